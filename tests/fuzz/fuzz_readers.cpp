// SPDX-License-Identifier: BSD-3-Clause
// Bytes → a file: reading must succeed or throw delone::Error with a message that is safe to print; what was
// read must be consistent, and the same after it was written and read again. `--target=csv` and so on chooses
// the reader; without it the first byte does.
#include <delone/delone.hpp>

#include "memory_folder.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iterator>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace {

using delone::test::content;
using delone::test::MemoryFolder;

struct Target {
  std::string_view name, format;
  bool is_result;
};
constexpr Target targets[] = {{"csv", "csv", false},      {"tsv", "tsv", false},  {"txt", "txt", false},
                              {"qhull", "qhull", false},  {"off", "off", false},  {"ply", "ply", false},
                              {"npy", "npy", false},      {"json", "json", true}, {"npz", "npz", true},
                              {"off_cells", "off", true}, {"xyz", "xyz", false},  {"pdb", "pdb", false},
                              {"las", "las", false}};
const Target* chosen = nullptr;

void require(bool condition, const std::string& what) {
  if (condition) return;
  std::fprintf(stderr, "fuzz_readers: %s\n", what.c_str());
  std::abort();
}

/// A file without a name, in memory.
class MemoryFile {
 public:
  MemoryFile() : descriptor_(memfd_create("delone_fuzz", 0)) {
    require(descriptor_ >= 0, "no file in memory");
  }
  std::string path() const { return "/proc/self/fd/" + std::to_string(descriptor_); }
  void hold(const std::uint8_t* data, std::size_t size) const {
    require(
        ftruncate(descriptor_, 0) == 0 && pwrite(descriptor_, data, size, 0) == static_cast<ssize_t>(size),
        "cannot write");
  }

 private:
  int descriptor_;
};

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

void check_points(const delone::PointTable& table, const MemoryFolder& folder) {
  require(table.coordinates.empty() || table.dimension >= 1, "coordinates without a dimension");
  require(
      table.coordinates.size() == table.num_points() * static_cast<std::size_t>(std::max(table.dimension, 0)),
      "an incomplete row");
  for (const double value : table.coordinates)
    require(std::isfinite(value), "a coordinate that is not finite");
  if (table.num_points() == 0) return;
  for (const std::string format : {"csv", "tsv", "npy", "qhull", "off", "txt"}) {
    const std::string path = folder.file("points." + format);
    delone::write_points(path, table, format);
    const delone::PointTable again = delone::read_points(path, {.format = format, .columns = {}});
    require(again.dimension == table.dimension && same_bits(again.coordinates, table.coordinates),
            "other points after " + format);
  }
}

/// Writing throws where the arrays disagree. What is written must read back as the same.
void check_result(const delone::AnyData& read, const MemoryFolder& folder) {
  const auto write = [](const std::string& path, const delone::AnyData& any) {
    std::visit([&](const auto& data) { delone::write(path, data); }, any);
  };
  const delone::CheckReport report = std::visit([](const auto& data) { return delone::check(data); }, read);
  require(report.ok == report.violation.empty(), "a report without a reason");
  const std::string json = folder.file("data.json"), npz = folder.file("data.npz"),
                    again = folder.file("again.json");
  try {
    write(json, read);
    write(npz, read);
  } catch (const delone::Error& error) {
    require(!report.ok, std::string("right, and cannot be written: ") + error.what());
    return;
  }
  const std::string expected = content(json);
  for (const std::string& path : {json, npz}) {
    write(again, delone::read(path));
    require(content(again) == expected, "another result after " + path);
  }
}

}  // namespace

extern "C" int LLVMFuzzerInitialize(int* argc, char*** argv) {
  constexpr std::string_view option = "--target=";
  for (int i = 1; i < *argc; ++i) {
    const std::string_view argument = (*argv)[i];
    if (!argument.starts_with(option)) continue;
    chosen = std::find_if(std::begin(targets), std::end(targets), [&](const Target& target) {
      return target.name == argument.substr(option.size());
    });
    require(chosen != std::end(targets), "no such target");
  }
  return 0;
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const MemoryFile file;
  static const MemoryFolder folder;
  const Target* target = chosen;
  if (target == nullptr) {
    if (size == 0) return 0;
    target = &targets[data[0] % std::size(targets)];
    ++data, --size;
  }
  file.hold(data, size);
  const std::string format(target->format);
  try {
    if (target->is_result)
      check_result(delone::read(file.path(), format), folder);
    else
      check_points(delone::read_points(file.path(), {.format = format, .columns = {}}), folder);
  } catch (const delone::Error& error) {
    const std::string message = error.what();
    require(message.starts_with("/"), "an error that does not name the file: " + message);
    require(delone::printable(message, message.size()) == message, "a message that is not safe to print");
    require(message.size() < 2000, "a message without a limit");
  }
  return 0;
}

#ifdef DELONE_LIBFUZZER
namespace {

/// An archive in place, by the records of its directory.
class Archive {
 public:
  Archive(std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  /// Makes the checksums right, and the names of members those of the directory.
  void repair() {
    for (std::size_t at = 0; at + 46 <= size_; ++at) {
      if (std::memcmp(data_ + at, "PK\1\2", 4) != 0) continue;
      const std::size_t local = number(at + 42, 4), length = number(at + 24, 4);
      if (local + 30 > size_ || std::memcmp(data_ + local, "PK\3\4", 4) != 0) continue;
      const std::size_t name = number(at + 28, 2), local_name = number(local + 26, 2);
      const std::size_t start = local + 30 + local_name + number(local + 28, 2);
      if (name == local_name && at + 46 + name <= size_ && start <= size_)
        std::memmove(data_ + local + 30, data_ + at + 46, name);
      if (start > size_ || length > size_ - start) continue;
      const std::uint32_t sum = checksum(start, length);
      for (std::size_t i = 0; i < 4; ++i) data_[at + 16 + i] = data_[local + 14 + i] = (sum >> 8 * i) & 0xff;
    }
  }

 private:
  std::size_t number(std::size_t at, std::size_t bytes) const {
    std::size_t value = 0;
    for (std::size_t i = bytes; i-- > 0;) value = value << 8 | data_[at + i];
    return value;
  }
  std::uint32_t checksum(std::size_t start, std::size_t length) const {
    std::uint32_t sum = 0xffffffff;
    for (std::size_t i = 0; i < length; ++i) {
      sum ^= data_[start + i];
      for (int bit = 0; bit < 8; ++bit) sum = (sum & 1) != 0 ? 0xedb88320u ^ (sum >> 1) : sum >> 1;
    }
    return ~sum;
  }

  std::uint8_t* data_;
  std::size_t size_;
};

}  // namespace

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

/// A change within a member shows in its checksum: most archives get a right one.
extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most,
                                               unsigned seed) {
  size = LLVMFuzzerMutate(data, size, most);
  if (chosen != nullptr && chosen->name == "npz" && seed % 8 != 0) Archive(data, size).repair();
  return size;
}
#endif
