// SPDX-License-Identifier: BSD-3-Clause
// VTK's XML format for unstructured grids, as ParaView opens it. The arrays follow the XML as raw
// little-endian bytes, each after its size in bytes (a 64-bit integer).
#include "io/atomic_file.hpp"
#include "io/complexes/pictures.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/write_npy.hpp"

#include <delone/voronoi.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace delone::io {

namespace {

constexpr std::array<std::uint8_t, 4> vtk_cell_types{1, 3, 5,
                                                     10};  // VTK_VERTEX, VTK_LINE, VTK_TRIANGLE, VTK_TETRA

template <class T>
void put_bytes(AtomicFile& file, T value) {
  std::string storage;
  file.write(little_endian_bytes(std::span<const T>(&value, 1), storage));
}

/// The beginning of the file, with a comment that says what it holds.
void put_opening(AtomicFile& file, DataKind kind) {
  file.write("<?xml version=\"1.0\"?>\n");
  if (kind != DataKind::unknown) file.print("<!-- kind {} -->\n", name_of(kind));
  file.write(
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n"
      "  <UnstructuredGrid>\n");
}

template <class T>
void append(std::string& bytes, T value) {
  std::string storage;
  bytes += little_endian_bytes(std::span<const T>(&value, 1), storage);
}

}  // namespace

template <class Id>
void write_vtu(AtomicFile& file, const VtuSimplices<Id>& data) {
  if (data.dimension > 3)
    fail(Errc::unsupported, "{}: a .vtu file holds at most 3 dimensions, these points have {}; use npz",
         file.name(), data.dimension);
  const auto dimension = static_cast<std::size_t>(data.dimension),
             corners = static_cast<std::size_t>(data.affine_dimension + 1);
  const std::uint64_t n = dimension == 0 ? 0 : data.points.size() / dimension,
                      m = corners == 0 ? 0 : data.cells.size() / corners;
  const std::uint64_t point_bytes = n * 3 * sizeof(double), connectivity_bytes = data.cells.size_bytes(),
                      offset_bytes = m * sizeof(std::int64_t), type_bytes = m;
  std::uint64_t offset = 0;
  const auto array = [&](std::string_view type, std::string_view name, std::string_view attributes,
                         std::uint64_t bytes) {
    file.print("        <DataArray type=\"{}\" Name=\"{}\"{} format=\"appended\" offset=\"{}\"/>\n", type,
               name, attributes, offset);
    offset += sizeof(std::uint64_t) + bytes;
  };
  put_opening(file, data.kind);
  file.print("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n", n, m);
  if (!data.rows.empty()) {
    file.write("      <PointData>\n");
    array("Int64", "row", "", data.rows.size_bytes());
    file.write("      </PointData>\n");
  }
  if (data.first_cell) {
    file.write("      <CellData>\n");
    array("Int64", "cell", "", m * sizeof(std::int64_t));
    file.write("      </CellData>\n");
  }
  file.write("      <Points>\n");
  array("Float64", "Points", " NumberOfComponents=\"3\"", point_bytes);
  file.write("      </Points>\n      <Cells>\n");
  array(sizeof(Id) == 4 ? "Int32" : "Int64", "connectivity", "", connectivity_bytes);
  array("Int64", "offsets", "", offset_bytes);
  array("UInt8", "types", "", type_bytes);
  file.write("      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_");

  std::string storage;
  if (!data.rows.empty()) {
    put_bytes(file, static_cast<std::uint64_t>(data.rows.size_bytes()));
    file.write(little_endian_bytes(data.rows, storage));
  }
  if (data.first_cell) {
    put_bytes(file, m * sizeof(std::int64_t));
    for (std::uint64_t cell = 0; cell < m; ++cell)
      put_bytes(file, *data.first_cell + static_cast<std::int64_t>(cell));
  }
  put_bytes(file, point_bytes);
  for (std::size_t row = 0; row < n; ++row)
    for (std::size_t i = 0; i < 3; ++i)
      put_bytes(file, i < dimension ? data.points[row * dimension + i] : 0.0);
  put_bytes(file, connectivity_bytes);
  file.write(little_endian_bytes(data.cells, storage));
  put_bytes(file, offset_bytes);
  for (std::uint64_t cell = 1; cell <= m; ++cell) put_bytes(file, static_cast<std::int64_t>(cell * corners));
  put_bytes(file, type_bytes);
  if (m > 0) file.write(std::string(m, static_cast<char>(vtk_cell_types[corners - 1])));
  file.write("\n  </AppendedData>\n</VTKFile>\n");
}
template void write_vtu(AtomicFile&, const VtuSimplices<std::int32_t>&);
template void write_vtu(AtomicFile&, const VtuSimplices<std::int64_t>&);

void write_vtu(AtomicFile& file, const ComplexData& data) {
  write_vtu(file, VtuSimplices<SignedIndex>{.dimension = data.dimension,
                                            .affine_dimension = data.affine_dimension,
                                            .points = data.points,
                                            .cells = data.cells,
                                            .kind = data.kind});
}

void write_vtu(AtomicFile& file, const Diagram& diagram, const Box& box) {
  const auto d = static_cast<std::size_t>(diagram.dimension());
  if (d != 2 && d != 3)
    fail(Errc::unsupported,
         "{}: a .vtu file of regions needs 2 or 3 dimensions, these points have {}; use npz", file.name(), d);
  constexpr std::uint8_t vtk_polygon = 7, vtk_polyhedron = 42;
  struct Cell {
    std::size_t region;
    std::int64_t first_point, num_corners;
    std::size_t begin, end;  // of its entries below
  };
  std::vector<Cell> cells;
  std::vector<std::int64_t> entries;  // d = 2: the polygon; d = 3: number of faces, and each with its length
  std::string points;
  std::int64_t num_points = 0;
  diagram.for_each_clipped_region(box, [&](std::size_t r, const ClippedRegion& region) {
    if (region.empty()) return;
    const auto corners = static_cast<std::int64_t>(region.corners.size() / d);
    for (std::size_t i = 0; i < region.corners.size(); i += d)
      for (std::size_t j = 0; j < 3; ++j) append(points, j < d ? region.corners[i + j] : 0.0);
    const std::size_t begin = entries.size();
    if (d == 3) entries.push_back(static_cast<std::int64_t>(region.faces.size()));
    for (const auto& face : region.faces) {
      if (d == 3) entries.push_back(static_cast<std::int64_t>(face.size()));
      for (const Index corner : face) entries.push_back(num_points + static_cast<std::int64_t>(corner));
    }
    const std::int64_t used = d == 2 ? static_cast<std::int64_t>(entries.size() - begin) : corners;
    cells.push_back({r, num_points, used, begin, entries.size()});
    num_points += corners;
  });
  // By numbers of corners: meshio, which makes a block of each number, wants its data in this order.
  std::stable_sort(cells.begin(), cells.end(),
                   [](const Cell& a, const Cell& b) { return a.num_corners < b.num_corners; });
  std::string connectivity, offsets, types, faces, face_offsets, regions, rows;
  std::int64_t num_entries = 0, num_face_entries = 0;
  for (const Cell& cell : cells) {
    for (std::int64_t i = 0; i < cell.num_corners; ++i)
      append(connectivity, d == 2 ? entries[cell.begin + static_cast<std::size_t>(i)] : cell.first_point + i);
    num_entries += cell.num_corners;
    append(offsets, num_entries);
    append(types, d == 2 ? vtk_polygon : vtk_polyhedron);
    append(regions, static_cast<std::int64_t>(cell.region));
    append(rows, static_cast<std::int64_t>(diagram.region_points()[cell.region]));
    if (d == 2) continue;
    for (std::size_t i = cell.begin; i < cell.end; ++i) append(faces, entries[i]);
    num_face_entries += static_cast<std::int64_t>(cell.end - cell.begin);
    append(face_offsets, num_face_entries);
  }

  std::vector<const std::string*> appended;
  std::uint64_t offset = 0;
  const auto array = [&](std::string_view type, std::string_view name, std::string_view attributes,
                         const std::string& bytes) {
    file.print("        <DataArray type=\"{}\" Name=\"{}\"{} format=\"appended\" offset=\"{}\"/>\n", type,
               name, attributes, offset);
    offset += sizeof(std::uint64_t) + bytes.size();
    appended.push_back(&bytes);
  };
  put_opening(file, diagram.kind());
  file.print("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n      <CellData>\n", num_points,
             cells.size());
  array("Int64", "region", "", regions);
  array("Int64", "point", "", rows);
  file.write("      </CellData>\n      <Points>\n");
  array("Float64", "Points", " NumberOfComponents=\"3\"", points);
  file.write("      </Points>\n      <Cells>\n");
  array("Int64", "connectivity", "", connectivity);
  array("Int64", "offsets", "", offsets);
  array("UInt8", "types", "", types);
  if (d == 3) {
    array("Int64", "faces", "", faces);
    array("Int64", "faceoffsets", "", face_offsets);
  }
  file.write("      </Cells>\n    </Piece>\n  </UnstructuredGrid>\n  <AppendedData encoding=\"raw\">\n_");
  for (const std::string* bytes : appended) {
    std::string size;
    append(size, static_cast<std::uint64_t>(bytes->size()));
    file.write(size);
    file.write(*bytes);
  }
  file.write("\n  </AppendedData>\n</VTKFile>\n");
}

}  // namespace delone::io
