// SPDX-License-Identifier: BSD-3-Clause
// Periodic triangulations against those of many copies of the points, cut down to one cell of each class.
#include "periodic_sets.hpp"
#include "scale.hpp"

#include <delone/delaunay.hpp>
#include <delone/periodic.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <set>
#include <string>
#include <vector>

namespace delone {
namespace {

using Vertex = std::vector<std::int64_t>;  // a row and an offset
using Cells = std::set<std::vector<Vertex>>;

/// The cells of all translates by offsets of up to `reach` whose smallest vertex is a given point.
Cells cells_of_copies(const std::vector<double>& points, const std::vector<double>& weights,
                      const Lattice& lattice, int reach) {
  const auto d = static_cast<std::size_t>(lattice.dimension), r = static_cast<std::size_t>(lattice.rank());
  std::vector<double> all, all_weights;
  std::vector<Vertex> names;
  std::vector<std::int64_t> k(r, -reach);
  for (bool more = true; more;) {
    for (std::size_t row = 0; row < points.size() / d; ++row) {
      names.push_back({static_cast<std::int64_t>(row)});
      names.back().insert(names.back().end(), k.begin(), k.end());
      for (std::size_t j = 0; j < d; ++j) {
        double x = points[row * d + j];
        for (std::size_t i = 0; i < r; ++i) x += static_cast<double>(k[i]) * lattice.vectors[i * d + j];
        all.push_back(x);
      }
      if (!weights.empty()) all_weights.push_back(weights[row]);
    }
    more = false;
    for (std::size_t i = 0; i < r && !more; ++i) {
      more = k[i]++ < reach;
      if (!more) k[i] = -reach;
    }
  }
  Cells cells;
  const auto add = [&](const Triangulation& t) {
    for (const CellId c : t.finite_cells()) {
      std::vector<std::size_t> rows;
      for (const VertexId v : t.vertices(c)) rows.push_back(t.row_of(v));
      std::sort(rows.begin(), rows.end(), [&](std::size_t a, std::size_t b) {
        return std::lexicographical_compare(&all[a * d], &all[a * d] + d, &all[b * d], &all[b * d] + d);
      });
      std::vector<Vertex> cell;
      for (const std::size_t row : rows) cell.push_back(names[row]);
      if (!std::all_of(cell[0].begin() + 1, cell[0].end(), [](std::int64_t x) { return x == 0; })) continue;
      std::sort(cell.begin(), cell.end());
      cells.insert(cell);
    }
  };
  if (weights.empty())
    add(Delaunay<>(PointsView(all, lattice.dimension)));
  else
    add(Regular<>(PointsView(all, lattice.dimension), all_weights));
  return cells;
}

Cells cells_of(const PeriodicTriangulation& t) {
  const auto corners = static_cast<std::size_t>(t.affine_dimension() + 1),
             r = static_cast<std::size_t>(t.rank());
  Cells cells;
  for (std::size_t c = 0; c < t.num_cells(); ++c) {
    std::vector<Vertex> cell;
    for (std::size_t i = 0; i < corners; ++i) {
      cell.push_back({t.cells()[c * corners + i]});
      for (std::size_t l = 0; l < r; ++l) cell.back().push_back(t.cell_offsets()[(c * corners + i) * r + l]);
    }
    std::sort(cell.begin(), cell.end());
    EXPECT_TRUE(cells.insert(cell).second);
  }
  return cells;
}

TEST(PeriodicCopies, InSpace) {
  for (const auto& [name, box] : test::lattices_in_space())
    for (const auto& [set_name, fractions] : test::sets_in_space(test::scaled_count(64)))
      for (const int rank : {3, 2, 1}) {
        SCOPED_TRACE(std::string(name) + ", " + set_name + ", rank " + std::to_string(rank));
        const Lattice lattice = test::of_rank(box, rank);
        const auto points = test::at_fractions(fractions, box);
        // A skewed box has short vectors that are sums of many.
        const int reach = std::string(name) == "skewed" ? 8 : fractions.size() > 60 ? 2 : 3;
        if (reach == 8 && rank == 3 && fractions.size() > 12) continue;
        EXPECT_EQ(cells_of(PeriodicDelaunay<>(PointsView(points, 3), lattice)),
                  cells_of_copies(points, {}, lattice, reach));
      }
}

TEST(PeriodicCopies, WithWeights) {
  for (const auto& [name, box] : test::lattices_in_space())
    for (const int rank : {3, 2, 1})
      for (const double range : {.01, .1, 2.0}) {
        if (std::string(name) == "skewed") continue;
        SCOPED_TRACE(testing::Message() << name << ", rank " << rank << ", weights up to " << range);
        const Lattice lattice = test::of_rank(box, rank);
        const auto points = test::at_fractions(test::random_fractions(3 * 12, 6), box);
        std::vector<double> weights = test::random_fractions(12, 7);
        for (double& w : weights) w *= range;
        EXPECT_EQ(cells_of(PeriodicRegular<>(PointsView(points, 3), weights, lattice)),
                  cells_of_copies(points, weights, lattice, 3));
      }
}

TEST(PeriodicCopies, InOtherDimensions) {
  for (const int d : {1, 2, 4})
    for (int rank = 1; rank <= d; ++rank)
      for (const std::size_t n : {std::size_t{1}, std::size_t{2}, std::size_t{6}}) {
        SCOPED_TRACE(testing::Message() << n << " points, dimension " << d << ", rank " << rank);
        Lattice lattice{d, {}};
        for (int i = 0; i < rank; ++i)
          for (int j = 0; j < d; ++j) lattice.vectors.push_back(i == j ? 1 : i == j + 1 ? .25 : 0);
        auto points = test::random_fractions(n * static_cast<std::size_t>(d), 3);
        for (double& x : points) x = test::coarse(x);
        EXPECT_EQ(cells_of(PeriodicDelaunay<>(PointsView(points, d), lattice)),
                  cells_of_copies(points, {}, lattice, 2));
      }
}

}  // namespace
}  // namespace delone
