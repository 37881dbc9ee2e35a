// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/index_file.hpp"

#include "../io/io_support.hpp"

#include <gtest/gtest.h>

namespace {

using namespace delone;
using namespace delone_test;

class IndexFile : public TemporaryDirectory {
 protected:
  IndexFile() {
    index_.dimension = 3;
    index_.affine_dimension = 2;
    index_.weighted = true;
    index_.num_points = 1000000000000;
    index_.num_vertices = 999999999989;
    index_.num_duplicates = 10;
    index_.num_hidden = 1;
    index_.num_cells = 7000000000000;
    index_.num_hull_facets = 77;
    index_.hash = {0x0123456789abcdef, 0xfedcba9876543210};
    index_.parts = {
        {"part-0000.npz", 0, 6000000000000, 1000, 999, 5, 6, 5000000000000, 0xffffffff, 88, 7},
        {"part-0001.npz", 6000000000000, 1000000000000, 999999999000, 999999998990, 0, 0, 0, 0, 99, 0}};
    tiles::write_tiles_index(path("."), index_, "input");
  }
  /// The file with one text in place of another.
  void expect_refused(const std::string& from, const std::string& to, const std::vector<std::string>& parts) {
    std::string text = content("index.json");
    const std::string whole = text;
    const auto at = text.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    file("index.json", text.replace(at, from.size(), to));
    expect_error(Errc::bad_format, parts, [&] { read_tiles_index(path(".")); });
    file("index.json", whole);
  }
  TilesIndex index_;
};

TEST_F(IndexFile, IsReadAsWritten) {
  std::string fingerprint;
  const TilesIndex read = tiles::read_tiles_index(path("."), fingerprint);
  EXPECT_EQ(fingerprint, "input");
  EXPECT_EQ(read.hash, index_.hash);
  EXPECT_EQ(read.dimension, 3);
  EXPECT_EQ(read.affine_dimension, 2);
  EXPECT_TRUE(read.weighted);
  EXPECT_EQ(read.num_points, index_.num_points);
  EXPECT_EQ(read.num_vertices, index_.num_vertices);
  EXPECT_EQ(read.num_hull_facets, 77);
  ASSERT_EQ(read.parts.size(), 2u);
  EXPECT_EQ(read.parts[1].file, "part-0001.npz");
  EXPECT_EQ(read.parts[1].first_cell, 6000000000000);
  EXPECT_EQ(read.parts[0].num_foreign, 5);
  EXPECT_EQ(read.parts[0].num_rounds, 6);
  EXPECT_EQ(read.parts[0].num_bytes, 5000000000000);
  EXPECT_EQ(read.parts[0].crc32, 0xffffffff);
  EXPECT_EQ(read.parts[1].num_seam_bytes, 99);
  EXPECT_EQ(read.parts[0].seam_crc32, 7);
}

TEST_F(IndexFile, ImpossibleNumbersAreRefused) {
  expect_refused("\"delone tiles\"", "\"else\"", {"not an index"});
  expect_refused("\"dimension\": 3", "\"dimension\": 0", {"dimension"});
  expect_refused("\"affine_dimension\": 2", "\"affine_dimension\": 4", {"affine_dimension"});
  expect_refused("\"weighted\": true", "\"weighted\": 1", {"weighted", "true or false"});
  expect_refused("\"weighted\": true", "\"weighted\": false", {"num_hidden"});
  expect_refused("\"num_hidden\": 1", "\"num_hidden\": 2", {"num_points"});
  expect_refused("\"num_hull_facets\": 77", "\"num_hull_facets\": 7.5", {"num_hull_facets"});
  expect_refused("\"num_hull_facets\": 77", "\"num_hull_facets\": 18446744073709551615", {"num_hull_facets"});
  expect_refused("0123456789abcdef", "0123456789abcde", {"hash", "hexadecimal"});
  expect_refused("\"first_cell\": 6000000000000", "\"first_cell\": 6000000000001",
                 {"parts[1]", "first_cell"});
  expect_refused("part-0001", "../../part-0001", {"parts[1]", "file"});
  expect_refused("\"num_rounds\": 6", "\"rounds\": 6", {"no member 'num_rounds'"});
  expect_refused("\"crc32\": 4294967295", "\"crc32\": 4294967296", {"parts[0]", "crc32"});
  expect_refused("\"seam_crc32\": 7", "\"crc\": 7", {"no member 'seam_crc32'"});
  expect_refused("\"num_bytes\": 5", "\"num_bytes\": -5", {"num_bytes"});
  expect_refused("\"num_vertices\": 999,", "\"num_vertices\": 998,", {"num_vertices"});
  expect_refused("{", "", {"index.json"});
  expect_refused("\"parts\": [", "\"parts\": 3, \"more\": [", {"parts", "an array"});
  expect_error(Errc::cannot_open, {"index.json"}, [&] { read_tiles_index(path("nowhere")); });
  expect_error(Errc::invalid_argument, {"no part 2"}, [&] { read_tile(path("."), 2); });
}

}  // namespace
