// SPDX-License-Identifier: BSD-3-Clause
// What a periodic triangulation is made of, which its members do not give.
#pragma once

#include "periodic/periodic_triangulation_impl.hpp"

namespace delone::periodic {

class StoredSet : private PeriodicTriangulation {
  using Member = const Impl& (PeriodicTriangulation::*)() const;
  static const Impl& impl_of(const PeriodicTriangulation& t) {
    return (t.*static_cast<Member>(&StoredSet::impl))();
  }

 public:
  static const PeriodicSet& set(const PeriodicTriangulation& t) { return impl_of(t).set; }
  static const GhostTriangulation& ghosts(const PeriodicTriangulation& t) { return impl_of(t).ghosts; }
  /// Made on first use.
  static const CellClasses& classes(const PeriodicTriangulation& t) { return impl_of(t).classes(); }
};

}  // namespace delone::periodic
