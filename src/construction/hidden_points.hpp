// SPDX-License-Identifier: BSD-3-Clause
// Hidden points by the cells that hide them: each with a finite cell whose closure contains it. If a vertex
// goes, only the hidden points of its cells may come back: above all other cells the lifted surface stays as
// it is.
#pragma once

#include <delone/types.hpp>

#include <cstddef>
#include <vector>

namespace delone::construction {

/// Lists by slots of cells, linked through the ids of the points.
class HiddenPoints {
 public:
  /// Makes room for points up to an id, and cells up to a slot. Throws std::bad_alloc.
  void reserve(std::size_t num_ids, std::size_t num_slots) {
    if (places_.size() < num_ids) places_.resize(num_ids + num_ids / 2);
    if (first_.size() < num_slots) first_.resize(num_slots + num_slots / 2, invalid_index);
  }
  /// REQUIRES room, and that the point is in no list.
  void add(Index point, Index cell) {
    Index& first = first_[cell];
    places_[point] = {cell, invalid_index, first};
    if (first != invalid_index) places_[first].previous = point;
    first = point;
    ++size_;
  }
  void remove(Index point) {
    Place& place = places_[point];
    (place.previous == invalid_index ? first_[place.cell] : places_[place.previous].next) = place.next;
    if (place.next != invalid_index) places_[place.next].previous = place.previous;
    place.cell = invalid_index;
    --size_;
  }
  /// How many points are in all lists.
  std::size_t size() const { return size_; }
  bool contains(Index point) const { return point < places_.size() && places_[point].cell != invalid_index; }
  /// Whether test(point) holds for a point of a cell.
  template <class Test>
  bool any_of(Index cell, Test&& test) const {
    if (cell >= first_.size()) return false;
    for (Index point = first_[cell]; point != invalid_index; point = places_[point].next)
      if (test(point)) return true;
    return false;
  }
  /// Moves the points of a cell to the end of a list. Throws std::bad_alloc; those that were moved are in the
  /// list then.
  void take(Index cell, std::vector<Index>& points) {
    if (cell >= first_.size()) return;
    while (first_[cell] != invalid_index) {
      points.push_back(first_[cell]);
      remove(first_[cell]);
    }
  }

 private:
  struct Place {
    Index cell = invalid_index, previous = invalid_index, next = invalid_index;
  };
  std::vector<Index> first_;   // by slot
  std::vector<Place> places_;  // by id
  std::size_t size_ = 0;
};

}  // namespace delone::construction
