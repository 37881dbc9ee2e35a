// SPDX-License-Identifier: BSD-3-Clause
// How fast this machine is.
#pragma once

namespace delone::cost_model {

/// Nanoseconds of processor time per created cell of a small set of points that are spread evenly in space:
/// the least of a few runs, some 30 milliseconds in all, at the first call of a process. Compare
/// reference_nanoseconds().
double machine_nanoseconds();

}  // namespace delone::cost_model
