// SPDX-License-Identifier: BSD-3-Clause
// Bytes → points, mostly degenerate: the triangulation must pass every exact check, and must not depend on
// the order of insertion. The first byte chooses the dimension and how the other bytes become coordinates.
#include <delone/delone.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <span>
#include <string>
#include <vector>

namespace {

void require(bool condition, const char* what, const std::string& detail = {}) {
  if (condition) return;
  std::fprintf(stderr, "fuzz_triangulation: %s %s\n", what, detail.c_str());
  std::abort();
}

/// Style 0: small integers (every tie there is); 1: integers one ulp apart or scaled; 2: any finite double.
std::vector<double> coordinates_from(const std::uint8_t* data, std::size_t size, int style) {
  std::vector<double> coordinates;
  if (style == 2) {
    for (; size >= 8; data += 8, size -= 8) {
      double value = 0;
      std::memcpy(&value, data, 8);
      if (std::isfinite(value)) coordinates.push_back(value);
    }
    return coordinates;
  }
  for (std::size_t i = 0; i < size; ++i) {
    double value = data[i] % 4;
    if (style == 1 && data[i] >= 192) value = std::nextafter(value, 8.0);
    if (style == 1 && (data[i] & 48) == 48) value = std::ldexp(value, (data[i] & 8) != 0 ? 500 : -500);
    coordinates.push_back(value);
  }
  return coordinates;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  if (size < 1) return 0;
  const int dimension = 1 + data[0] % 5;
  const int style = (data[0] / 5) % 3;
  std::vector<double> coordinates = coordinates_from(data + 1, size - 1, style);
  const std::size_t d = static_cast<std::size_t>(dimension);
  const std::size_t num_points = std::min<std::size_t>(coordinates.size() / d, 24);
  coordinates.resize(num_points * d);

  const delone::Delaunay<> batch(coordinates, dimension);
  const delone::CheckReport report = delone::check(batch.to_data());
  require(report.ok, "check:", report.violation);

  delone::Options options;
  options.force_runtime_dimension = true;
  delone::Delaunay<> one_by_one(dimension, options);
  for (std::size_t row = num_points; row-- > 0;)
    one_by_one.insert(std::span<const double>(coordinates).subspan(row * d, d));
  require(one_by_one.hash() == batch.hash(), "the order of insertion changed the result");

  for (std::size_t row = 0; row < num_points; ++row) {
    const delone::Location where = batch.locate(std::span<const double>(coordinates).subspan(row * d, d));
    require(where.kind == delone::Location::Kind::on_vertex && where.face.front() == batch.vertex_at(row),
            "an input point is not located at its vertex");
  }
  return 0;
}
