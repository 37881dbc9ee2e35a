// SPDX-License-Identifier: BSD-3-Clause
// A file appears whole when it is committed, and not at all otherwise.
#include "io/atomic_file.hpp"
#include "io_support.hpp"

#include <delone/progress.hpp>

#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>

namespace {

using namespace delone;
using delone_test::expect_error;
using io::AtomicFile;

class AtomicFiles : public delone_test::TemporaryDirectory {};

TEST_F(AtomicFiles, AppearWhenCommitted) {
  AtomicFile out(path("a"));
  EXPECT_EQ(out.name(), path("a"));
  out.write("text ");
  out.print("{}-{} ", 1, "b");
  out.put(0.1);
  out.put(' ');
  out.put(std::int8_t{-3});
  out.put(' ');
  out.put(std::numeric_limits<std::uint64_t>::max());
  EXPECT_FALSE(std::filesystem::exists(path("a")));
  out.commit();
  EXPECT_EQ(content("a"), "text 1-b 0.1 -3 18446744073709551615");
  EXPECT_EQ(num_files(), 1u);
}

TEST_F(AtomicFiles, SayWhatTheyHold) {
  AtomicFile out(path("a"));
  out.track_content();
  EXPECT_EQ(out.content(), io::FileContent());
  out.write("text ");
  out.put(0.1);
  io::FileContent expected;
  expected.add("text 0.1");
  EXPECT_EQ(out.content(), expected);
  const std::string block(std::size_t{20} << 20, 'x');
  out.write(block);
  out.put(' ');
  expected.add(block + ' ');
  EXPECT_EQ(out.content(), expected);
  out.commit_durably();
  EXPECT_EQ(content("a"), "text 0.1" + block + ' ');
  EXPECT_EQ(num_files(), 1u);
}

TEST_F(AtomicFiles, CanBeStoppedInTheMidstOfALargeBlock) {
  const std::string block(std::size_t{40} << 20, 'x');
  int calls = 0;
  const ProgressScope scope([&](double) { return ++calls < 2; });
  expect_error(Errc::cancelled, {}, [&] {
    AtomicFile out(path("a"));
    for (int i = 0; i < 20; ++i) out.write(block);  // long before the end of this it is asked again
    out.commit();
  });
  EXPECT_EQ(num_files(), 0u);
  EXPECT_EQ(calls, 2);
}

TEST_F(AtomicFiles, LargeBlocksAreWrittenWhole) {
  std::string block(std::size_t{33} << 20, 'x');
  for (std::size_t i = 0; i < block.size(); i += 1000) block[i] = static_cast<char>('a' + i / 1000 % 20);
  AtomicFile out(path("a"));
  out.write(block);
  out.commit();
  EXPECT_TRUE(content("a") == block);
}

TEST_F(AtomicFiles, LeaveNothingUnlessCommitted) {
  {
    AtomicFile out(path("a"));
    out.write(std::string(100'000, 'x'));  // more than is buffered
    EXPECT_EQ(num_files(), 1u);            // under another name
    EXPECT_FALSE(std::filesystem::exists(path("a")));
  }
  EXPECT_EQ(num_files(), 0u);
}

TEST_F(AtomicFiles, KeepTheOldContentUntilCommitted) {
  file("a", "old");
  { AtomicFile(path("a")).write("lost"); }
  EXPECT_EQ(content("a"), "old");
  AtomicFile out(path("a"));
  out.write("new");
  EXPECT_EQ(content("a"), "old");
  out.commit();
  EXPECT_EQ(content("a"), "new");
  EXPECT_EQ(num_files(), 1u);
}

TEST_F(AtomicFiles, KeepTheOrderOfLargeAndSmallPieces) {
  AtomicFile out(path("a"));
  std::string expected;
  for (int i = 0; i < 40; ++i) {
    const std::string piece(i % 10 == 9 ? 70'000 : 3'000, static_cast<char>('a' + i % 26));
    out.write(piece);
    expected += piece;
  }
  out.commit();
  EXPECT_EQ(content("a"), expected);
}

TEST_F(AtomicFiles, FollowSymbolicLinks) {
#ifdef _WIN32
  GTEST_SKIP() << "std::filesystem of MinGW creates no links";
#endif
  file("target", "old");
  std::filesystem::create_symlink(path("target"), path("link"));
  AtomicFile out(path("link"));
  out.write("new");
  out.commit();
  EXPECT_TRUE(std::filesystem::is_symlink(path("link")));
  EXPECT_EQ(content("target"), "new");
}

TEST_F(AtomicFiles, AreWrittenThroughLinksThatDangle) {
#ifdef _WIN32
  GTEST_SKIP() << "std::filesystem of MinGW creates no links";
#endif
  // Relative to the folder of each link, one after the other.
  std::filesystem::create_directory(path("folder"));
  std::filesystem::create_symlink("folder/second", path("first"));
  std::filesystem::create_symlink("../target", path("folder/second"));
  EXPECT_EQ(std::filesystem::weakly_canonical(write_target(path("first"))),
            std::filesystem::weakly_canonical(path("target")));
  write_text(path("first"), "new");
  EXPECT_TRUE(std::filesystem::is_symlink(path("first")));
  EXPECT_TRUE(std::filesystem::is_symlink(path("folder/second")));
  EXPECT_EQ(content("target"), "new");
  EXPECT_FALSE(std::filesystem::is_symlink(path("target")));
  EXPECT_EQ(num_files(), 3u);
}

TEST_F(AtomicFiles, DoNotReplaceLinksThatLeadNowhere) {
#ifdef _WIN32
  GTEST_SKIP() << "std::filesystem of MinGW creates no links";
#endif
  std::filesystem::create_symlink("none/file", path("dangling"));
  expect_error(Errc::cannot_write, {path("dangling"), "No such file"},
               [&] { write_text(path("dangling"), "x"); });
  std::filesystem::create_symlink("b", path("a"));
  std::filesystem::create_symlink("a", path("b"));
  EXPECT_EQ(write_target(path("a")), path("a"));
  expect_error(Errc::cannot_write, {path("a"), "symbolic links"}, [&] { write_text(path("a"), "x"); });
  for (const char* name : {"dangling", "a", "b"}) EXPECT_TRUE(std::filesystem::is_symlink(path(name)));
}

TEST_F(AtomicFiles, TargetsOfWhatIsNoLink) {
  EXPECT_EQ(write_target("-"), "-");
  EXPECT_EQ(write_target(path("none")), path("none"));
  EXPECT_EQ(write_target(file("plain", "x")), path("plain"));
}

TEST_F(AtomicFiles, SayWhatCannotBeWritten) {
  expect_error(Errc::cannot_write, {path("none/a"), "No such file"}, [&] { AtomicFile out(path("none/a")); });
  std::filesystem::create_directory(path("directory"));
  expect_error(Errc::cannot_write, {path("directory"), "directory"},
               [&] { AtomicFile out(path("directory")); });
  if (!std::filesystem::exists("/dev/full")) return;
  expect_error(Errc::cannot_write, {"/dev/full", "space"}, [] {
    AtomicFile out("/dev/full");  // a device is written to directly
    out.write("x");
    out.commit();
  });
}

}  // namespace
