// SPDX-License-Identifier: BSD-3-Clause
#include "base/platform_files.hpp"

#include "memory_folder.hpp"

#include <gtest/gtest.h>

#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>

namespace delone::internal {
namespace {

using platform::RawFile;

/// Names that are not ASCII, and bytes that a text would lose.
const std::string name = "\xc3\xa9\xe6\xbc\xa2.bin";
constexpr std::string_view bytes("a\r\nb\n\0\x1a\xff", 8);

void write(std::FILE* file) {
  ASSERT_NE(file, nullptr);
  EXPECT_EQ(std::fwrite(bytes.data(), 1, bytes.size(), file), bytes.size());
  EXPECT_EQ(std::fclose(file), 0);
}

TEST(PlatformFiles, KeepTheirBytesAndNames) {
  const test::MemoryFolder folder;
  const std::string path = folder.file("") + name;
  write(platform::open_file(path, "wb"));
  write(platform::open_file(path, "ab"));
  EXPECT_TRUE(std::filesystem::exists(platform::path_of(path)));
  std::FILE* const file = platform::open_file(path, "rb");
  ASSERT_NE(file, nullptr);
  char found[20];
  EXPECT_EQ(std::fread(found, 1, sizeof found, file), 2 * bytes.size());
  std::fclose(file);
  EXPECT_EQ(std::string_view(found, bytes.size()), bytes);
  EXPECT_EQ(std::string_view(found + bytes.size(), bytes.size()), bytes);
  platform::remove_file(path);
  EXPECT_FALSE(std::filesystem::exists(platform::path_of(path)));
  EXPECT_EQ(platform::open_file(path, "rb"), nullptr);
  EXPECT_EQ(errno, ENOENT);
}

TEST(PlatformFiles, AreSynced) {
  const test::MemoryFolder folder;
  const std::string path = folder.file("") + name;
  std::FILE* const file = platform::open_file(path, "wb");
  ASSERT_NE(file, nullptr);
  std::fwrite(bytes.data(), 1, bytes.size(), file);
  std::fflush(file);
  EXPECT_EQ(platform::sync_stream(file), 0);
  std::fclose(file);
  EXPECT_EQ(platform::sync_piece(path, 0, 3), 0);
  EXPECT_EQ(platform::sync_piece(path, 4, 100), 0);
  EXPECT_EQ(platform::sync_file(path), 0);
  EXPECT_EQ(platform::sync_folder(folder.file("")), 0);
#if DELONE_POSIX || DELONE_WINDOWS
  EXPECT_EQ(platform::sync_file(path + "?"), ENOENT);
  EXPECT_EQ(platform::sync_folder(folder.file("none")), ENOENT);
#endif
}

TEST(PlatformFiles, AreCreatedOnce) {
  const test::MemoryFolder folder;
  write(platform::create_file(folder.file("") + name));
  EXPECT_EQ(platform::create_file(folder.file("") + name), nullptr);
  EXPECT_EQ(errno, EEXIST);
}

TEST(RawFile, ReadsAndWritesAnywhere) {
  const test::MemoryFolder folder;
  const std::string path = folder.file("") + name;
  RawFile opened;
  ASSERT_EQ(opened.open(path, true), 0);
  RawFile file(std::move(opened));
  const auto put = [&](std::uint64_t offset, std::string_view text) {
    std::size_t done = 0;
    EXPECT_EQ(file.write_some(offset, text.data(), text.size(), done), 0);
    EXPECT_EQ(done, text.size());
  };
  const std::uint64_t far = (std::uint64_t{1} << 32) + 5;  // beyond 32 bits: a hole
  put(4, bytes);
  put(far, "end");
  put(0, "abc");
  std::uint64_t size = 0;
  EXPECT_EQ(file.size(size), 0);
  EXPECT_EQ(size, far + 3);
  const auto get = [](const RawFile& from, std::uint64_t offset) {
    char found[8]{};
    std::size_t done = 0;
    EXPECT_EQ(from.read_some(offset, found, sizeof found, done), 0);
    return std::string(found, done);
  };
  EXPECT_EQ(get(file, 4), bytes);
  EXPECT_EQ(get(file, far), "end");
  EXPECT_EQ(get(file, far + 3), "");
  {
    RawFile reader;  // while it is written
    ASSERT_EQ(reader.open(path, false), 0);
    EXPECT_EQ(get(reader, 0), std::string_view("abc\0a\r\nb", 8));
  }
  EXPECT_EQ(file.close(), 0);
  EXPECT_EQ(file.close(), 0);
}

TEST(RawFile, SaysWhyNot) {
  const test::MemoryFolder folder;
  RawFile none, directory, nowhere;
  EXPECT_EQ(none.open(folder.file("none"), false), ENOENT);
  EXPECT_EQ(nowhere.open(folder.file("none/file"), true), ENOENT);
  EXPECT_EQ(directory.open(folder.file(""), true), EISDIR);
}

TEST(FileLock, IsHeldOnceAtATime) {
  const test::MemoryFolder folder;
  const std::string path = folder.file("lock");
  for (int turn = 0; turn < 2; ++turn) {
    const platform::FileLock lock(path.c_str());
    EXPECT_TRUE(lock.is_held());
#if DELONE_LINUX || DELONE_WINDOWS
    const platform::FileLock other(path.c_str());
    EXPECT_FALSE(other.is_held());
#endif
  }
}

}  // namespace
}  // namespace delone::internal
