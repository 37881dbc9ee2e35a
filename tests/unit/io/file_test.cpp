// SPDX-License-Identifier: BSD-3-Clause
// Whole files, formats by name or extension, quotes that are safe to print, and exhausted memory.
#include "io/file.hpp"
#include "io_support.hpp"

#ifndef _WIN32
#include <unistd.h>
#endif

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <filesystem>
#include <new>
#include <stdexcept>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

namespace {

using namespace delone;
using delone_test::expect_error;

class Files : public delone_test::TemporaryDirectory {};

std::string read_all(const std::string& path, std::uint64_t max_stream_bytes = default_max_stream_bytes) {
  return std::string(io::read_all(path, max_stream_bytes, [](std::string_view, bool) {}).view());
}

TEST(Names, AreReadable) {
  EXPECT_EQ(io::joined({}), "");
  EXPECT_EQ(io::joined({"a", "b", "c"}), "a, b, c");
  EXPECT_EQ(io::input_name("-"), "standard input");
  EXPECT_EQ(io::output_name("-"), "standard output");
  EXPECT_EQ(io::input_name("a/b"), "a/b");
  EXPECT_EQ(io::input_name("a\x1b"), "a\\x1b");
  EXPECT_EQ(io::output_name(std::string(300, 'x')), std::string(300, 'x'));
  EXPECT_NE(io::error_text(ENOENT), io::error_text(EACCES));
}

TEST(Names, ListsArePrintableAndOfALimitedLength) {
  EXPECT_EQ(io::joined({"a\x1b[1m", "b\n"}), "a\\x1b[1m, b\\x0a");
  const std::string list = io::joined(std::vector<std::string>(100'000, std::string(1000, 'x')));
  EXPECT_LT(list.size(), 600u);
  EXPECT_TRUE(list.ends_with("… (100000 in all)"));
}

TEST_F(Files, AreReadWhole) {
  const std::string all_bytes("\0\r\n\xff\x1a end", 9), large(300'000, 'x');
  EXPECT_EQ(read_all(file("bytes", all_bytes)), all_bytes);
  EXPECT_EQ(read_all(file("large", large)), large);
  EXPECT_EQ(read_all(file("empty", "")), "");
}

TEST_F(Files, WithoutASizeAreReadWhole) {
  const char* const without_size = "/proc/self/status";  // its size is given as 0
  if (!std::filesystem::exists(without_size)) GTEST_SKIP();
  EXPECT_NE(read_all(without_size).find("Pid:"), std::string_view::npos);
}

TEST_F(Files, SayWhatCannotBeRead) {
  expect_error(Errc::cannot_open, {path("none"), "No such file"}, [&] { read_all(path("none")); });
  expect_error(Errc::cannot_open, {path("."), "directory"}, [&] { read_all(path(".")); });
}

#ifndef _WIN32  // which has no paths of pipes
TEST_F(Files, StreamsHaveALimit) {
  std::signal(SIGPIPE, SIG_IGN);
  const std::string text(300'000, 'x');
  for (const std::size_t limit :
       {std::size_t{0}, std::size_t{10}, std::size_t{1} << 16, text.size(), text.size() + 1}) {
    int ends[2];
    ASSERT_EQ(pipe(ends), 0);
    std::thread writer([&] {
      std::size_t left = text.size();
      for (ssize_t n = 1; left > 0 && n > 0; left -= n > 0 ? static_cast<std::size_t>(n) : 0)
        n = write(ends[1], text.data(), left);
      close(ends[1]);
    });
    const std::string stream = "/dev/fd/" + std::to_string(ends[0]);
    if (limit >= text.size())
      EXPECT_EQ(read_all(stream, limit), text);
    else
      expect_error(Errc::out_of_memory, {stream, "more than " + std::to_string(limit), "max_stream_bytes"},
                   [&] { read_all(stream, limit); });
    close(ends[0]);
    writer.join();
  }
  EXPECT_EQ(read_all(file("large", text), 10), text);  // no stream
}
#endif

TEST_F(Files, MayBeRefusedByTheirOpening) {
  const auto opening_of = [&](const std::string& name) {
    std::pair<std::size_t, bool> seen;
    io::read_all(name, default_max_stream_bytes, [&](std::string_view opening, bool is_whole) {
      seen = {opening.size(), is_whole};
    });
    return seen;
  };
  EXPECT_EQ(opening_of(file("empty", "")), std::pair(std::size_t{0}, true));
  EXPECT_EQ(opening_of(file("short", "abc")), std::pair(std::size_t{3}, true));
  EXPECT_EQ(opening_of(file("long", std::string(100'000, 'x'))), std::pair(std::size_t{1} << 16, false));
  const auto refuse = [](std::string_view, bool) { throw Error(Errc::bad_format, "refused"); };
  if (!std::filesystem::exists("/dev/zero")) return;
  expect_error(Errc::bad_format, {"refused"},
               [&] { io::read_all("/dev/zero", default_max_stream_bytes, refuse); });
}

TEST(Text, HasNoZeroBytes) {
  io::require_text("a\n", "a.txt");
  expect_error(Errc::bad_format, {"a.txt", "byte 1 is zero"},
               [] { io::require_text(std::string_view("a\0", 2), "a.txt"); });
}

std::string chosen(const std::string& path, const std::string& format) {
  return io::choose_format(path, format, "txt", {"txt", "npy"}, io::Use::reading, "points");
}

TEST(ChooseFormat, ByNameThenStreamThenExtension) {
  EXPECT_EQ(chosen("a.npy", ""), "npy");
  EXPECT_EQ(chosen("dir.txt/A.NPY", ""), "npy");
  EXPECT_EQ(chosen("a.npy", "TXT"), "txt");
  EXPECT_EQ(chosen("-", ""), "txt");
  EXPECT_EQ(chosen("-", "npy"), "npy");
  EXPECT_EQ(chosen("a.npy.gz", ""), "npy");
  expect_error(Errc::unsupported, {"not written compressed", "a.npy"}, [] {
    io::choose_format("a.npy.gz", "", "txt", {"txt", "npy"}, io::Use::writing, "points");
  });
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
