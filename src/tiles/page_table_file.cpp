// SPDX-License-Identifier: BSD-3-Clause
// What is known of all pages, kept in a file for going on later: a head that tells the kind and the byte
// order, numbers and arrays, and a checksum of all that. See page_file.hpp.
#include "base/progress_meter.hpp"
#include "io/atomic_file.hpp"
#include "io/crc32.hpp"
#include "io/file.hpp"
#include "io/positioned_file.hpp"
#include "tiles/file_content.hpp"
#include "tiles/page_file.hpp"

#include <algorithm>
#include <cstring>
#include <filesystem>
#include <limits>
#include <string_view>
#include <system_error>
#include <type_traits>

namespace delone::tiles {

namespace {

constexpr std::uint64_t head = 0x3130'7365'6761'7044u;  // "Dpages01"

class Writer {
 public:
  explicit Writer(const std::string& path) : file_(path) { put(head); }

  template <class T>
  void put(T value) {
    static_assert(std::is_arithmetic_v<T>);
    put_bytes({reinterpret_cast<const char*>(&value), sizeof value});
  }
  template <class T>
  void put(const std::vector<T>& values) {
    put<std::uint64_t>(values.size());
    put_bytes({reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T)});
  }
  void finish() {
    const std::uint32_t sum = checksum_;
    file_.write(&sum, sizeof sum);
    file_.commit();
  }

 private:
  void put_bytes(std::string_view bytes) {
    checksum_ = io::crc32(bytes, checksum_);
    file_.write(bytes);
  }

  io::AtomicFile file_;
  std::uint32_t checksum_ = 0;
};

class Reader {
 public:
  explicit Reader(const std::string& path) {
    const io::PositionedFile file(path);
    name_ = file.name();
    bytes_.resize(static_cast<std::size_t>(file.size()));
    file.read(0, bytes_.data(), bytes_.size());
    std::uint32_t sum = 0;
    if (bytes_.size() < sizeof head + sizeof sum) damaged();
    end_ = bytes_.size() - sizeof sum;
    std::memcpy(&sum, bytes_.data() + end_, sizeof sum);
    if (get<std::uint64_t>() != head || io::crc32(std::string_view(bytes_).substr(0, end_)) != sum) damaged();
  }

  template <class T>
  T get() {
    if (end_ - at_ < sizeof(T)) damaged();
    T value;
    std::memcpy(&value, bytes_.data() + at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  template <class T>
  std::vector<T> get_array() {
    const auto size = get<std::uint64_t>();
    if (size > (end_ - at_) / sizeof(T)) damaged();
    std::vector<T> values(static_cast<std::size_t>(size));
    if (!values.empty()) std::memcpy(values.data(), bytes_.data() + at_, values.size() * sizeof(T));
    at_ += values.size() * sizeof(T);
    return values;
  }
  /// REQUIRES that all has been read.
  void require(bool condition) const {
    if (!condition || at_ != end_) damaged();
  }

 private:
  [[noreturn]] void damaged() const {
    io::fail(Errc::bad_format, "{}: damaged, or written by another program", name_);
  }

  std::string name_, bytes_;
  std::size_t at_ = 0, end_ = 0;
};

/// Whether the arrays of a table have the sizes that belong together.
bool agrees(const PageTable& table) {
  if (table.dimension < 1 || table.first_point.empty() || table.first_point.front() != 0) return false;
  const auto d = static_cast<std::size_t>(table.dimension);
  const std::size_t num_pages = table.num_pages();
  if (!std::is_sorted(table.first_point.begin(), table.first_point.end()) ||
      table.first_duplicate.size() != table.tiles.size() + 1 || table.first_duplicate.front() != 0 ||
      !std::is_sorted(table.first_duplicate.begin(), table.first_duplicate.end()) ||
      table.boxes.size() != num_pages * 2 * d || table.weights.size() != (table.weighted ? num_pages : 0))
    return false;
  std::size_t page = 0;
  for (const Tile& tile : table.tiles) {
    if (tile.first_page != page || tile.last_page < page || tile.low.size() != d || tile.high.size() != d)
      return false;
    page = tile.last_page;
  }
  return page == num_pages;
}

}  // namespace

void write_page_table(const std::string& path, const PageTable& table) {
  Writer to(path);
  to.put<std::int32_t>(table.dimension);
  to.put<std::int32_t>(table.weighted ? 1 : 0);
  to.put(table.first_point);
  to.put(table.boxes);
  to.put(table.weights);
  to.put(table.first_duplicate);
  to.put<std::uint64_t>(table.tiles.size());
  for (const Tile& tile : table.tiles) {
    to.put<std::uint64_t>(tile.first_page);
    to.put<std::uint64_t>(tile.last_page);
    to.put(tile.low);
    to.put(tile.high);
  }
  for (const io::FileContent& content : {table.pages_content, table.duplicates_content}) {
    to.put(content.num_bytes);
    to.put(content.crc32);
  }
  to.finish();
}

PageTable read_page_table(const std::string& path) {
  Reader from(path);
  PageTable table;
  table.dimension = from.get<std::int32_t>();
  table.weighted = from.get<std::int32_t>() != 0;
  table.first_point = from.get_array<std::uint64_t>();
  table.boxes = from.get_array<double>();
  table.weights = from.get_array<double>();
  table.first_duplicate = from.get_array<std::uint64_t>();
  for (auto left = from.get<std::uint64_t>(); left > 0; --left) {
    Tile& tile = table.tiles.emplace_back();
    tile.first_page = static_cast<std::size_t>(from.get<std::uint64_t>());
    tile.last_page = static_cast<std::size_t>(from.get<std::uint64_t>());
    tile.low = from.get_array<double>();
    tile.high = from.get_array<double>();
  }
  for (io::FileContent* const content : {&table.pages_content, &table.duplicates_content}) {
    content->num_bytes = from.get<std::int64_t>();
    content->crc32 = from.get<std::int64_t>();
  }
  from.require(agrees(table));
  return table;
}

std::optional<PageTable> find_page_table(const std::string& path, const std::string& pages_path) {
  std::error_code error;
  if (!std::filesystem::exists(path, error)) return std::nullopt;
  try {
    PageTable table = read_page_table(path);
    const auto read = [](std::int64_t) { internal::cancellation_point(); };
    if (find_damage(pages_path, table.pages_content, read) ||
        find_damage(pages_path + ".duplicates", table.duplicates_content, read))
      return std::nullopt;
    return table;
  } catch (const Error& error_of_table) {
    if (error_of_table.code() != Errc::bad_format) throw;
    return std::nullopt;
  }
}

}  // namespace delone::tiles
