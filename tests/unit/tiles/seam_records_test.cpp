// SPDX-License-Identifier: BSD-3-Clause
// Pairs of equal facets, and what cannot be one.
#include "tiles/seam_records.hpp"

#include "../io/io_support.hpp"

#include <algorithm>
#include <set>
#include <utility>
#include <vector>

namespace delone_test {
namespace {

using namespace delone;

class SeamRecords : public TemporaryDirectory {};

/// Records of edges: two vertices, tile, cell, index, seam. Returns the pairs of cells.
std::set<std::pair<std::int64_t, std::int64_t>> pairs_of(const std::vector<std::int64_t>& words) {
  std::set<std::pair<std::int64_t, std::int64_t>> pairs;
  tiles::match_seam_records(words, 2, 0,
                            [&](std::span<const std::int64_t> a, std::span<const std::int64_t> b) {
                              pairs.insert(std::minmax(a[3], b[3]));
                            });
  return pairs;
}

TEST_F(SeamRecords, OfEqualVerticesArePairs) {
  using Pairs = std::set<std::pair<std::int64_t, std::int64_t>>;
  EXPECT_EQ(pairs_of({5, 7, 0, 10, 2, 0, 5, 8, 0, 11, 1, 1, 5, 7, 1, 20, 0, 0}), (Pairs{{10, 20}, {11, 11}}));
  EXPECT_EQ(pairs_of({}), Pairs{});
}

TEST_F(SeamRecords, OfThreeCellsOrOneTileAreErrors) {
  expect_error(Errc::bad_format,
               {"the facet {5, 7} is that of cell 10 of tile 0, cell 20 of tile 1 and cell 30 of tile 2"},
               [] {
                 pairs_of({5, 7, 0, 10, 2, 0, 5, 7, 1, 20, 0, 0, 5, 7, 2, 30, 0, 0});
               });
  expect_error(Errc::bad_format, {"the seam {5, 7} of tile 4 is between its own cells 10 and 20"}, [] {
    pairs_of({5, 7, 4, 10, 2, 0, 5, 7, 4, 20, 0, 1});
  });
}

TEST_F(SeamRecords, HeadersFitTheirFiles) {
  const auto write = [&](const std::vector<std::int64_t>& words) {
    file(tiles::seam_records_name(0),
         {reinterpret_cast<const char*>(words.data()), words.size() * sizeof(std::int64_t)});
  };
  write({1, 0, 2, 7, 0, 10, 2, 0, 8, 0, 11, 1, 1});
  tiles::SeamReader reader(path("."), 0);
  EXPECT_EQ(reader.header().k, 1);
  EXPECT_EQ(reader.header().count, 2);
  std::vector<std::int64_t> cells;
  reader.for_each([&](std::span<const std::int64_t> record) { cells.push_back(record[2]); });
  EXPECT_EQ(cells, (std::vector<std::int64_t>{10, 11}));
  expect_error(Errc::bad_format, {"a record {1, 2} out of range"}, [&] {
    reader.refuse(std::vector<std::int64_t>{1, 2});
  });
  const std::int64_t huge = std::int64_t{1} << 31;
  for (const std::vector<std::int64_t>& words :
       std::vector<std::vector<std::int64_t>>{{1, 0, 3, 7, 0, 10, 2, 0, 8, 0, 11, 1, 1},
                                              {-4, 0, 2},
                                              {1, 0, -1},
                                              {1, -1, 0},
                                              {huge, 0, 0},
                                              {0, 0, huge},
                                              {2, 0, 1, 7, 0, 10, 2, 0}}) {
    write(words);
    expect_error(Errc::bad_format, {"damaged or truncated"}, [&] { tiles::SeamReader(path("."), 0); });
  }
}

}  // namespace
}  // namespace delone_test
