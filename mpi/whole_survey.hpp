// SPDX-License-Identifier: BSD-3-Clause
// The survey of the points of all ranks.
#pragma once

#include "ranks.hpp"
#include "share.hpp"
#include "tiles/survey.hpp"

#include <cstdint>
#include <string>

namespace delone::mpi {

struct WholeSurvey {
  /// The same on all ranks. Landmarks may be repeated by other rows that come first; their rows are not set.
  tiles::SurveyResult result;
  std::int64_t first_row = 0;  ///< the number of rows of the ranks before this one
  /// What tells the points, in their order, from others, however they are shared among ranks.
  std::string fingerprint;
};

/// Collective. Throws as tiles::make_survey(), and bad_dimension if ranks have rows of different lengths.
WholeSurvey survey_whole(Share& share, bool weighted, const Ranks& ranks);

}  // namespace delone::mpi
