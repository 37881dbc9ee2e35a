// SPDX-License-Identifier: BSD-3-Clause
// Arrays of any size between all ranks, in pieces that are smaller than they are.
#include "ranks.hpp"

#include <delone/error.hpp>

#include <gtest/gtest.h>

#include <cstdint>
#include <new>
#include <string>
#include <vector>

namespace {

using namespace delone;
using mpi::Ranks;

/// What rank `from` sends to rank `to`: of another length for each pair, some empty.
std::vector<std::int64_t> array_of(int from, int to) {
  std::vector<std::int64_t> items(static_cast<std::size_t>((from * 7 + to * 5) % 11) * 3);
  for (std::size_t i = 0; i < items.size(); ++i) items[i] = from * 1000000 + to * 1000 + static_cast<int>(i);
  return items;
}

TEST(Ranks, ExchangesArraysInPieces) {
  for (const std::uint64_t piece_bytes : {std::uint64_t{8}, std::uint64_t{40}, std::uint64_t{1} << 29}) {
    Ranks ranks(MPI_COMM_WORLD, piece_bytes);
    std::vector<std::vector<std::int64_t>> to_each;
    std::size_t sent = 0, messages = 0;
    for (int to = 0; to < ranks.size(); ++to) {
      to_each.push_back(array_of(ranks.rank(), to));
      const std::size_t bytes = to_each.back().size() * sizeof(std::int64_t);
      if (to != ranks.rank()) sent += bytes, messages += (bytes + piece_bytes - 1) / piece_bytes;
    }
    const auto in = ranks.exchange(to_each);
    for (int from = 0; from < ranks.size(); ++from)
      EXPECT_EQ(in[static_cast<std::size_t>(from)], array_of(from, ranks.rank()));
    EXPECT_EQ(ranks.bytes_sent(), static_cast<std::int64_t>(sent));
    EXPECT_EQ(ranks.num_messages(), static_cast<std::int64_t>(messages));
    EXPECT_EQ(ranks.sum(ranks.bytes_sent()), ranks.sum(ranks.bytes_received()));
  }
}

TEST(Ranks, GathersAndBroadcastsInPieces) {
  for (const std::uint64_t piece_bytes : {std::uint64_t{8}, std::uint64_t{40}, std::uint64_t{1} << 29}) {
    const Ranks ranks(MPI_COMM_WORLD, piece_bytes);
    std::vector<std::int64_t> expected;
    for (int r = 0; r < ranks.size(); ++r)
      for (const std::int64_t item : array_of(r, 1)) expected.push_back(item);
    EXPECT_EQ(ranks.gather(array_of(ranks.rank(), 1)), expected);
    std::vector<std::int64_t> items = array_of(ranks.rank(), 1);
    ranks.broadcast(items);
    EXPECT_EQ(items, array_of(0, 1));
    std::string text = ranks.rank() == 0 ? "of rank 0" : "another";
    ranks.broadcast(text);
    EXPECT_EQ(text, "of rank 0");
  }
}

TEST(Ranks, ReducesNumbers) {
  const Ranks ranks(MPI_COMM_WORLD);
  const int n = ranks.size(), r = ranks.rank();
  EXPECT_EQ(ranks.sum(r + 1), n * (n + 1) / 2);
  EXPECT_EQ(ranks.sum_before(r + 1), r * (r + 1) / 2);
  EXPECT_EQ(ranks.max(r), n - 1);
  EXPECT_EQ(ranks.min(r), 0);
  EXPECT_EQ(ranks.max_real(r * 0.5), (n - 1) * 0.5);
  EXPECT_EQ(ranks.min_real(-r * 0.5), (1 - n) * 0.5);
  EXPECT_EQ(ranks.max({r, -r}), (std::vector<std::int64_t>{n - 1, 0}));
}

TEST(Ranks, ThrowTogether) {
  const Ranks ranks(MPI_COMM_WORLD);
  ranks.together([] {});
  const int last = ranks.size() - 1;
  try {
    ranks.together([&] {
      if (ranks.rank() == last) throw Error(Errc::bad_format, "no good", {4, 2});
    });
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::bad_format);
    EXPECT_EQ(error.what(),
              last == 0 ? std::string("no good") : "rank " + std::to_string(last) + ": no good");
    EXPECT_EQ(error.rows(), (std::vector<std::size_t>{4, 2}));
  }
  try {
    ranks.together([] { throw std::bad_alloc(); });
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::out_of_memory);
    EXPECT_EQ(error.what(), std::string("not enough memory"));
  }
}

}  // namespace
