// SPDX-License-Identifier: BSD-3-Clause
// Densities of particles: against the volumes of cells in integers, and masses against integrals.
#include "error_code.hpp"
#include "same_bits.hpp"

#include <delone/delaunay.hpp>
#include <delone/density.hpp>
#include <delone/furthest_site.hpp>
#include <delone/periodic.hpp>
#include <delone/point_sets.hpp>
#include <delone/rational.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace delone {
namespace {

using Fraction = boost::multiprecision::cpp_rational;

/// |det| of an n×n matrix, by elimination.
Fraction determinant(std::vector<std::vector<Fraction>> a) {
  Fraction result = 1;
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t pivot = i;
    while (pivot < a.size() && a[pivot][i] == 0) ++pivot;
    if (pivot == a.size()) return 0;
    std::swap(a[i], a[pivot]);
    result *= a[i][i];
    for (std::size_t r = i + 1; r < a.size(); ++r) {
      const Fraction factor = a[r][i] / a[i][i];
      for (std::size_t c = i; c < a.size(); ++c) a[r][c] -= factor * a[i][c];
    }
  }
  return abs(result);
}

/// A triangulation of points that span R^d as rows and corners, whatever made it.
struct Cells {
  std::size_t d = 0;
  std::vector<std::size_t> rows;  // of each corner
  std::vector<Fraction> corners;  // d coordinates each
  std::size_t size() const { return rows.size() / (d + 1); }
  Fraction volume(std::size_t cell) const {
    std::vector<std::vector<Fraction>> edges(d, std::vector<Fraction>(d));
    const Fraction* const p = corners.data() + cell * (d + 1) * d;
    for (std::size_t i = 0; i < d; ++i)
      for (std::size_t j = 0; j < d; ++j) edges[i][j] = p[(i + 1) * d + j] - p[j];
    Fraction result = determinant(std::move(edges));
    for (std::size_t i = 2; i <= d; ++i) result /= static_cast<int>(i);
    return result;
  }
};

Cells cells_of(const ComplexData& data) {
  Cells cells;
  cells.d = static_cast<std::size_t>(data.dimension);
  for (const SignedIndex row : data.cells) {
    cells.rows.push_back(static_cast<std::size_t>(row));
    for (std::size_t j = 0; j < cells.d; ++j)
      cells.corners.emplace_back(data.points[cells.rows.back() * cells.d + j]);
  }
  return cells;
}

Cells cells_of(const PeriodicTriangulation& t) {
  Cells cells;
  cells.d = static_cast<std::size_t>(t.dimension());
  const auto r = static_cast<std::size_t>(t.rank());
  for (std::size_t i = 0; i < t.cells().size(); ++i) {
    cells.rows.push_back(static_cast<std::size_t>(t.cells()[i]));
    for (std::size_t j = 0; j < cells.d; ++j) {
      Fraction x = t.points()[cells.rows.back() * cells.d + j];
      for (std::size_t a = 0; a < r; ++a)
        x += Fraction(t.cell_offsets()[i * r + a]) * Fraction(t.lattice().vectors[a * cells.d + j]);
      cells.corners.push_back(x);
    }
  }
  return cells;
}

/// Of the vertices by their rows.
std::vector<Fraction> star_volumes_of(const Cells& cells, std::size_t n) {
  std::vector<Fraction> volumes(n, 0);
  for (std::size_t c = 0; c < cells.size(); ++c) {
    const Fraction volume = cells.volume(c);
    for (std::size_t i = 0; i <= cells.d; ++i) volumes[cells.rows[c * (cells.d + 1) + i]] += volume;
  }
  return volumes;
}

/// That of the function that is linear in each cell.
double integral(const Cells& cells, const std::vector<double>& densities) {
  Fraction sum = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) {
    Fraction mean = 0;
    for (std::size_t i = 0; i <= cells.d; ++i) mean += Fraction(densities[cells.rows[c * (cells.d + 1) + i]]);
    sum += cells.volume(c) * mean / static_cast<int>(cells.d + 1);
  }
  return static_cast<double>(sum);
}

std::vector<double> random_masses(std::size_t n) {
  std::mt19937 random(5);
  std::vector<double> masses(n);
  for (double& m : masses) m = std::uniform_real_distribution<>(0.5, 2)(random);
  return masses;
}

/// Each density is off by a few roundings.
void expect_densities(const Cells& cells, const std::vector<double>& densities,
                      const std::vector<double>& mass_at) {
  const std::vector<Fraction> volumes = star_volumes_of(cells, mass_at.size());
  for (std::size_t row = 0; row < mass_at.size(); ++row) {
    if (volumes[row] == 0) continue;  // a duplicate
    const double exact =
        static_cast<double>(Fraction(mass_at[row]) * static_cast<int>(cells.d + 1) / volumes[row]);
    EXPECT_NEAR(densities[row], exact, 4e-15 * exact) << row;
  }
}

/// The masses of all rows by the first row at their point.
template <class T>
std::vector<double> masses_at(const T& t, const std::vector<double>& masses) {
  std::vector<double> sums(masses.size(), 0.0);
  for (std::size_t row = 0; row < masses.size(); ++row) sums[t.row_of(t.vertex_at(row))] += masses[row];
  return sums;
}

TEST(Density, IsMassOverTheVolumeOfTheStar) {
  const std::size_t sizes[] = {0, 60, 300, 200, 80, 30};
  for (int d = 1; d <= 5; ++d)
    for (const char* kind :
         {"uniform", "clusters", "grid", "nudged_grid", "cospherical", "duplicates", "tilted_grid"}) {
      if (d == 1 && std::string(kind) == "cospherical") continue;
      SCOPED_TRACE(std::string(kind) + " " + std::to_string(d));
      const std::vector<double> points = make_point_set(kind, d, sizes[d], 3);
      const Delaunay<> t(points, d);
      if (t.affine_dimension() < d) continue;
      const std::vector<double> masses = random_masses(t.num_rows());
      const std::vector<double> densities = dtfe_densities(t, masses);
      const Cells cells = cells_of(t.to_data());
      expect_densities(cells, densities, masses_at(t, masses));
      const double total = std::accumulate(masses.begin(), masses.end(), 0.0);
      EXPECT_NEAR(integral(cells, densities), total, 1e-13 * total);
      // The order of insertion and threads change no bit.
      EXPECT_TRUE(test::are_same_bits(
          densities, dtfe_densities(Delaunay<>(points, d, {.seed = 9}), masses, {.threads = 3})));
    }
}

TEST(Density, OfPeriodicSetsConservesMass) {
  const double skewed[] = {1, 0, 0, 0, 0.25, 1.5, 0, 0, 0, 0.5, 1, 0, 0.25, 0, 0.125, 1};
  for (int d = 1; d <= 4; ++d)
    for (const std::size_t n : {1, 2, 5, 60})
      for (const bool is_skewed : {false, true}) {
        SCOPED_TRACE(std::to_string(n) + " in " + std::to_string(d));
        Lattice lattice{d, {}};
        for (int i = 0; i < d; ++i)
          for (int j = 0; j < d; ++j)
            lattice.vectors.push_back(is_skewed ? skewed[i * 4 + j] : i == j ? 1.0 : 0.0);
        const PeriodicDelaunay<> t(PointsView(make_point_set(n == 60 ? "grid" : "uniform", d, n, 4), d),
                                   lattice);
        const std::vector<double> masses = random_masses(n);
        std::vector<double> at(n, 0.0);
        for (std::size_t row = 0; row < n; ++row)
          at[static_cast<std::size_t>(t.vertex_of_point()[row])] += masses[row];
        const std::vector<double> densities = dtfe_densities(t, masses);
        const Cells cells = cells_of(t);
        expect_densities(cells, densities, at);
        const double total = std::accumulate(masses.begin(), masses.end(), 0.0);
        EXPECT_NEAR(integral(cells, densities), total, 1e-12 * total);
      }
}

TEST(Density, OfSlabsAndUnits) {
  const std::vector<double> points = make_point_set("uniform", 3, 100, 2);
  const int axes[] = {0, 1};
  const double sides[] = {1.0, 1.0, 1.0};
  const PeriodicDelaunay<> slab(PointsView(points, 3), Lattice::box(sides, axes));
  EXPECT_NEAR(integral(cells_of(slab), dtfe_densities(slab)), 100, 1e-11);
  std::vector<double> thousandths(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) thousandths[i] = std::round(points[i] * 1000) / 1000;
  const PeriodicDelaunay<> decimal(PointsView(thousandths, 3), Lattice::box(sides), {.unit = 0.001});
  EXPECT_NEAR(integral(cells_of(decimal), dtfe_densities(decimal)), 100, 1e-10);
}

TEST(Density, OfThinCellsIsThatOfIntegers) {
  // Three planes one ulp apart, and points far away: volumes that binary64 does not find.
  std::vector<double> points;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 4; ++j)
      for (const double z : {1.0, std::nextafter(1.0, 2.0), 1.0 + 0x1p-51})
        points.insert(points.end(), {i + 0.1 * j, j - 0.07 * i * j, z});
  for (const double scale : {1.0, 1e-90, 1e90}) {
    std::vector<double> scaled = points;
    for (double& x : scaled) x *= scale;
    const Delaunay<> t(scaled, 3);
    ASSERT_EQ(t.affine_dimension(), 3);
    expect_densities(cells_of(t.to_data()), dtfe_densities(t), std::vector<double>(t.num_rows(), 1.0));
  }
}

TEST(Density, InAFlatIsPerVolumeOfTheFlat) {
  // The unit square, in the plane z = 2x + y: areas are √6 times as large.
  const std::vector<double> points{0, 0, 0, 1, 0, 2, 0, 1, 1, 1, 1, 3, 0.5, 0.5, 1.5};
  const std::vector<double> densities = dtfe_densities(Delaunay<>(points, 3));
  EXPECT_NEAR(densities[4], 3 / std::sqrt(6.0), 1e-15);
  EXPECT_NEAR(densities[0], 6 / std::sqrt(6.0), 1e-15);
  EXPECT_EQ(dtfe_densities(Delaunay<>(std::vector<double>{1, 2, 1, 2}, 2)), (std::vector<double>{2, 2}));
  EXPECT_TRUE(dtfe_densities(Delaunay<>(std::vector<double>{}, 2)).empty());
}

TEST(Density, OfRemovedRowsIsNone) {
  Delaunay<> t(std::vector<double>{0, 0, 1, 0, 0, 1, 0.25, 0.25}, 2);
  t.remove(3);
  const std::vector<double> densities = dtfe_densities(t);
  EXPECT_EQ(densities[0], 6);
  EXPECT_TRUE(std::isnan(densities[3]));
}

TEST(Density, RefusesWhatHasNone) {
  const std::vector<double> points = make_point_set("uniform", 2, 20, 1);
  const Delaunay<> t(points, 2);
  EXPECT_EQ(test::code_of([&] { dtfe_densities(t, std::vector<double>(19, 1.0)); }), Errc::bad_dimension);
  std::vector<double> masses(20, 1.0);
  masses[7] = std::numeric_limits<double>::quiet_NaN();
  try {
    dtfe_densities(t, masses);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::not_finite);
    EXPECT_EQ(error.rows(), std::vector<std::size_t>{7});
  }
  EXPECT_EQ(test::code_of([&] { dtfe_densities(FurthestSite<>(points, 2)); }), Errc::unsupported);
  EXPECT_EQ(test::code_of([&] { dtfe_densities(Regular<>(points, std::vector<double>(20, 0.0), 2)); }),
            Errc::unsupported);
  const std::vector<double> densities = dtfe_densities(t);
  DensityGrid grid = DensityGrid::of(Box{{0, 0}, {1, 1}}, {4, 4});
  EXPECT_EQ(test::code_of([&] { density_on_grid(t, densities, grid, 0); }), Errc::invalid_argument);
  grid.shape[0] = 0;
  EXPECT_EQ(test::code_of([&] { density_on_grid(t, densities, grid); }), Errc::invalid_argument);
  grid.shape[0] = std::size_t{1} << 50;
  EXPECT_EQ(test::code_of([&] { density_on_grid(t, densities, grid); }), Errc::too_many);
  grid.shape = {4};
  EXPECT_EQ(test::code_of([&] { density_on_grid(t, densities, grid); }), Errc::invalid_argument);
  EXPECT_EQ(test::code_of([&] { DensityGrid::of(Box{{0, 0}, {1}}, {4, 4}); }), Errc::bad_dimension);
  EXPECT_EQ(test::code_of([&] { DensityGrid::of(Lattice{2, {1, 0}}, {4, 4}); }), Errc::invalid_argument);
}

TEST(DensityGrid, OfALatticeOfPointsIsConstant) {
  std::vector<double> points;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < 3; ++j) points.insert(points.end(), {i * 0.25, j * 0.5});
  const double sides[] = {1, 1.5};
  const Lattice lattice = Lattice::box(sides);
  const PeriodicDelaunay<> t(PointsView(points, 2), lattice);
  for (const double x : density_on_grid(t, dtfe_densities(t), DensityGrid::of(lattice, {5, 7}), 2))
    EXPECT_NEAR(x, 8, 1e-13);
}

TEST(DensityGrid, SumsTendToTheMass) {
  const std::vector<double> points = make_point_set("uniform", 2, 100, 6);
  const std::vector<double> sides{1, 1};
  const Lattice lattice = Lattice::box(sides);
  const PeriodicDelaunay<> t(PointsView(points, 2), lattice);
  const std::vector<double> densities = dtfe_densities(t);
  for (const auto& [parts, samples] : {std::pair<std::size_t, std::size_t>{512, 1}, {64, 8}}) {
    const std::vector<double> field =
        density_on_grid(t, densities, DensityGrid::of(lattice, {parts, parts}), samples);
    EXPECT_NEAR(std::accumulate(field.begin(), field.end(), 0.0) / static_cast<double>(parts * parts), 100,
                0.05);
  }
}

TEST(DensityGrid, HasTheLastAxisFastestAndNothingOutside) {
  // One triangle with density 6 everywhere.
  const Delaunay<> t(std::vector<double>{0, 0, 1, 0, 0, 1}, 2);
  const std::vector<double> field =
      density_on_grid(t, dtfe_densities(t), DensityGrid::of(Box{{0, 0}, {2, 1}}, {4, 2}));
  EXPECT_EQ(field, (std::vector<double>{6, 6, 6, 0, 0, 0, 0, 0}));
}

}  // namespace
}  // namespace delone
