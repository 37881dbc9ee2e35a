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

#include "base/parallel_parts.hpp"
#include "polyhedra/bit_rows.hpp"
#include "polyhedra/common_zeros_kernel.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
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
  /// out by compare() then. Their order depends on the number of threads.
  std::vector<Pair> join_simple_rays(unsigned threads = 1);

  /// Calls visit(u, v) for the adjacent pairs that are left and for which wants(u, v), in this thread and in
  /// one order. `key_of(ray)` does not decrease; rays of one key are not compared, nor any of the key
  /// `no_key`.
  static constexpr std::uint32_t no_key = 0xffffffff;
  template <class KeyOf, class Wants, class Visit>
  void compare(const KeyOf& key_of, const Wants& wants, const Visit& visit, unsigned threads = 1) {
    prepare();
    const auto key_at = [&](std::size_t i) { return key_of(number(i)); };
    std::size_t end = size_;
    while (end > 0 && key_at(end - 1) == no_key) --end;
    const auto work = [&](std::size_t first, std::size_t last, Comparison& with, const auto& stop) {
      for (std::size_t i = first, next = 0; i < last; ++i) {
        stop();
        const std::uint32_t u = number(i);
        if (next <= i)
          for (next = i + 1; next < size_ && key_at(next) == key_at(i);) ++next;
        find_overlaps(columns_.data(), stride_, size_, as_const(i), next, least_, with.overlaps);
        with.has_witnesses = false;
        for (const Overlap& overlap : with.overlaps)
          if (const std::uint32_t v = number(overlap.set); wants(u, v) && is_adjacent(i, overlap, with))
            with.found.push_back({u, v});
        with.overlaps.clear();
      }
    };
    in_parts(threads, end, work, visit);
  }

 private:
  std::uint32_t number(std::size_t i) const {
    return numbers_.empty() ? static_cast<std::uint32_t>(i) : numbers_[i];
  }
  ConstBits as_const(std::size_t i) const { return {rows_.data() + i * words_, words_}; }
  /// Counts rows, and copies them word by word.
  void prepare();
  std::size_t num_common(std::size_t i, std::size_t j) const;
  /// What one thread works with.
  struct Comparison {
    std::vector<Pair> found;
    std::vector<Overlap> overlaps, witnesses;
    bool has_witnesses = false;
  };
  /// work(first, last, comparison, stop) for parts of 0 … count − 1, each number of which stands for a ray
  /// that is compared with all others; then visit(u, v) for the pairs found, part after part.
  template <class Work, class Visit>
  void in_parts(unsigned threads, std::size_t count, const Work& work, const Visit& visit) {
    constexpr std::size_t least_part = 16, comparisons = std::size_t{1} << 18;  // 100 µs and more
    const std::size_t part = std::max(least_part, comparisons / std::max(size_, std::size_t{1}));
    const std::size_t num_parts = (count + part - 1) / part;
    const bool is_alone = internal::threads_for_parts(threads, num_parts) == 1;
    std::vector<std::vector<Pair>> found(is_alone ? 0 : num_parts);
    internal::work_in_parts(is_alone ? 1 : threads, count, part, [&] {
      return [&, with = Comparison()](std::size_t first, std::size_t last, const auto& stop) mutable {
        work(first, last, with, stop);
        if (!is_alone) found[first / part] = std::exchange(with.found, {});
        for (const Pair& pair : with.found) visit(pair.first, pair.second);
        with.found.clear();
      };
    });
    for (std::vector<Pair>& pairs : found) {
      for (const Pair& pair : pairs) visit(pair.first, pair.second);
      std::vector<Pair>().swap(pairs);
    }
  }
  std::vector<Pair> hash_simple_rays(const std::vector<std::uint32_t>& simple, unsigned threads) const;
  std::vector<Pair> hash_simple_rays(const std::vector<std::uint32_t>& simple, std::size_t part,
                                     std::size_t parts, const internal::StopPoint& stop) const;
  /// Whether no third ray lies on all the rows that two have in common.
  bool is_adjacent(std::size_t i, const Overlap& overlap, Comparison& with) const;

  std::size_t size_ = 0, words_ = 0, stride_ = 0;
  std::uint32_t least_ = 0;             // k − 2
  std::vector<std::uint64_t> rows_;     // ray by ray
  std::vector<std::uint64_t> columns_;  // word by word
  std::vector<std::uint32_t> counts_;   // |Z(r)|
  bool is_prepared_ = false;
  std::vector<std::uint32_t> numbers_;  // which rays are left, unless all are
};

}  // namespace delone::polyhedra
