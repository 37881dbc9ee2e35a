// SPDX-License-Identifier: BSD-3-Clause
// PLY, byte by byte; meshio reads it in tests/python/test_files.py.
#include "complex_support.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace {

using namespace delone;
using namespace delone_test;

using WritePly = ResultFiles;

/// Two tetrahedra, the second across the facet opposite vertex 0 of the first.
ComplexData two_tetrahedra() {
  ComplexData data;
  data.dimension = data.affine_dimension = 3;
  data.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  data.cells = {0, 1, 2, 3, 4, 2, 1, 3};
  data.neighbors = {1, -1, -1, -1, 0, -1, -1, -1};
  return data;
}

/// The corners of the triangles that end a file.
std::vector<std::array<std::int32_t, 3>> last_triangles(const std::string& ply, std::size_t count) {
  std::vector<std::array<std::int32_t, 3>> triangles(count);
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t place = ply.size() - 13 * (count - i);
    EXPECT_EQ(ply[place], '\3');
    std::memcpy(triangles[i].data(), ply.data() + place + 1, 12);
  }
  return triangles;
}

TEST_F(WritePly, IsReadBack) {
  if (std::endian::native != std::endian::little) GTEST_SKIP() << "reads the arrays as native";
  write(path("a.ply"), square());
  const PointTable table = read_points(path("a.ply"));
  EXPECT_EQ(table.dimension, 3);
  EXPECT_EQ(table.coordinates, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1.5, 0, 0, 0, 0}));
  const std::string text = content("a.ply");
  EXPECT_NE(text.find("element face 2\nproperty list uchar int vertex_indices\nend_header\n"),
            std::string::npos);
  using Triangles = std::vector<std::array<std::int32_t, 3>>;
  EXPECT_EQ(last_triangles(text, 2), (Triangles{{0, 1, 2}, {1, 3, 2}}));
  write(path("b.ply"), one_cell(1, 2));
  EXPECT_NE(content("b.ply").find("element edge 1\n"), std::string::npos);
  EXPECT_EQ(read_points(path("b.ply")).num_points(), 2u);
  write(path("c.ply"), two_tetrahedra());
  EXPECT_EQ(last_triangles(content("c.ply"), 6),
            (Triangles{{0, 3, 2}, {0, 1, 3}, {0, 2, 1}, {4, 3, 1}, {4, 2, 3}, {4, 1, 2}}));
}

TEST_F(WritePly, SmallCells) {
  for (int k = -1; k <= 3; ++k)
    for (int d = std::max(k, 1); d <= 4; ++d) {
      std::filesystem::remove(path("a.ply"));
      if (d == 4)
        expect_error(Errc::unsupported, {"a.ply", "at most 3"},
                     [&] { write(path("a.ply"), one_cell(k, d)); });
      else
        write(path("a.ply"), one_cell(k, d));
      EXPECT_EQ(std::filesystem::exists(path("a.ply")), d < 4) << k << ' ' << d;
    }
}

TEST_F(WritePly, Refusals) {
  ComplexData data = two_tetrahedra();
  data.neighbors.clear();
  expect_error(Errc::invalid_argument, {"a.ply", "neighbors are missing"},
               [&] { write(path("a.ply"), data); });
  data.cells[0] = 5;
  expect_error(Errc::invalid_argument, {"cell 0 refers to point 5 of 5"},
               [&] { write(path("a.ply"), data); });
  expect_error(Errc::unsupported, {"'ply' is binary"}, [&] { write("-", square(), "ply"); });
}

TEST_F(WritePly, OtherMeshesAreThoseOfMeshio) {
  for (const char* name : {"a.stl", "a.obj", "a.msh"}) {
    expect_error(Errc::unsupported, {name, "cannot be used for writing a triangulation", "to_meshio()"},
                 [&] { write(path(name), square()); });
    EXPECT_FALSE(std::filesystem::exists(path(name)));
  }
}

}  // namespace
