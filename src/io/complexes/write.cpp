// SPDX-License-Identifier: BSD-3-Clause
// write(): validates the data and chooses the writer.
#include "io/atomic_file.hpp"
#include "io/collect.hpp"
#include "io/complexes/pictures.hpp"
#include "io/complexes/write_arrays.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/write_npy.hpp"

#include <delone/html.hpp>
#include <delone/io.hpp>
#include <delone/voronoi.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>

namespace delone {
namespace io {
namespace {

std::size_t num_corners(const ComplexData& data) {
  return static_cast<std::size_t>(data.affine_dimension + 1);
}

void refuse_binary_output(const std::string& path, const std::string& format) {
  constexpr std::array<std::string_view, 4> binary{"npz", "npy", "vtu", "ply"};
  if (path == "-" && std::find(binary.begin(), binary.end(), format) != binary.end())
    fail(Errc::unsupported, "format '{}' is binary and is not written to standard output", format);
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

/// Files have a point for every row.
template <class Data>
void require_all_rows(const Data& data, const std::string& name) {
  for (std::size_t row = 0; row < data.num_points(); ++row)
    if (data.is_removed(row))
      throw Error(Errc::not_finite,
                  name + ": row " + std::to_string(row) +
                      " was removed, and files need a point for every row: compact_ids() closes the gaps",
                  {row});
}

/// A file of data as arrays, or as `put(file)` writes it in another format.
template <class Data, class Put>
void write_file(const std::string& path, const std::string& format, const Data& data, const Put& put) {
  refuse_binary_output(path, format);
  AtomicFile file(path);
  if (format == "npz")
    write_npz(file, data);
  else if (format == "json")
    write_json(file, data);
  else
    put(file);
  file.commit();
}
constexpr auto no_other_format = [](AtomicFile&) {};

const std::initializer_list<std::string_view> complex_formats{"npz", "vtu", "off", "ply", "json",
                                                              "svg", "txt", "npy", "html"};

}  // namespace
}  // namespace io

void write(const std::string& path, const ComplexData& data, const std::string& format) {
  const std::string chosen =
      io::choose_format(path, format, "txt", io::complex_formats, io::Use::writing_mesh, "a triangulation");
  const std::string name = io::output_name(path);
  io::guarded(name, [&] {
    io::validate(data, name);
    if (data.is_periodic() && chosen != "npz" && chosen != "json")
      io::fail(Errc::unsupported, "{}: {} is written as npz or json; {} has no offsets", name,
               description_of(data.kind), chosen);
    if (chosen == "html") return write_text(path, to_html(data));
    io::require_all_rows(data, name);
    io::require_finite(data.points, data.dimension, name);
    io::require_finite(data.weights, 1, name + ": weights");
    if (chosen != "npz" && chosen != "json" && chosen != "txt" && chosen != "npy")
      io::require_rows_in_range(data, name);
    io::write_file(path, chosen, data, [&](io::AtomicFile& file) {
      if (chosen == "vtu") io::write_vtu(file, data);
      if (chosen == "off") io::write_off(file, data);
      if (chosen == "ply") io::write_ply(file, data);
      if (chosen == "svg") io::write_svg(file, data);
      if (chosen == "txt") io::write_qhull_cells(file, data);
      if (chosen == "npy") io::write_cells_npy(file, data);
    });
  });
}

void write(const std::string& path, const HullData& data, const std::string& format) {
  const std::string chosen =
      io::choose_format(path, format, "txt", io::complex_formats, io::Use::writing_mesh, "a hull");
  const std::string name = io::output_name(path);
  io::guarded(name, [&] {
    io::validate(data, name);
    io::require_finite(data.points, data.dimension, name);
    if (chosen == "html") return write_text(path, to_html(data));
    if (chosen != "npz" && chosen != "json") {
      ComplexData boundary;
      boundary.dimension = data.dimension;
      boundary.affine_dimension = std::max(data.affine_dimension - 1, -1);
      boundary.points = data.points;
      boundary.cells = data.cells;
      if (data.tolerance == 0) boundary.kind = DataKind::hull_boundary;
      return write(path, boundary, chosen);
    }
    io::write_file(path, chosen, data, io::no_other_format);
  });
}

void write(const std::string& path, const IntersectionData& data, const std::string& format) {
  const std::string chosen = io::choose_format(path, format, "json", {"npz", "json", "off", "html"},
                                               io::Use::writing_mesh, "an intersection");
  const std::string name = io::output_name(path);
  io::guarded(name, [&] {
    io::validate(data, name);
    if (chosen == "html") return write_text(path, to_html(data));
    io::write_file(path, chosen, data, [&](io::AtomicFile& file) { io::write_off(file, data); });
  });
}

void write(const std::string& path, const VoronoiData& data, const std::string& format) {
  const std::string chosen = io::choose_format(path, format, "json", {"npz", "json"}, io::Use::writing,
                                               "the arrays of a Voronoi diagram");
  const std::string name = io::output_name(path);
  io::guarded(name, [&] {
    io::validate(data, name);
    io::require_all_rows(data, name);
    io::write_file(path, chosen, data, io::no_other_format);
  });
}

void write(const std::string& path, const Diagram& diagram, const std::optional<Box>& box,
           const std::string& format, const std::vector<std::string>& column_names) {
  const std::string chosen = io::choose_format(path, format, "json", {"npz", "json", "svg", "vtu", "html"},
                                               io::Use::writing_mesh, "a Voronoi diagram");
  const std::string name = io::output_name(path);
  io::guarded(name, [&] {
    if (!diagram.has_ridges()) io::fail(Errc::invalid_argument, "the diagram was made without ridges");
    if (chosen == "npz" || chosen == "json") {
      VoronoiData data = diagram.to_data();
      data.column_names = column_names;
      return write(path, data, chosen);
    }
    if (chosen == "html") return write_text(path, to_html(diagram, {.column_names = column_names}, box));
    io::refuse_binary_output(path, chosen);
    io::AtomicFile file(path);
    const Box shown = box ? *box : diagram.bounding_box();
    if (chosen == "svg") io::write_svg(file, diagram, shown);
    if (chosen == "vtu") io::write_vtu(file, diagram, shown);
    file.commit();
  });
}

}  // namespace delone
