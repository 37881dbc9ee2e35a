// SPDX-License-Identifier: BSD-3-Clause
// Cells of the points of periodic sets against those of many copies of the points, and against what must hold
// whatever stands for the set.
#include "cell_polygons.hpp"
#include "error_code.hpp"
#include "periodic_sets.hpp"
#include "same_bits.hpp"

#include <delone/delaunay.hpp>
#include <delone/periodic.hpp>
#include <delone/regular.hpp>
#include <delone/site_cells.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <numeric>
#include <random>
#include <string>
#include <vector>

namespace delone {
namespace {

using test::at_fractions;
using test::code_of;
using test::random_fractions;

SiteCells periodic_cells(const std::vector<double>& points, const std::vector<double>& weights,
                         const Lattice& lattice, const SiteCellsOptions& options,
                         const PeriodicOptions& how = {}) {
  const PointsView view(points, lattice.dimension);
  if (!weights.empty()) return site_cells(PeriodicRegular<>(view, weights, lattice, how), options);
  return site_cells(PeriodicDelaunay<>(view, lattice, how), options);
}

/// The absolute value of the determinant of as many vectors as dimensions.
double volume_of_box(const Lattice& lattice) {
  const auto d = static_cast<std::size_t>(lattice.dimension);
  std::vector<double> rows = lattice.vectors;
  double volume = 1;
  for (std::size_t i = 0; i < d; ++i) {
    std::size_t pivot = i;
    for (std::size_t l = i + 1; l < d; ++l)
      if (std::abs(rows[l * d + i]) > std::abs(rows[pivot * d + i])) pivot = l;
    for (std::size_t j = 0; j < d; ++j) std::swap(rows[i * d + j], rows[pivot * d + j]);
    volume *= std::abs(rows[i * d + i]);
    for (std::size_t l = i + 1; l < d; ++l)
      for (std::size_t j = d; j-- > i;)
        rows[l * d + j] -= rows[l * d + i] / rows[i * d + i] * rows[i * d + j];
  }
  return volume;
}

double sum_of(const std::vector<double>& volumes) {
  return std::accumulate(volumes.begin(), volumes.end(), 0.0);
}

/// The cells of the points among their translates by offsets of up to `reach`, with translates as neighbors.
SiteCells cells_among_copies(const std::vector<double>& points, const std::vector<double>& weights,
                             const Lattice& lattice, const SiteCellsOptions& options, int reach) {
  const auto d = static_cast<std::size_t>(lattice.dimension), r = static_cast<std::size_t>(lattice.rank()),
             n = points.size() / d;
  std::vector<double> all = points, all_weights = weights;
  std::vector<std::int32_t> offsets(n * r, 0), k(r, -reach);
  for (bool more = r > 0; more;) {
    if (std::any_of(k.begin(), k.end(), [](int x) { return x != 0; })) {
      for (std::size_t row = 0; row < n; ++row) {
        offsets.insert(offsets.end(), k.begin(), k.end());
        for (std::size_t j = 0; j < d; ++j) {
          double x = points[row * d + j];
          for (std::size_t i = 0; i < r; ++i) x += k[i] * lattice.vectors[i * d + j];
          all.push_back(x);
        }
      }
      all_weights.insert(all_weights.end(), weights.begin(), weights.end());
    }
    more = false;
    for (std::size_t i = 0; i < r && !more; ++i) {
      more = k[i]++ < reach;
      if (!more) k[i] = -reach;
    }
  }
  const SiteCells of_all = weights.empty()
                               ? site_cells(Delaunay<>(all, lattice.dimension), options)
                               : site_cells(Regular<>(all, all_weights, lattice.dimension), options);
  SiteCells cells = of_all;
  cells.rank = lattice.rank();
  cells.volumes.resize(n);
  cells.centroids.resize(n * d);
  cells.areas.resize(n);
  cells.num_faces.resize(n);
  cells.neighbor_offsets.resize(n + 1);
  for (std::size_t row = 0; row < n; ++row) {
    const auto first = static_cast<std::size_t>(cells.neighbor_offsets[row]),
               last = static_cast<std::size_t>(cells.neighbor_offsets[row + 1]);
    std::vector<std::size_t> order(last - first);
    std::iota(order.begin(), order.end(), first);
    const auto name = [&](std::size_t i) {
      const auto copy = static_cast<std::size_t>(of_all.neighbors[i]);
      std::vector<std::int64_t> of_copy{static_cast<std::int64_t>(copy % n)};
      const auto of_offset = offsets.begin() + static_cast<std::ptrdiff_t>(copy * r);
      of_copy.insert(of_copy.end(), of_offset, of_offset + static_cast<std::ptrdiff_t>(r));
      return of_copy;
    };
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return name(a) < name(b); });
    for (std::size_t i = first; i < last; ++i) {
      const std::size_t from = order[i - first];
      cells.neighbors[i] = static_cast<SignedIndex>(name(from)[0]);
      for (std::size_t l = 1; l <= r; ++l)
        cells.neighbor_lattice.push_back(static_cast<std::int32_t>(name(from)[l]));
      cells.face_areas[i] = of_all.face_areas[from];
      cells.distances[i] = of_all.distances[from];
      if (!cells.num_edges.empty()) cells.num_edges[i] = of_all.num_edges[from];
    }
  }
  const auto size = static_cast<std::size_t>(cells.neighbor_offsets[n]);
  cells.neighbors.resize(size);
  cells.face_areas.resize(size);
  cells.distances.resize(size);
  if (!cells.num_edges.empty()) cells.num_edges.resize(size);
  return cells;
}

/// Numbers that are both NaN, both infinite, or near.
void expect_near(const std::vector<double>& found, const std::vector<double>& expected, double tolerance) {
  ASSERT_EQ(found.size(), expected.size());
  for (std::size_t i = 0; i < found.size(); ++i) {
    if (std::isnan(expected[i])) {
      EXPECT_TRUE(std::isnan(found[i])) << i << ": " << found[i];
    } else if (std::isinf(expected[i])) {
      EXPECT_EQ(found[i], expected[i]) << i;
    } else {
      EXPECT_NEAR(found[i], expected[i], tolerance * std::max(1.0, std::abs(expected[i]))) << i;
    }
  }
}

void expect_same(const SiteCells& found, const SiteCells& expected) {
  EXPECT_EQ(found.dimension, expected.dimension);
  EXPECT_EQ(found.rank, expected.rank);
  expect_near(found.volumes, expected.volumes, 1e-12);
  expect_near(found.areas, expected.areas, 1e-11);
  EXPECT_EQ(found.num_faces, expected.num_faces);
  EXPECT_EQ(found.neighbor_offsets, expected.neighbor_offsets);
  EXPECT_EQ(found.neighbors, expected.neighbors);
  EXPECT_EQ(found.neighbor_lattice, expected.neighbor_lattice);
  EXPECT_EQ(found.num_edges, expected.num_edges);
  expect_near(found.face_areas, expected.face_areas, 1e-11);
  expect_near(found.distances, expected.distances, 1e-15);
  ASSERT_EQ(found.centroids.size(), expected.centroids.size());
  // A centroid is as good as the volume is.
  const auto d = static_cast<std::size_t>(found.dimension);
  for (std::size_t i = 0; i < found.centroids.size(); ++i)
    if (std::isnan(expected.centroids[i]) || !(expected.volumes[i / d] > 1e-6)) {
      EXPECT_EQ(std::isnan(found.centroids[i]), std::isnan(expected.centroids[i])) << i;
    } else {
      EXPECT_NEAR(found.centroids[i], expected.centroids[i], 1e-9) << i;
    }
}

/// Cells among more copies are smaller, and as large as the box together when there are enough of them. One
/// more layer has the points that are on the same empty spheres.
void expect_cells_among_copies(const std::vector<double>& points, const std::vector<double>& weights,
                               const Lattice& lattice) {
  const double of_box = volume_of_box(lattice);
  int reach = 1;
  for (const int most = lattice.dimension > 3 ? 2 : 7; reach < most; ++reach) {
    const double sum = sum_of(cells_among_copies(points, weights, lattice, {}, reach).volumes);
    if (std::abs(sum - of_box) < 1e-9 * of_box) break;
  }
  for (const CellFaces faces : {CellFaces::triangulated, CellFaces::proper}) {
    const SiteCellsOptions options{.faces = faces, .neighbors = true};
    const SiteCells found = periodic_cells(points, weights, lattice, options);
    EXPECT_NEAR(sum_of(found.volumes), of_box, 1e-12 * of_box);
    expect_same(found, cells_among_copies(points, weights, lattice, options, reach + 1));
  }
}

std::vector<double> random_weights(std::size_t n, double size) {
  std::vector<double> weights = random_fractions(n, 23);
  for (double& w : weights) w *= size;
  return weights;
}

TEST(PeriodicCells, AgreeWithCellsAmongCopies) {
  for (const auto& [name, box] : test::lattices_in_space())
    for (const auto& [set_name, fractions] : test::sets_in_space(8)) {
      SCOPED_TRACE(std::string(name) + ", " + set_name);
      const std::vector<double> points = at_fractions(fractions, box);
      expect_cells_among_copies(points, {}, box);
      if (fractions.size() < 12)
        expect_cells_among_copies(points, random_weights(points.size() / 3, 0.1), box);
    }
}

TEST(PeriodicCells, OtherDimensions) {
  const std::vector<Lattice> lattices{{1, {2}},
                                      {2, {1, 0, 0, 1}},
                                      {2, {1, .25, -.5, 1}},
                                      {2, {.5, 2, 1, 1}},
                                      {4, {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1}}};
  for (const Lattice& lattice : lattices)
    for (const std::size_t n : {std::size_t{1}, std::size_t{2}, std::size_t{5}, std::size_t{40}}) {
      const int d = lattice.dimension;
      if (d == 4 && n > 2) continue;
      SCOPED_TRACE(testing::Message() << n << " points in dimension " << d);
      const auto points = at_fractions(random_fractions(n * static_cast<std::size_t>(d), 11), lattice);
      expect_cells_among_copies(points, {}, lattice);
      if (d < 4) expect_cells_among_copies(points, random_weights(n, 0.2), lattice);
    }
}

/// Cells across the border are whole.
TEST(PeriodicCells, PolygonsClose) {
  for (const auto& [name, box] : test::lattices_in_space())
    for (const int rank : {3, 2}) {
      SCOPED_TRACE(testing::Message() << name << ", rank " << rank);
      const Lattice lattice = test::of_rank(box, rank);
      for (const auto& [set_name, fractions] : test::sets_in_space(8)) {
        SCOPED_TRACE(set_name);
        std::vector<double> points = at_fractions(fractions, box);
        for (std::size_t i = 0; i < points.size(); ++i)  // outside of the box
          points[i] += 2 * lattice.vectors[i % 3] * (i / 3 % 2 == 0 ? 1 : 0);
        for (const auto& weights : {std::vector<double>{}, random_weights(points.size() / 3, 0.1)})
          for (const CellFaces faces : {CellFaces::triangulated, CellFaces::proper}) {
            const SiteCells cells =
                periodic_cells(points, weights, lattice, {.faces = faces, .vertices = true});
            if (cells.num_edges.empty()) continue;  // all in a plane
            test::expect_closed(cells, 3);
            test::expect_oriented(cells, points, lattice.vectors);
          }
      }
    }
}

/// Cells at the hull are unbounded, others as among copies.
TEST(PeriodicCells, SlabsAndWires) {
  for (const auto& [name, box] : test::lattices_in_space())
    for (const int rank : {2, 1, 0}) {
      if (std::string(name) == "oblong" || std::string(name) == "skewed") continue;
      SCOPED_TRACE(testing::Message() << name << ", rank " << rank);
      const std::vector<double> points = at_fractions(random_fractions(3 * 12, 31), box);
      const Lattice lattice = test::of_rank(box, rank);
      for (const CellFaces faces : {CellFaces::triangulated, CellFaces::proper}) {
        const SiteCellsOptions options{.faces = faces, .neighbors = true};
        for (const auto& weights : {std::vector<double>{}, random_weights(12, 0.02)}) {
          const SiteCells found = periodic_cells(points, weights, lattice, options);
          EXPECT_TRUE(std::isinf(*std::max_element(found.volumes.begin(), found.volumes.end())));
          const SiteCells expected =
              cells_among_copies(points, weights, lattice, options, rank == 1 ? 12 : 5);
          EXPECT_EQ(found.neighbors, expected.neighbors);
          EXPECT_EQ(found.neighbor_lattice, expected.neighbor_lattice);
          EXPECT_EQ(found.num_edges, expected.num_edges);
          for (std::size_t row = 0; row < found.num_rows(); ++row) {
            EXPECT_EQ(std::isinf(found.volumes[row]), std::isinf(expected.volumes[row])) << row;
            if (expected.volumes[row] < 10) {
              EXPECT_NEAR(found.volumes[row], expected.volumes[row], 1e-11);
            }
          }
        }
      }
    }
}

/// Points and lattice in a plane: cells are those inside of it.
TEST(PeriodicCells, InsideFlats) {
  const Lattice lattice{3, {1, 0, 0, .25, 2, 0}};
  std::vector<double> points = at_fractions(random_fractions(3 * 20, 2), lattice);
  for (std::size_t row = 0; row < 20; ++row) points[3 * row + 2] = .5;
  const SiteCells cells = periodic_cells(points, {}, lattice, {.neighbors = true});
  EXPECT_NEAR(sum_of(cells.volumes), 2, 1e-12);
  for (std::size_t row = 0; row < 20; ++row) EXPECT_EQ(cells.centroids[3 * row + 2], .5);
  EXPECT_TRUE(cells.num_edges.empty());
}

/// Other translates of the points are other rows of offsets.
TEST(PeriodicCells, BelongToThePointsAsTheyWereGiven) {
  std::mt19937 random(4);
  for (const auto& [name, box] : test::lattices_in_space())
    for (const int rank : {3, 2})
      for (const std::size_t n : {std::size_t{2}, std::size_t{50}}) {
        SCOPED_TRACE(testing::Message() << name << ", rank " << rank << ", " << n << " points");
        const Lattice lattice = test::of_rank(box, rank);
        const auto r = static_cast<std::size_t>(rank);
        const std::vector<double> points = at_fractions(random_fractions(3 * n, 8), box);
        std::vector<double> others = points, steps(3 * n, 0.0);
        std::vector<std::int32_t> moved(n * r);
        for (std::size_t row = 0; row < n; ++row)
          for (std::size_t l = 0; l < r; ++l) {
            moved[row * r + l] = static_cast<std::int32_t>(random() % 7) - 3;
            for (std::size_t j = 0; j < 3; ++j)
              steps[3 * row + j] += moved[row * r + l] * lattice.vectors[3 * l + j];
          }
        for (std::size_t i = 0; i < others.size(); ++i) others[i] += steps[i];
        const SiteCells found = periodic_cells(others, {}, lattice, {.neighbors = true});
        SiteCells expected = periodic_cells(points, {}, lattice, {.neighbors = true});
        for (std::size_t i = 0; i < steps.size(); ++i) expected.centroids[i] += steps[i];
        for (std::size_t row = 0; row < n; ++row)
          for (auto i = static_cast<std::size_t>(expected.neighbor_offsets[row]);
               i < static_cast<std::size_t>(expected.neighbor_offsets[row + 1]); ++i)
            for (std::size_t l = 0; l < r; ++l)
              expected.neighbor_lattice[i * r + l] +=
                  moved[row * r + l] - moved[static_cast<std::size_t>(expected.neighbors[i]) * r + l];
        EXPECT_EQ(found.neighbors, expected.neighbors);
        EXPECT_EQ(found.neighbor_lattice, expected.neighbor_lattice);
        expect_near(found.distances, expected.distances, 1e-15);
        for (std::size_t i = 0; i < steps.size(); ++i)
          if (expected.volumes[i / 3] < 10) {
            EXPECT_NEAR(found.centroids[i], expected.centroids[i], 1e-11);
          }
      }
}

/// A neighbor is where its row and translation say; and the cell is one of its neighbors.
TEST(PeriodicCells, NeighborsAreMutual) {
  const Lattice lattice = test::lattices_in_space()[3].lattice;
  const std::size_t n = 30;
  const std::vector<double> points = at_fractions(random_fractions(3 * n, 3), lattice);
  const SiteCells cells = periodic_cells(points, {}, lattice, {.neighbors = true});
  std::map<std::vector<std::int64_t>, double> areas;
  for (std::size_t row = 0; row < n; ++row) {
    double surface = 0;
    for (auto i = static_cast<std::size_t>(cells.neighbor_offsets[row]);
         i < static_cast<std::size_t>(cells.neighbor_offsets[row + 1]); ++i) {
      const auto other = static_cast<std::size_t>(cells.neighbors[i]);
      const std::int32_t* const k = &cells.neighbor_lattice[3 * i];
      double squared = 0;
      for (std::size_t j = 0; j < 3; ++j) {
        double x = points[3 * other + j] - points[3 * row + j];
        for (std::size_t l = 0; l < 3; ++l) x += k[l] * lattice.vectors[3 * l + j];
        squared += x * x;
      }
      EXPECT_NEAR(cells.distances[i], std::sqrt(squared), 1e-14);
      surface += cells.face_areas[i];
      areas[{static_cast<std::int64_t>(row), cells.neighbors[i], k[0], k[1], k[2]}] = cells.face_areas[i];
    }
    EXPECT_NEAR(surface, cells.areas[row], 1e-13);
  }
  EXPECT_EQ(areas.size(), cells.neighbors.size());
  for (const auto& [key, area] : areas) {
    const auto back = areas.find({key[1], key[0], -key[2], -key[3], -key[4]});
    ASSERT_NE(back, areas.end());
    EXPECT_NEAR(area, back->second, 1e-13);
  }
}

TEST(PeriodicCells, CrystalsHaveTheirCells) {
  using Faces = std::map<int, int>;
  const std::pair<test::Crystal, Faces> crystals[] = {{test::Crystal::simple, {{4, 6}}},
                                                      {test::Crystal::bcc, {{4, 6}, {6, 8}}},
                                                      {test::Crystal::fcc, {{4, 12}}},
                                                      {test::Crystal::diamond, {{3, 12}, {6, 4}}}};
  const Lattice cube = test::lattices_in_space()[0].lattice;
  for (const auto& [crystal, faces] : crystals)
    for (const int m : {1, 2, 4}) {
      const std::vector<double> points = at_fractions(test::crystal_fractions(crystal, m), cube);
      const std::size_t n = points.size() / 3;
      SCOPED_TRACE(testing::Message() << n << " points");
      const SiteCells cells =
          periodic_cells(points, {}, cube, {.faces = CellFaces::proper, .neighbors = true});
      for (std::size_t row = 0; row < n; ++row) {
        EXPECT_DOUBLE_EQ(cells.volumes[row] * static_cast<double>(n), 1);
        Faces found;
        for (auto i = static_cast<std::size_t>(cells.neighbor_offsets[row]);
             i < static_cast<std::size_t>(cells.neighbor_offsets[row + 1]); ++i)
          ++found[cells.num_edges[i]];
        EXPECT_EQ(found, faces);
      }
    }
  // One point is its own neighbor on all sides.
  const SiteCells cells =
      periodic_cells({.25, .5, .75}, {}, cube, {.faces = CellFaces::proper, .neighbors = true});
  EXPECT_EQ(cells.neighbors, std::vector<SignedIndex>(6, 0));
  EXPECT_EQ(cells.neighbor_lattice,
            (std::vector<std::int32_t>{-1, 0, 0, 0, -1, 0, 0, 0, -1, 0, 0, 1, 0, 1, 0, 1, 0, 0}));
  EXPECT_EQ(cells.face_areas, std::vector<double>(6, 1.0));
}

/// Hidden points and translates of earlier points have no cell.
TEST(PeriodicCells, RowsWithoutCells) {
  const Lattice lattice = test::lattices_in_space()[2].lattice;
  std::vector<double> points = at_fractions(random_fractions(3 * 40, 6), lattice);
  for (std::size_t j = 0; j < 3; ++j) points.push_back(points[3 * 7 + j] + 2 * lattice.vectors[3 + j]);
  const auto expect_cells_of_vertices = [&](const PeriodicTriangulation& t) {
    const SiteCells cells = site_cells(t, {.neighbors = true});
    std::size_t without = 0;
    for (std::size_t row = 0; row < 41; ++row) {
      const bool has_cell = t.vertex_of_point()[row] == static_cast<SignedIndex>(row);
      without += has_cell ? 0 : 1;
      EXPECT_EQ(cells.volumes[row] > 0, has_cell) << row;
      EXPECT_EQ(cells.num_faces[row] > 0, has_cell) << row;
      EXPECT_EQ(std::isnan(cells.centroids[3 * row]), !has_cell) << row;
    }
    EXPECT_EQ(without, t.num_hidden() + t.num_duplicates());
    EXPECT_NEAR(sum_of(cells.volumes), volume_of_box(lattice), 1e-12);
    return without;
  };
  EXPECT_EQ(expect_cells_of_vertices(PeriodicDelaunay<>(PointsView(points, 3), lattice)), 1u);
  std::vector<double> weights = random_weights(41, 0.2);
  EXPECT_GT(expect_cells_of_vertices(PeriodicRegular<>(PointsView(points, 3), weights, lattice)), 2u);
  weights[40] = 0.5;  // heavier than row 7 at a translate of it
  const PeriodicRegular<> t(PointsView(points, 3), weights, lattice);
  expect_cells_of_vertices(t);
  EXPECT_EQ(t.vertex_of_point()[40], 40);
}

TEST(PeriodicCells, DoNotDependOnThreads) {
  for (const bool is_crystal : {false, true})
    for (const int rank : {3, 2}) {
      const Lattice box = test::lattices_in_space()[2].lattice, lattice = test::of_rank(box, rank);
      const std::vector<double> points = at_fractions(
          is_crystal ? test::crystal_fractions(test::Crystal::fcc, 8) : random_fractions(3 * 5000, 9), box);
      const SiteCellsOptions options{.faces = is_crystal ? CellFaces::proper : CellFaces::triangulated,
                                     .neighbors = true};
      const SiteCells expected =
          site_cells(PeriodicDelaunay<>(PointsView(points, 3), lattice, {}, {.threads = 1}), options);
      for (const unsigned threads : {2u, 4u}) {
        const SiteCells found =
            site_cells(PeriodicDelaunay<>(PointsView(points, 3), lattice, {}, {.threads = threads}), options,
                       {.threads = threads});
        EXPECT_TRUE(test::are_same_bits(found.volumes, expected.volumes));
        EXPECT_TRUE(test::are_same_bits(found.centroids, expected.centroids));
        EXPECT_TRUE(test::are_same_bits(found.areas, expected.areas));
        EXPECT_TRUE(test::are_same_bits(found.face_areas, expected.face_areas));
        EXPECT_TRUE(test::are_same_bits(found.distances, expected.distances));
        EXPECT_EQ(found.neighbors, expected.neighbors);
        EXPECT_EQ(found.neighbor_lattice, expected.neighbor_lattice);
        EXPECT_EQ(found.num_edges, expected.num_edges);
      }
    }
}

/// Lengths are those of the caller: of decimals, and far from 1.
TEST(PeriodicCells, UnitsAndScales) {
  std::vector<double> decimals;
  for (int i = 0; i < 27; ++i)
    for (const int step : {i % 3, i / 3 % 3, i / 9}) decimals.push_back(0.1 * step + 3);
  const Lattice tenths{3, {0.3, 0, 0, 0, 0.3, 0, 0, 0, 0.3}};
  const SiteCells of_tenths = periodic_cells(
      decimals, {}, tenths, {.faces = CellFaces::proper, .neighbors = true}, {.exact = true, .unit = 0.1});
  EXPECT_EQ(of_tenths.neighbors.size(), 27u * 6);
  for (std::size_t row = 0; row < 27; ++row) {
    EXPECT_NEAR(of_tenths.volumes[row], 1e-3, 1e-17);
    EXPECT_NEAR(of_tenths.areas[row], 0.06, 1e-16);
    EXPECT_NEAR(of_tenths.centroids[3 * row], decimals[3 * row], 1e-15);
  }
  expect_near(of_tenths.distances, std::vector<double>(27 * 6, 0.1), 1e-16);
  expect_near(of_tenths.face_areas, std::vector<double>(27 * 6, 0.01), 1e-17);

  const Lattice lattice = test::lattices_in_space()[3].lattice;
  const std::vector<double> points = at_fractions(random_fractions(3 * 20, 5), lattice),
                            weights = random_weights(20, 0.05);
  const SiteCells expected = periodic_cells(points, weights, lattice, {.neighbors = true});
  for (const int exponent : {300, -300}) {
    std::vector<double> far = points, far_weights = weights;
    Lattice far_lattice = lattice;
    for (double& x : far) x = std::ldexp(x, exponent);
    for (double& x : far_weights) x = std::ldexp(x, 2 * exponent);
    for (double& x : far_lattice.vectors) x = std::ldexp(x, exponent);
    const SiteCells found = periodic_cells(far, far_weights, far_lattice, {.neighbors = true});
    EXPECT_EQ(found.neighbor_lattice, expected.neighbor_lattice);
    for (std::size_t row = 0; row < 20; ++row)
      EXPECT_NEAR(std::ldexp(found.volumes[row], -3 * exponent), expected.volumes[row], 1e-13);
    for (std::size_t i = 0; i < found.distances.size(); ++i) {
      EXPECT_DOUBLE_EQ(std::ldexp(found.distances[i], -exponent), expected.distances[i]);
      EXPECT_NEAR(std::ldexp(found.face_areas[i], -2 * exponent), expected.face_areas[i], 1e-12);
    }
  }
}

TEST(PeriodicCells, NoneAndOneAndRefusals) {
  const Lattice cube = test::lattices_in_space()[0].lattice;
  const SiteCells none = periodic_cells({}, {}, cube, {.neighbors = true});
  EXPECT_EQ(none.num_rows(), 0u);
  EXPECT_EQ(none.rank, 3);
  EXPECT_EQ(none.neighbor_offsets, std::vector<std::int64_t>{0});
  const SiteCells lone = periodic_cells({1, 2, 3, 1, 2, 3}, {}, Lattice{3, {}}, {.neighbors = true});
  EXPECT_TRUE(std::isinf(lone.volumes[0]));
  EXPECT_EQ(lone.volumes[1], 0);
  const PeriodicDelaunay<> t(PointsView(std::vector<double>{0, 0, 0}, 3), cube);
  EXPECT_EQ(code_of([&] { site_cells(t, {.box = Box{{0, 0, 0}, {1, 1, 1}}}); }), Errc::unsupported);
  EXPECT_EQ(code_of([&] { site_cells(t, {.halfspaces = {1, 0, 0, 0}}); }), Errc::invalid_argument);
}

}  // namespace
}  // namespace delone
