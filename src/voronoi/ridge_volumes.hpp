// SPDX-License-Identifier: BSD-3-Clause
// Volumes of the ridges of a diagram, in which ridges share the volumes of their faces.
#pragma once

#include <delone/types.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::voronoi {

/// The two regions between which a ridge is.
inline std::array<std::size_t, 2> regions_of_ridge(std::span<const SignedIndex> ridge_points,
                                                   std::span<const SignedIndex> point_region,
                                                   std::size_t ridge) {
  const auto region = [&](std::size_t end) {
    return static_cast<std::size_t>(point_region[static_cast<std::size_t>(ridge_points[2 * ridge + end])]);
  };
  return {region(0), region(1)};
}

/// The arrays of a diagram of affine dimension k in R^d.
struct DiagramParts {
  std::size_t k, d;
  std::span<const double> sites;  ///< of the regions
  std::span<const double> vertices;
  std::span<const SignedIndex> cell_regions;               ///< k + 1 per finite cell
  std::span<const SignedIndex> cell_vertex;                ///< per finite cell
  const std::vector<std::vector<Index>>& cells_of_region;  ///< increasing
  std::span<const SignedIndex> ridge_points, point_region, ridge_vertices;
  std::span<const std::int64_t> ridge_offsets;
};

/// The (k−1)-volumes of the bounded ridges of wanted regions; NaN for others, for those where rounding errors
/// may be magnified, and for k < 4. The time is that of FaceVolumes for the cells of these regions; memory is
/// limited unless one region has very many cells.
std::vector<double> measure_ridges(const DiagramParts& diagram, const std::vector<unsigned char>& wanted);

}  // namespace delone::voronoi
