// SPDX-License-Identifier: BSD-3-Clause
#include "order/farthest_first.hpp"

#include "base/compiled_dimension.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <new>

#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "order/farthest_first.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#ifndef DELONE_FARTHEST_TASK
#define DELONE_FARTHEST_TASK
namespace delone::order {

/// Arrays are filled up to a multiple of this many entries.
constexpr std::size_t lanes = 16;

struct FarthestTask {
  std::size_t dimension;
  std::size_t size;    ///< of each array, a multiple of `lanes`
  std::size_t stride;  ///< from the coordinates of one axis to those of the next
  const float* coordinates;
  float* distances;
  std::uint32_t start;
  std::span<std::uint32_t> chosen;
};

}  // namespace delone::order
#endif

HWY_BEFORE_NAMESPACE();
namespace delone::order {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Updates the distances after a point has been chosen, and returns the first of the farthest points. D is
/// the dimension, or 0 for any. Products are rounded before they are added, so that all instruction sets give
/// the same result.
template <std::size_t D>
std::uint32_t take(const FarthestTask& task, std::uint32_t point) {
  const hn::CappedTag<float, lanes> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  using V = hn::Vec<decltype(d)>;
  const std::size_t dimension = D > 0 ? D : task.dimension;
  V at[D > 0 ? D : 1];
  for (std::size_t r = 0; r < D; ++r) at[r] = hn::Set(d, task.coordinates[r * task.stride + point]);
  task.distances[point] = -1;
  V largest = hn::Set(d, -2.0f);
  auto place = hn::Iota(du, 0), place_of_largest = place;
  for (std::size_t i = 0; i < task.size; i += hn::Lanes(d)) {
    V square = hn::Zero(d);
    for (std::size_t r = 0; r < dimension; ++r) {
      const float* const axis = task.coordinates + r * task.stride;
      const V edge = hn::Sub(hn::Load(d, axis + i), D > 0 ? at[r] : hn::Set(d, axis[point]));
      square = hn::Add(square, hn::Mul(edge, edge));
    }
    const V distance = hn::Min(hn::Load(d, task.distances + i), square);
    hn::Store(distance, d, task.distances + i);
    place_of_largest = hn::IfThenElse(hn::RebindMask(du, hn::Gt(distance, largest)), place, place_of_largest);
    largest = hn::Max(largest, distance);
    place = hn::Add(place, hn::Set(du, static_cast<std::uint32_t>(hn::Lanes(d))));
  }
  const auto is_farthest = hn::RebindMask(du, hn::Eq(largest, hn::MaxOfLanes(d, largest)));
  return hn::GetLane(
      hn::MinOfLanes(du, hn::IfThenElse(is_farthest, place_of_largest, hn::Set(du, ~std::uint32_t{0}))));
}

/// Returns the point that would be chosen next.
template <std::size_t D>
std::uint32_t choose_all(const FarthestTask& task) {
  std::uint32_t next = task.start;
  for (std::uint32_t& chosen : task.chosen) {
    chosen = next;
    next = take<D>(task, next);
  }
  return next;
}

std::uint32_t choose_here(const FarthestTask& task) {
  return internal::with_compiled_dimension<3, 5>(task.dimension,
                                                 [&](auto d) { return choose_all<d()>(task); });
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::order
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::order {

HWY_EXPORT(choose_here);

FarthestFirst::FarthestFirst(int dimension, std::size_t most)
    : dimension_(static_cast<std::size_t>(dimension)),
      stride_((most + lanes - 1) / lanes * lanes),
      coordinates_(hwy::AllocateAligned<float>(dimension_ * stride_)),
      distances_(hwy::AllocateAligned<float>(stride_)) {
  if (!coordinates_ || !distances_) throw std::bad_alloc();
}

void FarthestFirst::load(PointsView points, std::span<const Index> rows) {
  const auto coordinate = [&](std::size_t i, std::size_t r) { return points[rows[i]][r]; };
  double extent = 0;
  for (std::size_t r = 0; r < dimension_; ++r) {
    double least = std::numeric_limits<double>::infinity(), largest = -least;
    for (std::size_t i = 0; i < rows.size(); ++i) {
      least = std::min(least, coordinate(i, r));
      largest = std::max(largest, coordinate(i, r));
    }
    extent = std::max(extent, largest - least);
  }
  const double inverse = 1 / extent, scale = std::isfinite(extent) && std::isfinite(inverse) ? inverse : 0;
  const std::size_t filled = (rows.size() + lanes - 1) / lanes * lanes;
  for (std::size_t r = 0; r < dimension_; ++r) {
    float* const axis = coordinates_.get() + r * stride_;
    const double origin = scale > 0 ? coordinate(0, r) : 0;
    for (std::size_t i = 0; i < rows.size(); ++i)
      axis[i] = scale > 0 ? static_cast<float>((coordinate(i, r) - origin) * scale) : 0.0f;
    std::fill(axis + rows.size(), axis + filled, 0.0f);
  }
  std::fill_n(distances_.get(), rows.size(), std::numeric_limits<float>::max());
  std::fill(distances_.get() + rows.size(), distances_.get() + filled, -1.0f);
}

void FarthestFirst::choose(PointsView points, std::span<const Index> rows, std::size_t start,
                           std::span<std::uint32_t> chosen, const std::function<void()>& stop) {
  load(points, rows);
  constexpr std::size_t work_between_stops = std::size_t{1} << 22;  // about a millisecond
  const std::size_t at_a_time = std::max<std::size_t>(work_between_stops / (rows.size() * dimension_), 1);
  for (auto next = static_cast<std::uint32_t>(start); !chosen.empty();) {
    const std::size_t count = std::min(at_a_time, chosen.size());
    next =
        HWY_DYNAMIC_DISPATCH(choose_here)({dimension_, (rows.size() + lanes - 1) / lanes * lanes, stride_,
                                           coordinates_.get(), distances_.get(), next, chosen.first(count)});
    chosen = chosen.subspan(count);
    if (stop) stop();
  }
}

}  // namespace delone::order
#endif
