// SPDX-License-Identifier: BSD-3-Clause
// What belongs to a folder of tiles and what is somebody else's, which nothing removes.
#include "tiles/folder_names.hpp"

#include "../io/io_support.hpp"

#include <filesystem>
#include <string>
#include <utility>

namespace delone_test {
namespace {

using namespace delone;
using namespace delone::tiles;
namespace fs = std::filesystem;

class FolderNames : public TemporaryDirectory {
 protected:
  FolderNames() {
    fs::create_directory(path("work"));
    for (const char* const name :
         {"index.json", "tiles.pvtu", "part-0000.npz", "part-0001.seams.npy", "part-0000.vtu",
          ".delone-partial-7", "work/plan.json", "work/lock", "work/tile-0000.npz", "work/seams-0000.bin"})
      file(name, "x");
  }
  std::string folder() const { return path("."); }
  bool has(const std::string& name) const { return fs::exists(path(name)); }
};

TEST_F(FolderNames, OfOthersAreNamed) {
  EXPECT_EQ(foreign_names(folder()), "");
  EXPECT_EQ(foreign_names(path("none")), "") << "a folder that is not there has none";
  file("work/notes", "x");
  file("part-0000.txt", "x");
  file("a\nb", "x");
  const std::string names = foreign_names(folder());
  EXPECT_NE(names.find("part-0000.txt"), std::string::npos) << names;
  EXPECT_NE(names.find("work"), std::string::npos) << names;
  EXPECT_NE(names.find("notes"), std::string::npos) << names;
  EXPECT_EQ(names.find('\n'), std::string::npos) << "names are made printable";
  EXPECT_LT(names.find("part-0000.txt"), names.find("notes")) << "in order";
}

TEST_F(FolderNames, PartsAreRemovedAndNothingElse) {
  file("mine.txt", "x");
  remove_parts(folder());
  EXPECT_TRUE(has("mine.txt"));
  EXPECT_EQ(num_files(), 1u);
  expect_error(Errc::cannot_write, {"none"}, [&] { remove_parts(path("none")); });
}

TEST_F(FolderNames, OneProcessHasTheFolder) {
#if DELONE_PORTABLE
  GTEST_SKIP() << "standard C++ has no locks of files";
#endif
  auto lock = lock_work(folder());
  expect_error(Errc::cannot_write, {"another process is making tiles"}, [&] { lock_work(folder()); });
  remove_leftover_work(folder());
  EXPECT_TRUE(has("work/plan.json")) << "somebody works there";
  lock.reset();
  lock = lock_work(folder());
  remove_work(folder(), std::move(lock));
  EXPECT_FALSE(has("work"));
  EXPECT_TRUE(has("index.json"));
}

TEST_F(FolderNames, LeftoverWorkIsRemovedUnlessOthersHaveFilesThere) {
  file("work/notes", "x");
  remove_leftover_work(folder());
  EXPECT_TRUE(has("work/plan.json"));
  fs::remove(path("work/notes"));
  remove_leftover_work(folder());
  EXPECT_FALSE(has("work"));
  remove_leftover_work(folder());  // there is none
  EXPECT_TRUE(has("index.json"));
}

}  // namespace
}  // namespace delone_test
