// SPDX-License-Identifier: BSD-3-Clause
// Files of other programs, and files that are wrong: what read() says of them.
#include "complex_support.hpp"
#include "small_results.hpp"

#include <delone/printable.hpp>

#include <cmath>
#include <filesystem>
#include <numeric>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace {

using namespace delone;
using namespace delone_test;

using Read = ResultFiles;

/// One file of each kind in each format, and what it holds.
const std::vector<std::pair<std::string, std::size_t>> kinds{
    {"triangulation", 0}, {"hull", 1}, {"intersection", 2}, {"diagram", 3}};

void write_all(const std::string& folder, const std::string& format) {
  write(folder + "triangulation." + format, test::small_triangulation());
  write(folder + "hull." + format, test::small_hull());
  write(folder + "intersection." + format, test::small_intersection());
  write(folder + "diagram." + format, test::small_diagram());
}

TEST_F(Read, EveryKindIsRecognised) {
  for (const std::string format : {"npz", "json"}) {
    write_all(path(""), format);
    for (const auto& [name, kind] : kinds)
      EXPECT_EQ(delone::read(path(name + "." + format)).index(), kind) << name << format;
  }
  write(path("a.off"), square());
  EXPECT_TRUE(std::holds_alternative<ComplexData>(delone::read(path("a.off"))));
}

TEST_F(Read, AxesOfHulls) {
  HullData hull = test::small_hull();
  ASSERT_EQ(hull.affine_dimension, hull.dimension);
  for (const std::string format : {"npz", "json"}) {
    hull.axes.clear();  // as other programs write it: there are no other axes
    write(path("hull." + format), hull);
    std::vector<int> all(static_cast<std::size_t>(hull.dimension));
    std::iota(all.begin(), all.end(), 0);
    EXPECT_EQ(read_as<HullData>(path("hull." + format)).axes, all);
    HullData flat = hull;  // kept as they are
    flat.axes.assign(all.rbegin(), all.rend());
    write(path("hull." + format), flat);
    EXPECT_EQ(read_as<HullData>(path("hull." + format)).axes, flat.axes);
  }
}

TEST_F(Read, AnotherKindIsRefusedByName) {
  for (const std::string format : {"npz", "json"}) {
    write_all(path(""), format);
    const auto refused = [&](const std::string& file, const std::string& held, const std::string& wanted,
                             auto read) {
      expect_error(Errc::bad_format, {file, "the file holds " + held + ", not " + wanted},
                   [&] { read(path(file + "." + format)); });
    };
    const auto as_complex = [](const std::string& file) { read_as<ComplexData>(file); };
    const auto as_hull = [](const std::string& file) { read_as<HullData>(file); };
    const auto as_intersection = [](const std::string& file) { read_as<IntersectionData>(file); };
    const auto as_diagram = [](const std::string& file) { read_as<VoronoiData>(file); };
    refused("hull", "a convex hull", "a triangulation", as_complex);
    refused("triangulation", "a triangulation", "a convex hull", as_hull);
    refused("diagram", "a Voronoi or power diagram", "an intersection of halfspaces", as_intersection);
    refused("intersection", "an intersection of halfspaces", "a Voronoi or power diagram", as_diagram);
  }
  write(path("a.off"), square());
  expect_error(Errc::bad_format, {"a.off", "holds a triangulation, not a convex hull"},
               [&] { read_as<HullData>(path("a.off")); });
}

TEST_F(Read, EveryMemberIsNeeded) {
  const auto without = [&](const std::string& kind, const std::string& member) {
    const std::string text = content(kind + ".json");
    const std::size_t at = text.find("\"" + member + "\"");
    EXPECT_NE(at, std::string::npos) << member;
    std::string renamed = text;
    renamed.replace(at, member.size() + 2, "\"other\"");
    expect_error(Errc::bad_format, {"bad.json: there is no member '" + member + "'"},
                 [&] { delone::read(file("bad.json", renamed)); });
  };
  write_all(path(""), "json");
  for (const char* member : {"points", "cells"}) without("triangulation", member);
  for (const char* member :
       {"neighbors", "facet_offsets", "facet_vertices", "equations", "equation_errors", "ridge_facets",
        "ridge_offsets", "ridge_vertices", "vertices", "vertex_of_point", "point_kinds", "affine_dimension"})
    without("hull", member);
  for (const char* member :
       {"dimension", "rank", "state", "bounded", "interior_point_is_exact", "halfspaces", "kinds", "axes",
        "vertex_offsets", "edges", "rays", "lineality", "dual_points", "dual_equations"})
    without("intersection", member);
  for (const char* member :
       {"points", "vertices", "ridge_vertices", "regions", "ray_vertices", "ray_points", "affine_dimension"})
    without("diagram", member);
}

TEST_F(Read, ShapesMustAgree) {
  const auto changed = [&](const std::string& kind, const std::string& old, const std::string& with,
                           const std::vector<std::string>& parts, Errc code = Errc::bad_format) {
    std::string text = content(kind + ".json");
    const std::size_t at = text.find(old);
    ASSERT_NE(at, std::string::npos) << old;
    text.replace(at, old.size(), with);
    expect_error(code, parts, [&] { delone::read(file("bad.json", text)); });
  };
  write_all(path(""), "json");
  changed("hull", "\"facet_of_cell\": [0, 1, 2]", "\"facet_of_cell\": [0, 1]",
          {"facet_of_cell: expected shape (3,)", "found (2,)"});
  changed("hull", "\"point_kinds\": [0", "\"point_kinds\": [4",
          {"point_kinds: row 0: expected a number from 0 to 3, found 4"});
  changed("hull", "\"affine_dimension\": 2", "\"affine_dimension\": 3", {"affine dimension 3 is impossible"});
  changed("hull", "[4, 0]", "[4, null]", {"points: row 1: expected a number, found null"});
  changed("intersection", "\"state\": \"full\"", "\"state\": \"round\"",
          {"state: expected full, flat or empty"});
  changed("intersection", "\"state\": \"full\"", "\"state\": 0", {"state: expected full, flat or empty"});
  changed("intersection", "\"bounded\": true", "\"bounded\": 1",
          {"bounded: expected true or false, found '1'"});
  changed("intersection", "\"rank\": 1", "\"rank\": 2", {"rank 2 is impossible in dimension 1"});
  changed("intersection", "\"dimension\": 1", "\"dimension\": 0", {"the dimension is 0"},
          Errc::bad_dimension);
  changed("intersection", "\"kinds\": [0, 0, 2]", "\"kinds\": [0, 0, 5]",
          {"kinds: row 2: expected a number from 0 to 4, found 5"});
  changed("diagram", "\"regions\": [", "\"regions\": [3, ", {"regions: row 0: expected an array, found '3'"});
  changed("diagram", "\"ray_vertices\": [0, 1]", "\"ray_vertices\": [0]",
          {"ray_directions: expected shape (1, 1)", "found (2, 1)"});
  changed("diagram", "[6]\n]", "[6]\n],\n\"weights\": [1]", {"weights: expected shape (3,)", "found (1,)"});
}

TEST_F(Read, NpzOfOthers) {
  // scipy's names, 64-bit and big-endian integers, Fortran order, float32 points
  const auto data =
      read_as<ComplexData>(npz("a.npz", {{"points", npy_of<float>("<f4", "(3, 2)", {0, 1, 0, 0, 0, 1}, true)},
                                         {"simplices", npy_of<std::int64_t>(">i8", "(1, 3)", {0, 1, 2})},
                                         {"other", npy("|O", "(1,)", "pickle")}}));
  EXPECT_EQ(data.points, (std::vector<double>{0, 0, 1, 0, 0, 1}));
  EXPECT_EQ(data.cells, (Indices{0, 1, 2}));
  EXPECT_EQ(data.affine_dimension, 2);
  EXPECT_TRUE(data.neighbors.empty());
  EXPECT_TRUE(data.vertex_of_point.empty());
  // out-of-range rows are for `check` to name
  EXPECT_EQ(
      read_as<ComplexData>(npz("a.npz", {{"points", npy_of<double>("<f8", "(1, 2)", {0, 1})},
                                         {"cells", npy_of<std::uint8_t>("|u1", "(1, 3)", {0, 9, 200})}}))
          .cells,
      (Indices{0, 9, 200}));
}

TEST_F(Read, NpzFaults) {
  const std::string points = npy_of<double>("<f8", "(3, 2)", {0, 0, 1, 0, 0, 1}),
                    cells = npy_of<std::int32_t>("<i4", "(1, 3)", {0, 1, 2});
  const auto expect = [&](Errc code, const std::vector<std::string>& parts,
                          const std::vector<std::pair<std::string, std::string>>& members) {
    return expect_error(code, parts, [&] { read_as<ComplexData>(npz("a.npz", members)); });
  };
  expect(Errc::bad_format, {"a.npz", "'points'", "cells, foo"}, {{"cells", cells}, {"foo", cells}});
  expect(Errc::bad_format, {"a.npz", "'cells'"}, {{"points", points}});
  expect(Errc::bad_format, {"cells", "2-D", "(3,)"},
         {{"points", points}, {"cells", npy_of<std::int32_t>("<i4", "(3,)", {0, 1, 2})}});
  expect(Errc::bad_format, {"points", "2-D", "(2,)"},
         {{"points", npy_of<double>("<f8", "(2,)", {0, 0})}, {"cells", cells}});
  expect(Errc::bad_format, {"cells", "integers"},
         {{"points", points}, {"cells", npy_of<double>("<f8", "(1, 3)", {0, 1, 2})}});
  expect(Errc::bad_format, {"affine dimension 3", "dimension 2"},
         {{"points", points}, {"cells", npy_of<std::int32_t>("<i4", "(1, 4)", {0, 1, 2, 0})}});
  expect(
      Errc::bad_format, {"expected 2 columns for affine dimension 1, found 3"},
      {{"points", points}, {"cells", cells}, {"affine_dimension", npy_of<std::int64_t>("<i8", "()", {1})}});
  expect(Errc::bad_format, {"neighbors", "(1, 3)", "(3, 1)"},
         {{"points", points},
          {"cells", cells},
          {"neighbors", npy_of<std::int32_t>("<i4", "(3, 1)", {0, 1, 2})}});
  expect(Errc::bad_format, {"vertex_of_point", "expected shape (3,)", "found (2,)"},
         {{"points", points},
          {"cells", cells},
          {"vertex_of_point", npy_of<std::int32_t>("<i4", "(2,)", {0, 1})}});
  expect(Errc::bad_format, {"affine_dimension", "one number"},
         {{"points", points},
          {"cells", cells},
          {"affine_dimension", npy_of<std::int64_t>("<i8", "(2,)", {1, 1})}});
  expect(Errc::bad_format, {"cells", "4 rows without vertices"},
         {{"points", points}, {"cells", npy("<i4", "(4, 0)", "")}});
  expect(Errc::bad_format, {"cells: row 0", "18446744073709551615", "does not fit"},
         {{"points", points}, {"cells", npy_of<std::uint64_t>("<u8", "(1, 3)", {0, 1, ~std::uint64_t{0}})}});
  if (sizeof(SignedIndex) == 4) {
    expect(
        Errc::bad_format, {"cells: row 1", "2147483648", "32-bit"},
        {{"points", points}, {"cells", npy_of<std::int64_t>("<i8", "(2, 3)", {0, 1, 2, 0, 1, 2147483648})}});
  }
  expect(Errc::bad_dimension, {"points", "(3, 0)"}, {{"points", npy("<f8", "(3, 0)", "")}, {"cells", cells}});
  EXPECT_EQ(expect(Errc::not_finite, {"points: row 1: column 0"},
                   {{"points", npy_of<double>("<f8", "(3, 2)", {0, 0, NAN, 0, 0, 1})}, {"cells", cells}}),
            (std::vector<std::size_t>{1}));
}

TEST_F(Read, WeightFaults) {
  const std::string points = npy_of<double>("<f8", "(3, 2)", {0, 0, 1, 0, 0, 1}),
                    cells = npy_of<std::int32_t>("<i4", "(1, 3)", {0, 1, 2});
  const auto from_npz = [&](Errc code, const std::vector<std::string>& parts, const std::string& weights) {
    return expect_error(code, parts, [&] {
      read_as<ComplexData>(npz("a.npz", {{"points", points}, {"cells", cells}, {"weights", weights}}));
    });
  };
  from_npz(Errc::bad_format, {"a.npz: weights", "expected shape (3,)", "found (2,)"},
           npy_of<double>("<f8", "(2,)", {0, 1}));
  from_npz(Errc::bad_format, {"a.npz: weights", "expected shape (3,)", "found (0,)"}, npy("<f8", "(0,)", ""));
  from_npz(Errc::bad_format, {"a.npz: weights", "1-D", "(3, 1)"}, npy_of<double>("<f8", "(3, 1)", {0, 1, 2}));
  EXPECT_EQ(from_npz(Errc::not_finite, {"a.npz: weights: row 1", "nan"},
                     npy_of<double>("<f8", "(3,)", {0, NAN, 2})),
            (std::vector<std::size_t>{1}));
  EXPECT_EQ(from_npz(Errc::not_finite, {"a.npz: weights: row 0", "inf", "1 more row"},
                     npy_of<double>("<f8", "(3,)", {INFINITY, 0, NAN})),
            (std::vector<std::size_t>{0, 2}));

  const auto from_json = [&](Errc code, const std::vector<std::string>& parts, const std::string& weights) {
    return expect_error(code, parts, [&] {
      read_as<ComplexData>(file(
          "a.json", "{\"points\": [[0,0],[1,0],[0,1]], \"cells\": [[0,1,2]], \"weights\": " + weights + "}"));
    });
  };
  from_json(Errc::bad_format, {"a.json: weights", "expected shape (3,)", "found (4,)"}, "[1, 2, 3, 4]");
  from_json(Errc::bad_format, {"a.json: weights", "expected shape (3,)", "found (0,)"}, "[]");
  from_json(Errc::bad_format, {"a.json: weights: row 1", "expected a number", "null"}, "[0, null, 2]");
  from_json(Errc::bad_format, {"a.json: weights: row 2", "expected a number", "'x'"}, "[0, 1, \"x\"]");
  from_json(Errc::bad_format, {"a.json: weights", "an array"}, "[[0], [1], [2]]");
  from_json(Errc::bad_format, {"a.json: weights", "expected an array", "7"}, "7");
  from_json(Errc::bad_format, {"not valid JSON"}, "[0, NaN, 2]");
  EXPECT_EQ(from_json(Errc::not_finite, {"a.json: weights: row 2", "1e999"}, "[0, 1, 1e999]"),
            (std::vector<std::size_t>{2}));
}

TEST_F(Read, JsonFaults) {
  const auto expect = [&](Errc code, const std::vector<std::string>& parts, const std::string& text) {
    return expect_error(code, parts, [&] { read_as<ComplexData>(file("a.json", text)); });
  };
  const std::string points = "\"points\": [[0,0],[1,0],[0,1]]";
  expect(Errc::bad_format, {"empty"}, "");
  expect(Errc::bad_format, {"a.json", "not valid JSON", "line 1"}, "{\"points\": [[0,0]");
  expect(Errc::bad_format, {"not valid JSON"}, "{} {}");
  expect(Errc::bad_format, {"expected an object", "an array"}, "[1]");
  expect(Errc::bad_format, {"expected an object", "3"}, "3");
  expect(Errc::bad_format, {"'points'"}, "{\"cells\": []}");
  expect(Errc::bad_format, {"'cells'"}, "{" + points + "}");
  expect(Errc::bad_format, {"points: row 1", "expected 2", "found 1"}, "{\"points\": [[0,0],[1]]}");
  expect(Errc::bad_format, {"points: row 1", "found the string 'x'"}, "{\"points\": [[0,0],[1,\"x\"]]}");
  expect(Errc::bad_format, {"points: row 0", "found null"}, "{\"points\": [[null,0]]}");
  expect(Errc::bad_format, {"points", "an array of arrays"}, "{\"points\": 3}");
  expect(Errc::bad_format, {"points", "expected an array", "7"}, "{\"points\": [7]}");
  expect(Errc::bad_format, {"points", "expected a number", "an array"}, "{\"points\": [[[7]]]}");
  expect(Errc::bad_format, {"points", "an object"}, "{\"points\": [{}]}");
  expect(Errc::bad_format, {"cells: row 0", "integer", "'1.5'"}, "{" + points + ", \"cells\": [[0,1.5,2]]}");
  expect(Errc::bad_format, {"cells: row 1", "expected 3", "found 2"},
         "{" + points + ", \"cells\": [[0,1,2],[0,1]]}");
  expect(Errc::bad_format, {"cells", "does not fit"},
         "{" + points + ", \"cells\": [[0,1,18446744073709551615]]}");
  expect(Errc::bad_format, {"affine_dimension", "a boolean"},
         "{" + points + ", \"cells\": [[0,1,2]], \"affine_dimension\": true}");
  expect(Errc::bad_format, {"vertex_of_point", "expected shape (3,)", "found (1,)"},
         "{" + points + ", \"cells\": [[0,1,2]], \"vertex_of_point\": [0]}");
  expect(Errc::bad_format, {"neighbors", "(1, 3)", "(1, 2)"},
         "{" + points + ", \"cells\": [[0,1,2]], \"neighbors\": [[0,1]]}");
  expect(Errc::bad_format, {"'points'", "twice"}, "{" + points + "," + points + "}");
  expect(Errc::bad_format, {"points", "expected 3 columns", "found 2"},
         "{\"dimension\": 3," + points + ", \"cells\": []}");
  expect(Errc::bad_format, {"'dimension'"}, "{\"points\": [], \"cells\": []}");
  expect(Errc::bad_dimension, {"dimension is 0"}, "{\"points\": [[],[]], \"cells\": []}");
  EXPECT_EQ(expect(Errc::not_finite, {"points: row 1", "1e999"}, "{\"points\": [[0,0],[1e999,0]]}"),
            (std::vector<std::size_t>{1}));
}

TEST_F(Read, FaultsQuoteForeignTextSafely) {
  const auto message = [&](const std::string& name, const std::string& text) {
    try {
      read_as<ComplexData>(file(name, text));
    } catch (const Error& error) {
      return std::string(error.what());
    }
    ADD_FAILURE() << "no error";
    return std::string();
  };
  const std::string hostile = "\x1b]0;\xff" + std::string(1'000'000, 'y');
  const std::string points = "\"points\": [[0,0],[1,0],[0,1]]";
  std::string escaped = hostile;
  escaped.replace(0, 1, "\\u001b");
  escaped.replace(escaped.find('\xff'), 1, "\xc2\x9b");
  for (const std::string& text :
       {"{\"points\": " + hostile + "}", "{\"points\": \"" + escaped + "\"}",
        "{\"points\": [[\"" + escaped + "\"]]}", "{\"" + escaped + "\": [1e999]}",
        "{\"" + escaped + "\": 1, \"" + escaped + "\": 1}", "{\"" + escaped + "\": 1}",
        "{" + points + ", \"cells\": [[0,1,2]], \"affine_dimension\": \"" + escaped + "\"}",
        "\"" + escaped + "\"", "{\"x\": \"" + hostile + "\"}",
        "{\"x\": 1" + std::string(1'000'000, '1') + "}"}) {
    const std::string said = message("a.json", text);
    EXPECT_LT(said.size(), 1000u) << said.substr(0, 300);
    EXPECT_EQ(printable(said, said.size()), said);
  }
  EXPECT_NE(message("a.json", "{\"points\": [x]}").find("[x'"), std::string::npos)
      << message("a.json", "{\"points\": [x]}");
  EXPECT_NE(message("a.json", "{\"points\" 1}").find("expected ':'"), std::string::npos)
      << message("a.json", "{\"points\" 1}");
}

TEST_F(Read, AnyChangedBitOfAnNpzIsAnErrorOrHarmless) {
  const ComplexData expected = test::small_triangulation();
  write(path("a.npz"), expected);
  const std::string whole = content("a.npz");
  for (std::size_t bit = 0; bit / 8 < whole.size(); bit += 11) {
    std::filesystem::remove(path("b.npz"));  // some file systems write at once what replaces a file
    std::string bytes = whole;
    bytes[bit / 8] = static_cast<char>(bytes[bit / 8] ^ 1 << bit % 8);
    try {
      const ComplexData data = read_as<ComplexData>(file("b.npz", bytes));
      EXPECT_TRUE(data.points == expected.points && data.cells == expected.cells &&
                  data.neighbors == expected.neighbors && data.vertex_of_point == expected.vertex_of_point)
          << bit;
    } catch (const Error&) {
    }
  }
}

TEST_F(Read, ReadFaults) {
  expect_error(Errc::cannot_open, {"none.npz", "No such file"},
               [&] { read_as<ComplexData>(path("none.npz")); });
  expect_error(Errc::unsupported, {"a.vtu", "npz, json, off"},
               [&] { read_as<ComplexData>(file("a.vtu", "x")); });
}

}  // namespace
