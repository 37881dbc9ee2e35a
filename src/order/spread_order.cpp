// SPDX-License-Identifier: BSD-3-Clause
// Rounds whose points are spread more evenly than at random, so that insertions create fewer cells
// (docs/decisions/0008-points-are-inserted-farthest-first.md).
#include "base/parallel_parts.hpp"
#include "base/random.hpp"
#include "order/farthest_first.hpp"
#include "order/insertion_order.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

namespace delone::order {
namespace {

/// Points along the curve, and the round of each: 0 is the last round; those of kept_round go on to the next
/// pass.
struct Pass {
  std::vector<Index> rows;
  std::vector<std::uint8_t> rounds;
};
/// Each round doubles the number of points.
constexpr std::uint8_t kept_round = 3;

/// The number of consecutive points of the curve from which points are chosen at a time. Larger blocks spread
/// points better, at a cost per point that is proportional to their size; this one is small against the cost
/// of an insertion.
std::size_t block_size(int dimension) { return dimension <= 3 ? 256 : dimension == 4 ? 512 : 4096; }

/// How many blocks a thread treats at a time.
std::size_t blocks_in_part(int dimension) { return 4096 / block_size(dimension); }

/// All rounds of a pass are inserted for this many consecutive points before the next stretch, so that their
/// cells stay in the cache. From 5 dimensions on stars are too large for that.
std::size_t stretch_size(int dimension) {
  return dimension <= 3 ? 1024 : dimension == 4 ? 4096 : ~std::size_t{0};
}

/// Writes the rows of a round between two places, forwards or backwards, and returns the end of the output.
/// Without a branch, as it would be unpredictable: one entry more may be overwritten.
Index* write_round(const Pass& pass, std::uint8_t round, std::size_t begin, std::size_t end, bool backwards,
                   Index* to) {
  for (std::size_t i = 0; i < end - begin; ++i) {
    const std::size_t at = backwards ? end - 1 - i : begin + i;
    *to = pass.rows[at];
    to += pass.rounds[at] == round;
  }
  return to;
}

/// Where block b of n points in num_blocks blocks begins: all but the last ones have n / num_blocks points,
/// and those one more.
std::size_t begin_of_block(std::size_t b, std::size_t n, std::size_t num_blocks) {
  const std::size_t first_larger = num_blocks - n % num_blocks;
  return b * (n / num_blocks) + (b > first_larger ? b - first_larger : 0);
}

}  // namespace

std::vector<Index> spread_order(PointsView points, std::uint64_t seed, std::vector<std::size_t>* rounds,
                                unsigned threads) {
  std::vector<Index> rows(points.size());
  std::iota(rows.begin(), rows.end(), Index{0});
  if (rows.empty()) return rows;
  const int d = points.dimension();
  hilbert_sort(points, rows, d - 1, threads);

  std::vector<Index> order(rows.size() + 1);
  Index* next = order.data();
  std::vector<Pass> passes;
  random::Generator generator(seed);
  const std::size_t largest_block = block_size(d) + block_size(d) / 2;
  const std::size_t most = std::min(largest_block, rows.size());
  std::vector<std::size_t> starts;  // of the blocks
  for (bool is_first_to_insert = false; !is_first_to_insert;) {
    const std::size_t n = rows.size(),
                      num_blocks = std::max<std::size_t>(1, (n + block_size(d) / 2) / block_size(d));
    is_first_to_insert = num_blocks == 1;
    Pass pass{std::move(rows), std::vector<std::uint8_t>(n, 0)};
    const auto begin_of = [&](std::size_t b) { return begin_of_block(b, n, num_blocks); };
    starts.clear();
    for (std::size_t b = 0; b < num_blocks; ++b)
      starts.push_back(generator.below(begin_of(b + 1) - begin_of(b)));
    internal::work_in_parts(threads, num_blocks, blocks_in_part(d), [&] {
      return [&, farthest = FarthestFirst(d, most), chosen = std::vector<std::uint32_t>(largest_block / 2)](
                 std::size_t first, std::size_t last, const internal::StopPoint& stop) mutable {
        for (std::size_t b = first; b < last; ++b) {
          stop();
          const std::size_t begin = begin_of(b), size = begin_of(b + 1) - begin;
          const std::span<const Index> block(pass.rows.data() + begin, size);
          farthest.choose(points, block, starts[b], {chosen.data(), size / 2}, stop);
          for (std::size_t c = 0; c < size / 2; ++c)
            pass.rounds[begin + chosen[c]] = c < size / 8 ? kept_round : c < size / 4 ? 2 : 1;
          if (is_first_to_insert)
            for (std::size_t c = 0; c < size / 8; ++c) *next++ = block[chosen[c]];
        }
      };
    });
    rows.assign(n, 0);
    rows.resize(
        static_cast<std::size_t>(write_round(pass, kept_round, 0, n, false, rows.data()) - rows.data()));
    passes.push_back(std::move(pass));
  }

  // A round that ends at the end of a stretch is followed by one that starts there.
  bool backwards = false;
  for (auto pass = passes.rbegin(); pass != passes.rend(); ++pass) {
    const std::size_t n = pass->rows.size(), stretch = std::min(stretch_size(d), n);
    for (std::size_t i = 0; i < n; i += stretch) {
      internal::cancellation_point();
      const std::size_t length = std::min(stretch, n - i), begin = backwards ? n - i - length : i;
      bool turned = backwards;
      for (std::uint8_t round = kept_round; round-- > 0; turned = !turned) {
        next = write_round(*pass, round, begin, begin + length, turned, next);
        // Unless there are several stretches, each round covers all of the curve.
        if (rounds != nullptr && (length == n || (i + length == n && round == 0)))
          rounds->push_back(static_cast<std::size_t>(next - order.data()));
      }
    }
    backwards = !backwards;
  }
  order.pop_back();
  return order;
}

}  // namespace delone::order
