// SPDX-License-Identifier: BSD-3-Clause
// What Qhull's text outputs have in common: the names that are asked for, lists of numbers, and the outputs
// of anything that consists of facets.
#pragma once

#include "io/atomic_file.hpp"

#include <delone/types.hpp>

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace delone::io {

/// A number of Qhull's, as an index of an array.
inline std::size_t at(SignedIndex number) { return static_cast<std::size_t>(number); }

/// Lists of numbers, stored back to back.
class NumberLists {
 public:
  void add(std::span<const SignedIndex> list) {
    items_.insert(items_.end(), list.begin(), list.end());
    offsets_.push_back(items_.size());
  }
  std::size_t size() const { return offsets_.size() - 1; }
  std::size_t num_items() const { return items_.size(); }
  std::span<const SignedIndex> operator[](std::size_t i) const {
    return {items_.data() + offsets_[i], offsets_[i + 1] - offsets_[i]};
  }

 private:
  std::vector<SignedIndex> items_;
  std::vector<std::size_t> offsets_{0};
};

/// What Qhull calls the facets of its hull: those of a hull, the cells of a triangulation, the vertices of an
/// intersection of halfspaces.
struct QhullFacets {
  /// As many vertices as neighbors: neighbor i is opposite vertex i.
  NumberLists vertices, neighbors;
  /// The same vertices as a cycle or, in a simplex, in the order that Qhull gives to one of its orientation.
  NumberLists oriented;
  /// Qhull's count of ridges.
  std::size_t num_ridges() const { return neighbors.num_items() / 2; }
};

/// An output by its name.
using QhullOutput = std::pair<const char*, std::function<void(AtomicFile&)>>;

/// Writes the outputs with the names in `wanted`, which commas or blanks separate, in their order. Throws
/// invalid_argument for others.
void write_qhull_outputs(const std::string& path, const std::string& wanted, const std::string& what,
                         std::initializer_list<QhullOutput> known);

/// Numbers with blanks between them, and the end of the line.
template <class Numbers>
void put_line(AtomicFile& file, const Numbers& numbers) {
  bool is_first = true;
  for (const auto x : numbers) {
    if (!is_first) file.put(' ');
    file.put(x);
    is_first = false;
  }
  file.put('\n');
}

/// Each number on a line of its own, after how many there are.
void put_column(AtomicFile& file, std::span<const SignedIndex> numbers);
/// Each list on a line, after its length.
void put_counted(AtomicFile& file, const NumberLists& lists);
/// Rows of numbers.
void put_rows(AtomicFile& file, std::span<const double> numbers, std::size_t width);

}  // namespace delone::io
