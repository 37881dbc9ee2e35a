// SPDX-License-Identifier: BSD-3-Clause
// Damaged folders of tiles of a periodic set: what is found, at which level, and of which rows.
#include "tiles/check/check_periodic_tiles.hpp"

#include "../../io/io_support.hpp"
#include "tiles/index_file.hpp"
#include "tiles/part_file.hpp"

#include <delone/check.hpp>
#include <delone/point_sets.hpp>
#include <delone/tiles.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace delone::tiles {
namespace {

/// 60 points in the plane, and the rows 60 and 61, which are the point of row 3.
class CheckPeriodicTiles : public delone_test::TemporaryDirectory {
 protected:
  CheckPeriodicTiles() {
    std::vector<double> points = make_point_set("uniform", 2, 60, 2);
    for (int copy = 0; copy < 2; ++copy) points.insert(points.end(), {points[6], points[7]});
    TilesOptions options;
    options.tiles = 3;
    options.lattice = Lattice::box(std::vector<double>{1, 1});
    options.memory = std::uint64_t{1} << 34;
    make_tiles(PointsView(points, 2), folder_, options);
  }
  void expect_violation(int level, const std::string& message, const std::vector<std::size_t>& points) const {
    const CheckReport report = delone::check_tiles(folder_);
    EXPECT_FALSE(report.ok) << message;
    EXPECT_EQ(report.reached.number, level) << report.violation;
    EXPECT_NE(report.violation.find(message), std::string::npos) << report.violation;
    EXPECT_EQ(report.points, points);
  }
  void change_index(const std::function<void(TilesIndex&)>& change) const {
    TilesIndex index = delone::read_tiles_index(folder_);
    change(index);
    write_tiles_index(folder_, index, "a test");
  }
  void change_part(std::size_t i, const std::function<void(TileData&)>& change) const {
    TileData part = read_tile(folder_, i);
    change(part);
    const io::FileContent written = write_part(folder_, i, part);
    change_index([&](TilesIndex& index) {
      index.parts[i].num_bytes = written.num_bytes;
      index.parts[i].crc32 = written.crc32;
    });
  }
  /// The part that has the row, and its place there.
  std::pair<std::size_t, std::size_t> place_of(std::int64_t row) const {
    for (std::size_t i = 0; i < 3; ++i) {
      const std::vector<std::int64_t> rows = read_tile(folder_, i).own_rows;
      if (const auto found = std::find(rows.begin(), rows.end(), row); found != rows.end())
        return {i, static_cast<std::size_t>(found - rows.begin())};
    }
    ADD_FAILURE() << "no part has row " << row;
    return {};
  }
  void change_vertex_of(std::int64_t row, std::int64_t vertex) const {
    const auto [i, at] = place_of(row);
    change_part(i, [at = at, vertex](TileData& part) { part.vertex_of_row[at] = vertex; });
  }

  const std::string folder_ = path("out");
};

TEST_F(CheckPeriodicTiles, SoundOnesPass) {
  EXPECT_TRUE(delone::check_tiles(folder_).ok);
  EXPECT_EQ(delone::check_tiles(folder_, {.up_to = 3}).reached.number, 3);
}

TEST_F(CheckPeriodicTiles, DamagedFilesAreFoundInStorage) {
  file("out/part-0001.npz", content("out/part-0001.npz").substr(0, 300));
  expect_violation(1, "part-0001.npz", {});
}

TEST_F(CheckPeriodicTiles, PartsHaveTheSamePoints) {
  const std::vector<std::int64_t> rows = read_tile(folder_, 0).rows;
  std::int64_t shared = -1;
  change_part(1, [&](TileData& part) {
    for (std::size_t v = 0; v < part.rows.size() && shared < 0; ++v)
      if (std::find(rows.begin(), rows.end(), part.rows[v]) != rows.end()) {
        shared = part.rows[v];
        part.points[2 * v] += 1e-9;
      }
  });
  ASSERT_GE(shared, 0);
  expect_violation(2, "parts have different coordinates for point " + std::to_string(shared),
                   {static_cast<std::size_t>(shared)});
}

TEST_F(CheckPeriodicTiles, RowsAreVerticesOrDuplicatesOfThem) {
  change_vertex_of(61, 60);
  expect_violation(6, "point 61 was merged into point 60, which is no vertex", {61, 60});
  change_vertex_of(61, 61);
  expect_violation(6, "point 61 is its own vertex, but no cell has it", {61});
  change_vertex_of(61, 3);
  EXPECT_TRUE(delone::check_tiles(folder_).ok);
  change_vertex_of(7, 3);
  expect_violation(6, "point 7 is a vertex of a cell, but merged into another", {7});
}

TEST_F(CheckPeriodicTiles, RowsAreInOnePart) {
  const std::size_t part = place_of(61).first, other = part == 0 ? 1 : 0;
  change_part(other, [](TileData& data) { data.own_rows.back() = 61; });
  expect_violation(
      6, "point 61 is in " + part_name(std::min(part, other)) + " and in " + part_name(std::max(part, other)),
      {61});
}

TEST_F(CheckPeriodicTiles, TheIndexAgrees) {
  change_index([](TilesIndex& index) { ++index.num_hull_facets; });
  expect_violation(6, "there are 0 hull facets, but index.json says 1", {});
  change_index([](TilesIndex& index) {
    --index.num_hull_facets;
    index.hash.high ^= 1;
  });
  expect_violation(6, "the hash is ", {});
}

}  // namespace
}  // namespace delone::tiles
