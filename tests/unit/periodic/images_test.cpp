// SPDX-License-Identifier: BSD-3-Clause
// Shifts and their numbers; which images are known, against all that there are.
#include "periodic/images.hpp"

#include "degenerate.hpp"
#include "made_set.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace delone::periodic {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

using Named = std::set<std::pair<std::uint32_t, std::vector<std::int32_t>>>;  // rows and translations

Named named(const Images& images, const std::vector<Image>& some) {
  Named names;
  for (const Image& image : some) {
    EXPECT_TRUE(names.emplace(image.row, images.shift(image.shift).k).second) << "an image is there once";
    EXPECT_NE(image.shift, 0u) << "points of the set are no images";
  }
  return names;
}

/// What the shifts say that they know.
Named known(Images& images) {
  Named names;
  for (std::uint32_t number = 0; number < images.num_shifts(); ++number)
    for (std::uint32_t page = 0; page < images.table().num_pages(); ++page)
      for (std::uint32_t slot = 0; slot < images.table().page_size(page); ++slot)
        if (images.shift(number).known.contains(page, slot))
          names.emplace(images.image_at(number, {page, slot}).row, images.shift(number).k);
  return names;
}

TEST(NextInRange, CountsFromTheLowestToTheHighest) {
  std::vector<std::int32_t> k{-1, 3};
  const std::vector<std::int32_t> low{-1, 3}, high{0, 4};
  std::vector<std::vector<std::int32_t>> all;
  do all.push_back(k);
  while (next_in_range(k, low, high));
  EXPECT_THAT(all, ElementsAre(ElementsAre(-1, 3), ElementsAre(0, 3), ElementsAre(-1, 4), ElementsAre(0, 4)));
  EXPECT_EQ(k, low);
}

TEST(Images, ShiftsAreMadeOnce) {
  const PeriodicSet set = set_of({0.25, 0.5, 0.75, 0.125}, {1, 0, 0.5, 1}, 2, {3, -7});
  Images images(set);
  EXPECT_EQ(images.num_shifts(), 1u);
  EXPECT_EQ(images.shift_number(std::vector<std::int32_t>{0, 0}), 0u);
  std::set<std::uint32_t> numbers;
  for (int round = 0; round < 2; ++round)
    for (std::int32_t i = -1; i <= 1; ++i)
      for (std::int32_t j = -1; j <= 1; ++j) {
        const std::vector<std::int32_t> k{i, j};
        const std::uint32_t number = images.shift_number(k);
        numbers.insert(number);
        EXPECT_EQ(images.shift(number).k, k);
        double image[3];
        images.copy_image({1, number}, image);
        for (std::size_t axis = 0; axis < 2; ++axis)
          EXPECT_EQ(image[axis],
                    set.row(1)[axis] + i * set.period.vector(0)[axis] + j * set.period.vector(1)[axis]);
        EXPECT_EQ(image[2], -7);
      }
  EXPECT_EQ(numbers.size(), 9u);
  EXPECT_EQ(images.num_shifts(), 9u);
}

TEST(Images, TheFrameHasEveryExtremePoint) {
  const PeriodicSet set = set_of({0.5, 0.5, 0, 0.1, 0.2, 9, 0.25, -3}, {1, 0}, 2);
  Images images(set);
  // The middle one, the highest and the lowest, by one vector to either side.
  const Named frame = named(images, images.frame());
  EXPECT_EQ(frame, (Named{{0, {-1}}, {0, {1}}, {2, {-1}}, {2, {1}}, {3, {-1}}, {3, {1}}}));
}

/// No image in the range that is said to be known is missing, and the shifts know the images of the layer.
TEST(Images, TheLayerHasAllThatItSays) {
  for (const int d : {1, 2, 3})
    for (const test::PointSet& given : test::degenerate_sets(d, 12, 3)) {
      const auto width = static_cast<std::size_t>(d);
      const std::size_t rank = d == 1 ? 1 : width - 1;
      std::vector<double> lattice(rank * width, 0);
      for (std::size_t i = 0; i < rank; ++i) lattice[i * width + i] = 16;
      std::vector<double> points = given.points;
      for (double& x : points) x = std::abs(x) < 1e3 ? x : 3;
      const PeriodicSet set = set_of(points, lattice, width);
      for (const double layer_width : {0.01, 1.0, 1e9}) {
        SCOPED_TRACE(given.name + ", width " + std::to_string(layer_width));
        Images images(set);
        const Named layer = named(images, images.layer(layer_width));
        EXPECT_EQ(known(images), layer);
        std::vector<std::int32_t> k(rank, -1);
        const std::vector<std::int32_t> low(rank, -1), high(rank, 1);
        do {
          if (k == std::vector<std::int32_t>(rank, 0)) continue;
          for (std::uint32_t row = 0; row < set.num_points(); ++row) {
            bool is_within = true;
            for (std::size_t i = 0; i < rank; ++i) {
              ASSERT_GT(images.known_below(i), 0);
              ASSERT_LT(images.known_above(i), 1);
              const double fraction = set.period.fraction(i, set.row(row)) + k[i];
              is_within =
                  is_within && -images.known_below(i) < fraction && fraction < 1 + images.known_above(i);
            }
            if (is_within) {
              EXPECT_TRUE(layer.count({row, k})) << "row " << row;
            }
          }
        } while (next_in_range(k, low, high));
      }
    }
}

TEST(Images, AreForgottenAndKnownAgain) {
  const PeriodicSet set = set_of({0.25, 0.5, 0.75, 0.125}, {1, 0, 0, 1}, 2);
  Images images(set);
  const std::vector<Image> layer = images.layer(3);
  const Named names = known(images);
  const std::vector<double> below = images.known_below(), above = images.known_above();
  EXPECT_EQ(names, named(images, layer));
  images.forget_known();
  EXPECT_THAT(known(images), IsEmpty());
  EXPECT_THAT(images.known_below(), ElementsAre(0, 0));
  EXPECT_THAT(images.known_above(), ElementsAre(0, 0));
  std::vector<Image> with_a_point = layer;
  with_a_point.push_back({1, 0});  // no image: nothing to know
  images.set_known(below, above, with_a_point);
  EXPECT_EQ(known(images), names);
  EXPECT_EQ(images.known_below(), below);
  EXPECT_EQ(images.known_above(), above);
}

}  // namespace
}  // namespace delone::periodic
