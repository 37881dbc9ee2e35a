// SPDX-License-Identifier: BSD-3-Clause
// Sites whose distances count where axes have tolerances of their own.
#pragma once

#include "base/axis_scale.hpp"
#include "sites/boundary_sites.hpp"

#include <optional>

namespace delone::hull {

using sites::BoundarySites;

/// Sites, or a copy of them with scaled coordinates. Both must outlive this object.
class ScaledSites {
 public:
  ScaledSites(const BoundarySites& sites, const internal::AxisScale& scale) : sites_(sites) {
    if (scale.is_one()) return;
    copy_.emplace(sites.ambient);
    copy_->axes = sites.axes;
    copy_->coordinates = scale.scaled(sites.coordinates);
    for (Index site = 0; site < copy_->size(); ++site) copy_->grid.include(copy_->point(site));
  }
  ScaledSites(const ScaledSites&) = delete;
  ScaledSites& operator=(const ScaledSites&) = delete;

  const BoundarySites& get() const { return copy_ ? *copy_ : sites_; }

 private:
  const BoundarySites& sites_;
  std::optional<BoundarySites> copy_;
};

}  // namespace delone::hull
