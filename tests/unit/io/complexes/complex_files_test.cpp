// SPDX-License-Identifier: BSD-3-Clause
// Triangulations written and read back, the exact text or bytes of each format, and files whose members
// disagree.
#include "io/atomic_file.hpp"
#include "io/zip.hpp"
#include "../io_support.hpp"

#include <cmath>
#include <cstdlib>
#include <limits>

namespace {

using namespace delone;
using delone_test::expect_error;
using delone_test::npy;
using delone_test::npy_of;
using Indices = std::vector<SignedIndex>;

class ComplexFiles : public delone_test::TemporaryDirectory {
 protected:
  /// An archive as numpy.savez makes it.
  std::string npz(const std::string& name,
                  const std::vector<std::pair<std::string, std::string>>& members) const {
    io::AtomicFile out(path(name));
    io::ZipWriter zip(out);
    for (const auto& [member, bytes] : members) zip.add(member + ".npy", bytes, "");
    zip.finish();
    out.commit();
    return path(name);
  }
};

/// Two triangles of a square, and a duplicate of its first corner.
ComplexData square() {
  ComplexData data;
  data.dimension = 2;
  data.affine_dimension = 2;
  data.points = {0, 0, 1, 0, 0, 1, 1, 1.5, 0, 0};
  data.cells = {0, 1, 2, 1, 3, 2};
  data.neighbors = {1, -1, -1, -1, 0, -1};
  data.vertex_of_point = {0, 1, 2, 3, 0};
  return data;
}

/// One cell of dimension k, in R^d, with awkward coordinates.
ComplexData one_cell(int k, int d) {
  ComplexData data;
  data.dimension = d;
  data.affine_dimension = k;
  for (int i = 0; i <= k; ++i) {
    for (int j = 0; j < d; ++j) data.points.push_back(i == j + 1 ? 0.1 : -0.0);
    data.cells.push_back(i);
    data.neighbors.push_back(-1);
    data.vertex_of_point.push_back(i);
  }
  return data;
}

bool same_bits(const std::vector<double>& a, const std::vector<double>& b) {
  return a.size() == b.size() &&
         (a.empty() || std::memcmp(a.data(), b.data(), a.size() * sizeof(double)) == 0);
}

void expect_same(const ComplexData& a, const ComplexData& b, bool all_members, const std::string& what) {
  EXPECT_EQ(a.dimension, b.dimension) << what;
  EXPECT_EQ(a.affine_dimension, b.affine_dimension) << what;
  ASSERT_EQ(a.points.size(), b.points.size()) << what;
  EXPECT_TRUE(same_bits(a.points, b.points)) << what;
  EXPECT_EQ(a.cells, b.cells) << what;
  if (all_members) {
    EXPECT_EQ(a.neighbors, b.neighbors) << what;
    EXPECT_EQ(a.vertex_of_point, b.vertex_of_point) << what;
    EXPECT_TRUE(same_bits(a.weights, b.weights)) << what;
  }
}

TEST_F(ComplexFiles, RoundTrips) {
  std::vector<ComplexData> all{square()};
  for (int d = 1; d <= 6; ++d)
    for (int k = -1; k <= d; ++k) all.push_back(one_cell(k, d));
  for (const ComplexData& data : all)
    for (const char* name : {"a.npz", "a.json", "a.off"}) {
      write_complex(path(name), data);
      expect_same(read_complex(path(name)), data, std::string(name) != "a.off",
                  std::string(name) + " k=" + std::to_string(data.affine_dimension) +
                      " d=" + std::to_string(data.dimension));
    }
}

TEST_F(ComplexFiles, WeightsRoundTripToTheBit) {
  using Limits = std::numeric_limits<double>;
  for (const std::vector<double>& weights :
       {std::vector<double>{0.1, -0.0, Limits::max(), Limits::denorm_min(), -2},
        {1, 2, 3, 4, 5},
        {-Limits::max(), 1e300, 1e-310, 0, 1 / 3.}}) {
    ComplexData data = square();
    data.weights = weights;
    data.vertex_of_point[4] = -1;  // hidden
    for (const char* name : {"a.npz", "a.json"}) {
      write_complex(path(name), data);
      expect_same(read_complex(path(name)), data, true, name);
    }
  }
  write_complex(path("a.npz"), square());
  EXPECT_TRUE(read_complex(path("a.npz")).weights.empty()) << "no weights are not weights of 0";
}

TEST_F(ComplexFiles, WeightFaults) {
  const std::string points = npy_of<double>("<f8", "(3, 2)", {0, 0, 1, 0, 0, 1}),
                    cells = npy_of<std::int32_t>("<i4", "(1, 3)", {0, 1, 2});
  const auto from_npz = [&](Errc code, const std::vector<std::string>& parts, const std::string& weights) {
    return expect_error(code, parts, [&] {
      read_complex(npz("a.npz", {{"points", points}, {"cells", cells}, {"weights", weights}}));
    });
  };
  from_npz(Errc::bad_format, {"a.npz: weights", "expected 3 numbers, one per point, found 2"},
           npy_of<double>("<f8", "(2,)", {0, 1}));
  from_npz(Errc::bad_format, {"a.npz: weights", "expected 3 numbers", "found 0"}, npy("<f8", "(0,)", ""));
  from_npz(Errc::bad_format, {"a.npz: weights", "1-D", "(3, 1)"}, npy_of<double>("<f8", "(3, 1)", {0, 1, 2}));
  EXPECT_EQ(from_npz(Errc::not_finite, {"a.npz: weights: row 1", "nan"},
                     npy_of<double>("<f8", "(3,)", {0, NAN, 2})),
            (std::vector<std::size_t>{1}));
  EXPECT_EQ(from_npz(Errc::not_finite, {"a.npz: weights: row 0", "inf", "1 more row"},
                     npy_of<double>("<f8", "(3,)", {INFINITY, 0, NAN})),
            (std::vector<std::size_t>{0, 2}));

  const auto from_json = [&](Errc code, const std::vector<std::string>& parts, const std::string& weights) {
    return expect_error(code, parts, [&] {
      read_complex(file(
          "a.json", "{\"points\": [[0,0],[1,0],[0,1]], \"cells\": [[0,1,2]], \"weights\": " + weights + "}"));
    });
  };
  from_json(Errc::bad_format, {"a.json: weights", "expected 3 numbers, one per point, found 4"},
            "[1, 2, 3, 4]");
  from_json(Errc::bad_format, {"a.json: weights", "expected 3 numbers", "found 0"}, "[]");
  from_json(Errc::bad_format, {"a.json: weights: row 1", "expected a number", "null"}, "[0, null, 2]");
  from_json(Errc::bad_format, {"a.json: weights: row 2", "expected a number", "'x'"}, "[0, 1, \"x\"]");
  from_json(Errc::bad_format, {"a.json: weights", "an array"}, "[[0], [1], [2]]");
  from_json(Errc::bad_format, {"a.json: weights", "expected an array", "7"}, "7");
  from_json(Errc::bad_format, {"not valid JSON"}, "[0, NaN, 2]");
  EXPECT_EQ(from_json(Errc::not_finite, {"a.json: weights: row 2", "1e999"}, "[0, 1, 1e999]"),
            (std::vector<std::size_t>{2}));

  for (const char* name : {"b.npz", "b.json"}) {
    ComplexData data = square();
    data.weights = {0, 1, 2, NAN, 4};
    EXPECT_EQ(expect_error(Errc::not_finite, {"weights: row 3"}, [&] { write_complex(path(name), data); }),
              (std::vector<std::size_t>{3}));
    data.weights = {0, 1, 2, 3};
    expect_error(Errc::invalid_argument, {"weights"}, [&] { write_complex(path(name), data); });
    EXPECT_FALSE(std::filesystem::exists(path(name)));
  }
}

TEST_F(ComplexFiles, UnknownMembersStayUnknown) {
  ComplexData data = square();
  data.neighbors.clear();
  data.vertex_of_point.clear();
  for (const char* name : {"a.npz", "a.json"}) {
    write_complex(path(name), data);
    expect_same(read_complex(path(name)), data, true, name);
  }
}

TEST_F(ComplexFiles, NpzMembers) {
  write_complex(path("a.npz"), square());
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
  write_complex(path("a.npz"), none);
  const std::string empty = content("a.npz");
  EXPECT_NE(io::ZipReader(empty, "").find("cells.npy")->find("'shape': (0, 0)"), std::string_view::npos);
  EXPECT_NE(io::ZipReader(empty, "").find("points.npy")->find("'shape': (0, 3)"), std::string_view::npos);
}

TEST_F(ComplexFiles, NpzOfOthers) {
  // scipy's names, 64-bit and big-endian integers, Fortran order, float32 points
  const auto data =
      read_complex(npz("a.npz", {{"points", npy_of<float>("<f4", "(3, 2)", {0, 1, 0, 0, 0, 1}, true)},
                                 {"simplices", npy_of<std::int64_t>(">i8", "(1, 3)", {0, 1, 2})},
                                 {"other", npy("|O", "(1,)", "pickle")}}));
  EXPECT_EQ(data.points, (std::vector<double>{0, 0, 1, 0, 0, 1}));
  EXPECT_EQ(data.cells, (Indices{0, 1, 2}));
  EXPECT_EQ(data.affine_dimension, 2);
  EXPECT_TRUE(data.neighbors.empty());
  EXPECT_TRUE(data.vertex_of_point.empty());
  // out-of-range rows are for `check` to name
  EXPECT_EQ(read_complex(npz("a.npz", {{"points", npy_of<double>("<f8", "(1, 2)", {0, 1})},
                                       {"cells", npy_of<std::uint8_t>("|u1", "(1, 3)", {0, 9, 200})}}))
                .cells,
            (Indices{0, 9, 200}));
}

TEST_F(ComplexFiles, NpzFaults) {
  const std::string points = npy_of<double>("<f8", "(3, 2)", {0, 0, 1, 0, 0, 1}),
                    cells = npy_of<std::int32_t>("<i4", "(1, 3)", {0, 1, 2});
  const auto expect = [&](Errc code, const std::vector<std::string>& parts,
                          const std::vector<std::pair<std::string, std::string>>& members) {
    return expect_error(code, parts, [&] { read_complex(npz("a.npz", members)); });
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
  expect(Errc::bad_format, {"vertex_of_point", "expected 3 rows", "found 2"},
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

TEST_F(ComplexFiles, Json) {
  ComplexData data = one_cell(1, 1);
  write_complex(path("a.json"), data);
  EXPECT_EQ(content("a.json"),
            "{\n\"dimension\": 1,\n\"affine_dimension\": 1,\n\"points\": [\n[-0.0],\n[0.1]\n],\n\"cells\": "
            "[\n[0, 1]\n],\n"
            "\"neighbors\": [\n[-1, -1]\n],\n\"vertex_of_point\": [0, 1]\n}\n");
  const auto other = read_complex(file("b.json",
                                       "\xef\xbb\xbf{\"meta\": {\"cells\": [1, {\"points\": null}], \"x\": "
                                       "[[]]}, \"simplices\": [[0,1,2]], \"n\": null,"
                                       "\"points\": [[0,0],[1,0.5],[2e0,18446744073709551615]], "
                                       "\"neighbors\": [[-1,-1,-1]], \"last\": [{}]}"));
  EXPECT_EQ(other.points, (std::vector<double>{0, 0, 1, 0.5, 2, 18446744073709551616.0}));
  EXPECT_EQ(other.cells, (Indices{0, 1, 2}));
  EXPECT_EQ(other.neighbors, (Indices{-1, -1, -1}));
  EXPECT_EQ(other.affine_dimension, 2);
  EXPECT_EQ(
      read_complex(file("b.json", "{\"simplices\": [[0]], \"cells\": [[0,1]], \"points\": [[0],[1]]}")).cells,
      (Indices{0, 1}));
}

TEST_F(ComplexFiles, JsonFaults) {
  const auto expect = [&](Errc code, const std::vector<std::string>& parts, const std::string& text) {
    return expect_error(code, parts, [&] { read_complex(file("a.json", text)); });
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
  expect(Errc::bad_format, {"affine_dimension", "a boolean"}, "{" + points + ", \"affine_dimension\": true}");
  expect(Errc::bad_format, {"vertex_of_point", "expected 3", "found 1"},
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

TEST_F(ComplexFiles, Off) {
  write_complex(path("a.off"), square());
  EXPECT_EQ(content("a.off"), "nOFF\n2\n5 2 0\n0 0\n1 0\n0 1\n1 1.5\n0 0\n3 0 1 2\n3 1 3 2\n");
  EXPECT_EQ(
      read_complex(file("b.off", "OFF\n3 1 3\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n")).affine_dimension, 2);
  const std::string start = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n";
  const auto expect = [&](const std::vector<std::string>& parts, const std::string& text) {
    expect_error(Errc::bad_format, parts, [&] { read_complex(file("a.off", text)); });
  };
  expect({"a.off:7: face 1: expected 3 vertices as before, found 2"}, start + "3 0 1 2\n2 0 1\n");
  expect({"expected 2 faces", "after 1"}, start + "3 0 1 2\n");
  expect({"a.off:7: face 1: expected 3 vertices, found 2"}, start + "3 0 1 2\n3 0 1\n");
  expect({"more than the 2 faces"}, start + "3 0 1 2\n3 0 1 2\n3 0 1 2\n");
  expect({"a.off:6", "'-1'"}, start + "3 0 1 -1\n");
  expect({"a.off:6", "99999999999999999999"}, start + "3 0 1 99999999999999999999\n");
  expect({"a.off:6", "no simplex"}, start + "5 0 1 2 0 1\n5 0 1 2 0 1\n");
  expect({"without vertices"}, start + "0\n0\n");
  expect({"18446744073709551615 faces"}, "OFF\n1 18446744073709551615 0\n0 0 0\n1 0\n");
}

/// The attribute `name` of the `which`-th array of a .vtu file.
std::string attribute(const std::string& text, const std::string& array, const std::string& name) {
  const std::size_t at = text.find("Name=\"" + array + "\"");
  const std::size_t start = text.rfind('<', at), stop = text.find('>', at);
  const std::string tag = text.substr(start, stop - start);
  const std::size_t value = tag.find(" " + name + "=\"") + name.size() + 3;
  return tag.substr(value, tag.find('"', value) - value);
}

template <class T>
std::vector<T> appended(const std::string& text, const std::string& array) {
  const std::size_t at =
      text.find("\n_") + 2 + static_cast<std::size_t>(std::stoull(attribute(text, array, "offset")));
  std::uint64_t size = 0;
  std::memcpy(&size, text.data() + at, sizeof(size));
  std::vector<T> out(size / sizeof(T));
  if (size > 0) std::memcpy(out.data(), text.data() + at + sizeof(size), size);
  return out;
}

TEST_F(ComplexFiles, Vtu) {
  if (std::endian::native != std::endian::little) GTEST_SKIP() << "reads the arrays as native";
  write_complex(path("a.vtu"), square());
  const std::string text = content("a.vtu");
  EXPECT_NE(text.find("header_type=\"UInt64\""), std::string::npos);
  EXPECT_NE(text.find("NumberOfPoints=\"5\" NumberOfCells=\"2\""), std::string::npos);
  EXPECT_EQ(attribute(text, "connectivity", "type"), sizeof(SignedIndex) == 4 ? "Int32" : "Int64");
  EXPECT_EQ(appended<double>(text, "Points"),
            (std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 1, 1.5, 0, 0, 0, 0}));
  EXPECT_EQ(appended<SignedIndex>(text, "connectivity"), (Indices{0, 1, 2, 1, 3, 2}));
  EXPECT_EQ(appended<std::int64_t>(text, "offsets"), (std::vector<std::int64_t>{3, 6}));
  EXPECT_EQ(appended<std::uint8_t>(text, "types"), (std::vector<std::uint8_t>{5, 5}));
  const std::vector<int> types{1, 3, 5, 10};
  for (int k = -1; k <= 3; ++k) {
    write_complex(path("b.vtu"), one_cell(k, 3));
    const std::string other = content("b.vtu");
    EXPECT_TRUE(other.ends_with("</AppendedData>\n</VTKFile>\n"));
    if (k >= 0) {
      EXPECT_EQ(appended<std::uint8_t>(other, "types").at(0), types[static_cast<std::size_t>(k)]);
      EXPECT_EQ(appended<std::int64_t>(other, "offsets").at(0), k + 1);
    }
  }
  expect_error(Errc::unsupported, {"c.vtu", "at most 3"},
               [&] { write_complex(path("c.vtu"), one_cell(2, 4)); });
  EXPECT_FALSE(std::filesystem::exists(path("c.vtu")));
}

TEST_F(ComplexFiles, Svg) {
  write_complex(path("a.svg"), square());
  const std::string text = content("a.svg");
  // 1 × 1.5 → 666.67 × 1000 and the margin; the origin is at the lower left
  EXPECT_NE(text.find("viewBox=\"0 0 706.67 1040.00\""), std::string::npos) << text;
  EXPECT_NE(text.find("M20.00,1020.00L686.67,1020.00L20.00,353.33Z"), std::string::npos) << text;
  EXPECT_NE(text.find("<circle cx=\"686.67\" cy=\"20.00\""), std::string::npos) << text;
  for (int k = -1; k <= 2; ++k) {
    write_complex(path("b.svg"), one_cell(k, 2));
    const std::string other = content("b.svg");
    EXPECT_EQ(other.find("nan"), std::string::npos);
    EXPECT_EQ(other.find("inf"), std::string::npos);
    EXPECT_EQ(other.find("<path") != std::string::npos, k >= 1);
    EXPECT_EQ(other.find("<circle") != std::string::npos, k >= 0);
    EXPECT_TRUE(other.ends_with("</svg>\n"));
  }
  ComplexData huge = square();
  for (double& x : huge.points) x = x > 0 ? 1.7e308 : -1.7e308;
  write_complex(path("c.svg"), huge);
  EXPECT_NE(content("c.svg").find("M20.00,1020.00L1020.00,1020.00L20.00,20.00Z"), std::string::npos)
      << content("c.svg");
  expect_error(Errc::unsupported, {"d.svg", "dimension 3"},
               [&] { write_complex(path("d.svg"), one_cell(2, 3)); });
}

TEST_F(ComplexFiles, CellsOnly) {
  write_complex(path("a.txt"), square());
  EXPECT_EQ(content("a.txt"), "2\n0 1 2\n1 3 2\n");
  write_complex(path("a.npy"), square());
  EXPECT_EQ(read_points(path("a.npy")).coordinates, (std::vector<double>{0, 1, 2, 1, 3, 2}));
}

TEST_F(ComplexFiles, StandardOutput) {
  const auto printed = [&](const std::string& format) {
    testing::internal::CaptureStdout();
    write_complex("-", square(), format);
    return testing::internal::GetCapturedStdout();
  };
  EXPECT_EQ(printed(""), "2\n0 1 2\n1 3 2\n");
  EXPECT_EQ(printed("off").substr(0, 5), "nOFF\n");
  for (const char* format : {"npz", "npy", "vtu"})
    expect_error(Errc::unsupported, {"binary"}, [&] { write_complex("-", square(), format); });
}

TEST_F(ComplexFiles, WriteFaults) {
  const auto expect = [&](Errc code, const std::vector<std::string>& parts, const auto& change,
                          const std::string& name = "a.npz") {
    ComplexData data = square();
    change(data);
    expect_error(code, parts, [&] { write_complex(path(name), data); });
  };
  expect(
      Errc::unsupported, {"a.stl", "npz, vtu"}, [](ComplexData&) {}, "a.stl");
  expect(Errc::bad_dimension, {"dimension is 0"}, [](ComplexData& c) { c.dimension = 0; });
  expect(Errc::invalid_argument, {"coordinates"}, [](ComplexData& c) { c.points.pop_back(); });
  expect(Errc::invalid_argument, {"cells"}, [](ComplexData& c) { c.cells.pop_back(); });
  expect(Errc::invalid_argument, {"neighbors"}, [](ComplexData& c) { c.neighbors.pop_back(); });
  expect(Errc::invalid_argument, {"vertex_of_point"}, [](ComplexData& c) { c.vertex_of_point.pop_back(); });
  expect(Errc::invalid_argument, {"affine dimension"}, [](ComplexData& c) { c.affine_dimension = 3; });
  expect(Errc::not_finite, {"row 1"}, [](ComplexData& c) { c.points[2] = NAN; });
  for (const char* name : {"a.off", "a.svg", "a.vtu"}) {
    expect(
        Errc::invalid_argument, {"cell 1 refers to point 5 of 5"}, [](ComplexData& c) { c.cells[5] = 5; },
        name);
    expect(
        Errc::invalid_argument, {"cell 0 refers to point -1"}, [](ComplexData& c) { c.cells[0] = -1; }, name);
  }
  EXPECT_EQ(num_files(), 0u);
  if (std::filesystem::exists("/dev/full"))
    for (const char* format : {"npz", "json", "off", "txt", "npy", "vtu", "svg"})
      expect_error(Errc::cannot_write, {"/dev/full", "No space left"},
                   [&] { write_complex("/dev/full", square(), format); });
}

TEST_F(ComplexFiles, ReadFaults) {
  expect_error(Errc::cannot_open, {"none.npz", "No such file"}, [&] { read_complex(path("none.npz")); });
  expect_error(Errc::unsupported, {"a.vtu", "npz, json, off"}, [&] { read_complex(file("a.vtu", "x")); });
}

}  // namespace
