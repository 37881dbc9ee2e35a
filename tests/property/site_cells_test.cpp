// SPDX-License-Identifier: BSD-3-Clause
// Cells of sites against the diagram of the same triangulation, and against what must hold for any cells.
#include "cell_polygons.hpp"
#include "error_code.hpp"
#include "same_bits.hpp"

#include <delone/convex_hull.hpp>
#include <delone/delaunay.hpp>
#include <delone/furthest_site.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>
#include <delone/site_cells.hpp>
#include <delone/voronoi.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <vector>

namespace delone {
namespace {

struct SiteSet {
  std::string name;
  int d;
  std::vector<double> points;
  std::size_t size() const { return points.size() / static_cast<std::size_t>(d); }
};

/// Copies of `basis`, in sixteenths of a cube, at all integer points of [0, m)³.
std::vector<double> crystal(int m, const std::vector<std::array<int, 3>>& basis) {
  std::vector<double> points;
  for (int i = 0; i < m * m * m; ++i)
    for (const auto& b : basis)
      for (int j = 0; j < 3; ++j) {
        const int at[] = {i % m, i / m % m, i / m / m};
        points.push_back(at[j] + b[static_cast<std::size_t>(j)] / 16.0);
      }
  return points;
}
const std::vector<std::array<int, 3>> simple{{0, 0, 0}}, bcc{{0, 0, 0}, {8, 8, 8}},
    fcc{{0, 0, 0}, {0, 8, 8}, {8, 0, 8}, {8, 8, 0}},
    diamond{{0, 0, 0}, {0, 8, 8}, {8, 0, 8}, {8, 8, 0}, {4, 4, 4}, {4, 12, 12}, {12, 4, 12}, {12, 12, 4}};

std::vector<SiteSet> point_sets() {
  std::vector<SiteSet> sets{{"simple", 3, crystal(4, simple)},
                            {"bcc", 3, crystal(4, bcc)},
                            {"fcc", 3, crystal(3, fcc)},
                            {"diamond", 3, crystal(3, diamond)}};
  const std::size_t sizes[] = {0, 300, 400, 250, 120, 50, 20};
  for (int d = 1; d <= 6; ++d)
    for (const char* kind : {"uniform", "clusters", "grid", "nudged_grid", "cospherical", "flat", "collinear",
                             "duplicates", "tilted_grid"}) {
      const std::string name = kind;
      if (d == 1 && (name == "flat" || name == "cospherical")) continue;
      if (d > 3 && name == "nudged_grid") continue;  // integers of many digits for most cells
      sets.push_back({kind, d, make_point_set(kind, d, sizes[d], 7)});
    }
  for (const double noise : {1e-6, 1e-9, 1e-12, 1e-15}) {
    SiteSet noisy{"noisy lattice " + std::to_string(noise), 3, crystal(5, simple)};
    std::mt19937 random(1);
    for (double& x : noisy.points) x += noise * std::uniform_real_distribution<>(-1, 1)(random);
    sets.push_back(noisy);
  }
  return sets;
}

/// Cells at the hull of nearly flat facets may be vast, and their pieces even more so; errors are relative to
/// those.
constexpr double vast = 1e6;

void expect_volumes(const SiteCells& cells, const Diagram& diagram, const std::vector<double>& volumes) {
  std::vector<int> seen(diagram.num_regions(), 0);
  for (std::size_t row = 0; row < cells.num_rows(); ++row) {
    const SignedIndex region = diagram.point_region()[row];
    if (region < 0 || seen[static_cast<std::size_t>(region)]++ > 0) {
      EXPECT_EQ(cells.volumes[row], 0) << row;
      EXPECT_EQ(cells.num_faces[row], 0) << row;
      EXPECT_TRUE(std::isnan(cells.centroids[row * static_cast<std::size_t>(cells.dimension)])) << row;
      continue;
    }
    const double expected = volumes[static_cast<std::size_t>(region)];
    if (std::isinf(expected)) {
      EXPECT_EQ(cells.volumes[row], expected) << row;
    } else if (expected < vast) {
      EXPECT_NEAR(cells.volumes[row], expected, 1e-9 * expected + 1e-13) << row;
    }
  }
}

std::vector<double> weights_for(std::size_t n, double size) {
  std::mt19937 random(5);
  std::vector<double> weights(n);
  for (double& w : weights) w = std::uniform_real_distribution<>(-size, size)(random);
  return weights;
}

/// Of regions that are bounded, those of the convex hulls of their vertices.
TEST(SiteCells, AgreeWithHullsOfRegions) {
  for (const SiteSet& set : point_sets()) {
    if (set.d < 2 || set.d > 4) continue;
    SCOPED_TRACE(set.name + " " + std::to_string(set.d));
    const Regular<> t(set.points, weights_for(set.size(), 0.02), set.d);
    if (t.affine_dimension() < set.d) continue;
    const PowerDiagram<> diagram(t);
    const SiteCells cells = site_cells(t);
    for (std::size_t row = 0; row < cells.num_rows(); row += 7) {
      const SignedIndex region = diagram.point_region()[row];
      if (region < 0 || !(cells.volumes[row] > 0 && cells.volumes[row] < vast)) continue;
      std::vector<double> corners;
      for (const SignedIndex v : diagram.region(static_cast<std::size_t>(region))) {
        const auto x = diagram.vertex(static_cast<std::size_t>(v));
        corners.insert(corners.end(), x.begin(), x.end());
      }
      const double expected = ConvexHull<>(corners, set.d).volume().value;
      EXPECT_NEAR(cells.volumes[row], expected, 1e-9 * expected + 1e-12) << row;
    }
  }
}

TEST(SiteCells, AgreeWithDiagrams) {
  for (const SiteSet& set : point_sets()) {
    SCOPED_TRACE(set.name + " " + std::to_string(set.d));
    const Delaunay<> delaunay(set.points, set.d);
    const Voronoi<> voronoi(delaunay);
    expect_volumes(site_cells(delaunay), voronoi, voronoi.region_volumes());
    const Regular<> regular(set.points, weights_for(set.size(), 0.02), set.d);
    const PowerDiagram<> power(regular);
    expect_volumes(site_cells(regular), power, power.region_volumes());
  }
}

/// Volumes do not see where the sites are: differences of their coordinates are exact.
TEST(SiteCells, FarFromTheOrigin) {
  for (const int d : {1, 2, 3, 4, 5})
    for (const bool weighted : {false, true}) {
      SCOPED_TRACE(d);
      std::vector<double> near = make_point_set("uniform", d, d < 4 ? 200 : 60, 3);
      for (double& x : near) x = std::floor(x * 0x1p20) * 0x1p-20;
      std::vector<double> far = near;
      for (double& x : far) x += 0x1p27;
      const std::vector<double> weights = weights_for(near.size() / static_cast<std::size_t>(d), 0.01);
      const auto volumes = [&](const std::vector<double>& points) {
        if (weighted) return PowerDiagram<>(Regular<>(points, weights, d)).region_volumes();
        return Voronoi<>(Delaunay<>(points, d)).region_volumes();
      };
      EXPECT_TRUE(test::are_same_bits(volumes(near), volumes(far)));
    }
}

TEST(SiteCells, FillBoxes) {
  for (const SiteSet& set : point_sets()) {
    if (set.d > 4 || set.size() > (set.d > 3 ? 60 : 150)) continue;
    SCOPED_TRACE(set.name + " " + std::to_string(set.d));
    const auto d = static_cast<std::size_t>(set.d);
    const Delaunay<> delaunay(set.points, set.d);
    const Voronoi<> voronoi(delaunay);
    const Regular<> regular(set.points, weights_for(set.size(), 0.02), set.d);
    const PowerDiagram<> power(regular);
    const Box around = voronoi.bounding_box(0.1);
    Box half = around;
    for (std::size_t j = 0; j < d; ++j) half.high[j] = (half.low[j] + half.high[j]) / 2;
    for (const Box& box : {around, half}) {
      const auto expect_filled = [&](const Triangulation& t, const Diagram& diagram) {
        const SiteCells cells = site_cells(t, {.neighbors = true, .box = box});
        expect_volumes(cells, diagram, diagram.region_volumes(box));
        double of_box = 1;
        std::vector<double> moment(d, 0.0);
        for (std::size_t j = 0; j < d; ++j) of_box *= box.high[j] - box.low[j];
        EXPECT_NEAR(std::accumulate(cells.volumes.begin(), cells.volumes.end(), 0.0), of_box, 1e-11 * of_box);
        for (std::size_t row = 0; row < cells.num_rows(); ++row)
          if (cells.volumes[row] > 0)
            for (std::size_t j = 0; j < d; ++j)
              moment[j] += cells.volumes[row] * cells.centroids[row * d + j];
        for (std::size_t j = 0; j < d; ++j)
          EXPECT_NEAR(moment[j] / of_box, (box.low[j] + box.high[j]) / 2, 1e-10 * (box.high[j] - box.low[j]));
        for (std::size_t row = 0; row < cells.num_rows(); ++row) {
          double surface = 0;
          for (auto i = static_cast<std::size_t>(cells.neighbor_offsets[row]);
               i < static_cast<std::size_t>(cells.neighbor_offsets[row + 1]); ++i)
            surface += cells.face_areas[i];
          EXPECT_NEAR(surface, cells.areas[row], 1e-12 * surface);
        }
      };
      expect_filled(delaunay, voronoi);
      expect_filled(regular, power);
    }
  }
}

/// A cube cut by planes through its middle keeps a quarter; cells that no plane cuts keep all their digits.
TEST(SiteCells, HalfspacesCut) {
  const std::vector<double> points = make_point_set("uniform", 3, 300, 2);
  const Delaunay<> t(points, 3);
  const Box box{{0, 0, 0}, {1, 1, 1}};
  const SiteCells whole = site_cells(t, {.neighbors = true, .box = box});
  const SiteCells part = site_cells(
      t,
      {.faces = CellFaces::proper, .neighbors = true, .box = box, .halfspaces = {1, 1, 0, -1, 1, -1, 0, 0}});
  EXPECT_NEAR(std::accumulate(part.volumes.begin(), part.volumes.end(), 0.0), 0.25, 1e-14);
  std::size_t same = 0;
  for (std::size_t row = 0; row < part.num_rows(); ++row) {
    EXPECT_LE(part.volumes[row], whole.volumes[row] * (1 + 1e-14));
    if (part.volumes[row] == whole.volumes[row]) ++same;
  }
  EXPECT_GT(same, 10u);
  const ClippedRegions regions =
      Voronoi<>(t).clipped_regions(box, std::vector<double>{1, 1, 0, -1, 1, -1, 0, 0});
  for (std::size_t row = 0; row < part.num_rows(); ++row)
    EXPECT_EQ(part.num_faces[row], regions.region_offsets[row + 1] - regions.region_offsets[row]);
}

/// Areas and distances of both sides of a face agree, and with the volume: V = Σ area·distance/(2k).
TEST(SiteCells, NeighborsAreMutual) {
  for (const SiteSet& set : point_sets()) {
    if (set.d < 2) continue;
    SCOPED_TRACE(set.name + " " + std::to_string(set.d));
    const Delaunay<> t(set.points, set.d);
    for (const CellFaces faces : {CellFaces::triangulated, CellFaces::proper}) {
      const SiteCells cells = site_cells(t, {.faces = faces, .neighbors = true});
      std::map<std::pair<SignedIndex, SignedIndex>, std::size_t> places;
      for (std::size_t row = 0; row < cells.num_rows(); ++row) {
        const auto first = static_cast<std::size_t>(cells.neighbor_offsets[row]),
                   last = static_cast<std::size_t>(cells.neighbor_offsets[row + 1]);
        EXPECT_EQ(last - first, static_cast<std::size_t>(cells.num_faces[row]));
        double volume = 0, size = 0;
        for (std::size_t i = first; i < last; ++i) {
          if (i > first) {
            EXPECT_LT(cells.neighbors[i - 1], cells.neighbors[i]);
          }
          places[{static_cast<SignedIndex>(row), cells.neighbors[i]}] = i;
          volume += cells.face_areas[i] * cells.distances[i] / (2 * t.affine_dimension());
          size = std::max(size, std::pow(cells.distances[i], t.affine_dimension()));
        }
        if (cells.volumes[row] < vast) {
          EXPECT_NEAR(volume, cells.volumes[row], 1e-11 * (volume + size)) << row;
        }
      }
      for (const auto& [ends, i] : places) {
        const auto other = places.find({ends.second, ends.first});
        ASSERT_NE(other, places.end());
        const std::size_t j = other->second;
        EXPECT_EQ(cells.distances[i], cells.distances[j]);
        if (std::isinf(cells.face_areas[i])) {
          EXPECT_EQ(cells.face_areas[i], cells.face_areas[j]);
        } else if (cells.volumes[static_cast<std::size_t>(ends.first)] < vast &&
                   cells.volumes[static_cast<std::size_t>(ends.second)] < vast) {
          const double size = std::pow(cells.distances[i], t.affine_dimension() - 1);
          EXPECT_NEAR(cells.face_areas[i], cells.face_areas[j], 1e-9 * (cells.face_areas[i] + size));
        }
        if (t.affine_dimension() == 3) {
          EXPECT_EQ(cells.num_edges[i], cells.num_edges[j]);
        }
      }
    }
  }
}

/// Proper faces are the ridges of the diagram.
TEST(SiteCells, ProperFacesAreRidges) {
  for (const SiteSet& set : point_sets()) {
    SCOPED_TRACE(set.name + " " + std::to_string(set.d));
    const auto expect_ridges = [](const Triangulation& t, const Diagram& diagram) {
      const SiteCells cells = site_cells(t, {.faces = CellFaces::proper, .neighbors = true});
      std::vector<std::array<SignedIndex, 2>> ridges, faces;
      std::map<std::array<SignedIndex, 2>, std::size_t> sizes;
      for (std::size_t i = 0; i < diagram.num_ridges(); ++i) {
        std::array<SignedIndex, 2> ends{diagram.ridge_points()[2 * i], diagram.ridge_points()[2 * i + 1]};
        std::sort(ends.begin(), ends.end());
        ridges.push_back(ends);
        sizes[ends] = diagram.ridge(i).size();  // with −1 if it is unbounded: as many as edges, with two rays
      }
      for (std::size_t row = 0; row < cells.num_rows(); ++row)
        for (auto i = static_cast<std::size_t>(cells.neighbor_offsets[row]);
             i < static_cast<std::size_t>(cells.neighbor_offsets[row + 1]); ++i)
          if (const auto here = static_cast<SignedIndex>(row); here < cells.neighbors[i]) {
            faces.push_back({here, cells.neighbors[i]});
            if (t.affine_dimension() == 3) {
              EXPECT_EQ(static_cast<std::size_t>(cells.num_edges[i]), sizes[faces.back()]);
            }
          }
      std::sort(ridges.begin(), ridges.end());
      std::sort(faces.begin(), faces.end());
      EXPECT_EQ(ridges, faces);
    };
    const Delaunay<> delaunay(set.points, set.d);
    expect_ridges(delaunay, Voronoi<>(delaunay));
    const Regular<> regular(set.points, std::vector<double>(set.size(), 0.5), set.d);
    expect_ridges(regular, PowerDiagram<>(regular));
  }
}

/// Vertices to the last bit, and their order around a face up to where it starts and which way it goes.
TEST(SiteCells, PolygonsAreRidges) {
  for (const SiteSet& set : point_sets()) {
    SCOPED_TRACE(set.name + " " + std::to_string(set.d));
    const auto d = static_cast<std::size_t>(set.d);
    const auto expect_ridges = [&](const Triangulation& t, const Diagram& diagram) {
      const SiteCells cells = site_cells(t, {.faces = CellFaces::proper, .vertices = true});
      using Polygon = std::vector<std::vector<double>>;  // an empty vertex is infinity
      std::map<std::array<SignedIndex, 2>, Polygon> ridges;
      const auto canonical = [&](Polygon polygon) {
        if (t.affine_dimension() != 3) {
          std::sort(polygon.begin(), polygon.end());
          return polygon;
        }
        Polygon least;
        for (int way = 0; way < 2; ++way, std::reverse(polygon.begin(), polygon.end()))
          for (std::size_t i = 0; i < polygon.size(); ++i) {
            std::rotate(polygon.begin(), polygon.begin() + 1, polygon.end());
            if (least.empty() || polygon < least) least = polygon;
          }
        return least;
      };
      for (std::size_t i = 0; i < diagram.num_ridges(); ++i) {
        Polygon polygon;
        for (const SignedIndex v : diagram.ridge(i)) {
          polygon.emplace_back();
          if (v < 0) continue;
          const auto x = diagram.vertex(static_cast<std::size_t>(v));
          polygon.back().assign(x.begin(), x.end());
        }
        std::array<SignedIndex, 2> ends{diagram.ridge_points()[2 * i], diagram.ridge_points()[2 * i + 1]};
        std::sort(ends.begin(), ends.end());
        ridges[ends] = canonical(polygon);
      }
      for (std::size_t row = 0; row < cells.num_rows(); ++row)
        for (auto i = static_cast<std::size_t>(cells.neighbor_offsets[row]);
             i < static_cast<std::size_t>(cells.neighbor_offsets[row + 1]); ++i) {
          Polygon polygon;
          for (const SignedIndex v : test::polygon(cells, i)) {
            polygon.emplace_back();
            for (std::size_t j = 0; v >= 0 && j < d; ++j)
              polygon.back().push_back(test::vertex_of(cells, row, v, j));
          }
          std::array<SignedIndex, 2> ends{static_cast<SignedIndex>(row), cells.neighbors[i]};
          std::sort(ends.begin(), ends.end());
          EXPECT_EQ(canonical(polygon), ridges[ends]) << ends[0] << ' ' << ends[1];
        }
    };
    const Delaunay<> delaunay(set.points, set.d);
    expect_ridges(delaunay, Voronoi<>(delaunay));
    const Regular<> regular(set.points, weights_for(set.size(), 0.02), set.d);
    expect_ridges(regular, PowerDiagram<>(regular));
  }
}

TEST(SiteCells, PolygonsClose) {
  for (const SiteSet& set : point_sets()) {
    SCOPED_TRACE(set.name + " " + std::to_string(set.d));
    const Delaunay<> delaunay(set.points, set.d);
    const Regular<> regular(set.points, weights_for(set.size(), 0.02), set.d);
    const std::vector<const Triangulation*> triangulations{&delaunay, &regular};
    for (const Triangulation* t : triangulations)
      for (const CellFaces faces : {CellFaces::triangulated, CellFaces::proper}) {
        const int k = t->affine_dimension();
        if (k != 2 && k != 3) continue;
        const SiteCells cells = site_cells(*t, {.faces = faces, .vertices = true});
        test::expect_closed(cells, k);
        if (k == set.d) test::expect_oriented(cells, set.points);
      }
  }
}

TEST(SiteCells, FewPointsHaveFewVertices) {
  const SiteCellsOptions options{.vertices = true};
  const SiteCells none = site_cells(Delaunay<>(std::vector<double>{}, 3), options);
  EXPECT_EQ(none.vertex_offsets, std::vector<std::int64_t>{0});
  EXPECT_EQ(none.face_vertex_offsets, std::vector<std::int64_t>{0});
  const SiteCells one = site_cells(Delaunay<>(std::vector<double>{1, 2, 3, 1, 2, 3}, 3), options);
  EXPECT_EQ(one.vertex_offsets, (std::vector<std::int64_t>{0, 0, 0}));
  const SiteCells two = site_cells(Delaunay<>(std::vector<double>{0, 0, 0, 2, 4, 6}, 3), options);
  EXPECT_EQ(two.vertices, (std::vector<double>{1, 2, 3, 1, 2, 3}));
  EXPECT_EQ(two.face_vertices, (std::vector<SignedIndex>{0, 0}));
  const SiteCells in_box = site_cells(Delaunay<>(std::vector<double>{0, 1}, 1),
                                      {.faces = CellFaces::proper, .vertices = true, .box = Box{{0.5}, {1}}});
  EXPECT_EQ(in_box.vertex_offsets, (std::vector<std::int64_t>{0, 0, 2}));
  EXPECT_EQ(in_box.vertices, (std::vector<double>{0.5, 1}));
  EXPECT_EQ(in_box.neighbors, (std::vector<SignedIndex>{-1, -1}));  // the lower wall is the bisector, too
  EXPECT_EQ(in_box.face_vertices, (std::vector<SignedIndex>{1, 0}));
}

/// The faces of the cells of crystals, and their edges.
TEST(SiteCells, CrystalsHaveTheirCells) {
  const auto faces_of_middle = [](const std::vector<std::array<int, 3>>& basis, bool clipped) {
    const int m = 5;
    const std::vector<double> points = crystal(m, basis);
    const Delaunay<3> t(points);
    SiteCellsOptions options{.faces = CellFaces::proper, .neighbors = true};
    if (clipped) options.box = Box{{2 - 1.0, 2 - 1.0, 2 - 1.0}, {2 + 1.0, 2 + 1.0, 2 + 1.0}};
    const SiteCells cells = site_cells(t, options);
    std::size_t row = 0;
    while (!(points[3 * row] == 2 && points[3 * row + 1] == 2 && points[3 * row + 2] == 2)) ++row;
    EXPECT_DOUBLE_EQ(cells.volumes[row], 1.0 / static_cast<double>(basis.size()));
    std::map<int, int> by_edges;
    for (auto i = static_cast<std::size_t>(cells.neighbor_offsets[row]);
         i < static_cast<std::size_t>(cells.neighbor_offsets[row + 1]); ++i)
      ++by_edges[cells.num_edges[i]];
    return by_edges;
  };
  using Faces = std::map<int, int>;
  for (const bool clipped : {false, true}) {
    EXPECT_EQ(faces_of_middle(simple, clipped), (Faces{{4, 6}}));
    EXPECT_EQ(faces_of_middle(bcc, clipped), (Faces{{4, 6}, {6, 8}}));
    EXPECT_EQ(faces_of_middle(fcc, clipped), (Faces{{4, 12}}));
    EXPECT_EQ(faces_of_middle(diamond, clipped), (Faces{{3, 12}, {6, 4}}));
  }
}

/// Nor on the order of insertion.
TEST(SiteCells, DoNotDependOnThreads) {
  for (const int d : {2, 3, 4}) {
    const std::vector<double> points = make_point_set("clusters", d, d == 4 ? 3000 : 20000, 4);
    const Delaunay<> one(points, d),
        four(points, d, {.seed = 7, .order = InsertionOrder::shuffled, .threads = 4});
    for (const bool in_box : {false, true}) {
      SiteCellsOptions options{
          .faces = d < 4 ? CellFaces::proper : CellFaces::triangulated, .neighbors = true, .vertices = true};
      if (in_box && d == 4) continue;
      if (in_box) options.box = Voronoi<>(one).bounding_box(0);
      const SiteCells expected = site_cells(one, options), found = site_cells(four, options, {.threads = 3});
      EXPECT_TRUE(test::are_same_bits(expected.volumes, found.volumes));
      EXPECT_TRUE(test::are_same_bits(expected.centroids, found.centroids));
      EXPECT_TRUE(test::are_same_bits(expected.areas, found.areas));
      EXPECT_TRUE(test::are_same_bits(expected.face_areas, found.face_areas));
      EXPECT_TRUE(test::are_same_bits(expected.distances, found.distances));
      EXPECT_EQ(expected.neighbors, found.neighbors);
      EXPECT_EQ(expected.num_faces, found.num_faces);
      EXPECT_EQ(expected.vertex_offsets, found.vertex_offsets);
      EXPECT_TRUE(test::are_same_bits(expected.vertices, found.vertices));
      EXPECT_EQ(expected.face_vertex_offsets, found.face_vertex_offsets);
      EXPECT_EQ(expected.face_vertices, found.face_vertices);
    }
  }
}

/// Powers of two change no digit.
TEST(SiteCells, ScaleWithThePoints) {
  for (const int d : {2, 3, 4, 5}) {
    const std::vector<double> points = make_point_set("uniform", d, 150, 9);
    const SiteCells expected = site_cells(Delaunay<>(points, d), {.neighbors = true});
    for (const int exponent : {200, -200}) {
      std::vector<double> scaled = points;
      for (double& x : scaled) x = std::ldexp(x, exponent);
      const SiteCells found = site_cells(Delaunay<>(scaled, d), {.neighbors = true});
      for (std::size_t row = 0; row < found.num_rows(); ++row)
        EXPECT_EQ(found.volumes[row], std::ldexp(expected.volumes[row], d * exponent));
      for (std::size_t i = 0; i < found.face_areas.size(); ++i) {
        EXPECT_EQ(found.face_areas[i], std::ldexp(expected.face_areas[i], (d - 1) * exponent));
        EXPECT_EQ(found.distances[i], std::ldexp(expected.distances[i], exponent));
      }
    }
  }
}

/// Lengths from 10⁻³⁰⁰ to 10³⁰⁰, and differences of coordinates beyond the range of doubles.
TEST(SiteCells, HaveNoRange) {
  const double huge = 1.7e308;
  const SiteCells cells = site_cells(Delaunay<2>(std::vector<std::array<double, 2>>{
                                         {-huge, -huge}, {huge, -huge}, {huge, huge}, {-huge, huge}, {0, 0}}),
                                     {.neighbors = true});
  EXPECT_TRUE(std::isinf(cells.volumes[4]));
  EXPECT_EQ(cells.centroids[8], 0);
  EXPECT_EQ(cells.num_faces[4], 4);
  for (const double size : {1e-300, 1e-100, 1e100, 1e300}) {
    const Delaunay<1> line(std::vector<std::array<double, 1>>{{-1}, {0}, {size}, {2 * size}, {3 * size}});
    EXPECT_DOUBLE_EQ(site_cells(line).volumes[2], size);
    EXPECT_DOUBLE_EQ(site_cells(line).centroids[2], size);
    std::vector<std::array<double, 2>> points{{-1, -1}, {1, -1}, {1, 1}, {-1, 1}};
    if (size > 1) continue;
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j) points.push_back({(i - 1) * size, (j - 1) * size});
    const SiteCells far = site_cells(Delaunay<2>(points));
    EXPECT_DOUBLE_EQ(far.areas[8], 4 * size);
  }
}

/// The cells of a lattice with sides of very different lengths, in a box with walls half a side beyond it. A
/// halfspace through opposite corners of the box takes half of it.
TEST(SiteCells, BoxesOfAnyShape) {
  for (const int d : {2, 3, 4})
    for (const int exponent : {30, 200, 480}) {
      SCOPED_TRACE(std::to_string(d) + " 2^" + std::to_string(exponent));
      std::vector<double> sides(static_cast<std::size_t>(d)), points;
      for (int j = 0; j < d; ++j)
        sides[static_cast<std::size_t>(j)] = std::ldexp(1.0, j % 2 == 0 ? exponent : -exponent);
      const int n = 1 << d;
      Box box;
      for (int j = 0; j < d; ++j) {
        box.low.push_back(-0.5 * sides[static_cast<std::size_t>(j)]);
        box.high.push_back(1.5 * sides[static_cast<std::size_t>(j)]);
      }
      for (int i = 0; i < n; ++i)
        for (int j = 0; j < d; ++j) points.push_back((i >> j & 1) * sides[static_cast<std::size_t>(j)]);
      const Delaunay<> t(points, d);
      double of_cell = 1;
      for (const double side : sides) of_cell *= side;
      const SiteCells cells = site_cells(t, {.faces = CellFaces::proper, .neighbors = true, .box = box});
      for (std::size_t row = 0; row < cells.num_rows(); ++row) {
        EXPECT_DOUBLE_EQ(cells.volumes[row], of_cell);
        EXPECT_EQ(cells.num_faces[row], 2 * d);
        double surface = 0;
        for (const double side : sides) surface += 2 * (of_cell / side);
        EXPECT_DOUBLE_EQ(cells.areas[row], surface);
        for (std::size_t j = 0; j < sides.size(); ++j)
          EXPECT_NEAR(cells.centroids[row * sides.size() + j], points[row * sides.size() + j],
                      1e-13 * sides[j]);
      }
      std::vector<double> half(sides.size() + 1, 0.0);
      half[0] = 1 / sides[0];
      half[1] = 1 / sides[1];
      half[sides.size()] = -1;
      const SiteCells cut = site_cells(t, {.neighbors = true, .box = box, .halfspaces = half});
      const double total = std::accumulate(cut.volumes.begin(), cut.volumes.end(), 0.0);
      EXPECT_NEAR(total / (of_cell * n), 0.5, 1e-12);
      EXPECT_EQ(Voronoi<>(t).region_volumes(box), cells.volumes);
    }
}

/// Also where walls lie on bisectors, and a site behind one has no cell left. In d > 3 faces are proper, too.
TEST(SiteCells, NeighborsInBoxesAreMutual) {
  for (const SiteSet& set : point_sets()) {
    if (set.d < 2 || set.d > 3 || (set.d == 3 && set.size() > 130)) continue;
    const auto d = static_cast<std::size_t>(set.d);
    SCOPED_TRACE(set.name + " " + std::to_string(set.d));
    const Delaunay<> t(set.points, set.d);
    const Regular<> regular(set.points, weights_for(set.size(), 0.02), set.d);
    Box whole = Voronoi<>(t).bounding_box(0), walls = whole;
    const double* const p = set.points.data();
    const double* const q = p + d;
    for (std::size_t j = 0; j < d; ++j) {  // for lattices often on a bisector
      const double middle = (p[j] + q[j]) / 2 + (p[j] == q[j] ? 0.5 : 0);
      if (middle > walls.low[j] && middle < walls.high[j]) walls.low[j] = middle;
      if (!(whole.low[j] < whole.high[j])) whole.high[j] = walls.high[j] = whole.low[j] + 1;
    }
    const std::vector<const Triangulation*> triangulations{&t, &regular};
    for (const Triangulation* triangulation : triangulations)
      for (const Box& box : {whole, walls}) {
        const SiteCells cells =
            site_cells(*triangulation, {.faces = CellFaces::proper, .neighbors = true, .box = box});
        std::set<std::pair<SignedIndex, SignedIndex>> pairs;
        for (std::size_t row = 0; row < cells.num_rows(); ++row)
          for (auto i = static_cast<std::size_t>(cells.neighbor_offsets[row]);
               i < static_cast<std::size_t>(cells.neighbor_offsets[row + 1]); ++i)
            if (cells.neighbors[i] >= 0) pairs.emplace(static_cast<SignedIndex>(row), cells.neighbors[i]);
        for (const auto& [a, b] : pairs) EXPECT_TRUE(pairs.contains({b, a})) << a << ' ' << b;
      }
  }
  std::vector<double> grid;
  for (int i = 0; i < 81; ++i)
    for (const int place : {i % 3, i / 3 % 3, i / 9 % 3, i / 27}) grid.push_back(place);
  const SiteCells cells = site_cells(
      Delaunay<4>(grid),
      {.faces = CellFaces::proper, .neighbors = true, .box = Box{std::vector(4, 0.5), std::vector(4, 2.5)}});
  for (std::size_t row = 0; row < 81; ++row) {
    const bool is_inside =
        std::all_of(grid.begin() + static_cast<std::ptrdiff_t>(4 * row),
                    grid.begin() + static_cast<std::ptrdiff_t>(4 * row + 4), [](double x) { return x > 0; });
    EXPECT_EQ(cells.volumes[row], is_inside ? 1 : 0);
    EXPECT_EQ(cells.num_faces[row], is_inside ? 8 : 0);
  }
}

TEST(SiteCells, FewSites) {
  const SiteCells none = site_cells(Delaunay<3>());
  EXPECT_EQ(none.num_rows(), 0u);
  const Delaunay<2> one(std::vector<std::array<double, 2>>{{1, 2}, {1, 2}});
  EXPECT_EQ(site_cells(one).volumes, (std::vector<double>{std::numeric_limits<double>::infinity(), 0}));
  const SiteCells boxed =
      site_cells(one, {.faces = CellFaces::proper, .neighbors = true, .box = Box{{0, 0}, {2, 3}}});
  EXPECT_EQ(boxed.volumes, (std::vector<double>{6, 0}));
  EXPECT_EQ(boxed.areas[0], 10);
  EXPECT_EQ(boxed.centroids[0], 1);
  EXPECT_EQ(boxed.neighbors, (std::vector<SignedIndex>{-1, -1, -1, -1}));
}

TEST(SiteCells, RefuseWhatTheyCannotDo) {
  const Delaunay<2> t(std::vector<std::array<double, 2>>{{0, 0}, {1, 0}, {0, 1}});
  const auto code = [&](const SiteCellsOptions& options) {
    return test::code_of([&] { site_cells(t, options); });
  };
  EXPECT_EQ(code({.box = Box{{0}, {1}}}), Errc::invalid_argument);
  EXPECT_EQ(code({.box = Box{{0, 0}, {1, 0}}}), Errc::invalid_argument);
  EXPECT_EQ(code({.box = Box{{0, 0}, {1, std::nan("")}}}), Errc::invalid_argument);
  EXPECT_EQ(code({.halfspaces = {1, 0, 0}}), Errc::invalid_argument);
  EXPECT_EQ(code({.box = Box{{0, 0}, {1, 1}}, .halfspaces = {1, 0}}), Errc::invalid_argument);
  EXPECT_EQ(code({.box = Box{{0, 0}, {1, 1}}, .halfspaces = {0, 0, 1}}), Errc::invalid_argument);
  EXPECT_EQ(test::code_of([&] { site_cells(FurthestSite<2>()); }), Errc::invalid_argument);
  EXPECT_EQ(test::code_of([&] { site_cells(t, {}, {.progress = [](double) { return false; }}); }),
            Errc::cancelled);
}

}  // namespace
}  // namespace delone
