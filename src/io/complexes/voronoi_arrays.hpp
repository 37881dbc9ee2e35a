// SPDX-License-Identifier: BSD-3-Clause
// The arrays of a Voronoi or power diagram in a file, by name: what write_voronoi writes and read_voronoi
// reads (docs/formats.md).
#pragma once

#include <delone/voronoi.hpp>

#include <algorithm>
#include <cstddef>
#include <initializer_list>

namespace delone::io {

/// Calls visit(name, items, shape) for every array; `weights` only if there are any. In json ridge_vertices
/// and region_vertices (under the name `regions`) are lists of lists, and there are no offsets.
template <class Data, class Visit>
void for_each_array(Data& data, Visit visit) {
  using Shape = std::initializer_list<std::size_t>;
  const auto d = static_cast<std::size_t>(data.dimension),
             k = static_cast<std::size_t>(std::max(data.affine_dimension, 0));
  visit("points", data.points, Shape{data.num_points(), d});
  if (!data.weights.empty()) visit("weights", data.weights, Shape{data.num_points()});
  visit("vertices", data.vertices, Shape{data.num_vertices(), d});
  visit("ridge_points", data.ridge_points, Shape{data.num_ridges(), 2});
  visit("ridge_vertices", data.ridge_vertices, Shape{data.ridge_vertices.size()});
  visit("ridge_offsets", data.ridge_offsets, Shape{data.ridge_offsets.size()});
  visit("region_vertices", data.region_vertices, Shape{data.region_vertices.size()});
  visit("region_offsets", data.region_offsets, Shape{data.region_offsets.size()});
  visit("point_region", data.point_region, Shape{data.num_points()});
  visit("ray_vertices", data.ray_vertices, Shape{data.num_rays()});
  visit("ray_directions", data.ray_directions, Shape{data.num_rays(), d});
  visit("ray_points", data.ray_points, Shape{data.num_rays(), k});
}

}  // namespace delone::io
