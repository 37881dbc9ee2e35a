// SPDX-License-Identifier: BSD-3-Clause
// Many hulls at once are those of single sets; flat and empty sets have their place; bad offsets are errors.
#include <delone/convex_hull.hpp>
#include <delone/convex_hulls.hpp>
#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace delone::hull {
namespace {

TEST(ConvexHulls, AreThoseOfSingleSets) {
  for (int d = 1; d <= 4; ++d) {
    const auto width = static_cast<std::size_t>(d);
    const std::vector<double> points = make_point_set("uniform", d, 200, 5);
    const std::vector<std::size_t> offsets{0, 20, 20, 21, 60, 60 + width, 200};
    const ConvexHulls hulls = convex_hulls(points, d, offsets);
    ASSERT_EQ(hulls.size(), 6u);
    EXPECT_EQ(hulls.affine_dimensions, (std::vector<int>{d, -1, 0, d, d - 1, d}));
    for (std::size_t i = 0; i < hulls.size(); ++i) {
      ConvexHull<> hull(d);
      hull.insert_range(
          std::vector<double>(points.begin() + static_cast<std::ptrdiff_t>(offsets[i] * width),
                              points.begin() + static_cast<std::ptrdiff_t>(offsets[i + 1] * width)));
      std::vector<SignedIndex> vertices(
          hulls.vertices.begin() + static_cast<std::ptrdiff_t>(hulls.vertex_offsets[i]),
          hulls.vertices.begin() + static_cast<std::ptrdiff_t>(hulls.vertex_offsets[i + 1]));
      for (SignedIndex& row : vertices) row -= static_cast<SignedIndex>(offsets[i]);
      EXPECT_EQ(vertices, hull.data().vertices);
      const std::size_t cells = hulls.cell_offsets[i + 1] - hulls.cell_offsets[i];
      if (hull.affine_dimension() < d) {
        EXPECT_EQ(cells, 0u);
        EXPECT_EQ(hulls.volumes[i], 0);
        continue;
      }
      EXPECT_EQ(cells, hull.num_cells());
      EXPECT_NEAR(hulls.volumes[i], hull.volume().value, 1e-12);
      EXPECT_NEAR(hulls.areas[i], hull.area().value, 1e-12);
      for (std::size_t c = hulls.cell_offsets[i]; c < hulls.cell_offsets[i + 1]; ++c)
        for (std::size_t j = 0; j < width; ++j) {
          const auto row = static_cast<std::size_t>(hulls.cells[c * width + j]);
          EXPECT_TRUE(offsets[i] <= row && row < offsets[i + 1]);
          double distance = hulls.equations[c * (width + 1) + width];
          for (std::size_t axis = 0; axis < width; ++axis)
            distance += hulls.equations[c * (width + 1) + axis] * points[row * width + axis];
          EXPECT_NEAR(distance, 0, 1e-12);
          const auto across = static_cast<std::size_t>(hulls.neighbors[c * width + j]);
          ASSERT_TRUE(hulls.cell_offsets[i] <= across && across < hulls.cell_offsets[i + 1]);
          const SignedIndex* const back = &hulls.neighbors[across * width];
          EXPECT_TRUE(d == 1 || std::find(back, back + d, static_cast<SignedIndex>(c)) != back + d);
        }
    }
  }
}

TEST(ConvexHulls, ThreadsShareSetsAndChangeNothing) {
  const std::vector<double> points = make_point_set("grid", 3, 1000, 5);
  std::vector<std::size_t> offsets{0};
  while (offsets.back() < 1000)
    offsets.push_back(std::min<std::size_t>(1000, offsets.back() + offsets.size() % 7));
  const ConvexHulls one = convex_hulls(points, 3, offsets),
                    many = convex_hulls(points, 3, offsets, {.threads = 3});
  EXPECT_EQ(one.affine_dimensions, many.affine_dimensions);
  EXPECT_EQ(one.vertex_offsets, many.vertex_offsets);
  EXPECT_EQ(one.vertices, many.vertices);
  EXPECT_EQ(one.cell_offsets, many.cell_offsets);
  EXPECT_EQ(one.cells, many.cells);
  EXPECT_EQ(one.neighbors, many.neighbors);
  EXPECT_EQ(one.equations, many.equations);
  EXPECT_EQ(one.volumes, many.volumes);
  EXPECT_EQ(one.areas, many.areas);
}

TEST(ConvexHulls, FlatSetsHaveTheAreaOfTheLimit) {
  const std::vector<double> square{0, 0, 5, 2, 0, 5, 2, 2, 5, 0, 2, 5, 1, 1, 5};
  const ConvexHulls hulls = convex_hulls(square, 3, std::vector<std::size_t>{0, 5});
  EXPECT_EQ(hulls.vertices, (std::vector<SignedIndex>{0, 1, 2, 3}));
  EXPECT_NEAR(hulls.areas[0], 8, 1e-12);
}

TEST(ConvexHulls, BadInputIsAnError) {
  const std::vector<double> points{0, 0, 1, 0, 0, std::nan("")}, finite{0, 0, 1, 0, 0, 1};
  const auto code = [](auto call) {
    try {
      call();
    } catch (const Error& error) {
      return error.code();
    }
    return Errc::cancelled;
  };
  using Offsets = std::vector<std::size_t>;
  EXPECT_EQ(code([&] { convex_hulls(points, 2, Offsets{0, 3}); }), Errc::not_finite);
  for (const Offsets& bad : {Offsets{}, Offsets{0}, Offsets{0, 2}, Offsets{1, 3}, Offsets{0, 2, 1, 3}})
    EXPECT_EQ(code([&] { convex_hulls(finite, 2, bad); }), Errc::invalid_argument);
  EXPECT_EQ(code([&] { convex_hulls(finite, 0, Offsets{0, 3}); }), Errc::bad_dimension);
  EXPECT_EQ(code([&] { convex_hulls(finite, 4, Offsets{0, 1}); }), Errc::bad_dimension);
  EXPECT_EQ(convex_hulls(std::vector<double>{}, 2, Offsets{0}).size(), 0u);
}

}  // namespace
}  // namespace delone::hull
