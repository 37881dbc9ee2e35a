// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/survey.hpp"

#include "tile_sets.hpp"

#include <gtest/gtest.h>
#include <delone/predicates.hpp>

#include <algorithm>
#include <map>
#include <set>

namespace delone::tiles {
namespace {

TEST(Survey, KnowsBoxHullAndLandmarks) {
  for (const test::TileSet& set : test::tile_sets(500)) {
    SCOPED_TRACE(set.name);
    const auto stream = stream_of(set.view());
    const auto [survey, sample] = make_survey(*stream, set.weighted, 100, 1);
    const auto d = static_cast<std::size_t>(set.dimension()), width = static_cast<std::size_t>(set.row_size);
    const std::size_t n = set.rows.size() / width;
    ASSERT_EQ(survey.num_points, n);
    EXPECT_EQ(survey.dimension, set.dimension());
    EXPECT_EQ(sample.size(), std::min<std::size_t>(n, 100) * d);
    if (n == 0) {
      EXPECT_EQ(survey.affine_dimension, -1);
      continue;
    }
    std::vector<double> points;
    for (std::size_t i = 0; i < n; ++i)
      points.insert(points.end(), &set.rows[i * width], &set.rows[i * width] + d);
    EXPECT_EQ(survey.affine_dimension, affine_dimension(points, set.dimension()));

    // Of each position the row that counts, which is the first one of the largest weight.
    std::map<std::vector<double>, std::size_t> row_of_position;
    for (std::size_t i = 0; i < n; ++i) {
      const std::vector<double> position(&points[i * d], &points[i * d] + d);
      const auto [place, is_new] = row_of_position.emplace(position, i);
      if (!is_new && set.weighted && set.rows[i * width + d] > set.rows[place->second * width + d])
        place->second = i;
    }
    std::set<std::vector<double>> positions;
    std::vector<double> landmarks;
    ASSERT_EQ(survey.landmarks.size(), survey.landmark_rows.size() * width);
    for (std::size_t i = 0; i < survey.landmark_rows.size(); ++i) {
      const double* const point = &survey.landmarks[i * width];
      const auto row = static_cast<std::size_t>(survey.landmark_rows[i]);
      EXPECT_TRUE(std::equal(point, point + width, &set.rows[row * width]));
      EXPECT_TRUE(positions.insert({point, point + d}).second);
      EXPECT_EQ(row_of_position.at({point, point + d}), row);
      landmarks.insert(landmarks.end(), point, point + d);
    }
    EXPECT_EQ(affine_dimension(landmarks, set.dimension()), survey.affine_dimension);
    const auto basis_size = static_cast<std::size_t>(survey.affine_dimension + 1) * d;
    landmarks.resize(basis_size);
    EXPECT_EQ(affine_dimension(landmarks, set.dimension()), survey.affine_dimension);
    for (std::size_t axis = 0; axis < d; ++axis) {
      double low = points[axis], high = low, lowest = survey.landmarks[axis], highest = lowest;
      for (std::size_t i = 0; i < n; ++i) {
        low = std::min(low, points[i * d + axis]);
        high = std::max(high, points[i * d + axis]);
      }
      for (std::size_t i = 0; i < survey.landmark_rows.size(); ++i) {
        lowest = std::min(lowest, survey.landmarks[i * width + axis]);
        highest = std::max(highest, survey.landmarks[i * width + axis]);
      }
      EXPECT_EQ(survey.low[axis], low);
      EXPECT_EQ(survey.high[axis], high);
      EXPECT_EQ(lowest, low);
      EXPECT_EQ(highest, high);
    }
    if (set.weighted) {
      double low = set.rows[d], high = low;
      for (std::size_t i = d; i < set.rows.size(); i += width) {
        low = std::min(low, set.rows[i]);
        high = std::max(high, set.rows[i]);
      }
      EXPECT_EQ(survey.lowest_weight, low);
      EXPECT_EQ(survey.largest_weight, high);
    }
  }
}

/// Rows 0 … 9 999; each tenth of them has about a tenth of the sample.
TEST(Survey, SamplesUniformly) {
  std::vector<double> rows;
  for (int i = 0; i < 10000; ++i) rows.push_back(i);
  const auto stream = stream_of(PointsView(rows, 1));
  const auto sample = make_survey(*stream, false, 1000, 3).sample;
  std::vector<int> tenths(10);
  for (const double value : sample) ++tenths[static_cast<std::size_t>(value) / 1000];
  for (const int count : tenths) {
    EXPECT_GT(count, 60);
    EXPECT_LT(count, 140);
  }
  EXPECT_EQ(std::set<double>(sample.begin(), sample.end()).size(), 1000u);
  EXPECT_EQ(make_survey(*stream, false, 1000, 3).sample, sample);
  EXPECT_NE(make_survey(*stream, false, 1000, 4).sample, sample);
}

TEST(Survey, RefusesWeightsWithoutCoordinates) {
  const std::vector<double> rows = {1, 2};
  const auto stream = stream_of(PointsView(rows, 1));
  EXPECT_THROW(make_survey(*stream, true), Error);
}

}  // namespace
}  // namespace delone::tiles
