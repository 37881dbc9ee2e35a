// SPDX-License-Identifier: BSD-3-Clause
#include <delone/measures.hpp>

#include "base/guarded.hpp"
#include "base/parallel_parts.hpp"
#include "faces/cell_shape.hpp"
#include "faces/face_blocks.hpp"
#include "voronoi/cell_center.hpp"

#include <algorithm>
#include <cmath>

namespace delone {
namespace internal {
namespace {

constexpr std::size_t cells_in_part = 4096;

/// Calls work(first, count, points) for blocks of up to orthosphere_block cells, by number, with the points
/// of all. `make_work` makes one for each thread.
template <class MakeWork>
void for_blocks_of_cells(const Triangulation& triangulation, unsigned threads, const MakeWork& make_work) {
  const Complex complex = triangulation.complex();
  const VertexPoints& points = StoredPoints::of(triangulation);
  const auto corners = static_cast<std::size_t>(complex.affine_dimension() + 1);
  std::vector<CellId> cells;
  cells.reserve(complex.num_finite_cells());
  for (const CellId c : complex.finite_cells()) cells.push_back(c);
  work_in_parts(threads, cells.size(), cells_in_part, [&] {
    return [&, work = make_work(), of_block = std::vector<const double*>(orthosphere_block * corners)](
               std::size_t begin, std::size_t end, const StopPoint& stop) mutable {
      for (std::size_t first = begin; first < end; first += orthosphere_block) {
        stop();
        const std::size_t count = std::min(orthosphere_block, end - first);
        for (std::size_t i = 0; i < count; ++i)
          for (std::size_t m = 0; m < corners; ++m)
            of_block[i * corners + m] =
                points.point(index(complex.vertex(cells[first + i], static_cast<int>(m))));
        work(first, count, of_block.data());
      }
    };
  });
}

/// √square, or the exact one where the square is not normal.
double radius_of(double square, const double* const* points, std::size_t corners, std::size_t dimension) {
  if (square > 1e-290 && square <= std::numeric_limits<double>::max()) return std::sqrt(square);
  return ExactOrthosphere(points, corners, dimension, false).radius_above();
}

/// Makes work for for_blocks_of_cells() that calls take(cell, radius, points).
template <class Take>
auto radii_of_blocks(const Triangulation& triangulation, const Take& take) {
  return [&triangulation, &take, unit = unit_of(triangulation)] {
    const auto d = static_cast<std::size_t>(triangulation.dimension()),
               corners = static_cast<std::size_t>(triangulation.affine_dimension() + 1);
    return [&take, d, corners, spheres = Orthospheres(triangulation.dimension(), false, unit, corners)](
               std::size_t first, std::size_t count, const double* const* points) mutable {
      Orthospheres::Answer answers[orthosphere_block];
      spheres.find_block(count, points, Orthospheres::Want::square, answers);
      for (std::size_t i = 0; i < count; ++i)
        take(first + i, radius_of(answers[i].square, points + i * corners, corners, d), points + i * corners);
    };
  };
}

}  // namespace
}  // namespace internal

std::vector<double> circumradii(const Triangulation& triangulation, const FaceOptions& options) {
  return internal::guarded("the circumradii", [&] {
    const internal::ProgressMeter meter(options.progress);
    std::vector<double> radii(triangulation.num_finite_cells(), 0.0);
    if (triangulation.affine_dimension() < 1) return radii;
    const auto take = [&](std::size_t cell, double radius, const double* const*) { radii[cell] = radius; };
    internal::for_blocks_of_cells(triangulation, options.threads,
                                  internal::radii_of_blocks(triangulation, take));
    return radii;
  });
}

std::vector<double> circumcenters(const Triangulation& triangulation, const FaceOptions& options) {
  return internal::guarded("the circumcenters", [&] {
    const internal::ProgressMeter meter(options.progress);
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
    static_assert(internal::CenterFinder::block == internal::orthosphere_block);
    internal::for_blocks_of_cells(triangulation, options.threads, [&] {
      return [&, finder = internal::CenterFinder(triangulation.dimension(), axes, aligned)](
                 std::size_t first, std::size_t count, const double* const* points) mutable {
        finder.find_block(count, points, nullptr, centers.data() + first * d);
      };
    });
    return centers;
  });
}

std::vector<double> cell_qualities(const Triangulation& triangulation, QualityMeasure measure,
                                   const FaceOptions& options) {
  using namespace internal;
  return guarded("the qualities", [&] {
    const ProgressMeter meter(options.progress);
    std::vector<double> qualities(triangulation.num_finite_cells(), 1.0);
    const int k = triangulation.affine_dimension();
    if (k < 1) return qualities;
    const auto d = static_cast<std::size_t>(triangulation.dimension()),
               corners = static_cast<std::size_t>(k) + 1;
    if (measure == QualityMeasure::mean_ratio) {
      for_blocks_of_cells(triangulation, options.threads, [&] {
        return [&](std::size_t first, std::size_t count, const double* const* points) {
          for (std::size_t i = 0; i < count; ++i)
            qualities[first + i] = mean_ratio(points + i * corners, corners, d);
        };
      });
      return qualities;
    }
    const auto take = [&](std::size_t cell, double radius, const double* const* points) {
      qualities[cell] = measure == QualityMeasure::radius_ratio
                            ? std::min(1.0, k / (sum_of_inverse_heights(points, corners, d) * radius))
                            : radius / shortest_edge(points, corners, d);
    };
    for_blocks_of_cells(triangulation, options.threads, radii_of_blocks(triangulation, take));
    return qualities;
  });
}

}  // namespace delone
