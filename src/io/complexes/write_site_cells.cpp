// SPDX-License-Identifier: BSD-3-Clause
// Cells of sites as their arrays, or as a table.
#include <delone/io.hpp>
#include <delone/site_cells.hpp>

#include "io/atomic_file.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/write_npy.hpp"
#include "io/zip.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <vector>

namespace delone {
namespace io {
namespace {

class SiteCellsWriter {
 public:
  explicit SiteCellsWriter(AtomicFile& file) : zip_(file) {}
  template <class T>
  void operator()(const std::string& name, const std::vector<T>& items, std::size_t columns = 0) {
    const std::string_view type = std::is_same_v<T, double>         ? "f8"
                                  : std::is_same_v<T, std::int64_t> ? "i8"
                                                                    : "i4";
    std::vector<std::size_t> shape{items.size()};
    if (columns > 0) shape = {items.size() / columns, columns};
    zip_.add(name + ".npy", npy_header(type, shape),
             little_endian_bytes(std::span<const T>(items), storage_));
  }
  void finish() { zip_.finish(); }

 private:
  ZipWriter zip_;
  std::string storage_;
};

void write_arrays_of_cells(AtomicFile& file, const SiteCells& cells) {
  SiteCellsWriter write_array(file);
  write_array("volumes", cells.volumes);
  write_array("centroids", cells.centroids, static_cast<std::size_t>(cells.dimension));
  write_array("areas", cells.areas);
  write_array("num_faces", cells.num_faces);
  if (!cells.neighbor_offsets.empty()) {
    write_array("neighbor_offsets", cells.neighbor_offsets);
    write_array("neighbors", cells.neighbors);
    write_array("face_areas", cells.face_areas);
    write_array("distances", cells.distances);
    if (!cells.num_edges.empty()) write_array("num_edges", cells.num_edges);
    if (cells.rank > 0)
      write_array("neighbor_lattice", cells.neighbor_lattice, static_cast<std::size_t>(cells.rank));
  }
  if (!cells.vertex_offsets.empty()) {
    write_array("vertex_offsets", cells.vertex_offsets);
    write_array("vertices", cells.vertices, static_cast<std::size_t>(cells.dimension));
    write_array("face_vertex_offsets", cells.face_vertex_offsets);
    write_array("face_vertices", cells.face_vertices);
  }
  write_array.finish();
}

/// One row per row of the points.
PointTable table_of(const SiteCells& cells) {
  const auto d = static_cast<std::size_t>(cells.dimension);
  PointTable table;
  table.dimension = static_cast<int>(d) + 3;
  table.column_names = {"volume", "area", "num_faces"};
  for (std::size_t j = 0; j < d; ++j) table.column_names.push_back("centroid_" + std::to_string(j));
  for (std::size_t row = 0; row < cells.num_rows(); ++row) {
    table.coordinates.insert(table.coordinates.end(), {cells.volumes[row], cells.areas[row],
                                                       static_cast<double>(cells.num_faces[row])});
    for (std::size_t j = 0; j < d; ++j) table.coordinates.push_back(cells.centroids[row * d + j]);
  }
  return table;
}

}  // namespace
}  // namespace io

void write(const std::string& path, const SiteCells& cells, const std::string& format) {
  const std::string chosen =
      io::choose_format(path, format, "csv", {"npz", "csv"}, io::Use::writing, "cells of sites");
  if (chosen == "csv") return write_table(path, io::table_of(cells), "csv");
  const std::string name = io::output_name(path);
  io::guarded(name, [&] {
    if (path == "-")
      io::fail(Errc::unsupported, "format 'npz' is binary and is not written to standard output");
    io::AtomicFile file(path);
    io::write_arrays_of_cells(file, cells);
    file.commit();
  });
}

}  // namespace delone
