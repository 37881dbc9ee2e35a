// SPDX-License-Identifier: BSD-3-Clause
// Whole files, formats by name or extension, quotes that are safe to print, and exhausted memory.
#include "io/file.hpp"
#include "io_support.hpp"

#include <cerrno>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>

namespace {

using namespace delone;
using delone_test::expect_error;

class Files : public delone_test::TemporaryDirectory {};

TEST(InQuotes, EscapesAndShortens) {
  EXPECT_EQ(io::in_quotes("a b"), "'a b'");
  EXPECT_EQ(io::in_quotes(""), "''");
  EXPECT_EQ(io::in_quotes("\x1b[1m\xff\n"), "'\\x1b[1m\\xff\\x0a'");
  EXPECT_EQ(io::in_quotes(std::string(40, 'x')), "'" + std::string(40, 'x') + "'");
  EXPECT_EQ(io::in_quotes(std::string(41, 'x')), "'" + std::string(40, 'x') + "…'");
}

TEST(Names, AreReadable) {
  EXPECT_EQ(io::joined({}), "");
  EXPECT_EQ(io::joined({"a", "b", "c"}), "a, b, c");
  EXPECT_EQ(io::input_name("-"), "standard input");
  EXPECT_EQ(io::input_name("a/b"), "a/b");
  EXPECT_NE(io::error_text(ENOENT), io::error_text(EACCES));
}

TEST_F(Files, AreReadWhole) {
  const std::string all_bytes("\0\r\n\xff\x1a end", 9), large(300'000, 'x');
  EXPECT_EQ(io::read_all(file("bytes", all_bytes)).view(), all_bytes);
  EXPECT_EQ(io::read_all(file("large", large)).view(), large);
  EXPECT_EQ(io::read_all(file("empty", "")).view(), "");
}

TEST_F(Files, WithoutASizeAreReadWhole) {
  const char* const without_size = "/proc/self/status";  // its size is given as 0
  if (!std::filesystem::exists(without_size)) GTEST_SKIP();
  EXPECT_NE(io::read_all(without_size).view().find("Pid:"), std::string_view::npos);
}

TEST_F(Files, SayWhatCannotBeRead) {
  expect_error(Errc::cannot_open, {path("none"), "No such file"}, [&] { io::read_all(path("none")); });
  expect_error(Errc::cannot_open, {path("."), "directory"}, [&] { io::read_all(path(".")); });
}

std::string chosen(const std::string& path, const std::string& format) {
  return io::choose_format(path, format, "txt", {"txt", "npy"}, "points");
}

TEST(ChooseFormat, ByNameThenStreamThenExtension) {
  EXPECT_EQ(chosen("a.npy", ""), "npy");
  EXPECT_EQ(chosen("dir.txt/A.NPY", ""), "npy");
  EXPECT_EQ(chosen("a.npy", "TXT"), "txt");
  EXPECT_EQ(chosen("-", ""), "txt");
  EXPECT_EQ(chosen("-", "npy"), "npy");
}

TEST(ChooseFormat, ListsWhatIsKnown) {
  expect_error(Errc::unsupported, {"a.csv", "'csv'", "points", "txt, npy"}, [] { chosen("a.csv", ""); });
  expect_error(Errc::unsupported, {"a.txt", "'csv'", "txt, npy"}, [] { chosen("a.txt", "csv"); });
  for (const char* path : {"a", "a.", ".npy", "dir.npy/a"})
    expect_error(Errc::unsupported, {path, "no extension", "txt, npy"}, [&] { chosen(path, ""); });
}

TEST(GuardedReading, TurnsExhaustedMemoryIntoAnError) {
  EXPECT_EQ(io::guarded("f", [] { return 7; }), 7);
  expect_error(Errc::out_of_memory, {"f", "memory"},
               [] { io::guarded("f", [] { throw std::bad_alloc(); }); });
  expect_error(Errc::out_of_memory, {"f"}, [] { io::guarded("f", [] { throw std::length_error("x"); }); });
  expect_error(Errc::bad_format, {"other"},
               [] { io::guarded("f", [] { io::fail(Errc::bad_format, "{}", "other"); }); });
}

}  // namespace
