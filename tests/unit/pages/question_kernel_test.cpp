// SPDX-License-Identifier: BSD-3-Clause
// The SIMD kernel against exact fractions: what it leaves out is outside, what it keeps is not far from that.
#include "degenerate.hpp"
#include "pages/page_tree.hpp"
#include "pages/question.hpp"

#include <delone/predicates.hpp>

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>

#include <cmath>
#include <vector>

namespace {

using namespace delone;
using namespace delone::pages;
using Rational = boost::multiprecision::cpp_rational;

/// |x − p|² − w_x + w_p − 2(c − p)·(x − p): negative inside.
Rational power(const double* p, const double* c, const double* x, std::size_t d, bool weighted) {
  Rational sum = weighted ? Rational(p[d]) - Rational(x[d]) : Rational(0);
  for (std::size_t j = 0; j < d; ++j) {
    const Rational from_p = Rational(x[j]) - Rational(p[j]);
    sum += from_p * (from_p - 2 * (Rational(c[j]) - Rational(p[j])));
  }
  return sum;
}

struct Case {
  std::vector<double> p, c, points;  // eight points, axis by axis
  double largest_weight = 0;
};

Case random_case(test::Random& random, std::size_t d, bool weighted) {
  Case result;
  const double offset = random.integer(0, 1) != 0 ? 1e6 : 0, scale = std::ldexp(1.0, random.integer(-30, 30));
  const auto coordinate = [&] {
    return offset + scale * random.integer(-3, 3) / (random.integer(0, 1) != 0 ? 1 : 3);
  };
  const std::size_t width = d + (weighted ? 1 : 0);
  for (std::size_t j = 0; j < width; ++j) {
    result.p.push_back(coordinate());
    if (j < d) result.c.push_back(coordinate() * (random.integer(0, 9) == 0 ? 1e9 : 1));
  }
  for (std::size_t at = 0; at < 8 * width; ++at) {
    result.points.push_back(coordinate());
    result.largest_weight = std::max(result.largest_weight, std::abs(result.points.back()));
  }
  if (weighted) result.largest_weight = std::max(result.largest_weight, std::abs(result.p[d]));
  return result;
}

Question<0> question_of(const Case& asked, std::size_t d, bool weighted) {
  Question<0> question(d, weighted);
  question.set_largest_weight(asked.largest_weight);
  question.ask_within_sphere(asked.p.data(), asked.c.data());
  return question;
}

TEST(QuestionKernel, PointsOfSpheres) {
  test::Random random(1);
  std::size_t outside = 0, kept_outside = 0;
  for (int repeat = 0; repeat < 400; ++repeat) {
    const std::size_t d = 1 + static_cast<std::size_t>(repeat % 6);
    const bool weighted = repeat / 6 % 2 != 0;
    const Case one = random_case(random, d, weighted);
    const Question<0> question = question_of(one, d, weighted);
    const std::uint64_t bits = find_points_not_outside(d, question.form(), one.points.data(), 8, 8);
    for (std::size_t i = 0; i < 8; ++i) {
      std::vector<double> x;
      for (std::size_t at = i; at < one.points.size(); at += 8) x.push_back(one.points[at]);
      const Rational value = power(one.p.data(), one.c.data(), x.data(), d, weighted);
      const bool is_kept = (bits >> i & 1) != 0;
      if (!is_kept) {
        ASSERT_GT(value, 0) << repeat;
      }
      const QuestionSide side = question.side(x.data());
      if (side == QuestionSide::outside) {
        ASSERT_GT(value, 0);
      }
      if (side == QuestionSide::inside) {
        ASSERT_LT(value, 0);
        ASSERT_TRUE(is_kept);
      }
      outside += value > 0;
      kept_outside += value > 0 && is_kept;
    }
  }
  EXPECT_LT(kept_outside * 20, outside);
}

TEST(QuestionKernel, Boxes) {
  test::Random random(2);
  std::size_t closed = 0, shut = 0;
  for (int repeat = 0; repeat < 400; ++repeat) {
    const std::size_t d = 1 + static_cast<std::size_t>(repeat % 6);
    const bool weighted = repeat / 6 % 2 != 0;
    const Case low = random_case(random, d, weighted);
    const Question<0> question = question_of(low, d, weighted);
    // The boxes of two points each.
    std::vector<double> boxes, others;
    for (std::size_t j = 0; j < d; ++j) {
      std::vector<double> highs;
      for (std::size_t i = 0; i < 8; ++i) {
        const double a = low.points[8 * j + i], b = low.points[8 * j + (i + 3) % 8];
        boxes.push_back(std::min(a, b));
        highs.push_back(std::max(a, b));
      }
      boxes.insert(boxes.end(), highs.begin(), highs.end());
    }
    for (std::size_t i = 0; weighted && i < 8; ++i)
      boxes.push_back(std::max(low.points[8 * d + i], low.points[8 * d + (i + 3) % 8]));
    double distances[8];
    const unsigned open = find_open_boxes(d, question.form(), boxes.data(), false, 0, distances);
    for (std::size_t i = 0; i < 8; ++i) {
      // The least value is at the point of the box that is nearest to the center.
      std::vector<double> x;
      for (std::size_t j = 0; j < d; ++j)
        x.push_back(std::clamp(low.c[j], boxes[16 * j + i], boxes[16 * j + 8 + i]));
      if (weighted) x.push_back(boxes[16 * d + i]);
      const Rational least = power(low.p.data(), low.c.data(), x.data(), d, weighted);
      if ((open >> i & 1) == 0) {
        ASSERT_GT(least, 0) << repeat;
      }
      shut += least > 0;
      closed += (open >> i & 1) == 0;
    }
  }
  EXPECT_GT(closed * 10, shut * 9);
}

TEST(QuestionKernel, Halfspaces) {
  const std::vector<double> p{0.5, 0.25, 1}, normal{0, 0.6, 0.8};
  Question<3> question(3, false);
  question.ask_beyond_facet(p.data(), normal.data());
  std::vector<double> points(24, 0.0), boxes(48, 0.0);
  for (std::size_t i = 0; i < 8; ++i)
    for (std::size_t j = 0; j < 3; ++j) {
      const double step = static_cast<double>(i) - 4;
      points[8 * j + i] = p[j] + step * normal[j] + (j == 0 ? 7 : 0);
      boxes[16 * j + i] = points[8 * j + i] - (j == 0 ? 3 : 0);
      boxes[16 * j + 8 + i] = points[8 * j + i];
    }
  // The fifth is in the hyperplane, the ones after it beyond.
  EXPECT_EQ(find_points_not_outside(3, question.form(), points.data(), 8, 8), 0xf0u);
  double distances[8];
  EXPECT_EQ(find_open_boxes(3, question.form(), boxes.data(), false, 0, distances), 0xf0u);
  EXPECT_DOUBLE_EQ(distances[4], 16.0);
}

}  // namespace
