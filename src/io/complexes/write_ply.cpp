// SPDX-License-Identifier: BSD-3-Clause
// Triangulations for programs that work on surfaces in space: PLY. Missing coordinates are 0; of tetrahedra
// the boundary is written.
#include "io/atomic_file.hpp"
#include "io/complexes/pictures.hpp"
#include "io/file.hpp"
#include "io/write_npy.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
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

}  // namespace

void write_ply(AtomicFile& file, const ComplexData& data) {
  if (data.dimension > 3)
    fail(Errc::unsupported, "{}: a .ply file holds at most 3 dimensions, these points have {}; use npz",
         file.name(), data.dimension);
  const Surface surface(file, data);
  if (data.num_points() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()))
    fail(Errc::too_many, "{}: a .ply file numbers at most 2^31 - 1 points", file.name());
  file.write("ply\nformat binary_little_endian 1.0\ncomment made by delone\n");
  if (data.kind != DataKind::unknown) file.print("comment kind {}\n", name_of(data.kind));
  file.print(
      "element vertex {}\nproperty double x\n"
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

}  // namespace delone::io
