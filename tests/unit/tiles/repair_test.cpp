// SPDX-License-Identifier: BSD-3-Clause
// What is damaged in a finished folder is found, named and made again, byte by byte as it was, and nothing
// else is touched.
#include "tiles/repair.hpp"

#include "../io/io_support.hpp"
#include "scale.hpp"
#include "tiles/index_file.hpp"
#include "tiles/part_file.hpp"

#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <functional>
#include <map>

namespace {

using namespace delone;
using namespace delone_test;

namespace fs = std::filesystem;

class Repair : public TemporaryDirectory {
 protected:
  struct Input {
    std::string name;
    int columns = 0;
    bool weighted = false;
    std::vector<double> rows;
    CanonicalHash hash;
  };

  static std::vector<Input> inputs() {
    std::vector<Input> all;
    for (const char* const kind : {"uniform", "grid", "flat"}) {
      std::vector<double> points = make_point_set(kind, 3, test::scaled_size(400, 100));
      points.insert(points.end(), points.begin(), points.begin() + 30);  // duplicates
      const CanonicalHash hash = Delaunay<>(points, 3).hash();
      all.push_back({kind, 3, false, std::move(points), hash});
    }
    const std::vector<double> points = make_point_set("uniform", 2, 300);
    std::vector<double> weights = make_point_set("uniform", 1, 300, 5);
    Input weighted{"weighted", 3, true, {}, {}};
    for (std::size_t i = 0; i < 300; ++i)
      weighted.rows.insert(weighted.rows.end(), {points[2 * i], points[2 * i + 1], weights[i] *= 0.01});
    weighted.hash = Regular<>(points, weights, 2).hash();
    all.push_back(std::move(weighted));
    return all;
  }

  /// Makes the folder, or what is damaged in it.
  TilesIndex make(const Input& input, std::size_t tiles) {
    TilesOptions options = options_;
    options.memory = std::uint64_t{1} << 34;
    options.tiles = tiles;
    options.weighted = input.weighted;
    if (!options.damage)
      options.damage = [&](const std::vector<std::string>& files) {
        told_.insert(told_.end(), files.begin(), files.end());
        return true;
      };
    return make_tiles(PointsView(input.rows, input.columns), path("out"), options);
  }
  std::map<std::string, std::string> contents() const {
    std::map<std::string, std::string> all;
    for (const fs::directory_entry& entry : fs::directory_iterator(path("out")))
      all[entry.path().filename().string()] = content("out/" + entry.path().filename().string());
    return all;
  }
  void flip(const std::string& name, std::size_t at) {
    std::string bytes = content("out/" + name);
    bytes[at % bytes.size()] ^= 4;
    file("out/" + name, bytes);
  }
  void swap(const std::string& a, const std::string& b) {
    const std::string bytes = content("out/" + a);
    file("out/" + a, content("out/" + b));
    file("out/" + b, bytes);
  }

  TilesOptions options_;
  std::vector<std::string> told_;
};

TEST_F(Repair, MakesWhatIsDamagedAsItWas) {
  for (const Input& input : inputs())
    for (const std::size_t tiles : {1u, 4u}) {
      SCOPED_TRACE(input.name + ", tiles: " + std::to_string(tiles));
      const TilesIndex index = make(input, tiles);
      EXPECT_EQ(index.hash, input.hash);
      EXPECT_EQ(make(input, tiles).hash, input.hash);
      EXPECT_TRUE(told_.empty());
      const auto whole = contents();
      ASSERT_EQ(whole.size(), 2 * index.parts.size() + 1);
      const std::string last = tiles::part_name(index.parts.size() - 1),
                        last_seams = tiles::seams_name(index.parts.size() - 1);
      const auto expect_repaired = [&](const std::vector<std::string>& damaged,
                                       const std::function<void()>& damage) {
        std::map<std::string, fs::file_time_type> times;
        for (const auto& [name, bytes] : whole) times[name] = fs::last_write_time(path("out/" + name));
        damage();
        const TilesIndex again = make(input, tiles);
        EXPECT_EQ(again.hash, input.hash);
        ASSERT_EQ(told_.size(), damaged.size());
        for (std::size_t i = 0; i < damaged.size(); ++i) {
          EXPECT_NE(told_[i].find(damaged[i] + ": "), std::string::npos) << told_[i];
          times.erase(damaged[i]);
        }
        told_.clear();
        EXPECT_TRUE(contents() == whole);
        for (const auto& [name, time] : times)
          EXPECT_EQ(fs::last_write_time(path("out/" + name)), time) << name;
      };
      for (const std::string& name : {last, last_seams}) {
        const std::size_t size = whole.at(name).size();
        for (const std::size_t left : {std::size_t{0}, std::size_t{100}, size - 1})
          expect_repaired({name}, [&] { file("out/" + name, whole.at(name).substr(0, left)); });
        for (const std::size_t at : {std::size_t{0}, std::size_t{11}, size / 2, size - 1})
          expect_repaired({name}, [&] { flip(name, at); });
        expect_repaired({name}, [&] { file("out/" + name, whole.at(name) + '\0'); });
        expect_repaired({name}, [&] { fs::remove(path("out/" + name)); });
      }
      expect_repaired({last, last_seams}, [&] {
        flip(last, 1000);
        fs::remove(path("out/" + last_seams));
      });
      if (index.parts.size() > 1) {
        expect_repaired({"part-0000.npz", last}, [&] { swap("part-0000.npz", last); });
        expect_repaired({"part-0000.seams.npy", last_seams},
                        [&] { swap("part-0000.seams.npy", last_seams); });
        expect_repaired({"part-0000.npz", last_seams}, [&] { swap("part-0000.npz", last_seams); });
      }
      fs::remove_all(path("out"));
    }
}

TEST_F(Repair, FindsTheNumberOfTilesInTheFolder) {
  const Input input = inputs()[0];
  make(input, 4);
  fs::remove(path("out/part-0002.npz"));
  EXPECT_EQ(make(input, 0).parts.size(), 4u);
  EXPECT_EQ(told_.size(), 1u);
  EXPECT_TRUE(check_tiles(path("out")).ok);
}

TEST_F(Repair, CanBeStoppedAndGoesOn) {
  const Input input = inputs()[0];
  make(input, 4);
  const auto whole = contents();
  flip("part-0001.npz", 5000);
  flip("part-0003.npz", 5000);
  const auto damaged = contents();
  options_.damage = [](const std::vector<std::string>&) { return false; };
  expect_error(Errc::cancelled, {}, [&] { make(input, 4); });
  EXPECT_TRUE(contents() == damaged);
  options_ = {};
  options_.progress = [](double) { return false; };
  expect_error(Errc::cancelled, {}, [&] { make(input, 4); });
  EXPECT_TRUE(contents() == damaged);
  options_.progress = [&](double) { return content("out/part-0001.npz") != whole.at("part-0001.npz"); };
  // If the progress function is asked too seldom, this one ends, too.
  try {
    make(input, 4);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::cancelled);
    EXPECT_TRUE(fs::exists(path("out/index.json")));
    EXPECT_FALSE(find_unfinished_tiles(path("out")));
  }
  options_ = {};
  make(input, 4);
  EXPECT_TRUE(contents() == whole);
}

TEST_F(Repair, LeavesAPartThatWouldBecomeAnother) {
  const Input input = inputs()[0];
  TilesIndex index = make(input, 4);
  std::string fingerprint;
  index = tiles::read_tiles_index(path("out"), fingerprint);
  for (const bool is_seams : {false, true}) {
    TilesIndex changed = index;
    (is_seams ? changed.parts[1].seam_crc32 : changed.parts[1].crc32) ^= 1;
    tiles::write_tiles_index(path("out"), changed, fingerprint);
    const std::string name = is_seams ? "part-0001.seams.npy" : "part-0001.npz",
                      before = content("out/" + name);
    expect_error(Errc::bad_format, {name, "differs from what index.json says", "resume off"},
                 [&] { make(input, 4); });
    EXPECT_EQ(content("out/" + name), before);
  }
  options_.resume = false;
  EXPECT_EQ(make(input, 4).parts[1].crc32, index.parts[1].crc32);
}

TEST_F(Repair, OfADamagedIndexIsUpToTheCaller) {
  const Input input = inputs()[0];
  const TilesIndex index = make(input, 3);
  const std::string whole = content("out/index.json");
  std::vector<std::string> damaged;
  for (const std::size_t size : {std::size_t{0}, std::size_t{20}, whole.size() / 2, whole.size() - 3})
    damaged.push_back(whole.substr(0, size));
  damaged.push_back(std::string(whole.size(), '\0'));
  damaged.push_back(whole);
  damaged.back().replace(whole.find("\"num_cells\": ") + 13, 1, "0");
  for (const std::string& bytes : damaged) {
    file("out/index.json", bytes);
    for (const std::size_t tiles : {0u, 3u})
      expect_error(Errc::bad_format, {"index.json", "make the tiles again with resume off"},
                   [&] { make(input, tiles); });
    EXPECT_EQ(content("out/index.json"), bytes);
    options_.resume = false;
    EXPECT_EQ(make(input, 3).hash, index.hash);
    EXPECT_EQ(content("out/index.json"), whole);
    options_ = {};
  }
  // That of somebody else stays.
  file("out/index.json", "{\"mine\": 1}");
  for (options_.resume = false;; options_.resume = true) {
    expect_error(Errc::bad_format, {"index.json", "format"}, [&] { make(input, 3); });
    if (options_.resume) break;
  }
  EXPECT_EQ(content("out/index.json"), "{\"mine\": 1}");
}

TEST_F(Repair, IsOfOneProcessAndTouchesNothingOfOthers) {
  const Input input = inputs()[0];
  const TilesIndex index = make(input, 3);
  std::string fingerprint;
  tiles::read_tiles_index(path("out"), fingerprint);
  fs::create_directory(path("out/work"));
  file("out/work/thesis.txt", "precious");
  make(input, 3);
  fs::remove(path("out/part-0001.npz"));
  expect_error(Errc::invalid_argument, {"thesis.txt"}, [&] { make(input, 3); });
  EXPECT_EQ(content("out/work/thesis.txt"), "precious");
  fs::remove(path("out/work/thesis.txt"));
#if !DELONE_PORTABLE
  {
    const platform::FileLock lock(path("out/work/lock").c_str());
    expect_error(Errc::cannot_write, {"another process"}, [&] { make(input, 3); });
    EXPECT_TRUE(fs::exists(path("out/work/lock")));
  }
#endif
  // Pages of other points, left there.
  file("out/work/plan.json", "{");
  file("out/work/pages.bin", "of others");
  EXPECT_EQ(make(input, 3).hash, index.hash);
  EXPECT_TRUE(check_tiles(path("out")).ok);
  EXPECT_FALSE(fs::exists(path("out/work")));
}

TEST_F(Repair, ReadersNameTheDamagedFile) {
  const Input input = inputs()[0];
  make(input, 2);
  for (const std::string name : {"part-0001.npz", "part-0001.seams.npy"}) {
    const std::string whole = content("out/" + name);
    for (std::size_t at = 0; at < whole.size(); at += whole.size() / 50 + 1) {
      flip(name, at);
      expect_error(Errc::bad_format, {name}, [&] { read_tile(path("out"), 1); });
      file("out/" + name, whole);
    }
    file("out/" + name, whole.substr(0, whole.size() - 1));
    expect_error(Errc::bad_format,
                 {name, "truncated: " + std::to_string(whole.size() - 1) + " bytes, not " +
                            std::to_string(whole.size())},
                 [&] { read_tile(path("out"), 1); });
    const CheckReport report = check_tiles(path("out"));
    EXPECT_EQ(report.reached.number, 1);
    EXPECT_NE(report.violation.find(name + ": truncated"), std::string::npos) << report.violation;
    file("out/" + name, whole);
    EXPECT_EQ(read_tile(path("out"), 1).affine_dimension, 3);
  }
}

}  // namespace
