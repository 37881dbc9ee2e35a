// SPDX-License-Identifier: BSD-3-Clause
// Tiles of periodic sets by all ranks: the triangulation in one piece, for any share of the rows and number
// of tiles. Every rank runs every test; rank 0 compares.
#include "periodic_tiles.hpp"

#include <delone/mpi/tiles.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "mpi_folder.hpp"
#include "scale.hpp"

namespace {

using namespace delone;
using test::cube;
using test::grid;
using test::num_ranks;
using test::options_of_tiles;
using test::rank_of;

class PeriodicMpiTiles : public test::MpiTiles {
 protected:
  /// By turns as few tiles as possible, and more than ranks.
  void expect_as_in_one_piece(const std::vector<double>& points, const std::vector<double>& weights,
                              const Lattice& lattice, double unit = 0) {
    ++number_;
    SCOPED_TRACE("set " + std::to_string(number_) + ", rank " + std::to_string(rank_of()));
    const std::vector<double> rows = test::rows_of(points, weights, lattice.dimension);
    const int columns = lattice.dimension + (weights.empty() ? 0 : 1);
    const std::string out = path(std::to_string(number_));
    TilesOptions how = options_of_tiles(lattice, number_ % 2 == 0 ? 0 : 7, !weights.empty());
    how.unit = unit;
    const TilesIndex index =
        mpi::make_tiles(test::rows_of_rank(rows, columns, number_), out, MPI_COMM_WORLD, how);
    std::array<std::uint64_t, 2> first{index.hash.high, index.hash.low};
    MPI_Bcast(first.data(), 2, MPI_UINT64_T, 0, MPI_COMM_WORLD);
    EXPECT_EQ(first, (std::array<std::uint64_t, 2>{index.hash.high, index.hash.low}));
    if (rank_of() == 0) test::expect_as_in_one_piece(index, out, points, weights, lattice, unit);
    MPI_Barrier(MPI_COMM_WORLD);
  }

  std::uint64_t number_ = 0;
};

std::vector<double> coarse(std::vector<double> points) {
  for (double& x : points) x = test::coarse(x);
  return points;
}

TEST_F(PeriodicMpiTiles, UniformPoints) {
  for (const int d : {2, 3, 4}) {
    const std::vector<double> points = make_point_set("uniform", d, test::scaled_size(d == 4 ? 60 : 300, 40));
    for (int turn = 0; turn < 2; ++turn) expect_as_in_one_piece(points, {}, cube(d));
  }
}

TEST_F(PeriodicMpiTiles, ClustersAndTies) {
  const std::vector<double> clusters = make_point_set("plummer", 3, test::scaled_size(300, 60), 3);
  for (int turn = 0; turn < 2; ++turn) {
    expect_as_in_one_piece(clusters, {}, cube(3, 8));
    expect_as_in_one_piece(grid(2, 6), {}, cube(2));
  }
  expect_as_in_one_piece(grid(3, 4), {}, cube(3));
}

// Fewer than ranks, and none.
TEST_F(PeriodicMpiTiles, FewPoints) {
  for (const int d : {2, 3})
    for (const std::size_t n : {0, 1, 2, 3, 7})
      for (int turn = 0; turn < 2; ++turn)
        expect_as_in_one_piece(make_point_set("uniform", d, n, 2), {}, cube(d));
  expect_as_in_one_piece({.25, .5, .75}, {}, test::of_rank(cube(3), 2));
}

TEST_F(PeriodicMpiTiles, AllBoxes) {
  const std::vector<double> fractions = test::random_fractions(3 * test::scaled_size(90, 30), 8);
  for (const auto& [name, lattice] : test::lattices_in_space())
    for (const int rank : {1, 2, 3}) {
      SCOPED_TRACE(std::string(name) + ", rank " + std::to_string(rank));
      const Lattice some = test::of_rank(lattice, rank);
      expect_as_in_one_piece(test::at_fractions(fractions, some), {}, some);
    }
}

TEST_F(PeriodicMpiTiles, AllAxes) {
  const std::vector<double> points = coarse(make_point_set("uniform", 3, test::scaled_size(120, 30), 5)),
                            sides{1, 2, .5};
  for (int chosen = 1; chosen < 8; ++chosen) {
    std::vector<int> axes;
    for (int axis = 0; axis < 3; ++axis)
      if ((chosen >> axis & 1) != 0) axes.push_back(axis);
    expect_as_in_one_piece(points, {}, Lattice::box(sides, axes));
  }
}

// What one rank alone sees of the directions that are not periodic does not settle the grid of all.
TEST_F(PeriodicMpiTiles, OnePointIsFarOff) {
  std::vector<double> points = make_point_set("uniform", 2, 60, 4);
  points.push_back(.5);
  points.push_back(1e6);
  for (int turn = 0; turn < 4; ++turn)
    expect_as_in_one_piece(points, {}, Lattice::box(std::vector<double>{1, 1}, std::vector<int>{0}));
}

TEST_F(PeriodicMpiTiles, FlatSlabs) {
  std::vector<double> points;
  for (const double x : make_point_set("uniform", 2, 100, 4)) {
    points.push_back(test::coarse(x));
    if (points.size() % 3 == 2) points.push_back(0.25);
  }
  const Lattice slab = test::of_rank(cube(3), 2);
  for (int turn = 0; turn < 2; ++turn) expect_as_in_one_piece(points, {}, slab);
  expect_as_in_one_piece(grid(3, 3), {}, slab);
}

TEST_F(PeriodicMpiTiles, Weights) {
  for (const int d : {2, 3}) {
    const std::size_t n = test::scaled_size(150, 40);
    const std::vector<double> points = coarse(make_point_set("uniform", d, n, 6));
    for (const double size : {1e-3, 0.3})
      expect_as_in_one_piece(points, test::some_weights(n, size), cube(d));
    expect_as_in_one_piece(points, std::vector<double>(n, 0.5), cube(d));
    expect_as_in_one_piece(points, test::some_weights(n, 0.05), test::of_rank(cube(d), d - 1));
  }
}

TEST_F(PeriodicMpiTiles, Units) {
  std::vector<double> points = grid(3, 4);
  for (double& x : points) x *= .4;
  std::vector<double> weights = make_point_set("uniform", 1, 64, 7);
  for (double& w : weights) w *= .008;  // hides some
  for (const int rank : {2, 3})
    for (int turn = 0; turn < 2; ++turn) {
      expect_as_in_one_piece(points, {}, test::of_rank(cube(3, .4), rank), .1);
      expect_as_in_one_piece(points, weights, test::of_rank(cube(3, .4), rank), .1);
    }
}

// The finest bit of the coordinates is that of a hidden point of one rank, and the hash does not count in it.
TEST_F(PeriodicMpiTiles, HiddenPointsOfFinerCoordinates) {
  std::vector<double> points = grid(2, 8), weights(64, 0.0);
  points.insert(points.end(), {0.3, 0.7});
  weights.push_back(-1);
  for (int turn = 0; turn < 2; ++turn) expect_as_in_one_piece(points, weights, cube(2));
  // And one rank alone has the vertex of the finest bit.
  points[0] = 0x1p-10;
  for (int turn = 0; turn < 2; ++turn) expect_as_in_one_piece(points, weights, cube(2));
}

TEST_F(PeriodicMpiTiles, DuplicatesAndPointsOutside) {
  const std::vector<double> points = coarse(make_point_set("uniform", 3, 100, 9));
  std::vector<double> all = points;
  for (std::size_t i = 0; i < 90; ++i) all.push_back(points[i] + (i % 3 == 0 ? 5.0 : -1.0));
  for (int turn = 0; turn < 2; ++turn) expect_as_in_one_piece(all, {}, cube(3));
}

// Equal positions at different ranks, the last of them the heaviest: also where tiles begin with them.
TEST_F(PeriodicMpiTiles, HeavierDuplicates) {
  const std::vector<double> some = coarse(make_point_set("uniform", 2, 20, 9));
  std::vector<double> points, weights;
  for (int copy = 0; copy < 4; ++copy) {
    points.insert(points.end(), some.begin(), some.end());
    weights.insert(weights.end(), 20, 0.001 * copy);
  }
  for (int turn = 0; turn < 2; ++turn) {
    expect_as_in_one_piece(points, weights, cube(2));
    expect_as_in_one_piece(points, weights, test::of_rank(cube(2), 1));
  }
}

TEST_F(PeriodicMpiTiles, ReadsFiles) {
  const std::vector<double> points = make_point_set("uniform", 2, 200);
  if (rank_of() == 0) {
    std::ofstream text(path("whole.txt"));
    text.precision(17);
    for (std::size_t i = 0; i < points.size(); i += 2) text << points[i] << ' ' << points[i + 1] << '\n';
    std::ofstream raw(path("whole.raw"), std::ios::binary);
    raw.write(reinterpret_cast<const char*>(points.data()),
              static_cast<std::streamsize>(points.size() * sizeof(double)));
  }
  MPI_Barrier(MPI_COMM_WORLD);
  for (const std::string name : {"whole.txt", "whole.raw"}) {
    TilesOptions how = options_of_tiles(cube(2), 3);
    how.columns = 2;
    const TilesIndex index = mpi::make_tiles({path(name)}, path(name + ".out"), MPI_COMM_WORLD, how);
    if (rank_of() == 0) test::expect_as_in_one_piece(index, path(name + ".out"), points, {}, cube(2));
  }
}

TEST_F(PeriodicMpiTiles, GoesOnWithWhatIsThere) {
  const std::vector<double> points = make_point_set("uniform", 3, 400);
  const std::string out = path("out");
  TilesOptions how = options_of_tiles(cube(3), 4 * static_cast<std::size_t>(num_ranks()));
  how.progress = [&](double) { return !std::filesystem::exists(out + "/work/tile-0001.json"); };
  const auto make = [&](const Lattice& lattice, std::uint64_t seed, mpi::RankEffort* effort = nullptr) {
    how.lattice = lattice;
    return mpi::make_tiles(test::rows_of_rank(points, 3, seed), out, MPI_COMM_WORLD, how, effort);
  };
  EXPECT_THROW(make(cube(3), 1), Error);
  MPI_Barrier(MPI_COMM_WORLD);
  how.progress = {};
  const auto expect_refused = [&] {
    how.unit = 1e-6;
    EXPECT_THROW(make(cube(3), 2), Error);
    how.unit = 0;
    for (const Lattice& other :
         {cube(3, 2), test::of_rank(cube(3), 2), Lattice{}, Lattice{3, {0, 1, 0, 1, 0, 0, 0, 0, 1}}}) {
      try {
        make(other, 2);
        ADD_FAILURE() << "no error";
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), Errc::invalid_argument) << error.what();
        EXPECT_NE(std::string(error.what()).find("lattice"), std::string::npos) << error.what();
      }
    }
  };
  expect_refused();
  mpi::RankEffort effort;
  const TilesIndex index = make(cube(3), 3, &effort);
  if (rank_of() == 0) {
    EXPECT_LE(effort.num_tiles, 3);
    test::expect_as_in_one_piece(index, out, points, {}, cube(3));
  }
  MPI_Barrier(MPI_COMM_WORLD);
  expect_refused();
  EXPECT_EQ(make(cube(3), 4, &effort).hash, index.hash);
  EXPECT_EQ(effort.num_tiles, 0);
}

/// Runs work on all ranks, and expects the same error on all.
template <class Work>
void expect_error(Errc code, const std::string& text, const Work& work) {
  std::array<char, 400> message{};
  try {
    work();
    ADD_FAILURE() << "no error: " << text;
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_NE(std::string(error.what()).find(text), std::string::npos) << error.what();
    std::strncpy(message.data(), error.what(), message.size() - 1);
  }
  std::array<char, 400> first = message;
  MPI_Bcast(first.data(), static_cast<int>(first.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
  EXPECT_STREQ(first.data(), message.data());
}

TEST_F(PeriodicMpiTiles, AllRanksThrowTheSame) {
  std::vector<double> points = make_point_set("uniform", 2, 50);
  const auto make = [&](const Lattice& lattice, std::size_t tiles = 0) {
    mpi::make_tiles(test::rows_of_rank(points, 2, 1), path("out"), MPI_COMM_WORLD,
                    options_of_tiles(lattice, tiles));
  };
  expect_error(Errc::bad_dimension, "the lattice has 3 dimensions, not 2", [&] { make(cube(3)); });
  expect_error(Errc::invalid_argument, "lattice vector 1 is zero", [&] { make({2, {1, 0, 0, 0}}); });
  expect_error(Errc::invalid_argument, "the lattice is singular", [&] { make({2, {1, 1, 2, 2}}); });
  expect_error(Errc::not_finite, "lattice vector 0", [&] { make({2, {NAN, 1, 2, 2}}); });
  points[2 * 47] = 1e12;  // a row of the last rank that has rows
  expect_error(Errc::invalid_argument, "point 47 is more than 2^29 periods away", [&] { make(cube(2)); });
  points[2 * 47] = std::numeric_limits<double>::infinity();
  expect_error(Errc::not_finite, "inf", [&] { make(cube(2)); });
  points[2 * 47] = 0.5;
  if (num_ranks() > 1)
    expect_error(Errc::invalid_argument, "not that of rank 0",
                 [&] { make(cube(2, rank_of() == num_ranks() - 1 ? 2 : 1)); });
  if (num_ranks() > 1)
    expect_error(Errc::invalid_argument, "not that of rank 0",
                 [&] { make(rank_of() == 0 ? Lattice{} : cube(2)); });
  expect_error(Errc::unsupported, "vtu", [&] {
    TilesOptions how = options_of_tiles(cube(2), 2);
    how.vtu = true;
    mpi::make_tiles(PointsView(points, 2), path("out"), MPI_COMM_WORLD, how);
  });
  const std::vector<double> many = make_point_set("uniform", 8, 20);
  expect_error(Errc::unsupported, "translations", [&] {
    mpi::make_tiles(PointsView(many, 8), path("out"), MPI_COMM_WORLD, options_of_tiles(cube(8), 2));
  });
  if (rank_of() == 0) {
    EXPECT_FALSE(std::filesystem::exists(path("out")));
  }
}

}  // namespace
