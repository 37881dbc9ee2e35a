// SPDX-License-Identifier: BSD-3-Clause
#include "halfspaces/row_sieve.hpp"

#include "base/progress_meter.hpp"
#include "hull/point_sieve.hpp"
#include "kernel/predicates.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace delone::halfspaces {
namespace {

/// The first rows of a list that are independent, and the axes that they project on.
struct Span {
  std::vector<Index> rows;
  std::vector<int> axes;
};

Span span_of(std::span<const double> rows, std::size_t d, const std::vector<Index>& list) {
  kernel::AffineHull normals(static_cast<int>(d));
  const std::vector<double> origin(d, 0.0);
  normals.add(origin.data());
  Span span;
  for (std::size_t i = 0; i < list.size() && normals.dimension() < static_cast<int>(d); ++i)
    if (normals.add(&rows[list[i] * (d + 1)])) span.rows.push_back(list[i]);
  span.axes = normals.axes();
  return span;
}

/// The leading parts of the dual points; none if one is beyond the range of doubles.
std::vector<double> leading_duals(std::span<const double> rows, const InteriorPoint& p,
                                  std::span<const int> axes, const std::vector<Index>& list) {
  constexpr std::size_t part = 256;  // so many are in the cache
  const std::size_t width = p.rounded.size() + 1, k = axes.size();
  std::vector<double> copied, duals(part * 2 * k), leading(list.size() * k);
  double rest = 0;  // is no number if one is not finite
  for (std::size_t first = 0; first < list.size(); first += part) {
    internal::cancellation_point();
    const std::size_t count = std::min(part, list.size() - first);
    const double* some = &rows[list[first] * width];
    if (list[first + count - 1] - list[first] != count - 1) {  // not one after the other
      copied.clear();
      for (std::size_t i = first; i < first + count; ++i)
        copied.insert(copied.end(), &rows[list[i] * width], &rows[list[i] * width] + width);
      some = copied.data();
    }
    dual_points(some, count, p, axes, duals.data());
    double* to = leading.data() + first * k;
    for (std::size_t i = 0; i < count; ++i)
      for (std::size_t j = 0; j < k; ++j) {
        *to = duals[i * 2 * k + j];
        rest += 0 * *to++;
      }
  }
  if (rest != 0) return {};
  return leading;
}

}  // namespace

std::vector<Index> remove_redundant(std::span<const double> rows, const InteriorPoint& p,
                                    const Options& options, std::vector<Index>& list) {
  constexpr std::size_t least_sieved = 256;
  // The leading part of a dual point's coordinate is the nearest double or a neighbor of it: off by at most
  // 3/2 of the distance of doubles there.
  constexpr double relative_error = 2 * 0x1p-52;
  if (list.size() < least_sieved || options.order != InsertionOrder::automatic) return {};
  const Span span = span_of(rows, p.rounded.size(), list);
  if (span.axes.size() < 2) return {};
  const std::vector<double> duals = leading_duals(rows, p, span.axes, list);
  if (duals.empty()) return {};
  hull::PointSieve sieve(duals, static_cast<int>(span.axes.size()), relative_error, options.threads);
  sieve.run();
  if (sieve.num_remaining() == list.size()) return {};
  std::vector<Index> remaining, staying, removed;
  for (std::size_t i = 0; i < sieve.num_remaining(); ++i) remaining.push_back(list[sieve.remaining_row(i)]);
  std::set_union(remaining.begin(), remaining.end(), span.rows.begin(), span.rows.end(),
                 std::back_inserter(staying));
  std::set_difference(list.begin(), list.end(), staying.begin(), staying.end(), std::back_inserter(removed));
  list = std::move(staying);
  return removed;
}

}  // namespace delone::halfspaces
