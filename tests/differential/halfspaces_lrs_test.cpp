// SPDX-License-Identifier: BSD-3-Clause
// Intersections of halfspaces against lrs, which walks from vertex to vertex in rational numbers (Avis and
// Fukuda 1992, doi:10.1007/BF02293050): the same vertices and directions, exactly.
#include "halfspace_brute_force.hpp"
#include "halfspace_sets.hpp"

#include <delone/halfspaces.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <map>
#include <memory>
#include <sstream>
#include <string>

namespace delone {
namespace {

#ifdef DELONE_LRS
using Row = test::RationalRow;

/// Vertices (1, x) and directions (0, u), the latter divided by their largest entry in magnitude. Entries
/// times 2²⁰ are integers.
std::set<Row> lrs(const std::vector<double>& rows, int dimension) {
  const auto width = static_cast<std::size_t>(dimension) + 1;
  std::string name = testing::UnitTest::GetInstance()->current_test_info()->name();
  std::replace(name.begin(), name.end(), '/', '_');
  const std::string path = testing::TempDir() + "delone_lrs_" + name + ".ine";
  {
    std::ofstream file(path);
    file << "delone\nH-representation\nbegin\n" << rows.size() / width << " " << width << " integer\n";
    for (std::size_t i = 0; i < rows.size(); i += width) {
      file << static_cast<long long>(std::ldexp(-rows[i + width - 1], 20));
      for (std::size_t j = 0; j + 1 < width; ++j)
        file << " " << static_cast<long long>(std::ldexp(-rows[i + j], 20));
      file << "\n";
    }
    file << "end\n";
  }
  std::set<Row> found;
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> pipe(
      popen((DELONE_LRS " " + path + " 2>/dev/null").c_str(), "r"), pclose);
  std::string text;
  char part[4096];
  for (std::size_t size; (size = std::fread(part, 1, sizeof part, pipe.get())) > 0;) text.append(part, size);
  std::remove(path.c_str());
  std::istringstream lines(text);
  bool is_within = false;
  for (std::string line; std::getline(lines, line);) {
    if (line == "end" || line.rfind("*lrs", 0) == 0)
      is_within = false;                         // it starts anew where integers grow too long
    if (is_within && line.rfind("*", 0) != 0) {  // not "***** 4 rational"
      std::istringstream fields(line);
      Row row;
      for (std::string field; fields >> field;) row.emplace_back(field);
      test::Rational largest = row[0] != 0 ? test::Rational(1) : test::Rational(0);
      if (row[0] == 0)
        for (const test::Rational& x : row) largest = std::max(largest, test::Rational(abs(x)));
      for (test::Rational& x : row) x /= largest;
      found.insert(row);
    }
    if (line == "begin") is_within = true;
  }
  return found;
}

void expect_same(const std::vector<double>& rows, int d) {
  const HalfspaceIntersection found(rows, d);
  const IntersectionData& data = found.data();
  if (data.rank < d) return;
  std::size_t vertices = 0, directions = 0;
  std::set<std::vector<double>> rounded, expected;
  for (std::size_t v = 0; v < data.num_vertices(); ++v)
    rounded.emplace(data.vertex(v).begin(), data.vertex(v).end());
  for (const Row& row : lrs(rows, d)) {
    ++(row[0] == 0 ? directions : vertices);
    if (row[0] == 0) continue;
    std::vector<double> x;
    for (std::size_t j = 1; j < row.size(); ++j) {
      x.push_back(static_cast<double>(row[j]));
      for (const double to :
           {-INFINITY, INFINITY})  // the conversion may be off by one unit in the last place
        if (const double next = std::nextafter(x.back(), to);
            !test::is_nearest(x.back(), row[j]) && test::is_nearest(next, row[j]))
          x.back() = next;
    }
    expected.insert(x);
  }
  EXPECT_EQ(rounded, expected);
  EXPECT_EQ(data.num_vertices(), vertices);
  EXPECT_EQ(data.num_directions(), directions);
}
#endif

class HalfspacesLrsIn : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, HalfspacesLrsIn, ::testing::Range(2, 7),
                         ::testing::PrintToStringParamName());

TEST_P(HalfspacesLrsIn, GeneralPosition) {
#ifdef DELONE_LRS
  const int d = GetParam(), sizes[] = {100, 80, 40, 25, 20};
  expect_same(test::halfspaces_around_a_ball(d, sizes[d - 2], 61), d);
#else
  GTEST_SKIP() << "this build found no lrs";
#endif
}

TEST_P(HalfspacesLrsIn, SmallIntegers) {
#ifdef DELONE_LRS
  const int d = GetParam();
  for (std::uint64_t repeat = 0; repeat < 4; ++repeat)
    expect_same(test::halfspaces_of_small_integers(d, repeat % 2 == 0 ? 2 * d + 4 : d + 1, 62 + repeat), d);
#else
  GTEST_SKIP() << "this build found no lrs";
#endif
}

}  // namespace
}  // namespace delone
