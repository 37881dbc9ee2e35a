// SPDX-License-Identifier: BSD-3-Clause
// Compressed files, of blocks that are only stored, so that the tests need no compressor.
#include "io/gzip.hpp"

#include "io/crc32.hpp"
#include "io/file.hpp"
#include "io/zip.hpp"
#include "io_support.hpp"

#include <algorithm>

namespace delone::io {
namespace {

using delone_test::expect_error;

std::string little_endian(std::uint32_t value, std::size_t size) {
  std::string bytes;
  for (std::size_t i = 0; i < size; ++i) bytes += static_cast<char>(value >> 8 * i & 0xff);
  return bytes;
}

/// A member of a gzip file (RFC 1952) with stored blocks (RFC 1951, 3.2.4) of at most so many bytes.
std::string member(std::string_view content, std::size_t block = 1000) {
  std::string bytes("\x1f\x8b\x08\x00\x00\x00\x00\x00\x00\x03", 10);
  std::string_view rest = content;
  do {
    const std::size_t size = std::min(block, rest.size());
    bytes += size == rest.size() ? '\1' : '\0';
    bytes += little_endian(static_cast<std::uint32_t>(size), 2) +
             little_endian(~static_cast<std::uint32_t>(size), 2);
    bytes += rest.substr(0, size);
    rest.remove_prefix(size);
  } while (!rest.empty());
  return bytes + little_endian(crc32(content), 4) +
         little_endian(static_cast<std::uint32_t>(content.size()), 4);
}

/// Gives at most `step` bytes at once, but all that are asked for, as files do.
ReadBytes source(std::string bytes) {
  return [bytes = std::move(bytes), at = std::size_t{0}](char* to, std::size_t size) mutable {
    const std::size_t found = std::string_view(bytes).substr(at).copy(to, size);
    at += found;
    return found;
  };
}

std::string all_of(const ReadBytes& read, std::size_t step) {
  std::string all, piece(step, '\0');
  for (std::size_t found = step; found == step;) {
    found = read(piece.data(), step);
    all.append(piece, 0, found);
  }
  return all;
}

bool has_zlib() {
  try {
    decompressed(source(""), "f");
    return true;
  } catch (const Error& e) {
    EXPECT_EQ(e.code(), Errc::unsupported);
    EXPECT_NE(std::string(e.what()).find("f: compressed by gzip, and this build"), std::string::npos);
    return false;
  }
}

class Gzip : public delone_test::TemporaryDirectory {};

TEST_F(Gzip, IsToldByItsFirstBytesAndItsName) {
  EXPECT_TRUE(is_gzip(member("")));
  EXPECT_FALSE(is_gzip(""));
  EXPECT_FALSE(is_gzip("\x1f"));
  EXPECT_TRUE(has_gzip_name("a.csv.gz"));
  EXPECT_TRUE(has_gzip_name("a.GZ"));
  for (const char* name : {"", ".gz", "gz", "a.gzip", "a.gz.csv"}) EXPECT_FALSE(has_gzip_name(name)) << name;
  EXPECT_EQ(without_gzip_name("a.csv.gz"), "a.csv");
  EXPECT_EQ(without_gzip_name("a.csv"), "a.csv");
}

TEST_F(Gzip, OpeningsArePutBack) {
  for (const std::string text : {"", "a", "ab", "a text"})
    for (const std::size_t step : {1, 2, 3, 100}) {
      EXPECT_EQ(all_of(maybe_decompressed(source(text), "f"), step), text);
      EXPECT_EQ(all_of(with_opening(text, source(text)), step), text + text);
    }
}

TEST_F(Gzip, MembersAreReadOneAfterTheOther) {
  if (!has_zlib()) GTEST_SKIP() << "built without zlib";
  std::string text;
  for (int i = 0; i < 20000; ++i) text += std::to_string(i * i) + "\n";
  const std::string padding(1000, '\0');
  for (const std::size_t step :
       {std::size_t{1}, std::size_t{7}, std::size_t{1000}, text.size(), 2 * text.size()})
    for (const std::string& file :
         {member(text), member(text, 65535) + padding,
          member("") + member(text.substr(0, 5000)) + member(text.substr(5000)) + member("")})
      ASSERT_EQ(all_of(maybe_decompressed(source(file), "f"), step), text) << step;
}

TEST_F(Gzip, DamageIsAnErrorThatNamesTheFile) {
  if (!has_zlib()) GTEST_SKIP() << "built without zlib";
  const std::string good = member("0 1\n2 3\n");
  const auto refused = [&](const std::string& bytes) {
    expect_error(Errc::bad_format, {"f: the compressed file "},
                 [&] { all_of(decompressed(source(bytes), "f"), 100); });
  };
  for (std::size_t size = 0; size < good.size(); ++size) refused(good.substr(0, size));  // truncated anywhere
  for (const std::size_t at : {2, 11, 12, 20, 26, 30}) {
    std::string bad = good;
    bad[at] = static_cast<char>(bad[at] ^ 0x55);
    refused(bad);
  }
  for (const std::string& after : {std::string("x"), std::string("\0\0x", 3), std::string("\0", 1) + good})
    refused(good + after);
}

TEST_F(Gzip, ReadersAndLimits) {
  if (!has_zlib()) GTEST_SKIP() << "built without zlib";
  EXPECT_EQ(read_points(file("a.csv.gz", member("x,y\n1,2\n3,4\n"))).coordinates,
            (std::vector<double>{1, 2, 3, 4}));
  EXPECT_EQ(read_points(file("a.txt", member("1 2\n"))).dimension, 2);
  expect_error(Errc::bad_format, {"b.csv.gz: not compressed by gzip"},
               [&] { read_points(file("b.csv.gz", "1,2\n")); });
  expect_error(Errc::bad_format, {"a.npz.gz: not an .npz file"},
               [&] { delone::read(file("a.npz.gz", member("text"))); });
  expect_error(Errc::unsupported, {"c.csv.gz: files are not written compressed"},
               [&] { write_points(path("c.csv.gz"), read_points(path("a.csv.gz"))); });
  const std::string large = file("large.txt.gz", member(std::string(50000, '7'), 60000));
  for (const std::uint64_t limit : {0u, 10u, 49999u})
    expect_error(Errc::out_of_memory, {"large.txt.gz", "raise max_stream_bytes"},
                 [&] { read_points(large, {.format = {}, .columns = {}, .max_stream_bytes = limit}); });
  expect_error(Errc::not_finite, {"large.txt.gz:1"},
               [&] { read_points(large, {.format = {}, .columns = {}, .max_stream_bytes = 50000}); });
}

}  // namespace
}  // namespace delone::io
