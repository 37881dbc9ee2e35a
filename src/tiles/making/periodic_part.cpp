// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/making/periodic_part.hpp"

#include "base/progress_meter.hpp"
#include "base/quick_rounds.hpp"
#include "periodic/periodic_hash.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace delone::tiles {

namespace {

/// Point i as numbers of the set, its weight included.
void copy_inner_point(const periodic::PeriodicSet& set, const TileData& part, std::size_t i, double* x) {
  for (std::size_t j = 0; j < set.dimension; ++j) {
    x[j] = set.inner(part.points[i * set.dimension + j]);
    if (set.unit > 0) x[j] = std::nearbyint(x[j]);
  }
  if (set.weighted) x[set.dimension] = set.inner_weight(part.weights[i]);
}

}  // namespace

void finish_periodic_part(const periodic::PeriodicSet& set, int grid, FinishedTile& tile) {
  TileData& part = tile.data;
  for (double& x : part.points) x = set.outer(x);
  for (double& weight : part.weights) weight = set.outer_weight(weight);
  tile.least_weight = set.outer_weight(tile.least_weight);
  tile.largest_weight = set.outer_weight(tile.largest_weight);
  internal::QuickRounds round;
  std::vector<std::int64_t> offset(set.rank);
  for (std::size_t at = 0; at < part.cell_offsets.size(); at += set.rank) {
    round();
    std::copy_n(part.cell_offsets.begin() + static_cast<std::ptrdiff_t>(at), set.rank, offset.begin());
    set.to_given_basis(offset, &part.cell_offsets[at]);
  }
  tile.hash = hash_of_part(set, grid, part, tile.num_vertices, false);
  if (set.weighted) tile.weighted_hash = hash_of_part(set, grid, part, tile.num_vertices, true);
}

complex::HashAccumulator hash_of_part(const periodic::PeriodicSet& set, int grid, const TileData& part,
                                      std::int64_t num_vertices, bool with_weights) {
  complex::HashAccumulator hash;
  periodic::PeriodicTags tagger(set, grid);
  const std::size_t d = set.dimension, r = set.rank, v = part.num_points(),
                    corners = static_cast<std::size_t>(part.affine_dimension + 1);
  internal::QuickRounds round;
  std::vector<double> x(set.row_size());
  std::vector<complex::PointTag> tags(v);
  std::vector<std::uint64_t> units(v * d);
  for (std::size_t i = 0; i < v; ++i) {
    round();
    copy_inner_point(set, part, i, x.data());
    for (std::size_t j = 0; j < d; ++j) units[i * d + j] = tagger.units(x[j]);
    if (static_cast<std::int64_t>(i) >= num_vertices) continue;
    tags[i] = tagger.of_vertex(x.data(), with_weights);
    hash.add_vertex(tags[i]);
  }
  std::vector<std::uint64_t> lattice, from(d), difference(d);
  for (const double one : set.lattice) lattice.push_back(tagger.units(one));
  // The smallest vertex of a cell is of the tile and has offset 0. It is compared with others of that kind.
  for (std::size_t cell = 0; cell < part.num_cells(); ++cell) {
    round();
    const auto point = [&](std::size_t i) {
      return static_cast<std::size_t>(part.cells[cell * corners + i]);
    };
    const auto is_candidate = [&](std::size_t i) {
      const auto first = part.cell_offsets.begin() + static_cast<std::ptrdiff_t>((cell * corners + i) * r);
      return static_cast<std::int64_t>(point(i)) < num_vertices &&
             std::all_of(first, first + static_cast<std::ptrdiff_t>(r), [](auto k) { return k == 0; });
    };
    std::size_t smallest = corners;
    for (std::size_t i = 0; i < corners; ++i) {
      if (!is_candidate(i)) continue;
      const auto coordinates = [&](std::size_t one) {
        return part.points.begin() + static_cast<std::ptrdiff_t>(point(one) * d);
      };
      if (smallest == corners ||
          std::lexicographical_compare(coordinates(i), coordinates(i) + static_cast<std::ptrdiff_t>(d),
                                       coordinates(smallest),
                                       coordinates(smallest) + static_cast<std::ptrdiff_t>(d)))
        smallest = i;
    }
    if (smallest == corners) continue;
    complex::PointTag sum = tags[point(smallest)];
    for (std::size_t i = 0; i < corners; ++i) {
      for (std::size_t j = 0; j < d; ++j) {
        // Modulo 2^64, as multiples of vectors may be large where their sum is small.
        difference[j] = units[point(i) * d + j] - units[point(smallest) * d + j];
        for (std::size_t l = 0; l < r; ++l)
          difference[j] +=
              static_cast<std::uint64_t>(std::int64_t{part.cell_offsets[(cell * corners + i) * r + l]}) *
              lattice[l * d + j];
      }
      sum += tagger.of_difference(difference);
    }
    hash.add_cell(sum);
  }
  return hash;
}

complex::HashAccumulator lattice_hash(const periodic::PeriodicSet& set, int grid) {
  complex::HashAccumulator hash;
  hash.add_vertex(periodic::PeriodicTags(set, grid).of_lattice());
  return hash;
}

int finest_bit_of_part(const periodic::PeriodicSet& set, const TileData& part, std::int64_t num_vertices) {
  int finest = periodic::no_grid;
  std::vector<double> x(set.row_size());
  for (std::size_t i = 0; i < static_cast<std::size_t>(num_vertices); ++i) {
    copy_inner_point(set, part, i, x.data());
    finest = std::min(finest, periodic::finest_bit(x.data(), set.dimension));
  }
  return finest;
}

}  // namespace delone::tiles
