// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/vtu_parts.hpp"

#include "../io/io_support.hpp"
#include "tiles_support.hpp"

#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

namespace {

using namespace delone;
using namespace delone_test;

class VtuParts : public TemporaryDirectory {};

/// The appended arrays of a .vtu file, in their order.
std::vector<std::string> appended(const std::string& vtu) {
  const std::string mark = "<AppendedData encoding=\"raw\">\n_", end = "\n  </AppendedData>\n</VTKFile>\n";
  std::string bytes = vtu.substr(vtu.find(mark) + mark.size());
  EXPECT_TRUE(bytes.ends_with(end));
  bytes.resize(bytes.size() - end.size());
  std::vector<std::string> arrays;
  for (std::size_t at = 0; at < bytes.size();) {
    std::uint64_t size = 0;
    std::memcpy(&size, bytes.data() + at, 8);
    arrays.push_back(bytes.substr(at + 8, size));
    at += 8 + size;
  }
  return arrays;
}

TEST_F(VtuParts, HaveRowsAndGlobalCells) {
  write_folder(path("out"), Delaunay<>(make_point_set("uniform", 2, 100), 2).to_data(), 3);
  const TilesIndex index = read_tiles_index(path("out"));
  tiles::write_vtu_parts(path("out"), index);
  for (std::size_t i = 0; i < 3; ++i) {
    const TileData part = read_tile(path("out"), i);
    const std::string name = "part-000" + std::to_string(i) + ".vtu";
    EXPECT_NE(content("out/tiles.pvtu").find("<Piece Source=\"" + name + "\"/>"), std::string::npos);
    const std::vector<std::string> arrays = appended(content("out/" + name));
    ASSERT_EQ(arrays.size(), 6u);
    std::vector<std::int64_t> rows(part.rows.size()), cells(part.num_cells());
    ASSERT_EQ(arrays[0].size(), 8 * rows.size());
    ASSERT_EQ(arrays[1].size(), 8 * cells.size());
    std::memcpy(rows.data(), arrays[0].data(), arrays[0].size());
    std::memcpy(cells.data(), arrays[1].data(), arrays[1].size());
    EXPECT_EQ(rows, part.rows);
    EXPECT_EQ(cells.front(), index.parts[i].first_cell);
    EXPECT_EQ(cells.back(), index.parts[i].first_cell + index.parts[i].num_cells - 1);
    EXPECT_EQ(arrays[2].size(), 24 * rows.size());
    EXPECT_EQ(arrays[3].size(), 4 * part.cells.size());
    EXPECT_EQ(arrays[4].size(), 8 * cells.size());
    EXPECT_EQ(arrays[5], std::string(cells.size(), '\x05'));
  }
}

TEST_F(VtuParts, HaveAtMostThreeDimensions) {
  write_folder(path("out"), Delaunay<>(make_point_set("uniform", 4, 20), 4).to_data(), 2);
  expect_error(Errc::unsupported, {"tiles.pvtu", "3 dimensions"},
               [&] { tiles::write_vtu_parts(path("out"), read_tiles_index(path("out"))); });
}

}  // namespace
