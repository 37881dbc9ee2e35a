// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <chrono>

namespace delone::platform {

/// The time in steps of some milliseconds, where the system has that; for nanoseconds on any machine, while
/// the exact time takes up to a microsecond on some virtual ones.
std::chrono::steady_clock::time_point coarse_now();

}  // namespace delone::platform
