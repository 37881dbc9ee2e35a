// SPDX-License-Identifier: BSD-3-Clause
// Functions of cells are barycentric coordinates, exchanged vertex by vertex or from the start; the vertex
// that comes first in a pencil is among those that are found.
#include "geometry/hole_search/hole_search.hpp"

#include "base/random.hpp"

#include <delone/types.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace delone::geometry {
namespace {

/// Vertices in [−1/2, 1/2]^k, lifted; on a coarse grid, if that is not 0.
void fill(HoleSearch& search, int k, std::size_t n, int grid, std::uint64_t seed) {
  random::Generator random(seed);
  search.begin(k, n, n + 1);
  for (std::size_t v = 1; v <= n; ++v) {
    double lift = 0;
    for (int r = 0; r < k; ++r) {
      double x = random.uniform() - 0.5;
      if (grid > 0) x = std::floor(x * grid) / grid;
      search.row(v)[r] = x;
      lift += x * x;
    }
    search.row(v)[k] = lift;
  }
  search.arrange();
}

/// Function f at a row: of k + 2, the last one is the functional, with the lift.
double value(HoleSearch& search, const std::vector<double>& functions, int f, std::size_t v) {
  const int k = search.dimension();
  const std::size_t width = width_of_functions(k);
  const auto at = [&](int r) {
    return functions[static_cast<std::size_t>(r) * width + static_cast<std::size_t>(f)];
  };
  double sum = at(k) + (f == k + 1 ? search.row(v)[k] : 0);
  for (int r = 0; r < k; ++r) sum += at(r) * search.row(v)[r];
  return sum;
}

TEST(HoleSearch, FunctionsAreBarycentricCoordinatesAndTheFunctional) {
  for (int k = 1; k <= 9; ++k) {
    HoleSearch search;
    const auto corners = static_cast<std::size_t>(k) + 1;
    fill(search, k, corners + 3, 0, static_cast<std::uint64_t>(k));
    std::vector<Index> cell(corners);
    std::iota(cell.begin(), cell.end(), Index{1});
    std::vector<double> functions(size_of_functions(k)), replaced(functions), solved(functions);
    search.solve(cell.data(), functions.data());
    for (int turn = 0; turn < 3; ++turn) {
      for (int f = 0; f <= k; ++f)
        for (std::size_t i = 0; i < corners; ++i)
          EXPECT_NEAR(value(search, functions, f, cell[i]), static_cast<std::size_t>(f) == i ? 1 : 0, 1e-7);
      for (std::size_t i = 0; i < corners; ++i)
        EXPECT_NEAR(value(search, functions, k + 1, cell[i]), 0, 1e-7);
      const int slot = turn % (k + 1);
      const auto apex = static_cast<Index>(corners) + 1 + static_cast<Index>(turn);
      search.replace(functions.data(), slot, apex, replaced.data());
      cell[static_cast<std::size_t>(slot)] = apex;
      search.solve(cell.data(), solved.data());
      for (int f = 0; f <= k + 1; ++f)
        for (std::size_t v = 1; v <= corners + 3; ++v) {
          const double right = value(search, solved, f, v);
          EXPECT_NEAR(value(search, replaced, f, v), right, 1e-6 * (1 + std::fabs(right)));
        }
      functions = replaced;
    }
  }
}

TEST(HoleSearch, FindsTheFirstVertexBeyondAFacet) {
  for (int k = 1; k <= 8; ++k)
    for (const int grid : {0, 4})
      for (std::uint64_t seed = 0; seed < 30; ++seed) {
        HoleSearch search;
        const std::size_t corners = static_cast<std::size_t>(k) + 1, n = 40;
        fill(search, k, n, grid, seed);
        std::vector<Index> cell(corners);
        std::iota(cell.begin(), cell.end(), Index{1});
        std::vector<double> functions(size_of_functions(k));
        search.solve(cell.data(), functions.data());
        if (!std::all_of(functions.begin(), functions.end(), [](double x) { return std::fabs(x) < 100; }))
          continue;  // a flat cell
        // No candidate is below the cell, as around a vertex that goes.
        random::Generator random(seed + 100);
        for (std::size_t v = corners + 1; v <= n; ++v) {
          const double height = grid > 0 ? std::floor(1 + random.uniform() * grid) / grid : random.uniform();
          search.row(v)[k] += height - value(search, functions, k + 1, v);
        }
        search.arrange();
        for (int slot = 0; slot <= k; ++slot)
          for (const bool beyond : {true, false}) {
            // On the side of the cell, its own vertex goes: it is no candidate, but one above it is.
            const Index own = cell[static_cast<std::size_t>(slot)], leaving = n + 1;
            std::vector<Index> source = cell;
            if (!beyond) {
              std::copy_n(search.row(own), k + 1, search.row(leaving));
              search.row(own)[k] += 0.5;
              search.arrange();
              source[static_cast<std::size_t>(slot)] = leaving;
            }
            double least = INFINITY;
            std::size_t first = 0;
            for (std::size_t v = 1; v <= n; ++v) {
              if (std::find(source.begin(), source.end(), v) != source.end()) continue;
              const double distance = (beyond ? -1 : 1) * value(search, functions, slot, v);
              if (distance < 1e-9) continue;
              const double ratio = value(search, functions, k + 1, v) / distance;
              if (ratio < least) {
                least = ratio;
                first = v;
              }
            }
            // Beyond the facet, together with others.
            std::vector<int> slots{slot};
            if (beyond) slots.insert(slots.begin(), static_cast<std::size_t>(slot), (slot + 1) % (k + 1));
            search.search(functions.data(), slots, beyond, false, source.data());
            const auto found = search.found(slots.size() - 1);
            if (first != 0) {  // else there may be some that are near the facet
              EXPECT_TRUE(std::find(found.begin(), found.end(), first) != found.end())
                  << k << "D, grid " << grid << ", seed " << seed << ", slot " << slot;
              EXPECT_TRUE(grid > 0 || found.size() == 1) << found.size();
            }
            for (const auto v : found)
              EXPECT_TRUE(std::find(source.begin(), source.end(), v) == source.end());
            if (beyond) continue;
            std::copy_n(search.row(leaving), k + 1, search.row(own));
            search.arrange();
          }
      }
}

/// The unit simplex, scaled, and what it takes to search beyond its facet opposite the origin, vertex 1.
struct BeyondASimplex {
  BeyondASimplex(int k, std::size_t num_others)
      : functions(size_of_functions(k)), cell(static_cast<std::size_t>(k) + 1) {
    const std::size_t n = cell.size() + num_others;
    search.begin(k, n, n + 1);
    std::iota(cell.begin(), cell.end(), Index{1});
    for (std::size_t v = 1; v <= cell.size(); ++v)
      place(v, [&](int r) { return v == static_cast<std::size_t>(r) + 2 ? 0.25 : 0; });
    search.solve(cell.data(), functions.data());
  }
  template <class Coordinate>
  void place(std::size_t v, Coordinate&& coordinate, double height = 0) {
    double lift = height;
    for (int r = 0; r < search.dimension(); ++r) {
      search.row(v)[r] = coordinate(r);
      lift += search.row(v)[r] * search.row(v)[r];
    }
    search.row(v)[search.dimension()] = lift;
  }
  std::vector<std::uint32_t> find() {
    search.arrange();
    search.search(functions.data(), slots, true, false, cell.data());
    const auto found = search.found(0);
    return {found.begin(), found.end()};
  }

  HoleSearch search;
  std::vector<double> functions;
  std::vector<Index> cell;
  std::vector<int> slots{0};
};

TEST(HoleSearch, TellsHeightsApartThatAreEqualInFloat) {
  for (int k = 1; k <= 8; ++k) {
    BeyondASimplex beyond(k, 3);
    const auto first = static_cast<std::uint32_t>(k) + 2;
    const auto at = [](int) { return 0.3; };
    beyond.place(first, at, 0.1 + 1e-9);
    beyond.place(first + 1, at, 0.1);
    beyond.place(first + 2, at, 0.1 + 2e-9);
    EXPECT_EQ(beyond.find(), std::vector{first + 1}) << k;
    EXPECT_TRUE(beyond.search.is_certain(0));
    beyond.place(first + 2, at, 0.1);
    EXPECT_EQ(beyond.find(), (std::vector{first + 1, first + 2})) << k;
  }
}

TEST(HoleSearch, IsNotCertainOfAVertexInThePlaneOfAFacet) {
  for (int k = 1; k <= 8; ++k) {
    BeyondASimplex beyond(k, 1);
    const auto other = static_cast<std::uint32_t>(k) + 2;
    const auto in_plane = [&](int r) { return r == 0 ? 0.25 * (1 + 1.0 / 3 * (k - 1)) : -0.25 / 3; };
    for (const double off : {0.0, 1e-15, -1e-15}) {
      beyond.place(
          other, [&](int r) { return in_plane(r) + off; }, -0.1);
      EXPECT_TRUE(beyond.find().empty() || !beyond.search.is_certain(0)) << k << ", " << off;
    }
    beyond.place(
        other, [&](int r) { return in_plane(r) + 1e-9; }, -0.1);
    EXPECT_EQ(beyond.find(), std::vector{other}) << k;
    EXPECT_TRUE(beyond.search.is_certain(0));
    beyond.place(
        other, [&](int r) { return in_plane(r) - 1e-9; }, -0.1);
    EXPECT_TRUE(beyond.find().empty()) << k;
  }
}

TEST(HoleSearch, FindsVerticesWhoseLiftsAreTooLargeForFloat) {
  for (int k = 1; k <= 8; ++k)
    for (const double scale : {1e30, 1e60, 1e300}) {
      BeyondASimplex beyond(k, 20);
      const auto first = static_cast<std::uint32_t>(k) + 2;
      for (std::uint32_t v = first; v < first + 20; ++v)
        beyond.place(
            v, [](int) { return 0.3; }, scale * (1 + (v + 7) % 20));
      const std::vector<std::uint32_t> found = beyond.find();
      ASSERT_EQ(found.size(), 1u) << k << ", " << scale;
      EXPECT_EQ((found[0] + 7) % 20, 0u) << k << ", " << scale;
    }
}

}  // namespace
}  // namespace delone::geometry
