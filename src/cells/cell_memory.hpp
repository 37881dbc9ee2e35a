// SPDX-License-Identifier: BSD-3-Clause
// The memory of all cells:
//   functional    k + 1 coefficients, for geometry/
//   certificate   64 bits, for geometry/; two of them are the engine's mark
//   links         k + 1 vertices and k + 1 neighbors, for engine/
// Insertions need all of a cell together, so it is in one record, with two exceptions. In 3D, functional and
// links fill a cache line, and certificates are in an array of their own. From 7D on, where points are
// wrapped, links are in an array of their own: until all cells are there, nothing else of them is needed. In
// 5D and 6D, vertices take 16 bits as long as their ids fit (docs/decisions/0010-short-ids-of-vertices.md).
#pragma once

#include "base/growable_array.hpp"
#include "base/progress_meter.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <utility>

namespace delone::cells {

using internal::GrowableArray;
using internal::Pages;

/// The state of a cell during the search of a conflict zone.
enum class Mark : std::uint8_t { unseen = 0, in_conflict = 1, not_in_conflict = 2 };

/// How vertices are stored in cells: in 32 bits, or in 16.
enum class VertexIds : std::uint8_t { wide, narrow };

/// The last id that fits 16 bits, and the 16-bit form of invalid_index.
inline constexpr Index last_narrow_vertex = 0xfffe, invalid_narrow_index = 0xffff;

/// Whether vertices may be narrow in this dimension, if it is known at compile time.
constexpr bool may_be_narrow(int k) { return k == 5 || k == 6; }

/// The width for vertices up to this one.
constexpr VertexIds ids_for(std::size_t last_vertex) {
  return last_vertex <= last_narrow_vertex ? VertexIds::narrow : VertexIds::wide;
}

/// A wide copy of the vertices of a cell. It is used like a pointer to the first.
template <int K>
class CopiedVertices {
 public:
  template <class VertexAt>
  explicit CopiedVertices(VertexAt vertex) {
    for (int i = 0; i <= K; ++i) ids_[i] = vertex(i);
  }
  operator const Index*() const& { return ids_; }
  operator const Index*() const&& = delete;  // the pointer would outlive the copy

 private:
  Index ids_[K + 1];
};
/// The vertices of a cell in 32 bits: a pointer to them, or a copy.
template <int K>
using CellVertices = std::conditional_t<may_be_narrow(K), CopiedVertices<K>, const Index*>;

/// The layout of cells in memory. K is the dimension of the cells, or 0 if it is chosen at run time.
template <int K>
class CellLayout {
 public:
  /// `ids`: ignored in dimensions in which vertices are always wide.
  explicit CellLayout(int dimension, VertexIds ids = VertexIds::wide) : dimension_(dimension), ids_(ids) {}

  int dimension() const { return K > 0 ? K : dimension_; }
  VertexIds vertex_ids() const { return is_narrow() ? VertexIds::narrow : VertexIds::wide; }
  bool is_narrow() const { return may_be_narrow(K) && ids_ == VertexIds::narrow; }
  std::size_t num_coefficients() const { return static_cast<std::size_t>(dimension()) + 1; }
  bool certificates_are_apart() const { return dimension() == 3; }
  bool links_are_apart() const { return dimension() >= 7; }

  /// The distance from a cell to the next, in words.
  std::size_t functional_stride() const {
    const std::size_t words = links_are_apart() ? words_of_record() : words_before_links() + words_of_links();
    // Cache lines have 8 words: one word of padding keeps cells of 7 words, and of 15, from straddling more
    // lines than they need.
    return words % 8 == 7 ? words + 1 : words;
  }
  /// The same for links, in ids.
  std::size_t link_stride() const {
    return (links_are_apart() ? words_of_links() : functional_stride()) * ids_per_word;
  }
  /// The distance from the first vertex of a cell to its first neighbor, in ids.
  std::size_t ids_before_neighbors() const {
    return is_narrow() ? (num_coefficients() + 1) / 2 : num_coefficients();
  }
  /// The size of the vertices and neighbors of a cell, in ids.
  std::size_t num_link_ids() const { return ids_before_neighbors() + num_coefficients(); }
  /// How many bytes of a record are not used, after the links.
  std::size_t num_spare_bytes() const {
    if (links_are_apart()) return 0;
    return (functional_stride() - words_before_links()) * sizeof(double) - num_link_ids() * sizeof(Index);
  }
  /// How many words of the record are before the links.
  std::size_t words_before_links() const { return links_are_apart() ? 0 : words_of_record(); }
  /// The memory of a cell, all arrays together.
  std::size_t bytes() const {
    return (functional_stride() + certificates_are_apart() + (links_are_apart() ? words_of_links() : 0)) *
           sizeof(double);
  }

  /// Vertex i of the cell with these links.
  Index vertex(const Index* links, int i) const {
    return is_narrow() ? Index{reinterpret_cast<const std::uint16_t*>(links)[i]} : links[i];
  }
  void set_vertex(Index* links, int i, Index vertex) const {
    if (is_narrow())
      reinterpret_cast<std::uint16_t*>(links)[i] = static_cast<std::uint16_t>(vertex);
    else
      links[i] = vertex;
  }
  /// Vertex 0 of a vacant slot.
  Index vacant() const { return is_narrow() ? invalid_narrow_index : invalid_index; }

  static constexpr std::size_t ids_per_word = sizeof(double) / sizeof(Index);

 private:
  std::size_t words_of_record() const { return num_coefficients() + !certificates_are_apart(); }
  std::size_t words_of_links() const { return (num_link_ids() + ids_per_word - 1) / ids_per_word; }

  int dimension_;
  VertexIds ids_;
};

/// Access to the functionals and certificates of all cells, valid until memory grows. Word is double or const
/// double.
template <int K, class Word = double>
class CellRecords {
 public:
  CellRecords(CellLayout<K> layout, Word* functionals, Word* certificates)
      : layout_(layout), functionals_(functionals), certificates_(certificates) {}

  Word* functional(Index cell) const { return functionals_ + cell * layout_.functional_stride(); }
  /// The bits of a certificate.
  Word* certificate(Index cell) const {
    return layout_.certificates_are_apart() ? certificates_ + cell
                                            : functional(cell) + layout_.num_coefficients();
  }

 private:
  CellLayout<K> layout_;
  Word* functionals_;
  Word* certificates_;  ///< if they are apart
};

/// The memory of all cells. K is the dimension of the cells, or 0 if it is chosen at run time.
template <int K>
class CellMemory {
 public:
  /// `ids`: the width of vertices at first.
  explicit CellMemory(int dimension, VertexIds ids = VertexIds::wide) : layout_(dimension, ids) {}

  int dimension() const { return layout_.dimension(); }
  const CellLayout<K>& layout() const { return layout_; }

  CellRecords<K> records() { return {layout_, words_.data(), certificates_.data()}; }
  CellRecords<K, const double> records() const { return {layout_, words_.data(), certificates_.data()}; }
  Index* links(Index cell) { return const_cast<Index*>(std::as_const(*this).links(cell)); }
  const Index* links(Index cell) const {
    if (layout_.links_are_apart()) return links_.data() + cell * layout_.link_stride();
    return reinterpret_cast<const Index*>(words_.data() + cell * layout_.functional_stride() +
                                          layout_.words_before_links());
  }

  /// The number of cells, and of links, that there is room for.
  std::size_t capacity() const { return capacity_; }
  std::size_t link_capacity() const { return link_capacity_; }
  std::size_t bytes() const {
    return (words_.capacity() + certificates_.capacity()) * sizeof(double) +
           links_.capacity() * sizeof(Index);
  }
  /// Makes room for cells and keeps the present ones. Throws std::bad_alloc, and then changes nothing.
  void reserve(std::size_t cells) {
    words_.reserve(cells * layout_.functional_stride() + spare);
    if (layout_.certificates_are_apart()) certificates_.reserve(cells);
    if (layout_.links_are_apart()) reserve_links(cells);
    capacity_ = std::max(capacity_, cells);
    link_capacity_ = std::max(link_capacity_, cells);
  }
  /// The same for links, if they are apart.
  void reserve_links(std::size_t cells) {
    if (!layout_.links_are_apart()) return reserve(cells);
    links_.reserve(cells * layout_.link_stride() + spare * CellLayout<K>::ids_per_word);
    link_capacity_ = std::max(link_capacity_, cells);
  }
  /// Gives back the memory beyond the first `cells` cells, and keeps those.
  void shrink(std::size_t cells) noexcept {
    words_.shrink(cells * layout_.functional_stride() + spare);
    certificates_.shrink(cells);
    links_.shrink(cells * layout_.link_stride() + spare * CellLayout<K>::ids_per_word);
    capacity_ = std::min(capacity_, cells);
    link_capacity_ = std::min(link_capacity_, cells);
  }
  /// Announces that cells before `cells` will now be written. REQUIRES room for them.
  void prepare(std::size_t cells) {
    words_.prepare(cells * layout_.functional_stride());
    if (layout_.certificates_are_apart()) certificates_.prepare(cells);
    if (layout_.links_are_apart()) links_.prepare(cells * layout_.link_stride());
  }
  /// The same for links, if they are apart.
  void prepare_links(std::size_t cells) {
    if (!layout_.links_are_apart()) return prepare(cells);
    links_.prepare(cells * layout_.link_stride());
  }
  /// Makes the vertices of the first `cells` cells wide. Throws std::bad_alloc, and then changes nothing.
  void widen(std::size_t cells) {
    if constexpr (may_be_narrow(K)) {
      if (!layout_.is_narrow()) return;
      const CellLayout<K> narrow = layout_, wide(dimension(), VertexIds::wide);
      words_.reserve(capacity_ * wide.functional_stride() + spare);
      layout_ = wide;
      for (std::size_t cell = cells; cell-- > 0;) {  // from the last on, as each moves up
        const double* const old_record = words_.data() + cell * narrow.functional_stride();
        const Index* const old_links =
            reinterpret_cast<const Index*>(old_record + narrow.words_before_links());
        Index vertices[K + 1], neighbors[K + 1];
        for (int i = 0; i <= K; ++i) vertices[i] = narrow.vertex(old_links, i);
        if (vertices[0] == narrow.vacant()) vertices[0] = wide.vacant();
        std::copy_n(old_links + narrow.ids_before_neighbors(), K + 1, neighbors);
        double* const record = words_.data() + cell * wide.functional_stride();
        std::copy_backward(old_record, old_record + wide.words_before_links(),
                           record + wide.words_before_links());
        Index* const links = reinterpret_cast<Index*>(record + wide.words_before_links());
        std::copy_n(vertices, K + 1, links);
        std::copy_n(neighbors, K + 1, links + wide.ids_before_neighbors());
      }
    }
  }
  /// Copies the first `cells` cells of a memory of the same dimension; their links alone if that is all it
  /// has. Throws std::bad_alloc and Errc::cancelled; some cells are then unspecified.
  void copy(const CellMemory& other, std::size_t cells) {
    layout_ = other.layout_;
    if (layout_.links_are_apart()) {
      reserve_links(cells);
      copy_entries(other.links_, cells * layout_.link_stride(), links_);
      if (other.capacity_ < cells) return;
    }
    reserve(cells);
    copy_entries(other.words_, cells * layout_.functional_stride(), words_);
    if (layout_.certificates_are_apart()) copy_entries(other.certificates_, cells, certificates_);
  }

 private:
  /// Words after the last cell, so that vectors may reach beyond its ids.
  static constexpr std::size_t spare = 4;

  /// With a cancellation point before every few megabytes.
  template <class T>
  static void copy_entries(const GrowableArray<T>& from, std::size_t size, GrowableArray<T>& to) {
    constexpr std::size_t piece = std::size_t{1} << 19;
    for (std::size_t first = 0; first < size; first += piece) {
      internal::cancellation_point();
      std::copy_n(from.data() + first, std::min(piece, size - first), to.data() + first);
    }
  }

  CellLayout<K> layout_;
  std::size_t capacity_ = 0, link_capacity_ = 0;
  GrowableArray<double> words_{Pages::large};         // functionals, and everything that is not apart
  GrowableArray<double> certificates_{Pages::large};  // if they are apart
  GrowableArray<Index> links_{Pages::large};          // if they are apart
};

/// The bits of a certificate that hold the mark of the cell.
namespace mark_bits {
constexpr int in_conflict = 47, not_in_conflict = 63;
constexpr std::uint64_t all = std::uint64_t{1} << in_conflict | std::uint64_t{1} << not_in_conflict;

inline Mark read(std::uint64_t word) {
  return static_cast<Mark>((word >> in_conflict & 1) | (word >> (not_in_conflict - 1) & 2));
}
inline std::uint64_t write(Mark mark) {
  const auto bits = static_cast<std::uint64_t>(mark);
  return (bits & 1) << in_conflict | (bits & 2) << (not_in_conflict - 1);
}
}  // namespace mark_bits

}  // namespace delone::cells
