// SPDX-License-Identifier: BSD-3-Clause
// Questions against eight boxes, or the points of a page, at a time: SIMD for the best instruction set of the
// processor. The bounds are those of question.hpp, computed in the same order.
#pragma once

#include <cstddef>
#include <cstdint>

namespace delone::pages {

/// A question as the kernel reads it; see Question.
struct QuestionForm {
  const double *p = nullptr, *c = nullptr;
  const double *direction = nullptr, *reach = nullptr;
  bool is_halfspace = false, is_weighted = false;
  double largest_weight = 0;
};

/// What the sums of question.hpp are multiplied with to give slacks.
constexpr double slack_factor(bool is_halfspace, std::size_t d) {
  return (is_halfspace ? 1.01e-12 : 0.0) + static_cast<double>(d + 8) * 0x1p-53;
}
inline constexpr double least_slack = 0x1p-1000;

inline constexpr std::size_t boxes_per_node = 8;
inline constexpr std::size_t most_points_at_once = 64;

/// The boxes, by their bits, of which it is not certain that no point is in conflict. `boxes`: for each axis
/// eight least coordinates and then eight largest ones; then eight largest weights, if points have weights.
/// With `has_best` boxes are also left out in which no key can be less than `best_key`, rounded.
/// `distances`: the squared distances of the boxes from p.
unsigned find_open_boxes(std::size_t d, const QuestionForm& question, const double* boxes, bool has_best,
                         double best_key, double* distances);

/// The points, by their bits, that are not certainly outside. Coordinate j of point i is number j·stride + i;
/// weights follow the coordinates. REQUIRES count ≤ most_points_at_once, and that eight points at a time can
/// be read.
std::uint64_t find_points_not_outside(std::size_t d, const QuestionForm& question, const double* coordinates,
                                      std::size_t stride, std::size_t count);

}  // namespace delone::pages
