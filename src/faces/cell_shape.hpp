// SPDX-License-Identifier: BSD-3-Clause
// Numbers that tell the shape of one simplex, with relative errors below 10⁻¹⁰.
#pragma once

#include <cstddef>

namespace delone::internal {

/// The sum of 1/h over the heights h of a simplex with `corners` ≥ 2 affinely independent vertices: one over
/// the radius of its inscribed sphere.
double sum_of_inverse_heights(const double* const* points, std::size_t corners, std::size_t dimension);

/// QualityMeasure::mean_ratio.
double mean_ratio(const double* const* points, std::size_t corners, std::size_t dimension);

/// The length of the shortest edge.
double shortest_edge(const double* const* points, std::size_t corners, std::size_t dimension);

}  // namespace delone::internal
