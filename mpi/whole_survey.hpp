// SPDX-License-Identifier: BSD-3-Clause
// The survey of the points of all ranks.
#pragma once

#include "periodic/extent.hpp"
#include "periodic/periodic_set.hpp"
#include "ranks.hpp"
#include "share.hpp"
#include "tiles/making/periodic_input.hpp"
#include "tiles/survey.hpp"

#include <delone/tiles.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>

namespace delone::mpi {

/// What is known of a periodic set, the same on all ranks.
struct WholePeriod {
  explicit WholePeriod(periodic::PeriodicSet given) : set(std::move(given)), extent(set) {}
  WholePeriod(const WholePeriod&) = delete;
  WholePeriod& operator=(const WholePeriod&) = delete;

  periodic::PeriodicSet set;
  periodic::Extent extent;  ///< its frame may have rows and weights of other points of equal positions
  int finest_bit = 0;       ///< of lattice and points
};

struct WholeSurvey {
  /// The same on all ranks. Landmarks may be repeated by other rows that come first; their rows are not set.
  tiles::SurveyResult result;
  std::int64_t first_row = 0;  ///< the number of rows of the ranks before this one
  /// What tells the points, in their order, from others, however they are shared among ranks.
  std::string fingerprint;
  std::unique_ptr<WholePeriod> period;                 ///< of a periodic set
  std::unique_ptr<tiles::PlacedPoints> placed_points;  ///< the same: those of the share, in the box
};

/// Collective. Throws as tiles::make_survey(), bad_dimension if ranks have rows of different lengths; with a
/// lattice as PeriodicDelaunay, and unsupported if too many translations have to be looked at.
WholeSurvey survey_whole(Share& share, const TilesOptions& options, const Ranks& ranks);

}  // namespace delone::mpi
