// SPDX-License-Identifier: BSD-3-Clause
// A folder of tiles is gone on with if it is of the same plan; whatever else it holds stays as it is.
#include "tiles/work_folder.hpp"

#include "../io/io_support.hpp"
#include "file_size_limit.hpp"
#include "tiles/index_file.hpp"
#include "tiles_support.hpp"

#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <memory>

namespace {

using namespace delone;
using namespace delone_test;
using tiles::WorkFolder;

class WorkFolderTest : public TemporaryDirectory {
 protected:
  WorkFolderTest()
      : whole_(make_point_set("uniform", 2, 100), 2),
        data_(whole_.to_data()),
        tiles_(cut_into_tiles(data_, scattered_tiles(data_, 3), 3)),
        folder_(path("out")) {}

  Delaunay<> whole_;
  ComplexData data_;
  std::vector<tiles::FinishedTile> tiles_;
  std::string folder_;
};

TEST_F(WorkFolderTest, GoesOnWithFinishedTiles) {
  const tiles::Plan plan = plan_of(data_, 3);
  EXPECT_FALSE(find_unfinished_tiles(folder_));
  EXPECT_FALSE(tiles::find_plan(folder_));
  WorkFolder(folder_, plan, true).finish(1, tiles_[1]);
  EXPECT_EQ(find_unfinished_tiles(folder_).value().num_finished, 1u);
  EXPECT_EQ(find_unfinished_tiles(folder_).value().num_tiles, 3u);
  EXPECT_EQ(tiles::find_plan(folder_).value(), plan);
  WorkFolder again(folder_, plan, true);
  EXPECT_FALSE(again.finished(0));
  ASSERT_TRUE(again.finished(1));
  EXPECT_EQ(again.num_finished(), 1u);
  EXPECT_EQ(again.finished(1)->hash.words(), tiles_[1].hash.words());
  EXPECT_EQ(again.finished(1)->num_cells, static_cast<std::int64_t>(tiles_[1].data.num_cells()));
  again.finish(0, tiles_[0]);
  again.finish(2, tiles_[2]);
  EXPECT_FALSE(tiles::find_finished(folder_, plan));
  const TilesIndex index = again.finish_all(std::uint64_t{1} << 20);
  EXPECT_EQ(index.hash, whole_.hash());
  EXPECT_EQ(tiles::find_finished(folder_, plan).value().hash, whole_.hash());
  EXPECT_FALSE(find_unfinished_tiles(folder_));
}

TEST_F(WorkFolderTest, OnlyCompleteTilesAreFinished) {
  const tiles::Plan plan = plan_of(data_, 3);
  /// What verify() says of tile 1.
  const auto damage = [&] {
    WorkFolder work(folder_, plan, true);
    const std::vector<std::string> found = work.verify(0, 3);
    EXPECT_EQ(work.finished(1).has_value(), found.empty());
    EXPECT_TRUE(work.finished(2));
    return found.empty() ? "" : found[0];
  };
  WorkFolder(folder_, plan, true).finish(2, tiles_[2]);
  for (const char* damaged : {"part-0001.npz", "work/seams-0001.bin"}) {
    WorkFolder(folder_, plan, true).finish(1, tiles_[1]);
    const std::string name = std::string("out/") + damaged, whole = content(name);
    EXPECT_EQ(damage(), "");
    file(name, whole.substr(0, whole.size() - 3));
    EXPECT_NE(damage().find(std::string(damaged) + ": truncated"), std::string::npos);
    EXPECT_EQ(find_unfinished_tiles(folder_).value().num_finished, 1u);
    for (std::size_t at = 0; at < whole.size(); at += whole.size() / 20 + 1) {
      std::string changed = whole;
      changed[at] ^= 1;
      file(name, changed);
      EXPECT_NE(damage().find(std::string(damaged) + ": damaged"), std::string::npos) << at;
    }
    file(name, whole);
    EXPECT_EQ(damage(), "");
    std::filesystem::remove(path(name));
    EXPECT_NE(damage().find(damaged), std::string::npos);
  }
  const std::string record = "out/work/tile-0001.json";
  for (const std::size_t less : {0, 3, 20}) {
    WorkFolder(folder_, plan, true).finish(1, tiles_[1]);
    const std::string whole = content(record);
    file(record, less == 0 ? std::string(whole.size(), '\0') : whole.substr(0, whole.size() - less));
    EXPECT_FALSE(WorkFolder(folder_, plan, true).finished(1));
  }
}

TEST_F(WorkFolderTest, OfSomethingElseIsLeftAlone) {
  const tiles::Plan plan = plan_of(data_, 3);
  const auto open = [&](tiles::Plan other) { return [this, other] { WorkFolder(folder_, other, true); }; };
  file("out", "a file");
  expect_error(Errc::invalid_argument, {"not a folder"}, open(plan));
  std::filesystem::remove(folder_);
  std::filesystem::create_directory(folder_);
  file("out/thesis.txt", "precious");
  for (const bool resume : {false, true})
    expect_error(Errc::invalid_argument, {"not empty", "thesis.txt"},
                 [&] { WorkFolder(folder_, plan, resume); });
  EXPECT_EQ(content("out/thesis.txt"), "precious");
  std::filesystem::remove(path("out/thesis.txt"));
  WorkFolder(folder_, plan, true).finish(0, tiles_[0]);
  auto other = plan;
  other.fingerprint = "another";
  expect_error(Errc::invalid_argument, {"unfinished", "of other points"}, open(other));
  other = plan;
  other.num_tiles = 4;
  expect_error(Errc::invalid_argument, {"in 3 tiles, not 4"}, open(other));
  other = plan;
  other.dimension = 3;
  expect_error(Errc::invalid_argument, {"dimension 2, not 3"}, open(other));
  EXPECT_TRUE(WorkFolder(folder_, plan, true).finished(0));
  file("out/work/plan.json", "{");
  expect_error(Errc::bad_format, {"plan.json"}, open(plan));
  EXPECT_EQ(WorkFolder(folder_, plan, false).num_finished(), 0u);
}

TEST_F(WorkFolderTest, IsOfOneProcess) {
#if DELONE_PORTABLE
  GTEST_SKIP() << "standard C++ has no locks of files";
#endif
  const tiles::Plan plan = plan_of(data_, 3);
  {
    const WorkFolder first(folder_, plan, true);
    for (const bool resume : {false, true})
      expect_error(Errc::cannot_write, {"another process"}, [&] { WorkFolder(folder_, plan, resume); });
    const WorkFolder shared(folder_, plan, true, false);
  }
  const WorkFolder next(folder_, plan, true);
  expect_error(Errc::invalid_argument, {"name of the folder is empty"}, [] { tiles::require_name(""); });
}

TEST_F(WorkFolderTest, NothingOfOthersIsRemoved) {
  const tiles::Plan plan = plan_of(data_, 3);
  {
    WorkFolder work(folder_, plan, true);
    for (std::size_t t = 0; t < 3; ++t) work.finish(t, tiles_[t]);
    work.finish_all(std::uint64_t{1} << 20);
  }
  std::filesystem::create_directory(path("out/work"));
  file("out/work/thesis.txt", "precious");
  EXPECT_TRUE(tiles::find_finished(folder_, plan));
  expect_error(Errc::invalid_argument, {"thesis.txt"}, [&] { WorkFolder(folder_, plan, false); });
  EXPECT_EQ(content("out/work/thesis.txt"), "precious");
  std::filesystem::remove_all(path("out/work"));
  file("out/index.json", "{\"mine\": 1}");
  expect_error(Errc::bad_format, {"index.json"}, [&] { WorkFolder(folder_, plan, false); });
}

TEST_F(WorkFolderTest, FinishedOfAnotherPlanIsAnError) {
  write_folder(folder_, data_, 3);
  tiles::Plan plan = plan_of(data_, 3);
  EXPECT_TRUE(tiles::find_finished(folder_, plan));
  expect_error(Errc::invalid_argument, {"finished"}, [&] { WorkFolder(folder_, plan, true); });
  plan.fingerprint = "another";
  expect_error(Errc::invalid_argument, {"of other points"}, [&] { tiles::find_finished(folder_, plan); });
}

TEST_F(WorkFolderTest, FullDiskLosesNoFinishedTile) {
  if (!test::FileSizeLimit::exists) GTEST_SKIP();
  const tiles::Plan plan = plan_of(data_, 3);
  auto work = std::make_unique<WorkFolder>(folder_, plan, true);
  work->finish(0, tiles_[0]);
  {
    const test::FileSizeLimit full(1500);
    expect_error(Errc::cannot_write, {"part-0001.npz"}, [&] { work->finish(1, tiles_[1]); });
    work.reset();
  }
  EXPECT_EQ(WorkFolder(folder_, plan, true).num_finished(), 1u);
  EXPECT_FALSE(std::filesystem::exists(path("out/part-0001.npz")));
}

}  // namespace
