// SPDX-License-Identifier: BSD-3-Clause
// Clipped regions as geometry: a picture of the plane, and VTK's polygons and polyhedra for ParaView.
#include "io/atomic_file.hpp"
#include "io/complexes/write_voronoi.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/write_npy.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace delone::io {

namespace {

constexpr double side = 1000, margin = 20;  // the longer side of the box takes 1000 units, y points up
constexpr std::size_t most_circles = 20000;

/// Maps the box into the picture. Works on halved coordinates, whose differences cannot overflow.
class Frame {
 public:
  explicit Frame(const Box& box) : box_(box) {
    for (std::size_t axis = 0; axis < 2; ++axis) extent_[axis] = box.high[axis] / 2 - box.low[axis] / 2;
    largest_ = std::max(extent_[0], extent_[1]);
  }
  double width() const { return 2 * margin + side * extent_[0] / largest_; }
  double height() const { return 2 * margin + side * extent_[1] / largest_; }
  std::array<double, 2> place(double x, double y) const {
    return {margin + side * ((x / 2 - box_.low[0] / 2) / largest_),
            height() - margin - side * ((y / 2 - box_.low[1] / 2) / largest_)};
  }
  bool contains(double x, double y) const {
    return x >= box_.low[0] && x <= box_.high[0] && y >= box_.low[1] && y <= box_.high[1];
  }

 private:
  const Box& box_;
  std::array<double, 2> extent_{};
  double largest_ = 0;
};

template <class T>
void append(std::string& bytes, T value) {
  std::string storage;
  bytes += little_endian_bytes(std::span<const T>(&value, 1), storage);
}

}  // namespace

void write_voronoi_svg(AtomicFile& file, const Diagram& diagram, const Box& box) {
  if (diagram.dimension() != 2)
    fail(Errc::unsupported, "{}: an .svg file is a picture of the plane, these points have dimension {}",
         file.name(), diagram.dimension());
  const Frame frame(box);
  // Lines get thinner as edges get shorter, which is as 1/sqrt(n).
  const double stroke = std::clamp(20 / std::sqrt(static_cast<double>(diagram.num_regions()) + 1), 0.1, 1.5);
  bool is_open = false;
  const auto open = [&] {
    if (is_open) return;
    is_open = true;
    file.print(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.2f} {1:.2f}\" width=\"{0:.2f}\" "
        "height=\"{1:.2f}\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        "<path fill=\"#dce9f5\" stroke=\"#1f4e79\" stroke-width=\"{2:.2f}\" stroke-linejoin=\"round\" d=\"",
        frame.width(), frame.height(), stroke);
  };
  diagram.for_each_clipped_region(box, [&](std::size_t, const ClippedRegion& region) {
    open();
    if (region.empty()) return;
    bool is_first = true;
    for (const Index corner : region.faces.front()) {
      const auto [x, y] = frame.place(region.corners[2 * corner], region.corners[2 * corner + 1]);
      file.print("{}{:.2f},{:.2f}", is_first ? 'M' : 'L', x, y);
      is_first = false;
    }
    file.write("Z\n");
  });
  open();
  file.write("\"/>\n");
  if (diagram.num_regions() <= most_circles) {
    file.write("<g fill=\"#c0392b\">\n");
    for (std::size_t r = 0; r < diagram.num_regions(); ++r) {
      const auto site = diagram.site(r);
      if (!frame.contains(site[0], site[1])) continue;
      const auto [x, y] = frame.place(site[0], site[1]);
      file.print("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"/>\n", x, y, std::max(2 * stroke, 0.3));
    }
    file.write("</g>\n");
  }
  file.write("</svg>\n");
}

void write_voronoi_vtu(AtomicFile& file, const Diagram& diagram, const Box& box) {
  const auto d = static_cast<std::size_t>(diagram.dimension());
  if (d != 2 && d != 3)
    fail(Errc::unsupported,
         "{}: a .vtu file of regions needs 2 or 3 dimensions, these points have {}; use npz", file.name(), d);
  constexpr std::uint8_t vtk_polygon = 7, vtk_polyhedron = 42;
  std::string points, connectivity, offsets, types, faces, face_offsets, regions, rows;
  std::int64_t num_points = 0, num_cells = 0, num_entries = 0, num_face_entries = 0;
  diagram.for_each_clipped_region(box, [&](std::size_t r, const ClippedRegion& region) {
    if (region.empty()) return;
    const auto corners = static_cast<std::int64_t>(region.corners.size() / d);
    for (std::size_t i = 0; i < region.corners.size(); i += d)
      for (std::size_t j = 0; j < 3; ++j) append(points, j < d ? region.corners[i + j] : 0.0);
    if (d == 2) {
      for (const Index corner : region.faces.front())
        append(connectivity, num_points + static_cast<std::int64_t>(corner));
      num_entries += static_cast<std::int64_t>(region.faces.front().size());
    } else {
      for (std::int64_t corner = 0; corner < corners; ++corner) append(connectivity, num_points + corner);
      num_entries += corners;
      append(faces, static_cast<std::int64_t>(region.faces.size()));
      ++num_face_entries;
      for (const auto& face : region.faces) {
        append(faces, static_cast<std::int64_t>(face.size()));
        for (const Index corner : face) append(faces, num_points + static_cast<std::int64_t>(corner));
        num_face_entries += 1 + static_cast<std::int64_t>(face.size());
      }
      append(face_offsets, num_face_entries);
    }
    append(offsets, num_entries);
    append(types, d == 2 ? vtk_polygon : vtk_polyhedron);
    append(regions, static_cast<std::int64_t>(r));
    append(rows, static_cast<std::int64_t>(diagram.region_points()[r]));
    num_points += corners;
    ++num_cells;
  });

  std::vector<const std::string*> appended;
  std::uint64_t offset = 0;
  const auto array = [&](std::string_view type, std::string_view name, std::string_view attributes,
                         const std::string& bytes) {
    file.print("        <DataArray type=\"{}\" Name=\"{}\"{} format=\"appended\" offset=\"{}\"/>\n", type,
               name, attributes, offset);
    offset += sizeof(std::uint64_t) + bytes.size();
    appended.push_back(&bytes);
  };
  file.write(
      "<?xml version=\"1.0\"?>\n"
      "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
      "header_type=\"UInt64\">\n"
      "  <UnstructuredGrid>\n");
  file.print("    <Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">\n      <CellData>\n", num_points,
             num_cells);
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
