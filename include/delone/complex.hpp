// SPDX-License-Identifier: BSD-3-Clause
// The read-only complex: cells, neighbors, vertices, stars and faces of a triangulated sphere.
#pragma once

#include <delone/error.hpp>
#include <delone/execution.hpp>
#include <delone/export.hpp>
#include <delone/types.hpp>

#include <compare>
#include <cstddef>
#include <cstdint>
#include <iosfwd>
#include <iterator>
#include <string>
#include <vector>

namespace delone {

struct ComplexData;

namespace detail {

/// What a hardened build (DELONE_HARDENED) does for an id or index out of range. In other builds the behavior
/// is undefined.
[[noreturn]] inline void throw_out_of_range(const char* what) {
  throw Error(Errc::invalid_argument, std::string(what) + " is out of range");
}

}  // namespace detail

/// The vertices or the neighbors of a cell: a random-access range of ids, by value. Refers to the complex,
/// and is valid as long as the complex is. Allocates nothing; converts to a vector, which does.
template <class Id>
class CellLinks {
 public:
  class Iterator {
   public:
    using value_type = Id;
    using difference_type = std::ptrdiff_t;
    using reference = Id;
    using pointer = void;
    using iterator_category = std::random_access_iterator_tag;
    Iterator() = default;
    Iterator(const CellLinks& links, int place)
        : first_(links.first_), narrow_(links.narrow_), place_(place) {}
    Id operator*() const { return CellLinks::id(first_, narrow_, place_); }
    Id operator[](std::ptrdiff_t n) const { return *(*this + n); }
    Iterator& operator+=(std::ptrdiff_t n) {
      place_ += n;
      return *this;
    }
    Iterator& operator-=(std::ptrdiff_t n) { return *this += -n; }
    Iterator& operator++() { return *this += 1; }
    Iterator& operator--() { return *this += -1; }
    Iterator operator++(int) {
      const Iterator old = *this;
      ++*this;
      return old;
    }
    Iterator operator--(int) {
      const Iterator old = *this;
      --*this;
      return old;
    }
    friend Iterator operator+(Iterator i, std::ptrdiff_t n) { return i += n; }
    friend Iterator operator+(std::ptrdiff_t n, Iterator i) { return i += n; }
    friend Iterator operator-(Iterator i, std::ptrdiff_t n) { return i -= n; }
    friend std::ptrdiff_t operator-(const Iterator& a, const Iterator& b) { return a.place_ - b.place_; }
    friend bool operator==(const Iterator& a, const Iterator& b) { return a.place_ == b.place_; }
    friend auto operator<=>(const Iterator& a, const Iterator& b) { return a.place_ <=> b.place_; }

   private:
    const Index* first_ = nullptr;
    bool narrow_ = false;
    std::ptrdiff_t place_ = 0;
  };

  CellLinks() = default;
  CellLinks(const Index* first, int size, bool narrow) : first_(first), size_(size), narrow_(narrow) {}
  std::size_t size() const { return static_cast<std::size_t>(size_); }
  bool empty() const { return size_ == 0; }
  Id operator[](std::size_t i) const {
    if (DELONE_HARDENED && i >= size()) detail::throw_out_of_range("the index of a vertex or neighbor");
    return id(first_, narrow_, static_cast<std::ptrdiff_t>(i));
  }
  Id front() const { return (*this)[0]; }
  Id back() const { return (*this)[size() - 1]; }
  Iterator begin() const { return {*this, 0}; }
  Iterator end() const { return {*this, size_}; }
  operator std::vector<Id>() const { return {begin(), end()}; }

 private:
  static Id id(const Index* first, bool narrow, std::ptrdiff_t i) {
    return Id{narrow ? Index{reinterpret_cast<const std::uint16_t*>(first)[i]} : first[i]};
  }

  const Index* first_ = nullptr;
  int size_ = 0;
  bool narrow_ = false;  // 16 bits each
};

using VerticesOfCell = CellLinks<VertexId>;
using NeighborsOfCell = CellLinks<CellId>;

/// A read-only view of a simplicial complex that triangulates the sphere S^k: the finite cells of a
/// triangulation of affine dimension k, and one infinite cell per hull facet, which joins the facet to the
/// infinite vertex. Topology only: no coordinates. Cheap to copy; valid until its owner changes or dies.
///
/// Cells live in slots; a slot may be vacant after insertions and edits. The ranges skip vacant slots.
/// Functions that take a cell REQUIRE is_cell(c), those that take a vertex is_vertex(v), and indices in a
/// cell are 0 … k. A hardened build (the CMake option DELONE_HARDENED) checks this and throws
/// Errc::invalid_argument.
class DELONE_EXPORT Complex {
 public:
  /// Which cells a range visits.
  enum class Which { all, finite, infinite };

  class CellIterator;
  class CellRange;

  /// For each slot, k+1 vertices and then k+1 neighbors. A vacant slot has invalid_index, or its lower 16
  /// bits, as its first vertex.
  struct Links {
    const Index* first;
    std::size_t stride;    ///< from one slot to the next, in ids
    bool narrow_vertices;  ///< whether vertices take 16 bits each; neighbors begin at the next whole id
  };

  Complex() = default;
  /// `cell_of_vertex`: by vertex id, invalid_cell for an id without a vertex; `num_vertex_slots` entries, or
  /// num_finite_vertices + 1 if that is 0.
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
  int affine_dimension() const { return dimension_; }
  /// The number of finite vertices. Their ids are 1 … num_vertices() unless points are hidden or were
  /// removed, which leaves gaps.
  Index num_vertices() const { return num_finite_vertices_; }
  Index num_vertex_slots() const { return num_vertex_slots_; }  ///< size for payload arrays indexed by vertex
  Index num_finite_cells() const { return num_finite_cells_; }
  Index num_infinite_cells() const { return num_infinite_cells_; }  ///< = number of hull facets
  Index num_all_cells() const { return num_finite_cells_ + num_infinite_cells_; }
  Index num_cell_slots() const { return num_slots_; }  ///< size for payload arrays indexed by cell

  bool is_cell(CellId c) const { return delone::index(c) < num_slots_ && !is_vacant(c); }
  bool is_vertex(VertexId v) const {
    return delone::index(v) < num_vertex_slots_ && incident_cell(v) != invalid_cell;
  }
  bool is_infinite(CellId c) const { return infinite_index(c) >= 0; }
  bool is_infinite(VertexId v) const { return v == infinite_vertex; }

  CellRange all_cells() const;
  CellRange finite_cells() const;
  CellRange infinite_cells() const;
  /// The finite vertices in increasing id. O(slots).
  std::vector<VertexId> finite_vertices() const;

  /// Vertex i of cell c, 0 ≤ i ≤ k. Cells are coherently oriented: replacing one vertex of a cell by another
  /// point on the same side of the opposite facet keeps the orientation.
  VertexId vertex(CellId c, int i) const {
    require(c, i);
    return VertexId{vertex_id(c, i)};
  }
  /// The cell across the facet opposite vertex i.
  CellId neighbor(CellId c, int i) const {
    require(c, i);
    return CellId{neighbor_ids(c)[i]};
  }
  /// The k+1 vertices of a cell, and its neighbors: neighbor i is opposite vertex i. Without allocation.
  VerticesOfCell vertices(CellId c) const {
    require(c);
    return {row(c), dimension_ + 1, links_.narrow_vertices};
  }
  NeighborsOfCell neighbors(CellId c) const {
    require(c);
    return {neighbor_ids(c), dimension_ + 1, false};
  }
  /// Asks the processor to load the vertices and neighbors of a cell into its caches. No effect on results.
  void prefetch(CellId c) const;
  /// The index, in neighbor i of c, of the vertex opposite the shared facet. O(k). REQUIRES as neighbor().
  int mirror_index(CellId c, int i) const {
    // Two cells of a simplicial sphere share at most one facet, so the neighbor that is c is found once.
    const Index* const neighbors = neighbor_ids(neighbor(c, i));
    int j = 0;
    while (j < dimension_ && neighbors[j] != delone::index(c)) ++j;
    return j;
  }
  /// The index of vertex v in cell c, or −1. O(k).
  int index_of(CellId c, VertexId v) const {
    require(c);
    for (int i = 0; i <= dimension_; ++i)
      if (vertex_id(c, i) == delone::index(v)) return i;
    return -1;
  }
  /// The index of the infinite vertex in c, or −1 if c is finite. O(k).
  int infinite_index(CellId c) const { return index_of(c, infinite_vertex); }

  /// A cell that contains v (any vertex, the infinite one included). O(1).
  CellId incident_cell(VertexId v) const {
    if (DELONE_HARDENED && delone::index(v) >= num_vertex_slots_)
      detail::throw_out_of_range("the id of a vertex");
    return cell_of_vertex_[delone::index(v)];
  }
  /// All cells that contain v, finite and infinite. O(size of the star · k). REQUIRES is_vertex(v), as link()
  /// and adjacent_vertices() do.
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
  /// All finite faces of dimension j, as rows of j+1 increasing vertex ids, sorted. O(cells · C(k+1,j+1))
  /// memory. Throws Errc::invalid_argument unless 0 ≤ j ≤ k.
  std::vector<VertexId> faces(int j) const;
  /// All finite edges as pairs of increasing ids, sorted: faces(1), or none for k < 1.
  std::vector<VertexId> edges() const { return dimension_ < 1 ? std::vector<VertexId>{} : faces(1); }

 private:
  friend class CellIterator;
  void require([[maybe_unused]] CellId c, [[maybe_unused]] int i = 0) const {
    if (DELONE_HARDENED && !is_cell(c)) detail::throw_out_of_range("the id of a cell");
    if (DELONE_HARDENED && (i < 0 || i > dimension_))
      detail::throw_out_of_range("the index of a vertex or neighbor");
  }
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

/// A forward iterator. Holds its own copy of the view, so it may outlive its range.
class Complex::CellIterator {
 public:
  using value_type = CellId;
  using difference_type = std::ptrdiff_t;
  using iterator_category = std::forward_iterator_tag;
  CellIterator() = default;
  CellIterator(const Complex& complex, Index slot, Which which)
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
    while (slot_ < complex_.num_slots_ && !complex_.is_in(CellId{slot_}, which_)) ++slot_;
  }
  Complex complex_;
  Index slot_ = 0;
  Which which_ = Which::all;
};

/// The cells of one kind, as a range. Holds its own copy of the view, so it may be made from a temporary
/// Complex.
class Complex::CellRange {
 public:
  CellRange(const Complex& complex, Which which) : complex_(complex), which_(which) {}
  CellIterator begin() const { return {complex_, 0, which_}; }
  CellIterator end() const { return {complex_, complex_.num_slots_, which_}; }

 private:
  Complex complex_;
  Which which_;
};

inline Complex::CellRange Complex::all_cells() const { return {*this, Which::all}; }
inline Complex::CellRange Complex::finite_cells() const { return {*this, Which::finite}; }
inline Complex::CellRange Complex::infinite_cells() const { return {*this, Which::infinite}; }

/// The canonical hash of a triangulation: 128 bits that depend on the coordinates of the vertices and on the
/// set of finite cells only; not on ids, order of insertion, seed, duplicates, or the sign of zeros. As 32
/// hexadecimal digits. If vertices have different weights, it depends on these, too; it never depends on
/// hidden points.
struct DELONE_EXPORT CanonicalHash {
  std::uint64_t high = 0, low = 0;
  friend bool operator==(const CanonicalHash&, const CanonicalHash&) = default;
  std::string hex() const;
};
/// Writes the digits of hex().
DELONE_EXPORT std::ostream& operator<<(std::ostream& out, const CanonicalHash& hash);

/// The canonical hash of a plain triangulation. O(n·d + m·k). Throws Errc::invalid_argument if the arrays
/// disagree or a cell has a row that is not one of the points; unsupported for periodic triangulations, and
/// cancelled.
DELONE_EXPORT CanonicalHash canonical_hash(const ComplexData& data, const Execution& how = {});

}  // namespace delone
