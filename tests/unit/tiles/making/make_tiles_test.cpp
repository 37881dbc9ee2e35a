// SPDX-License-Identifier: BSD-3-Clause
// Folders from arrays in memory: the hash of the whole, whatever the number of tiles and threads.
#include "base/platform.hpp"
#include "degenerate.hpp"
#include "memory_folder.hpp"
#include "scale.hpp"

#include <delone/delaunay.hpp>
#include <delone/regular.hpp>
#include <delone/tiles.hpp>

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

namespace {

using namespace delone;

class MakeTiles : public ::testing::Test {
 protected:
  std::string folder(const std::string& name) { return files_.file(name); }
  test::MemoryFolder files_;
};

TEST_F(MakeTiles, Hashes) {
  for (const test::PointSet& set : test::degenerate_sets(3, test::scaled_size(60, 15), 9)) {
    SCOPED_TRACE(set.name);
    const std::string out = folder("out");
    TilesOptions options;
    options.tiles = 4;
    options.memory = std::uint64_t{1} << 34;
    const TilesIndex index = make_tiles(PointsView(set.points, 3), out, options);
    const Delaunay<> whole(set.points, 3);
    EXPECT_EQ(index.hash, whole.hash());
    EXPECT_EQ(index.num_cells, static_cast<std::int64_t>(whole.num_finite_cells()));
    EXPECT_EQ(index.num_duplicates, static_cast<std::int64_t>(whole.num_duplicates()));
    if (index.affine_dimension > 0) {
      EXPECT_EQ(index.num_hull_facets, static_cast<std::int64_t>(whole.num_infinite_cells()));
    }
    EXPECT_EQ(read_tiles_index(out).hash, index.hash);
    std::filesystem::remove_all(out);
  }
}

TEST_F(MakeTiles, GoesOn) {
  const std::vector<double> points = make_point_set("uniform", 2, 3000, 1);
  TilesOptions options;
  options.tiles = 5;
  options.memory = std::uint64_t{1} << 34;
  int forecasts = 0;
  options.forecast = [&](const TilesForecast& forecast) {
    EXPECT_EQ(forecast.num_tiles, 5u);
    ++forecasts;
    return true;
  };
  const std::string out = folder("out");
  options.progress = [&](double) { return !std::filesystem::exists(out + "/part-0002.npz"); };
  try {
    make_tiles(PointsView(points, 2), out, options);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::cancelled);
  }
  const bool was_stopped = std::filesystem::exists(out + "/work");
  const auto first = was_stopped ? std::filesystem::last_write_time(out + "/part-0000.npz")
                                 : std::filesystem::file_time_type{};
  options.progress = {};
  const TilesIndex index = make_tiles(PointsView(points, 2), out, options);
  EXPECT_EQ(index.hash, Delaunay<>(points, 2).hash());
  EXPECT_FALSE(std::filesystem::exists(out + "/work"));
  if (was_stopped) {
    EXPECT_EQ(std::filesystem::last_write_time(out + "/part-0000.npz"), first);
  }
  // Finished: nothing is done again.
  EXPECT_EQ(make_tiles(PointsView(points, 2), out, options).hash, index.hash);
  // Other points.
  EXPECT_THROW(make_tiles(PointsView(std::span(points).first(100), 2), out, options), Error);
  EXPECT_GE(forecasts, 2);
}

TEST_F(MakeTiles, GoesOnAfterDamage) {
  const std::vector<double> points = make_point_set("uniform", 2, 3000, 1);
  const CanonicalHash hash = Delaunay<>(points, 2).hash();
  for (const std::string damaged : {"part-0001.npz", "work/points.bin", "work/points.bin.duplicates",
                                    "work/pages.bin", "work/seams-0001.bin", "work/tile-0001.json"})
    for (const bool flips : {false, true}) {
      SCOPED_TRACE(damaged);
      const std::string out = folder("out"), path = out + "/" + damaged;
      TilesOptions options;
      options.tiles = 5;
      options.memory = std::uint64_t{1} << 34;
      std::vector<std::string> told;
      options.damage = [&](const std::vector<std::string>& files) {
        told = files;
        return true;
      };
      options.progress = [&](double) { return !std::filesystem::exists(out + "/work/tile-0002.json"); };
      try {
        make_tiles(PointsView(points, 2), out, options);
        continue;  // it was not asked in time
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), Errc::cancelled);
      }
      std::string bytes = test::content(path);
      if (bytes.empty()) bytes = "?";
      if (flips)
        bytes[bytes.size() / 3] ^= 1;
      else
        bytes.resize(bytes.size() / 2);
      std::ofstream(path, std::ios::binary) << bytes;
      options.progress = {};
      EXPECT_EQ(make_tiles(PointsView(points, 2), out, options).hash, hash);
      const bool is_told = damaged.starts_with("part") || damaged.starts_with("work/seams");
      ASSERT_EQ(told.size(), is_told ? 1u : 0u);
      if (is_told) {
        EXPECT_NE(told[0].find(damaged), std::string::npos);
      }
      EXPECT_TRUE(check_tiles(out).ok);
      std::filesystem::remove_all(out);
    }
}

TEST_F(MakeTiles, Weights) {
  const std::vector<double> points = make_point_set("uniform", 3, 500, 1);
  std::vector<double> rows, weights;
  test::Random random(1);
  for (std::size_t i = 0; i < 500; ++i) {
    rows.insert(rows.end(), {points[3 * i], points[3 * i + 1], points[3 * i + 2]});
    weights.push_back(0.05 * random.real());
    rows.push_back(weights.back());
  }
  TilesOptions options;
  options.tiles = 3;
  options.memory = std::uint64_t{1} << 34;
  options.weighted = true;
  const TilesIndex index = make_tiles(PointsView(rows, 4), folder("out"), options);
  const Regular<> whole(points, weights, 3);
  EXPECT_EQ(index.hash, whole.hash());
  EXPECT_EQ(index.num_hidden, static_cast<std::int64_t>(whole.num_hidden()));
  EXPECT_GT(index.num_hidden, 0);
}

TEST_F(MakeTiles, TooLittleMemory) {
  if (platform::resident_memory() == 0) GTEST_SKIP() << "the system does not tell how much memory is in use";
  const std::vector<double> points = make_point_set("uniform", 3, test::scaled_size(20000, 1000), 1);
  TilesOptions options;
  options.memory = 1 << 20;  // less than the program itself
  try {
    make_tiles(PointsView(points, 3), folder("out"), options);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::out_of_memory);
  }
}

}  // namespace
