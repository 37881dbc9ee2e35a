// SPDX-License-Identifier: BSD-3-Clause
// Rows with and without weights make the triangulations that Delaunay and Regular make.
#include "triangulation/row_triangulation.hpp"

#include "degenerate.hpp"

#include <gtest/gtest.h>

#include <cstddef>
#include <optional>
#include <vector>

namespace delone::triangulation {
namespace {

/// Rows of a small lattice, with ties and duplicates, and some weights.
std::vector<double> lattice_rows(std::size_t n, std::size_t d, bool weighted) {
  test::Random random(n + d);
  std::vector<double> rows;
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < d; ++j) rows.push_back(random.integer(0, 3));
    if (weighted) rows.push_back(random.integer(0, 4) / 2.0);
  }
  return rows;
}

/// The same rows in bulk, one by one, and half by half.
TEST(RowTriangulation, IsThatOfItsKind) {
  for (const std::size_t d : {1, 2, 3})
    for (const bool weighted : {false, true}) {
      const std::size_t n = 40, width = d + (weighted ? 1 : 0);
      const std::vector<double> rows = lattice_rows(n, d, weighted);
      std::vector<double> coordinates, weights;
      for (std::size_t i = 0; i < n; ++i) {
        coordinates.insert(coordinates.end(), &rows[i * width], &rows[i * width] + d);
        if (weighted) weights.push_back(rows[i * width + d]);
      }
      const auto dimension = static_cast<int>(d);
      const CanonicalHash expected = weighted ? Regular<>(coordinates, weights, dimension).hash()
                                              : Delaunay<>(coordinates, dimension).hash();

      RowTriangulation bulk(dimension, weighted, {}), single(dimension, weighted, {});
      EXPECT_EQ(bulk.get().kind(), weighted ? TriangulationKind::regular : TriangulationKind::delaunay);
      bulk.insert_rows(rows);
      for (std::size_t i = 0; i < n; ++i) {
        single.insert_row(std::span(rows).subspan(i * width, width), std::nullopt);
        EXPECT_EQ(single.get().num_rows(), i + 1);
      }
      EXPECT_EQ(bulk.get().hash(), expected);
      EXPECT_EQ(single.get().hash(), expected);
      EXPECT_EQ(bulk.get().num_rows(), n);

      RowTriangulation half(dimension, weighted, {});
      half.insert_rows({rows.begin(), rows.begin() + static_cast<std::ptrdiff_t>(n / 2 * width)});
      RowTriangulation copy = half.clone();
      copy.insert_rows({rows.begin() + static_cast<std::ptrdiff_t>(n / 2 * width), rows.end()});
      EXPECT_EQ(copy.get().hash(), expected);
      EXPECT_EQ(half.get().num_rows(), n / 2);
    }
}

}  // namespace
}  // namespace delone::triangulation
