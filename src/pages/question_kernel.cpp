// SPDX-License-Identifier: BSD-3-Clause
#include "pages/question_kernel.hpp"

#include "base/compiled_dimension.hpp"

#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "pages/question_kernel.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace delone::pages {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Whether value > slack, the certain side of no conflict, from the sums over the axes.
template <class Tag, class V>
auto is_outside(Tag tag, const QuestionForm& question, std::size_t d, V value, V slack) {
  const double factor = slack_factor(question.is_halfspace, d);
  return hn::Gt(value, hn::Add(hn::Mul(slack, hn::Set(tag, factor)), hn::Set(tag, least_slack)));
}

template <int D>
unsigned open_boxes(std::size_t dimension, const QuestionForm& question, const double* HWY_RESTRICT boxes,
                    bool has_best, double best_key, double* HWY_RESTRICT distances) {
  const std::size_t d = D > 0 ? static_cast<std::size_t>(D) : dimension;
  const hn::CappedTag<double, boxes_per_node> tag;
  using V = hn::Vec<decltype(tag)>;
  const V zero = hn::Zero(tag);
  unsigned open = 0;
  for (std::size_t lane = 0; lane < boxes_per_node; lane += hn::Lanes(tag)) {
    V value = zero, slack = zero, distance = zero, least = zero;
    for (std::size_t j = 0; j < d; ++j) {
      const V low = hn::LoadU(tag, boxes + 2 * j * boxes_per_node + lane),
              high = hn::LoadU(tag, boxes + (2 * j + 1) * boxes_per_node + lane),
              p = hn::Set(tag, question.p[j]);
      const V low_from_p = hn::Sub(low, p), high_from_p = hn::Sub(high, p);
      const V farthest = hn::Max(hn::Abs(low_from_p), hn::Abs(high_from_p));
      const V direction = hn::Set(tag, question.direction[j]);
      if (question.is_halfspace) {
        value = hn::Sub(value, hn::Max(hn::Mul(direction, low_from_p), hn::Mul(direction, high_from_p)));
        slack = hn::Add(slack, farthest);
      } else {
        const V c = hn::Set(tag, question.c[j]);
        const V nearest = hn::Min(hn::Max(c, low), high);
        value = hn::Add(value, hn::Mul(hn::Sub(nearest, p), hn::Add(hn::Sub(nearest, c), hn::Sub(p, c))));
        const V farthest_from_c = hn::Max(hn::Abs(hn::Sub(low, c)), hn::Abs(hn::Sub(high, c)));
        slack = hn::Add(slack, hn::Mul(farthest, hn::Add(farthest_from_c, hn::Set(tag, question.reach[j]))));
      }
      const V off = hn::Max(zero, hn::Max(low_from_p, hn::Neg(high_from_p)));
      distance = hn::Add(distance, hn::Mul(off, off));
      if (has_best) {
        const V step = hn::Mul(direction, hn::Set(tag, best_key > 0 ? best_key : 0.0));
        const V nearest = hn::Min(hn::Max(hn::Mul(step, hn::Set(tag, 0.5)), low_from_p), high_from_p);
        least = hn::Add(least, hn::Mul(nearest, hn::Sub(nearest, step)));
      }
    }
    if (question.is_weighted) {
      const V gain =
          hn::Sub(hn::LoadU(tag, boxes + 2 * d * boxes_per_node + lane), hn::Set(tag, question.p[d]));
      if (!question.is_halfspace) {
        value = hn::Sub(value, gain);
        slack = hn::Add(slack, hn::Set(tag, question.largest_weight * 2));
      }
      least = hn::Sub(least, gain);
    }
    auto closed = is_outside(tag, question, d, value, slack);
    if (has_best) closed = hn::Or(closed, hn::Gt(least, hn::Set(tag, best_key < 0 ? best_key : 0.0)));
    hn::StoreU(distance, tag, distances + lane);
    HWY_ALIGN std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, hn::Not(closed), bits);
    open |= static_cast<unsigned>(bits[0] & ((1u << hn::Lanes(tag)) - 1)) << lane;
  }
  return open;
}

template <int D>
std::uint64_t points_not_outside(std::size_t dimension, const QuestionForm& question,
                                 const double* HWY_RESTRICT coordinates, std::size_t stride,
                                 std::size_t count) {
  const std::size_t d = D > 0 ? static_cast<std::size_t>(D) : dimension;
  const hn::CappedTag<double, 8> tag;
  using V = hn::Vec<decltype(tag)>;
  std::uint64_t result = 0;
  for (std::size_t first = 0; first < count; first += hn::Lanes(tag)) {
    V value = hn::Zero(tag), slack = hn::Zero(tag);
    const auto load = [&](std::size_t j) { return hn::LoadU(tag, coordinates + j * stride + first); };
    for (std::size_t j = 0; j < d; ++j) {
      const V x = load(j), p = hn::Set(tag, question.p[j]);
      const V from_p = hn::Sub(x, p);
      if (question.is_halfspace) {
        value = hn::Sub(value, hn::Mul(hn::Set(tag, question.direction[j]), from_p));
        slack = hn::Add(slack, hn::Abs(from_p));
      } else {
        const V c = hn::Set(tag, question.c[j]), from_c = hn::Sub(x, c);
        value = hn::Add(value, hn::Mul(from_p, hn::Add(from_c, hn::Sub(p, c))));
        slack = hn::Add(slack,
                        hn::Mul(hn::Abs(from_p), hn::Add(hn::Abs(from_c), hn::Set(tag, question.reach[j]))));
      }
    }
    if (question.is_weighted && !question.is_halfspace) {
      value = hn::Sub(value, hn::Sub(load(d), hn::Set(tag, question.p[d])));
      slack = hn::Add(slack, hn::Set(tag, question.largest_weight * 2));
    }
    HWY_ALIGN std::uint8_t bits[8] = {};
    hn::StoreMaskBits(tag, hn::Not(is_outside(tag, question, d, value, slack)), bits);
    result |= static_cast<std::uint64_t>(bits[0] & ((1u << hn::Lanes(tag)) - 1)) << first;
  }
  return count == 64 ? result : result & ((std::uint64_t{1} << count) - 1);
}

unsigned find_open_boxes_here(std::size_t d, const QuestionForm& question, const double* boxes, bool has_best,
                              double best_key, double* distances) {
  return internal::with_compiled_dimension<2, 5>(d, [&](auto dimension) {
    return open_boxes<dimension()>(d, question, boxes, has_best, best_key, distances);
  });
}
std::uint64_t find_points_not_outside_here(std::size_t d, const QuestionForm& question,
                                           const double* coordinates, std::size_t stride, std::size_t count) {
  return internal::with_compiled_dimension<2, 5>(d, [&](auto dimension) {
    return points_not_outside<dimension()>(d, question, coordinates, stride, count);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::pages
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::pages {

HWY_EXPORT(find_open_boxes_here);
HWY_EXPORT(find_points_not_outside_here);

unsigned find_open_boxes(std::size_t d, const QuestionForm& question, const double* boxes, bool has_best,
                         double best_key, double* distances) {
  return HWY_DYNAMIC_DISPATCH(find_open_boxes_here)(d, question, boxes, has_best, best_key, distances);
}

std::uint64_t find_points_not_outside(std::size_t d, const QuestionForm& question, const double* coordinates,
                                      std::size_t stride, std::size_t count) {
  return HWY_DYNAMIC_DISPATCH(find_points_not_outside_here)(d, question, coordinates, stride, count);
}

}  // namespace delone::pages
#endif
