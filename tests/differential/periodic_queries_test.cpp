// SPDX-License-Identifier: BSD-3-Clause
// Queries to periodic triangulations against the triangulation of many copies of the points, and against all
// copies one by one.
#include "periodic_sets.hpp"
#include "scale.hpp"

#include <delone/alpha.hpp>
#include <delone/delaunay.hpp>
#include <delone/faces.hpp>
#include <delone/interpolation.hpp>
#include <delone/natural_neighbors.hpp>
#include <delone/periodic_faces.hpp>
#include <delone/periodic_queries.hpp>
#include <delone/predicates.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numeric>
#include <optional>
#include <random>
#include <string>
#include <tuple>
#include <vector>

namespace delone {
namespace {

using Offset = std::vector<std::int32_t>;

/// All translates of the points by offsets of up to `reach`, in the order of rows and offsets.
struct Copies {
  Copies(const std::vector<double>& points, const std::vector<double>& given_weights, const Lattice& lattice,
         int reach)
      : d(static_cast<std::size_t>(lattice.dimension)), r(static_cast<std::size_t>(lattice.rank())) {
    std::vector<Offset> all;
    Offset k(r, -reach);
    for (bool more = true; more;) {
      all.push_back(k);
      more = false;
      for (std::size_t i = 0; i < r && !more; ++i) {
        more = k[i]++ < reach;
        if (!more) k[i] = -reach;
      }
    }
    std::sort(all.begin(), all.end());
    for (std::size_t row = 0; row < points.size() / d; ++row)
      for (const Offset& offset : all) {
        rows.push_back(static_cast<SignedIndex>(row));
        offsets.push_back(offset);
        for (std::size_t j = 0; j < d; ++j) {
          double x = points[row * d + j];
          for (std::size_t i = 0; i < r; ++i) x += offset[i] * lattice.vectors[i * d + j];
          coordinates.push_back(x);
        }
        if (!given_weights.empty()) weights.push_back(given_weights[row]);
      }
    const PointsView view(coordinates, lattice.dimension);
    if (weights.empty())
      triangulation = &delaunay.emplace(view);
    else
      triangulation = &regular.emplace(view, weights);
  }

  std::size_t d, r;
  std::vector<SignedIndex> rows;
  std::vector<Offset> offsets;
  std::vector<double> coordinates, weights;
  const Triangulation* triangulation = nullptr;  // one of these
  std::optional<Delaunay<>> delaunay;
  std::optional<Regular<>> regular;
};

/// Rows and offsets of vertices with a number each.
using Named = std::vector<std::tuple<SignedIndex, Offset, double>>;

struct Set {
  std::string name;
  std::vector<double> points, weights;
  Lattice lattice;
  int reach;
  std::vector<double> queries = {};  // more of them
};

std::vector<Set> sets() {
  std::vector<Set> all;
  for (const auto& [name, box] : test::lattices_in_space())
    for (const auto& [set_name, fractions] : test::sets_in_space(32))
      for (const int rank : {3, 2, 1}) {
        const bool is_skewed = std::string(name) == "skewed";
        if (is_skewed && (rank == 3 ? fractions.size() > 6 : fractions.size() > 15)) continue;
        const bool is_oblong = std::string(name) == "oblong";
        if (is_oblong && rank == 3 && fractions.size() > 15) continue;
        const int reach = is_skewed ? 8 : is_oblong ? 7 : fractions.size() > 30 ? 2 : 3;
        all.push_back({std::string(name) + ", " + set_name + ", rank " + std::to_string(rank),
                       test::at_fractions(fractions, box),
                       {},
                       test::of_rank(box, rank),
                       reach});
      }
  for (const int d : {1, 2, 4})
    for (int rank = 1; rank <= d; ++rank)
      for (const std::size_t n : {std::size_t{1}, std::size_t{6}}) {
        Lattice lattice{d, {}};
        for (int i = 0; i < rank; ++i)
          for (int j = 0; j < d; ++j) lattice.vectors.push_back(i == j ? 1 : i == j + 1 ? .25 : 0);
        auto points = test::random_fractions(n * static_cast<std::size_t>(d), 3);
        for (double& x : points) x = test::coarse(x);
        all.push_back(
            {std::to_string(n) + " points, dimension " + std::to_string(d) + ", rank " + std::to_string(rank),
             points,
             {},
             lattice,
             d == 4 ? 2 : 4});
      }
  const Lattice cube = Lattice::box(std::vector<double>{1, 1, 1});
  for (const double range : {.05, 1.0}) {
    Set weighted{"weights up to " + std::to_string(range), {}, {}, cube, 3};
    weighted.points = test::at_fractions(test::random_fractions(30, 6), cube);
    weighted.weights = test::random_fractions(10, 7);
    for (double& w : weighted.weights) w *= range;
    all.push_back(weighted);
  }
  // Images of hidden points are vertices of cells that have no vertex in the box.
  all.push_back({"a hidden point",
                 {0, 1, 1, 0, .875, 0},
                 {0, 1},
                 {3, {1, -.5, 1, 0, -.5, -1.5, -2, -.5, .5}},
                 7,
                 {-1.25, 1.5, 1.375}});
  all.push_back({"a hidden point among three",
                 {.25, .625, .625, .375, .375, .875, 1, .125, .625},
                 {4, 1, 2},
                 {3, {-1.5, 2, 2, 1.5, -.5, .5, 1, 1, -.5}},
                 7,
                 {-1.875, -1.75, .625}});
  // Two lines of points in a plane that is not periodic along a third direction.
  all.push_back({"flat", {0, 0, 0, .5, .25, 0, .25, .5, 0}, {}, {3, {1, 0, 0, 0, 1, 0}}, 3});
  return all;
}

/// Random points of the box, points of the set, midpoints of edges, centers of the unit cells, and some that
/// are outside.
std::vector<double> queries_for(const Set& set) {
  const auto d = static_cast<std::size_t>(set.lattice.dimension),
             r = static_cast<std::size_t>(set.lattice.rank());
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> fraction(0, 1);
  std::vector<double> queries = set.points;
  for (int i = 0; i < 40; ++i) {
    std::vector<double> x(d);
    for (std::size_t l = 0; l < r; ++l) {
      double along = fraction(random);
      if (i % 3 == 0) along = std::floor(4 * along) / 4;
      for (std::size_t j = 0; j < d; ++j) x[j] += along * set.lattice.vectors[l * d + j];
    }
    for (std::size_t j = r; j < d; ++j) x[j] += 1.25 * fraction(random) - .125;
    for (const double one : x) queries.push_back(test::coarse(one));
  }
  for (std::size_t row = 1; row < set.points.size() / d; ++row)
    for (std::size_t j = 0; j < d; ++j) queries.push_back((set.points[j] + set.points[row * d + j]) / 2);
  queries.insert(queries.end(), set.queries.begin(), set.queries.end());
  return queries;
}

Named face_of(const PeriodicTriangulation& t, const PeriodicPointLocator& locator,
              std::span<const double> query, SignedIndex& cell, Offset& offset, Location::Kind& kind) {
  const auto corners = static_cast<std::size_t>(t.affine_dimension() + 1),
             r = static_cast<std::size_t>(t.rank());
  std::vector<double> barycentric(corners);
  offset.assign(r, 7);
  locator.locate(query, {{&kind, 1}, {&cell, 1}, offset, barycentric});
  Named named;
  for (std::size_t i = 0; cell >= 0 && i < corners; ++i) {
    if (barycentric[i] == 0) continue;
    const std::size_t at = static_cast<std::size_t>(cell) * corners + i;
    Offset of_vertex = offset;
    for (std::size_t l = 0; l < r; ++l) of_vertex[l] += t.cell_offsets()[at * r + l];
    named.emplace_back(t.cells()[at], of_vertex, barycentric[i]);
  }
  std::sort(named.begin(), named.end());
  return named;
}

/// Of all cells and their translates that have these vertices, the one of the least row and offset.
std::pair<SignedIndex, Offset> first_with(const PeriodicTriangulation& t, const Named& face) {
  const auto corners = static_cast<std::size_t>(t.affine_dimension() + 1),
             r = static_cast<std::size_t>(t.rank());
  std::vector<std::pair<SignedIndex, Offset>> all;
  for (std::size_t c = 0; c < t.num_cells(); ++c)
    for (std::size_t i = 0; i < corners; ++i) {
      const auto offset_of = [&](std::size_t j) {
        return t.cell_offsets().subspan((c * corners + j) * r, r);
      };
      if (t.cells()[c * corners + i] != std::get<0>(face[0])) continue;
      Offset by = std::get<1>(face[0]);
      for (std::size_t l = 0; l < r; ++l) by[l] -= offset_of(i)[l];
      const bool has_all = std::ranges::all_of(face, [&](const auto& vertex) {
        for (std::size_t j = 0; j < corners; ++j) {
          Offset there = by;
          for (std::size_t l = 0; l < r; ++l) there[l] += offset_of(j)[l];
          if (t.cells()[c * corners + j] == std::get<0>(vertex) && there == std::get<1>(vertex)) return true;
        }
        return false;
      });
      if (has_all) all.emplace_back(static_cast<SignedIndex>(c), by);
    }
  return *std::min_element(all.begin(), all.end());
}

void expect_near(const Named& a, const Named& b, double error) {
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(std::get<0>(a[i]), std::get<0>(b[i]));
    EXPECT_EQ(std::get<1>(a[i]), std::get<1>(b[i]));
    EXPECT_NEAR(std::get<2>(a[i]), std::get<2>(b[i]), error);
  }
}

std::shared_ptr<const PeriodicTriangulation> triangulated(const Set& set) {
  const PointsView view(set.points, set.lattice.dimension);
  if (set.weights.empty()) return std::make_shared<const PeriodicDelaunay<>>(view, set.lattice);
  return std::make_shared<const PeriodicRegular<>>(view, set.weights, set.lattice);
}

TEST(PeriodicQueries, LocationAsAmongCopies) {
  for (const Set& set : sets()) {
    SCOPED_TRACE(set.name);
    const auto t = triangulated(set);
    const Copies copies(set.points, set.weights, set.lattice, set.reach);
    const PeriodicPointLocator locator(*t);
    const PointLocator among(*copies.triangulation);
    const auto queries = queries_for(set);
    for (std::size_t at = 0; at < queries.size(); at += copies.d) {
      const std::span<const double> query(&queries[at], copies.d);
      Named expected;
      Location::Kind kind{}, expected_kind{};
      among.locate(query, [&](std::size_t, const LocatedPoint& where) {
        expected_kind = where.kind;
        for (std::size_t i = 0; i < where.barycentric.size(); ++i) {
          if (where.barycentric[i] == 0) continue;
          const std::size_t row = copies.triangulation->row_of(copies.triangulation->vertices(where.cell)[i]);
          expected.emplace_back(copies.rows[row], copies.offsets[row], where.barycentric[i]);
        }
      });
      std::sort(expected.begin(), expected.end());
      SignedIndex cell = -7;
      Offset offset;
      const Named found = face_of(*t, locator, query, cell, offset, kind);
      SCOPED_TRACE("query " + std::to_string(at / copies.d));
      ASSERT_EQ(kind, expected_kind);
      expect_near(found, expected, 1e-9);
      if (cell >= 0) {
        EXPECT_EQ(std::pair(cell, offset), first_with(*t, found));
      }
      const PeriodicLocatedPoints places = locator.locate(query);
      EXPECT_EQ(places.cells[0], cell);
      EXPECT_EQ(places.offsets, cell < 0 ? Offset(copies.r) : offset);
      ASSERT_EQ(places.face_rows.size(), found.size());
      for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(places.face_rows[i], std::get<0>(found[i]));
        EXPECT_TRUE(std::equal(std::get<1>(found[i]).begin(), std::get<1>(found[i]).end(),
                               places.face_lattice.begin() + static_cast<std::ptrdiff_t>(i * copies.r)));
      }
      if (::testing::Test::HasFailure()) return;
    }
  }
}

TEST(PeriodicQueries, NearestOfAllCopies) {
  for (const Set& set : sets()) {
    SCOPED_TRACE(set.name);
    const auto t = triangulated(set);
    const Copies copies(set.points, set.weights, set.lattice, set.reach);
    const PeriodicPointLocator locator(*t);
    const auto queries = queries_for(set);
    const std::size_t count = queries.size() / copies.d;
    std::vector<SignedIndex> rows(count);
    std::vector<std::int32_t> offsets(count * copies.r);
    std::vector<double> distances(count);
    locator.nearest(queries, {rows, offsets, distances});
    for (std::size_t query = 0; query < count; ++query) {
      const std::span<const double> q(&queries[query * copies.d], copies.d);
      const auto point = [&](std::size_t i) {
        return std::span<const double>(&copies.coordinates[i * copies.d], copies.d);
      };
      const auto weight = [&](std::size_t i) { return copies.weights.empty() ? 0.0 : copies.weights[i]; };
      std::size_t best = 0;
      for (std::size_t i = 1; i < copies.rows.size(); ++i) {
        const Sign sign = compare_distances(q, point(i), point(best), weight(i), weight(best));
        if (sign == Sign::negative ||
            (sign == Sign::zero &&
             std::tie(copies.rows[i], copies.offsets[i]) < std::tie(copies.rows[best], copies.offsets[best])))
          best = i;
      }
      SCOPED_TRACE("query " + std::to_string(query));
      ASSERT_EQ(rows[query], copies.rows[best]);
      EXPECT_EQ(Offset(&offsets[query * copies.r], &offsets[query * copies.r] + copies.r),
                copies.offsets[best]);
      double square = 0;
      for (std::size_t j = 0; j < copies.d; ++j) square += (q[j] - point(best)[j]) * (q[j] - point(best)[j]);
      EXPECT_NEAR(distances[query], set.weights.empty() ? std::sqrt(square) : square - weight(best), 1e-12);
    }
  }
}

TEST(PeriodicQueries, NaturalNeighborsAsAmongCopies) {
  for (const Set& set : sets()) {
    if (!set.weights.empty()) continue;
    SCOPED_TRACE(set.name);
    const auto t = triangulated(set);
    const Copies copies(set.points, {}, set.lattice, set.reach);
    const PeriodicNaturalNeighborCoordinates coordinates(*t);
    const NaturalNeighborCoordinates among(*copies.triangulation);
    const auto queries = queries_for(set);
    const std::size_t count = queries.size() / copies.d;
    const PeriodicNaturalNeighbors found = coordinates.find(queries);
    std::vector<Named> expected(count);
    among.find(queries, [&](std::size_t query, const NaturalNeighbors& neighbors) {
      for (std::size_t i = 0; i < neighbors.vertices.size(); ++i) {
        const std::size_t row = copies.triangulation->row_of(neighbors.vertices[i]);
        // What cospherical points have beyond the error may be there or not.
        if (neighbors.weights[i] > 1e-9)
          expected[query].emplace_back(copies.rows[row], copies.offsets[row], neighbors.weights[i]);
      }
      std::sort(expected[query].begin(), expected[query].end());
    });
    for (std::size_t query = 0; query < count; ++query) {
      SCOPED_TRACE("query " + std::to_string(query));
      Named named;
      for (std::int64_t at = found.starts[query]; at < found.starts[query + 1]; ++at) {
        const auto i = static_cast<std::size_t>(at);
        if (found.weights[i] > 1e-9)
          named.emplace_back(found.rows[i],
                             Offset(found.offsets.begin() + static_cast<std::ptrdiff_t>(i * copies.r),
                                    found.offsets.begin() + static_cast<std::ptrdiff_t>((i + 1) * copies.r)),
                             found.weights[i]);
      }
      expect_near(named, expected[query], 1e-8);
      if (::testing::Test::HasFailure()) return;
    }
  }
}

TEST(PeriodicQueries, InterpolationAsAmongCopies) {
  for (const Set& set : sets()) {
    SCOPED_TRACE(set.name);
    const auto t = triangulated(set);
    const Copies copies(set.points, set.weights, set.lattice, set.reach);
    const std::size_t n = set.points.size() / copies.d;
    const std::vector<double> values = test::random_fractions(2 * n, 9);
    std::vector<double> of_copies;
    for (const SignedIndex row : copies.rows)
      of_copies.insert(of_copies.end(), {values[2 * static_cast<std::size_t>(row)],
                                         values[2 * static_cast<std::size_t>(row) + 1]});
    const auto queries = queries_for(set);
    const std::size_t count = queries.size() / copies.d;
    const auto compare = [](const std::vector<double>& a, const std::vector<double>& b, double error) {
      for (std::size_t i = 0; i < a.size(); ++i) {
        if (std::isnan(b[i]))
          EXPECT_TRUE(std::isnan(a[i])) << i;
        else
          EXPECT_NEAR(a[i], b[i], error) << i;
      }
    };
    const PeriodicLinearInterpolator linear(*t, values, 2);
    const LinearInterpolator among(*copies.triangulation, of_copies, 2);
    std::vector<double> a(2 * count), b(2 * count);
    for (const Outside outside : {Outside::fill, Outside::nearest}) {
      linear.evaluate(queries, a, {.outside = outside});
      among.evaluate(queries, b, {.outside = outside});
      compare(a, b, 1e-9);
    }
    if (set.weights.empty()) {
      const PeriodicNaturalNeighborInterpolator natural(*t, values, 2);
      const NaturalNeighborInterpolator natural_among(*copies.triangulation, of_copies, 2);
      natural.evaluate(queries, a);
      natural_among.evaluate(queries, b);
      compare(a, b, 1e-8);
      std::vector<double> c(2 * queries.size()), d(c.size());
      natural.gradients(queries, c);
      natural_among.gradients(queries, d);
      const double steepest = std::accumulate(d.begin(), d.end(), 1.0, [](double largest, double x) {
        return std::isnan(x) ? largest : std::max(largest, std::abs(x));
      });
      compare(c, d, 1e-8 * steepest);
    }
    if (::testing::Test::HasFailure()) return;
  }
}

TEST(PeriodicQueries, FacesAndAlphaValuesAsAmongCopies) {
  for (const Set& set : sets()) {
    if (set.points.size() > 16) continue;
    SCOPED_TRACE(set.name);
    const auto t = triangulated(set);
    const Copies copies(set.points, set.weights, set.lattice, set.reach);
    for (int j = 0; j <= copies.triangulation->affine_dimension(); ++j) {
      const FaceValues all = alpha_values(*copies.triangulation, j);
      const std::size_t corners = static_cast<std::size_t>(j) + 1;
      // By names of faces: their values. Those whose smallest vertex is a given point.
      std::map<std::vector<std::pair<SignedIndex, Offset>>, double> expected, found;
      for (std::size_t i = 0; i < all.faces.size(); ++i) {
        std::vector<std::pair<SignedIndex, Offset>> name;
        std::vector<std::pair<std::vector<double>, std::size_t>> places;
        for (const SignedIndex copy : all.faces.face(i)) {
          const auto row = static_cast<std::size_t>(copy);
          name.emplace_back(copies.rows[row], copies.offsets[row]);
          places.emplace_back(std::vector<double>(&copies.coordinates[row * copies.d],
                                                  &copies.coordinates[row * copies.d] + copies.d),
                              row);
        }
        if (copies.offsets[std::min_element(places.begin(), places.end())->second] != Offset(copies.r))
          continue;
        std::sort(name.begin(), name.end());
        expected.emplace(name, all.values[i]);
      }
      const PeriodicFaceValues once = alpha_values(*t, j);
      EXPECT_EQ(once.faces.vertices, faces(*t, j).vertices);
      for (std::size_t i = 0; i < once.faces.size(); ++i) {
        std::vector<std::pair<SignedIndex, Offset>> name;
        for (std::size_t at = i * corners; at < (i + 1) * corners; ++at)
          name.emplace_back(
              once.faces.vertices[at],
              Offset(once.faces.offsets.begin() + static_cast<std::ptrdiff_t>(at * copies.r),
                     once.faces.offsets.begin() + static_cast<std::ptrdiff_t>((at + 1) * copies.r)));
        std::sort(name.begin(), name.end());
        EXPECT_TRUE(found.emplace(name, once.values[i]).second);
      }
      ASSERT_EQ(found, expected) << "dimension " << j;
      if (j == t->affine_dimension()) {
        EXPECT_TRUE(std::ranges::equal(once.faces.vertices, t->cells()));
        EXPECT_TRUE(std::ranges::equal(once.faces.offsets, t->cell_offsets()));
      }
    }
  }
}

TEST(PeriodicQueries, TranslatesHaveTranslatedAnswers) {
  const Lattice lattice{3, {1, 0, 0, .25, 1, 0, -.375, .3125, 1}};
  for (const auto& [name, fractions] : test::sets_in_space(64)) {
    SCOPED_TRACE(name);
    const auto points = test::at_fractions(fractions, lattice);
    // Other translates of the points, another basis.
    std::vector<double> moved = points;
    for (std::size_t at = 0; at < moved.size(); at += 6)
      for (std::size_t j = 0; j < 3; ++j) moved[at + j] += 3 * lattice.vectors[j] - lattice.vectors[6 + j];
    const PeriodicDelaunay<> t(PointsView(points, 3), lattice), other(PointsView(moved, 3), lattice);
    const PeriodicPointLocator locator(t), of_other(other);
    const auto queries = queries_for({name, points, {}, lattice, 1});
    std::vector<double> translated = queries;
    for (std::size_t at = 0; at < translated.size(); at += 3)
      for (std::size_t j = 0; j < 3; ++j)
        translated[at + j] += 5 * lattice.vectors[3 + j] - 1024 * lattice.vectors[6 + j];
    const PeriodicLocatedPoints a = locator.locate(queries), b = locator.locate(translated);
    EXPECT_EQ(a.kinds, b.kinds);
    EXPECT_EQ(a.cells, b.cells);
    EXPECT_EQ(a.face_rows, b.face_rows);
    const std::size_t count = queries.size() / 3;
    for (std::size_t i = 0; i < count; ++i) {
      EXPECT_EQ(b.offsets[3 * i], a.offsets[3 * i]);
      EXPECT_EQ(b.offsets[3 * i + 1], a.offsets[3 * i + 1] + 5);
      EXPECT_EQ(b.offsets[3 * i + 2], a.offsets[3 * i + 2] - 1024);
    }
    std::vector<SignedIndex> rows(count), others(count);
    std::vector<std::int32_t> offsets(3 * count), other_offsets(3 * count);
    locator.nearest(queries, {.rows = rows, .offsets = offsets});
    of_other.nearest(translated, {.rows = others, .offsets = other_offsets});
    for (std::size_t i = 0; i < count; ++i) {
      const auto at = [&](const PeriodicTriangulation& from, SignedIndex row, const std::int32_t* offset,
                          std::size_t j) {
        double x = from.points()[3 * static_cast<std::size_t>(row) + j];
        for (std::size_t l = 0; l < 3; ++l) x += offset[l] * lattice.vectors[3 * l + j];
        return x;
      };
      if (name.find("random") == std::string::npos) continue;  // ties: by rows and offsets as given
      EXPECT_EQ(rows[i], others[i]);
      for (std::size_t j = 0; j < 3; ++j)
        EXPECT_EQ(
            at(t, rows[i], &offsets[3 * i], j) + 5 * lattice.vectors[3 + j] - 1024 * lattice.vectors[6 + j],
            at(other, others[i], &other_offsets[3 * i], j));
    }
  }
}

TEST(PeriodicQueries, ThreadsChangeNothing) {
  const auto points = test::random_fractions(3 * test::scaled_count(3000), 11);
  const PeriodicDelaunay<> t(PointsView(points, 3), Lattice::box(std::vector<double>{1, 1, 1}));
  const PeriodicPointLocator locator(t);
  const auto queries = test::random_fractions(3 * 5000, 12);
  const std::size_t count = queries.size() / 3;
  const PeriodicLocatedPoints one = locator.locate(queries, {.threads = 1}),
                              two = locator.locate(queries, {.threads = 2});
  EXPECT_EQ(one.cells, two.cells);
  EXPECT_EQ(one.offsets, two.offsets);
  std::vector<double> a(count), b(count);
  locator.nearest(queries, {.distances = a}, {.threads = 1});
  locator.nearest(queries, {.distances = b}, {.threads = 2});
  EXPECT_EQ(a, b);
  const std::vector<double> values(points.begin(),
                                   points.begin() + static_cast<std::ptrdiff_t>(t.num_points()));
  const PeriodicNaturalNeighborInterpolator natural(t, values);
  natural.evaluate(queries, a, {}, {.threads = 1});
  natural.evaluate(queries, b, {}, {.threads = 2});
  EXPECT_EQ(a, b);
}

TEST(PeriodicQueries, BadInputIsNamed) {
  const std::vector<double> points{.5, .5, .25, .125};
  const PeriodicDelaunay<> t(PointsView(points, 2), Lattice::box(std::vector<double>{1, 1}));
  const PeriodicPointLocator locator(t);
  const auto code_of = [&](std::vector<double> queries) {
    try {
      locator.locate(queries);
    } catch (const Error& error) {
      return std::pair(error.code(), error.rows());
    }
    return std::pair(Errc::cancelled, std::vector<std::size_t>{});
  };
  EXPECT_EQ(code_of({0, 0, 1, NAN}), std::pair(Errc::not_finite, std::vector<std::size_t>{1}));
  EXPECT_EQ(code_of({0, 0, 1, 1e300}), std::pair(Errc::invalid_argument, std::vector<std::size_t>{1}));
  EXPECT_EQ(code_of({0, 0, 1}).first, Errc::bad_dimension);
  std::vector<double> result(1);
  const PeriodicLinearInterpolator linear(t, points, 2);
  EXPECT_THROW(linear.evaluate(points, result), Error);
  result.resize(4);
  EXPECT_THROW(linear.evaluate(points, result, {.tolerance = .1}), Error);
  EXPECT_THROW(PeriodicLinearInterpolator(t, points, 3), Error);
  const PeriodicRegular<> weighted(PointsView(points, 2), std::vector<double>{0, .125},
                                   Lattice::box(std::vector<double>{1, 1}));
  EXPECT_THROW(PeriodicNaturalNeighborCoordinates{weighted}, Error);
}

}  // namespace
}  // namespace delone
