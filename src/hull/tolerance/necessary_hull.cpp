// SPDX-License-Identifier: BSD-3-Clause
// Covered. Let o be a point of the hull, v_i the vertices of a cell and w_i ≥ 0 weights with Σw_i ≤ 1: then
// z = o + Σw_i·(v_i − o) is in the hull. The weights are computed, rounded, and scaled if their sum exceeds
// 1; so it exceeds 1 by at most η = (d+4)·u. If it does, z divided by it is in the hull, and |z − that| ≤
// η·Σw_i·|v_i − o|. The computed p − z is off in each coordinate by at most γ(d+3) of the sum of the
// magnitudes of its terms. The distance of p from the hull is at most the norm of p − z, and these. Products
// that underflow are far below the absolute term.
#include "hull/tolerance/necessary_hull.hpp"

#include "base/progress_meter.hpp"
#include "hull/point_sieve.hpp"
#include "kernel/determinant.hpp"
#include "kernel/nearest_in_hull.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace delone::internal {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double unit = kernel::unit_roundoff;
constexpr double absolute = 0x1p-500;

/// The inverses of the cells' cones, each computed when it is first asked for.
class Cones {
 public:
  Cones(const HullState& state, const double* center)
      : sites_(state.sites()),
        hull_(state.hull()),
        center_(center),
        d_(static_cast<std::size_t>(sites_.ambient)),
        inverses_(hull_.num_cells() * d_ * d_),
        is_known_(hull_.num_cells(), 0) {}

  const SimplicialHull& hull() const { return hull_; }

  /// The matrix that takes x − o to the weights of the cell's vertices; with numbers that are none if
  /// binary64 finds the cone to be flat.
  const double* inverse(std::size_t cell) {
    double* const result = inverses_.data() + cell * d_ * d_;
    if (std::exchange(is_known_[cell], 1) == 0) invert(cell, result);
    return result;
  }
  double edge(std::size_t cell, std::size_t i, std::size_t j) const {
    return sites_.point(hull_.cell(cell)[i])[j] - center_[j];
  }

 private:
  void invert(std::size_t cell, double* result) {
    matrix_.resize(d_ * 2 * d_);
    const std::size_t width = 2 * d_;
    for (std::size_t r = 0; r < d_; ++r)
      for (std::size_t c = 0; c < d_; ++c) {
        matrix_[r * width + c] = edge(cell, c, r);
        matrix_[r * width + d_ + c] = r == c ? 1 : 0;
      }
    for (std::size_t s = 0; s < d_; ++s) {
      std::size_t pivot = s;
      for (std::size_t r = s + 1; r < d_; ++r)
        if (std::fabs(matrix_[r * width + s]) > std::fabs(matrix_[pivot * width + s])) pivot = r;
      if (pivot != s)
        std::swap_ranges(matrix_.begin() + static_cast<std::ptrdiff_t>(s * width),
                         matrix_.begin() + static_cast<std::ptrdiff_t>((s + 1) * width),
                         matrix_.begin() + static_cast<std::ptrdiff_t>(pivot * width));
      double* const row = matrix_.data() + s * width;
      const double factor = 1 / row[s];
      for (std::size_t c = s; c < width; ++c) row[c] *= factor;
      for (std::size_t r = 0; r < d_; ++r) {
        double* const other = matrix_.data() + r * width;
        const double part = other[s];
        if (r == s || part == 0) continue;
        for (std::size_t c = s; c < width; ++c) other[c] -= part * row[c];
      }
    }
    for (std::size_t r = 0; r < d_; ++r) std::copy_n(matrix_.data() + r * width + d_, d_, result + r * d_);
  }

  const HullSites& sites_;
  const SimplicialHull& hull_;
  const double* center_;
  std::size_t d_;
  std::vector<double> inverses_, matrix_;
  std::vector<char> is_known_;
};

class Search {
 public:
  Search(std::span<const double> coordinates, int dimension, const Options& options)
      : coordinates_(coordinates),
        d_(static_cast<std::size_t>(dimension)),
        n_(coordinates.size() / d_),
        tolerance_(options.tolerance),
        meter_(options.progress, 0),
        sieve_(coordinates, dimension),
        difference_(d_),
        weights_(d_) {}

  std::optional<NecessaryHull> run() {
    sieve_.run();
    if (!sieve_.has_shell() || !has_moderate_size() || !is_far_from_flats()) return std::nullopt;
    for (std::size_t i = 0; i < sieve_.num_remaining(); ++i)
      if (!sieve_.is_in_shell(i)) open_.push_back(i);
    constexpr int most_rounds = 64;
    for (int round = 0; !open_.empty(); ++round) {
      meter_(0);
      if (round == most_rounds || sieve_.shell_rows().size() * n_ > most_work) return std::nullopt;
      cover();
      if (!open_.empty() && !extend()) return std::nullopt;
    }
    // Equal rows would be one site.
    if (shell().sites().size() != sieve_.shell_rows().size() || !all_are_necessary()) return std::nullopt;
    return result();
  }

 private:
  static constexpr std::size_t most_work = std::size_t{1} << 20;

  HullState& shell() { return sieve_.shell(); }
  const double* point(std::size_t i) const { return sieve_.remaining_points().data() + i * d_; }
  const ConvexHullBuilder& builder() { return *shell().builder(); }

  /// Whether squares neither overflow nor underflow where that matters, and there is a point o.
  bool has_moderate_size() {
    const auto& reach = sieve_.box().reach;
    return std::all_of(reach.begin(), reach.end(), [](double x) { return x > 0x1p-300 && x < 0x1p300; }) &&
           shell().builder() != nullptr && builder().has_center() && builder().boundary() != nullptr;
  }

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

  /// Sets weights_ to the nonnegative ones nearest to those of p in the cone of a cell, and returns a bound
  /// on the distance.
  double distance_up(const Cones& cones, std::size_t cell) {
    double sum = 0, square = 0, moved = 0;
    for (double& w : weights_) sum += w = std::max(w, 0.0);
    if (sum > 1)
      for (double& w : weights_) w /= sum;
    const auto dimension = static_cast<double>(d_);
    for (std::size_t j = 0; j < d_; ++j) {
      double rest = difference_[j], size = 0;
      for (std::size_t i = 0; i < d_; ++i) {
        const double term = weights_[i] * cones.edge(cell, i, j);
        rest -= term;
        size += std::fabs(term);
      }
      moved += size;
      const double most =
          std::fabs(rest) + 1.01 * (dimension + 3) * unit * (size + std::fabs(difference_[j]));
      square += most * most;
    }
    return (std::sqrt(square) + 1.01 * (dimension + 4) * unit * moved) * (1 + (dimension + 8) * unit) +
           absolute;
  }

  /// Walks to the cone of a point and returns a bound on its distance; cell_ is where it ends.
  double walk(Cones& cones, const double* p) {
    constexpr int most_steps = 100;
    const double* const center = builder().center().data();
    for (std::size_t j = 0; j < d_; ++j) difference_[j] = p[j] - center[j];
    double best = infinity;
    for (int step = 0; step < most_steps; ++step) {
      const double* const inverse = cones.inverse(cell_);
      std::size_t least = 0;
      for (std::size_t i = 0; i < d_; ++i) {
        double w = 0;
        for (std::size_t j = 0; j < d_; ++j) w += inverse[i * d_ + j] * difference_[j];
        weights_[i] = w;
        if (!(w >= weights_[least])) least = i;
      }
      sum_ = std::accumulate(weights_.begin(), weights_.end(), 0.0);
      const bool is_in_cone = weights_[least] >= 0;
      if (weights_[least] > -0x1p-20) {
        best = std::min(best, distance_up(cones, cell_));
        if (best <= tolerance_ || is_in_cone) return best;
      }
      // Flat cones lead nowhere in particular.
      const std::size_t across =
          sum_ > -infinity && sum_ < infinity ? least : static_cast<std::size_t>(step) % d_;
      cell_ = cones.hull().neighbors_of(cell_)[across];
    }
    return best;
  }

  /// Takes out the open points that are covered or in the interior; sets cells_ for the others.
  void cover() {
    Cones cones(shell(), builder().center().data());
    const HullEngine& boundary = *builder().boundary();
    std::vector<Index> start(1);
    cells_.clear();
    cell_ = 0;
    std::size_t left = 0;
    for (const std::size_t i : open_) {
      const double distance = walk(cones, point(i));
      if (distance <= tolerance_) {
        start[0] = cones.hull().slots[cell_];
        if (sum_ < 1 - 0x1p-30 && boundary.descend(point(i), start).second == Sign::positive) continue;
        covered_.push_back(i);
      } else {
        open_[left++] = i;
        cells_.push_back(static_cast<Index>(cell_));
      }
    }
    open_.resize(left);
  }

  /// Adds the farthest points beyond cells whose cones have open points.
  bool extend() {
    const SimplicialHull& hull = shell().hull();
    std::sort(cells_.begin(), cells_.end());
    cells_.erase(std::unique(cells_.begin(), cells_.end()), cells_.end());
    LinearFunctions functions{builder().center(), std::vector<double>(cells_.size() * d_)};
    std::vector<double> heights;
    for (std::size_t f = 0; f < cells_.size(); ++f) {
      double* const normal = functions.normals.data() + f * d_;
      const double threshold = builder().boundary()->hyperplane(hull.slots[cells_[f]], normal);
      const double square = std::inner_product(normal, normal + d_, normal, 0.0);
      heights.push_back(1 + threshold + std::sqrt(square) * tolerance_);
      if (heights.back() < infinity) continue;
      std::fill_n(normal, d_, 0.0);
      heights.back() = infinity;
    }
    std::vector<double> points;
    for (const std::size_t i : open_) points.insert(points.end(), point(i), point(i) + d_);
    std::vector<std::size_t> farther;
    for (const bool tilted : {true, false}) {
      const std::vector<std::size_t> farthest = sieve_.extremes_among(points, functions, tilted);
      for (std::size_t f = 0; f < farthest.size(); ++f) {
        if (farthest[f] == Extreme::nowhere) continue;
        const double* const x = points.data() + farthest[f] * d_;
        double value = 0;
        for (std::size_t j = 0; j < d_; ++j)
          value += functions.normals[f * d_ + j] * (x[j] - functions.origin[j]);
        if (value > heights[f]) farther.push_back(open_[farthest[f]]);
      }
      if (!farther.empty()) break;
    }
    if (farther.empty()) return cover_by_all();
    std::sort(farther.begin(), farther.end());
    farther.erase(std::unique(farther.begin(), farther.end()), farther.end());
    sieve_.add_to_shell(farther);
    std::erase_if(open_, [&](std::size_t i) { return sieve_.is_in_shell(i); });
    return true;
  }

  /// The nearest points of the open ones in the hull of all vertices; false if one of them is not covered.
  bool cover_by_all() {
    constexpr std::size_t most_open = 256;
    if (open_.size() > most_open) return false;
    std::vector<const double*> vertices;
    for (Index site = 0; site < shell().sites().size(); ++site)
      vertices.push_back(shell().sites().point(site));
    for (const std::size_t i : open_) {
      nearest_.find(vertices, point(i), static_cast<int>(d_));
      if (!(nearest_.upper() <= tolerance_)) return false;
      covered_.push_back(i);
    }
    open_.clear();
    return true;
  }

  /// For each vertex the sum of the unit normals of its cells.
  std::vector<double> directions() {
    const HullState& state = shell();
    const SimplicialHull& hull = state.hull();
    std::vector<double> sums(state.sites().size() * d_, 0.0), normal(d_);
    for (std::size_t c = 0; c < hull.num_cells(); ++c) {
      const double threshold = builder().boundary()->hyperplane(hull.slots[c], normal.data());
      const double length = std::sqrt(std::inner_product(normal.begin(), normal.end(), normal.begin(), 0.0));
      if (!(threshold < 0x1p-20 && length > 0 && length < infinity)) continue;
      for (const Index site : hull.cell(c))
        for (std::size_t j = 0; j < d_; ++j) sums[site * d_ + j] += normal[j] / length;
    }
    return sums;
  }

  /// Whether n proves that v is farther than the tolerance from the hull of all other points. A computed n·(v
  /// − w) is off by at most γ(d+1) of the sum of the absolute products, and these are at most Σ|n_j| times
  /// the extent.
  bool is_necessary(const double* v, const double* n) const {
    double square = 0, size = 0;
    for (std::size_t j = 0; j < d_; ++j) {
      square += n[j] * n[j];
      size += std::fabs(n[j]) * sieve_.box().reach[j];
    }
    const auto dimension = static_cast<double>(d_);
    const double length = std::sqrt(square) * (1 + (dimension + 4) * unit);
    if (!(length > 0x1p-400 && length < 0x1p400)) return false;
    const double least =
        tolerance_ * length * (1 + 4 * unit) + 2.02 * (dimension + 2) * unit * size * 1.01 + absolute;
    const double* w = coordinates_.data();
    for (std::size_t i = 0; i < n_; ++i, w += d_) {
      double product = 0;
      for (std::size_t j = 0; j < d_; ++j) product += n[j] * (v[j] - w[j]);
      if (!(product > least) && !std::equal(v, v + d_, w)) return false;
    }
    return true;
  }

  bool all_are_necessary() {
    const HullSites& sites = shell().sites();
    const std::vector<double> sums = directions();
    std::vector<const double*> others;
    std::vector<double> direction(d_);
    for (Index v = 0; v < sites.size(); ++v) {
      if (is_necessary(sites.point(v), sums.data() + v * d_)) continue;
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

  NecessaryHull result() {
    NecessaryHull found;
    found.rows = sieve_.shell_rows();
    std::sort(covered_.begin(), covered_.end());
    for (const std::size_t i : covered_) {
      const Index row = sieve_.remaining_row(i);
      const Index site = shell().add_without_inserting(point(i));
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
  ProgressMeter meter_;
  PointSieve sieve_;
  kernel::NearestInHull nearest_;
  std::vector<std::size_t> open_, covered_;  // remaining rows
  std::vector<Index> cells_;                 // where the open ones are
  // Of the walk.
  std::size_t cell_ = 0;
  double sum_ = 0;
  std::vector<double> difference_, weights_;
};

}  // namespace

std::optional<NecessaryHull> find_necessary_hull(std::span<const double> coordinates, int dimension,
                                                 const Options& options) {
  constexpr std::size_t least_rows = 64, most_rows = 8192;
  const std::size_t n = coordinates.size() / static_cast<std::size_t>(dimension);
  if (dimension < 2 || n < least_rows || n > most_rows) return std::nullopt;
  return Search(coordinates, dimension, options).run();
}

}  // namespace delone::internal
