// SPDX-License-Identifier: BSD-3-Clause
#include "hull/outermost_sites.hpp"

#include <algorithm>
#include <cstddef>
#include <limits>

namespace delone::hull {
namespace {

/// The minimum and maximum of a function, and the first sites that attain them.
struct Range {
  double low = std::numeric_limits<double>::infinity(), high = -std::numeric_limits<double>::infinity();
  Index lowest = invalid_index, highest = invalid_index;

  void include(double value, Index site) {
    if (value < low) low = value, lowest = site;
    if (value > high) high = value, highest = site;
  }
};

}  // namespace

std::vector<Index> outermost_sites(const sites::BoundarySites& sites, Index first) {
  const auto d = static_cast<std::size_t>(sites.ambient);
  std::vector<Range> ranges(d);
  for (Index site = first; site < sites.size(); ++site)
    for (std::size_t j = 0; j < d; ++j) ranges[j].include(sites.point(site)[j], site);

  if (d > 1 && d <= most_axes_with_diagonals) {
    // Coordinates in units of the box give all axes the same weight. A sum that overflows to NaN is ignored.
    std::vector<double> scale(d), x(d);
    for (std::size_t j = 0; j < d; ++j)
      scale[j] = ranges[j].high > ranges[j].low ? 1 / (ranges[j].high - ranges[j].low) : 0;
    // One of each pair of opposite diagonals: the sign of x_0 is always +.
    const std::size_t num_diagonals = std::size_t{1} << (d - 1);
    std::vector<Range> diagonals(num_diagonals);
    std::vector<double> sums(num_diagonals);
    for (Index site = first; site < sites.size(); ++site) {
      sums[0] = sites.point(site)[0] * scale[0];
      for (std::size_t j = 1, half = 1; j < d; ++j, half *= 2) {
        const double term = sites.point(site)[j] * scale[j];
        for (std::size_t i = 0; i < half; ++i) {
          sums[i + half] = sums[i] - term;
          sums[i] += term;
        }
      }
      for (std::size_t i = 0; i < num_diagonals; ++i) diagonals[i].include(sums[i], site);
    }
    ranges.insert(ranges.end(), diagonals.begin(), diagonals.end());
  }

  std::vector<Index> chosen;
  for (const Range& range : ranges)
    for (const Index site : {range.lowest, range.highest})
      if (site != invalid_index && std::find(chosen.begin(), chosen.end(), site) == chosen.end())
        chosen.push_back(site);
  return chosen;
}

}  // namespace delone::hull
