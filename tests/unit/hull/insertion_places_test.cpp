// SPDX-License-Identifier: BSD-3-Clause
#include "hull/insertion_places.hpp"

#include <gtest/gtest.h>

#include <array>

namespace delone::hull {
namespace {

TEST(InsertionPlaces, AreThoseOfVertices) {
  InsertionPlaces places;
  places.add(std::array<Index, 2>{4, 0}, 6);
  places.add({}, 8);
  places.add(std::array<Index, 2>{7, 2}, 8);
  const auto of = places.of_vertices();
  ASSERT_GE(of.size(), 9u);
  EXPECT_EQ(of[5], 1u);
  EXPECT_EQ(of[1], 2u);
  EXPECT_EQ(of[8], 3u);
  EXPECT_EQ(of[3], 4u);
  EXPECT_EQ(of[2], 0u);  // of a site that came singly
}

}  // namespace
}  // namespace delone::hull
