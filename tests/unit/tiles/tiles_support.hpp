// SPDX-License-Identifier: BSD-3-Clause
// Whole triangulations cut into finished tiles, as the tiles of a folder would be, whatever the tiles are: a
// cell belongs to the tile of its lexicographically smallest vertex.
#pragma once

#include "tiles/finished_tile.hpp"
#include "tiles/work_folder.hpp"

#include <delone/data.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace delone_test {

/// The point of a row, and its weight: what the order of vertices in a cell goes by.
inline std::vector<double> weighted_row(const delone::ComplexData& data, std::size_t row) {
  const auto d = static_cast<std::size_t>(data.dimension);
  const auto first = data.points.begin() + static_cast<std::ptrdiff_t>(row * d);
  std::vector<double> point(first, first + static_cast<std::ptrdiff_t>(d));
  if (!data.weights.empty()) point.push_back(data.weights[row]);
  return point;
}

/// `tile_of_row`: for each row, equal rows alike.
inline std::vector<delone::tiles::FinishedTile> cut_into_tiles(const delone::ComplexData& data,
                                                               std::span<const std::size_t> tile_of_row,
                                                               std::size_t num_tiles) {
  using delone::SignedIndex;
  using delone::tiles::FinishedTile;
  const auto d = static_cast<std::size_t>(data.dimension);
  const std::size_t corners = static_cast<std::size_t>(data.affine_dimension + 1), m = data.num_cells(),
                    n = data.num_points();
  std::vector<FinishedTile> tiles(num_tiles);
  std::vector<std::size_t> tile_of_cell(m), number_of_cell(m);
  for (std::size_t c = 0; c < m; ++c) {
    std::size_t least = static_cast<std::size_t>(data.cells[c * corners]);
    for (std::size_t i = 1; i < corners; ++i)
      if (const auto row = static_cast<std::size_t>(data.cells[c * corners + i]);
          weighted_row(data, row) < weighted_row(data, least))
        least = row;
    tile_of_cell[c] = tile_of_row[least];
    number_of_cell[c] = tiles[tile_of_cell[c]].data.num_cells();
    FinishedTile& tile = tiles[tile_of_cell[c]];
    tile.data.dimension = data.dimension;
    tile.data.affine_dimension = data.affine_dimension;
    tile.data.cells.resize(tile.data.cells.size() + corners);
  }
  for (std::size_t t = 0; t < num_tiles; ++t) {
    FinishedTile& tile = tiles[t];
    tile.data.dimension = data.dimension;
    tile.data.affine_dimension = data.affine_dimension;
    std::vector<std::int32_t> number_of_row(n, -1);
    bool has_vertex = false;
    for (std::size_t row = 0; row < n; ++row) {
      if (tile_of_row[row] != t) continue;
      const SignedIndex vertex = data.vertex_of_point[row];
      tile.data.own_rows.push_back(static_cast<std::int64_t>(row));
      tile.data.vertex_of_row.push_back(vertex);
      if (vertex < 0) {
        ++tile.num_hidden;
      } else if (static_cast<std::size_t>(vertex) != row) {
        ++tile.num_duplicates;
      } else {
        ++tile.num_vertices;
        const std::vector<double> point = weighted_row(data, row);
        tile.hash.add_vertex(delone::complex::point_tag(point.data(), data.dimension));
        if (data.weights.empty()) continue;
        tile.weighted_hash.add_vertex(delone::complex::point_tag(point.data(), data.dimension + 1));
        tile.least_weight = has_vertex ? std::min(tile.least_weight, point[d]) : point[d];
        tile.largest_weight = has_vertex ? std::max(tile.largest_weight, point[d]) : point[d];
        has_vertex = true;
      }
    }
    for (std::size_t c = 0; c < m; ++c) {
      if (tile_of_cell[c] != t) continue;
      delone::complex::PointTag sum, weighted_sum;
      for (std::size_t i = 0; i < corners; ++i) {
        const auto row = static_cast<std::size_t>(data.cells[c * corners + i]);
        const std::vector<double> point = weighted_row(data, row);
        if (number_of_row[row] < 0) {
          number_of_row[row] = static_cast<std::int32_t>(tile.data.rows.size());
          tile.data.rows.push_back(static_cast<std::int64_t>(row));
          tile.data.points.insert(tile.data.points.end(), point.begin(),
                                  point.begin() + static_cast<std::ptrdiff_t>(d));
          if (!data.weights.empty()) tile.data.weights.push_back(point[d]);
          if (tile_of_row[row] != t) ++tile.num_foreign;
        }
        tile.data.cells[number_of_cell[c] * corners + i] = number_of_row[row];
        sum += delone::complex::point_tag(point.data(), data.dimension);
        if (!data.weights.empty())
          weighted_sum += delone::complex::point_tag(point.data(), data.dimension + 1);
        const SignedIndex across = data.neighbors[c * corners + i];
        bool knows_facet = false;
        for (std::size_t j = 0; j < corners; ++j)
          knows_facet |= j != i && tile_of_row[static_cast<std::size_t>(data.cells[c * corners + j])] == t;
        if (across >= 0 && tile_of_cell[static_cast<std::size_t>(across)] == t) {
          tile.data.neighbors.push_back(
              static_cast<std::int32_t>(number_of_cell[static_cast<std::size_t>(across)]));
        } else if (across < 0 && knows_facet) {
          tile.data.neighbors.push_back(-1);
          ++tile.num_hull_facets;
        } else {
          tile.data.neighbors.push_back(
              static_cast<std::int32_t>(-2 - static_cast<std::ptrdiff_t>(tile.seams.size())));
          tile.seams.push_back({static_cast<std::int32_t>(number_of_cell[c]), static_cast<std::int32_t>(i)});
        }
      }
      tile.hash.add_cell(sum);
      if (!data.weights.empty()) tile.weighted_hash.add_cell(weighted_sum);
    }
  }
  return tiles;
}

/// Tiles by a hash of the coordinates: as scattered as can be.
inline std::vector<std::size_t> scattered_tiles(const delone::ComplexData& data, std::size_t num_tiles) {
  std::vector<std::size_t> tiles;
  for (std::size_t row = 0; row < data.num_points(); ++row)
    tiles.push_back(delone::complex::point_tag(
                        data.points.data() + row * static_cast<std::size_t>(data.dimension), data.dimension)
                        .high %
                    num_tiles);
  return tiles;
}

inline delone::tiles::Plan plan_of(const delone::ComplexData& data, std::size_t num_tiles) {
  return {data.dimension,
          data.affine_dimension,
          !data.weights.empty(),
          {},
          0,
          static_cast<std::int64_t>(data.num_points()),
          num_tiles,
          "a test"};
}

/// Makes a finished folder of the whole.
inline delone::TilesIndex write_folder(const std::string& folder, const delone::ComplexData& data,
                                       std::size_t num_tiles, std::uint64_t memory = std::uint64_t{1} << 24) {
  delone::tiles::WorkFolder work(folder, plan_of(data, num_tiles), false);
  const auto tiles = cut_into_tiles(data, scattered_tiles(data, num_tiles), num_tiles);
  for (std::size_t t = 0; t < num_tiles; ++t) work.finish(t, tiles[t]);
  return work.finish_all(memory);
}

/// All parts of a folder as one triangulation; without the coordinates of rows that are no vertices.
inline delone::ComplexData glue(const std::string& folder) {
  const delone::TilesIndex index = delone::read_tiles_index(folder);
  delone::ComplexData whole;
  whole.dimension = index.dimension;
  whole.affine_dimension = index.affine_dimension;
  const auto d = static_cast<std::size_t>(index.dimension), n = static_cast<std::size_t>(index.num_points);
  whole.points.assign(n * d, 0);
  whole.vertex_of_point.assign(n, -2);
  if (index.weighted) whole.weights.assign(n, 0);
  for (std::size_t t = 0; t < index.parts.size(); ++t) {
    const delone::TileData part = delone::read_tile(folder, t);
    for (std::size_t v = 0; v < part.rows.size(); ++v) {
      std::copy_n(
          part.points.begin() + static_cast<std::ptrdiff_t>(v * d), d,
          whole.points.begin() + static_cast<std::ptrdiff_t>(part.rows[v]) * static_cast<std::ptrdiff_t>(d));
      if (index.weighted) whole.weights[static_cast<std::size_t>(part.rows[v])] = part.weights[v];
    }
    for (const std::int32_t v : part.cells)
      whole.cells.push_back(static_cast<delone::SignedIndex>(part.rows[static_cast<std::size_t>(v)]));
    for (const std::int32_t neighbor : part.neighbors)
      whole.neighbors.push_back(static_cast<delone::SignedIndex>(
          neighbor >= 0    ? index.parts[t].first_cell + neighbor
          : neighbor == -1 ? -1
                           : part.seams[static_cast<std::size_t>(-2 - neighbor)]));
    for (std::size_t i = 0; i < part.own_rows.size(); ++i)
      whole.vertex_of_point[static_cast<std::size_t>(part.own_rows[i])] =
          static_cast<delone::SignedIndex>(part.vertex_of_row[i]);
  }
  return whole;
}

}  // namespace delone_test
