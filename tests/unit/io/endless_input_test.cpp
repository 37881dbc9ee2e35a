// SPDX-License-Identifier: BSD-3-Clause
// Input without an end, in every format: what the first bytes tell is refused by them, the rest by the limit.
#ifndef _WIN32  // which has no such files

#include "io_support.hpp"

#include <unistd.h>

#include <csignal>
#include <filesystem>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace {

using namespace delone;
using delone_test::expect_error;

const std::vector<std::string> point_formats{"npy", "csv", "tsv", "txt", "xyz",  "pts",
                                             "off", "ply", "pdb", "las", "qhull"};
const std::vector<std::string> data_formats{"npz", "json", "off"};

/// Runs use(path) on a stream: a first piece, then another again and again.
template <class Use>
void with_stream(std::string_view first, std::string_view again, Use use) {
  std::signal(SIGPIPE, SIG_IGN);
  int ends[2];
  ASSERT_EQ(pipe(ends), 0);
  std::thread writer([&] {
    std::string block;
    while (block.size() < 1 << 16) block += again;
    for (ssize_t n = write(ends[1], first.data(), first.size()); n >= 0;)
      n = write(ends[1], block.data(), block.size());
    close(ends[1]);
  });
  use("/dev/fd/" + std::to_string(ends[0]));
  close(ends[0]);
  writer.join();
}

TEST(EndlessInput, ZeroBytesAreNoFormat) {
  if (!std::filesystem::exists("/dev/zero")) GTEST_SKIP();
  for (const std::string& format : point_formats)
    expect_error(Errc::bad_format, {"/dev/zero"},
                 [&] { read_points("/dev/zero", {.format = format, .columns = {}}); });
  for (const std::string& format : data_formats)
    expect_error(Errc::bad_format, {"/dev/zero"}, [&] { read("/dev/zero", format); });
}

TEST(EndlessInput, WordsAreNoNumbers) {
  for (const std::string format : {"npy", "txt", "off", "ply", "qhull"})
    with_stream("", "yes\n", [&](const std::string& path) {
      expect_error(Errc::bad_format, {path}, [&] { read_points(path, {.format = format, .columns = {}}); });
    });
  for (const std::string& format : data_formats)
    with_stream("", "yes\n", [&](const std::string& path) {
      expect_error(Errc::bad_format, {path}, [&] { read(path, format); });
    });
}

TEST(EndlessInput, TheLimitStopsTheRest) {
  struct Stream {
    std::string format;
    std::string_view first, again;
  };
  for (const Stream& stream : std::vector<Stream>{{"npy", "\x93NUMPY\x01", "x"},
                                                  {"csv", "", "a,b\n"},
                                                  {"txt", "", "1 2\n"},
                                                  {"txt", "", "1"},
                                                  {"txt", "", "# "},
                                                  {"off", "OFF\n1 0 0\n", "1 "},
                                                  {"off", "", "# "},
                                                  {"ply", "ply\n", "comment\n"},
                                                  {"qhull", "", "1 "},
                                                  {"qhull", "", "\n"}})
    with_stream(stream.first, stream.again, [&](const std::string& path) {
      expect_error(Errc::out_of_memory, {path, "more than 200000 bytes"}, [&] {
        read_points(path, {.format = stream.format, .columns = {}, .max_stream_bytes = 200'000});
      });
    });
  for (const Stream& stream : std::vector<Stream>{
           {"json", "{\"", "x"}, {"json", "", "\n"}, {"npz", "PK", "PK"}, {"off", "OFF ", "0 "}})
    with_stream(stream.first, stream.again, [&](const std::string& path) {
      expect_error(Errc::out_of_memory, {path, "more than 200000 bytes"},
                   [&] { read(path, stream.format, 200'000); });
    });
}

}  // namespace

#endif
