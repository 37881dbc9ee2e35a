// SPDX-License-Identifier: BSD-3-Clause
#include "halfspaces/sites_to_insert.hpp"

#include "hull/point_sieve.hpp"
#include "order/insertion_order.hpp"

#include <algorithm>
#include <cmath>

namespace delone::halfspaces {

SitesToInsert sites_to_insert(const IntersectionParts& parts, Index first, const Options& options) {
  constexpr std::size_t least_sieved = 256;
  // The leading part of a dual point's coordinate is the nearest double or a neighbor of it: off by at most
  // 3/2 of the distance of doubles there.
  constexpr double relative_error = 2 * 0x1p-52;
  const auto k = static_cast<std::size_t>(parts.rank());
  const std::size_t count = parts.sites.size() - first;
  bool are_finite = true;
  std::vector<double> duals(count * k);
  for (std::size_t i = 0; i < count; ++i) {
    const double* const dual = parts.sites.dual(first + static_cast<Index>(i));
    for (std::size_t j = 0; j < k; ++j) {
      const bool is_finite = std::isfinite(dual[j]);
      are_finite = are_finite && is_finite;
      duals[i * k + j] = is_finite ? dual[j] : 0.0;
    }
  }
  SitesToInsert sites;
  hull::PointSieve sieve(duals, parts.rank(), relative_error, options.threads);
  if (are_finite && !parts.cone && k > 1 && count >= least_sieved &&
      options.order == InsertionOrder::automatic)
    sieve.run();
  sites.order = order::insertion_order({sieve.remaining_points(), parts.rank()}, options, &sites.rounds);
  std::size_t next = 0;
  for (Index i = 0; sieve.num_remaining() < count && i < count; ++i)
    if (next < sieve.num_remaining() && sieve.remaining_row(next) == i)
      ++next;
    else
      sites.inner.push_back(first + i);
  for (Index& site : sites.order) site = first + sieve.remaining_row(site);
  return sites;
}

}  // namespace delone::halfspaces
