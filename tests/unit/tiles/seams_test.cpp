// SPDX-License-Identifier: BSD-3-Clause
// Triangulations cut into tiles, written, matched at their seams and glued together are what they were, for
// any cut and with little memory.
#include "tiles/seams.hpp"

#include "../io/io_support.hpp"
#include "tiles/part_file.hpp"
#include "tiles_support.hpp"

#include <delone/check.hpp>
#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

namespace {

using namespace delone;
using namespace delone_test;

class Seams : public TemporaryDirectory {
 protected:
  /// Cuts, glues and compares.
  void expect_whole(const Triangulation& whole, std::size_t tiles, std::uint64_t memory) {
    const ComplexData data = whole.to_data();
    const std::string folder = path("tiles");
    const TilesIndex index = write_folder(folder, data, tiles, memory);
    EXPECT_EQ(index.hash, whole.hash());
    EXPECT_EQ(index.num_cells, static_cast<std::int64_t>(data.num_cells()));
    EXPECT_EQ(index.num_hull_facets, static_cast<std::int64_t>(whole.num_infinite_cells()));
    EXPECT_EQ(index.num_vertices, static_cast<std::int64_t>(whole.num_vertices()));
    EXPECT_FALSE(std::filesystem::exists(path("tiles/work")));
    EXPECT_EQ(read_tiles_index(folder).hash, index.hash);
    ComplexData glued = glue(folder);
    EXPECT_EQ(glued.vertex_of_point, data.vertex_of_point);
    glued.points = data.points;  // those of rows that are no vertices, too
    glued.weights = data.weights;
    const CheckReport report = check(glued);
    EXPECT_TRUE(report.ok) << report.violation;
    std::filesystem::remove_all(folder);
  }
};

const auto ignore = [](std::size_t, std::span<const std::int64_t>) {};

constexpr std::uint64_t plenty = std::uint64_t{1} << 24, little = 4096;

TEST_F(Seams, JoinTheWhole) {
  for (int d = 1; d <= 4; ++d)
    for (const char* kind : {"uniform", "grid"})
      for (const std::size_t tiles : {1u, 2u, 7u})
        for (const std::uint64_t memory : {plenty, little})
          expect_whole(Delaunay<>(make_point_set(kind, d, d == 4 ? 60 : 200), d), tiles, memory);
}

TEST_F(Seams, JoinFlatAndTinySets) {
  expect_whole(Delaunay<>(make_point_set("flat", 3, 60), 3), 5, little);
  expect_whole(Delaunay<>(make_point_set("collinear", 3, 30), 3), 5, plenty);
  expect_whole(Delaunay<>(std::vector<double>{1, 2, 1, 2}, 2), 3, plenty);  // one point, twice
  expect_whole(Delaunay<>(std::vector<double>{0, 0, 1, 0, 0, 1}, 2), 3, plenty);
}

TEST_F(Seams, JoinRegularTriangulations) {
  for (const double scale : {0.0, 0.01}) {
    const std::vector<double> points = make_point_set("uniform", 3, 300);
    std::vector<double> weights = make_point_set("uniform", 1, 300, 5);
    for (double& weight : weights) weight *= scale;
    expect_whole(Regular<>(points, weights, 3), 6, little);
  }
}

TEST_F(Seams, OfThreeCellsAreAnError) {
  const ComplexData data = Delaunay<>(make_point_set("uniform", 2, 50), 2).to_data();
  auto tiles = cut_into_tiles(data, scattered_tiles(data, 3), 3);
  ASSERT_FALSE(tiles[0].seams.empty());
  std::filesystem::create_directory(path("work"));
  for (std::size_t t = 0; t < 3; ++t) tiles::append_seam_records(path("work"), t, tiles[t]);
  const std::vector<std::int64_t> first{0, 1000, 2000, 3000};
  EXPECT_GT(tiles::match_seams(path("work"), std::span(first).first(3), plenty, ignore), 0);
  tiles::append_seam_records(path("work"), 3, tiles[0]);
  expect_error(Errc::bad_format, {"do not fit together", "tile 3"},
               [&] { tiles::match_seams(path("work"), first, plenty, ignore); });
  tiles[0].seams.push_back(tiles[0].seams[0]);
  tiles::append_seam_records(path("work"), 0, tiles[0]);
  expect_error(Errc::bad_format, {"tile 0"},
               [&] { tiles::match_seams(path("work"), std::span(first).first(1), little, ignore); });
}

TEST_F(Seams, DamagedRecordsAreErrors) {
  const ComplexData data = Delaunay<>(make_point_set("uniform", 2, 50), 2).to_data();
  const auto tiles = cut_into_tiles(data, scattered_tiles(data, 2), 2);
  const std::vector<std::int64_t> first{0, 1000};
  const auto match = [&] { tiles::match_seams(path("."), first, plenty, ignore); };
  tiles::append_seam_records(path("."), 0, tiles[0]);
  expect_error(Errc::cannot_open, {"seams-0001.bin"}, match);
  tiles::append_seam_records(path("."), 1, tiles[1]);
  const std::string whole = content("seams-0001.bin");
  for (const std::size_t size : {std::size_t{0}, std::size_t{5}, std::size_t{16}, whole.size() - 8}) {
    file("seams-0001.bin", whole.substr(0, size));
    expect_error(Errc::bad_format, {"seams-0001.bin", "truncated"}, match);
  }
  tiles::append_seam_records(path("."), 1, tiles[0]);  // swapped
  std::filesystem::rename(path("seams-0001.bin"), path("seams-0000.bin"));
  tiles::append_seam_records(path("."), 1, tiles[1]);
  expect_error(Errc::bad_format, {"seams-0000.bin", "out of range"}, match);
}

}  // namespace
