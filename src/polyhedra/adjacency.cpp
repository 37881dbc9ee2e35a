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

bool Adjacency::is_adjacent(std::size_t i, const Overlap& overlap, Comparison& with) const {
  std::vector<Overlap>& witnesses = with.witnesses;
  const std::size_t j = overlap.set;
  if (overlap.count + 1 >= std::min(counts_[i], counts_[j])) return true;
  if (!with.has_witnesses) {  // a third ray has at least k − 2 rows in common with i, too
    witnesses.clear();
    find_overlaps(columns_.data(), stride_, size_, as_const(i), 0, least_, witnesses);
    std::erase_if(witnesses, [&](const Overlap& witness) { return witness.set == i; });
    with.has_witnesses = true;
  }
  const ConstBits a = as_const(i), b = as_const(j);
  for (std::size_t k = 0; k < witnesses.size(); ++k) {
    if (witnesses[k].count < overlap.count || witnesses[k].set == j) continue;
    const ConstBits c = as_const(witnesses[k].set);
    bool has_all = true;
    for (std::size_t w = 0; w < words_ && has_all; ++w) has_all = (a[w] & b[w] & ~c[w]) == 0;
    if (!has_all) continue;
    std::swap(witnesses[k], witnesses[k / 2]);  // it is likely to be one for other pairs, too
    return false;
  }
  return true;
}

std::vector<Adjacency::Pair> Adjacency::join_simple_rays(unsigned threads) {
  constexpr std::size_t least_simple = 200;
  const std::uint32_t degree = least_ + 1;
  std::vector<std::uint32_t> simple, others;
  for (std::size_t i = 0; i < size_; ++i)
    (count(as_const(i)) == degree ? simple : others).push_back(static_cast<std::uint32_t>(i));
  if (simple.size() < std::max(least_simple, size_ / 8)) return {};
  std::vector<Pair> pairs = hash_simple_rays(simple, threads);
  std::vector<std::uint32_t> num_partners(size_, 0);
  for (const Pair& pair : pairs) {
    ++num_partners[pair.first];
    ++num_partners[pair.second];
  }
  std::erase_if(simple, [&](std::uint32_t i) { return num_partners[i] == degree; });

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
  const auto work = [&](std::size_t first, std::size_t last, Comparison& with, const auto& stop) {
    for (std::size_t s = first; s < last; ++s) {
      stop();
      const std::uint32_t i = simple[s];
      find_overlaps(columns_.data(), stride_, size_, {all_rows.data() + i * words_, words_}, 0, least_,
                    with.overlaps);
      for (const Overlap& overlap : with.overlaps) with.found.push_back({i, numbers_[overlap.set]});
      with.overlaps.clear();
    }
  };
  in_parts(threads, simple.size(), work, [&](std::uint32_t u, std::uint32_t v) { pairs.push_back({u, v}); });
  return pairs;
}

/// Each thread has a table for its share of the keys, and looks at all rays.
std::vector<Adjacency::Pair> Adjacency::hash_simple_rays(const std::vector<std::uint32_t>& simple,
                                                         unsigned threads) const {
  constexpr std::size_t many = std::size_t{1} << 16;
  const std::size_t parts =
      simple.size() * (least_ + 1) < many ? 1 : internal::threads_for_parts(threads, many);
  std::vector<std::vector<Pair>> found(parts);
  internal::for_parts(static_cast<unsigned>(parts), parts, 1,
                      [&](std::size_t first, std::size_t, const internal::StopPoint& stop) {
                        found[first] = hash_simple_rays(simple, first, parts, stop);
                      });
  for (std::size_t p = 1; p < parts; ++p)
    found.front().insert(found.front().end(), found[p].begin(), found[p].end());
  return std::move(found.front());
}

/// A table with open addressing, which grows if keys are not spread evenly. The key of a set is the sum of
/// the hashes of its words, so that another key costs one word when one member is left out.
std::vector<Adjacency::Pair> Adjacency::hash_simple_rays(const std::vector<std::uint32_t>& simple,
                                                         std::size_t part, std::size_t parts,
                                                         const internal::StopPoint& stop) const {
  struct Place {
    std::uint64_t key = 0;
    std::uint32_t ray = no_key;
  };
  const std::size_t degree = least_ + 1;
  std::vector<Place> table(std::bit_ceil(simple.size() * degree / parts * 3 / 2 + 1));
  std::size_t num_places = 0;
  const auto place_of = [&](std::uint64_t key) { return key & (table.size() - 1); };
  const auto hash = [](std::uint64_t word, std::size_t w) {
    return random::mix(word + (w + 1) * 0x9e3779b97f4a7c15u);
  };
  const auto grow = [&] {
    std::vector<Place> larger(2 * table.size());
    larger.swap(table);
    for (const Place& place : larger) {
      if (place.ray == no_key) continue;
      std::size_t at = place_of(place.key);
      while (table[at].ray != no_key) at = (at + 1) & (table.size() - 1);
      table[at] = place;
    }
  };
  std::vector<Pair> pairs;
  for (const std::uint32_t i : simple) {
    stop();
    const ConstBits row = as_const(i);
    std::uint64_t sum = 0;
    for (std::size_t w = 0; w < words_; ++w) sum += hash(row[w], w);
    for (std::size_t w = 0; w < words_; ++w) {
      const std::uint64_t rest = sum - hash(row[w], w);
      for (std::uint64_t word = row[w]; word != 0; word &= word - 1) {
        const std::uint64_t key = rest + hash(row[w] & ~(word & (0 - word)), w);
        if (parts > 1 && (key >> 32) % parts != part) continue;
        for (std::size_t at = place_of(key);; at = (at + 1) & (table.size() - 1)) {
          Place& place = table[at];
          if (place.ray == no_key) {
            place = {key, i};
            if (++num_places > table.size() / 8 * 7) grow();
            break;
          }
          if (place.key != key || num_common(place.ray, i) != least_) continue;
          pairs.push_back({place.ray, i});
          break;
        }
      }
    }
  }
  return pairs;
}

}  // namespace delone::polyhedra
