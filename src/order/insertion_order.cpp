// SPDX-License-Identifier: BSD-3-Clause
// The choice of an order, and random rounds: a random permutation is cut into rounds of growing size, each
// sorted along the Hilbert curve.
#include "order/insertion_order.hpp"

#include "base/compiler.hpp"
#include "base/parallel.hpp"
#include "base/random.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <numeric>
#include <utility>

namespace delone::order {
namespace {

/// Of the points of a round and all before it, one in `points_per_earlier` is in an earlier round: the last
/// round holds 7/8 of all points. The ratio matters little; with few rounds there are few walks across the
/// whole complex.
constexpr std::size_t points_per_earlier = 8;

/// A round of at most this many points per dimension is the first one: its order hardly matters.
constexpr std::size_t first_round_per_dimension = 64;

/// How many times the points of a round are halved: the number of splits, along one axis each, that determine
/// its order.
int num_splits(std::size_t n) { return n < 2 ? 0 : static_cast<int>(std::bit_width(n - 1)); }

}  // namespace

std::vector<Index> insertion_order(PointsView points, const Options& options,
                                   std::vector<std::size_t>* rounds) {
  switch (options.order) {
    case InsertionOrder::shuffled:
      return shuffled_order(points.size(), options.seed);
    case InsertionOrder::as_given: {
      std::vector<Index> rows(points.size());
      std::iota(rows.begin(), rows.end(), Index{0});
      return rows;
    }
    case InsertionOrder::automatic:
      break;
  }
  constexpr std::size_t enough = 20000;  // points, whose order takes a millisecond
  const bool is_left_open = options.threads == 0;
  return automatic_order(
      points, options.seed, rounds,
      is_left_open && points.size() < enough ? 1 : internal::threads_to_use(options.threads));
}

std::vector<Index> shuffled_order(std::size_t n, std::uint64_t seed) {
  std::vector<Index> rows(n);
  std::iota(rows.begin(), rows.end(), Index{0});
  // Rows are met in no order: they are prefetched some swaps before their turn.
  constexpr std::size_t ahead = 32;
  std::array<Index, ahead> places;
  random::Generator generator(seed);
  const auto draw = [&](std::size_t i) {
    if (i <= 1) return;
    const auto place = static_cast<Index>(generator.below(i));
    places[i % ahead] = place;
    internal::prefetch_for_writing(rows.data() + place);
  };
  for (std::size_t i = n; i + ahead > n && i > 1; --i) draw(i);
  for (std::size_t i = n; i > 1; --i) {
    std::swap(rows[i - 1], rows[places[i % ahead]]);
    if (i > ahead) draw(i - ahead);
  }
  return rows;
}

std::vector<Index> brio_order(PointsView points, std::uint64_t seed, std::vector<std::size_t>* rounds,
                              unsigned threads) {
  std::vector<Index> rows = shuffled_order(points.size(), seed);
  if (rows.empty()) return rows;

  const int d = points.dimension();
  const std::size_t smallest = first_round_per_dimension * static_cast<std::size_t>(d);
  std::vector<std::size_t> ends{rows.size()};
  while (ends.back() > smallest) ends.push_back(ends.back() / points_per_earlier);

  if (rounds != nullptr) rounds->assign(ends.rbegin(), ends.rend());
  std::size_t begin = 0;
  int first_axis = d - 1;
  bool backwards = false;
  for (auto end = ends.rbegin(); end != ends.rend(); ++end) {
    const std::span<Index> round(rows.data() + begin, *end - begin);
    hilbert_sort(points, round, first_axis, threads);
    // A round that ends at the end of the curve is followed by one that starts there.
    if (backwards) std::reverse(round.begin(), round.end());
    backwards = !backwards;
    // A round of fewer than 2^d points is split along some of the axes only: the next round starts with the
    // others.
    const int splits = num_splits(round.size());
    if (splits < d) first_axis = (first_axis + d - splits) % d;
    begin = *end;
  }
  return rows;
}

}  // namespace delone::order
