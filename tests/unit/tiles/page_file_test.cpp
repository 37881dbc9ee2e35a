// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/page_file.hpp"

#include "../io/io_support.hpp"
#include "file_size_limit.hpp"
#include "tile_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <thread>

namespace delone::tiles {
namespace {

class PageFiles : public delone_test::TemporaryDirectory {};

struct Made {
  Survey survey;
  SplitTree tree;
  PageTable table;
};

Made make(const test::TileSet& set, std::size_t num_tiles, const std::string& path,
          const PageFileOptions& options) {
  const auto stream = stream_of(set.view());
  auto [survey, sample] = make_survey(*stream, set.weighted, 500);
  SplitTree tree = make_split_tree(sample, set.dimension(), num_tiles);
  PageTable table = make_page_file(*stream, survey, tree, path, options);
  return {std::move(survey), std::move(tree), std::move(table)};
}

test::TileSet set_named(const std::string& name, std::size_t n) {
  for (test::TileSet& set : test::tile_sets(n))
    if (set.name == name) return set;
  return {};
}

TEST_F(PageFiles, HaveEveryRowOnce) {
  for (const test::TileSet& set : test::tile_sets(test::scaled_count(800)))
    for (const std::size_t num_tiles : {1, 5, 2000})
      for (const std::uint64_t memory : {std::uint64_t{64} << 10, std::uint64_t{1} << 30}) {
        SCOPED_TRACE(set.name + ", tiles: " + std::to_string(num_tiles));
        const std::string points = path("points.bin");
        const auto [survey, tree, table] =
            make(set, num_tiles, points, {.page_points = 16, .memory = memory});
        EXPECT_EQ(num_files(), 2u);  // points and duplicates
        const auto width = static_cast<std::size_t>(set.row_size),
                   d = static_cast<std::size_t>(set.dimension());
        const std::size_t n = set.rows.size() / width;
        ASSERT_EQ(table.num_points() + table.first_duplicate.back(), n);
        ASSERT_EQ(table.tiles.size(), static_cast<std::size_t>(tree.num_tiles));
        PageFile file(points, table);
        std::vector<bool> seen(n);
        std::map<std::vector<double>, std::size_t> tile_of;
        for (std::size_t t = 0; t < table.tiles.size(); ++t) {
          const TilePoints own = file.read_tile_points(t);
          std::size_t at = 0;
          for (std::size_t page = table.tiles[t].first_page; page < table.tiles[t].last_page; ++page) {
            const auto found = file.find(page);
            ASSERT_EQ(found->size(), table.page_size(page));
            for (std::size_t i = 0; i < found->size(); ++i, ++at) {
              const auto row = static_cast<std::size_t>(found->rows[i]);
              std::vector<double> numbers(width);
              found->copy_point(i, numbers.data());
              const double* const point = numbers.data();
              ASSERT_LT(row, n);
              ASSERT_FALSE(seen[row]);
              seen[row] = true;
              ASSERT_TRUE(std::equal(point, point + width, &set.rows[row * width]));
              ASSERT_EQ(own.rows[at], found->rows[i]);
              ASSERT_TRUE(std::equal(point, point + width, &own.points[at * width]));
              ASSERT_EQ(tree.tile_of(point), t);
              ASSERT_EQ(tile_of.emplace(std::vector<double>(point, point + d), t).first->second, t);
              for (std::size_t axis = 0; axis < d; ++axis) {
                ASSERT_LE(table.low(page)[axis], point[axis]);
                ASSERT_GE(table.high(page)[axis], point[axis]);
              }
              if (set.weighted) {
                ASSERT_GE(table.weights[page], point[d]);
              }
            }
          }
          ASSERT_EQ(at, own.rows.size());
          for (const Duplicate& duplicate : own.duplicates) {
            const auto row = static_cast<std::size_t>(duplicate.row),
                       first = static_cast<std::size_t>(duplicate.first_row);
            ASSERT_LT(first, row);
            ASSERT_TRUE(
                std::equal(&set.rows[row * width], &set.rows[row * width] + width, &set.rows[first * width]));
            ASSERT_FALSE(seen[row]);
            seen[row] = true;
          }
        }
        EXPECT_EQ(std::count(seen.begin(), seen.end(), true), static_cast<std::ptrdiff_t>(n));
      }
}

/// A tile is read and written in several pieces.
TEST_F(PageFiles, HaveLargeTiles) {
  const test::TileSet set = set_named("uniform3", 80000);
  const Made made = make(set, 1, path("points"), {});
  const PageFile file(path("points"), made.table);
  const TilePoints all = file.read_tile_points(0);
  ASSERT_EQ(all.rows.size(), 80000u);
  std::vector<double> rows(set.rows.size());
  for (std::size_t i = 0; i < all.rows.size(); ++i)
    std::copy_n(&all.points[i * 3], 3, &rows[static_cast<std::size_t>(all.rows[i]) * 3]);
  EXPECT_EQ(rows, set.rows);
}

/// The same file, however much memory there is.
TEST_F(PageFiles, AreDeterministic) {
  const test::TileSet set = set_named("uniform3", 2000);
  make(set, 3, path("a"), {.memory = 200 << 10});
  make(set, 3, path("b"), {.memory = std::uint64_t{1} << 30});
  EXPECT_EQ(content("a"), content("b"));
}

TEST_F(PageFiles, CacheWithinItsLimit) {
  const test::TileSet set = set_named("uniform2", 1000);
  const Made made = make(set, 2, path("points"), {.page_points = 10});
  const std::size_t num_pages = made.table.num_pages();
  PageFile large(path("points"), made.table);
  for (int round = 0; round < 2; ++round)
    for (std::size_t page = 0; page < num_pages; ++page) large.find(page);
  EXPECT_EQ(large.num_reads(), num_pages);
  const auto kept = large.find(0);
  large.drop();
  EXPECT_EQ(kept->size(), made.table.page_size(0));
  large.find(0);
  EXPECT_EQ(large.num_reads(), num_pages + 1);
  PageFile none(path("points"), made.table, 0);
  for (int round = 0; round < 2; ++round)
    for (std::size_t page = 0; page < num_pages; ++page)
      EXPECT_EQ(none.find(page)->size(), made.table.page_size(page));
  EXPECT_EQ(none.num_reads(), 2 * num_pages);
  PageFile some(path("points"), made.table, 3000);
  for (int round = 0; round < 2; ++round) {
    const std::uint64_t before = some.num_reads();
    for (int again = 0; again < 2; ++again)
      for (std::size_t page = 0; page < num_pages; ++page) some.find(page);
    const std::uint64_t hits = 2 * num_pages - (some.num_reads() - before);
    EXPECT_GT(hits, 0u);
    EXPECT_LT(hits, 13u);  // no more pages of 240 bytes fit
    some.drop();
  }
}

TEST_F(PageFiles, ServeThreads) {
  const test::TileSet set = set_named("uniform2", 1000);
  const Made made = make(set, 1, path("points"), {.page_points = 10});
  PageFile file(path("points"), made.table, 3000);
  std::vector<std::thread> threads;
  std::atomic<std::size_t> found = 0;
  for (int thread = 0; thread < 4; ++thread)
    threads.emplace_back([&, thread] {
      for (std::size_t page = 0; page < made.table.num_pages(); ++page) {
        found += file.find(page)->size();
        if (thread == 0 && page % 20 == 0) file.drop();
      }
    });
  for (std::thread& thread : threads) thread.join();
  EXPECT_EQ(found, 4000u);
}

TEST_F(PageFiles, RefuseDamage) {
  const test::TileSet set = set_named("uniform2", 1000);
  const Made made = make(set, 2, path("points"), {});
  const auto expect_bad = [&](const auto& use) {
    try {
      use();
      ADD_FAILURE();
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Errc::bad_format);
      EXPECT_NE(std::string(error.what()).find(path("points")), std::string::npos) << error.what();
    }
  };
  PageFile opened(path("points"), made.table);
  std::filesystem::resize_file(path("points"), 100);
  expect_bad([&] { PageFile(path("points"), made.table); });
  expect_bad([&] { opened.find(made.table.num_pages() - 1); });
  expect_bad([&] { opened.read_tile_points(1); });
  std::filesystem::resize_file(path("points"), 1 << 20);
  expect_bad([&] { PageFile(path("points"), made.table); });
}

TEST_F(PageFiles, LeaveNothingOnAFullDisk) {
  if (!test::FileSizeLimit::exists) GTEST_SKIP();
  const test::TileSet set = set_named("uniform3", 5000);
  for (const std::uint64_t memory : {std::uint64_t{256} << 10, std::uint64_t{1} << 30}) {
    Errc code{};
    std::string message;
    try {
      const test::FileSizeLimit full(64 << 10);
      make(set, 2, path("points"), {.memory = memory});
    } catch (const Error& error) {
      code = error.code();
      message = error.what();
    }
    EXPECT_EQ(code, Errc::cannot_write);
    EXPECT_NE(message.find(path("points")), std::string::npos) << message;
    EXPECT_EQ(num_files(), 0u);
  }
}

TEST_F(PageFiles, RefuseATileBeyondTheMemory) {
  const test::TileSet set = set_named("equal", 5000);
  try {
    make(set, 4, path("points"), {.memory = 100 << 10});
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::out_of_memory);
  }
  EXPECT_EQ(num_files(), 0u);
}

TEST_F(PageFiles, RefuseAnInputThatChanges) {
  const test::TileSet set = set_named("uniform3", 100);
  const auto stream = stream_of(set.view());
  auto [survey, sample] = make_survey(*stream, false);
  ++survey.num_points;
  EXPECT_THROW(make_page_file(*stream, survey, make_split_tree(sample, 3, 2), path("points")), Error);
  EXPECT_EQ(num_files(), 0u);
}

TEST_F(PageFiles, TablesComeBack) {
  for (const test::TileSet& set : test::tile_sets(200)) {
    SCOPED_TRACE(set.name);
    const Made made = make(set, 3, path("points"), {.page_points = 9});
    write_page_table(path("table"), made.table);
    const PageTable table = read_page_table(path("table"));
    EXPECT_EQ(table.dimension, made.table.dimension);
    EXPECT_EQ(table.weighted, made.table.weighted);
    EXPECT_EQ(table.first_point, made.table.first_point);
    EXPECT_EQ(table.boxes, made.table.boxes);
    EXPECT_EQ(table.weights, made.table.weights);
    ASSERT_EQ(table.tiles.size(), made.table.tiles.size());
    for (std::size_t t = 0; t < table.tiles.size(); ++t) {
      EXPECT_EQ(table.tiles[t].first_page, made.table.tiles[t].first_page);
      EXPECT_EQ(table.tiles[t].last_page, made.table.tiles[t].last_page);
      EXPECT_EQ(table.tiles[t].low, made.table.tiles[t].low);
      EXPECT_EQ(table.tiles[t].high, made.table.tiles[t].high);
    }
  }
}

/// Every byte that is changed, and every shorter file, is noticed.
TEST_F(PageFiles, TablesShowDamage) {
  const Made made = make(set_named("weighted", 30), 2, path("points"), {.page_points = 9});
  write_page_table(path("table"), made.table);
  const std::string whole = content("table");
  for (std::size_t at = 0; at < whole.size(); at += 3) {
    std::string changed = whole;
    changed[at] = static_cast<char>(changed[at] ^ 0x10);
    EXPECT_THROW(read_page_table(file("changed", changed)), Error) << at;
    EXPECT_THROW(read_page_table(file("changed", whole.substr(0, at))), Error) << at;
  }
  EXPECT_THROW(read_page_table(path("nothing")), Error);
}

}  // namespace
}  // namespace delone::tiles
