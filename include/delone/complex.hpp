// SPDX-License-Identifier: BSD-3-Clause
// The read-only complex: cells, neighbors, vertices, stars and faces of a triangulated sphere.
#pragma once

#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <vector>

namespace delone {

struct ComplexData;

/// A read-only view of a simplicial complex that triangulates the sphere S^k: the finite cells of a
/// triangulation of affine dimension k, and one infinite cell per hull facet, which joins the facet to the
/// infinite vertex. Topology only: no coordinates. Cheap to copy; valid until its owner changes or dies.
///
/// Cells live in slots; a slot may be vacant after an insertion. The ranges skip vacant slots.
class Complex {
 public:
  /// Which cells a range visits.
  enum class Which { all, finite, infinite };

  class CellIterator {
   public:
    using value_type = CellId;
    using difference_type = std::ptrdiff_t;
    using iterator_category = std::forward_iterator_tag;
    CellIterator() = default;
    CellIterator(const Complex* complex, Index slot, Which which)
        : complex_(complex), slot_(slot), which_(which) {
      skip();
    }
    CellId operator*() const { return CellId{slot_}; }
    CellIterator& operator++() {
      ++slot_;
      skip();
      return *this;
    }
    CellIterator operator++(int) {
      auto old = *this;
      ++*this;
      return old;
    }
    friend bool operator==(const CellIterator& a, const CellIterator& b) { return a.slot_ == b.slot_; }

   private:
    void skip() {
      while (slot_ < complex_->num_slots_ && !complex_->is_in(CellId{slot_}, which_)) ++slot_;
    }
    const Complex* complex_ = nullptr;
    Index slot_ = 0;
    Which which_ = Which::all;
  };

  class CellRange;

  /// For each slot, k+1 vertices and then k+1 neighbors. A vacant slot has invalid_index, or its lower 16
  /// bits, as its first vertex.
  struct Links {
    const Index* first;
    std::size_t stride;    ///< from one slot to the next, in ids
    bool narrow_vertices;  ///< whether vertices take 16 bits each; neighbors begin at the next whole id
  };

  Complex() = default;
  /// `cell_of_vertex`: by vertex id, `num_vertex_slots` entries, num_finite_vertices + 1 if that is 0;
  /// invalid_cell where there is no vertex.
  Complex(const Links& links, int dimension, Index num_slots, Index num_finite_cells,
          Index num_infinite_cells, Index num_finite_vertices, const CellId* cell_of_vertex,
          Index num_vertex_slots = 0)
      : links_(links),
        dimension_(dimension),
        num_slots_(num_slots),
        num_finite_cells_(num_finite_cells),
        num_infinite_cells_(num_infinite_cells),
        num_finite_vertices_(num_finite_vertices),
        num_vertex_slots_(num_vertex_slots > 0 ? num_vertex_slots : num_finite_vertices + 1),
        cell_of_vertex_(cell_of_vertex) {}

  /// k, the dimension of the cells; −1 for the complex of no points.
  int dimension() const { return dimension_; }
  /// Finite vertices. Their ids are 1 … num_vertices(), unless points are hidden: these leave gaps among the
  /// ids.
  Index num_vertices() const { return num_finite_vertices_; }
  Index num_vertex_slots() const { return num_vertex_slots_; }  ///< size for payload arrays indexed by vertex
  Index num_finite_cells() const { return num_finite_cells_; }
  Index num_infinite_cells() const { return num_infinite_cells_; }  ///< = number of hull facets
  Index num_cells() const { return num_finite_cells_ + num_infinite_cells_; }
  Index num_cell_slots() const { return num_slots_; }  ///< size for payload arrays indexed by cell

  bool is_cell(CellId c) const { return delone::index(c) < num_slots_ && !is_vacant(c); }
  bool is_vertex(VertexId v) const {
    return delone::index(v) < num_vertex_slots_ && incident_cell(v) != invalid_cell;
  }
  bool is_infinite(CellId c) const { return infinite_index(c) >= 0; }
  bool is_infinite(VertexId v) const { return v == infinite_vertex; }

  CellRange cells() const;
  CellRange finite_cells() const;
  CellRange infinite_cells() const;
  /// The finite vertices in increasing id. O(slots).
  std::vector<VertexId> finite_vertices() const;

  /// Vertex i of cell c, 0 ≤ i ≤ k. Cells are coherently oriented: replacing one vertex of a cell by another
  /// point on the same side of the opposite facet keeps the orientation.
  VertexId vertex(CellId c, int i) const { return VertexId{vertex_id(c, i)}; }
  /// The cell across the facet opposite vertex i.
  CellId neighbor(CellId c, int i) const { return CellId{neighbor_ids(c)[i]}; }
  /// All k+1 vertices / neighbors of a cell, by value. O(k).
  std::vector<VertexId> vertices(CellId c) const;
  std::vector<CellId> neighbors(CellId c) const;
  /// The index, in neighbor i of c, of the vertex opposite the shared facet. O(k).
  int mirror_index(CellId c, int i) const {
    // Two cells of a simplicial sphere share at most one facet, so the neighbor that is c is found once.
    const Index* const neighbors = neighbor_ids(neighbor(c, i));
    int j = 0;
    while (j < dimension_ && neighbors[j] != delone::index(c)) ++j;
    return j;
  }
  /// The index of vertex v in cell c, or −1. O(k).
  int index_of(CellId c, VertexId v) const {
    for (int i = 0; i <= dimension_; ++i)
      if (vertex_id(c, i) == delone::index(v)) return i;
    return -1;
  }
  /// The index of the infinite vertex in c, or −1 if c is finite. O(k).
  int infinite_index(CellId c) const { return index_of(c, infinite_vertex); }

  /// A cell that contains v (any vertex, the infinite one included). O(1).
  CellId incident_cell(VertexId v) const { return cell_of_vertex_[delone::index(v)]; }
  /// All cells that contain v, finite and infinite. O(size of the star · k).
  std::vector<CellId> star(VertexId v) const;
  /// The facets of the star of v that do not contain v, as (cell of the star, index of v). O(size of the star
  /// · k).
  std::vector<Facet> link(VertexId v) const;
  /// The vertices joined to v by an edge, the infinite vertex excluded, in increasing id. O(size of the star
  /// · k log).
  std::vector<VertexId> adjacent_vertices(VertexId v) const;

  /// Every facet between two cells once. Facets of infinite cells included when `with_infinite`. O(cells ·
  /// k).
  std::vector<Facet> facets(bool with_infinite = false) const;
  /// The hull facets, as (finite cell, index of the vertex opposite the hull facet). O(cells).
  std::vector<Facet> hull_facets() const;
  /// All finite faces of dimension j, 0 ≤ j ≤ k, as rows of j+1 increasing vertex ids, sorted. O(cells ·
  /// C(k+1,j+1)) memory.
  std::vector<VertexId> faces(int j) const;
  /// All finite edges as pairs of increasing ids, sorted: faces(1).
  std::vector<VertexId> edges() const { return faces(1); }

 private:
  friend class CellIterator;
  const Index* row(CellId c) const {
    return links_.first + static_cast<std::size_t>(delone::index(c)) * links_.stride;
  }
  Index vertex_id(CellId c, int i) const {
    return links_.narrow_vertices ? Index{reinterpret_cast<const std::uint16_t*>(row(c))[i]} : row(c)[i];
  }
  const Index* neighbor_ids(CellId c) const {
    return row(c) + (links_.narrow_vertices ? (dimension_ + 2) / 2 : dimension_ + 1);
  }
  bool is_vacant(CellId c) const {
    return vertex_id(c, 0) == (links_.narrow_vertices ? invalid_index & 0xffff : invalid_index);
  }
  bool is_in(CellId c, Which which) const {
    if (is_vacant(c)) return false;
    return which == Which::all || (which == Which::infinite) == is_infinite(c);
  }

  Links links_{nullptr, 0, false};
  int dimension_ = -1;
  Index num_slots_ = 0, num_finite_cells_ = 0, num_infinite_cells_ = 0, num_finite_vertices_ = 0,
        num_vertex_slots_ = 0;
  const CellId* cell_of_vertex_ = nullptr;
};

/// The cells of one kind, as a range. Holds its own copy of the view, so it may be made from a temporary
/// Complex.
class Complex::CellRange {
 public:
  CellRange(const Complex& complex, Which which) : complex_(complex), which_(which) {}
  CellIterator begin() const { return {&complex_, 0, which_}; }
  CellIterator end() const { return {&complex_, complex_.num_slots_, which_}; }

 private:
  Complex complex_;
  Which which_;
};

inline Complex::CellRange Complex::cells() const { return {*this, Which::all}; }
inline Complex::CellRange Complex::finite_cells() const { return {*this, Which::finite}; }
inline Complex::CellRange Complex::infinite_cells() const { return {*this, Which::infinite}; }

/// The canonical hash of a triangulation: 128 bits that depend on the coordinates of the vertices and on the
/// set of finite cells only; not on ids, order of insertion, seed, duplicates, or the sign of zeros. As 32
/// hexadecimal digits. If vertices have different weights, it depends on these, too; on hidden points never.
struct CanonicalHash {
  std::uint64_t high = 0, low = 0;
  friend bool operator==(const CanonicalHash&, const CanonicalHash&) = default;
  std::string hex() const;
};

/// The canonical hash of a plain triangulation. O(n·d + m·k).
CanonicalHash canonical_hash(const ComplexData& data);

}  // namespace delone
