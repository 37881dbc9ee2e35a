// SPDX-License-Identifier: BSD-3-Clause
// Triangulations for programs that work on meshes in space: PLY (Stanford), STL, OBJ (Wavefront), and the
// format of Gmsh. Missing coordinates are 0. PLY, STL and OBJ hold surfaces: of tetrahedra they get the
// boundary.
#include "io/atomic_file.hpp"
#include "io/complexes/pictures.hpp"
#include "io/file.hpp"
#include "io/write_npy.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace delone::io {

namespace {

using Point = std::array<double, 3>;

Point point_of(const ComplexData& data, std::size_t row) {
  const auto dimension = static_cast<std::size_t>(data.dimension);
  Point x{};
  for (std::size_t j = 0; j < dimension; ++j) x[j] = data.points[row * dimension + j];
  return x;
}

void require_space(const AtomicFile& file, const ComplexData& data, std::string_view format) {
  if (data.dimension > 3)
    fail(Errc::unsupported, "{}: a .{} file holds at most 3 dimensions, these points have {}; use npz",
         file.name(), format, data.dimension);
}

/// Simplices of at most three vertices: the cells, or of tetrahedra the facets without a neighbor,
/// counterclockwise seen from outside when k = d.
class Surface {
 public:
  Surface(const AtomicFile& file, const ComplexData& data) : corners_(data.cells), width_(width_of(data)) {
    if (width_ < 4) return;
    width_ = 3;
    if (data.neighbors.size() != data.cells.size())
      fail(Errc::invalid_argument,
           "{}: cannot write: the boundary of tetrahedra is written, and neighbors are missing", file.name());
    // The vertex that is left out, put before these three, is an even permutation of the cell.
    constexpr std::array<std::array<std::size_t, 3>, 4> facets{
        {{{1, 2, 3}}, {{0, 3, 2}}, {{0, 1, 3}}, {{0, 2, 1}}}};
    for (std::size_t i = 0; i < data.cells.size(); ++i)
      if (data.neighbors[i] < 0)
        for (const std::size_t corner : facets[i % 4]) boundary_.push_back(data.cells[i - i % 4 + corner]);
    corners_ = boundary_;
  }
  Surface(const Surface&) = delete;
  Surface& operator=(const Surface&) = delete;

  std::size_t size() const { return width_ == 0 ? 0 : corners_.size() / width_; }
  /// The vertices of a simplex: 1 to 3, or 0 if there are no simplices.
  std::size_t width() const { return width_; }
  std::span<const SignedIndex> operator[](std::size_t i) const {
    return corners_.subspan(i * width_, width_);
  }

 private:
  static std::size_t width_of(const ComplexData& data) {
    return static_cast<std::size_t>(data.affine_dimension + 1);
  }

  std::vector<SignedIndex> boundary_;
  std::span<const SignedIndex> corners_;
  std::size_t width_;
};

/// a − b up to a positive factor, so that nothing overflows.
Point scaled_difference(const Point& a, const Point& b) {
  Point difference{};
  double largest = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    difference[j] = a[j] / 2 - b[j] / 2;
    largest = std::fmax(largest, std::fabs(difference[j]));
  }
  if (largest > 0)
    for (double& x : difference) x /= largest;
  return difference;
}

/// A unit normal of a triangle by the right hand's rule, rounded; zeros for one without area.
Point normal_of(const std::array<Point, 3>& corners) {
  const Point a = scaled_difference(corners[1], corners[0]), b = scaled_difference(corners[2], corners[0]);
  Point normal{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
  const double length = std::hypot(normal[0], normal[1], normal[2]);
  for (double& x : normal) x = length > 0 ? x / length : 0;
  return normal;
}

/// REQUIRES width 1 to 4.
const char* plural_of_simplex(std::size_t width) {
  constexpr std::array<const char*, 4> names{"points", "segments", "triangles", "tetrahedra"};
  return names[width - 1];
}

}  // namespace

void write_ply(AtomicFile& file, const ComplexData& data) {
  require_space(file, data, "ply");
  const Surface surface(file, data);
  if (data.num_points() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    fail(Errc::too_many, "{}: a .ply file numbers at most 2^31 - 1 points", file.name());
  file.print(
      "ply\nformat binary_little_endian 1.0\ncomment made by delone\nelement vertex {}\nproperty double x\n"
      "property double y\nproperty double z\n",
      data.num_points());
  if (surface.width() == 2)
    file.print("element edge {}\nproperty int vertex1\nproperty int vertex2\n", surface.size());
  if (surface.width() == 3)
    file.print("element face {}\nproperty list uchar int vertex_indices\n", surface.size());
  file.write("end_header\n");
  std::string storage;
  for (std::size_t row = 0; row < data.num_points(); ++row)
    file.write(little_endian_bytes(std::span<const double>(point_of(data, row)), storage));
  if (surface.width() < 2) return;
  for (std::size_t i = 0; i < surface.size(); ++i) {
    std::array<std::int32_t, 3> corners{};
    for (std::size_t j = 0; j < surface.width(); ++j) corners[j] = static_cast<std::int32_t>(surface[i][j]);
    if (surface.width() == 3) file.put('\3');
    file.write(little_endian_bytes(std::span<const std::int32_t>(corners).first(surface.width()), storage));
  }
}

void write_stl(AtomicFile& file, const ComplexData& data) {
  require_space(file, data, "stl");
  const Surface surface(file, data);
  if (surface.size() > 0 && surface.width() != 3)
    fail(Errc::unsupported, "{}: a .stl file holds triangles, these cells are {}; use ply or obj",
         file.name(), plural_of_simplex(surface.width()));
  if (surface.size() > std::numeric_limits<std::uint32_t>::max())
    fail(Errc::too_many, "{}: a .stl file holds at most 2^32 - 1 triangles", file.name());
  std::string header = "binary STL made by delone";  // must not begin with "solid", as texts do
  header.resize(80, ' ');
  file.write(header);
  std::string storage;
  const auto count = static_cast<std::uint32_t>(surface.size());
  file.write(little_endian_bytes(std::span<const std::uint32_t>(&count, 1), storage));
  for (std::size_t i = 0; i < surface.size(); ++i) {
    std::array<Point, 3> corners{};
    for (std::size_t j = 0; j < 3; ++j) corners[j] = point_of(data, static_cast<std::size_t>(surface[i][j]));
    const Point normal = normal_of(corners);
    std::array<float, 12> numbers{};
    for (std::size_t j = 0; j < 3; ++j) numbers[j] = static_cast<float>(normal[j]);
    for (std::size_t j = 0; j < 9; ++j) {
      const double x = corners[j / 3][j % 3];
      if (std::fabs(x) > static_cast<double>(std::numeric_limits<float>::max()))
        fail(Errc::unsupported,
             "{}: a .stl file holds numbers in single precision; row {} has the coordinate {}; use ply",
             file.name(), surface[i][j / 3], x);
      numbers[3 + j] = static_cast<float>(x);
    }
    file.write(little_endian_bytes(std::span<const float>(numbers), storage));
    file.write(std::string_view("\0\0", 2));  // no attributes
  }
}

void write_obj(AtomicFile& file, const ComplexData& data) {
  require_space(file, data, "obj");
  const Surface surface(file, data);
  file.write("# made by delone\n");
  for (std::size_t row = 0; row < data.num_points(); ++row) {
    file.put('v');
    for (const double x : point_of(data, row)) {
      file.put(' ');
      file.put(x);
    }
    file.put('\n');
  }
  for (std::size_t i = 0; i < surface.size(); ++i) {
    file.put("plf"[surface.width() - 1]);
    for (const SignedIndex row : surface[i]) {
      file.put(' ');
      file.put(static_cast<std::int64_t>(row) + 1);
    }
    file.put('\n');
  }
}

// Version 2.2, which more programs read than later ones. All cells are in physical group 1, as some of these
// programs want.
void write_msh(AtomicFile& file, const ComplexData& data) {
  require_space(file, data, "msh");
  constexpr std::array<int, 4> types{15, 1, 2, 4};  // point, line, triangle, tetrahedron
  file.print("$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n{}\n", data.num_points());
  for (std::size_t row = 0; row < data.num_points(); ++row) {
    file.put(row + 1);
    for (const double x : point_of(data, row)) {
      file.put(' ');
      file.put(x);
    }
    file.put('\n');
  }
  file.print("$EndNodes\n$Elements\n{}\n", data.num_cells());
  const auto corners = static_cast<std::size_t>(data.affine_dimension + 1);
  for (std::size_t cell = 0; cell < data.num_cells(); ++cell) {
    file.print("{} {} 2 1 1", cell + 1, types[corners - 1]);
    for (std::size_t j = 0; j < corners; ++j) {
      file.put(' ');
      file.put(static_cast<std::int64_t>(data.cells[cell * corners + j]) + 1);
    }
    file.put('\n');
  }
  file.write("$EndElements\n");
}

}  // namespace delone::io
