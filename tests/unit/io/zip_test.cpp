// SPDX-License-Identifier: BSD-3-Clause
// Zip archives: our own, with and without zip64 records, ones as NumPy writes them, and damaged ones.
#include "io/zip.hpp"
#include "io/atomic_file.hpp"
#include "io/crc32.hpp"
#include "io_support.hpp"

namespace {

using namespace delone;
using delone_test::bytes_of;
using delone_test::expect_error;

class Zip : public delone_test::TemporaryDirectory {
 protected:
  std::string archive(std::uint64_t zip64_from) const {
    io::AtomicFile out(path("a.zip"));
    io::ZipWriter zip(out, zip64_from);
    zip.add("one", "he", "llo");
    zip.add("empty", "", "");
    zip.add("large", std::string(100000, 'a'), std::string(100000, 'b'));
    zip.add("last", "x", "");
    zip.finish();
    out.commit();
    return content("a.zip");
  }
};

TEST_F(Zip, RoundTripWithAnyMixOfZip64Records) {
  // The thresholds put in turn no field, the large offset, sizes and offsets, and everything into zip64 form.
  for (const std::uint64_t zip64_from :
       {std::uint64_t{0xffffffff}, std::uint64_t{200100}, std::uint64_t{1000}, std::uint64_t{1}}) {
    const std::string bytes = archive(zip64_from);
    const io::ZipReader zip(bytes, "a.zip");
    ASSERT_EQ(zip.members().size(), 4u) << zip64_from;
    EXPECT_EQ(zip.find("one"), "hello");
    EXPECT_EQ(zip.find("empty"), "");
    EXPECT_EQ(zip.find("large"), std::string(100000, 'a') + std::string(100000, 'b'));
    EXPECT_EQ(zip.find("last"), "x");
    EXPECT_FALSE(zip.find("none").has_value());
  }
}

TEST_F(Zip, EqualContentGivesEqualFiles) { EXPECT_EQ(archive(0xffffffff), archive(0xffffffff)); }

/// A member as numpy.savez writes it: the local header in zip64 form, the directory not.
std::string numpy_archive(std::uint16_t method = 0, std::uint16_t flags = 0,
                          const std::string& comment = "") {
  const std::string name = "x.npy", data = "content";
  const std::string crc = bytes_of(io::crc32(data)), size = bytes_of<std::uint32_t>(7);
  const auto u16 = [](int v) { return bytes_of(static_cast<std::uint16_t>(v)); };
  const auto u32 = [](std::uint32_t v) { return bytes_of(v); };
  std::string out = u32(0x04034b50) + u16(45) + u16(flags) + u16(method) + u16(0) + u16(0x21) + crc +
                    u32(0xffffffff) + u32(0xffffffff) + u16(5) + u16(20) + name + u16(1) + u16(16) +
                    bytes_of<std::uint64_t>(7) + bytes_of<std::uint64_t>(7) + data;
  const auto start = static_cast<std::uint32_t>(out.size());
  out += u32(0x02014b50) + u16(45) + u16(45) + u16(flags) + u16(method) + u16(0) + u16(0x21) + crc + size +
         size + u16(5) + u16(0) + u16(0) + u16(0) + u16(0) + u32(0) + u32(0) + name;
  const auto length = static_cast<std::uint32_t>(out.size()) - start;
  return out + u32(0x06054b50) + u16(0) + u16(0) + u16(1) + u16(1) + u32(length) + u32(start) +
         u16(static_cast<int>(comment.size())) + comment;
}

TEST_F(Zip, AsNumpyWrites) {
  EXPECT_EQ(io::ZipReader(numpy_archive(), "a").members().size(), 1u);
  const std::string plain = numpy_archive(), commented = numpy_archive(0, 0, "a comment");
  EXPECT_EQ(io::ZipReader(plain, "a").find("x.npy"), "content");
  EXPECT_EQ(io::ZipReader(commented, "a").find("x.npy"), "content");
}

TEST_F(Zip, Unsupported) {
  expect_error(Errc::unsupported, {"a.npz", "x.npy", "numpy.savez "}, [] {
    const std::string bytes = numpy_archive(8);
    io::ZipReader(bytes, "a.npz").find("x.npy");
  });
  expect_error(Errc::unsupported, {"x.npy", "encrypted"}, [] {
    const std::string bytes = numpy_archive(0, 1);
    io::ZipReader(bytes, "a.npz").find("x.npy");
  });
}

TEST_F(Zip, Damaged) {
  expect_error(Errc::bad_format, {"a.npz", "empty"}, [] { io::ZipReader("", "a.npz"); });
  expect_error(Errc::bad_format, {"a.npz", "not a zip"},
               [] { io::ZipReader("\x93NUMPY and much more than a directory needs", "a.npz"); });
  expect_error(Errc::bad_format, {"a.npz", "checksum"}, [] {
    std::string bytes = numpy_archive();
    bytes[bytes.find("content")] = 'C';
    io::ZipReader(bytes, "a.npz").find("x.npy");
  });
  for (const std::uint64_t zip64_from : {std::uint64_t{0xffffffff}, std::uint64_t{1}}) {
    const std::string whole = archive(zip64_from);
    for (std::size_t cut = 1; cut < 400; ++cut)
      expect_error(Errc::bad_format, {"a.npz"},
                   [&] { io::ZipReader(std::string_view(whole).substr(0, whole.size() - cut), "a.npz"); });
  }
}

TEST_F(Zip, AnyChangedByteIsAnErrorOrHarmless) {
  const std::string whole = numpy_archive();
  for (std::size_t i = 0; i < whole.size(); ++i)
    for (const int change : {1, 2, 4, 8, 0x10, 0x20, 0x40, 0x80, 0xff}) {
      std::string bytes = whole;
      bytes[i] = static_cast<char>(bytes[i] ^ change);
      try {
        EXPECT_EQ(io::ZipReader(bytes, "a.npz").find("x.npy"), "content") << i;
      } catch (const Error& error) {
        EXPECT_TRUE(error.code() == Errc::bad_format || error.code() == Errc::unsupported) << error.what();
      }
    }
}

TEST_F(Zip, NoMemberIsLost) {
  const std::string whole = archive(0xffffffff);
  const auto changed = [&](std::size_t at, char to) {
    std::string bytes = whole;
    bytes[at] = to;
    return bytes;
  };
  // In the member itself, and in the directory.
  for (const std::size_t at : {whole.find("empty"), whole.rfind("empty")})
    expect_error(Errc::bad_format, {"a.npz", "disagree about its name", "'empty'", "'eXpty'"},
                 [&] { io::ZipReader(changed(at + 1, 'X'), "a.npz"); });
  expect_error(Errc::bad_format, {"a.npz", "more than 3 entries"},
               [&] { io::ZipReader(changed(whole.size() - 12, 3), "a.npz"); });
}

TEST_F(Zip, NamesAreMetOnce) {
  io::AtomicFile out(path("a.zip"));
  io::ZipWriter zip(out);
  zip.add("one\x1b", "he", "llo");
  zip.add("two", "", "");
  zip.add("one\x1b", "", "");
  zip.finish();
  out.commit();
  const std::string bytes = content("a.zip");
  expect_error(Errc::bad_format, {"a.npz", "'one\\x1b' appears twice"},
               [&] { io::ZipReader(bytes, "a.npz"); });
}

}  // namespace
