// SPDX-License-Identifier: BSD-3-Clause
// Facets of cells are found by the neighbors of cells. Faces of lower dimension are spread over their lowest
// vertices; those of one vertex are few and close together in memory, and a small table tells equal ones.
#include "faces/face_level.hpp"

#include "base/large_vector.hpp"
#include "base/parallel_parts.hpp"
#include "base/quick_rounds.hpp"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace delone::internal {
namespace {

constexpr std::size_t vertices_in_part = 4096, faces_in_part = 1 << 16;

/// The choices of j+1 of the vertices 0 … J that begin with one vertex: the others, and all as bits.
struct Subset {
  std::vector<unsigned char> rest;
  std::uint64_t bits;
};
std::vector<std::vector<Subset>> subsets_by_first(std::size_t size, std::size_t chosen) {
  std::vector<std::vector<Subset>> result(size - chosen + 1);
  std::vector<unsigned char> choice(chosen);
  std::iota(choice.begin(), choice.end(), static_cast<unsigned char>(0));
  for (;;) {
    std::uint64_t bits = 0;
    for (const unsigned char i : choice) bits |= std::uint64_t{1} << i;
    result[choice[0]].push_back({{choice.begin() + 1, choice.end()}, bits});
    std::size_t i = chosen;
    while (i > 0 && choice[i - 1] == size - chosen + (i - 1)) --i;
    if (i == 0) return result;
    ++choice[i - 1];
    for (; i < chosen; ++i) choice[i] = static_cast<unsigned char>(choice[i - 1] + 1);
  }
}

/// The level's faces that have each vertex as one of their first `first_corners`.
struct FacesAtVertices {
  std::vector<std::size_t> offsets;
  std::vector<Index> faces;

  FacesAtVertices(const FaceLevel& level, std::size_t first_corners, Index num_slots)
      : offsets(static_cast<std::size_t>(num_slots) + 2, 0), faces() {
    resize_large(faces, level.size() * first_corners);
    const std::size_t corners = level.corners(), count = level.size();
    QuickRounds round;
    for (std::size_t face = 0; face < count; ++face) {
      round();
      for (std::size_t i = 0; i < first_corners; ++i)
        ++offsets[static_cast<std::size_t>(level.vertices[face * corners + i]) + 2];
    }
    std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
    for (std::size_t face = 0; face < count; ++face) {
      round();
      for (std::size_t i = 0; i < first_corners; ++i)
        faces[offsets[static_cast<std::size_t>(level.vertices[face * corners + i]) + 1]++] =
            static_cast<Index>(face);
    }
    offsets.pop_back();
  }
};

/// The faces whose lowest vertices are in one range.
struct Piece {
  std::vector<SignedIndex> vertices, cells;
  std::vector<unsigned char> on_hull;
};

class FaceFinder {
 public:
  /// `facets`: for each face of the level and its facets their numbers in the piece, or null.
  FaceFinder(const FaceLevel& level, int j, const FacesAtVertices& at, Index* facets)
      : level_(level),
        at_(at),
        facets_(facets),
        size_(static_cast<std::size_t>(j) + 1),
        subsets_(subsets_by_first(level.corners(), size_)),
        edge_to_(facets != nullptr && j == 1 ? at.offsets.size() : 0) {}

  void find(std::size_t first, std::size_t last, const StopPoint& stop, Piece& piece) {
    for (std::size_t v = first; v < last; ++v) {
      if (v % 64 == 0) stop();
      if (facets_ != nullptr && size_ == 2 && level_.corners() == 3)
        find_edges_at(v, piece);
      else
        find_at(v, piece);
    }
  }

 private:
  void find_at(std::size_t v, Piece& piece) {
    const std::size_t corners = level_.corners(), begin = piece.cells.size();
    const std::size_t first = at_.offsets[v], last = at_.offsets[v + 1];
    std::size_t room = 0;
    for (std::size_t e = first; e < last; ++e) room += subsets_[place_of(at_.faces[e], v)].size();
    std::size_t slots = 4;
    while (slots < 2 * room) slots *= 2;
    table_.assign(slots, invalid_index);
    for (std::size_t e = first; e < last; ++e) {
      const std::size_t face = at_.faces[e];
      const SignedIndex* const ids = level_.vertices.data() + face * corners;
      const std::uint64_t hull = hull_bits(face);
      for (const Subset& subset : subsets_[place_of(face, v)]) {
        const std::size_t number = number_of(ids, subset, begin, face, piece);
        if ((hull & ~subset.bits) != 0) piece.on_hull[number] = 1;
        if (facets_ == nullptr) continue;
        std::size_t missing = 0;
        while ((subset.bits >> missing & 1) != 0) ++missing;
        facets_[face * corners + missing] = static_cast<Index>(number);
      }
    }
  }
  /// The same for edges of triangles.
  void find_edges_at(std::size_t v, Piece& piece) {
    const std::size_t begin = piece.cells.size();
    const auto number_of_edge = [&](SignedIndex to, std::size_t face) {
      Index& known = edge_to_[static_cast<std::size_t>(to)];
      if (known < begin || known >= piece.cells.size() || piece.vertices[2 * known + 1] != to) {
        known = static_cast<Index>(piece.cells.size());
        piece.vertices.push_back(static_cast<SignedIndex>(v));
        piece.vertices.push_back(to);
        piece.cells.push_back(level_.cells.empty() ? static_cast<SignedIndex>(face) : level_.cells[face]);
        piece.on_hull.push_back(0);
      }
      if (hull_bits(face) != 0) piece.on_hull[known] = 1;
      return known;
    };
    for (std::size_t e = at_.offsets[v]; e < at_.offsets[v + 1]; ++e) {
      const std::size_t face = at_.faces[e];
      const SignedIndex* const ids = level_.vertices.data() + face * 3;
      if (ids[0] == static_cast<SignedIndex>(v)) {
        facets_[face * 3 + 2] = number_of_edge(ids[1], face);
        facets_[face * 3 + 1] = number_of_edge(ids[2], face);
      } else {
        facets_[face * 3] = number_of_edge(ids[2], face);
      }
    }
  }
  std::size_t place_of(std::size_t face, std::size_t v) const {
    const SignedIndex* const ids = level_.vertices.data() + face * level_.corners();
    std::size_t place = 0;
    while (ids[place] != static_cast<SignedIndex>(v)) ++place;
    return place;
  }
  /// Bit i: there is a hull facet that has all vertices of the face but perhaps vertex i.
  std::uint64_t hull_bits(std::size_t face) const {
    if (level_.neighbors.empty()) return level_.on_hull.empty() || level_.on_hull[face] == 0 ? 0 : ~0ull;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < level_.corners(); ++i)
      if (level_.neighbors[face * level_.corners() + i] == invalid_index) bits |= std::uint64_t{1} << i;
    return bits;
  }
  std::size_t number_of(const SignedIndex* ids, const Subset& subset, std::size_t begin, std::size_t face,
                        Piece& piece) {
    std::uint64_t hash = 0;
    for (const unsigned char i : subset.rest)
      hash = (hash + static_cast<std::uint64_t>(ids[i]) + 1) * 0x9e3779b97f4a7c15u;
    const std::size_t mask = table_.size() - 1;
    std::size_t slot = (hash >> 32) & mask;
    for (; table_[slot] != invalid_index; slot = (slot + 1) & mask) {
      const std::size_t number = begin + table_[slot];
      const SignedIndex* const known = piece.vertices.data() + number * size_ + 1;
      bool is_same = true;
      for (std::size_t i = 0; i + 1 < size_; ++i) is_same = is_same && known[i] == ids[subset.rest[i]];
      if (is_same) return number;
    }
    const std::size_t number = piece.cells.size();
    table_[slot] = static_cast<Index>(number - begin);
    std::size_t lowest = 0;
    while ((subset.bits >> lowest & 1) == 0) ++lowest;
    piece.vertices.push_back(ids[lowest]);
    for (const unsigned char i : subset.rest) piece.vertices.push_back(ids[i]);
    piece.cells.push_back(level_.cells.empty() ? static_cast<SignedIndex>(face) : level_.cells[face]);
    piece.on_hull.push_back(0);
    return number;
  }

  const FaceLevel& level_;
  const FacesAtVertices& at_;
  Index* facets_;
  std::size_t size_;
  std::vector<std::vector<Subset>> subsets_;
  std::vector<Index> table_;
  std::vector<Index> edge_to_;  // by the second vertex: the last edge that was found with it
};

/// `expected`: how many there will be; 0 if that is not known.
FaceLevel find_faces(const FaceLevel& level, int j, Index num_slots, unsigned threads, std::size_t expected,
                     std::vector<Index>* facets) {
  const std::size_t corners = level.corners(), chosen = static_cast<std::size_t>(j) + 1;
  const FacesAtVertices at(level, corners - chosen + 1, num_slots);
  if (facets != nullptr) resize_large(*facets, level.vertices.size());
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
    return [&, finder = FaceFinder(level, j, at, facets == nullptr ? nullptr : facets->data())](
               std::size_t first, std::size_t last, const StopPoint& stop) mutable {
      finder.find(first, last, stop, pieces[is_alone ? 0 : first / vertices_in_part]);
    };
  });
  std::vector<std::size_t> begin{0};
  for (const Piece& piece : pieces) begin.push_back(begin.back() + piece.cells.size());
  if (begin.back() > max_index) throw Error(Errc::too_many, "more faces than this build can number");
  FaceLevel result;
  result.dimension = j;
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
  if (facets == nullptr) return result;
  for_parts(
      threads, level.size(), faces_in_part, [&](std::size_t first, std::size_t last, const StopPoint& stop) {
        stop();
        for (std::size_t face = first; face < last; ++face)
          for (std::size_t i = 0; i < corners; ++i) {
            const auto lowest = static_cast<std::size_t>(level.vertices[face * corners + (i == 0 ? 1 : 0)]);
            (*facets)[face * corners + i] += static_cast<Index>(begin[lowest / vertices_in_part]);
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
      if (result.cells[vertex] < 0)
        result.cells[vertex] = edges.cells.empty() ? static_cast<SignedIndex>(edge) : edges.cells[edge];
      if (!edges.on_hull.empty() && edges.on_hull[edge] != 0) result.on_hull[vertex] = 1;
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
  return find_faces(level, level.dimension - 1, num_vertex_slots, threads, expected, &level.facets);
}

FaceLevel faces_of(const FaceLevel& level, int j, Index num_vertex_slots, unsigned threads) {
  return find_faces(level, j, num_vertex_slots, threads, 0, nullptr);
}

}  // namespace delone::internal
