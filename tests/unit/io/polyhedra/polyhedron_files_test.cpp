// SPDX-License-Identifier: BSD-3-Clause
// Files of cddlib and lrs: what is read, what is refused and where, and that what is written is read back.
#include <delone/polyhedron_io.hpp>

#include "../io_support.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace delone {
namespace {

class PolyhedronFiles : public delone_test::TemporaryDirectory {
 protected:
  PolyhedronRows rows_of(const std::string& text) const { return read_polyhedron(file("in", text)); }
  Polyhedron read(const std::string& text) const { return to_polyhedron(rows_of(text)); }
  /// What the error says after the path.
  std::string error_of(const std::string& text) const {
    const std::string path = file("in", text);
    try {
      read_polyhedron(path);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), Errc::bad_format);
      const std::string message = error.what();
      EXPECT_TRUE(message.starts_with(path + ":")) << message;
      return message.substr(path.size() + 1);
    }
    return "none";
  }
};

constexpr const char* square = "H-representation\nbegin\n4 3 rational\n0 1 0\n0 0 1\n1/2 -1 0\n1 0 -1\nend\n";

TEST_F(PolyhedronFiles, Inequalities) {
  const PolyhedronRows rows = rows_of(square);
  EXPECT_FALSE(rows.has_generators);
  EXPECT_EQ(rows.dimension, 2);
  EXPECT_EQ(rows.inequalities, (RationalRows{{-1, 0, 0}, {0, -1, 0}, {1, 0, Rational("1/2")}, {0, 1, 1}}));
  EXPECT_EQ(to_polyhedron(rows).vertices(),
            (RationalRows{{0, 0}, {0, 1}, {Rational("1/2"), 0}, {Rational("1/2"), 1}}));
}

TEST_F(PolyhedronFiles, WhatMeansTheSame) {
  const Polyhedron expected = read(square);
  EXPECT_EQ(read("name\n* a comment\nbegin\n4 3 real\n0 1 0\n0 0 1\n.5 -1 0\n1.0 0 -10e-1\nend\nvolume\n"),
            expected);
  EXPECT_EQ(
      read("H-representation\r\nnonnegative\r\nbegin\r\n***** 3 rational\r\n1/2 -1 0 1\r\n0 -1\r\nend\r\n"),
      expected);
  EXPECT_EQ(read("V-representation\nbegin\n4 3 rational\n1 0 0\n1 0 1\n1 1/2 0\n1 1/2 1\nend\n"), expected);
}

TEST_F(PolyhedronFiles, EquationsRaysAndLines) {
  const PolyhedronRows rows =
      rows_of("H-representation\nlinearity 2 3 1\nbegin\n3 3 integer\n1 -1 0\n0 0 1\n2 -1 -1\nend\n");
  EXPECT_EQ(rows.equations, (RationalRows{{1, 0, 1}, {1, 1, 2}}));
  EXPECT_EQ(rows.inequalities, (RationalRows{{0, -1, 0}}));
  const PolyhedronRows generators =
      rows_of("V-representation\nlinearity 1 2\nbegin\n3 3 integer\n0 1 0\n0 0 1\n1 2 3\nend\n");
  EXPECT_EQ(generators.vertices, (RationalRows{{2, 3}}));
  EXPECT_EQ(generators.rays, (RationalRows{{1, 0}}));
  EXPECT_EQ(generators.lines, (RationalRows{{0, 1}}));
  EXPECT_EQ(rows_of("begin\n0 4 integer\nend\nlinearity 0\n").dimension, 3);
}

TEST_F(PolyhedronFiles, ErrorsNameTheLine) {
  EXPECT_EQ(error_of("H-representation\n"), " there is no begin");
  EXPECT_EQ(error_of("begin\n1 2 whole\n"), "2: expected integer, rational or real, found 'whole'");
  EXPECT_EQ(error_of("begin\nx 2 integer\n"), "2: expected the number of rows, found 'x'");
  EXPECT_THAT(error_of("begin\n2 2 integer\n1 2\n3\nend\n"),
              testing::StartsWith("5: expected 2 rows of 2 numbers"));
  EXPECT_THAT(error_of("begin\n1 2 integer\n1 2\n3 4\nend\n"),
              testing::StartsWith("4: expected end after 1 rows"));
  EXPECT_THAT(error_of("begin\n1 2 integer\n1 2\n"), testing::EndsWith("there is no end after the rows"));
  EXPECT_EQ(error_of("begin\n1 2 rational\n1 2/0\nend\n"), "3: \"2/0\" has the denominator 0");
  EXPECT_EQ(error_of("begin\n1 2 integer\n1 nan\nend\n"), "3: \"nan\" is not a rational number");
  EXPECT_EQ(error_of("linearity 1 2\nbegin\n1 2 integer\n1 2\nend\n"), "1: there is no row 2");
  EXPECT_THAT(error_of("V-representation\nbegin\n1 2 integer\n2 2\nend\n"),
              testing::StartsWith("4: a row begins with 1"));
  EXPECT_THAT(error_of("V-representation\nlinearity 1 1\nbegin\n1 2 integer\n1 2\nend\n"),
              testing::StartsWith("2: row 1 is no line"));
  EXPECT_THAT(error_of("begin\n0 2 integer\nend\nbegin\n"), testing::StartsWith("4: a second begin"));
}

TEST_F(PolyhedronFiles, AreReadBack) {
  const std::string huge = "1234567890123456789012345678901234567890/77";
  for (const Polyhedron& polyhedron :
       {read(square), Polyhedron::empty(3), Polyhedron::space(2), Polyhedron(), Polyhedron::space(0),
        Polyhedron::from_generators({{1, Rational(huge)}}, {{1, 2}}, {}, 2),
        Polyhedron::from_inequalities({{1, 1, 0, Rational("1/3")}}, {{0, 0, 1, 5}}, 3)}) {
    write_polyhedron(path("out.ine"), polyhedron);
    EXPECT_EQ(to_polyhedron(read_polyhedron(path("out.ine"))), polyhedron);
    write_polyhedron(path("out.ext"), polyhedron);
    EXPECT_EQ(to_polyhedron(read_polyhedron(path("out.ext"))), polyhedron);
  }
  EXPECT_THROW(write_polyhedron(path("out.off"), read(square)), Error);
  write_polyhedron(path("out"), read(square), "ext");
  EXPECT_EQ(content("out"), "V-representation\nbegin\n4 3 rational\n1 0 0\n1 0 1\n1 1/2 0\n1 1/2 1\nend\n");
}

}  // namespace
}  // namespace delone
