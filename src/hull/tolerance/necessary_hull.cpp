// SPDX-License-Identifier: BSD-3-Clause
#include "hull/tolerance/necessary_hull.hpp"

#include "base/infinity.hpp"
#include "base/progress_meter.hpp"
#include "hull/growing_shell.hpp"
#include "hull/point_sieve.hpp"
#include "hull/sieve_kernel.hpp"
#include "hull/site_normals.hpp"
#include "kernel/determinant.hpp"
#include "kernel/nearest_in_hull.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace delone::hull {
namespace {

using kernel::unit_roundoff;

class Search {
 public:
  Search(std::span<const double> coordinates, int dimension, double tolerance, const Options& options)
      : coordinates_(coordinates),
        d_(static_cast<std::size_t>(dimension)),
        n_(coordinates.size() / d_),
        tolerance_(tolerance),
        meter_(options.progress, 0),
        sieve_(coordinates, dimension) {}

  std::optional<NecessaryHull> run() {
    sieve_.run();
    if (!sieve_.has_shell()) return std::nullopt;
    GrowingShell growth(sieve_, tolerance_, [&] { meter_(0); });
    if (!growth.is_possible() || !is_far_from_flats() || !growth.run({.vertices = most_work / n_}))
      return std::nullopt;
    // Equal rows would be one site.
    if (shell().sites().size() != sieve_.shell_rows().size() || !all_are_necessary()) return std::nullopt;
    return result(growth.covered());
  }

 private:
  static constexpr std::size_t most_work = std::size_t{1} << 20;

  HullState& shell() { return sieve_.shell(); }

  /// Let h be the least height of a simplex of points. A flat of fewer dimensions is farther than
  /// h/(2·(d+1)) from one of them: the simplex is no thinner than h/(d+1) in any direction. With the bounds
  /// here that is far more than the tolerance, and than the rounding in the search for the farthest point.
  bool is_far_from_flats() {
    std::vector<const double*> simplex;
    for (const Index site : shell().basis()) simplex.push_back(shell().sites().point(site));
    const auto& reach = sieve_.box().reach;
    const double extent = *std::max_element(reach.begin(), reach.end());
    const double height = nearest_.least_height_down(simplex, static_cast<int>(d_));
    return height > 8 * static_cast<double>(d_ + 1) * tolerance_ && height > extent * 0x1p-16;
  }

  /// A point v is farther than the tolerance from the hull of others if all computed n·(v − w) exceed this;
  /// also if all differences of computed n·(v − o) and n·(w − o) do, where o is the center of the box. A
  /// computed n·(v − w) is off by at most γ(d+1) of the sum of the absolute products, and these are at most
  /// Σ|n_j| times the extent. Each of the other two, fused or not, is off by as much of half of that, and
  /// their difference by one rounding more. Infinite if n is too long or too short.
  double least_beyond(const double* n) const {
    double square = 0, size = 0;
    for (std::size_t j = 0; j < d_; ++j) {
      square += n[j] * n[j];
      size += std::fabs(n[j]) * sieve_.box().reach[j];
    }
    const auto dimension = static_cast<double>(d_);
    const double length = std::sqrt(square) * (1 + (dimension + 4) * unit_roundoff);
    if (!(length > 0x1p-400 && length < 0x1p400)) return internal::infinity;
    return tolerance_ * length * (1 + 4 * unit_roundoff) +
           2.02 * (dimension + 3) * unit_roundoff * size * 1.01 + underflow_slack;
  }

  /// Whether n proves that v is farther than the tolerance from the hull of all other points.
  bool is_necessary(const double* v, const double* n) const {
    const double least = least_beyond(n);
    const double* w = coordinates_.data();
    for (std::size_t i = 0; i < n_; ++i, w += d_) {
      double product = 0;
      for (std::size_t j = 0; j < d_; ++j) product += n[j] * (v[j] - w[j]);
      if (!(product > least) && !std::equal(v, v + d_, w)) return false;
    }
    return true;
  }

  /// For each vertex whether its direction proves the same. Equal rows prove nothing.
  std::vector<char> are_necessary(const std::vector<double>& directions) {
    constexpr std::size_t block = 64;  // of vertices, which are compared with each other one by one
    const std::size_t m = sieve_.shell_rows().size();
    std::vector<char> is_vertex(n_, 0), are(m, 0);
    std::vector<double> points;
    points.reserve(n_ * d_);
    const auto add = [&](std::size_t row) {
      const auto point = coordinates_.subspan(row * d_, d_);
      points.insert(points.end(), point.begin(), point.end());
    };
    for (const Index row : sieve_.shell_rows()) {
      is_vertex[row] = 1;
      add(row);
    }
    for (std::size_t row = 0; row < n_; ++row)
      if (is_vertex[row] == 0) add(row);
    for (std::size_t first = 0; first < m; first += block) {
      const std::size_t last = std::min(first + block, m);
      LinearFunctions functions{sieve_.box().center, {}};
      functions.normals.assign(directions.begin() + static_cast<std::ptrdiff_t>(first * d_),
                               directions.begin() + static_cast<std::ptrdiff_t>(last * d_));
      std::vector<Extreme> others(last - first, Extreme{-internal::infinity, Extreme::nowhere});
      find_extremes(std::span(points).first(first * d_), functions, others);
      find_extremes(std::span(points).subspan(last * d_), functions, others);
      for (std::size_t v = first; v < last; ++v) {
        const double* const n = directions.data() + v * d_;
        const auto value = [&](std::size_t w) {
          double sum = 0;
          for (std::size_t j = 0; j < d_; ++j) sum += n[j] * (points[w * d_ + j] - functions.origin[j]);
          return sum;
        };
        double largest = others[v - first].value;
        for (std::size_t w = first; w < last; ++w)
          if (w != v) largest = std::max(largest, value(w));
        are[v] = value(v) - largest > least_beyond(n) ? 1 : 0;
      }
    }
    return are;
  }

  bool all_are_necessary() {
    const BoundarySites& sites = shell().sites();
    const std::vector<double> sums = sums_of_normals(shell());
    const std::vector<char> are = are_necessary(sums);
    std::vector<const double*> others;
    std::vector<double> direction(d_);
    for (Index v = 0; v < sites.size(); ++v) {
      if (are[v] != 0 || is_necessary(sites.point(v), sums.data() + v * d_)) continue;
      others.clear();
      for (Index w = 0; w < sites.size(); ++w)
        if (w != v) others.push_back(sites.point(w));
      nearest_.find(others, sites.point(v), static_cast<int>(d_));
      std::fill(direction.begin(), direction.end(), 0.0);
      for (const int i : nearest_.face())
        for (std::size_t j = 0; j < d_; ++j)
          direction[j] += nearest_.weights()[static_cast<std::size_t>(i)] *
                          (sites.point(v)[j] - others[static_cast<std::size_t>(i)][j]);
      if (!is_necessary(sites.point(v), direction.data())) return false;
    }
    return true;
  }

  NecessaryHull result(const std::vector<std::size_t>& covered) {
    NecessaryHull found;
    found.rows = sieve_.shell_rows();
    for (const std::size_t i : covered) {
      const Index row = sieve_.remaining_row(i);
      const Index site = shell().add_without_inserting(sieve_.remaining_points().data() + i * d_);
      if (site == found.rows.size())
        found.rows.push_back(row);
      else
        found.rows[site] = std::min(found.rows[site], row);
    }
    found.state = sieve_.take_shell();
    return found;
  }

  std::span<const double> coordinates_;
  std::size_t d_, n_;
  double tolerance_;
  internal::ProgressMeter meter_;
  PointSieve sieve_;
  kernel::NearestInHull nearest_;
};

/// The hull of the same rows, with other coordinates: of those that are vertices, which come first.
std::unique_ptr<HullState> hull_of_rows(std::span<const double> coordinates, int dimension,
                                        const NecessaryHull& found, double tolerance,
                                        const Options& options) {
  const auto d = static_cast<std::size_t>(dimension);
  const std::vector<Index>& corners = found.state->hull().cells;
  const std::size_t num_vertices = std::size_t{*std::max_element(corners.begin(), corners.end())} + 1;
  std::vector<double> vertices;
  for (std::size_t i = 0; i < num_vertices; ++i) {
    const auto row = coordinates.subspan(found.rows[i] * d, d);
    vertices.insert(vertices.end(), row.begin(), row.end());
  }
  Options quiet;
  quiet.seed = options.seed;
  quiet.tolerance = tolerance;  // then every row gets a site
  auto state = std::make_unique<HullState>(dimension);
  state->insert_range(vertices, quiet);
  for (std::size_t i = num_vertices; i < found.rows.size(); ++i)
    state->add_without_inserting(coordinates.data() + found.rows[i] * d);
  return state;
}

}  // namespace

std::optional<NecessaryHull> find_necessary_hull(std::span<const double> coordinates, int dimension,
                                                 const internal::AxisScale& scale, const Options& options) {
  constexpr std::size_t least_rows = 64, most_rows = 8192;
  const std::size_t n = coordinates.size() / static_cast<std::size_t>(dimension);
  if (dimension < 2 || n < least_rows || n > most_rows) return std::nullopt;
  if (scale.is_one()) return Search(coordinates, dimension, scale.tolerance(), options).run();
  const std::vector<double> scaled = scale.scaled(coordinates);
  auto found = Search(scaled, dimension, scale.tolerance(), options).run();
  if (found) found->state = hull_of_rows(coordinates, dimension, *found, scale.tolerance(), options);
  return found;
}

}  // namespace delone::hull
