// SPDX-License-Identifier: BSD-3-Clause
#include "io/positioned_file.hpp"
#include "io_support.hpp"

namespace delone::io {
namespace {

class PositionedFiles : public delone_test::TemporaryDirectory {};

TEST_F(PositionedFiles, ReadAndWriteAnywhere) {
  {
    PositionedFile out(path("a"), PositionedFile::Mode::write);
    out.write(3, "def", 3);
    out.write(0, "abc", 3);
    EXPECT_EQ(out.size(), 6u);
    char back[2];
    out.read(2, back, 2);
    EXPECT_EQ(std::string(back, 2), "cd");
    out.close();
  }
  EXPECT_EQ(content("a"), "abcdef");
  PositionedFile in(path("a"));
  char bytes[8];
  EXPECT_EQ(in.read_some(4, bytes, 8), 2u);
  EXPECT_EQ(in.read_some(9, bytes, 8), 0u);
  const PositionedFile moved = std::move(in);
  EXPECT_EQ(moved.size(), 6u);
  delone_test::expect_error(Errc::bad_format, {path("a"), "expected 9 bytes, found 6"},
                            [&] { moved.read(1, bytes, 8); });
  PositionedFile again(path("a"), PositionedFile::Mode::write);
  EXPECT_EQ(again.size(), 0u);
}

TEST_F(PositionedFiles, SayWhatFails) {
  delone_test::expect_error(Errc::cannot_open, {path("none"), "No such file"},
                            [&] { PositionedFile(path("none")); });
  delone_test::expect_error(Errc::cannot_write, {path("none/a")},
                            [&] { PositionedFile(path("none/a"), PositionedFile::Mode::write); });
  PositionedFile read_only(file("a", "abc"), PositionedFile::Mode::read, "the points");
  delone_test::expect_error(Errc::cannot_write, {"the points: "}, [&] { read_only.write(0, "x", 1); });
}

}  // namespace
}  // namespace delone::io
