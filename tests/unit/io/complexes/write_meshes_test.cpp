// SPDX-License-Identifier: BSD-3-Clause
// PLY, STL, OBJ and Gmsh's format, byte by byte; other programs read them in tests/python/test_files.py.
#include "complex_support.hpp"

#include <algorithm>
#include <array>
#include <cstring>

namespace {

using namespace delone;
using namespace delone_test;

using WriteMeshes = ResultFiles;

constexpr std::array<const char*, 4> formats{"ply", "stl", "obj", "msh"};

/// Two tetrahedra, the second across the facet opposite vertex 0 of the first.
ComplexData two_tetrahedra() {
  ComplexData data;
  data.dimension = data.affine_dimension = 3;
  data.points = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1};
  data.cells = {0, 1, 2, 3, 4, 2, 1, 3};
  data.neighbors = {1, -1, -1, -1, 0, -1, -1, -1};
  return data;
}

/// Three coordinates of each row of a boundary, in binary STL: the normal and the three corners.
std::vector<std::array<float, 12>> triangles_of(const std::string& stl) {
  std::uint32_t count = 0;
  std::memcpy(&count, stl.data() + 80, 4);
  EXPECT_EQ(stl.size(), 84 + 50 * std::size_t{count});
  std::vector<std::array<float, 12>> triangles(count);
  for (std::size_t i = 0; i < count; ++i) std::memcpy(triangles[i].data(), stl.data() + 84 + 50 * i, 48);
  return triangles;
}

TEST_F(WriteMeshes, Texts) {
  write(path("a.obj"), square());
  EXPECT_EQ(content("a.obj"),
            "# made by delone\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 1 1.5 0\nv 0 0 0\nf 1 2 3\nf 2 4 3\n");
  write(path("a.msh"), square());
  EXPECT_EQ(content("a.msh"),
            "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 1 1.5 0\n5 0 0 "
            "0\n$EndNodes\n$Elements\n2\n1 2 2 1 1 1 2 3\n2 2 2 1 1 2 4 3\n$EndElements\n");
  write(path("b.msh"), two_tetrahedra());
  EXPECT_NE(content("b.msh").find("\n1 4 2 1 1 1 2 3 4\n2 4 2 1 1 5 3 2 4\n"), std::string::npos);
  write(path("b.obj"), two_tetrahedra());
  EXPECT_NE(content("b.obj").find("\nf 1 4 3\nf 1 2 4\nf 1 3 2\nf 5 4 2\nf 5 3 4\nf 5 2 3\n"),
            std::string::npos);
}

TEST_F(WriteMeshes, PlyIsReadBack) {
  if (std::endian::native != std::endian::little) GTEST_SKIP() << "reads the arrays as native";
  write(path("a.ply"), square());
  const PointTable table = read_points(path("a.ply"));
  EXPECT_EQ(table.dimension, 3);
  EXPECT_EQ(table.coordinates, (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1.5, 0, 0, 0, 0}));
  const std::string text = content("a.ply");
  EXPECT_NE(text.find("element face 2\nproperty list uchar int vertex_indices\nend_header\n"),
            std::string::npos);
  std::array<std::int32_t, 3> last{};
  std::memcpy(last.data(), text.data() + text.size() - 12, 12);
  EXPECT_EQ(last, (std::array<std::int32_t, 3>{1, 3, 2}));
  EXPECT_EQ(text[text.size() - 13], '\3');
  write(path("b.ply"), one_cell(1, 2));
  EXPECT_NE(content("b.ply").find("element edge 1\n"), std::string::npos);
  EXPECT_EQ(read_points(path("b.ply")).num_points(), 2u);
}

TEST_F(WriteMeshes, NormalsOfTheBoundaryPointOutward) {
  if (std::endian::native != std::endian::little) GTEST_SKIP() << "reads the arrays as native";
  write(path("a.stl"), two_tetrahedra());
  const auto triangles = triangles_of(content("a.stl"));
  ASSERT_EQ(triangles.size(), 6u);
  for (const auto& triangle : triangles) {
    float above = 0, length = 0;  // of a corner over (1/4, 1/4, 1/4), a point inside
    for (std::size_t j = 0; j < 3; ++j) {
      above += triangle[j] * (triangle[3 + j] - 0.25F);
      length += triangle[j] * triangle[j];
    }
    EXPECT_GT(above, 0);
    EXPECT_NEAR(length, 1, 1e-6);
  }
  ComplexData flat = square();
  flat.points = {0, 0, 1e38, 1e38, 2e38, 2e38, 1, 0, 0, 0};  // a triangle without area
  write(path("b.stl"), flat);
  EXPECT_EQ(triangles_of(content("b.stl"))[0][0], 0);
}

TEST_F(WriteMeshes, SmallCells) {
  for (const char* format : formats)
    for (int k = -1; k <= 3; ++k)
      for (int d = std::max(k, 1); d <= 4; ++d) {
        const std::string name = std::string("a.") + format;
        const std::string what = name + " " + std::to_string(k) + " " + std::to_string(d);
        std::filesystem::remove(path(name));
        if (d == 4) {
          expect_error(Errc::unsupported, {name, "at most 3"}, [&] { write(path(name), one_cell(k, d)); });
          EXPECT_FALSE(std::filesystem::exists(path(name))) << what;
        } else if (std::string(format) == "stl" && (k == 0 || k == 1)) {
          expect_error(Errc::unsupported, {name, k == 0 ? "cells are points" : "cells are segments"},
                       [&] { write(path(name), one_cell(k, d)); });
        } else {
          write(path(name), one_cell(k, d));
          EXPECT_TRUE(std::filesystem::exists(path(name))) << what;
        }
      }
}

TEST_F(WriteMeshes, Refusals) {
  ComplexData data = square();
  data.points[0] = 1e39;
  expect_error(Errc::unsupported, {"a.stl", "row 0", "1e+39"}, [&] { write(path("a.stl"), data); });
  data = two_tetrahedra();
  data.neighbors.clear();
  expect_error(Errc::invalid_argument, {"a.ply", "neighbors are missing"},
               [&] { write(path("a.ply"), data); });
  write(path("a.msh"), data);
  data.cells[0] = 5;
  for (const char* format : formats)
    expect_error(Errc::invalid_argument, {"cell 0 refers to point 5 of 5"},
                 [&] { write(path(std::string("a.") + format), data); });
  expect_error(Errc::unsupported, {"'ply' is binary"}, [&] { write("-", square(), "ply"); });
  expect_error(Errc::unsupported, {"'stl' is binary"}, [&] { write("-", square(), "stl"); });
}

}  // namespace
