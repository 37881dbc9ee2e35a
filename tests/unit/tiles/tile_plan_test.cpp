// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/survey.hpp"
#include "tiles/tile_plan.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

namespace {

using namespace delone;
using namespace delone::tiles;

TEST(TilePlan, AsFewTilesAsFit) {
  Survey survey;
  survey.dimension = survey.affine_dimension = 3;
  survey.num_points = 20'000'000;
  const std::uint64_t gigabyte = std::uint64_t{1} << 30;
  EXPECT_EQ(plan_tiles(survey, 6.7, {}, 40 * gigabyte).num_tiles, 1u);
  const TilesForecast forecast = plan_tiles(survey, 6.7, {}, 2 * gigabyte);
  EXPECT_GT(forecast.num_tiles, 5u);
  EXPECT_LT(forecast.num_tiles, 20u);
  EXPECT_LE(forecast.bytes_per_tile, 2 * gigabyte);
  EXPECT_GT(forecast.foreign_share, 0.01);
  EXPECT_LT(forecast.foreign_share, 0.1);
  EXPECT_EQ(forecast.num_points, 20'000'000);

  TilesOptions options;
  options.tiles = 7;
  EXPECT_EQ(plan_tiles(survey, 6.7, options, 1).num_tiles, 7u);
  // More and more tiles would not fit: it ends.
  EXPECT_GT(plan_tiles(survey, 1e6, {}, 1000).bytes_per_tile, 1000u);
  survey.num_points = 0;
  survey.affine_dimension = -1;
  EXPECT_EQ(plan_tiles(survey, 1, {}, gigabyte).num_tiles, 1u);
}

TEST(TilePlan, CellsPerPoint) {
  const std::vector<double> points = make_point_set("uniform", 3, 4000, 1);
  const auto stream = stream_of(PointsView(points, 3));
  const SurveyResult result = make_survey(*stream, false);
  const double cells = cells_per_point(result.sample, result.survey);
  EXPECT_GT(cells, 6);
  EXPECT_LT(cells, 7);
}

TEST(TilePlan, ForeignShare) {
  EXPECT_EQ(expected_foreign_share(3, 1e6, 1), 0);
  EXPECT_NEAR(expected_foreign_share(3, 125000, 8), 0.077, 0.02);  // measured for uniform points
  EXPECT_GT(expected_foreign_share(5, 5000, 4), 0.5);
}

}  // namespace
