// SPDX-License-Identifier: BSD-3-Clause
// write_complex: validates the data, chooses the writer; the formats that take a few lines.
#include "io/complexes/write_complex.hpp"

#include "io/atomic_file.hpp"
#include "io/collect.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/write_npy.hpp"
#include "io/zip.hpp"

#include <cmath>
#include <cstdint>
#include <span>

namespace delone {

namespace io {

namespace {

std::size_t num_corners(const ComplexData& data) {
  return static_cast<std::size_t>(data.affine_dimension + 1);
}

/// The sizes of the arrays agree and the coordinates are finite.
void validate(const ComplexData& data, const std::string& name) {
  const auto wrong = [&](std::string_view what) {
    fail(Errc::invalid_argument, "{}: cannot write: {}", name, what);
  };
  if (data.dimension < 1)
    fail(Errc::bad_dimension, "{}: cannot write: the dimension is {}", name, data.dimension);
  if (data.points.size() % static_cast<std::size_t>(data.dimension) != 0)
    wrong("the coordinates are no multiple of the dimension");
  if (data.affine_dimension < -1 || data.affine_dimension > data.dimension)
    wrong("the affine dimension is out of range");
  if (data.affine_dimension == -1 ? !data.cells.empty() : data.cells.size() % num_corners(data) != 0)
    wrong("the cells are no multiple of the affine dimension + 1");
  if (!data.neighbors.empty() && data.neighbors.size() != data.cells.size())
    wrong("cells and neighbors differ in size");
  if (!data.vertex_of_point.empty() && data.vertex_of_point.size() != data.num_points())
    wrong("vertex_of_point has another size than the points");
  if (!data.weights.empty() && data.weights.size() != data.num_points())
    wrong("the weights have another size than the points");
  require_finite(data.points, data.dimension, name);
  require_finite(data.weights, 1, name + ": weights");
}

/// For formats whose readers follow the rows without a check.
void require_rows_in_range(const ComplexData& data, const std::string& name) {
  const std::size_t n = data.num_points();
  for (std::size_t i = 0; i < data.cells.size(); ++i)
    if (data.cells[i] < 0 || static_cast<std::uint64_t>(data.cells[i]) >= n)
      fail(Errc::invalid_argument, "{}: cannot write: cell {} refers to point {} of {}", name,
           i / num_corners(data), data.cells[i], n);
}

void write_cells_npy(AtomicFile& file, const ComplexData& data) {
  std::string storage;
  file.write(npy_header(npy_index_type, {data.num_cells(), num_corners(data)}));
  file.write(little_endian_bytes(std::span<const SignedIndex>(data.cells), storage));
}

void write_qhull_cells(AtomicFile& file, const ComplexData& data) {
  file.print("{}\n", data.num_cells());
  const std::size_t corners = num_corners(data);
  for (std::size_t i = 0; i < data.cells.size(); ++i) {
    file.put(data.cells[i]);
    file.put((i + 1) % corners == 0 ? '\n' : ' ');
  }
}

}  // namespace

void write_npz(AtomicFile& file, const ComplexData& data) {
  ZipWriter zip(file);
  std::string storage;
  const auto add_indices = [&](const char* member, const std::vector<SignedIndex>& items,
                               std::string_view header) {
    zip.add(member, header, little_endian_bytes(std::span<const SignedIndex>(items), storage));
  };
  zip.add("points.npy", npy_header("f8", {data.num_points(), static_cast<std::size_t>(data.dimension)}),
          little_endian_bytes(std::span<const double>(data.points), storage));
  const std::string header = npy_header(npy_index_type, {data.num_cells(), num_corners(data)});
  add_indices("cells.npy", data.cells, header);
  if (data.neighbors.size() == data.cells.size()) add_indices("neighbors.npy", data.neighbors, header);
  if (data.vertex_of_point.size() == data.num_points())
    add_indices("vertex_of_point.npy", data.vertex_of_point, npy_header(npy_index_type, {data.num_points()}));
  if (!data.weights.empty())
    zip.add("weights.npy", npy_header("f8", {data.num_points()}),
            little_endian_bytes(std::span<const double>(data.weights), storage));
  const std::int64_t dimension = data.affine_dimension;
  zip.add("affine_dimension.npy", npy_header("i8", {}),
          little_endian_bytes(std::span(&dimension, 1), storage));
  zip.finish();
}

void write_json(AtomicFile& file, const ComplexData& data) {
  file.print("{{\n\"dimension\": {},\n\"affine_dimension\": {},\n", data.dimension, data.affine_dimension);
  const auto put_number = [&](auto x) {
    // "-0" would be read as an integer, and those have no negative zero.
    if (x == 0)
      file.write(std::signbit(static_cast<double>(x)) ? "-0.0" : "0");
    else
      file.put(x);
  };
  const auto matrix = [&](const char* member, const auto& items, std::size_t columns) {
    file.print("\"{}\": [", member);
    for (std::size_t i = 0; i < items.size(); ++i) {
      file.write(i == 0 ? "\n[" : i % columns == 0 ? "],\n[" : ", ");
      put_number(items[i]);
    }
    file.write(items.empty() ? "]" : "]\n]");
  };
  matrix("points", data.points, static_cast<std::size_t>(data.dimension));
  file.write(",\n");
  matrix("cells", data.cells, num_corners(data));
  if (data.neighbors.size() == data.cells.size()) {
    file.write(",\n");
    matrix("neighbors", data.neighbors, num_corners(data));
  }
  if (data.vertex_of_point.size() == data.num_points()) {
    file.write(",\n\"vertex_of_point\": [");
    for (std::size_t i = 0; i < data.vertex_of_point.size(); ++i) {
      if (i > 0) file.write(", ");
      file.put(data.vertex_of_point[i]);
    }
    file.write("]");
  }
  if (!data.weights.empty()) {
    file.write(",\n\"weights\": [");
    for (std::size_t i = 0; i < data.weights.size(); ++i) {
      if (i > 0) file.write(", ");
      put_number(data.weights[i]);
    }
    file.write("]");
  }
  file.write("\n}\n");
}

void write_off(AtomicFile& file, const ComplexData& data) {
  if (data.dimension == 3)
    file.write("OFF\n");
  else
    file.print("nOFF\n{}\n", data.dimension);
  file.print("{} {} 0\n", data.num_points(), data.num_cells());
  const auto dimension = static_cast<std::size_t>(data.dimension), corners = num_corners(data);
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    file.put(data.points[i]);
    file.put((i + 1) % dimension == 0 ? '\n' : ' ');
  }
  for (std::size_t i = 0; i < data.cells.size(); ++i) {
    if (i % corners == 0) file.put(corners);
    file.put(' ');
    file.put(data.cells[i]);
    if ((i + 1) % corners == 0) file.put('\n');
  }
}

}  // namespace io

void write_complex(const std::string& path, const ComplexData& data, const std::string& format) {
  const std::string chosen = io::choose_format(
      path, format, "txt", {"npz", "vtu", "off", "json", "svg", "txt", "npy"}, "writing a triangulation");
  io::guarded(path, [&] {
    io::validate(data, path);
    if (path == "-" && (chosen == "npz" || chosen == "npy" || chosen == "vtu"))
      io::fail(Errc::unsupported, "format '{}' is binary and is not written to standard output", chosen);
    if (chosen == "vtu" || chosen == "svg" || chosen == "off") io::require_rows_in_range(data, path);
    io::AtomicFile file(path);
    if (chosen == "npz") io::write_npz(file, data);
    if (chosen == "vtu") io::write_vtu(file, data);
    if (chosen == "off") io::write_off(file, data);
    if (chosen == "json") io::write_json(file, data);
    if (chosen == "svg") io::write_svg(file, data);
    if (chosen == "txt") io::write_qhull_cells(file, data);
    if (chosen == "npy") io::write_cells_npy(file, data);
    file.commit();
  });
}

}  // namespace delone
