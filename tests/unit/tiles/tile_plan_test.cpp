// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/tile_plan.hpp"
#include "scale.hpp"
#include "tiles/survey.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

namespace {

using namespace delone;
using namespace delone::tiles;

TEST(TilePlan, AsFewTilesAsFit) {
  Survey survey;
  survey.dimension = survey.affine_dimension = 3;
  survey.num_points = 20'000'000;
  const SetModel model{6.7, ForeignShare::of_uniform_points(3)};
  const SetModel many_cells{1e6, ForeignShare::of_uniform_points(3)};
  const std::uint64_t gigabyte = std::uint64_t{1} << 30;
  EXPECT_EQ(plan_tiles(survey, model, {}, 40 * gigabyte).num_tiles, 1u);
  const TilesForecast forecast = plan_tiles(survey, model, {}, 2 * gigabyte);
  EXPECT_GT(forecast.num_tiles, 5u);
  EXPECT_LT(forecast.num_tiles, 20u);
  EXPECT_LE(forecast.bytes_per_tile, 2 * gigabyte);
  EXPECT_GT(forecast.foreign_share, 0.01);
  EXPECT_LT(forecast.foreign_share, 0.1);
  EXPECT_EQ(forecast.num_points, 20'000'000);

  TilesOptions options;
  options.tiles = 7;
  EXPECT_EQ(plan_tiles(survey, model, options, 1).num_tiles, 7u);
  // More and more tiles would not fit: it ends.
  EXPECT_GT(plan_tiles(survey, many_cells, {}, 1000).bytes_per_tile, 1000u);
  survey.num_points = 0;
  survey.affine_dimension = -1;
  EXPECT_EQ(plan_tiles(survey, model, {}, gigabyte).num_tiles, 1u);
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
  EXPECT_EQ(ForeignShare::of_uniform_points(3).of(1e6, 1), 0);
  EXPECT_NEAR(ForeignShare::of_uniform_points(3).of(125000, 8), 0.077, 0.02);  // measured
  EXPECT_GT(ForeignShare::of_uniform_points(5).of(5000, 4), 0.5);
}

TEST(TilePlan, ForeignShareOfSamples) {
  const std::size_t n = test::scaled_size(20000, 800);
  const ForeignShare uniform = ForeignShare::of_sample(make_point_set("uniform", 3, n, 1), 3);
  const double expected = ForeignShare::of_uniform_points(3).of(1e6, 16);
  EXPECT_GT(uniform.of(1e6, 16), expected / 4);
  EXPECT_LT(uniform.of(1e6, 16), expected * 4);
  const ForeignShare surface = ForeignShare::of_sample(make_point_set("manifold", 3, n, 1), 3);
  EXPECT_GT(surface.of(1e6, 16), 4 * expected);
  EXPECT_EQ(ForeignShare::of_sample(std::vector<double>(300, 1.0), 3).of(1e6, 8), 0);
}

}  // namespace
