// SPDX-License-Identifier: BSD-3-Clause
// Which rays of a pointed cone are adjacent, that is, span a face of dimension 2, from the rows that each ray
// lies on (Fukuda and Prodon, "Double description method revisited", doi:10.1007/3-540-61576-8_77).
//
// Let the cone have dimension k, and let Z(r) be the set of rows that ray r lies on, of valid rows among
// which are all facets, without rows that contain the whole cone. Two rays are adjacent iff no third one lies
// on all of Z(u) ∩ Z(v); and only if that set has at least k − 2 members. If it has |Z(u)| − 1 members they
// are adjacent, because Z(u) has rank k − 1.
//
// A ray is simple if |Z(r)| = k − 1: these rows are independent, so r has exactly k − 1 neighbors, one for
// each row that is left out. A simple ray w is no third ray of any pair (u, v). With Z(u) ∩ Z(v) ⊆ Z(w), the
// rows of this intersection are independent and at least k − 2. If k − 2, the face that they define has
// dimension 2 and two rays only; if k − 1, it is w itself. So pairs of simple rays are found by hashing Z(r)
// without each row, and simple rays are left out when others are compared.
#pragma once

#include "base/progress_meter.hpp"
#include "polyhedra/bit_rows.hpp"
#include "polyhedra/common_zeros_kernel.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::polyhedra {

class Adjacency {
 public:
  struct Pair {
    std::uint32_t first, second;
  };

  /// Begins with `size` rays that lie on no rows, in a cone of dimension k ≥ 2; `width`: the number of rows.
  void reset(std::size_t size, std::size_t width, std::size_t cone_dimension);
  /// The rows of a ray, to be filled in before anything is asked.
  Bits rows(std::size_t ray) { return {rows_.data() + ray * words_, words_}; }

  /// All pairs of adjacent rays of which at least one is simple, if there are many such rays: these are left
  /// out by compare() then.
  std::vector<Pair> join_simple_rays();

  /// Calls visit(u, v) for the adjacent pairs that are left and for which wants(u, v). `key_of(ray)` does not
  /// decrease; rays of one key are not compared, nor any of the key `no_key`.
  static constexpr std::uint32_t no_key = 0xffffffff;
  template <class KeyOf, class Wants, class Visit>
  void compare(KeyOf key_of, Wants wants, Visit visit) {
    prepare();
    for (std::size_t i = 0, next = 0; i < size_; ++i) {
      internal::cancellation_point();
      const std::uint32_t u = number(i), key = key_of(u);
      if (key == no_key) return;
      if (next <= i)
        for (next = i + 1; next < size_ && key_of(number(next)) == key;) ++next;
      find_overlaps(columns_.data(), stride_, size_, as_const(i), next, least_, overlaps_);
      has_witnesses_ = false;
      for (const Overlap& overlap : overlaps_)
        if (const std::uint32_t v = number(overlap.set); wants(u, v) && is_adjacent(i, overlap)) visit(u, v);
      overlaps_.clear();
    }
  }

 private:
  std::uint32_t number(std::size_t i) const {
    return numbers_.empty() ? static_cast<std::uint32_t>(i) : numbers_[i];
  }
  ConstBits as_const(std::size_t i) const { return {rows_.data() + i * words_, words_}; }
  /// Counts rows, and copies them word by word.
  void prepare();
  std::size_t num_common(std::size_t i, std::size_t j) const;
  void hash_simple_rays(const std::vector<std::uint32_t>& simple, std::vector<std::uint32_t>& num_partners,
                        std::vector<Pair>& pairs);
  /// Whether no third ray lies on all the rows that two have in common.
  bool is_adjacent(std::size_t i, const Overlap& overlap);

  std::size_t size_ = 0, words_ = 0, stride_ = 0;
  std::uint32_t least_ = 0;             // k − 2
  std::vector<std::uint64_t> rows_;     // ray by ray
  std::vector<std::uint64_t> columns_;  // word by word
  std::vector<std::uint32_t> counts_;   // |Z(r)|
  bool is_prepared_ = false;
  std::vector<std::uint32_t> numbers_;  // which rays are left, unless all are
  std::vector<Overlap> overlaps_, witnesses_;
  bool has_witnesses_ = false;
};

}  // namespace delone::polyhedra
