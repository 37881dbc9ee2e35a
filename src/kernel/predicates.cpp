// SPDX-License-Identifier: BSD-3-Clause
#include "kernel/predicates.hpp"

#include "base/compiled_dimension.hpp"
#include "base/require_finite.hpp"
#include "kernel/hull_stages.hpp"

#include <delone/arithmetic.hpp>
#include <delone/error.hpp>
#include <delone/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace delone::kernel {
namespace {

/// The points with two of them exchanged if that makes the simplex positively oriented.
std::vector<const double*> positively_oriented(std::span<const double* const> points,
                                               Sign orientation_of_points) {
  std::vector<const double*> ordered(points.begin(), points.end());
  if (orientation_of_points == Sign::negative && ordered.size() > 1) std::swap(ordered[0], ordered[1]);
  return ordered;
}

Grid grid_of(std::span<const double* const> points, const double* q, const Flat& flat) {
  Grid grid(flat.ambient, flat.weighted());
  const std::size_t n = points.size() + (q != nullptr ? 1 : 0);
  grid.include_all(n, [&](std::size_t i) { return i < points.size() ? points[i] : q; });
  return grid;
}

/// Empty for homogeneous rows, which need none.
Grid grid_of_hull(const Flat& flat, std::span<const double* const> facet, const double* inner,
                  const double* q) {
  if (flat.form == RowForm::homogeneous) return Grid(flat.ambient);
  Grid grid = grid_of(facet, q, flat);
  grid.include(inner);
  return grid;
}

}  // namespace

Sign orientation(const Flat& flat, std::span<const double* const> points) {
  return orientation<0>(flat, points.data(), grid_of(points, nullptr, flat));
}

Sign in_sphere(const Flat& flat, std::span<const double* const> points, Sign orientation_of_points,
               const double* q) {
  if (flat.dimension() == 0 && !flat.weighted()) return Sign::positive;
  internal::StageCounts counts;
  const auto ordered = positively_oriented(points, orientation_of_points);
  return in_sphere<0>(flat, ordered.data(), q, grid_of(points, q, flat), counts);
}

Sign in_sphere_perturbed(const Flat& flat, std::span<const double* const> points, Sign orientation_of_points,
                         const double* q) {
  for (const double* p : points)
    if (equal_points(p, q, flat.row_size())) return Sign::zero;
  if (const Sign sign = in_sphere(flat, points, orientation_of_points, q); sign != Sign::zero) return sign;
  const auto ordered = positively_oriented(points, orientation_of_points);
  return perturbed_in_sphere<0>(flat, ordered.data(), q, grid_of(points, q, flat));
}

Sign homogeneous_orientation(const Flat& flat, std::span<const double* const> rows) {
  internal::StageCounts counts;
  return homogeneous_orientation<0>(flat, rows.data(), counts);
}

Sign hull_side(const Flat& flat, std::span<const double* const> facet, const double* inner, const double* q) {
  const Grid grid = grid_of_hull(flat, facet, inner, q);
  internal::StageCounts counts;
  return hull_side<0>(flat, facet.data(), q, grid, counts) *
         hull_side<0>(flat, facet.data(), inner, grid, counts);
}

Sign hull_side_perturbed(const Flat& flat, std::span<const double* const> facet, const double* inner,
                         const double* q) {
  for (const double* row : facet)
    if (equal_rows(flat, row, q)) return Sign::zero;
  const Grid grid = grid_of_hull(flat, facet, inner, q);
  internal::StageCounts counts;
  const Sign side_of_inner = hull_side<0>(flat, facet.data(), inner, grid, counts);
  const Sign side = hull_side<0>(flat, facet.data(), q, grid, counts) * side_of_inner;
  return side != Sign::zero ? side
                            : perturbed_hull_side<0>(flat, facet.data(), q, inner, grid, side_of_inner);
}

bool AffineHull::add(const double* p) {
  int axis = -1;
  if (!basis_.empty()) {
    axis = separating_axis(p);
    if (axis < 0) return false;
    axes_.insert(std::upper_bound(axes_.begin(), axes_.end(), axis), axis);
  }
  basis_.insert(basis_.end(), p, p + ambient_);
  return true;
}

std::vector<const double*> AffineHull::basis() const {
  std::vector<const double*> points;
  for (std::size_t i = 0; i < basis_.size(); i += static_cast<std::size_t>(ambient_))
    points.push_back(basis_.data() + i);
  return points;
}

int AffineHull::separating_axis(const double* p) const {
  if (dimension() == ambient_) return -1;
  std::vector<const double*> simplex = basis();
  simplex.push_back(p);
  const Grid grid = grid_of(simplex, nullptr, Flat{ambient_, {}});
  for (int axis = 0; axis < ambient_; ++axis) {
    if (std::binary_search(axes_.begin(), axes_.end(), axis)) continue;
    std::vector<int> axes = axes_;
    axes.insert(std::upper_bound(axes.begin(), axes.end(), axis), axis);
    const Sign sign = internal::with_compiled_dimension<1, 6>(axes.size(), [&](auto k) {
      return orientation<k()>(Flat{ambient_, axes}, simplex.data(), grid);
    });
    if (sign != Sign::zero) return axis;
  }
  return -1;
}

}  // namespace delone::kernel

namespace delone {
namespace {

/// The signs of the kernel are those of distances, negative inside. Sides are positive inside.
Side side_of(Sign sign_of_distance) { return static_cast<Side>(-static_cast<int>(sign_of_distance)); }

/// Pointers to the rows, after checking their number and that every coordinate is finite.
std::vector<const double*> rows_of(std::span<const double> coordinates, int dimension, std::size_t expected) {
  if (dimension < 1) throw Error(Errc::bad_dimension, "the dimension must be at least 1");
  const auto d = static_cast<std::size_t>(dimension);
  if (coordinates.size() % d != 0 || (expected != 0 && coordinates.size() != expected * d))
    throw Error(Errc::bad_dimension, "the number of coordinates does not fit the dimension");
  internal::require_finite(coordinates, d, "a coordinate");
  std::vector<const double*> rows;
  for (std::size_t row = 0; row * d < coordinates.size(); ++row) rows.push_back(coordinates.data() + row * d);
  return rows;
}

std::vector<int> all_axes(int dimension) {
  std::vector<int> axes(static_cast<std::size_t>(dimension));
  std::iota(axes.begin(), axes.end(), 0);
  return axes;
}

/// Rows of a point and its weight: the form that weighted predicates read.
std::vector<double> with_weights(const std::vector<const double*>& points, std::span<const double> weights,
                                 int dimension) {
  if (weights.size() != points.size())
    throw Error(Errc::bad_dimension, "the number of weights is not that of the points");
  std::vector<double> rows;
  internal::require_finite(weights, 1, "the weight");
  for (std::size_t row = 0; row < points.size(); ++row) {
    rows.insert(rows.end(), points[row], points[row] + dimension);
    rows.push_back(weights[row]);
  }
  return rows;
}

template <class Predicate>
Side side_of_sphere(const kernel::Flat& flat, std::span<const double* const> simplex, const double* q,
                    Predicate predicate) {
  const Sign orientation_of_points = kernel::orientation(flat, simplex);
  if (orientation_of_points == Sign::zero)
    throw Error(Errc::invalid_argument, "the points of the sphere are affinely dependent");
  return side_of(predicate(flat, simplex, orientation_of_points, q));
}

template <class Predicate>
Side side_of_sphere(std::span<const double> points, std::span<const double> q, int dimension,
                    Predicate predicate) {
  const auto simplex = rows_of(points, dimension, static_cast<std::size_t>(std::max(dimension, 0)) + 1);
  const auto query = rows_of(q, dimension, 1);
  const std::vector<int> axes = all_axes(dimension);
  return side_of_sphere(kernel::Flat{dimension, axes}, simplex, query[0], predicate);
}

template <class Predicate>
Side side_of_power_sphere(std::span<const double> points, std::span<const double> weights,
                          std::span<const double> q, double weight_of_q, int dimension, Predicate predicate) {
  const auto simplex = rows_of(points, dimension, static_cast<std::size_t>(std::max(dimension, 0)) + 1);
  const auto query = rows_of(q, dimension, 1);
  const auto rows = with_weights(simplex, weights, dimension);
  const auto query_row = with_weights(query, std::span(&weight_of_q, 1), dimension);
  std::vector<const double*> weighted;
  for (std::size_t i = 0; i < simplex.size(); ++i)
    weighted.push_back(&rows[i * (static_cast<std::size_t>(dimension) + 1)]);
  const std::vector<int> axes = all_axes(dimension);
  return side_of_sphere(kernel::Flat{dimension, axes, kernel::RowForm::weighted_point}, weighted,
                        query_row.data(), predicate);
}

constexpr auto unperturbed = [](const auto&... arguments) { return kernel::in_sphere(arguments...); };
constexpr auto perturbed = [](const auto&... arguments) { return kernel::in_sphere_perturbed(arguments...); };

}  // namespace

Sign orientation(std::span<const double> points, int dimension) {
  const ArithmeticScope arithmetic;
  const auto simplex = rows_of(points, dimension, static_cast<std::size_t>(std::max(dimension, 0)) + 1);
  const std::vector<int> axes = all_axes(dimension);
  return kernel::orientation(kernel::Flat{dimension, axes}, simplex);
}

Side in_sphere(std::span<const double> points, std::span<const double> q, int dimension) {
  const ArithmeticScope arithmetic;
  return side_of_sphere(points, q, dimension, unperturbed);
}

Side in_sphere_perturbed(std::span<const double> points, std::span<const double> q, int dimension) {
  const ArithmeticScope arithmetic;
  return side_of_sphere(points, q, dimension, perturbed);
}

Side in_power_sphere(std::span<const double> points, std::span<const double> weights,
                     std::span<const double> q, double weight_of_q, int dimension) {
  const ArithmeticScope arithmetic;
  return side_of_power_sphere(points, weights, q, weight_of_q, dimension, unperturbed);
}

Side in_power_sphere_perturbed(std::span<const double> points, std::span<const double> weights,
                               std::span<const double> q, double weight_of_q, int dimension) {
  const ArithmeticScope arithmetic;
  return side_of_power_sphere(points, weights, q, weight_of_q, dimension, perturbed);
}

Sign homogeneous_orientation(std::span<const double> rows, int dimension) {
  const ArithmeticScope arithmetic;
  if (dimension < 1) throw Error(Errc::bad_dimension, "the dimension must be at least 1");
  const auto pointers = rows_of(rows, dimension + 1, static_cast<std::size_t>(dimension) + 1);
  const std::vector<int> axes = all_axes(dimension + 1);
  return kernel::homogeneous_orientation(kernel::Flat{dimension + 1, axes, kernel::RowForm::homogeneous},
                                         pointers);
}

Side side_of_hyperplane(std::span<const double> hyperplane, std::span<const double> p, int dimension) {
  const ArithmeticScope arithmetic;
  const auto point = rows_of(p, dimension, 1);
  const auto row = rows_of(hyperplane, dimension + 1, 1);
  internal::StageCounts counts;
  return side_of(kernel::side_of_hyperplane(row[0], point[0], dimension, counts));
}

int affine_dimension(std::span<const double> points, int dimension) {
  const ArithmeticScope arithmetic;
  const std::vector<const double*> rows = rows_of(points, dimension, 0);
  if (rows.empty()) return -1;
  kernel::AffineHull hull(dimension);
  for (const double* row : rows) hull.add(row);
  return hull.dimension();
}

}  // namespace delone
