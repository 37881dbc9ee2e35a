// SPDX-License-Identifier: BSD-3-Clause
// The check of folders of tiles: sound ones pass with little memory, and every damage is found at its level.
#include "tiles/check/check_tiles.hpp"

#include "../../io/io_support.hpp"
#include "../tiles_support.hpp"
#include "degenerate.hpp"
#include "scale.hpp"
#include "tiles/index_file.hpp"
#include "tiles/part_file.hpp"

#include <delone/check.hpp>
#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <functional>

namespace {

using namespace delone;
using namespace delone_test;

constexpr std::uint64_t little = 4096;

class CheckTiles : public TemporaryDirectory {
 protected:
  CheckTiles() : folder_(path("out")) {}

  CheckReport checked(bool canonical = false, std::uint64_t memory = little) const {
    CheckOptions options;
    options.canonical = canonical;
    return tiles::check_tiles(folder_, options, 1, memory);
  }
  void expect_sound(const ComplexData& data, std::size_t tiles) {
    write_folder(folder_, data, tiles);
    const CheckReport whole = check(data);
    ASSERT_TRUE(whole.ok) << whole.violation;
    for (const std::uint64_t memory : {little, std::uint64_t{1} << 24}) {
      const CheckReport report = checked(true, memory);
      EXPECT_TRUE(report.ok) << report.violation;
      EXPECT_EQ(report.reached.number, 6);
      EXPECT_EQ(report.ties, whole.ties);
    }
    EXPECT_EQ(check_tiles(folder_).ok, true);
    const std::size_t tiles_files = 2 * tiles + 1;
    EXPECT_EQ(static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(folder_), {})),
              tiles_files);
    std::filesystem::remove_all(folder_);
  }
  void expect_violation(int level, const std::string& text, std::uint64_t memory = little) {
    const CheckReport report = checked(false, memory);
    EXPECT_FALSE(report.ok) << text;
    EXPECT_EQ(report.reached.number, level) << report.violation;
    EXPECT_NE(report.violation.find(text), std::string::npos) << report.violation;
    CheckOptions below;
    below.up_to = level - 1;
    if (level > 1) {
      EXPECT_TRUE(tiles::check_tiles(folder_, below, 1, memory).ok);
    }
  }
  void change_part(std::size_t i, const std::function<void(TileData&)>& change) {
    TileData part = read_tile(folder_, i);
    const std::vector<std::int64_t> seams = part.seams;
    change(part);
    tiles::write_part(folder_, i, part);
    if (part.seams != seams) tiles::write_seams(folder_, i, part.seams, 0);
    accept_files();
  }
  /// Lets the index say what the files are now.
  void accept_files() {
    change_index([&](TilesIndex& index) {
      for (std::size_t i = 0; i < index.parts.size(); ++i) {
        io::FileContent part, seams;
        part.add(content("out/" + tiles::part_name(i)));
        seams.add(content("out/" + tiles::seams_name(i)));
        index.parts[i].num_bytes = part.num_bytes;
        index.parts[i].crc32 = part.crc32;
        tiles::set_content_of_seams(index.parts[i], seams);
      }
    });
  }
  void change_index(const std::function<void(TilesIndex&)>& change) {
    TilesIndex index = read_tiles_index(folder_);
    change(index);
    tiles::write_tiles_index(folder_, index, "a test");
  }
  /// Writes anything in tiles that the test chooses.
  void write_cut(const ComplexData& data, const std::vector<std::size_t>& tile_of_row,
                 std::size_t num_tiles) {
    tiles::WorkFolder work(folder_, plan_of(data, num_tiles), false);
    const auto cut = cut_into_tiles(data, tile_of_row, num_tiles);
    for (std::size_t t = 0; t < num_tiles; ++t) work.finish(t, cut[t]);
    work.finish_all(little);
  }
  void write_usual() { write_folder(folder_, usual_, 3); }

  std::string folder_;
  ComplexData usual_ = Delaunay<>(make_point_set("uniform", 3, 80), 3).to_data();
};

/// A triangulation of rows of points in the plane, with neighbors.
ComplexData plane(std::vector<double> points, std::vector<SignedIndex> cells) {
  ComplexData data{2, 2, std::move(points), std::move(cells), {}, {}, {}};
  const std::size_t m = data.num_cells();
  for (std::size_t v = 0; v < data.num_points(); ++v)
    data.vertex_of_point.push_back(static_cast<SignedIndex>(v));
  data.neighbors.assign(3 * m, -1);
  for (std::size_t a = 0; a < 3 * m; ++a)
    for (std::size_t b = 0; b < 3 * m; ++b) {
      const auto at = [&](std::size_t facet, std::size_t i) {
        return data.cells[facet / 3 * 3 + (facet % 3 + i) % 3];
      };
      if (a / 3 != b / 3 && at(a, 1) == at(b, 2) && at(a, 2) == at(b, 1))
        data.neighbors[a] = static_cast<SignedIndex>(b / 3);
    }
  return data;
}
std::vector<std::size_t> rows_apart(const ComplexData& data) {
  std::vector<std::size_t> tiles;
  for (std::size_t row = 0; row < data.num_points(); ++row) tiles.push_back(row);
  return tiles;
}

TEST_F(CheckTiles, SoundOnesPass) {
  for (int d = 1; d <= 4; ++d)
    for (const char* kind : {"uniform", "grid"})
      for (const std::size_t tiles : {1u, 5u})
        expect_sound(Delaunay<>(make_point_set(kind, d, d == 4 ? 50 : 120), d).to_data(), tiles);
  expect_sound(Delaunay<>(make_point_set("flat", 3, 50), 3).to_data(), 4);
  expect_sound(Delaunay<>(make_point_set("collinear", 3, 20), 3).to_data(), 4);
  expect_sound(Delaunay<>(std::vector<double>{1, 2, 1, 2}, 2).to_data(), 2);
  expect_sound(Delaunay<>(std::vector<double>{1, 2, 1, 2, 5, 2}, 2).to_data(), 2);
}

TEST_F(CheckTiles, SoundRegularOnesPass) {
  for (const double scale : {0.0, 0.02}) {
    std::vector<double> weights = make_point_set("uniform", 1, 120, 5);
    for (double& weight : weights) weight *= scale;
    std::vector<double> points = make_point_set("uniform", 3, 120);
    std::copy_n(points.begin(), 30, points.end() - 30);  // of other weights, and of the same ones
    std::copy_n(weights.begin(), 5, weights.end() - 10);
    expect_sound(Regular<>(points, weights, 3).to_data(), 4);
  }
}

TEST_F(CheckTiles, DamagedFilesAreFoundInStorage) {
  for (const char* name : {"out/part-0001.npz", "out/part-0002.seams.npy"}) {
    write_usual();
    file(name, content(name).substr(0, 500));
    expect_violation(1, std::string(name).substr(4));
    std::filesystem::remove(path(name));
    expect_violation(1, std::string(name).substr(4));
  }
  write_usual();
  change_part(1, [](TileData& part) { part.cells[1] = part.cells[0]; });
  expect_violation(1, "part-0001.npz");
  std::filesystem::remove(path("out/index.json"));
  expect_error(Errc::cannot_open, {"index.json"}, [&] { checked(); });
}

TEST_F(CheckTiles, SwappedPartsAreFound) {
  write_usual();
  std::filesystem::rename(path("out/part-0000.npz"), path("out/x"));
  std::filesystem::rename(path("out/part-0001.npz"), path("out/part-0000.npz"));
  std::filesystem::rename(path("out/x"), path("out/part-0001.npz"));
  expect_violation(1, "part-0000.npz: ");
  accept_files();
  expect_violation(1, "index.json says");
}

TEST_F(CheckTiles, ChangedNeighborsAreFound) {
  write_usual();
  change_part(1, [](TileData& part) {
    auto& neighbor =
        *std::find_if(part.neighbors.begin(), part.neighbors.end(), [](auto n) { return n >= 0; });
    neighbor = neighbor == 0 ? 1 : 0;
  });
  expect_violation(2, "part-0001.npz");
  write_usual();
  change_part(1, [](TileData& part) {
    *std::find_if(part.neighbors.begin(), part.neighbors.end(), [](auto n) { return n >= 0; }) = -1;
  });
  expect_violation(2, "not the other way round");
  write_usual();
  change_part(2, [](TileData& part) {
    auto& seam = *std::find_if(part.seams.begin(), part.seams.end(), [](auto s) { return s >= 0; });
    seam = seam == 0 ? 1 : 0;
  });
  expect_violation(2, "for its neighbor");
  write_usual();
  change_part(2, [](TileData& part) {
    *std::find_if(part.seams.begin(), part.seams.end(), [](auto s) { return s >= 0; }) = -1;
  });
  expect_violation(2, "has none for its neighbor");
  write_usual();
  change_part(2, [](TileData& part) {
    const auto hull = std::find(part.neighbors.begin(), part.neighbors.end(), -1);
    ASSERT_NE(hull, part.neighbors.end());
    *hull = static_cast<std::int32_t>(-2 - static_cast<std::ptrdiff_t>(part.seams.size()));
    part.seams.push_back(0);
  });
  expect_violation(2, "does not share it");
}

TEST_F(CheckTiles, ChangedCoordinatesAreFound) {
  write_usual();
  change_part(0, [](TileData& part) { part.points[1] += 1e-9; });
  const CheckReport report = checked();
  EXPECT_FALSE(report.ok);
  EXPECT_EQ(report.reached.number, 2) << report.violation;
  EXPECT_NE(report.violation.find("different coordinates"), std::string::npos) << report.violation;
  EXPECT_EQ(report.points.size(), 1u);
  // The same everywhere: a triangulation of other points, which only the hash tells.
  write_usual();
  const std::int64_t moved = read_tile(folder_, 0).rows[0];
  for (std::size_t i = 0; i < 3; ++i)
    change_part(i, [&](TileData& part) {
      for (std::size_t v = 0; v < part.rows.size(); ++v)
        if (part.rows[v] == moved) part.points[3 * v] += 1e-12;
    });
  expect_violation(6, "the hash is");
  for (std::size_t i = 0; i < 3; ++i)
    change_part(i, [&](TileData& part) {
      for (std::size_t v = 0; v < part.rows.size(); ++v)
        if (part.rows[v] == moved) part.points[3 * v] += 10;
    });
  expect_violation(4, "negatively oriented");
}

// One number of one array, anything in range: never passes, and is never an error.
TEST_F(CheckTiles, EveryChangedNumberIsFound) {
  test::Random random(7);
  for (std::size_t round = 0; round < test::scaled_count(40); ++round) {
    write_usual();
    const std::int64_t num_points = read_tiles_index(folder_).num_points,
                       num_cells = read_tiles_index(folder_).num_cells;
    const auto part_number = static_cast<std::size_t>(random.integer(0, 2));
    const int kind = random.integer(0, 6);
    bool changes = false;
    change_part(part_number, [&](TileData& part) {
      const auto change = [&](auto& items, std::int64_t least, std::int64_t largest) {
        if (items.empty()) return;
        auto& item = items[random.bits() % items.size()];
        const auto before = item;
        item = static_cast<std::remove_reference_t<decltype(item)>>(
            random.integer(static_cast<int>(least), static_cast<int>(largest)));
        changes = item != before;
      };
      const auto m = static_cast<std::int64_t>(part.num_cells()),
                 v = static_cast<std::int64_t>(part.num_points());
      if (kind == 0) change(part.cells, 0, v - 1);
      if (kind == 1) change(part.neighbors, -1, m - 1);
      if (kind == 2) change(part.seams, -1, num_cells - 1);
      if (kind == 3) change(part.rows, 0, num_points - 1);
      if (kind == 4) change(part.points, -2, 2);
      if (kind == 5) change(part.vertex_of_row, 0, num_points - 1);
      if (kind == 6) change(part.own_rows, 0, num_points - 1);
    });
    if (!changes) continue;
    const CheckReport report = checked(false, round % 2 == 0 ? little : std::uint64_t{1} << 20);
    EXPECT_FALSE(report.ok) << "kind " << kind << ", round " << round;
    for (const std::size_t cell : report.cells) EXPECT_LT(cell, static_cast<std::size_t>(num_cells));
    for (const std::size_t row : report.points) EXPECT_LT(row, static_cast<std::size_t>(num_points));
  }
}

TEST_F(CheckTiles, OrientationIsComparedAcrossSeams) {
  const ComplexData data = plane({0, 0, 3, 0, 0, 3, 4, 4}, {0, 1, 2, 1, 3, 2});
  write_cut(data, rows_apart(data), 4);
  EXPECT_TRUE(checked().ok);
  change_part(0, [](TileData& part) {
    ASSERT_EQ(part.num_cells(), 1u);
    std::swap(part.cells[0], part.cells[1]);
    std::swap(part.neighbors[0], part.neighbors[1]);
  });
  expect_violation(2, "not oriented coherently");
}

TEST_F(CheckTiles, SpheresAreComparedAcrossSeams) {
  // The other diagonal of a quadrangle: 0 and 3 are opposite.
  const std::vector<double> points{0, 0, 3, 0, 0, 3, 2, 2};
  const ComplexData wrong = plane(points, {0, 1, 2, 1, 3, 2}), right = plane(points, {0, 1, 3, 0, 3, 2});
  write_cut(right, rows_apart(right), 4);
  EXPECT_TRUE(checked().ok);
  write_cut(wrong, rows_apart(wrong), 4);
  expect_violation(5, "inside the sphere");
  // A square: both diagonals are, and one of them is canonical.
  const std::vector<double> square{0, 0, 1, 0, 0, 1, 1, 1};
  const ComplexData one = plane(square, {0, 1, 2, 1, 3, 2}), other = plane(square, {0, 1, 3, 0, 3, 2});
  int canonical = 0;
  for (const ComplexData& data : {one, other}) {
    write_cut(data, rows_apart(data), 4);
    EXPECT_TRUE(checked(false).ok);
    EXPECT_EQ(checked(false).ties, 1u);
    canonical += checked(true).ok ? 1 : 0;
  }
  EXPECT_EQ(canonical, 1);
}

TEST_F(CheckTiles, TheHullIsClosedAndConvex) {
  // Two triangles that meet in a point.
  const ComplexData touching = plane({0, 0, 1, 0, 0, 1, 3, 0, 3, 1}, {0, 1, 2, 1, 3, 4});
  write_cut(touching, rows_apart(touching), 5);
  expect_violation(3, "the hull is not closed");
  // A triangle with its center is left without one of its three cells.
  const ComplexData dented = plane({0, 0, 4, 0, 0, 4, 1, 1}, {0, 1, 3, 1, 2, 3});
  write_cut(dented, rows_apart(dented), 4);
  expect_violation(5, "the hull is not convex");
  // All hull facets are seen from the first cell, and yet there is a reflex angle.
  const ComplexData reflex = plane({0, 0, 10, 0, 5, 3, 0, 10}, {0, 1, 2, 0, 2, 3});
  write_cut(reflex, rows_apart(reflex), 4);
  expect_violation(5, "is beyond a hull facet");
}

TEST_F(CheckTiles, CellsCoverTheHullOnce) {
  // The same triangle twice, of other rows.
  const ComplexData twice = plane({0, 0, 4, 0, 0, 4, 0, 0, 4, 0, 0, 4}, {0, 1, 2, 3, 4, 5});
  std::vector<std::size_t> tiles{0, 0, 0, 1, 1, 1};
  write_cut(twice, tiles, 2);
  expect_violation(5, "overlaps");
  // Two triangles apart.
  const ComplexData apart = plane({0, 0, 4, 0, 0, 4, 10, 10, 14, 10, 10, 14}, {0, 1, 2, 3, 4, 5});
  write_cut(apart, tiles, 2);
  expect_violation(5, "the hull is not convex");
}

TEST_F(CheckTiles, EveryRowIsOnce) {
  write_usual();
  const std::int64_t other = read_tile(folder_, 1).own_rows[0];
  change_part(0, [&](TileData& part) {
    const auto at =
        std::upper_bound(part.own_rows.begin(), part.own_rows.end(), other) - part.own_rows.begin();
    const auto i = static_cast<std::size_t>(at > 0 ? at - 1 : at);
    part.own_rows[i] = part.vertex_of_row[i] = other;
  });
  const CheckReport report = checked();
  EXPECT_EQ(report.reached.number, 6) << report.violation;
  EXPECT_FALSE(report.ok);
  EXPECT_TRUE(report.violation.find("and in part-") != std::string::npos ||
              report.violation.find("in no part") != std::string::npos)
      << report.violation;
  write_usual();
  change_part(0, [](TileData& part) { part.vertex_of_row[0] = part.own_rows[0] == 0 ? 1 : 0; });
  change_index([](TilesIndex& index) {
    --index.num_vertices;
    --index.parts[0].num_vertices;
    ++index.num_duplicates;
  });
  expect_violation(6, "is a vertex of a cell, but merged into another");
  write_usual();
  change_part(1, [](TileData& part) {
    part.rows.push_back(0);
    part.points.insert(part.points.end(), {0, 0, 0});
  });
  expect_violation(6, "but no cell with it");
}

TEST_F(CheckTiles, DuplicatesAreOfEarlierVertices) {
  // The rows 3, 4 and 5 are those of 0, and 6 is another vertex.
  const std::vector<double> points{0, 0, 1, 0, 0, 1, 0, 0, 0, 0, 0, 0, 2, 2};
  for (const std::int64_t wrong : {3, 6}) {
    write_folder(folder_, Delaunay<>(points, 2).to_data(), 2);
    EXPECT_TRUE(checked().ok);
    for (std::size_t i = 0; i < 2; ++i)
      change_part(i, [&](TileData& part) {
        for (std::size_t r = 0; r < part.own_rows.size(); ++r)
          if (part.own_rows[r] == 4) part.vertex_of_row[r] = wrong;
      });
    expect_violation(6, wrong == 3 ? "which is no vertex" : "which is a later one");
  }
}

TEST_F(CheckTiles, ComparesWithTheInput) {
  const std::vector<double> points{0, 0, 1, 0, 0, 1, 0, 0, 2, 2};
  write_folder(folder_, Delaunay<>(points, 2).to_data(), 2);
  EXPECT_TRUE(check_tiles(folder_, PointsView(points, 2)).ok);
  for (const std::size_t i : {6u, 9u}) {
    std::vector<double> others = points;
    others[i] = 7;
    EXPECT_TRUE(checked().ok);
    const CheckReport report = check_tiles(folder_, PointsView(others, 2));
    EXPECT_FALSE(report.ok);
    EXPECT_EQ(report.reached.number, 6);
    EXPECT_NE(report.violation.find(i == 6 ? "not equal" : "other coordinates"), std::string::npos)
        << report.violation;
  }
  expect_error(Errc::bad_dimension, {"1 columns"}, [&] { check_tiles(folder_, PointsView(points, 1)); });
  expect_error(Errc::invalid_argument, {"4 points"},
               [&] { check_tiles(folder_, PointsView(std::span(points).first(8), 2)); });
  const std::vector<double> weighted{0, 0, .5, 1, 0, 0, 0, 1, 0, 0, 0, .5, 1, 1, 0, 1, 1, -9};
  std::vector<double> coordinates, weights;
  for (std::size_t i = 0; i < weighted.size(); i += 3) {
    coordinates.insert(coordinates.end(), {weighted[i], weighted[i + 1]});
    weights.push_back(weighted[i + 2]);
  }
  write_folder(folder_, Regular<>(coordinates, weights, 2).to_data(), 2);
  EXPECT_TRUE(check_tiles(folder_, PointsView(weighted, 3)).ok);
}

TEST_F(CheckTiles, TheIndexAgrees) {
  write_usual();
  change_index([](TilesIndex& index) { index.hash.low ^= 1; });
  expect_violation(6, "the hash is");
  write_usual();
  change_index([](TilesIndex& index) { ++index.num_hull_facets; });
  expect_violation(6, "hull facets");
  write_usual();
  change_index([](TilesIndex& index) {
    --index.num_vertices;
    ++index.num_duplicates;
    --index.parts[1].num_vertices;
  });
  expect_violation(6, "part-0001.npz has");
  expect_error(Errc::invalid_argument, {"oriented"}, [&] {
    CheckOptions options;
    options.furthest_site = true;
    check_tiles(folder_, options);
  });
}

}  // namespace
