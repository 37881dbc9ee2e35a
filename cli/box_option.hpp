// SPDX-License-Identifier: BSD-3-Clause
// --box, the box that regions are clipped to.
#pragma once

#include <delone/data.hpp>

#include <optional>
#include <vector>

namespace delone::cli {

/// The box of --box, all lower limits and then all upper ones; none if there are no numbers. Checked before
/// the work: throws UsageError.
std::optional<Box> chosen_box(const std::vector<double>& limits, int dimension);

}  // namespace delone::cli
