// SPDX-License-Identifier: BSD-3-Clause
// Tiles of periodic sets against the triangulation in one piece: the hash, the counts and the cells, for
// every number of tiles and threads; and check_tiles() of the folders.
#include "periodic_tiles.hpp"
#include "error_code.hpp"
#include "memory_folder.hpp"
#include "periodic_sets.hpp"
#include "scale.hpp"

#include <delone/periodic.hpp>
#include <delone/point_sets.hpp>
#include <delone/tiles.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace delone {
namespace {

using test::cube;
using test::grid;
using test::options_of_tiles;
using test::some_weights;

class PeriodicTiles : public ::testing::Test {
 protected:
  void expect_as_in_one_piece(const std::vector<double>& points, const std::vector<double>& weights,
                              const Lattice& lattice, std::size_t tiles, unsigned threads = 1,
                              double unit = 0) {
    const std::vector<double> rows = test::rows_of(points, weights, lattice.dimension);
    const int columns = lattice.dimension + (weights.empty() ? 0 : 1);
    const std::string out = files_.file("out");
    std::filesystem::remove_all(out);
    TilesOptions how = options_of_tiles(lattice, tiles, !weights.empty(), threads);
    how.unit = unit;
    const TilesIndex index = make_tiles(PointsView(rows, columns), out, how);
    test::expect_as_in_one_piece(index, out, points, weights, lattice, unit);
  }

  test::MemoryFolder files_;
};

TEST_F(PeriodicTiles, UniformPoints) {
  for (const int d : {2, 3}) {
    const std::vector<double> points = make_point_set("uniform", d, test::scaled_size(1500, 200), 1);
    for (const std::size_t tiles : {1, 2, 5, 16}) {
      SCOPED_TRACE(std::to_string(d) + "D, tiles " + std::to_string(tiles));
      expect_as_in_one_piece(points, {}, cube(d), tiles);
    }
    expect_as_in_one_piece(points, {}, cube(d), 5, 3);
  }
}

TEST_F(PeriodicTiles, FilesDoNotDependOnThreads) {
  const std::vector<double> points = make_point_set("uniform", 3, test::scaled_size(3000, 500), 2);
  std::vector<std::int64_t> checksums[2];
  for (const unsigned threads : {1u, 3u}) {
    const std::string out = files_.file("threads" + std::to_string(threads));
    for (const TilePart& part :
         make_tiles(PointsView(points, 3), out, options_of_tiles(cube(3), 3, false, threads)).parts)
      for (const std::int64_t checksum : {part.crc32, part.seam_crc32})
        checksums[threads / 2].push_back(checksum);
  }
  EXPECT_EQ(checksums[0], checksums[1]);
}

TEST_F(PeriodicTiles, Clusters) {
  std::vector<double> points = make_point_set("plummer", 3, test::scaled_size(2000, 200), 3);
  for (const std::size_t tiles : {1, 8}) expect_as_in_one_piece(points, {}, cube(3, 8), tiles);
}

TEST_F(PeriodicTiles, LatticesWithTies) {
  for (const auto& [d, n] : {std::pair{2, 6}, std::pair{3, 4}})
    for (const std::size_t tiles : {1, 3, 8}) {
      SCOPED_TRACE(std::to_string(d) + "D, tiles " + std::to_string(tiles));
      expect_as_in_one_piece(grid(d, n), {}, cube(d), tiles);
    }
}

TEST_F(PeriodicTiles, FewPoints) {
  for (const int d : {2, 3})
    for (std::size_t n = 0; n <= 20; n += n < 4 ? 1 : 5)
      for (const std::size_t tiles : {1, 4}) {
        SCOPED_TRACE(std::to_string(d) + "D, points " + std::to_string(n) + ", tiles " +
                     std::to_string(tiles));
        expect_as_in_one_piece(make_point_set("uniform", d, n, 2), {}, cube(d), tiles);
      }
}

TEST_F(PeriodicTiles, AllBoxes) {
  const std::vector<double> fractions = test::random_fractions(3 * test::scaled_size(300, 60), 8);
  for (const auto& [name, lattice] : test::lattices_in_space())
    for (const int rank : {1, 2, 3})
      for (const std::size_t tiles : {1, 6}) {
        SCOPED_TRACE(std::string(name) + ", rank " + std::to_string(rank) + ", tiles " +
                     std::to_string(tiles));
        const Lattice some = test::of_rank(lattice, rank);
        expect_as_in_one_piece(test::at_fractions(fractions, some), {}, some, tiles);
      }
}

TEST_F(PeriodicTiles, FlatSlabs) {
  Lattice lattice{3, {1, 0, 0, 0, 1, 0}};
  std::vector<double> points;
  for (const double x : make_point_set("uniform", 2, 300, 4)) {
    points.push_back(test::coarse(x));
    if (points.size() % 3 == 2) points.push_back(0.25);
  }
  expect_as_in_one_piece(points, {}, lattice, 4);
  // Layers: all points of the top and of the bottom are on the hull.
  std::vector<double> layers = grid(3, 5);
  expect_as_in_one_piece(layers, {}, lattice, 6);
}

TEST_F(PeriodicTiles, Weights) {
  for (const int d : {2, 3}) {
    const std::size_t n = test::scaled_size(600, 100);
    std::vector<double> points = make_point_set("uniform", d, n, 6);
    for (double& x : points) x = test::coarse(x);
    for (const double size : {1e-3, 0.3})  // few points are hidden, and most
      for (const std::size_t tiles : {1, 5}) {
        SCOPED_TRACE(std::to_string(d) + "D, size " + std::to_string(size) + ", tiles " +
                     std::to_string(tiles));
        expect_as_in_one_piece(points, some_weights(n, size), cube(d), tiles);
      }
    expect_as_in_one_piece(points, std::vector<double>(n, 0.5), cube(d), 3);
    if (d == 3) expect_as_in_one_piece(points, some_weights(n, 0.05), {3, {1, 0, 0, 0, 1, 0}}, 4);
  }
}

// The finest bit of the coordinates is that of a hidden point, and the hash does not count in it.
TEST_F(PeriodicTiles, HiddenPointsOfFinerCoordinates) {
  std::vector<double> points = grid(2, 8), weights(64, 0.0);
  points.insert(points.end(), {0.3, 0.7});
  weights.push_back(-1);
  expect_as_in_one_piece(points, weights, cube(2), 4);
}

// Multiples of a tenth are ties only by their unit. Weights are not multiples of anything.
TEST_F(PeriodicTiles, Units) {
  for (const int d : {2, 3}) {
    std::vector<double> points = grid(d, 5);
    for (double& x : points) x *= .5;
    std::vector<double> weights =
        make_point_set("uniform", 1, points.size() / static_cast<std::size_t>(d), 7);
    for (double& w : weights) w *= .008;  // hides some
    for (const int rank : {d, d - 1})
      for (const std::size_t tiles : {1, 4}) {
        const Lattice lattice = test::of_rank(cube(d, .5), rank);
        expect_as_in_one_piece(points, {}, lattice, tiles, 1, .1);
        expect_as_in_one_piece(points, weights, lattice, tiles, 1, .1);
      }
  }
}

TEST_F(PeriodicTiles, DuplicatesAndPointsOutside) {
  std::vector<double> points = make_point_set("uniform", 3, 200, 9);
  for (double& x : points) x = test::coarse(x);
  std::vector<double> all = points;
  for (std::size_t i = 0; i < 90; ++i) all.push_back(points[i] + (i % 3 == 0 ? 5.0 : -1.0));
  expect_as_in_one_piece(all, {}, cube(3), 4);
}

TEST_F(PeriodicTiles, DamagedFoldersAreMadeAgain) {
  const std::vector<double> points = make_point_set("uniform", 3, 500, 1);
  const std::string out = files_.file("out");
  const TilesIndex index = make_tiles(PointsView(points, 3), out, options_of_tiles(cube(3), 4));
  const std::string path = out + "/part-0002.seams.npy";
  std::filesystem::remove(path);
  std::filesystem::resize_file(out + "/part-0001.npz", 100);
  EXPECT_FALSE(check_tiles(out).ok);
  const TilesIndex again = make_tiles(PointsView(points, 3), out, options_of_tiles(cube(3), 4));
  EXPECT_EQ(again.hash, index.hash);
  EXPECT_TRUE(check_tiles(out).ok);
}

TEST_F(PeriodicTiles, WrongFoldersAreFound) {
  const std::vector<double> points = make_point_set("uniform", 3, 500, 1);
  const std::string out = files_.file("out");
  make_tiles(PointsView(points, 3), out, options_of_tiles(cube(3), 4));
  EXPECT_EQ(test::code_of([&] { make_tiles(PointsView(points, 3), out, options_of_tiles(cube(3, 2), 4)); }),
            Errc::invalid_argument);
  const std::vector<double> others = make_point_set("uniform", 3, 500, 2);
  EXPECT_EQ(test::code_of([&] { make_tiles(PointsView(others, 3), out, options_of_tiles(cube(3), 4)); }),
            Errc::invalid_argument);
  EXPECT_EQ(test::code_of([&] { make_tiles(PointsView(points, 3), out, options_of_tiles({}, 4)); }),
            Errc::invalid_argument);
  TilesOptions with_unit = options_of_tiles(cube(3), 4);
  with_unit.unit = 1e-6;
  EXPECT_EQ(test::code_of([&] { make_tiles(PointsView(points, 3), out, with_unit); }),
            Errc::invalid_argument);
  EXPECT_EQ(test::code_of([&] { make_tiles(PointsView(points, 3), out, options_of_tiles(cube(2), 4)); }),
            Errc::bad_dimension);
  EXPECT_EQ(test::code_of([&] { check_tiles(out, PointsView(points, 3)); }), Errc::unsupported);
  std::ifstream in(out + "/index.json");
  std::string text((std::istreambuf_iterator<char>(in)), {});
  const std::size_t at = text.find("\"hash\": \"") + 9;
  text[at] = text[at] == '0' ? '1' : '0';
  std::ofstream(out + "/index.json") << text;
  const CheckReport report = check_tiles(out);
  EXPECT_FALSE(report.ok);
  EXPECT_EQ(report.reached.number, 6) << report;
}

TEST_F(PeriodicTiles, WhatTilesDoNotTake) {
  const std::vector<double> points = make_point_set("uniform", 3, 50, 1);
  TilesOptions how = options_of_tiles(cube(3), 2);
  how.vtu = true;
  EXPECT_EQ(test::code_of([&] { make_tiles(PointsView(points, 3), files_.file("vtu"), how); }),
            Errc::unsupported);
  const std::vector<double> many = make_point_set("uniform", 8, 50, 1);
  EXPECT_EQ(test::code_of(
                [&] { make_tiles(PointsView(many, 8), files_.file("high"), options_of_tiles(cube(8), 2)); }),
            Errc::unsupported);
}

}  // namespace
}  // namespace delone
