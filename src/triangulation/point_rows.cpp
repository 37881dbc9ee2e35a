// SPDX-License-Identifier: BSD-3-Clause
#include "triangulation/point_rows.hpp"

#include "order/insertion_order.hpp"

#include <delone/error.hpp>

#include <cmath>
#include <numeric>

namespace delone::front_ends {

void require_finite(std::span<const double> numbers, std::size_t width, const std::string& what) {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!std::isfinite(numbers[i]) && (rows.empty() || rows.back() != i / width)) rows.push_back(i / width);
  if (rows.empty()) return;
  throw Error(Errc::not_finite,
              what + " of point " + std::to_string(rows.front()) + " is not finite" +
                  (rows.size() > 1 ? " (and of " + std::to_string(rows.size() - 1) + " more points)" : ""),
              rows);
}

std::vector<Index> insertion_order(PointsView points, const Options& options) {
  switch (options.order) {
    case InsertionOrder::shuffled:
      return order::shuffled_order(points.size(), options.seed);
    case InsertionOrder::as_given: {
      std::vector<Index> rows(points.size());
      std::iota(rows.begin(), rows.end(), Index{0});
      return rows;
    }
    case InsertionOrder::automatic:
      break;
  }
  return order::automatic_order(points, options.seed);
}

}  // namespace delone::front_ends
