// SPDX-License-Identifier: BSD-3-Clause
// When a forecast is a reason for a warning.
#pragma once

#include <delone/forecast.hpp>

#include <cstddef>
#include <string>

namespace delone::cost_model {

/// Whether points of a number are worth an estimate: were they spread evenly, they would take a quarter of
/// the bytes available, or more. Nanoseconds for few points, and then no file is read.
bool may_exceed(int dimension, std::size_t num_points, double (*available)());

/// delone::memory_warning() with so many bytes available; 0: not known.
std::string memory_warning(const Forecast& forecast, double available);

}  // namespace delone::cost_model
