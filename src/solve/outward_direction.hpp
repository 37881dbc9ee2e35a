// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <vector>

namespace delone::solve {

/// The unit vector orthogonal to the flat of `facet` (k points), within the flat that `facet` and `behind`
/// span, pointing away from `behind`. Gram–Schmidt, or integers where that cancels more than a few bits. The
/// relative error is below 10⁻¹².
std::vector<double> outward_direction(const std::vector<const double*>& facet, const double* behind,
                                      std::size_t dimension);

}  // namespace delone::solve
