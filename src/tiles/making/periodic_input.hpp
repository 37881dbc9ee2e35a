// SPDX-License-Identifier: BSD-3-Clause
// The points of a periodic set, read one after the other: each on the grid of the set and in the box of its
// lattice. And what is known of all of them before the first tile.
#pragma once

#include "periodic/extent.hpp"
#include "periodic/periodic_set.hpp"
#include "tiles/point_stream.hpp"
#include "tiles/survey.hpp"

#include <delone/periodic.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

namespace delone::tiles {

/// Reads the points once if the lattice has less than d vectors. Throws as PeriodicTriangulation.
periodic::PeriodicSet make_set(PointStream& points, bool weighted, const Lattice& lattice);

/// The lattice on its grid, in the numbers of the caller.
Lattice lattice_of(const periodic::PeriodicSet& set);

/// The points of another stream as numbers of a set. Both outlive the object.
class PlacedPoints final : public PointStream {
 public:
  PlacedPoints(PointStream& points, const periodic::PeriodicSet& set) : points_(points), set_(set) {}

  int dimension() const override { return points_.dimension(); }
  std::optional<std::uint64_t> size_hint() const override { return points_.size_hint(); }
  bool next(std::vector<double>& rows) override;
  void rewind() override;

  /// Sees each point that is read, and its row.
  std::function<void(const double*, std::int64_t)> observer;

 private:
  PointStream& points_;
  const periodic::PeriodicSet& set_;
  std::uint64_t num_read_ = 0;
};

struct PeriodicSurvey {
  SurveyResult result;
  periodic::Extent extent;
  int finest_bit;  ///< of lattice and points, for periodic_hash.hpp
};

/// As make_survey(): the affine dimension is that of all translates, and along the lattice the box of the
/// survey has no ends.
PeriodicSurvey make_periodic_survey(PlacedPoints& points, const periodic::PeriodicSet& set);

}  // namespace delone::tiles
