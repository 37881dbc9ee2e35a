// SPDX-License-Identifier: BSD-3-Clause
// Points and cells from OFF files.
#include "../io_support.hpp"

namespace {

using namespace delone;
using delone_test::expect_error;
using Doubles = std::vector<double>;

class ReadOff : public delone_test::TemporaryDirectory {
 protected:
  void expect_no_complex(const std::vector<std::string>& parts, const std::string& text) {
    expect_error(Errc::bad_format, parts, [&] { std::get<ComplexData>(delone::read(file("a.off", text))); });
  }
};

TEST_F(ReadOff, Vertices) {
  const Doubles expected{0, 0, 0, 1, 0, 0.5};
  for (const char* text :
       {"OFF\n2 0 0\n0 0 0\n1 0 0.5\n", "# made by\r\nOFF 2 1 0\r\n\r\n0 0 0 # a\r\n1 0 .5\r\n2 0 1",
        "OFF\n2 0\n0 0 0\n1 0 0.5", "COFF\n2 0 0\n0 0 0 255 0 0 1\n1 0 0.5 0 0 0 1\n",
        "nOFF\n3\n2 0 0\n0 0 0\n1 0 0.5\n"})
    EXPECT_EQ(read("a.off", text).coordinates, expected) << text;
  EXPECT_EQ(read("a.off", "nOFF 5\n1 0 0\n1 2 3 4 5\n").dimension, 5);
}

TEST_F(ReadOff, Faults) {
  expect_error(Errc::bad_format, {"a.off:1", "'OOF'"}, [&] { read("a.off", "OOF\n1 0 0\n0 0 0\n"); });
  expect_error(Errc::unsupported, {"'STOFF'"}, [&] { read("a.off", "STOFF\n1 0 0\n0 0 0\n"); });
  expect_error(Errc::unsupported, {"binary"}, [&] { read("a.off", "OFF BINARY\n"); });
  expect_error(Errc::bad_format, {"expected 3 vertices", "after 2"},
               [&] { read("a.off", "OFF\n3 0 0\n0 0 0\n1 1 1\n"); });
  expect_error(Errc::bad_format, {"a.off:4: vertex 1: expected 3 coordinates, found 2"},
               [&] { read("a.off", "OFF\n2 0 0\n0 0 0\n1 1\n"); });
  expect_error(Errc::bad_format, {"a.off:3: vertex 0: more than 3", "'255 0 0'"},
               [&] { read("a.off", "OFF\n1 0 0\n0 0 0 255 0 0\n"); });
  expect_error(Errc::bad_format, {"a.off:3", "'x'"}, [&] { read("a.off", "OFF\n1 0 0\n0 x 0\n"); });
  expect_error(Errc::bad_format, {"the number of vertices", "'-1'"}, [&] { read("a.off", "OFF\n-1 0 0\n"); });
  expect_error(Errc::bad_dimension, {"dimension is 0"}, [&] { read("a.off", "nOFF\n0\n1 0 0\n\n"); });
  expect_error(Errc::bad_format, {"18446744073709551615 vertices"},
               [&] { read("a.off", "OFF\n18446744073709551615 0 0\n0 0 0\n"); });
  EXPECT_EQ(expect_error(Errc::not_finite, {"a.off:4: column 2: 'inf'"},
                         [&] { read("a.off", "OFF\n2 0 0\n0 0 0\n1 1 inf\n"); }),
            (std::vector<std::size_t>{1}));
  expect_error(Errc::bad_format, {"empty"}, [&] { read("a.off", ""); });
}

TEST_F(ReadOff, CountsStandAlone) {
  expect_error(Errc::bad_format, {"a.off:2: unexpected '7' after the counts"},
               [&] { read("a.off", "OFF\n1 0 0 7\n0 0 0\n"); });
  expect_error(Errc::bad_format, {"a.off:2", "the number of edges", "'x'"},
               [&] { read("a.off", "OFF\n1 0 x\n0 0 0\n"); });
  expect_error(Errc::bad_format, {"a.off:1", "the dimension", "'d'"},
               [&] { read("a.off", "nOFF d\n1 0 0\n"); });
  EXPECT_EQ(read("a.off", "OFF\n0 0 0\n").num_points(), 0u);
}

TEST_F(ReadOff, ColoursAreThoseOfCoffAlone) {
  expect_error(Errc::bad_format, {"a.off:3: vertex 0: expected 3 coordinates, found 2"},
               [&] { read("a.off", "COFF\n1 0 0\n1 2\n"); });
  EXPECT_EQ(read("a.off", "COFF\n1 0 0\n1 2 3\n").coordinates, (Doubles{1, 2, 3}));
}

TEST_F(ReadOff, FacesAreOneSimplexEach) {
  const std::string start = "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n";
  expect_no_complex({"a.off:6: a face of 5 vertices is no simplex of dimension 3"}, start + "5 0 1 2 0 1\n");
  expect_no_complex({"a.off:6: a face without vertices"}, start + "0\n0\n");
  expect_no_complex({"a.off:9: more than the 2 faces promised: '3 2 1 0'"},
                    start + "3 0 1 2\n3 0 1 2\n\n3 2 1 0\n");
  expect_no_complex({"a.off:7", "the colour of a face", "'red'"}, start + "3 0 1 2\n3 0 1 2 0.5 red\n");
  const auto tetrahedron = std::get<ComplexData>(
      delone::read(file("a.off", "OFF\n4 1 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n4 0 1 2 3 .5 .5 1 # blue\n")));
  EXPECT_EQ(tetrahedron.affine_dimension, 3);
  EXPECT_EQ(tetrahedron.cells, (std::vector<SignedIndex>{0, 1, 2, 3}));
}

TEST_F(ReadOff, CommentsSayWhatItHolds) {
  const std::string cells = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", kind = "# delone: alpha_complex\n";
  for (const std::string& text : {"OFF\n" + kind + cells, "OFF\n" + cells + kind})
    EXPECT_EQ(std::get<ComplexData>(delone::read(file("a.off", text))).kind, DataKind::alpha_complex);
  expect_no_complex({"a.off: the file says that it holds a convex hull, which is not kept as OFF"},
                    "OFF\n# delone: convex_hull\n" + cells);
}

}  // namespace
