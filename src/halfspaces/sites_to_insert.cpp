// SPDX-License-Identifier: BSD-3-Clause
#include "halfspaces/sites_to_insert.hpp"

#include "order/insertion_order.hpp"

#include <cmath>

namespace delone::halfspaces {

SitesToInsert sites_to_insert(const IntersectionParts& parts, Index first, const Options& options) {
  const auto k = static_cast<std::size_t>(parts.rank());
  std::vector<double> duals;
  duals.reserve((parts.sites.size() - first) * k);
  for (Index site = first; site < parts.sites.size(); ++site)
    for (std::size_t j = 0; j < k; ++j) {
      const double x = parts.sites.dual(site)[j];
      duals.push_back(std::isfinite(x) ? x : 0.0);
    }
  SitesToInsert sites;
  sites.order = order::insertion_order({duals, parts.rank()}, options, &sites.rounds);
  for (Index& site : sites.order) site += first;
  return sites;
}

}  // namespace delone::halfspaces
