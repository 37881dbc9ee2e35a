// SPDX-License-Identifier: BSD-3-Clause
// Cells in boxes and halfspaces against the exact polyhedra of all bisectors and walls: faces, vertices to
// the last bit, and their order.
#include "cell_polygons.hpp"
#include "degenerate.hpp"

#include <delone/delaunay.hpp>
#include <delone/polyhedron.hpp>
#include <delone/regular.hpp>
#include <delone/site_cells.hpp>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <numeric>
#include <set>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace delone {
namespace {

using Integer = boost::multiprecision::cpp_int;
using Exact = boost::multiprecision::cpp_rational;
using Point = std::vector<double>;

struct Container {
  Box box;
  std::vector<double> halfspaces;
};

Rational rational(const Exact& x) { return Rational(x.str()); }

/// The integers without a common divisor that are a positive multiple of a row.
std::vector<Integer> primitive(const std::vector<Exact>& row) {
  Integer denominator = 1, divisor = 0;
  for (const Exact& x : row) denominator = lcm(denominator, boost::multiprecision::denominator(x));
  std::vector<Integer> result;
  for (const Exact& x : row) {
    result.push_back(numerator(x) * (denominator / boost::multiprecision::denominator(x)));
    divisor = gcd(divisor, result.back());
  }
  for (Integer& x : result) x /= divisor;
  return result;
}

std::vector<Integer> primitive(std::span<const Rational> row) {
  std::vector<Exact> exact;
  for (const Rational& x : row) exact.emplace_back(x.to_string());
  return primitive(exact);
}

/// A cell as it must be.
struct ExpectedCell {
  bool exists = false;
  std::vector<Point> vertices;  // rounded, by coordinates; so are those of faces
  struct Face {
    std::set<SignedIndex> neighbors;  // any of these; −1 for a wall
    std::vector<Point> vertices;
    std::vector<Exact> outward;
  };
  std::vector<Face> faces;
  std::map<Point, std::vector<Exact>> exact;  // of rounded vertices
  std::set<std::pair<Point, Point>> edges;
  bool are_distinct = true;  // vertices, after rounding
};

ExpectedCell expected_cell(const std::vector<double>& points, const std::vector<double>& weights, int d,
                           const Container& container, std::size_t row) {
  const auto width = static_cast<std::size_t>(d);
  std::map<std::vector<Integer>, std::set<SignedIndex>> labels;
  RationalRows rows;
  const auto add = [&](const std::vector<Exact>& a_and_b, SignedIndex label) {
    std::vector<Rational> entries;
    for (const Exact& x : a_and_b) entries.push_back(rational(x));
    rows.push_back(entries);
    std::set<SignedIndex>& of_row = labels[primitive(a_and_b)];
    if (of_row.contains(-1)) return;
    if (label < 0) of_row.clear();
    of_row.insert(label);
  };
  for (std::size_t other = 0; other < points.size() / width; ++other) {
    std::vector<Exact> bisector(width + 1);
    if (!weights.empty()) bisector[width] = Exact(weights[row]) - Exact(weights[other]);
    for (std::size_t j = 0; j < width; ++j) {
      const Exact s(points[row * width + j]), t(points[other * width + j]);
      bisector[j] = 2 * (t - s);
      bisector[width] += t * t - s * s;
    }
    if (std::ranges::any_of(std::span(bisector).first(width), [](const Exact& x) { return x != 0; })) {
      add(bisector, static_cast<SignedIndex>(other));
    } else if (other < row || bisector[width] < 0) {
      if (bisector[width] <= 0) return {};  // a duplicate, or one beside a larger weight
    }
  }
  for (std::size_t j = 0; j < width; ++j)
    for (const int sign : {-1, 1}) {
      std::vector<Exact> wall(width + 1);
      wall[j] = sign;
      wall[width] = sign < 0 ? Exact(-container.box.low[j]) : Exact(container.box.high[j]);
      add(wall, -1);
    }
  for (std::size_t i = 0; i < container.halfspaces.size(); i += width + 1) {
    std::vector<Exact> wall;
    for (std::size_t j = 0; j < width; ++j) wall.emplace_back(container.halfspaces[i + j]);
    wall.emplace_back(-container.halfspaces[i + width]);
    add(wall, -1);
  }
  const Polyhedron cell = Polyhedron::from_inequalities(rows, {}, d);
  ExpectedCell result;
  if (cell.affine_dimension() < d) return result;
  result.exists = true;
  const RationalRows exact = cell.vertices();
  for (std::size_t v = 0; v < exact.size(); ++v) {
    Point& rounded = result.vertices.emplace_back();
    for (const Rational& x : exact[v]) rounded.push_back(x.to_double());
    for (const Rational& x : exact[v]) result.exact[rounded].emplace_back(x.to_string());
  }
  const std::vector<Point> by_number = result.vertices;
  std::ranges::sort(result.vertices);
  result.are_distinct = std::ranges::adjacent_find(result.vertices) == result.vertices.end();
  for (const auto& [a, b] : cell.adjacent_vertices()) {
    result.edges.emplace(by_number[a], by_number[b]);
    result.edges.emplace(by_number[b], by_number[a]);
  }
  const RationalRows facets = cell.inequalities();
  for (std::size_t f = 0; f < facets.size(); ++f) {
    ExpectedCell::Face& face = result.faces.emplace_back();
    face.neighbors = labels.at(primitive(facets[f]));
    for (const std::size_t v : cell.vertices_of_facet(f)) face.vertices.push_back(by_number[v]);
    std::ranges::sort(face.vertices);
    for (const Rational& x : facets[f].first(width)) face.outward.emplace_back(x.to_string());
  }
  return result;
}

/// Whether three corners of a face turn left, seen from outside, or in the plane the way to the second corner
/// has the outside on its right.
bool turns_left(const ExpectedCell& cell, const std::vector<Point>& corners,
                const std::vector<Exact>& outward) {
  const auto way = [&](std::size_t from, std::size_t j) -> Exact {
    return cell.exact.at(corners[from + 1])[j] - cell.exact.at(corners[from])[j];
  };
  if (outward.size() == 2) return way(0, 1) * outward[0] - way(0, 0) * outward[1] > 0;
  Exact sum = 0;
  for (std::size_t j = 0; j < 3; ++j) {
    const std::size_t k = (j + 1) % 3, l = (j + 2) % 3;
    sum += outward[j] * (way(0, k) * way(1, l) - way(0, l) * way(1, k));
  }
  return sum > 0;
}

/// `are_proper`: faces and vertices must be those of the polyhedron. Otherwise they are among them, and what
/// is left over has too few different corners.
void expect_cell(const SiteCells& cells, std::size_t row, const ExpectedCell& expected, bool are_proper) {
  const auto d = static_cast<std::size_t>(cells.dimension);
  const auto first = static_cast<std::size_t>(cells.neighbor_offsets[row]),
             last = static_cast<std::size_t>(cells.neighbor_offsets[row + 1]);
  ASSERT_EQ(cells.num_faces[row] > 0, expected.exists);
  ASSERT_EQ(last - first, static_cast<std::size_t>(cells.num_faces[row]));
  std::vector<Point> vertices;
  for (auto v = cells.vertex_offsets[row]; v < cells.vertex_offsets[row + 1]; ++v)
    vertices.emplace_back(cells.vertices.begin() + v * cells.dimension,
                          cells.vertices.begin() + (v + 1) * cells.dimension);
  EXPECT_TRUE(std::ranges::is_sorted(vertices));
  if (!are_proper) {
    if (!expected.are_distinct) return;
    vertices.erase(std::ranges::unique(vertices).begin(), vertices.end());
  }
  EXPECT_EQ(vertices, expected.vertices);
  std::vector<int> seen(expected.faces.size(), 0);
  for (std::size_t i = first; i < last; ++i) {
    std::vector<Point> in_order;
    for (const SignedIndex v : test::polygon(cells, i)) {
      const auto at = (cells.vertex_offsets[row] + v) * cells.dimension;
      Point corner(cells.vertices.begin() + at, cells.vertices.begin() + at + cells.dimension);
      if (are_proper || in_order.empty() || in_order.back() != corner) in_order.push_back(std::move(corner));
    }
    while (!are_proper && in_order.size() > 1 && in_order.front() == in_order.back()) in_order.pop_back();
    std::vector<Point> sorted = in_order;
    std::ranges::sort(sorted);
    const auto matches = [&](const ExpectedCell::Face& face) {
      return face.vertices == sorted && face.neighbors.contains(cells.neighbors[i]);
    };
    auto face = std::ranges::find_if(expected.faces, matches);
    while (face != expected.faces.end() && seen[static_cast<std::size_t>(face - expected.faces.begin())] > 0)
      face = std::find_if(face + 1, expected.faces.end(), matches);
    if (face == expected.faces.end()) {
      EXPECT_TRUE(!are_proper && (d > 3 || sorted.size() < d)) << row << ", face " << i - first;
      continue;
    }
    seen[static_cast<std::size_t>(face - expected.faces.begin())] = 1;
    if (!expected.are_distinct || d < 2 || d > 3) continue;
    for (std::size_t a = 0; a < in_order.size() && d == 3; ++a)
      EXPECT_TRUE(expected.edges.contains({in_order[a], in_order[(a + 1) % in_order.size()]}));
    EXPECT_TRUE(turns_left(expected, in_order, face->outward));
  }
  EXPECT_EQ(std::ranges::count(seen, 0), 0) << "faces are missing";
}

/// Boxes around the points, and with walls on bisectors and through points; halfspaces through points, which
/// cut corners of the box, and near them.
std::vector<Container> containers(const std::vector<double>& points, std::size_t d) {
  Box around{Point(d), Point(d)};
  for (std::size_t j = 0; j < d; ++j) {
    double low = points[j], high = points[j];
    for (std::size_t i = j; i < points.size(); i += d) {
      low = std::min(low, points[i]);
      high = std::max(high, points[i]);
    }
    const double margin = low < high ? high / 4 - low / 4 : low == 0 ? 1 : std::abs(low) / 8;
    around.low[j] = std::max(low - margin, -std::numeric_limits<double>::max());
    around.high[j] = std::min(high + margin, std::numeric_limits<double>::max());
    if (!(around.low[j] < around.high[j])) around.high[j] += 1;  // denormals have no eighth
  }
  Box on_bisectors = around;
  const std::size_t last = points.size() - d;
  for (std::size_t j = 0; j < d; ++j) {
    const double middle = points[j] / 2 + points[last + j] / 2;
    if (middle > around.low[j] && middle < around.high[j])
      (j % 2 == 0 ? on_bisectors.low[j] : on_bisectors.high[j]) = middle;
  }
  std::vector<Container> result{{around, {}}, {on_bisectors, {}}};
  Point diagonal(2 * (d + 1), 0.0);
  for (std::size_t j = 0; j < d; ++j) {
    diagonal[j] = j % 2 == 0 ? 1 : -1;
    diagonal[d + 1 + j] = 1;
  }
  if (around.low[0] < -1e300 || around.high[0] > 1e300) return result;  // no room for sums
  Point moved = diagonal;
  for (std::size_t j = 0; j < d; ++j) {
    diagonal[d] -= diagonal[j] * points[j];  // rounded unless points are small integers
    diagonal[2 * d + 1] -= points[last + j];
    moved[d] = 0.1;
    moved[2 * d + 1] = -around.high[j] * 1.5;
  }
  result.push_back({around, diagonal});
  result.push_back({on_bisectors, moved});
  return result;
}

void expect_polyhedra(const test::PointSet& set, bool weighted) {
  const int d = set.dimension;
  const auto width = static_cast<std::size_t>(d);
  if (set.points.empty()) return;
  const std::size_t n = set.points.size() / width;
  std::vector<double> weights;
  for (std::size_t i = 0; weighted && i < n; ++i) weights.push_back(static_cast<double>(i * i % 3) / 2);
  const Delaunay<> delaunay(set.points, d);
  const Regular<> regular(set.points, weighted ? weights : std::vector<double>(n, 0.0), d);
  const Triangulation& t = weighted ? static_cast<const Triangulation&>(regular) : delaunay;
  for (const Container& container : containers(set.points, width)) {
    SCOPED_TRACE(set.name + (weighted ? ", weighted" : "") + ", d = " + std::to_string(d));
    const auto cells_with = [&](CellFaces faces) {
      return site_cells(
          t, {.faces = faces, .vertices = true, .box = container.box, .halfspaces = container.halfspaces});
    };
    const SiteCells proper = cells_with(CellFaces::proper), all = cells_with(CellFaces::triangulated);
    const bool has_finite_areas =
        std::ranges::all_of(set.points, [](double x) { return std::abs(x) < 1e150; });
    for (const SiteCells* cells : {&proper, &all})
      if ((d == 2 || d == 3) && has_finite_areas) test::expect_closed(*cells, d);
    for (std::size_t row = 0; row < n; ++row) {
      const ExpectedCell expected = expected_cell(set.points, weights, d, container, row);
      expect_cell(proper, row, expected, true);
      expect_cell(all, row, expected, false);
    }
  }
}

class SiteCellsPolyhedra : public testing::TestWithParam<int> {};

TEST_P(SiteCellsPolyhedra, AreTheCells) {
  const int d = GetParam();
  for (const test::PointSet& set : test::degenerate_sets(d, d < 3 ? 12 : d == 3 ? 8 : 6, 3))
    for (const bool weighted : {false, true}) expect_polyhedra(set, weighted);
}

/// Enough sites for cells that nothing cuts beside those that a wall does.
TEST_P(SiteCellsPolyhedra, OfLattices) {
  const int d = GetParam();
  if (d > 3) return;
  const test::PointSet lattice = test::lattice(d, d == 3 ? 3 : 5);
  for (const test::PointSet& set : {lattice, test::nudged(lattice, 4)}) expect_polyhedra(set, false);
}

INSTANTIATE_TEST_SUITE_P(Dimensions, SiteCellsPolyhedra, testing::Values(1, 2, 3, 4));

}  // namespace
}  // namespace delone
