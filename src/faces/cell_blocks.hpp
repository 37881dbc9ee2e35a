// SPDX-License-Identifier: BSD-3-Clause
// Cells in blocks and by several threads, and the radii of their circumscribed spheres.
#pragma once

#include "base/parallel_parts.hpp"
#include "faces/exact_orthosphere.hpp"
#include "faces/orthosphere.hpp"
#include "faces/orthosphere_kernel.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <utility>
#include <vector>

namespace delone::internal {

inline constexpr std::size_t cells_in_part = 4096;

/// Calls work(first, count, points) for blocks of up to orthosphere_block cells out of `size`, by number,
/// with the points of all: corner_of(cell, i) gives those. `make_work` makes one for each thread.
template <class CornerOf, class MakeWork>
void for_blocks_of_cells(std::size_t size, std::size_t corners, unsigned threads, const CornerOf& corner_of,
                         const MakeWork& make_work) {
  work_in_parts(threads, size, cells_in_part, [&] {
    return [&, work = make_work(), of_block = std::vector<const double*>(orthosphere_block * corners)](
               std::size_t begin, std::size_t end, const StopPoint& stop) mutable {
      for (std::size_t first = begin; first < end; first += orthosphere_block) {
        stop();
        const std::size_t count = std::min(orthosphere_block, end - first);
        for (std::size_t i = 0; i < count; ++i)
          for (std::size_t m = 0; m < corners; ++m) of_block[i * corners + m] = corner_of(first + i, m);
        work(first, count, of_block.data());
      }
    };
  });
}

/// √square, or the exact one where the square is not normal. NaN for affinely dependent vertices.
inline double radius_of(double square, const double* const* points, std::size_t corners,
                        std::size_t dimension) {
  if (square > 1e-290 && square <= std::numeric_limits<double>::max()) return std::sqrt(square);
  return ExactOrthosphere(points, corners, dimension, false).radius_above();
}

/// Makes work for for_blocks_of_cells() that calls take(cell, radius, points). `unit`: of Orthospheres.
template <class Take>
auto radii_of_blocks(int dimension, std::size_t corners, int unit, const Take& take) {
  return [dimension, corners, unit, &take] {
    Orthospheres finder(dimension, false, unit, corners);
    finder.let_nearest_be_enough();  // the root of a rounded square is off by at most 2⁻⁵²
    return [&take, dimension, corners, spheres = std::move(finder)](std::size_t first, std::size_t count,
                                                                    const double* const* points) mutable {
      Orthospheres::Answer answers[orthosphere_block];
      spheres.find_block(count, points, Orthospheres::Want::square, answers);
      for (std::size_t i = 0; i < count; ++i) {
        const double* const* const of_cell = points + i * corners;
        take(first + i, radius_of(answers[i].square, of_cell, corners, static_cast<std::size_t>(dimension)),
             of_cell);
      }
    };
  };
}

}  // namespace delone::internal
