// SPDX-License-Identifier: BSD-3-Clause
// Facets of cells are found by the neighbors of cells. Faces of lower dimension are spread over their lowest
// vertices; those of one vertex are few and close together in memory, and a small table tells which are
// equal.
#include "faces/face_level.hpp"

#include "base/large_vector.hpp"
#include "base/parallel_parts.hpp"
#include "base/quick_rounds.hpp"
#include "base/spread.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <cstdint>
#include <span>

namespace delone::internal {
namespace {

constexpr std::size_t vertices_in_part = 4096, rows_in_part = 1 << 16;

/// The level's faces that have each vertex as their first or second one.
struct FacesAtVertices {
  std::vector<Index> offsets, faces;

  FacesAtVertices(const FaceLevel& level, Index num_slots) {
    QuickRounds round;
    spread(num_slots, offsets, faces, [&](const auto& put) {
      for (std::size_t face = 0; face < level.size(); ++face) {
        round();
        for (std::size_t i = 0; i < 2; ++i)
          put(static_cast<std::size_t>(level.vertices[face * level.corners() + i]), static_cast<Index>(face));
      }
    });
  }
};

/// The faces whose lowest vertices are in one range.
struct Piece {
  std::vector<SignedIndex> vertices, cells;
  std::vector<unsigned char> on_hull;
};

/// Finds the facets of the faces of a level, of at least 3 vertices.
class FacetFinder {
 public:
  /// `facets`: for each face of the level the numbers of its facets in the piece.
  FacetFinder(const FaceLevel& level, const FacesAtVertices& at, Index* facets)
      : level_(level),
        at_(at),
        facets_(facets),
        corners_(level.corners()),
        edge_to_(corners_ == 3 ? at.offsets.size() : 0) {}

  void find(std::size_t first, std::size_t last, const StopPoint& stop, Piece& piece) {
    for (std::size_t v = first; v < last; ++v) {
      if (v % 64 == 0) stop();
      if (corners_ == 3)
        find_edges_at(static_cast<SignedIndex>(v), piece);
      else
        find_at(static_cast<SignedIndex>(v), piece);
    }
  }

 private:
  const SignedIndex* ids_of(std::size_t face) const { return level_.vertices.data() + face * corners_; }
  std::span<const Index> faces_at(SignedIndex v) const {
    const auto vertex = static_cast<std::size_t>(v);
    return std::span(at_.faces).subspan(at_.offsets[vertex], at_.offsets[vertex + 1] - at_.offsets[vertex]);
  }
  /// The facets with the lowest vertex v.
  void find_at(SignedIndex v, Piece& piece) {
    const std::size_t begin = piece.cells.size();
    std::size_t room = 0, slots = 4;
    for (const Index face : faces_at(v)) room += ids_of(face)[0] == v ? corners_ - 1 : 1;
    while (slots < 2 * room) slots *= 2;
    table_.assign(slots, invalid_index);
    for (const Index face : faces_at(v)) {
      const bool is_lowest = ids_of(face)[0] == v;
      for (std::size_t missing = is_lowest ? 1 : 0; missing < (is_lowest ? corners_ : 1); ++missing) {
        const std::size_t number = number_of(face, missing, begin, piece);
        facets_[static_cast<std::size_t>(face) * corners_ + missing] = static_cast<Index>(number);
        if (level_.on_hull[face] != 0) piece.on_hull[number] = 1;
      }
    }
  }
  std::size_t number_of(std::size_t face, std::size_t missing, std::size_t begin, Piece& piece) {
    const SignedIndex* const ids = ids_of(face);
    std::uint64_t hash = 0;
    for (std::size_t i = 0; i < corners_; ++i)
      if (i != missing) hash = (hash + static_cast<std::uint64_t>(ids[i]) + 1) * 0x9e3779b97f4a7c15u;
    const std::size_t mask = table_.size() - 1;
    std::size_t slot = (hash >> 32) & mask;
    for (; table_[slot] != invalid_index; slot = (slot + 1) & mask) {
      const std::size_t number = begin + table_[slot];
      const SignedIndex* known = piece.vertices.data() + number * (corners_ - 1);
      bool is_same = true;
      for (std::size_t i = 0; i < corners_; ++i)
        if (i != missing) is_same = is_same && *known++ == ids[i];
      if (is_same) return number;
    }
    const std::size_t number = piece.cells.size();
    table_[slot] = static_cast<Index>(number - begin);
    for (std::size_t i = 0; i < corners_; ++i)
      if (i != missing) piece.vertices.push_back(ids[i]);
    piece.cells.push_back(level_.cells[face]);
    piece.on_hull.push_back(0);
    return number;
  }
  /// The same for edges of triangles.
  void find_edges_at(SignedIndex v, Piece& piece) {
    const std::size_t begin = piece.cells.size();
    const auto number_of_edge = [&](SignedIndex to, std::size_t face) {
      Index& known = edge_to_[static_cast<std::size_t>(to)];
      if (known < begin || known >= piece.cells.size() || piece.vertices[2 * known + 1] != to) {
        known = static_cast<Index>(piece.cells.size());
        piece.vertices.push_back(v);
        piece.vertices.push_back(to);
        piece.cells.push_back(level_.cells[face]);
        piece.on_hull.push_back(0);
      }
      if (level_.on_hull[face] != 0) piece.on_hull[known] = 1;
      return known;
    };
    for (const std::size_t face : faces_at(v)) {
      const SignedIndex* const ids = ids_of(face);
      if (ids[0] == v) {
        facets_[face * 3 + 2] = number_of_edge(ids[1], face);
        facets_[face * 3 + 1] = number_of_edge(ids[2], face);
      } else {
        facets_[face * 3] = number_of_edge(ids[2], face);
      }
    }
  }

  const FaceLevel& level_;
  const FacesAtVertices& at_;
  Index* facets_;
  std::size_t corners_;
  std::vector<Index> table_;
  std::vector<Index> edge_to_;  // by the second vertex: the last edge that was found with it
};

/// `expected`: how many there will be; 0 if that is not known.
FaceLevel find_facets(FaceLevel& level, Index num_slots, unsigned threads, std::size_t expected) {
  const std::size_t corners = level.corners(), chosen = corners - 1;
  const FacesAtVertices at(level, num_slots);
  resize_large(level.facets, level.vertices.size());
  const std::size_t num_parts = (num_slots + vertices_in_part - 1) / vertices_in_part;
  // One thread leaves everything where it belongs; otherwise pieces are put together.
  const bool is_alone = threads_for_parts(threads, num_parts) == 1;
  std::vector<Piece> pieces(is_alone ? 1 : num_parts);
  if (is_alone && expected > 0) {
    reserve_large(pieces[0].vertices, expected * chosen);
    reserve_large(pieces[0].cells, expected);
    reserve_large(pieces[0].on_hull, expected);
  }
  work_in_parts(is_alone ? 1 : threads, num_slots, vertices_in_part, [&] {
    return [&, finder = FacetFinder(level, at, level.facets.data())](std::size_t first, std::size_t last,
                                                                     const StopPoint& stop) mutable {
      finder.find(first, last, stop, pieces[is_alone ? 0 : first / vertices_in_part]);
    };
  });
  std::vector<std::size_t> begin{0};
  for (const Piece& piece : pieces) begin.push_back(begin.back() + piece.cells.size());
  if (begin.back() > max_index) throw Error(Errc::too_many, "more faces than this build can number");
  FaceLevel result;
  result.dimension = level.dimension - 1;
  if (is_alone) {
    result.vertices = std::move(pieces[0].vertices);
    result.cells = std::move(pieces[0].cells);
    result.on_hull = std::move(pieces[0].on_hull);
    return result;
  }
  resize_large(result.vertices, begin.back() * chosen);
  resize_large(result.cells, begin.back());
  resize_large(result.on_hull, begin.back());
  for (std::size_t p = 0; p < pieces.size(); ++p) {
    cancellation_point();
    const auto to = static_cast<std::ptrdiff_t>(begin[p]);
    std::copy(pieces[p].vertices.begin(), pieces[p].vertices.end(),
              result.vertices.begin() + to * static_cast<std::ptrdiff_t>(chosen));
    std::copy(pieces[p].cells.begin(), pieces[p].cells.end(), result.cells.begin() + to);
    std::copy(pieces[p].on_hull.begin(), pieces[p].on_hull.end(), result.on_hull.begin() + to);
    pieces[p] = {};
  }
  for_parts(
      threads, level.size(), rows_in_part, [&](std::size_t first, std::size_t last, const StopPoint& stop) {
        stop();
        for (std::size_t face = first; face < last; ++face)
          for (std::size_t i = 0; i < corners; ++i) {
            const auto lowest = static_cast<std::size_t>(level.vertices[face * corners + (i == 0 ? 1 : 0)]);
            level.facets[face * corners + i] += static_cast<Index>(begin[lowest / vertices_in_part]);
          }
      });
  return result;
}

/// The vertices of edges, in the order of their ids.
FaceLevel vertices_of_edges(FaceLevel& edges, Index num_slots) {
  std::vector<Index> number(num_slots, invalid_index);
  for (const SignedIndex v : edges.vertices) number[static_cast<std::size_t>(v)] = 0;
  FaceLevel result;
  result.dimension = 0;
  for (std::size_t v = 0; v < number.size(); ++v) {
    if (number[v] == invalid_index) continue;
    number[v] = static_cast<Index>(result.vertices.size());
    result.vertices.push_back(static_cast<SignedIndex>(v));
  }
  result.cells.assign(result.vertices.size(), -1);
  result.on_hull.assign(result.vertices.size(), 0);
  resize_large(edges.facets, edges.vertices.size());
  QuickRounds round;
  for (std::size_t edge = 0; edge < edges.size(); ++edge) {
    round();
    for (std::size_t i = 0; i < 2; ++i) {
      const Index vertex = number[static_cast<std::size_t>(edges.vertices[2 * edge + i])];
      edges.facets[2 * edge + 1 - i] = vertex;
      if (result.cells[vertex] < 0) result.cells[vertex] = edges.cells[edge];
      if (edges.on_hull[edge] != 0) result.on_hull[vertex] = 1;
    }
  }
  return result;
}

/// A facet is named by the lower one of its two cells.
FaceLevel facets_of_cells(FaceLevel& cells) {
  const std::size_t corners = cells.corners(), count = cells.size();
  resize_large(cells.facets, cells.vertices.size());
  FaceLevel result;
  result.dimension = cells.dimension - 1;
  std::size_t hull_facets = 0;
  for (const Index neighbor : cells.neighbors) hull_facets += neighbor == invalid_index ? 1 : 0;
  const std::size_t total = (cells.vertices.size() + hull_facets) / 2;
  if (total > max_index) throw Error(Errc::too_many, "more faces than this build can number");
  resize_large(result.vertices, total * (corners - 1));
  resize_large(result.cells, total);
  resize_large(result.on_hull, total);
  Index number = 0;
  QuickRounds round;
  for (std::size_t cell = 0; cell < count; ++cell) {
    round();
    for (std::size_t i = 0; i < corners; ++i) {
      const Index across = cells.neighbors[cell * corners + i];
      Index& facet = cells.facets[cell * corners + i];
      if (across != invalid_index && across < cell) {
        std::size_t mirror = static_cast<std::size_t>(across) * corners;
        while (cells.neighbors[mirror] != cell) ++mirror;
        facet = cells.facets[mirror];
        continue;
      }
      SignedIndex* to = result.vertices.data() + static_cast<std::size_t>(number) * (corners - 1);
      for (std::size_t m = 0; m < corners; ++m)
        if (m != i) *to++ = cells.vertices[cell * corners + m];
      result.cells[number] = static_cast<SignedIndex>(cell);
      result.on_hull[number] = across == invalid_index ? 1 : 0;
      facet = number++;
    }
  }
  return result;
}

}  // namespace

FaceLevel level_of_cells(const Triangulation& triangulation) {
  const Complex complex = triangulation.complex();
  FaceLevel level;
  level.dimension = complex.affine_dimension();
  if (level.dimension > 63) throw Error(Errc::unsupported, "faces of cells with more than 64 vertices");
  const int k = level.dimension;
  if (k < 0) return level;
  std::vector<Index> number(complex.num_cell_slots(), invalid_index);
  Index count = 0;
  for (const CellId c : complex.finite_cells()) number[index(c)] = count++;
  const std::size_t corners = level.corners();
  resize_large(level.vertices, count * corners);
  resize_large(level.neighbors, count * corners);
  QuickRounds round;
  SignedIndex* ids = level.vertices.data();
  Index* neighbors = level.neighbors.data();
  for (const CellId c : complex.finite_cells()) {
    round();
    for (std::size_t i = 0; i < corners; ++i) {  // sorts by insertion
      const auto v = static_cast<SignedIndex>(index(complex.vertex(c, static_cast<int>(i))));
      const Index neighbor = number[index(complex.neighbor(c, static_cast<int>(i)))];
      std::size_t at = i;
      for (; at > 0 && ids[at - 1] > v; --at) {
        ids[at] = ids[at - 1];
        neighbors[at] = neighbors[at - 1];
      }
      ids[at] = v;
      neighbors[at] = neighbor;
    }
    ids += corners;
    neighbors += corners;
  }
  return level;
}

FaceLevel facets_of(FaceLevel& level, Index num_vertex_slots, unsigned threads, std::size_t expected) {
  if (!level.neighbors.empty()) return facets_of_cells(level);
  if (level.dimension == 1) return vertices_of_edges(level, num_vertex_slots);
  return find_facets(level, num_vertex_slots, threads, expected);
}

}  // namespace delone::internal
