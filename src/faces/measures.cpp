// SPDX-License-Identifier: BSD-3-Clause
#include <delone/measures.hpp>

#include "base/guarded.hpp"
#include "base/quick_rounds.hpp"
#include "faces/cell_blocks.hpp"
#include "faces/cell_shape.hpp"
#include "faces/face_blocks.hpp"
#include "solve/cell_center.hpp"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace delone {
namespace internal {
namespace {

/// As for_blocks_of_cells(), for the finite cells.
template <class MakeWork>
void for_blocks_of(const Triangulation& triangulation, unsigned threads, const MakeWork& make_work) {
  const Complex complex = triangulation.complex();
  const sites::VertexPoints& points = triangulation::StoredPoints::of(triangulation);
  std::vector<CellId> cells;
  cells.reserve(complex.num_finite_cells());
  QuickRounds round;
  for (const CellId c : complex.finite_cells()) {
    round();
    cells.push_back(c);
  }
  const auto corner_of = [&](std::size_t cell, std::size_t i) {
    return points.point(index(complex.vertex(cells[cell], static_cast<int>(i))));
  };
  for_blocks_of_cells(cells.size(), static_cast<std::size_t>(complex.affine_dimension() + 1), threads,
                      corner_of, make_work);
}

/// Calls take(cell, radius, points) for the finite cells.
template <class Take>
void for_radii_of(const Triangulation& triangulation, unsigned threads, const Take& take) {
  for_blocks_of(triangulation, threads,
                radii_of_blocks(triangulation.dimension(),
                                static_cast<std::size_t>(triangulation.affine_dimension() + 1),
                                unit_of(triangulation), take));
}

}  // namespace
}  // namespace internal

std::vector<double> circumradii(const Triangulation& triangulation, const Execution& how) {
  return internal::guarded("the circumradii", [&] {
    const internal::ProgressMeter meter(how.progress);
    std::vector<double> radii(triangulation.num_finite_cells(), 0.0);
    if (triangulation.affine_dimension() < 1) return radii;
    const auto take = [&](std::size_t cell, double radius, const double* const*) { radii[cell] = radius; };
    internal::for_radii_of(triangulation, how.threads, take);
    return radii;
  });
}

std::vector<double> circumcenters(const Triangulation& triangulation, const Execution& how) {
  return internal::guarded("the circumcenters", [&] {
    const internal::ProgressMeter meter(how.progress);
    const auto d = static_cast<std::size_t>(triangulation.dimension());
    std::vector<double> centers(triangulation.num_finite_cells() * d);
    const Complex complex = triangulation.complex();
    const std::vector<VertexId> vertices = complex.finite_vertices();
    if (vertices.empty()) return centers;
    if (triangulation.affine_dimension() == 0) {
      const auto p = triangulation.point(vertices.front());
      std::transform(p.begin(), p.end(), centers.begin(), [](double x) { return x + 0.0; });
      return centers;
    }
    const std::vector<int> axes = triangulation.axes();
    bool aligned = true;
    for (std::size_t j = 0; j < d; ++j) {
      if (std::binary_search(axes.begin(), axes.end(), static_cast<int>(j))) continue;
      for (const VertexId v : vertices)
        aligned = aligned && triangulation.point(v)[j] == triangulation.point(vertices.front())[j];
    }
    static_assert(solve::CenterFinder::block == internal::orthosphere_block);
    internal::for_blocks_of(triangulation, how.threads, [&] {
      return [&, finder = solve::CenterFinder(triangulation.dimension(), axes, aligned)](
                 std::size_t first, std::size_t count, const double* const* points) mutable {
        finder.find_block(count, points, nullptr, centers.data() + first * d);
      };
    });
    return centers;
  });
}

std::vector<double> qualities(const Triangulation& triangulation, QualityMeasure measure,
                              const Execution& how) {
  using namespace internal;
  return guarded("the qualities", [&] {
    const ProgressMeter meter(how.progress);
    std::vector<double> result(triangulation.num_finite_cells(), 1.0);
    const int k = triangulation.affine_dimension();
    if (k < 1) return result;
    const auto d = static_cast<std::size_t>(triangulation.dimension()),
               corners = static_cast<std::size_t>(k) + 1;
    if (measure == QualityMeasure::mean_ratio) {
      for_blocks_of(triangulation, how.threads, [&] {
        return [&](std::size_t first, std::size_t count, const double* const* points) {
          for (std::size_t i = 0; i < count; ++i)
            result[first + i] = mean_ratio(points + i * corners, corners, d);
        };
      });
      return result;
    }
    const auto take = [&](std::size_t cell, double radius, const double* const* points) {
      result[cell] = measure == QualityMeasure::radius_ratio ? radius_ratio(points, corners, d, radius)
                                                             : radius_edge_ratio(points, corners, d, radius);
    };
    for_radii_of(triangulation, how.threads, take);
    return result;
  });
}

}  // namespace delone
