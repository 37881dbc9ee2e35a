// SPDX-License-Identifier: BSD-3-Clause
// What is beyond a facet at the border of a hole or within it: of the vertices around the hole, the one whose
// sphere through the facet comes first. Works with rounded numbers, and names all vertices that may be the
// one; nothing is proved here.
//
// With the barycentric coordinates λ_i of a cell and its functional h, the spheres through facet i are the
// members h + t·λ_i of a pencil. Of the vertices beyond, where λ_i < 0, the first has the least h/−λ_i. A
// cell and its neighbor share all vertices but one, so the functions of one are those of the other after one
// step of elimination.
#pragma once

#include "geometry/hole_search/hole_kernel.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace delone::geometry {

/// Vertices have numbers of their own, from 1 on: first the candidates, then others. Infinite vertices have
/// the number 0, and no row.
class HoleSearch {
 public:
  /// How many numbers the functions of a cell are.
  static constexpr std::size_t size_of_functions(int k) { return geometry::size_of_functions(k); }

  /// Begins with other vertices. Their rows, k images and the lift each, are to be written next, close to the
  /// origin and of magnitude 1 at most. Throws std::bad_alloc.
  void begin(int k, std::size_t num_candidates, std::size_t num_vertices);
  double* row(std::size_t vertex) { return rows_.data() + vertex * (static_cast<std::size_t>(k_) + 1); }
  /// After all rows have been written.
  void arrange();

  int dimension() const { return k_; }

  /// The functions of a cell of k + 1 vertices, by elimination. Cost O(k³).
  void solve(const Index* vertices, double* functions);
  /// Those of the cell that has another vertex in a slot.
  void replace(const double* functions, int slot, Index vertex, double* replaced) {
    replace_vertex(k_, functions, slot, row(vertex), replaced);
  }
  /// Searches the candidates that may come first beyond some facets of the cell of these k + 1 vertices, or
  /// on the side of the cell. Its own vertices are not among them, but for those in the slots if they may
  /// stay.
  void search(const double* functions, std::span<const int> slots, bool beyond, bool may_stay,
              const Index* vertices);
  /// Those of facet `slots[i]` of the last search; none if no candidate is there. A single one may not be
  /// there either, unless that is certain.
  std::span<const std::uint32_t> found(std::size_t i) const {
    return {found_.data() + parts_[i].first, parts_[i].count};
  }
  bool is_certain(std::size_t i) const { return parts_[i].is_certain; }

 private:
  struct Part {
    std::size_t first, count;
    bool is_certain;
  };
  /// The rows of the candidates, and scratch memory.
  template <class T>
  struct Lanes {
    std::vector<T> rows, values;
  };
  template <class T>
  void arrange(Lanes<T>& lanes);
  template <class T>
  void find(Lanes<T>& lanes, const double* functions, std::span<const int> slots, bool beyond,
            std::size_t num_own);
  /// Lists what find_first() has found of its facet i, from place `first` on, for a facet of the search.
  /// Returns the end of the list.
  std::size_t list(std::size_t i, std::size_t facet, std::size_t first);

  int k_ = 0;
  std::size_t num_candidates_ = 0, stride_ = 0;
  double largest_lift_ = 0;
  std::vector<double> rows_, matrix_;
  Lanes<float> floats_;
  Lanes<double> doubles_;
  bool are_doubles_there_ = false;  // whether the rows in double have been arranged
  std::vector<std::uint64_t> bits_;
  std::unique_ptr<bool[]> are_certain_;  // by facet, and `bits_`, of find_first()
  std::vector<std::size_t> unclear_;     // facets of a search where several candidates may be first
  std::vector<int> unclear_slots_;
  std::vector<std::uint32_t> own_, found_;
  std::vector<Part> parts_;  // of found_, by facet
};

}  // namespace delone::geometry
