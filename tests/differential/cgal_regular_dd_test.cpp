// SPDX-License-Identifier: BSD-3-Clause
// Regular triangulations against CGAL's in d dimensions, which are exact too, by their documented interface.
// In general position both have the same cells. CGAL decides ties in another way, and may hide other points
// of a tie: then the cells of both must subdivide the same power cells, and those of CGAL must pass check()
// without `canonical`.
#include "compare.hpp"
#include "degenerate.hpp"

#include <delone/check.hpp>
#include <delone/predicates.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#if DELONE_HAVE_CGAL
#include <CGAL/Epick_d.h>
#include <CGAL/Regular_triangulation.h>
#endif

#include <cstdlib>
#include <map>

namespace delone {
namespace {

#if DELONE_HAVE_CGAL
using test::Cells;
using test::PointSet;

struct WeightedSet {
  PointSet set;
  std::vector<double> weights;
};

/// Weights 0 … largest; every fifth row or so is there once more, lighter, as heavy, or heavier.
WeightedSet with_weights(PointSet set, int largest, std::uint64_t seed) {
  test::Random random(seed);
  const auto d = static_cast<std::size_t>(set.dimension);
  WeightedSet s{std::move(set), {}};
  for (std::size_t row = 0; row < s.set.size(); ++row) s.weights.push_back(random.integer(0, largest));
  for (std::size_t row = 0, n = s.set.size(); row < n; ++row) {
    if (random.integer(0, 4) != 0) continue;
    for (std::size_t j = 0; j < d; ++j) s.set.points.push_back(s.set.points[row * d + j]);
    s.weights.push_back(s.weights[row] + random.integer(-1, 1));
  }
  return s;
}

std::string describe(const WeightedSet& s) {
  return s.set.name + "\n" + test::to_text(s.set.points, s.set.dimension) +
         "weights: " + testing::PrintToString(s.weights);
}

/// The coordinates of a row, and its weight.
std::vector<double> key(const WeightedSet& s, std::size_t row) {
  const auto d = static_cast<std::ptrdiff_t>(s.set.dimension), first = static_cast<std::ptrdiff_t>(row) * d;
  std::vector<double> result(s.set.points.begin() + first, s.set.points.begin() + first + d);
  result.push_back(s.weights[row]);
  return result;
}

/// The first row with each key.
std::map<std::vector<double>, SignedIndex> first_rows(const WeightedSet& s) {
  std::map<std::vector<double>, SignedIndex> rows;
  for (std::size_t row = 0; row < s.set.size(); ++row)
    rows.emplace(key(s, row), static_cast<SignedIndex>(row));
  return rows;
}

/// By the kernel whose dimension is a variable, which is compiled once.
Cells cgal_cells(const WeightedSet& s) {
  using Kernel = CGAL::Epick_d<CGAL::Dynamic_dimension_tag>;
  using Bare = Kernel::Point_d;
  using Weighted = Kernel::Weighted_point_d;
  const int dimension = s.set.dimension;
  const auto row_of = first_rows(s);
  std::vector<Weighted> points;
  for (std::size_t row = 0; row < s.set.size(); ++row) {
    const std::vector<double> p = key(s, row);
    points.emplace_back(Bare(p.begin(), p.end() - 1), p.back());
  }
  CGAL::Regular_triangulation<Kernel> oracle(dimension);
  oracle.insert(points.begin(), points.end());
  Cells cells;
  if (oracle.current_dimension() < dimension) return cells;
  for (auto cell = oracle.finite_full_cells_begin(); cell != oracle.finite_full_cells_end(); ++cell) {
    cells.emplace_back();
    for (int i = 0; i <= dimension; ++i) {
      const Weighted& p = cell->vertex(i)->point();
      const Bare bare = p.point();  // a copy: its iterators would not outlive it
      std::vector<double> corner(bare.cartesian_begin(), bare.cartesian_end());
      corner.push_back(p.weight());
      cells.back().push_back(row_of.at(corner));
    }
    std::sort(cells.back().begin(), cells.back().end());
  }
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// d! times the volume of a cell with small integer coordinates, by fraction-free elimination.
std::int64_t volume(const WeightedSet& s, const std::vector<SignedIndex>& cell) {
  const std::size_t d = cell.size() - 1;
  std::vector<std::vector<std::int64_t>> m;
  const std::vector<double> origin = key(s, static_cast<std::size_t>(cell[0]));
  for (std::size_t i = 1; i <= d; ++i) {
    const std::vector<double> p = key(s, static_cast<std::size_t>(cell[i]));
    m.emplace_back();
    for (std::size_t j = 0; j < d; ++j) m.back().push_back(static_cast<std::int64_t>(p[j] - origin[j]));
  }
  std::int64_t divisor = 1;
  for (std::size_t k = 0; k + 1 < d; ++k) {
    std::size_t pivot = k;
    while (pivot < d && m[pivot][k] == 0) ++pivot;
    if (pivot == d) return 0;
    std::swap(m[pivot], m[k]);
    for (std::size_t i = k + 1; i < d; ++i)
      for (std::size_t j = k + 1; j < d; ++j) m[i][j] = (m[i][j] * m[k][k] - m[i][k] * m[k][j]) / divisor;
    divisor = m[k][k];
  }
  return std::abs(m[d - 1][d - 1]);
}

/// The regular subdivision that the cells refine: the rows (one of each place and weight) on each power
/// sphere, and the volume of the cells that share it. No row may be in conflict.
std::map<std::vector<SignedIndex>, std::int64_t> power_cells(const WeightedSet& s, const Cells& cells) {
  std::map<std::vector<SignedIndex>, std::int64_t> result;
  const auto rows = first_rows(s);
  for (const std::vector<SignedIndex>& cell : cells) {
    std::vector<double> points, weights;
    for (const SignedIndex row : cell) {
      const std::vector<double> p = key(s, static_cast<std::size_t>(row));
      points.insert(points.end(), p.begin(), p.end() - 1);
      weights.push_back(p.back());
    }
    std::vector<SignedIndex> on_sphere;
    for (const auto& [p, row] : rows) {
      const Side side =
          in_power_sphere(points, weights, std::span(p).first(p.size() - 1), p.back(), s.set.dimension);
      EXPECT_NE(side, Side::inside) << row << " in " << test::to_text(cell) << describe(s);
      if (side == Side::on) on_sphere.push_back(row);
    }
    std::sort(on_sphere.begin(), on_sphere.end());
    result[on_sphere] += volume(s, cell);
  }
  return result;
}

/// check() of another program's cells; a row that is not a vertex is a duplicate of one, or hidden.
void expect_checked(const WeightedSet& s, const Cells& cells) {
  const auto rows = first_rows(s);
  std::vector<bool> is_vertex(s.set.size(), false);
  ComplexData data;
  data.dimension = data.affine_dimension = s.set.dimension;
  data.points = s.set.points;
  data.weights = s.weights;
  for (const std::vector<SignedIndex>& cell : cells)
    for (const SignedIndex row : cell) {
      data.cells.push_back(row);
      is_vertex[static_cast<std::size_t>(row)] = true;
    }
  for (std::size_t row = 0; row < s.set.size(); ++row) {
    const SignedIndex first = rows.at(key(s, row));
    data.vertex_of_point.push_back(is_vertex[static_cast<std::size_t>(first)] ? first : -1);
  }
  const CheckReport report = check(data, {.oriented = false});
  EXPECT_TRUE(report.ok) << report.violation << describe(s);
}

void expect_same_subdivision(const WeightedSet& s) {
  const Regular<> t(s.set.points, s.weights, s.set.dimension);
  ASSERT_EQ(t.affine_dimension(), s.set.dimension) << describe(s);
  const Cells theirs = cgal_cells(s);
  expect_checked(s, theirs);
  EXPECT_EQ(power_cells(s, test::sorted_cells(t.to_data())), power_cells(s, theirs)) << describe(s);
}
#endif

template <int D>
void expect_degenerate() {
#if DELONE_HAVE_CGAL
  const std::size_t n = D == 4 ? 30 : 60;
  for (std::uint64_t seed = 0; seed < 4; ++seed)
    for (const int largest : {0, 1, 3, 9}) {
      expect_same_subdivision(with_weights(test::permuted(test::lattice(D, D == 2   ? 6
                                                                           : D == 3 ? 3
                                                                                    : 2),
                                                          seed),
                                           largest, seed));
      expect_same_subdivision(with_weights(test::small_integers(D, n, 0, 3, seed), largest, seed + 10));
      expect_same_subdivision(
          with_weights(test::sampled(test::cospherical(D, D == 2 ? 25 : 9), n, seed), largest, seed + 20));
    }
#else
  GTEST_SKIP() << "this build found no CGAL";
#endif
}

template <int D>
void expect_general_position() {
#if DELONE_HAVE_CGAL
  const std::size_t n = D == 4 ? 120 : 400;
  for (const double largest : {1e-3, 0.05, 1.0}) {
    test::Random random(D);
    WeightedSet s{{"uniform", D, {}}, {}};
    for (std::size_t i = 0; i < n * D; ++i) s.set.points.push_back(random.real());
    for (std::size_t i = 0; i < n; ++i) s.weights.push_back((random.real() - 0.5) * largest);
    const Regular<> t(s.set.points, s.weights, D);
    EXPECT_TRUE(test::same_cells(cgal_cells(s), test::sorted_cells(t.to_data()))) << D << ' ' << largest;
  }
#else
  GTEST_SKIP() << "this build found no CGAL";
#endif
}

TEST(CgalRegularDd, TheSameCellsInGeneralPosition2D) { expect_general_position<2>(); }
TEST(CgalRegularDd, TheSameCellsInGeneralPosition3D) { expect_general_position<3>(); }
TEST(CgalRegularDd, TheSameCellsInGeneralPosition4D) { expect_general_position<4>(); }
TEST(CgalRegularDd, TheSameSubdivisionWithTies2D) { expect_degenerate<2>(); }
TEST(CgalRegularDd, TheSameSubdivisionWithTies3D) { expect_degenerate<3>(); }
TEST(CgalRegularDd, TheSameSubdivisionWithTies4D) { expect_degenerate<4>(); }

}  // namespace
}  // namespace delone
