// SPDX-License-Identifier: BSD-3-Clause
// Bytes → a file of every format: reading must succeed or throw delone::Error, and what was read must be
// consistent.
#include <delone/delone.hpp>

#include <unistd.h>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <iterator>
#include <string>
#include <variant>

namespace {

void require(bool condition, const char* what) {
  if (condition) return;
  std::fprintf(stderr, "fuzz_readers: %s\n", what);
  std::abort();
}

/// The formats of points, then those of results, each with an opening that leads the bytes past the first
/// check.
struct Format {
  const char* name;
  const char* opening;
  bool is_result;
};
constexpr Format formats[] = {
    {"csv", "", false},
    {"csv", "x,y\n1,2\n", false},
    {"tsv", "", false},
    {"txt", "", false},
    {"off", "OFF\n", false},
    {"off", "nOFF\n2\n", false},
    {"ply",
     "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float "
     "z\nend_header\n",
     false},
    {"npy", "\x93NUMPY\x01", false},
    {"qhull", "2 rbox\n", false},
    {"json", "{\"points\": [[0, 0], [1, 0], [0, 1]], \"cells\": ", true},
    {"json", "", true},
    {"json", "{\"ridge_points\": [], \"point_region\": [0], \"points\": [[0, 0]], \"regions\": ", true},
    {"json",
     "{\"facet_of_cell\": [0, 1], \"points\": [[0], [1]], \"affine_dimension\": 1, \"cells\": ", true},
    {"json",
     "{\"first_of_halfspace\": [0], \"dimension\": 1, \"rank\": 1, \"state\": \"full\", \"kinds\": ", true},
    {"npz", "PK\x03\x04", true},
    {"off", "nOFF\n2\n3 1 0\n0 0\n1 0\n0 1\n", true},
};

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const Format& format = formats[data[0] % std::size(formats)];
  static const std::string path = "/tmp/delone_fuzz_readers." + std::to_string(getpid());
  std::FILE* file = std::fopen(path.c_str(), "wb");
  if (file == nullptr) return 0;
  std::fputs(format.opening, file);
  std::fwrite(data + 1, 1, size - 1, file);
  std::fclose(file);

  try {
    if (format.is_result) {
      // Whatever was read, examining it must end with a report.
      const delone::AnyData read = delone::read(path, format.name);
      const delone::CheckReport report =
          std::visit([](const auto& held) { return delone::check(held); }, read);
      require(report.ok == report.violation.empty(), "a report without a reason");
    } else {
      const delone::PointTable table = delone::read_points(path, {.format = format.name, .columns = {}});
      require(table.coordinates.empty() || table.dimension >= 1, "coordinates without a dimension");
      require(table.coordinates.size() ==
                  table.num_points() * static_cast<std::size_t>(std::max(table.dimension, 0)),
              "an incomplete row");
      for (const double value : table.coordinates)
        require(std::isfinite(value), "a coordinate that is not finite");
    }
  } catch (const delone::Error& error) {
    require(std::string(error.what()).size() > 0, "an error without a message");
  }
  std::remove(path.c_str());
  return 0;
}
