// SPDX-License-Identifier: BSD-3-Clause
#include <delone/data.hpp>
#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

namespace delone {
namespace {

TEST(CanonicalNumbers, OfTwoTriangles) {
  ComplexData data;
  data.dimension = data.affine_dimension = 2;
  data.points = {0, 0, 1, 0, 1, 1, 0, 1};
  data.cells = {3, 0, 2, 1, 2, 0};
  data.neighbors = {1, -1, -1, 0, -1, -1};
  EXPECT_EQ(number_canonically(data), (std::vector<SignedIndex>{1, 0}));
  EXPECT_EQ(data.cells, (std::vector<SignedIndex>{0, 1, 2, 0, 2, 3}));
  EXPECT_EQ(data.neighbors, (std::vector<SignedIndex>{-1, 1, -1, -1, -1, 0}));
}

TEST(CanonicalNumbers, AreThoseOfTheSetOfCells) {
  for (int d = 1; d <= 5; ++d) {
    const std::vector<double> points = make_point_set("uniform", d, 60, 3);
    ComplexData data = Delaunay<>(points, d).to_data();
    Options options;
    options.order = InsertionOrder::as_given;
    ComplexData other = Delaunay<>(points, d, options).to_data();
    const ComplexData before = data;
    const std::vector<SignedIndex> number = number_canonically(data, 2);
    number_canonically(other);
    EXPECT_EQ(data.cells, other.cells);
    EXPECT_EQ(data.neighbors, other.neighbors);
    EXPECT_EQ(canonical_hash(data), canonical_hash(before));
    const auto size = static_cast<std::size_t>(d) + 1;
    for (std::size_t c = 0; c < before.num_cells(); ++c)
      for (std::size_t i = 0; i < size; ++i) {
        const auto n = static_cast<std::size_t>(number[c]);
        const SignedIndex row = before.cells[c * size + i], across = before.neighbors[c * size + i];
        std::size_t slot = 0;
        while (slot < size && data.cells[n * size + slot] != row) ++slot;
        ASSERT_LT(slot, size);
        EXPECT_EQ(data.neighbors[n * size + slot],
                  across < 0 ? -1 : number[static_cast<std::size_t>(across)]);
      }
  }
}

TEST(CanonicalNumbers, OfNothing) {
  ComplexData data;
  EXPECT_TRUE(number_canonically(data).empty());
  data = Delaunay<>(std::vector<double>{1, 2, 1, 2}, 2).to_data();
  EXPECT_EQ(number_canonically(data), std::vector<SignedIndex>{0});
  EXPECT_EQ(data.cells, std::vector<SignedIndex>{0});
}

}  // namespace
}  // namespace delone
