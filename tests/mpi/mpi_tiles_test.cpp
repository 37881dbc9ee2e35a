// SPDX-License-Identifier: BSD-3-Clause
// Folders of tiles made by all ranks: the triangulation of the whole, for any share of the rows and number of
// tiles. Every rank runs every test, with the same random numbers; run it by mpirun.
#include <delone/delaunay.hpp>
#include <delone/mpi/tiles.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "degenerate.hpp"
#include "mpi_folder.hpp"
#include "scale.hpp"

namespace {

using namespace delone;

using test::MpiTiles;
using test::num_ranks;
using test::rank_of;
using test::rows_of_rank;

/// Rows of d coordinates, and a weight if `weighted`.
struct Rows {
  std::string name;
  int width = 0;
  bool weighted = false;
  std::vector<double> values;
  std::size_t size() const { return values.size() / static_cast<std::size_t>(width); }
};

Rows rows_of(const test::PointSet& set) { return {set.name, set.dimension, false, set.points}; }

PointsView share_of(const Rows& rows, std::uint64_t seed) {
  return rows_of_rank(rows.values, rows.width, seed);
}

/// The hash, the number of vertices and of infinite cells of the whole.
struct Whole {
  CanonicalHash hash;
  std::int64_t vertices = 0, hull_facets = 0;
};
Whole whole_of(const Rows& rows) {
  const auto of = [](const Triangulation& t) {
    return Whole{t.hash(), static_cast<std::int64_t>(t.num_vertices()),
                 static_cast<std::int64_t>(t.num_infinite_cells())};
  };
  if (!rows.weighted) return of(Delaunay<>(rows.values, rows.width));
  std::vector<double> coordinates, weights;
  const auto width = static_cast<std::size_t>(rows.width);
  for (std::size_t i = 0; i < rows.values.size(); ++i)
    (i % width == width - 1 ? weights : coordinates).push_back(rows.values[i]);
  return of(Regular<>(coordinates, weights, rows.width - 1));
}

void expect_whole(const Rows& rows, const TilesIndex& index, const std::string& folder) {
  SCOPED_TRACE(rows.name + ", rank " + std::to_string(rank_of()));
  const Whole whole = whole_of(rows);
  EXPECT_EQ(index.hash, whole.hash);
  EXPECT_EQ(index.num_vertices, whole.vertices);
  EXPECT_EQ(index.num_points, static_cast<std::int64_t>(rows.size()));
  if (index.affine_dimension > 0) {
    EXPECT_EQ(index.num_hull_facets, whole.hull_facets);
  }
  if (rank_of() == 0) {
    const CheckReport report = check_tiles(folder, PointsView(rows.values, rows.width));
    EXPECT_TRUE(report.ok) << report.violation;
  }
}

TilesIndex make(const Rows& rows, const std::string& folder, std::size_t num_tiles, std::uint64_t seed) {
  TilesOptions options;
  options.weighted = rows.weighted;
  options.tiles = num_tiles;
  options.memory = std::uint64_t{8} << 30;
  return mpi::make_tiles(share_of(rows, seed), folder, MPI_COMM_WORLD, options);
}

std::vector<Rows> degenerate_rows() {
  std::vector<Rows> sets;
  const std::size_t n = test::scaled_count(60);
  for (const int d : {1, 2, 3}) {
    for (const test::PointSet& set : test::degenerate_sets(d, n, 1)) sets.push_back(rows_of(set));
    sets.push_back({"uniform", d, false, make_point_set("uniform", d, 5 * n)});
  }
  sets.push_back({"uniform", 4, false, make_point_set("uniform", 4, 2 * n)});
  sets.push_back({"sphere", 3, false, make_point_set("sphere", 3, 2 * n)});
  sets.push_back({"equal", 2, false, std::vector<double>(2 * n, 0.5)});
  sets.push_back({"none", 3, false, {}});
  test::Random random(3);
  // Few or many hidden points, and equal positions; or few points of large weight among many of none, which
  // reach far into other tiles.
  for (const int kind : {0, 1, 2}) {
    Rows weighted{"weighted " + std::to_string(kind), 3, true, {}};
    for (std::size_t i = 0; i < 3 * n; ++i) {
      const double weight = kind == 2 ? (i % 60 == 0 ? 20 : 0) : random.real() * (kind == 0 ? 1 : 40);
      for (int axis = 0; axis < 2; ++axis)
        weighted.values.push_back(kind == 2 ? 15 * random.real()
                                            : static_cast<double>(random.integer(0, 15)));
      weighted.values.push_back(weight);
    }
    sets.push_back(weighted);
  }
  return sets;
}

TEST_F(MpiTiles, EqualTheWhole) {
  std::size_t number = 0;
  for (const Rows& rows : degenerate_rows()) {
    // By turns as few tiles as possible, and more than ranks; both if there is time.
    ++number;
    for (const std::size_t tiles : {std::size_t{0}, std::size_t{7}}) {
      if (number % 2 == tiles % 2 && test::scale() != test::Scale::large) continue;
      const std::string folder = path(std::to_string(number) + "-" + std::to_string(tiles));
      expect_whole(rows, make(rows, folder, tiles, number), folder);
    }
  }
}

TEST_F(MpiTiles, GoesOnWithWhatIsThere) {
  const Rows rows{"uniform", 3, false, make_point_set("uniform", 3, 600)};
  const std::string folder = path("out");
  // The first call is stopped when a tile is finished.
  TilesOptions options;
  options.tiles = 4 * static_cast<std::size_t>(num_ranks());
  options.progress = [&](double) { return !std::filesystem::exists(folder + "/work/tile-0001.json"); };
  EXPECT_THROW(mpi::make_tiles(share_of(rows, 1), folder, MPI_COMM_WORLD, options), Error);
  MPI_Barrier(MPI_COMM_WORLD);
  const std::string part = folder + "/part-0000.npz";
  ASSERT_TRUE(std::filesystem::exists(part));
  const auto time = std::filesystem::last_write_time(part);
  options.progress = {};
  mpi::RankEffort effort;
  expect_whole(rows, mpi::make_tiles(share_of(rows, 2), folder, MPI_COMM_WORLD, options, &effort), folder);
  EXPECT_EQ(std::filesystem::last_write_time(part), time);
  if (rank_of() == 0) {
    EXPECT_LE(effort.num_tiles, 3);
  }
  // And once more: there is nothing to do.
  expect_whole(rows, mpi::make_tiles(share_of(rows, 3), folder, MPI_COMM_WORLD, options, &effort), folder);
  EXPECT_EQ(effort.num_tiles, 0);
}

TEST_F(MpiTiles, ReadsFiles) {
  const Rows rows{"uniform", 2, false, make_point_set("uniform", 2, 500)};
  const std::string folder = path("");
  if (rank_of() == 0) {
    std::ofstream whole(path("whole.raw"), std::ios::binary), text(path("whole.txt"));
    whole.write(reinterpret_cast<const char*>(rows.values.data()),
                static_cast<std::streamsize>(rows.values.size() * sizeof(double)));
    text.precision(17);
    for (std::size_t i = 0; i < rows.values.size(); i += 2)
      text << rows.values[i] << ' ' << rows.values[i + 1] << '\n';
    for (std::size_t file = 0; file < 3; ++file) {
      std::ofstream part(path("part-" + std::to_string(file) + ".raw"), std::ios::binary);
      const std::size_t first = rows.size() * file / 3 * 2, last = rows.size() * (file + 1) / 3 * 2;
      part.write(reinterpret_cast<const char*>(rows.values.data() + first),
                 static_cast<std::streamsize>((last - first) * sizeof(double)));
    }
  }
  MPI_Barrier(MPI_COMM_WORLD);
  TilesOptions options;
  options.columns = 2;
  for (const std::vector<std::string>& files :
       {std::vector{path("whole.raw")}, std::vector{path("whole.txt")}, std::vector{path("part-%d.raw")}}) {
    // The rows are those of the whole, so that a call with other files of the same rows finds them done.
    mpi::RankEffort effort;
    expect_whole(rows, mpi::make_tiles(files, path("out"), MPI_COMM_WORLD, options, &effort), path("out"));
    EXPECT_EQ(effort.num_tiles > 0, files[0] == path("whole.raw"));
  }
}

TEST_F(MpiTiles, AllRanksThrowWhatOneFinds) {
  Rows rows{"uniform", 2, false, make_point_set("uniform", 2, 40)};
  if (rank_of() == num_ranks() - 1) rows.values[7] = NAN;
  try {
    mpi::make_tiles(PointsView(rows.values, 2), path("out"), MPI_COMM_WORLD);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::not_finite);
    EXPECT_EQ(error.rows(), std::vector<std::size_t>{3});
    const std::string front = "rank " + std::to_string(num_ranks() - 1) + ": ";
    EXPECT_EQ(std::string(error.what()).starts_with(front), num_ranks() > 1) << error.what();
  }
  EXPECT_THROW(mpi::make_tiles(std::vector<std::string>{path("missing.npy")}, path("out"), MPI_COMM_WORLD),
               Error);
  EXPECT_THROW(mpi::make_tiles(std::vector<std::string>{path("missing-%d.npy")}, path("out"), MPI_COMM_WORLD),
               Error);
}

}  // namespace

int main(int argc, char** argv) {
  MPI_Init(&argc, &argv);
  testing::InitGoogleTest(&argc, argv);
  int failed = RUN_ALL_TESTS();
  MPI_Allreduce(MPI_IN_PLACE, &failed, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  MPI_Finalize();
  return failed;
}
