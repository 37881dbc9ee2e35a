// SPDX-License-Identifier: BSD-3-Clause
#include "hull/insert_in_threads.hpp"

#include <algorithm>
#include <array>
#include <vector>

namespace delone::internal {
namespace {

/// Whether at least a quarter of some sites are in the interior.
bool are_many_interior(const ConvexHullBuilder& builder, std::span<const Index> sites) {
  std::array<Index, 64> sample;
  std::array<char, sample.size()> is_interior;
  if (sites.size() < 2 * sample.size()) return false;
  for (std::size_t i = 0; i < sample.size(); ++i) sample[i] = sites[i * (sites.size() / sample.size())];
  builder.find_surely_interior(sample, is_interior, 1);
  return std::count(is_interior.begin(), is_interior.end(), 1) >= std::ptrdiff_t{sample.size() / 4};
}

}  // namespace

void insert_in_threads(ConvexHullBuilder& builder, std::span<const Index> sites,
                       std::span<const std::size_t> rounds, unsigned threads,
                       const std::function<void(std::size_t)>& tick,
                       const std::function<void(Index, Insertion)>& placed) {
  constexpr std::size_t least_round = 2048;
  std::vector<std::size_t> ends;  // of the rounds to come
  std::vector<Index> outside;
  std::vector<char> is_interior;
  for (std::size_t begin = 0, end = 0; begin < sites.size(); begin = end) {
    std::span<const Index> next = sites.subspan(begin);
    end = sites.size();
    ends.clear();
    for (const std::size_t round : rounds)
      if (round > begin) ends.push_back(round - begin);
    if (are_many_interior(builder, next)) {
      end = std::min(end, ends.empty() ? std::max(2 * begin, least_round) : begin + ends.front());
      next = next.first(end - begin);
      is_interior.resize(next.size());
      builder.find_surely_interior(next, is_interior, threads);
      outside.clear();
      for (std::size_t i = 0; i < next.size(); ++i)
        if (is_interior[i] != 0)
          placed(next[i], Insertion::interior);
        else
          outside.push_back(next[i]);
      next = outside;
      ends.clear();
    }
    if (builder.shares_batches_of(next.size())) {
      builder.insert_all(
          next, ends, threads, [&](std::size_t done) { tick(begin + done); }, placed);
    } else {
      std::size_t done = 0;
      builder.insert_all(next, [&](Index site, Insertion outcome) {
        placed(site, outcome);
        tick(begin + ++done);
      });
    }
  }
}

}  // namespace delone::internal
