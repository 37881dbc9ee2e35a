// SPDX-License-Identifier: BSD-3-Clause
// write_hull: the arrays of a hull for NumPy and as JSON; for all other formats the cells, as a complex of
// dimension k−1.
#include "io/atomic_file.hpp"
#include "io/collect.hpp"
#include "io/complexes/hull_arrays.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/write_npy.hpp"
#include "io/zip.hpp"

#include <delone/io.hpp>

#include <cmath>
#include <cstdint>
#include <span>

namespace delone {
namespace io {
namespace {

void validate(const HullData& data, const std::string& name) {
  const auto wrong = [&](std::string_view what) {
    fail(Errc::invalid_argument, "{}: cannot write: {}", name, what);
  };
  if (data.dimension < 1)
    fail(Errc::bad_dimension, "{}: cannot write: the dimension is {}", name, data.dimension);
  if (data.points.size() != data.num_points() * static_cast<std::size_t>(data.dimension))
    wrong("the coordinates are not as many as those of the points");
  if (data.affine_dimension < -1 || data.affine_dimension > data.dimension)
    wrong("the affine dimension is out of range");
  const auto k = static_cast<std::size_t>(std::max(data.affine_dimension, 1));
  if (data.cells.size() % k != 0) wrong("the cells are no multiple of the affine dimension");
  if (data.neighbors.size() != data.cells.size()) wrong("cells and neighbors differ in size");
  if (data.facet_of_cell.size() != data.num_cells()) wrong("facet_of_cell has another size than the cells");
  if (data.equations.size() != data.num_facets() * (static_cast<std::size_t>(data.dimension) + 1))
    wrong("the equations are not as many as the facets");
  if (data.point_kinds.size() != data.num_points()) wrong("point_kinds has another size than the points");
  require_finite(data.points, data.dimension, name);
}

void write_hull_npz(AtomicFile& file, const HullData& data, const std::vector<SignedIndex>& kinds) {
  ZipWriter zip(file);
  std::string storage;
  for_each_array(
      data, kinds,
      [&]<class T>(const char* name, const std::vector<T>& items, std::initializer_list<std::size_t> shape) {
        constexpr std::string_view type = std::is_same_v<T, double> ? std::string_view("f8") : npy_index_type;
        zip.add(std::string(name) + ".npy", npy_header(type, shape),
                little_endian_bytes(std::span<const T>(items), storage));
      });
  const std::int64_t dimension = data.affine_dimension;
  zip.add("affine_dimension.npy", npy_header("i8", {}),
          little_endian_bytes(std::span(&dimension, 1), storage));
  zip.finish();
}

/// Numbers that JSON has no form for, infinite bounds of flat hulls, become null.
void put_number(AtomicFile& file, double x) {
  if (!std::isfinite(x))
    file.write("null");
  else if (x == 0)
    file.write(std::signbit(x) ? "-0.0" : "0");  // "-0" would be read as an integer
  else
    file.put(x);
}
void put_number(AtomicFile& file, SignedIndex x) { file.put(x); }

void write_hull_json(AtomicFile& file, const HullData& data, const std::vector<SignedIndex>& kinds) {
  file.print("{{\n\"dimension\": {},\n\"affine_dimension\": {}", data.dimension, data.affine_dimension);
  for_each_array(
      data, kinds,
      [&]<class T>(const char* name, const std::vector<T>& items, std::initializer_list<std::size_t> shape) {
        file.print(",\n\"{}\": [", name);
        const bool is_matrix = shape.size() == 2;
        const std::size_t columns = is_matrix ? *(shape.begin() + 1) : 0;
        for (std::size_t i = 0; i < items.size(); ++i) {
          if (is_matrix)
            file.write(i == 0 ? "\n[" : i % columns == 0 ? "],\n[" : ", ");
          else if (i > 0)
            file.write(", ");
          put_number(file, items[i]);
        }
        file.write(is_matrix && !items.empty() ? "]\n]" : "]");
      });
  file.write("\n}\n");
}

}  // namespace
}  // namespace io

void write_hull(const std::string& path, const HullData& data, const std::string& format) {
  const std::string chosen = io::choose_format(
      path, format, "txt", {"npz", "vtu", "off", "json", "svg", "txt", "npy"}, "writing a hull");
  io::guarded(path, [&] {
    io::validate(data, path);
    if (chosen != "npz" && chosen != "json") {
      ComplexData boundary;
      boundary.dimension = data.dimension;
      boundary.affine_dimension = std::max(data.affine_dimension - 1, -1);
      boundary.points = data.points;
      boundary.cells = data.cells;
      return write_complex(path, boundary, chosen);
    }
    if (path == "-" && chosen == "npz")
      io::fail(Errc::unsupported, "format '{}' is binary and is not written to standard output", chosen);
    std::vector<SignedIndex> kinds;
    for (const PointKind kind : data.point_kinds) kinds.push_back(static_cast<SignedIndex>(kind));
    io::AtomicFile file(path);
    if (chosen == "npz") io::write_hull_npz(file, data, kinds);
    if (chosen == "json") io::write_hull_json(file, data, kinds);
    file.commit();
  });
}

}  // namespace delone
