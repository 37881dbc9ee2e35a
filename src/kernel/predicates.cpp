// SPDX-License-Identifier: BSD-3-Clause
#include "kernel/predicates.hpp"

#include "kernel/stages.hpp"

#include <delone/error.hpp>
#include <delone/predicates.hpp>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace delone::kernel {
namespace {

/// The points with two of them exchanged if that makes the simplex positively oriented.
std::vector<const double*> positively_oriented(std::span<const double* const> points, Sign orientation_of_points) {
  std::vector<const double*> ordered(points.begin(), points.end());
  if (orientation_of_points == Sign::negative && ordered.size() > 1) std::swap(ordered[0], ordered[1]);
  return ordered;
}

Grid grid_of(std::span<const double* const> points, const double* q, int ambient) {
  Grid grid(ambient);
  for (const double* p : points) grid.include(p);
  if (q != nullptr) grid.include(q);
  return grid;
}

}  // namespace

Sign orientation(const Flat& flat, std::span<const double* const> points) {
  return orientation<0>(flat, points.data(), grid_of(points, nullptr, flat.ambient));
}

Sign in_sphere(const Flat& flat, std::span<const double* const> points, Sign orientation_of_points, const double* q) {
  if (flat.dimension() == 0) return Sign::positive;
  StageCounts counts;
  const auto ordered = positively_oriented(points, orientation_of_points);
  return in_sphere<0>(flat, ordered.data(), q, grid_of(points, q, flat.ambient), counts);
}

Sign in_sphere_perturbed(const Flat& flat, std::span<const double* const> points, Sign orientation_of_points, const double* q) {
  for (const double* p : points)
    if (equal_points(p, q, flat.ambient)) return Sign::zero;
  if (const Sign sign = in_sphere(flat, points, orientation_of_points, q); sign != Sign::zero) return sign;
  const auto ordered = positively_oriented(points, orientation_of_points);
  return perturbed_in_sphere<0>(flat, ordered.data(), q, grid_of(points, q, flat.ambient));
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
  for (std::size_t i = 0; i < basis_.size(); i += static_cast<std::size_t>(ambient_)) points.push_back(basis_.data() + i);
  return points;
}

int AffineHull::separating_axis(const double* p) const {
  if (dimension() == ambient_) return -1;
  std::vector<const double*> simplex = basis();
  simplex.push_back(p);
  const Grid grid = grid_of(simplex, nullptr, ambient_);
  for (int axis = 0; axis < ambient_; ++axis) {
    if (std::binary_search(axes_.begin(), axes_.end(), axis)) continue;
    std::vector<int> axes = axes_;
    axes.insert(std::upper_bound(axes.begin(), axes.end(), axis), axis);
    if (orientation<0>(Flat{ambient_, axes}, simplex.data(), grid) != Sign::zero) return axis;
  }
  return -1;
}

}  // namespace delone::kernel

namespace delone {
namespace {

/// Pointers to the rows, after checking their number and that every coordinate is finite.
std::vector<const double*> rows_of(std::span<const double> coordinates, int dimension, std::size_t expected) {
  if (dimension < 1) throw Error(Errc::bad_dimension, "the dimension must be at least 1");
  const auto d = static_cast<std::size_t>(dimension);
  if (coordinates.size() % d != 0 || (expected != 0 && coordinates.size() != expected * d))
    throw Error(Errc::bad_dimension, "the number of coordinates does not fit the dimension");
  std::vector<const double*> rows;
  for (std::size_t row = 0; row * d < coordinates.size(); ++row) {
    for (std::size_t j = 0; j < d; ++j)
      if (!std::isfinite(coordinates[row * d + j]))
        throw Error(Errc::not_finite, "a coordinate of point " + std::to_string(row) + " is not finite", {row});
    rows.push_back(coordinates.data() + row * d);
  }
  return rows;
}

std::vector<int> all_axes(int dimension) {
  std::vector<int> axes(static_cast<std::size_t>(dimension));
  std::iota(axes.begin(), axes.end(), 0);
  return axes;
}

template <class Predicate>
Sign sphere_sign(std::span<const double> points, std::span<const double> q, int dimension, Predicate predicate) {
  const auto simplex = rows_of(points, dimension, static_cast<std::size_t>(std::max(dimension, 0)) + 1);
  const auto query = rows_of(q, dimension, 1);
  const std::vector<int> axes = all_axes(dimension);
  const kernel::Flat flat{dimension, axes};
  const Sign orientation_of_points = kernel::orientation(flat, simplex);
  if (orientation_of_points == Sign::zero)
    throw Error(Errc::invalid_argument, "the points of the sphere are affinely dependent");
  return predicate(flat, simplex, orientation_of_points, query[0]);
}

}  // namespace

Sign orientation(std::span<const double> points, int dimension) {
  const auto simplex = rows_of(points, dimension, static_cast<std::size_t>(std::max(dimension, 0)) + 1);
  const std::vector<int> axes = all_axes(dimension);
  return kernel::orientation(kernel::Flat{dimension, axes}, simplex);
}

Sign in_sphere(std::span<const double> points, std::span<const double> q, int dimension) {
  return sphere_sign(points, q, dimension, [](const kernel::Flat& flat, const auto& simplex, Sign sign, const double* query) {
    return kernel::in_sphere(flat, simplex, sign, query);
  });
}

Sign in_sphere_perturbed(std::span<const double> points, std::span<const double> q, int dimension) {
  return sphere_sign(points, q, dimension, [](const kernel::Flat& flat, const auto& simplex, Sign sign, const double* query) {
    return kernel::in_sphere_perturbed(flat, simplex, sign, query);
  });
}

int affine_dimension(std::span<const double> points, int dimension) {
  kernel::AffineHull hull(dimension < 1 ? 1 : dimension);
  for (const double* row : rows_of(points, dimension, 0)) hull.add(row);
  return hull.dimension();
}

}  // namespace delone
