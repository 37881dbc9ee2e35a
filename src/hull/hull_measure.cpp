// SPDX-License-Identifier: BSD-3-Clause
#include "hull/hull_measure.hpp"

#include "base/compiled_dimension.hpp"
#include "base/infinity.hpp"
#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "hull/hull_normal.hpp"
#include "solve/outward_direction.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

namespace delone::hull {

namespace {

/// Vectors, one after the other: on the stack if they are few.
class Columns {
 public:
  Columns(std::size_t count, std::size_t rows)
      : rows_(rows), more_(count * rows > std::size(few_) ? count * rows : 0) {}
  double* operator[](std::size_t i) { return (more_.empty() ? few_ : more_.data()) + i * rows_; }

 private:
  std::size_t rows_;
  double few_[64];
  std::vector<double> more_;
};

/// Reduces `count` columns of `rows` entries each to triangular form by reflections; returns the product of
/// |r_ii|.
double product_of_diagonal(Columns& columns, std::size_t count, std::size_t rows) {
  double product = 1;
  Columns scratch(1, rows);
  double* const reflector = scratch[0];
  for (std::size_t s = 0; s < count; ++s) {
    const double* const column = columns[s];
    double square = 0;
    for (std::size_t r = s; r < rows; ++r) square += column[r] * column[r];
    const double length = std::sqrt(square);
    product *= length;
    if (length == 0) continue;
    const double alpha = column[s] > 0 ? -length : length;
    for (std::size_t r = s; r < rows; ++r) reflector[r] = column[r];
    reflector[s] -= alpha;
    const double half_square = square - alpha * column[s];  // |reflector|²/2, both terms positive
    for (std::size_t j = s; j < count; ++j) {
      double* const other = columns[j];
      double dot = 0;
      for (std::size_t r = s; r < rows; ++r) dot += reflector[r] * other[r];
      const double factor = dot / half_square;
      for (std::size_t r = s; r < rows; ++r) other[r] -= factor * reflector[r];
    }
  }
  return product;
}

/// x·2^exponent for an exponent of any size.
double times_power(double x, std::int64_t exponent) {
  return std::ldexp(x, static_cast<int>(std::clamp<std::int64_t>(exponent, -10000, 10000)));
}

std::vector<const double*>& gather(const BoundarySites& sites, std::span<const Index> cell,
                                   std::vector<const double*>& points) {
  points.clear();
  for (const Index site : cell) points.push_back(sites.point(site));
  return points;
}

/// Sums over the cells of a hull.
class Measuring {
 public:
  Measuring(const BoundarySites& sites, const SimplicialHull& hull)
      : sites_(sites),
        apex_(hull.cells[0]),
        is_full_(hull.dimension > 1 && hull.dimension == sites.ambient) {}

  /// Whether HullNormal, which works on k axes, helps: if k < d, it gives the areas of projections.
  bool needs_normals() const { return is_full_; }
  /// Adds a cell with these points, and its normal if that is known.
  template <int D>
  void add(std::span<const Index> cell, std::vector<const double*>& points, const HullNormal<D>* normal) {
    const bool has_apex = std::find(cell.begin(), cell.end(), apex_) != cell.end();
    if (normal != nullptr && normal->has_measures()) {
      area_.add(normal->content());
      if (!has_apex) volume_.add(normal->cone(sites_.point(apex_), sites_.axes));
      return;
    }
    area_.add(simplex_volume(points, sites_.ambient));
    if (has_apex) return;
    points.push_back(sites_.point(apex_));
    volume_.add(simplex_volume(points, sites_.ambient));
    points.pop_back();
  }
  void add(const Measuring& other) {
    volume_.add(other.volume_);
    area_.add(other.area_);
  }
  HullMeasures result(const SimplicialHull& hull) const {
    if (hull.dimension == 1) return {volume_.result(), {static_cast<double>(hull.num_cells()), 0}};
    return {volume_.result(), area_.result()};
  }

 private:
  const BoundarySites& sites_;
  Index apex_;
  bool is_full_;
  MeasureSum volume_, area_;
};

template <int D>
HullMeasures measure(const BoundarySites& sites, const SimplicialHull& hull, unsigned threads) {
  constexpr std::size_t part = 8192;
  std::vector<Measuring> of_parts((hull.num_cells() + part - 1) / part, Measuring(sites, hull));
  internal::for_parts(threads, hull.num_cells(), part,
                      [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                        HullNormal<D> normal(hull.dimension);
                        Measuring measuring(sites, hull);
                        std::vector<const double*> points;
                        for (std::size_t c = first; c < last; ++c) {
                          stop();
                          gather(sites, hull.cell(c), points);
                          const bool is_known =
                              measuring.needs_normals() && normal.compute(points.data(), sites.axes, false);
                          measuring.add(hull.cell(c), points, is_known ? &normal : nullptr);
                        }
                        of_parts[first / part].add(measuring);
                      });
  for (std::size_t p = 1; p < of_parts.size(); ++p) of_parts[0].add(of_parts[p]);
  return of_parts[0].result(hull);
}

/// An upper bound on the distance between two sites.
double extent_of(const BoundarySites& sites) {
  double square = 0;  // of the diagonal of the bounding box
  for (int j = 0; j < sites.ambient; ++j) {
    double low = sites.point(0)[j], high = low;
    for (Index site = 1; site < sites.size(); ++site) {
      low = std::min(low, sites.point(site)[j]);
      high = std::max(high, sites.point(site)[j]);
    }
    square += (high - low) * (high - low);
  }
  return 1.01 * std::sqrt(square) + 1e-150;  // squares may underflow
}

template <int D>
void fill_equations(const BoundarySites& sites, const SimplicialHull& hull,
                    std::span<const Index> facet_of_cell,
                    const std::function<const double*(std::size_t)>& inner, std::span<const Index> seeds,
                    HullMeasures* measures, FacetEquations& result) {
  const std::size_t d = static_cast<std::size_t>(sites.ambient), k = hull.corners();
  const double extent = extent_of(sites);
  HullNormal<D> normal(hull.dimension);
  Measuring measuring(sites, hull);
  std::vector<const double*> points;
  for (std::size_t c = 0; c < hull.num_cells(); ++c) {
    internal::cancellation_point();
    if (!seeds.empty() && seeds[facet_of_cell[c]] != c) continue;
    gather(sites, hull.cell(c), points);
    const bool is_known = k == d && normal.compute(points.data(), sites.axes, k == 1 && c == 0);
    if (measures != nullptr)
      measuring.add(hull.cell(c), points, is_known && measuring.needs_normals() ? &normal : nullptr);
    // Vectors N and N′ with |N − N′| ≤ e differ by at most 2e/|N| after normalization. Rounding the length
    // and the quotients adds (k + 5)·u. Where elimination fails, the relative error is that of
    // outward_direction(). Normals in a flat have no bound.
    constexpr double of_direction = 1e-12;
    const double relative = is_known ? 2 * normal.error() / normal.length() : of_direction;
    const double error =
        k == d ? 1.01 * (relative + static_cast<double>(k + 5) * 0x1p-53) * extent : internal::infinity;
    double* const equation = result.equations.data() + facet_of_cell[c] * (d + 1);
    double& best = result.errors[facet_of_cell[c]];
    if (best >= 0 && error >= best) continue;  // another cell of the facet is better
    if (is_known)
      for (std::size_t j = 0; j < d; ++j) equation[j] = normal.normal()[j] / normal.length();
    else
      std::ranges::copy(solve::outward_direction(points, inner(c), d), equation);
    double offset = 0, magnitude = 0;
    for (std::size_t j = 0; j < d; ++j) {
      offset -= equation[j] * points[0][j];
      magnitude += std::fabs(equation[j] * points[0][j]);
    }
    equation[d] = offset;
    best = error + 1.01 * static_cast<double>(d + 1) * 0x1p-53 * magnitude;
  }
  if (measures != nullptr) *measures = measuring.result(hull);
}

}  // namespace

void MeasureSum::add(const Measure& term) {
  sum_.add(term.value);
  error_ += term.error;
  magnitude_ += std::fabs(term.value);
}

void MeasureSum::add(const MeasureSum& other) {
  sum_.add(other.sum_);
  error_ += other.error_;
  magnitude_ += other.magnitude_;
}

Measure MeasureSum::result() const {
  const double value = sum_.value();
  if (!std::isfinite(value)) return {value, internal::infinity};
  // The rounding of the result, and the second-order terms of the sum for fewer than 2^40 terms.
  return {value, (1 + 0x1p-20) * error_ + 0x1p-52 * std::fabs(value) + 0x1p-64 * magnitude_ + 1e-320};
}

Measure simplex_volume(std::span<const double* const> points, int ambient) {
  const std::size_t j = points.size() - 1, d = static_cast<std::size_t>(ambient);
  if (j == 0) return {1, 0};
  Columns edges(j, d);
  std::int64_t exponent = 0;
  double product = 1, factorial = 1;
  for (std::size_t i = 0; i < j; ++i) {
    double largest = 0;
    for (std::size_t r = 0; r < d; ++r) {
      edges[i][r] = points[i + 1][r] - points[0][r];
      largest = std::max(largest, std::fabs(edges[i][r]));
    }
    if (!std::isfinite(largest)) return {internal::infinity, internal::infinity};
    if (largest == 0) return {0, 0};
    const int scale = std::ilogb(largest);
    double square = 0;
    // ldexp() is slow, and multiplication is the same while the factor is a double.
    const bool has_factor = scale > -1000 && scale < 1000;
    const double factor = has_factor ? std::ldexp(1.0, -scale) : 0;
    for (std::size_t r = 0; r < d; ++r) {
      double& x = edges[i][r];
      x = has_factor ? x * factor : std::ldexp(x, -scale);
      square += x * x;
    }
    exponent += scale;
    product *= std::sqrt(square);
    factorial *= static_cast<double>(i + 1);
  }
  const double value = product_of_diagonal(edges, j, d);
  const double relative = 10.0 * static_cast<double>(j * (d + 8)) * 0x1p-53;
  const double bound = 1.01 * product * (std::pow(1 + relative, static_cast<double>(j)) - 1) +
                       static_cast<double>(3 * j) * 0x1p-53 * value;
  return {times_power(value / factorial, exponent),
          times_power(bound / factorial, exponent) + std::numeric_limits<double>::denorm_min()};
}

HullMeasures measure_hull(const BoundarySites& sites, const SimplicialHull& hull, unsigned threads) {
  if (hull.num_cells() == 0) return {};
  return internal::with_compiled_dimension(hull.corners(),
                                           [&](auto k) { return measure<k()>(sites, hull, threads); });
}

FacetEquations facet_equations(const BoundarySites& sites, const SimplicialHull& hull,
                               std::span<const Index> facet_of_cell, std::size_t num_facets,
                               const std::function<const double*(std::size_t)>& inner,
                               std::span<const Index> seeds, HullMeasures* measures) {
  FacetEquations result{std::vector<double>(num_facets * (static_cast<std::size_t>(sites.ambient) + 1)),
                        std::vector<double>(num_facets, -1)};
  if (measures != nullptr) *measures = {};
  if (num_facets > 0)
    internal::with_compiled_dimension(hull.corners(), [&](auto k) {
      fill_equations<k()>(sites, hull, facet_of_cell, inner, seeds, measures, result);
    });
  return result;
}

}  // namespace delone::hull
