// SPDX-License-Identifier: BSD-3-Clause
// What the tests of readers and writers share: a directory of their own, byte strings, and the expectation of
// an error.
#pragma once

#include <gtest/gtest.h>
#include <delone/error.hpp>
#include <delone/io.hpp>

#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <string_view>
#include <vector>

namespace delone_test {

/// A directory that exists for the time of a test.
class TemporaryDirectory : public ::testing::Test {
 protected:
  TemporaryDirectory() {
    static std::atomic<int> counter{0};
    do {
      directory_ = std::filesystem::temp_directory_path() /
                   ("delone_io_" + std::to_string(std::random_device{}()) + "_" + std::to_string(++counter));
    } while (!std::filesystem::create_directory(directory_));
  }
  ~TemporaryDirectory() override {
    std::error_code ignored;
    std::filesystem::remove_all(directory_, ignored);
  }

  std::string path(const std::string& name) const { return (directory_ / name).string(); }
  /// Writes a file and gives its path.
  std::string file(const std::string& name, std::string_view content) const {
    std::ofstream(path(name), std::ios::binary) << content;
    return path(name);
  }
  std::string content(const std::string& name) const {
    std::ifstream in(path(name), std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
  }
  std::size_t num_files() const {
    return static_cast<std::size_t>(std::distance(std::filesystem::directory_iterator(directory_), {}));
  }

  /// The points of a file with this name and content.
  delone::PointTable read(const std::string& name, std::string_view text,
                          const std::vector<std::string>& columns = {}) const {
    return delone::read_points(file(name, text), {"", columns});
  }

 private:
  std::filesystem::path directory_;
};

/// Expects Error with this code, and all of these parts in its message; gives its rows.
template <class Work>
std::vector<std::size_t> expect_error(delone::Errc code, const std::vector<std::string>& parts, Work&& work) {
  try {
    work();
  } catch (const delone::Error& error) {
    EXPECT_EQ(static_cast<int>(error.code()), static_cast<int>(code)) << error.what();
    for (const std::string& part : parts)
      EXPECT_NE(std::string_view(error.what()).find(part), std::string_view::npos)
          << "no \"" << part << "\" in: " << error.what();
    return error.rows();
  } catch (const std::exception& error) {
    ADD_FAILURE() << "not a delone::Error: " << error.what();
    return {};
  }
  ADD_FAILURE() << "no error; expected one that says: " << (parts.empty() ? std::string{} : parts[0]);
  return {};
}

/// The bytes of a number in the given byte order.
template <class T>
std::string bytes_of(T value, bool big_endian = false) {
  std::string out(sizeof(T), '\0');
  std::memcpy(out.data(), &value, sizeof(T));
  if (big_endian != (std::endian::native == std::endian::big)) return {out.rbegin(), out.rend()};
  return out;
}

/// An .npy file as NumPy writes it.
inline std::string npy(const std::string& descr, const std::string& shape, const std::string& data,
                       bool fortran = false, int version = 1) {
  std::string header = "{'descr': '" + descr + "', 'fortran_order': " + (fortran ? "True" : "False") +
                       ", 'shape': " + shape + ", }";
  header.resize(version == 1 ? 117 : 115, ' ');
  header += '\n';
  std::string out = "\x93NUMPY";
  out += static_cast<char>(version);
  out += '\0';
  out += version == 1 ? bytes_of(static_cast<std::uint16_t>(header.size()))
                      : bytes_of(static_cast<std::uint32_t>(header.size()));
  return out + header + data;
}

template <class T>
std::string npy_of(const std::string& descr, const std::string& shape, const std::vector<T>& values,
                   bool fortran = false) {
  std::string data;
  for (const T value : values) data += bytes_of(value, descr[0] == '>');
  return npy(descr, shape, data, fortran);
}

}  // namespace delone_test
