// SPDX-License-Identifier: BSD-3-Clause
// locate, conflict_zone and in_sphere against brute force in integers: queries at vertices, at midpoints and
// centers of faces that doubles hold exactly, inside, outside the hull, beside the flat, and cospherical with
// cells.
#include "brute_force.hpp"

#include "compare.hpp"
#include "degenerate.hpp"
#include "scale.hpp"

#include <delone/delaunay.hpp>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>

namespace delone {
namespace {

using test::BruteForce;
using test::PointSet;

// One triangulation with many queries, each examined by itself.
class Examination {
 public:
  Examination(const PointSet& set, const std::vector<double>& queries, bool force_runtime_dimension)
      : set_(set),
        queries_(queries),
        oracle_(set.points, set.dimension, queries),
        triangulation_(set.points, set.dimension, options(force_runtime_dimension)),
        complex_(triangulation_.complex()) {
    for (const CellId c : complex_.finite_cells()) finite_.emplace_back(c, rows(c));
  }

  std::size_t num_queries() const { return queries_.size() / static_cast<std::size_t>(set_.dimension); }
  std::span<const double> query(std::size_t i) const {
    const auto d = static_cast<std::size_t>(set_.dimension);
    return std::span(queries_).subspan(i * d, d);
  }

  void expect_location(std::size_t i, std::optional<CellId> hint) const {
    const Location found = triangulation_.locate(query(i), hint);
    const SignedIndex q = row_of_query(i);
    if (!oracle_.in_flat(q)) {
      EXPECT_EQ(found.kind, Location::Kind::outside_affine_hull);
      EXPECT_TRUE(found.face.empty());
      return;
    }
    // The smallest face that holds q is the same in every cell that holds it.
    std::vector<SignedIndex> face;
    std::set<CellId> holders;
    for (const auto& [cell, simplex] : finite_) {
      const auto signs = oracle_.barycentric_signs(simplex, q);
      if (std::find(signs.begin(), signs.end(), Sign::negative) != signs.end()) continue;
      holders.insert(cell);
      face.clear();
      for (std::size_t j = 0; j < signs.size(); ++j)
        if (signs[j] == Sign::positive) face.push_back(simplex[j]);
    }
    std::sort(face.begin(), face.end());
    std::vector<SignedIndex> found_face;
    for (const VertexId v : found.face)
      found_face.push_back(static_cast<SignedIndex>(triangulation_.row_of(v)));
    std::sort(found_face.begin(), found_face.end());
    EXPECT_EQ(found_face, face);
    const Location::Kind kind = holders.empty()    ? Location::Kind::outside_hull
                                : face.size() == 1 ? Location::Kind::on_vertex
                                : static_cast<int>(face.size()) == complex_.affine_dimension() + 1
                                    ? Location::Kind::in_cell
                                    : Location::Kind::on_face;
    ASSERT_EQ(found.kind, kind);
    if (kind == Location::Kind::outside_hull) {
      ASSERT_TRUE(complex_.is_cell(found.cell));
      EXPECT_TRUE(complex_.is_infinite(found.cell));
      EXPECT_TRUE(in_conflict(found.cell, q));
    } else {
      EXPECT_TRUE(holders.contains(found.cell));
    }
  }

  void expect_conflict_zone(std::size_t i, std::optional<CellId> hint) const {
    const SignedIndex q = row_of_query(i);
    const std::vector<CellId> zone = triangulation_.conflict_zone(query(i), hint);
    const std::set<CellId> found(zone.begin(), zone.end());
    EXPECT_EQ(found.size(), zone.size()) << "a cell is listed twice";
    std::set<CellId> expected;
    if (oracle_.in_flat(q) && !is_vertex(q))
      for (const CellId c : complex_.all_cells())
        if (in_conflict(c, q)) expected.insert(c);
    EXPECT_EQ(found, expected);
  }

  void expect_spheres(std::size_t i) const {
    const SignedIndex q = row_of_query(i);
    if (!oracle_.in_flat(q)) return;
    for (const auto& [cell, simplex] : finite_)
      EXPECT_EQ(triangulation_.in_sphere(cell, query(i)), oracle_.side_of_sphere(simplex, q));
  }

  std::vector<std::optional<CellId>> hints() const {
    std::vector<std::optional<CellId>> result{std::nullopt};
    if (!finite_.empty()) result.emplace_back(finite_.front().first);
    for (const CellId c : complex_.infinite_cells()) {
      result.emplace_back(c);
      break;
    }
    return result;
  }

 private:
  static Options options(bool force_runtime_dimension) {
    Options result;
    result.force_runtime_dimension = force_runtime_dimension;
    return result;
  }
  SignedIndex row_of_query(std::size_t i) const { return static_cast<SignedIndex>(set_.size() + i); }
  BruteForce::Rows rows(CellId c) const {
    BruteForce::Rows result;
    for (const VertexId v : complex_.vertices(c))
      if (v != infinite_vertex) result.push_back(static_cast<SignedIndex>(triangulation_.row_of(v)));
    return result;
  }
  bool is_vertex(SignedIndex q) const {
    return std::any_of(oracle_.vertices().begin(), oracle_.vertices().end(),
                       [&](SignedIndex v) { return oracle_.equal(v, q); });
  }
  // Infinite cells: strictly beyond the hull facet, or on its plane and in conflict with the finite cell
  // behind it.
  bool in_conflict(CellId c, SignedIndex q) const {
    const int infinite = complex_.infinite_index(c);
    if (infinite < 0) return oracle_.in_conflict(rows(c), q);
    const CellId inner = complex_.neighbor(c, infinite);
    BruteForce::Rows simplex = rows(inner);
    const Sign whole = oracle_.orientation(simplex);
    simplex[static_cast<std::size_t>(complex_.mirror_index(c, infinite))] = q;
    const Sign side = oracle_.orientation(simplex) * whole;
    return side == Sign::zero ? oracle_.in_conflict(rows(inner), q) : side == Sign::negative;
  }

  const PointSet& set_;
  const std::vector<double>& queries_;
  BruteForce oracle_;
  Delaunay<> triangulation_;
  Complex complex_;
  std::vector<std::pair<CellId, BruteForce::Rows>> finite_;
};

// Vertices, means of 2 and 4 vertices (exact in binary64 for small integers), and random ones around.
std::vector<double> queries_for(const PointSet& set, std::size_t count, std::uint64_t seed) {
  const auto d = static_cast<std::size_t>(set.dimension);
  std::vector<double> queries;
  test::Random random(seed);
  const auto any = [&] { return static_cast<std::size_t>(random.bits() % set.size()); };
  for (std::size_t i = 0; i < count; ++i) {
    const std::size_t a = any(), b = any(), c = any(), e = any();
    for (std::size_t j = 0; j < d; ++j) {
      const auto x = [&](std::size_t row) { return set.points[row * d + j]; };
      const double mean = (x(a) + x(b)) / 2, mean_of_four = (x(a) + x(b) + x(c) + x(e)) / 4;
      switch (i % 6) {
        case 0:
          queries.push_back(x(a));
          break;
        case 1:
          queries.push_back(mean);
          break;
        case 2:
          queries.push_back(mean_of_four);
          break;
        case 3:
          queries.push_back(2 * x(a) - x(b));
          break;  // often outside, in the flat
        case 4:
          queries.push_back(x(a) + x(b) - x(c));
          break;  // fourth corner: ties
        default:
          queries.push_back(random.integer(-6, 6) / 2.0);  // anywhere, beside the flat
      }
    }
  }
  return queries;
}

void expect_correct_queries(const PointSet& set, std::size_t num_queries, std::uint64_t seed) {
  SCOPED_TRACE(set.name + "\n" + test::to_text(set.points, set.dimension));
  const std::vector<double> queries = queries_for(set, num_queries, seed);
  const Examination examination(set, queries, seed % 2 == 1);
  for (std::size_t i = 0; i < examination.num_queries(); ++i) {
    SCOPED_TRACE("query " + test::to_text(examination.query(i), set.dimension));
    for (const auto& hint : examination.hints()) {
      examination.expect_location(i, hint);
      examination.expect_conflict_zone(i, hint);
    }
    examination.expect_spheres(i);
    if (::testing::Test::HasFailure()) return;
  }
}

class LocateIn : public ::testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(Dimensions, LocateIn, ::testing::Range(1, 6), ::testing::PrintToStringParamName());

TEST_P(LocateIn, SmallIntegers) {
  const int d = GetParam();
  for (std::uint64_t seed = 0; seed < test::scaled_count(d <= 3 ? 60 : 8); ++seed) {
    expect_correct_queries(test::small_integers(d, d <= 3 ? 25 : 14, -3, 3, seed), 24, seed);
    if (HasFailure()) return;
  }
}

TEST_P(LocateIn, LatticesAndFlats) {
  const int d = GetParam();
  for (std::uint64_t seed = 0; seed < test::scaled_count(d <= 3 ? 10 : 2); ++seed) {
    expect_correct_queries(test::sampled(test::lattice(d, 3), 16, seed), 24, seed);
    for (int k = 1; k < d; ++k)
      expect_correct_queries(test::embedded(test::sampled(test::lattice(k, 4), 14, seed), d, true, seed), 24,
                             seed);
    if (HasFailure()) return;
  }
}

TEST_P(LocateIn, RealNumbers) {
  const int d = GetParam();
  for (std::uint64_t seed = 0; seed < test::scaled_count(4); ++seed) {
    expect_correct_queries({"uniform", d, make_point_set("uniform", d, d <= 3 ? 30 : 12, seed)}, 18, seed);
    if (HasFailure()) return;
  }
}

TEST_P(LocateIn, ManyPointsAndEveryVertex) {
  const int d = GetParam();
  static constexpr std::size_t usual[] = {5000, 5000, 3000, 500, 100};
  const std::vector<double> points = make_point_set("uniform", d, test::scaled_count(usual[d - 1]), 9);
  const Delaunay<> triangulation(points, d);
  const PointsView view(points, d);
  for (std::size_t row = 0; row < view.size(); ++row) {
    const Location found = triangulation.locate(view[row]);
    ASSERT_EQ(found.kind, Location::Kind::on_vertex);
    ASSERT_EQ(found.face, std::vector<VertexId>{triangulation.vertex_at(row)});
    ASSERT_GE(triangulation.complex().index_of(found.cell, found.face[0]), 0);
    ASSERT_TRUE(triangulation.conflict_zone(view[row]).empty());
  }
}

// Integer points prove ties by their grid; a query off the grid must not be taken for one of them.
TEST(OffGridQueries, OneUnitInTheLastPlaceBesideATie) {
  const Delaunay<> square(std::vector<double>{0, 0, 1, 0, 0, 1, 100, 100}, 2);
  for (const CellId cell : square.finite_cells()) {
    std::set<std::size_t> rows;
    for (const VertexId v : square.vertices(cell)) rows.insert(square.row_of(v));
    if (rows != std::set<std::size_t>{0, 1, 2}) continue;
    EXPECT_EQ(square.in_sphere(cell, std::array{1.0, 1.0}), Side::on);
    EXPECT_EQ(square.in_sphere(cell, std::array{1.0, std::nextafter(1.0, 0)}), Side::inside);
    EXPECT_EQ(square.in_sphere(cell, std::array{1.0, std::nextafter(1.0, 2)}), Side::outside);
    EXPECT_EQ(square.in_sphere(cell, std::array{1.0, 1e-300}), Side::inside);
    EXPECT_EQ(square.in_sphere(cell, std::array{1.0, -1e-300}), Side::outside);
  }
  const Delaunay<> triangle(std::vector<double>{0, 0, 4, 0, 0, 4}, 2);
  EXPECT_EQ(triangle.locate(std::array{1.0, 3.0}).kind, Location::Kind::on_face);
  EXPECT_EQ(triangle.locate(std::array{1.0, std::nextafter(3.0, 0)}).kind, Location::Kind::in_cell);
  EXPECT_EQ(triangle.locate(std::array{1.0, std::nextafter(3.0, 4)}).kind, Location::Kind::outside_hull);
  EXPECT_EQ(triangle.locate(std::array{1.0, 1e-310}).kind, Location::Kind::in_cell);
  EXPECT_EQ(triangle.locate(std::array{1.0, -1e-310}).kind, Location::Kind::outside_hull);
}

}  // namespace
}  // namespace delone
