// SPDX-License-Identifier: BSD-3-Clause
// The answers of interpolators: sizes, and what each policy answers outside the hull.
#include "queries/evaluation.hpp"

#include "error_code.hpp"

#include <delone/delaunay.hpp>

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <limits>
#include <vector>

namespace delone::queries {
namespace {

const std::vector<double> two_queries{0.25, 0.25, 5, 4};

TEST(Answers, RoomForAllAndNoMore) {
  const EvaluateOptions options;
  for (const std::size_t size : {0, 5, 7}) {
    std::vector<double> result(size);
    EXPECT_EQ(test::code_of([&] { Answers(two_queries, 2, result, 3, options, {}); }), Errc::bad_dimension);
  }
  std::vector<double> result(6);
  const Answers answers(two_queries, 2, result, 3, options, {});
  EXPECT_EQ(answers.at(1), result.data() + 3);
}

TEST(Answers, ConstantsOutside) {
  std::vector<double> result(4, 1.0);
  EvaluateOptions options;
  Answers unknown(two_queries, 2, result, 2, options, {});
  unknown.put_value_outside(1);
  EXPECT_EQ(result[1], 1);
  EXPECT_TRUE(std::isnan(result[2]) && std::isnan(result[3]));
  unknown.put_gradient_outside(0);
  EXPECT_TRUE(std::isnan(result[0]) && std::isnan(result[1]));

  const std::vector<double> fill{7, -8};
  options.fill = fill;
  Answers filled(two_queries, 2, result, 2, options, {});
  filled.put_value_outside(1);
  EXPECT_EQ(result[2], 7);
  EXPECT_EQ(result[3], -8);
}

TEST(Answers, RefusedOutside) {
  std::vector<double> result(2);
  EvaluateOptions options;
  options.outside = Outside::error;
  Answers answers(two_queries, 2, result, 1, options, {});
  EXPECT_EQ(test::code_of([&] { answers.put_value_outside(1); }), Errc::invalid_argument);
  EXPECT_EQ(test::code_of([&] { answers.put_gradient_outside(0); }), Errc::invalid_argument);
}

/// The value at the nearest vertex, once all are known; its gradient is 0.
TEST(Answers, NearestOutside) {
  const Delaunay<> t(std::vector<double>{0, 0, 1, 0, 0, 1}, 2);
  const PointLocator locator(t);
  std::vector<double> by_id(t.complex().num_vertex_slots(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t row = 0; row < 3; ++row) by_id[index(t.vertex_at(row))] = 10.0 * static_cast<double>(row);
  std::vector<double> result(2, 5.0);
  EvaluateOptions options;
  options.outside = Outside::nearest;
  Answers answers(two_queries, 2, result, 1, options, {});
  answers.put_value_outside(1);
  EXPECT_TRUE(std::isnan(result[1]));
  answers.finish(locator, by_id, 1);
  EXPECT_EQ(result[0], 5);
  EXPECT_EQ(result[1], 10);  // (1, 0) is nearest to (5, 4)
  answers.put_gradient_outside(0);
  EXPECT_EQ(result[0], 0);
}

}  // namespace
}  // namespace delone::queries
