// SPDX-License-Identifier: BSD-3-Clause
// Files that are not what was written: shorter, longer, changed, or missing.
#include "tiles/file_content.hpp"

#include "../io/io_support.hpp"
#include "base/platform.hpp"

#include <string>
#include <utility>

namespace delone_test {
namespace {

using namespace delone;
using tiles::find_damage;
using tiles::require_content;

class FileContents : public TemporaryDirectory {};

io::FileContent content_of(std::string_view bytes) {
  io::FileContent content;
  content.add(bytes);
  return content;
}

TEST_F(FileContents, BytesAreThoseThatAreExpected) {
  const std::string bytes = "some bytes", other = "same bytes";
  const io::FileContent expected = content_of(bytes);
  require_content(bytes, expected, "f");
  require_content("", content_of(""), "f");
  expect_error(Errc::bad_format, {"f: truncated: 4 bytes, not 10"},
               [&] { require_content("some", expected, "f"); });
  expect_error(Errc::bad_format, {"f: damaged: 11 bytes, not 10"},
               [&] { require_content("some bytes!", expected, "f"); });
  expect_error(Errc::bad_format, {"f: damaged: its CRC-32 is ", ", not "},
               [&] { require_content(other, expected, "f"); });
}

TEST_F(FileContents, DamageIsFoundInPieces) {
  std::string bytes((std::size_t{1} << 21) + 77, 'x');
  const io::FileContent expected = content_of(bytes);
  std::int64_t num_read = 0;
  int num_pieces = 0;
  const auto read = [&](std::int64_t size) {
    num_read += size;
    ++num_pieces;
  };
  EXPECT_EQ(find_damage(file("whole", bytes), expected, read), std::nullopt);
  EXPECT_EQ(num_read, expected.num_bytes);
  EXPECT_EQ(num_pieces, 3);
  bytes[bytes.size() - 1] = 'y';  // in the last piece
  const auto changed = find_damage(file("changed", bytes), expected, read);
  ASSERT_TRUE(changed);
  EXPECT_NE(changed->find("changed: damaged: its CRC-32"), std::string::npos) << *changed;
  num_read = 0;
  const auto cut = find_damage(file("cut", bytes.substr(1)), expected, read);
  ASSERT_TRUE(cut);
  EXPECT_NE(cut->find("cut: truncated"), std::string::npos) << *cut;
  EXPECT_EQ(num_read, 0) << "the size tells before anything is read";
  const auto missing = find_damage(path("missing"), expected, read);
  ASSERT_TRUE(missing);
  EXPECT_NE(missing->find("missing"), std::string::npos) << *missing;
}

TEST_F(FileContents, WhatReadingThrowsIsNoDamage) {
  const std::string bytes = "some bytes";
  expect_error(Errc::cancelled, {}, [&] {
    find_damage(file("a", bytes), content_of(bytes),
                [](std::int64_t) { throw Error(Errc::cancelled, "cancelled"); });
  });
}

TEST_F(FileContents, AreSyncedIfTheyAreThere) {
  tiles::sync_file(file("a", "some bytes"));
  tiles::sync_file(file("empty", ""));
  tiles::sync_folder(path("."));
#if !DELONE_PORTABLE
  expect_error(Errc::cannot_write, {"none"}, [&] { tiles::sync_file(path("none")); });
#if !DELONE_WINDOWS
  expect_error(Errc::cannot_write, {"none"}, [&] { tiles::sync_folder(path("none")); });
#endif
#endif
}

}  // namespace
}  // namespace delone_test
