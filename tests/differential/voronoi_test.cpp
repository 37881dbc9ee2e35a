// SPDX-License-Identifier: BSD-3-Clause
// Voronoi diagrams against their definition, in fractions without error on few points; against Qhull on more;
// volumes against boxes, counted samples and the geometry of clipped regions.
#include "degenerate.hpp"

#include <delone/voronoi.hpp>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>

#if DELONE_HAVE_QHULL
#include <libqhull_r/qhull_ra.h>
#endif

namespace delone {
namespace {

using Fraction = boost::multiprecision::cpp_rational;
using Vector = std::vector<Fraction>;

Vector exact(std::span<const double> x) { return {x.begin(), x.end()}; }
Fraction squared_distance(const Vector& a, const Vector& b) {
  Fraction sum = 0;
  for (std::size_t j = 0; j < a.size(); ++j) sum += (a[j] - b[j]) * (a[j] - b[j]);
  return sum;
}

/// The point of the affine hull of the sites that is equally far from all of them; none if they are
/// dependent.
std::optional<Vector> circumcenter(const std::vector<Vector>& sites) {
  const std::size_t k = sites.size() - 1, d = sites[0].size();
  std::vector<Vector> edges(k, Vector(d)), gram(k, Vector(k + 1));
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < d; ++j) edges[i][j] = sites[i + 1][j] - sites[0][j];
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t m = 0; m < k; ++m)
      for (std::size_t j = 0; j < d; ++j) gram[i][m] += 2 * edges[i][j] * edges[m][j];
    gram[i][k] = gram[i][i] / 2;
  }
  for (std::size_t s = 0; s < k; ++s) {
    std::size_t pivot = s;
    while (pivot < k && gram[pivot][s] == 0) ++pivot;
    if (pivot == k) return std::nullopt;
    std::swap(gram[pivot], gram[s]);
    for (std::size_t r = 0; r < k; ++r) {
      if (r == s) continue;
      const Fraction factor = gram[r][s] / gram[s][s];
      for (std::size_t c = s; c <= k; ++c) gram[r][c] -= factor * gram[s][c];
    }
  }
  Vector center = sites[0];
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t j = 0; j < d; ++j) center[j] += gram[i][k] / gram[i][i] * edges[i][j];
  return center;
}

/// The double nearest to x: no neighbor of it is nearer.
void expect_nearest(const Fraction& x, double rounded) {
  if (!std::isfinite(rounded)) {  // from half a unit in the last place beyond the largest double
    const Fraction beyond = Fraction(std::numeric_limits<double>::max()) + Fraction(std::ldexp(1.0, 970));
    EXPECT_GE(rounded > 0 ? x : Fraction(-x), beyond);
    return;
  }
  const Fraction error = abs(x - Fraction(rounded));
  for (const double other : {std::nextafter(rounded, -INFINITY), std::nextafter(rounded, INFINITY)}) {
    if (!std::isfinite(other)) continue;
    EXPECT_LE(error, abs(x - Fraction(other))) << rounded;
  }
}

/// All vertices and their nearest sites by definition.
std::map<Vector, std::set<std::size_t>> brute_force_vertices(const std::vector<Vector>& sites, int k) {
  std::map<Vector, std::set<std::size_t>> vertices;
  std::vector<bool> chosen(sites.size(), false);
  std::fill_n(chosen.begin(), k + 1, true);
  do {
    std::vector<Vector> simplex;
    for (std::size_t i = 0; i < sites.size(); ++i)
      if (chosen[i]) simplex.push_back(sites[i]);
    const auto center = circumcenter(simplex);
    if (!center) continue;
    const Fraction radius = squared_distance(*center, simplex[0]);
    std::set<std::size_t> nearest;
    bool is_empty = true;
    for (std::size_t i = 0; i < sites.size() && is_empty; ++i) {
      const Fraction distance = squared_distance(*center, sites[i]);
      is_empty = distance >= radius;
      if (distance == radius) nearest.insert(i);
    }
    if (is_empty) vertices[*center] = nearest;
  } while (std::prev_permutation(chosen.begin(), chosen.end()));
  return vertices;
}

void compare_with_definition(const test::PointSet& set) {
  SCOPED_TRACE(set.name);
  const Delaunay<> triangulation(set.points, set.dimension);
  const Voronoi diagram(triangulation);
  const int k = diagram.affine_dimension();
  std::vector<Vector> sites;
  for (std::size_t r = 0; r < diagram.num_regions(); ++r) {
    sites.push_back(exact(diagram.site(r)));
    EXPECT_EQ(diagram.point_region()[static_cast<std::size_t>(diagram.region_points()[r])],
              static_cast<SignedIndex>(r));
  }
  ASSERT_EQ(sites.size(), triangulation.num_vertices());
  if (k < 1) return;
  const auto expected = brute_force_vertices(sites, k);
  ASSERT_EQ(diagram.num_vertices(), expected.size());

  // The regions of each vertex name it: they are the nearest sites of exactly one expected vertex.
  std::vector<std::set<std::size_t>> nearest(diagram.num_vertices());
  for (std::size_t r = 0; r < diagram.num_regions(); ++r)
    for (const SignedIndex v : diagram.region(r))
      EXPECT_TRUE(v < 0 || nearest[static_cast<std::size_t>(v)].insert(r).second);
  std::map<std::set<std::size_t>, Vector> center_of;
  for (const auto& [center, around] : expected) center_of[around] = center;
  std::vector<Vector> centers;
  for (std::size_t v = 0; v < diagram.num_vertices(); ++v) {
    const auto found = center_of.find(nearest[v]);
    ASSERT_NE(found, center_of.end());
    for (std::size_t j = 0; j < found->second.size(); ++j)
      expect_nearest(found->second[j], diagram.vertex(v)[j]);
    centers.push_back(found->second);
  }

  // A point inside the common face of two regions has no third nearest site exactly if the face is a ridge.
  std::map<std::pair<SignedIndex, SignedIndex>, std::size_t> ridges;
  for (std::size_t i = 0; i < diagram.num_ridges(); ++i) {
    const SignedIndex a = diagram.point_region()[static_cast<std::size_t>(diagram.ridge_points()[2 * i])],
                      b = diagram.point_region()[static_cast<std::size_t>(diagram.ridge_points()[2 * i + 1])];
    EXPECT_LT(a, b);
    EXPECT_TRUE(ridges.emplace(std::pair{a, b}, i).second);
  }
  for (SignedIndex a = 0; a < static_cast<SignedIndex>(sites.size()); ++a)
    for (SignedIndex b = a + 1; b < static_cast<SignedIndex>(sites.size()); ++b) {
      std::set<SignedIndex> common;
      Vector middle(sites[0].size());
      for (std::size_t v = 0; v < centers.size(); ++v)
        if (nearest[v].count(static_cast<std::size_t>(a)) != 0 &&
            nearest[v].count(static_cast<std::size_t>(b)) != 0) {
          common.insert(static_cast<SignedIndex>(v));
          for (std::size_t j = 0; j < middle.size(); ++j) middle[j] += centers[v][j];
        }
      const auto ridge = ridges.find({a, b});
      if (common.empty()) {
        EXPECT_EQ(ridge, ridges.end());
        continue;
      }
      for (Fraction& x : middle) x /= common.size();
      const Fraction distance = squared_distance(middle, sites[static_cast<std::size_t>(a)]);
      std::size_t ties = 0;
      for (const Vector& site : sites) ties += squared_distance(middle, site) == distance ? 1 : 0;
      if (ridge == ridges.end()) {
        EXPECT_GT(ties, 2u) << a << ' ' << b;
        continue;
      }
      const auto items = diagram.ridge(ridge->second);
      std::set<SignedIndex> listed(items.begin(), items.end());
      EXPECT_EQ(listed.size(), items.size());
      const bool is_unbounded = listed.erase(-1) != 0;
      EXPECT_TRUE(!is_unbounded || items[0] == -1);
      EXPECT_EQ(listed, common);
      EXPECT_TRUE(is_unbounded || ties == 2) << a << ' ' << b;
    }

  // Far out along a ray its sites are still the nearest, up to rounding.
  for (std::size_t ray = 0; ray < diagram.num_rays(); ++ray) {
    const auto d = static_cast<std::size_t>(diagram.dimension());
    double length = 0;
    for (std::size_t j = 0; j < d; ++j) length += std::pow(diagram.ray_directions()[ray * d + j], 2);
    EXPECT_NEAR(length, 1, 1e-14);
    const auto& around = nearest[static_cast<std::size_t>(diagram.ray_vertices()[ray])];
    for (std::size_t i = 0; i < static_cast<std::size_t>(k); ++i) {
      const SignedIndex row = diagram.ray_points()[ray * static_cast<std::size_t>(k) + i];
      const auto r = static_cast<std::size_t>(diagram.point_region()[static_cast<std::size_t>(row)]);
      EXPECT_EQ(around.count(r), 1u);
      EXPECT_FALSE(diagram.is_bounded(r));
      for (std::size_t other = 0; other < sites.size(); ++other) {
        double ahead = 0, size = 0;  // of the other site, along the ray
        for (std::size_t j = 0; j < d; ++j) {
          ahead += (diagram.site(other)[j] - diagram.site(r)[j]) * diagram.ray_directions()[ray * d + j];
          size += std::abs(diagram.site(other)[j] - diagram.site(r)[j]);
        }
        EXPECT_LE(ahead, 1e-12 * size + 1e-320);
      }
    }
  }
}

TEST(VoronoiByDefinition, SmallIntegers) {
  for (int d = 1; d <= 4; ++d)
    for (std::uint64_t seed = 1; seed <= 25; ++seed)
      compare_with_definition(test::small_integers(d, d < 4 ? 11 : 9, -2, 2, seed));
}
TEST(VoronoiByDefinition, Generic) {
  for (int d = 1; d <= 5; ++d)
    for (std::uint64_t seed = 1; seed <= 4; ++seed) {
      test::PointSet set{"uniform", d, {}};
      test::Random random(seed);
      for (int i = 0; i < (d < 4 ? 10 : 8) * d; ++i) set.points.push_back(random.real() - 0.5);
      compare_with_definition(set);
    }
}
TEST(VoronoiByDefinition, LatticesAndSpheres) {
  for (int d = 1; d <= 3; ++d) compare_with_definition(test::sampled(test::lattice(d, 3), 12, 1));
  compare_with_definition(test::lattice(2, 3));
  compare_with_definition(test::lattice(3, 2));
  for (int d = 2; d <= 4; ++d)
    compare_with_definition(test::sampled(test::cospherical(d, d == 2 ? 25 : 9), 9, 2));
}
TEST(VoronoiByDefinition, Flats) {
  for (int d = 2; d <= 4; ++d)
    for (int k = 0; k < d; ++k)
      for (const bool tilted : {false, true})
        for (std::uint64_t seed = 1; seed <= 3; ++seed) {
          const auto flat =
              k == 0 ? test::PointSet{"point", 1, {3}} : test::small_integers(k, 8, -3, 3, seed);
          compare_with_definition(test::embedded(flat, d, tilted, seed));
        }
}
TEST(VoronoiByDefinition, NudgedLattices) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    test::PointSet set = test::lattice(2, 3);
    test::Random random(seed);
    for (double& x : set.points) x = random.integer(0, 2) == 0 ? std::nextafter(x + 1, 10) : x + 1;
    compare_with_definition(set);
  }
}
TEST(VoronoiByDefinition, TheWholeRangeOfDoubles) {
  for (const double scale : {1e-300, 0x1p-1074, 1e150, 1e300}) {
    test::PointSet set = test::small_integers(2, 9, -20, 20, 3);
    for (double& x : set.points) x *= scale;
    compare_with_definition(set);
    set.points.resize(14);
    test::Random random(7);
    for (double& x : set.points) x = std::ldexp(random.real(), random.integer(-900, 900));
    compare_with_definition(set);
  }
}

TEST(Voronoi, NoPointOnePointAndALine) {
  const Voronoi none{Delaunay<>(3)};
  EXPECT_EQ(none.num_regions(), 0u);
  EXPECT_EQ(none.affine_dimension(), -1);
  EXPECT_TRUE(none.region_volumes().empty());

  const Voronoi one{Delaunay<>(std::vector<double>{1, 2, 1, 2}, 2)};
  ASSERT_EQ(one.num_regions(), 1u);
  EXPECT_EQ(one.num_unbounded_regions(), 1u);
  EXPECT_EQ(one.num_vertices(), 0u);
  EXPECT_EQ(one.point_region()[1], 0);
  EXPECT_EQ(one.region(0).size(), 1u);
  EXPECT_EQ(one.region_volumes()[0], INFINITY);
  EXPECT_EQ(one.region_volumes(Box{{0, 0}, {4, 3}})[0], 12);

  const Voronoi line{Delaunay<>(std::vector<double>{7, 1, 2, 4}, 1)};
  ASSERT_EQ(line.num_vertices(), 3u);
  EXPECT_EQ(line.region_volumes(), (std::vector<double>{INFINITY, INFINITY, 1.5, 2.5}));
  EXPECT_EQ(line.region_volumes(Box{{0}, {6}}), (std::vector<double>{0.5, 1.5, 1.5, 2.5}));
  EXPECT_EQ(line.num_rays(), 2u);
}

TEST(Voronoi, Grid) {
  const test::PointSet set = test::lattice(2, 5);
  const Voronoi diagram{Delaunay<>(set.points, 2)};
  EXPECT_EQ(diagram.num_vertices(), 16u);
  EXPECT_EQ(diagram.num_ridges(), 40u);
  EXPECT_EQ(diagram.num_unbounded_regions(), 16u);
  EXPECT_EQ(diagram.num_rays(), 16u);
  for (std::size_t r = 0; r < 25; ++r)
    if (diagram.is_bounded(r)) {
      EXPECT_EQ(diagram.region_volumes()[r], 1);
      EXPECT_EQ(diagram.region(r).size(), 4u);
    }
  for (const double volume : diagram.region_volumes(Box{{-0.5, -0.5}, {4.5, 4.5}}))
    EXPECT_NEAR(volume, 1, 1e-14);
  for (int d = 3; d <= 5; ++d) {
    const Voronoi other{Delaunay<>(test::lattice(d, 3).points, d)};
    EXPECT_EQ(other.num_vertices(), std::size_t{1} << d);
    EXPECT_EQ(static_cast<double>(other.num_ridges()), d * 2 * std::pow(3, d - 1));
    const auto volumes = other.region_volumes();
    EXPECT_EQ(std::count(volumes.begin(), volumes.end(), INFINITY), std::pow(3, d) - 1);
    EXPECT_NEAR(*std::min_element(volumes.begin(), volumes.end()), 1, 1e-14);
  }
}

/// Sets of points of all kinds with a box that cuts through them.
std::vector<test::PointSet> sets_to_clip() {
  std::vector<test::PointSet> sets;
  for (int d = 1; d <= 6; ++d) {
    const std::size_t n = d <= 3 ? 60 : d == 4 ? 25 : d == 5 ? 12 : 9;
    sets.push_back({"uniform", d, make_point_set("uniform", d, n, 5)});
    sets.push_back(test::small_integers(d, n, -2, 2, 5));
    if (d > 1) sets.push_back(test::sampled(test::cospherical(d, d == 2 ? 25 : 9), n, 1));
    if (d <= 4) sets.push_back(test::lattice(d, 3));
    if (d == 3) sets.push_back(test::embedded(test::small_integers(2, 20, -2, 2, 3), 3, true, 3));
    if (d == 4) sets.push_back(test::embedded(test::small_integers(1, 6, -2, 2, 3), 4, false, 3));
  }
  return sets;
}

TEST(VoronoiVolumes, AddUpToTheBox) {
  for (const test::PointSet& set : sets_to_clip()) {
    const Voronoi diagram{Delaunay<>(set.points, set.dimension)};
    const Box whole = diagram.bounding_box(0.25);
    Box part = whole, far = whole, tight = diagram.bounding_box(0);
    for (std::size_t j = 0; j < whole.low.size(); ++j) {
      const double length = whole.high[j] - whole.low[j];
      part.low[j] += 0.3 * length;
      part.high[j] -= 0.2 * length;
      far.low[j] += 2 * length;
      far.high[j] += 3 * length;
    }
    for (const Box& box : {whole, part, far, tight}) {
      const auto volumes = diagram.region_volumes(box);
      double expected = 1;
      for (std::size_t j = 0; j < box.low.size(); ++j) expected *= box.high[j] - box.low[j];
      EXPECT_NEAR(std::accumulate(volumes.begin(), volumes.end(), 0.0), expected, 1e-12 * expected)
          << set.name << " d=" << set.dimension;
    }
  }
}

TEST(VoronoiVolumes, ClippingOnlyCutsOff) {
  for (const test::PointSet& set : sets_to_clip()) {
    if (set.dimension == 6) continue;
    const Voronoi diagram{Delaunay<>(set.points, set.dimension)};
    if (diagram.affine_dimension() < diagram.dimension()) continue;
    // Every region is cut by the first box, which is large enough for the bounded ones to be whole.
    const auto whole = diagram.region_volumes();
    const auto clipped = diagram.region_volumes(diagram.bounding_box(1e3));
    const auto part = diagram.region_volumes(diagram.bounding_box(0));
    for (std::size_t r = 0; r < whole.size(); ++r) {
      EXPECT_LE(clipped[r], whole[r] * (1 + 1e-10));
      EXPECT_LE(part[r], clipped[r] * (1 + 1e-9));
    }
  }
}

TEST(VoronoiVolumes, CountedSamples) {
  for (int d = 2; d <= 5; ++d) {
    const auto points = make_point_set("uniform", d, 10, 3);
    const Voronoi diagram{Delaunay<>(points, d)};
    const Box box = diagram.bounding_box(0.2);
    const auto volumes = diagram.region_volumes(box);
    const double total = std::accumulate(volumes.begin(), volumes.end(), 0.0);
    constexpr int samples = 40000;
    std::vector<int> counts(10, 0);
    test::Random random(11);
    for (int s = 0; s < samples; ++s) {
      std::vector<double> x;
      for (std::size_t j = 0; j < box.low.size(); ++j)
        x.push_back(box.low[j] + random.real() * (box.high[j] - box.low[j]));
      std::size_t best = 0;
      double least = INFINITY;
      for (std::size_t r = 0; r < 10; ++r) {
        double distance = 0;
        for (std::size_t j = 0; j < x.size(); ++j) distance += std::pow(x[j] - diagram.site(r)[j], 2);
        if (distance < least) least = distance, best = r;
      }
      ++counts[best];
    }
    for (std::size_t r = 0; r < 10; ++r) {
      const double p = volumes[r] / total;
      EXPECT_NEAR(counts[r], p * samples, 5 * std::sqrt(samples * p * (1 - p)) + 1) << "d=" << d;
    }
  }
}

TEST(VoronoiVolumes, BoundedRegionsByTwoRoutes) {
  for (int d = 2; d <= 4; ++d) {
    const Voronoi diagram{Delaunay<>(make_point_set("uniform", d, d == 4 ? 120 : 200, 9), d)};
    const auto volumes = diagram.region_volumes();
    // A box that just touches the region sends it through the clipper instead.
    int compared = 0;
    for (std::size_t r = 0; r < diagram.num_regions() && compared < 20; ++r) {
      if (!diagram.is_bounded(r)) continue;
      Box box{std::vector<double>(static_cast<std::size_t>(d), INFINITY),
              std::vector<double>(static_cast<std::size_t>(d), -INFINITY)};
      for (const SignedIndex v : diagram.region(r))
        for (std::size_t j = 0; j < box.low.size(); ++j) {
          box.low[j] = std::min(box.low[j], diagram.vertex(static_cast<std::size_t>(v))[j]);
          box.high[j] = std::max(box.high[j], diagram.vertex(static_cast<std::size_t>(v))[j]);
        }
      box.low[0] = std::nextafter(box.low[0], INFINITY);
      EXPECT_NEAR(diagram.region_volumes(box)[r], volumes[r], 1e-10 * volumes[r]);
      ++compared;
    }
    EXPECT_GT(compared, 0);
  }
}

TEST(VoronoiGeometry, FacesCloseAndEnclose) {
  for (const test::PointSet& set : sets_to_clip()) {
    if (set.dimension > 3) continue;
    const Voronoi diagram{Delaunay<>(set.points, set.dimension)};
    const Box box = diagram.bounding_box(0.1);
    const auto volumes = diagram.region_volumes(box);
    diagram.for_each_clipped_region(box, [&](std::size_t r, const ClippedRegion& region) {
      const auto at = [&](Index c, std::size_t j) {
        return region.corners[c * static_cast<std::size_t>(set.dimension) + j] - diagram.site(r)[j];
      };
      double volume = 0;
      std::map<std::pair<Index, Index>, int> edges;
      for (const auto& face : region.faces)
        for (std::size_t i = 0; i < face.size(); ++i) {
          const Index a = face[i], b = face[(i + 1) % face.size()], o = face[0];
          EXPECT_NE(a, b);
          ++edges[{a, b}];
          if (set.dimension == 1) volume += i == 0 ? -at(a, 0) : at(a, 0);
          if (set.dimension == 2) volume += (at(a, 0) * at(b, 1) - at(a, 1) * at(b, 0)) / 2;
          if (set.dimension == 3)
            volume += (at(o, 0) * (at(a, 1) * at(b, 2) - at(a, 2) * at(b, 1)) +
                       at(o, 1) * (at(a, 2) * at(b, 0) - at(a, 0) * at(b, 2)) +
                       at(o, 2) * (at(a, 0) * at(b, 1) - at(a, 1) * at(b, 0))) /
                      6;
        }
      EXPECT_NEAR(volume, volumes[r], 1e-11) << set.name << " d=" << set.dimension;
      if (set.dimension == 3)
        for (const auto& [edge, count] : edges) {
          EXPECT_EQ(count, 1);
          EXPECT_EQ(edges.count({edge.second, edge.first}), 1u);
        }
    });
  }
}

TEST(VoronoiGeometry, ClippedRegionsShareTheirFaces) {
  for (const test::PointSet& set : sets_to_clip()) {
    if (set.dimension != 2 && set.dimension != 3) continue;
    const auto d = static_cast<std::size_t>(set.dimension);
    const Voronoi diagram{Delaunay<>(set.points, set.dimension)};
    const Box box = diagram.bounding_box(0.1);
    const auto volumes = diagram.region_volumes(box);
    const ClippedRegions regions = diagram.clipped_regions(box);
    ASSERT_EQ(regions.num_regions(), diagram.num_regions());
    std::map<std::vector<SignedIndex>, std::vector<std::pair<SignedIndex, SignedIndex>>> sides;
    for (std::size_t r = 0; r < diagram.num_regions(); ++r) {
      const auto at = [&](SignedIndex c, std::size_t j) {
        return regions.vertices[static_cast<std::size_t>(c) * d + j] - diagram.site(r)[j];
      };
      double volume = 0;
      std::set<std::pair<SignedIndex, SignedIndex>> edges;
      for (auto f = static_cast<std::size_t>(regions.region_offsets[r]);
           f < static_cast<std::size_t>(regions.region_offsets[r + 1]); ++f) {
        const auto first = static_cast<std::size_t>(regions.face_offsets[f]),
                   size = static_cast<std::size_t>(regions.face_offsets[f + 1]) - first;
        const auto face = std::span(regions.face_vertices).subspan(first, size);
        for (std::size_t i = 0; i < size; ++i) {
          const SignedIndex a = face[i], b = face[(i + 1) % size], o = face[0];
          EXPECT_TRUE(edges.emplace(a, b).second);
          if (d == 2) sides[{std::min(a, b), std::max(a, b)}].emplace_back(r, regions.neighbors[first + i]);
          if (d == 2) volume += (at(a, 0) * at(b, 1) - at(a, 1) * at(b, 0)) / 2;
          if (d == 3)
            volume += (at(o, 0) * (at(a, 1) * at(b, 2) - at(a, 2) * at(b, 1)) +
                       at(o, 1) * (at(a, 2) * at(b, 0) - at(a, 0) * at(b, 2)) +
                       at(o, 2) * (at(a, 0) * at(b, 1) - at(a, 1) * at(b, 0))) /
                      6;
        }
        std::vector<SignedIndex> corners(face.begin(), face.end());
        std::sort(corners.begin(), corners.end());
        if (d == 3) sides[corners].emplace_back(r, regions.neighbors[f]);
      }
      EXPECT_NEAR(volume, volumes[r], 1e-11) << set.name << " d=" << d;
      for (const auto& [a, b] : edges) EXPECT_EQ(edges.count({b, a}), d - 2);
    }
    for (const auto& [corners, of] : sides) {
      ASSERT_LE(of.size(), 2u);
      EXPECT_EQ(of[0].second, of.size() == 1 ? -1 : of[1].first);
      if (of.size() == 2) {
        EXPECT_EQ(of[1].second, of[0].first);
      }
    }
  }
}

/// Weights 2a·p leave the triangulation as it is and move the diagram by −a.
Regular<> with_shifted_weights(const std::vector<double>& points, const std::vector<double>& a) {
  std::vector<double> weights;
  for (std::size_t i = 0; i < points.size(); i += a.size())
    weights.push_back(2 * std::inner_product(a.begin(), a.end(), points.data() + i, 0.0));
  return {points, weights, static_cast<int>(a.size())};
}

TEST(Power, AffineWeightsShiftTheDiagram) {
  for (int d = 1; d <= 5; ++d) {
    const test::PointSet set = test::small_integers(d, d < 4 ? 40 : 15, -3, 3, 4);
    std::vector<double> a;
    for (int j = 0; j < d; ++j) a.push_back(0.25 * (j + 1));
    const Regular<> triangulation = with_shifted_weights(set.points, a);
    const PowerDiagram power(triangulation);
    const Voronoi plain{Delaunay<>(set.points, d)};
    ASSERT_EQ(power.num_vertices(), plain.num_vertices());
    ASSERT_EQ(power.num_ridges(), plain.num_ridges());
    // The same vertices, moved, in another order.
    std::vector<bool> met(plain.num_vertices());
    for (std::size_t v = 0; v < power.num_vertices(); ++v) {
      const auto is_moved = [&](std::size_t w) {
        for (std::size_t j = 0; j < a.size(); ++j)
          if (!(std::abs(power.vertex(v)[j] - (plain.vertex(w)[j] - a[j])) <= 1e-13)) return false;
        return !met[w];
      };
      std::size_t w = 0;
      while (w < met.size() && !is_moved(w)) ++w;
      ASSERT_LT(w, met.size());
      met[w] = true;
    }
    Box box = plain.bounding_box(0.1), moved = box;
    for (std::size_t j = 0; j < a.size(); ++j) {
      moved.low[j] -= a[j];
      moved.high[j] -= a[j];
    }
    const auto expected = plain.region_volumes(box), volumes = power.region_volumes(moved);
    for (std::size_t r = 0; r < volumes.size(); ++r)
      EXPECT_NEAR(volumes[r], expected[r], 1e-9 * (1 + expected[r]));
    const auto whole = plain.region_volumes(), whole_power = power.region_volumes();
    for (std::size_t r = 0; r < whole.size(); ++r)
      if (plain.is_bounded(r))
        EXPECT_NEAR(whole_power[r], whole[r], 1e-9 * whole[r]);
      else
        EXPECT_EQ(whole_power[r], INFINITY);
  }
}

TEST(Voronoi, DoesNotDependOnTheOrderOfThePoints) {
  for (const test::PointSet& set :
       {test::lattice(3, 3), test::small_integers(4, 40, -2, 2, 1), test::small_integers(2, 60, 0, 9, 1)}) {
    std::set<std::vector<double>> vertices[2];
    std::size_t ridges[2];
    for (std::size_t run = 0; run < 2; ++run) {
      const auto points = run == 0 ? set : test::permuted(set, 5);
      const Voronoi diagram{Delaunay<>(points.points, set.dimension)};
      for (std::size_t v = 0; v < diagram.num_vertices(); ++v)
        EXPECT_TRUE(vertices[run].emplace(diagram.vertex(v).begin(), diagram.vertex(v).end()).second);
      ridges[run] = diagram.num_ridges();
    }
    EXPECT_EQ(vertices[0], vertices[1]);
    EXPECT_EQ(ridges[0], ridges[1]);
  }
}

TEST(Voronoi, BadBoxes) {
  const Voronoi diagram{Delaunay<>(std::vector<double>{0, 0, 1, 0, 0, 1}, 2)};
  for (const Box& box :
       {Box{{0}, {1}}, Box{{0, 0}, {1, 0}}, Box{{0, NAN}, {1, 1}}, Box{{0, 0}, {1, INFINITY}}}) {
    try {
      diagram.region_volumes(box);
      ADD_FAILURE() << "no error";
    } catch (const Error& e) {
      EXPECT_EQ(e.code(), Errc::invalid_argument);
    }
  }
}

#if DELONE_HAVE_QHULL
TEST(VoronoiAgainstQhull, UniformPoints) {
  for (int d = 2; d <= 5; ++d) {
    const int n = d == 2 ? 500 : d == 3 ? 300 : d == 4 ? 100 : 50;
    auto points = make_point_set("uniform", d, static_cast<std::size_t>(n), 17);
    const Voronoi diagram{Delaunay<>(points, d)};
    qhT state;
    qhT* qh = &state;
    qh_zero(qh, stderr);
    char command[] = "qhull v Qbb";
    ASSERT_EQ(qh_new_qhull(qh, d, n, points.data(), False, command, nullptr, stderr), 0);
    boolT is_lower;
    int num_centers;
    setT* vertices = qh_markvoronoi(qh, qh->facet_list, nullptr, False, &is_lower, &num_centers);
    const int ridges = qh_eachvoronoi_all(qh, nullptr, nullptr, False, qh_RIDGEall, 1);
    // Qhull leaves out ridges of fewer than d vertices, infinity counted once: some of the unbounded ones.
    int expected = 0;
    for (std::size_t i = 0; i < diagram.num_ridges(); ++i)
      expected += diagram.ridge(i).size() >= static_cast<std::size_t>(d);
    EXPECT_EQ(ridges, expected) << "d=" << d;
    EXPECT_EQ(static_cast<std::size_t>(num_centers) - 1, diagram.num_vertices());
    facetT* facet;
    std::vector<std::vector<double>> ours;
    for (std::size_t v = 0; v < diagram.num_vertices(); ++v)
      ours.emplace_back(diagram.vertex(v).begin(), diagram.vertex(v).end());
    std::sort(ours.begin(), ours.end());
    FORALLfacets {
      if (facet->upperdelaunay || facet->center == nullptr) continue;
      const auto near =
          std::lower_bound(ours.begin(), ours.end(),
                           std::vector<double>{facet->center[0] - 1e-6 * (1 + std::abs(facet->center[0]))});
      double least = INFINITY, size = 1;
      for (auto it = near;
           it != ours.end() && (*it)[0] < facet->center[0] + 1e-6 * (1 + std::abs(facet->center[0])); ++it) {
        double distance = 0;
        for (std::size_t j = 0; j < it->size(); ++j) {
          distance = std::max(distance, std::abs((*it)[j] - facet->center[j]));
          size = std::max(size, std::abs((*it)[j]));
        }
        least = std::min(least, distance);
      }
      EXPECT_LT(least, 1e-7 * size);
    }
    qh_settempfree(qh, &vertices);
    qh_freeqhull(qh, !qh_ALL);
    int current, total;
    qh_memfreeshort(qh, &current, &total);
  }
}
#endif

}  // namespace
}  // namespace delone
