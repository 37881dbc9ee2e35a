// SPDX-License-Identifier: BSD-3-Clause
#include "polyhedra/adjacency.hpp"

#include "base/random.hpp"

#include <bit>
#include <utility>

namespace delone::polyhedra {

void Adjacency::reset(std::size_t size, std::size_t width, std::size_t cone_dimension) {
  size_ = size;
  words_ = words_for(width);
  least_ = static_cast<std::uint32_t>(cone_dimension - 2);
  rows_.assign(size * words_, 0);
  numbers_.clear();
  is_prepared_ = false;
}

void Adjacency::prepare() {
  if (std::exchange(is_prepared_, true)) return;
  stride_ = (size_ + 31) / 32 * 32;
  columns_.assign(stride_ * words_, 0);
  counts_.resize(size_);
  for (std::size_t i = 0; i < size_; ++i) {
    const ConstBits row = as_const(i);
    for (std::size_t w = 0; w < words_; ++w) columns_[w * stride_ + i] = row[w];
    counts_[i] = static_cast<std::uint32_t>(count(row));
  }
}

std::size_t Adjacency::num_common(std::size_t i, std::size_t j) const {
  const ConstBits a = as_const(i), b = as_const(j);
  std::size_t sum = 0;
  for (std::size_t w = 0; w < words_; ++w) sum += static_cast<std::size_t>(std::popcount(a[w] & b[w]));
  return sum;
}

bool Adjacency::is_adjacent(std::size_t i, const Overlap& overlap) {
  const std::size_t j = overlap.set;
  if (overlap.count + 1 >= std::min(counts_[i], counts_[j])) return true;
  if (!has_witnesses_) {  // a third ray has at least k − 2 rows in common with i, too
    witnesses_.clear();
    find_overlaps(columns_.data(), stride_, size_, as_const(i), 0, least_, witnesses_);
    std::erase_if(witnesses_, [&](const Overlap& witness) { return witness.set == i; });
    has_witnesses_ = true;
  }
  const ConstBits a = as_const(i), b = as_const(j);
  for (std::size_t k = 0; k < witnesses_.size(); ++k) {
    if (witnesses_[k].count < overlap.count || witnesses_[k].set == j) continue;
    const ConstBits c = as_const(witnesses_[k].set);
    bool has_all = true;
    for (std::size_t w = 0; w < words_ && has_all; ++w) has_all = (a[w] & b[w] & ~c[w]) == 0;
    if (!has_all) continue;
    std::swap(witnesses_[k], witnesses_[k / 2]);  // it is likely to be one for other pairs, too
    return false;
  }
  return true;
}

std::vector<Adjacency::Pair> Adjacency::join_simple_rays() {
  constexpr std::size_t least_simple = 200;
  std::vector<Pair> pairs;
  const std::uint32_t degree = least_ + 1;
  std::vector<std::uint32_t> simple, others;
  for (std::size_t i = 0; i < size_; ++i)
    (count(as_const(i)) == degree ? simple : others).push_back(static_cast<std::uint32_t>(i));
  if (simple.size() < std::max(least_simple, size_ / 8)) return pairs;
  std::vector<std::uint32_t> num_partners(size_, 0);
  hash_simple_rays(simple, num_partners, pairs);

  const std::vector<std::uint64_t> all_rows = std::move(rows_);
  rows_.clear();
  for (const std::uint32_t i : others)
    rows_.insert(rows_.end(), all_rows.begin() + static_cast<std::ptrdiff_t>(i * words_),
                 all_rows.begin() + static_cast<std::ptrdiff_t>((i + 1) * words_));
  numbers_ = std::move(others);
  size_ = numbers_.size();
  is_prepared_ = false;
  if (size_ == 0) return pairs;
  prepare();
  for (const std::uint32_t i : simple) {
    if (num_partners[i] == degree) continue;
    internal::cancellation_point();
    find_overlaps(columns_.data(), stride_, size_, {all_rows.data() + i * words_, words_}, 0, least_,
                  overlaps_);
    for (const Overlap& overlap : overlaps_) pairs.push_back({i, numbers_[overlap.set]});
    overlaps_.clear();
  }
  return pairs;
}

/// A table with open addressing. The key of a set is the sum of the hashes of its words, so that another key
/// costs one word when one member is left out.
void Adjacency::hash_simple_rays(const std::vector<std::uint32_t>& simple,
                                 std::vector<std::uint32_t>& num_partners, std::vector<Pair>& pairs) {
  struct Place {
    std::uint64_t key = 0;
    std::uint32_t ray = no_key;
  };
  const std::size_t degree = least_ + 1;
  const std::size_t capacity = std::bit_ceil(simple.size() * degree * 3 / 2 + 1);
  std::vector<Place> table(capacity);
  const auto hash = [](std::uint64_t word, std::size_t w) {
    return random::mix(word + (w + 1) * 0x9e3779b97f4a7c15u);
  };
  for (const std::uint32_t i : simple) {
    internal::cancellation_point();
    const ConstBits row = as_const(i);
    std::uint64_t sum = 0;
    for (std::size_t w = 0; w < words_; ++w) sum += hash(row[w], w);
    for (std::size_t w = 0; w < words_; ++w) {
      const std::uint64_t rest = sum - hash(row[w], w);
      for (std::uint64_t word = row[w]; word != 0; word &= word - 1) {
        const std::uint64_t key = rest + hash(row[w] & ~(word & (0 - word)), w);
        std::size_t at = key & (capacity - 1);
        for (;; at = (at + 1) & (capacity - 1)) {
          Place& place = table[at];
          if (place.ray == no_key) {
            place = {key, i};
            break;
          }
          if (place.key != key || num_common(place.ray, i) != least_) continue;
          ++num_partners[i];
          ++num_partners[place.ray];
          pairs.push_back({place.ray, i});
          break;
        }
      }
    }
  }
}

}  // namespace delone::polyhedra
