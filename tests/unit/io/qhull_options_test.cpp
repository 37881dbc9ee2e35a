// SPDX-License-Identifier: BSD-3-Clause
// What options of Qhull ask for; tests/python/test_spatial_options.py goes through docs/from-qhull.md.
#include <gtest/gtest.h>
#include <delone/error.hpp>
#include <delone/qhull_options.hpp>

#include <string>

namespace {

using namespace delone;

/// The reason against an option.
std::string refusal_of(const std::string& text, QhullProgram program) {
  try {
    parse_qhull_options(text, program);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::unsupported) << text;
    return error.what();
  }
  return "";
}

TEST(QhullOptions, WhatTheyAskFor) {
  const QhullOptions none = parse_qhull_options(" \t\n", QhullProgram::hull);
  EXPECT_TRUE(!none.scaled && !none.last_in_box && !none.in_cube && !none.at_infinity && !none.joggled);
  EXPECT_TRUE(!none.keep_coplanar && !none.furthest_site && !none.unmerged && none.good_visible);
  EXPECT_TRUE(!none.good_row && !none.roundoff && none.centrum == 0 && none.width == 0);

  const QhullOptions of_delaunay = parse_qhull_options("Qt Qbb\tQc Qz QJ1e-9", QhullProgram::delaunay);
  EXPECT_TRUE(of_delaunay.scaled && !of_delaunay.last_in_box && of_delaunay.keep_coplanar);
  EXPECT_TRUE(of_delaunay.at_infinity && of_delaunay.joggled && of_delaunay.unmerged);
  EXPECT_TRUE(parse_qhull_options("Qu Qz", QhullProgram::voronoi).furthest_site);
  EXPECT_FALSE(parse_qhull_options("Qu Qz", QhullProgram::voronoi).at_infinity);

  const QhullOptions of_hull =
      parse_qhull_options("Qbb QbB Qz Q0 QG-7 C1e-3 C-.25 E+2 W3.", QhullProgram::hull);
  EXPECT_TRUE(!of_hull.scaled && of_hull.last_in_box && of_hull.in_cube && !of_hull.at_infinity);
  EXPECT_TRUE(of_hull.unmerged && !of_hull.joggled && !of_hull.good_visible);
  EXPECT_EQ(of_hull.good_row, 7);
  EXPECT_EQ(of_hull.centrum, 0.25);
  EXPECT_EQ(of_hull.roundoff, 2);
  EXPECT_EQ(of_hull.width, 3);
}

TEST(QhullOptions, ThoseWithoutEffect) {
  for (const char* option : {"Qt", "Qx", "Q12", "Tv", "T4", "T-1", "Ts", "TF100", "TW.1", "A-0.99", "U1e-4",
                             "R-1", "f", "Fv", "G", "GD2", "Po", "PG", "Pp"})
    for (const QhullProgram program : {QhullProgram::delaunay, QhullProgram::hull, QhullProgram::halfspaces})
      EXPECT_EQ(refusal_of(option, program), "") << option;
}

TEST(QhullOptions, OthersAreRefusedByName) {
  for (const char* option :
       {"Qb0:0", "QBk:1",     "QR7",     "QV2", "Qg",   "Qi",   "TI",   "TOfile",
        "TV3",   "TC-2",      "Pd0:0.5", "PA5", "d",    "H0,0", "W-1",  "E-1",
        "C--1",  "Qnonsense", "x",       "A",   "Anan", "Cinf", "E1e",  "W.",
        "QJx",   "GDx",       "Fvv",     "T",   "Q",    "QG",   "QG1x", "QG99999999999999999999"})
    EXPECT_EQ(refusal_of(std::string("Qt ") + option, QhullProgram::hull)
                  .find("Qhull option '" + std::string(option) + "': "),
              0)
        << option;
  EXPECT_NE(refusal_of("Qu", QhullProgram::hull).find("furthest sites"), std::string::npos);
  EXPECT_NE(refusal_of("QG3", QhullProgram::delaunay).find("only hulls"), std::string::npos);
}

}  // namespace
