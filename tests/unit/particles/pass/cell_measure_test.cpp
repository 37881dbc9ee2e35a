// SPDX-License-Identifier: BSD-3-Clause
// The pass of one site, from displacements alone, as sites of a periodic set have it.
#include "particles/pass/cell_measure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

namespace delone::particles {
namespace {

/// The cell of the integer lattice: neighbors ±e_j (slots 2j, 2j + 1), one cell in each orthant.
struct Orthants {
  explicit Orthants(std::size_t dimension) : d(dimension) {
    for (std::size_t cell = 0; cell < std::size_t{1} << d; ++cell)
      for (std::size_t j = 0; j < d; ++j)
        corners.push_back(static_cast<std::uint32_t>(2 * j + (cell >> j & 1)));
  }
  /// `high`: where the upper neighbors are.
  void measure(CellMeasure& measure, const std::vector<double>& site, double high = 1) const {
    measure.begin(site.data(), 2 * d);
    std::vector<std::vector<double>> to(2 * d, site);
    for (std::size_t i = 0; i < 2 * d; ++i) {
      to[i][i / 2] += i % 2 == 0 ? -1 : high;
      measure.set_neighbor(i, to[i].data());
    }
    measure.measure(corners);
  }
  std::size_t d;
  std::vector<std::uint32_t> corners;
};

TEST(CellMeasure, CellsOfTheIntegerLattice) {
  for (std::size_t d = 1; d <= 7; ++d) {
    const Orthants orthants(d);
    CellMeasure measure(d, d, false);
    orthants.measure(measure, std::vector<double>(d, 5.0));
    EXPECT_NEAR(measure.volume(), 1, 1e-15);
    for (const double area : measure.areas()) EXPECT_NEAR(area, 1, 1e-15);
    for (const double distance : measure.distances()) EXPECT_EQ(distance, 1);
    for (const double x : measure.offset()) EXPECT_NEAR(x, 0, 1e-16);
    EXPECT_EQ(measure.num_in_pairs() + measure.num_exact(), 0u);
    orthants.measure(measure, std::vector<double>(d, 5.0), 3);  // from −1/2 to 3/2
    EXPECT_NEAR(measure.volume(), std::pow(2.0, static_cast<double>(d)), 1e-13);
    for (const double x : measure.offset()) EXPECT_NEAR(x, 0.5, 1e-14);
  }
}

/// A bisector of weighted points moves by (w_0 − w)/(2·distance).
TEST(CellMeasure, Weights) {
  const Orthants orthants(3);
  CellMeasure measure(3, 3, true);
  const std::array<double, 4> site{0, 0, 0, 0.5};
  measure.begin(site.data(), 6);
  std::array<std::array<double, 4>, 6> to{};
  for (std::size_t i = 0; i < 6; ++i) {
    to[i][3] = i % 2 == 0 ? 0.5 : 0.25;
    to[i][i / 2] = i % 2 == 0 ? -1 : 1;
    measure.set_neighbor(i, to[i].data());
  }
  measure.measure(orthants.corners);
  EXPECT_NEAR(measure.volume(), 1.125 * 1.125 * 1.125, 1e-15);
  for (const double x : measure.offset()) EXPECT_NEAR(x, 0.0625, 1e-16);
}

/// A neighbor that is almost, or exactly, on a common circle has a face of almost no length.
TEST(CellMeasure, NearTies) {
  for (const double nearness : {1e-5, 1e-10, 1e-15, 1e-100}) {
    const std::vector<std::array<double, 2>> to{{1, 0}, {1, 1 + nearness}, {0, 1}, {-1, 0}, {0, -1}};
    const std::array<double, 2> site{0, 0};
    CellMeasure measure(2, 2, false);
    measure.begin(site.data(), 5);
    for (std::size_t i = 0; i < 5; ++i) measure.set_neighbor(i, to[i].data());
    measure.measure(std::vector<std::uint32_t>{0, 1, 1, 2, 2, 3, 3, 4, 0, 4});
    EXPECT_NEAR(measure.volume(), 1, nearness + 1e-15);
    EXPECT_NEAR(measure.areas()[1], 0, 2 * nearness + 1e-15);
  }
}

/// Lengths of very different sizes are for integers.
TEST(CellMeasure, WideRanges) {
  CellMeasure measure(2, 2, false);
  const std::array<double, 2> site{0, 0};
  const double small = 1e-200;
  const std::vector<std::array<double, 2>> to{{small, 0}, {0, 1}, {-small, 0}, {0, -1}};
  measure.begin(site.data(), 4);
  for (std::size_t i = 0; i < 4; ++i) measure.set_neighbor(i, to[i].data());
  measure.measure(std::vector<std::uint32_t>{0, 1, 1, 2, 2, 3, 0, 3});
  EXPECT_DOUBLE_EQ(measure.volume(), small);
  EXPECT_DOUBLE_EQ(measure.areas()[0], 1);
  EXPECT_DOUBLE_EQ(measure.areas()[1], small);
  EXPECT_EQ(measure.num_exact(), 4u);
}

/// Whatever is to be done with single cells: no bit depends on the order of the cells.
TEST(CellMeasure, CellsInAnyOrder) {
  std::mt19937 random(3);
  for (const std::size_t n : {40, 6000}) {  // more corners than one list is split for
    std::vector<std::array<double, 2>> to(n);
    for (std::size_t i = 0; i < n; ++i) {
      const double angle = 6.283185307179586 * static_cast<double>(i) / static_cast<double>(n),
                   radius = i % 3 == 0 ? 1 : 1 + 1e-9;
      to[i] = {radius * std::cos(angle), radius * std::sin(angle)};
    }
    std::vector<std::array<std::uint32_t, 2>> cells(n);
    for (std::uint32_t i = 0; i < n; ++i)
      cells[i] = {std::min(i, (i + 1) % static_cast<std::uint32_t>(n)),
                  std::max(i, (i + 1) % static_cast<std::uint32_t>(n))};
    const std::array<double, 2> site{0.1, 0.2};
    CellMeasure first(2, 2, false);
    for (int round = 0; round < 6; ++round) {
      std::vector<std::uint32_t> corners;
      for (const auto& cell : cells) corners.insert(corners.end(), cell.begin(), cell.end());
      CellMeasure measure(2, 2, false);
      for (CellMeasure* m : {&first, &measure}) {
        if (m == &first && round > 0) continue;
        m->begin(site.data(), n);
        for (std::size_t i = 0; i < n; ++i) m->set_neighbor(i, to[i].data());
        m->measure(corners);
      }
      EXPECT_EQ(measure.volume(), first.volume());
      EXPECT_TRUE(std::ranges::equal(measure.offset(), first.offset()));
      EXPECT_TRUE(std::ranges::equal(measure.areas(), first.areas()));
      EXPECT_EQ(measure.num_in_pairs(), first.num_in_pairs());
      std::shuffle(cells.begin(), cells.end(), random);
    }
    EXPECT_GT(first.volume(), 0.5);
  }
}

}  // namespace
}  // namespace delone::particles
