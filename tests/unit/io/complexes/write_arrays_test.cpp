// SPDX-License-Identifier: BSD-3-Clause
// The exact bytes of npz and json.
#include "io/complexes/write_arrays.hpp"
#include "complex_support.hpp"
#include "small_results.hpp"

#include <cmath>
#include <limits>

namespace {

using namespace delone;
using namespace delone_test;

using WriteArrays = ResultFiles;

TEST_F(WriteArrays, NpzMembers) {
  write(path("a.npz"), square());
  const std::string bytes = content("a.npz");
  const io::ZipReader zip(bytes, "a.npz");
  std::vector<std::string> names;
  for (const auto& member : zip.members()) names.push_back(member.name);
  EXPECT_EQ(names, (std::vector<std::string>{"points.npy", "cells.npy", "neighbors.npy",
                                             "vertex_of_point.npy", "affine_dimension.npy"}));
  const auto has = [&](const std::string& member, const std::string& text) {
    const std::string header(zip.find(member + ".npy")->substr(0, 128));
    EXPECT_EQ((zip.find(member + ".npy")->find('\n') + 1) % 64, 0u) << member;
    EXPECT_NE(header.find(text), std::string::npos) << header;
  };
  const std::string index = sizeof(SignedIndex) == 4 ? "'<i4'" : "'<i8'";
  has("points", "{'descr': '<f8', 'fortran_order': False, 'shape': (5, 2), }");
  has("cells", "{'descr': " + index + ", 'fortran_order': False, 'shape': (2, 3), }");
  has("vertex_of_point", "'shape': (5,), }");
  has("affine_dimension", "{'descr': '<i8', 'fortran_order': False, 'shape': (), }");

  ComplexData none;
  none.dimension = 3;
  write(path("a.npz"), none);
  const std::string empty = content("a.npz");
  EXPECT_NE(io::ZipReader(empty, "").find("cells.npy")->find("'shape': (0, 0)"), std::string_view::npos);
  EXPECT_NE(io::ZipReader(empty, "").find("points.npy")->find("'shape': (0, 3)"), std::string_view::npos);
}

TEST_F(WriteArrays, Json) {
  ComplexData data = one_cell(1, 1);
  write(path("a.json"), data);
  EXPECT_EQ(content("a.json"),
            "{\n\"dimension\": 1,\n\"affine_dimension\": 1,\n\"points\": [\n[-0.0],\n[0.1]\n],\n\"cells\": "
            "[\n[0, 1]\n],\n"
            "\"neighbors\": [\n[-1, -1]\n],\n\"vertex_of_point\": [0, 1]\n}\n");
  const auto other =
      read_as<ComplexData>(file("b.json",
                                "\xef\xbb\xbf{\"meta\": {\"cells\": [1, {\"points\": null}], \"x\": "
                                "[[]]}, \"simplices\": [[0,1,2]], \"n\": null,"
                                "\"points\": [[0,0],[1,0.5],[2e0,18446744073709551615]], "
                                "\"neighbors\": [[-1,-1,-1]], \"last\": [{}]}"));
  EXPECT_EQ(other.points, (std::vector<double>{0, 0, 1, 0.5, 2, 18446744073709551616.0}));
  EXPECT_EQ(other.cells, (Indices{0, 1, 2}));
  EXPECT_EQ(other.neighbors, (Indices{-1, -1, -1}));
  EXPECT_EQ(other.affine_dimension, 2);
  EXPECT_EQ(read_as<ComplexData>(
                file("b.json", "{\"simplices\": [[0]], \"cells\": [[0,1]], \"points\": [[0],[1]]}"))
                .cells,
            (Indices{0, 1}));
}

TEST_F(WriteArrays, ListsOfListsInJson) {
  write(path("a.json"), test::small_diagram());
  const std::string text = content("a.json");
  EXPECT_NE(text.find("\"regions\": [\n[-1, 0],\n[0, 1],\n[-1, 1]\n],"), std::string::npos) << text;
  EXPECT_NE(text.find("\"ridge_vertices\": [\n[0],\n[1]\n],"), std::string::npos) << text;
  EXPECT_EQ(text.find("offsets"), std::string::npos);
  EXPECT_EQ(text.find("weights"), std::string::npos);
  write(path("hull.json"), test::small_hull());
  EXPECT_NE(
      content("hull.json").find("\"facet_offsets\": [0, 2, 4, 6],\n\"facet_vertices\": [0, 1, 1, 2, 0, 2],"),
      std::string::npos);
}

TEST_F(WriteArrays, EveryKindRoundTrips) {
  for (const std::string name : {"a.npz", "a.json"}) {
    HullData hull = test::small_hull();
    hull.equation_errors[1] = std::numeric_limits<double>::infinity();  // null in json
    write(path(name), hull);
    const auto hull_again = read_as<HullData>(path(name));
    EXPECT_EQ(hull_again.dimension, 2);
    EXPECT_EQ(hull_again.affine_dimension, 2);
    EXPECT_EQ(hull_again.facet_vertices, hull.facet_vertices);
    EXPECT_EQ(hull_again.equations, hull.equations);
    EXPECT_EQ(hull_again.equation_errors, hull.equation_errors);
    EXPECT_EQ(hull_again.point_kinds, hull.point_kinds);

    const IntersectionData intersection = test::small_intersection();
    write(path(name), intersection);
    const auto again = read_as<IntersectionData>(path(name));
    EXPECT_EQ(again.rank, 1);
    EXPECT_EQ(again.state, IntersectionState::full);
    EXPECT_TRUE(again.bounded);
    EXPECT_TRUE(again.interior_point_is_exact);
    EXPECT_EQ(again.axes, intersection.axes);
    EXPECT_EQ(again.kinds, intersection.kinds);
    EXPECT_EQ(again.facet_direction_offsets, intersection.facet_direction_offsets);
    EXPECT_EQ(again.dual_equations, intersection.dual_equations);

    VoronoiData diagram = test::small_diagram();
    diagram.weights = {0, -0.0, 0.1};
    write(path(name), diagram);
    const auto diagram_again = read_as<VoronoiData>(path(name));
    EXPECT_EQ(diagram_again.region_vertices, diagram.region_vertices);
    EXPECT_EQ(diagram_again.region_offsets, diagram.region_offsets);
    EXPECT_EQ(diagram_again.ray_directions, diagram.ray_directions);
    EXPECT_TRUE(same_bits(diagram_again.weights, diagram.weights));
  }
}

TEST_F(WriteArrays, DataWithoutPoints) {
  for (const std::string name : {"a.npz", "a.json"}) {
    HullData hull;
    hull.dimension = 3;
    write(path(name), hull);
    EXPECT_EQ(read_as<HullData>(path(name)).dimension, 3);
    EXPECT_EQ(read_as<HullData>(path(name)).affine_dimension, -1);
    VoronoiData diagram;
    diagram.dimension = 4;
    write(path(name), diagram);
    EXPECT_EQ(read_as<VoronoiData>(path(name)).dimension, 4);
    EXPECT_EQ(read_as<VoronoiData>(path(name)).region_offsets, std::vector<std::int64_t>{0});
  }
}

TEST_F(WriteArrays, NamesOfColumns) {
  HullData data = test::small_hull();
  data.column_names = {"a \"name\"", "\xc3\xa9\n"};
  for (const char* name : {"a.npz", "a.json"}) {
    write(path(name), data);
    EXPECT_EQ(read_as<HullData>(path(name)).column_names, data.column_names);
  }
  data.column_names.emplace_back("z");
  expect_error(Errc::invalid_argument, {"3 column_names for dimension 2"},
               [&] { write(path("b.npz"), data); });
  const std::string start = "{\"points\": [[0, 0]], \"cells\": [[0]], \"column_names\": ";
  for (const char* names : {"[\"x\"]", "\"xy\"", "[1, 2]", "[\"x\", 2]", "[[\"x\", \"y\"]]", "null", "{}"})
    expect_error(Errc::bad_format, {"b.json: column_names: expected"},
                 [&] { delone::read(file("b.json", start + names + "}")); });
  EXPECT_EQ(read_as<ComplexData>(file("b.json", start + "[\"x\", \"y\"]}")).column_names[1], "y");
}

TEST_F(WriteArrays, DataThatDisagreeAreNotWritten) {
  const auto refused = [&](auto data, const std::string& part, auto damage) {
    damage(data);
    expect_error(Errc::invalid_argument, {"a.json: cannot write", part},
                 [&] { write(path("a.json"), data); });
  };
  refused(test::small_hull(), "facet_of_cell: expected shape (3,)",
          [](HullData& data) { data.facet_of_cell.pop_back(); });
  refused(test::small_hull(), "ridge_offsets: no offsets into the 3 entries of ridge_vertices",
          [](HullData& data) { data.ridge_offsets[3] = 4; });
  refused(test::small_intersection(), "halfspaces", [](IntersectionData& data) { data.halfspaces.clear(); });
  refused(test::small_intersection(), "facet_offsets",
          [](IntersectionData& data) { data.facet_offsets[1] = -1; });
  refused(test::small_diagram(), "region_offsets", [](VoronoiData& data) { data.region_offsets[1] = 9; });
  refused(test::small_diagram(), "ray_points", [](VoronoiData& data) { data.ray_points.pop_back(); });
  refused(test::small_diagram(), "affine dimension is 2",
          [](VoronoiData& data) { data.affine_dimension = 2; });
  EXPECT_EQ(num_files(), 0u);
}

}  // namespace
