// SPDX-License-Identifier: BSD-3-Clause
// What is beyond a facet: of all vertices there, the one whose sphere through the facet comes first. Every
// vertex is examined in binary32, many per instruction, and the few that remain in binary64. Results are not
// proved here but by engine/wrap/proof.hpp.
#pragma once

#include "geometry/facet_search/tile_search.hpp"
#include "geometry/simplex_kernel.hpp"

#include <delone/types.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <vector>

namespace delone::geometry {

/// Of the given vertices, the one that is strictly beyond facet `slot` of a finite cell and whose sphere
/// through the facet comes first, or infinite_vertex if none is beyond; nothing on a tie. Exact.
using Arbiter =
    std::function<std::optional<Index>(const Index* cell, int slot, std::span<const Index> vertices)>;

class FacetSearch {
 public:
  static constexpr std::size_t batch_size = simplex_lanes;

  /// `rows`: the images and lifts of the vertices 1 … num_vertices, k + 1 doubles each, those of vertex 0
  /// unused; they must outlive this object. The arbiter decides where rounded numbers leave several vertices.
  /// REQUIRES 2 ≤ k < 32.
  FacetSearch(int k, const double* rows, Index num_vertices, Arbiter arbiter);

  /// The vertices of a cell of the Delaunay triangulation, up to rounding errors. Returns false if the images
  /// seem to be flat. Cost O(n·k²).
  bool first_cell(Index* vertices) const;

  /// For up to batch_size finite cells, k + 1 apexes each: the vertex across every open facet, or
  /// infinite_vertex if there is none; other entries are not written. `limit` counts the vertices that the
  /// arbiter has to compare. Returns false on a tie, and where the limit is exceeded. Cost O(k³ + n·k·facets)
  /// per cell.
  bool find_apexes(std::span<const cells::OpenCell> cells, Index* apexes, cells::ComparisonLimit& limit);

 private:
  /// Bounds on the magnitudes of a cell's functions in the frame's box.
  struct Scale {
    double height;
    double spread;  ///< of all slots together
    std::array<double, 32> slots;
  };
  /// A vertex that may be the apex, and bounds on its ratio.
  struct Candidate {
    Index vertex;
    double low, high;
  };
  /// The apex by binary64 or the arbiter.
  std::optional<Index> settle(const SearchTask& task, const SoughtFacet& facet, double* functions,
                              const Scale& scale, cells::ComparisonLimit& limit);

  int k_;
  const double* rows_;
  Index num_vertices_;
  std::size_t num_blocks_;
  double largest_lift_ = 0;
  std::vector<float> images_;        // and lifts of the vertices
  std::vector<float> heights_;       // of a tile
  std::vector<float> functions_;     // of a batch
  std::vector<SoughtFacet> facets_;  // of a batch
  std::vector<double> scratch_;      // of simplices
  std::vector<std::uint32_t> list_;
  std::vector<Candidate> candidates_;
  std::vector<Index> contenders_;  // for the arbiter
  Arbiter arbiter_;
};

}  // namespace delone::geometry
