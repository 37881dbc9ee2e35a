// SPDX-License-Identifier: BSD-3-Clause
// What follows from a finished boundary: faces, kinds of points, measures and the arrays of HullData. Each is
// computed on first use. `const` members are safe to call from several threads at once.
#pragma once

#include "base/axis_scale.hpp"
#include "hull/hull_faces.hpp"
#include "hull/hull_locator.hpp"
#include "hull/hull_measure.hpp"
#include "hull/hull_state.hpp"

#include <delone/convex_hull.hpp>

#include <array>
#include <cstddef>
#include <mutex>
#include <optional>
#include <vector>

namespace delone::hull {

/// A value computed on first use, by one thread. If `make` throws, the next call tries again.
template <class T>
class Lazy {
 public:
  template <class Make>
  const T& get(Make make) const {
    const std::lock_guard lock(mutex_);
    if (!value_) value_.emplace(make());
    return *value_;
  }

 private:
  mutable std::mutex mutex_;
  mutable std::optional<T> value_;
};

/// What a hull with a tolerance promises; 0 for exact ones.
struct HullTolerance {
  internal::AxisScale scale;  ///< with the tolerance, of facets, too
  double max_distance = 0;    ///< of the points, where axes are scaled
};

class HullAnalysis {
 public:
  /// The state must outlive this object and must not change. `threads`: as Options::threads.
  explicit HullAnalysis(const HullState& state, const HullTolerance& tolerance = {}, unsigned threads = 1);

  /// Empty for k < 1.
  const std::optional<HullLocator>& locator() const { return locator_; }
  const PolytopeFaces& faces() const;
  /// By site. REQUIRES k ≥ 1.
  std::vector<char> are_extreme() const;
  const Lists& facet_sites() const;
  std::size_t num_ridges() const;
  /// By row.
  const std::vector<PointKind>& kinds() const;
  std::size_t count(PointKind kind) const;
  /// The same for extreme points, without the kinds of the others.
  std::size_t num_extreme() const;
  const HullMeasures& measures() const;
  const HullData& data() const;
  /// Made at each call.
  HullCells cells() const;
  /// Of the facets. Computed at each call. `measures`: if not null, set to measures(), which costs less
  /// together; not with a tolerance.
  FacetEquations equations(HullMeasures* measures = nullptr) const;

 private:
  std::vector<SignedIndex> rows_of(const std::vector<Index>& sites) const;
  std::vector<PointKind> find_kinds() const;
  HullData make_data() const;

  const HullState& state_;
  HullTolerance tolerance_;
  unsigned threads_;
  std::optional<HullLocator> locator_;
  Lazy<PolytopeFaces> faces_;
  Lazy<Lists> facet_sites_;
  Lazy<std::size_t> num_ridges_;
  Lazy<std::vector<PointKind>> kinds_;
  Lazy<std::array<std::size_t, 4>> counts_;
  Lazy<HullMeasures> measures_;
  Lazy<HullData> data_;
};

}  // namespace delone::hull
