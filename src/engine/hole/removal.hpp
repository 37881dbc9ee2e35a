// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace delone::engine {

/// What has become of a vertex that was to be removed. Nothing has changed unless it is `taken_out`.
enum class Removal {
  taken_out,
  flat,   ///< all other vertices lie in a hyperplane
  large,  ///< so many cells would fill its place that building all anew costs less
};

}  // namespace delone::engine
