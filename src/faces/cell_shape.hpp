// SPDX-License-Identifier: BSD-3-Clause
// The qualities of one simplex with `corners` ≥ 2 affinely independent vertices, with relative errors below
// 10⁻⁹: from binary64 or pairs of doubles where bounds allow, otherwise from integers, in which the unit of
// the coordinates cancels. So neither large nor small coordinates do harm; only a ratio that is itself below
// the normal numbers may become 0, and one beyond the range of doubles is +infinity.
#pragma once

#include <cstddef>

namespace delone::internal {

/// What a quality was found from.
enum class ShapeStage : unsigned char { binary64, pairs, integers };

/// QualityMeasure::radius_ratio. `radius`: of the circumscribed sphere, as circumradii() has it. Sets *stage,
/// if that is given.
double radius_ratio(const double* const* points, std::size_t corners, std::size_t dimension, double radius,
                    ShapeStage* stage = nullptr);

/// QualityMeasure::mean_ratio.
double mean_ratio(const double* const* points, std::size_t corners, std::size_t dimension,
                  ShapeStage* stage = nullptr);

/// QualityMeasure::radius_edge_ratio.
double radius_edge_ratio(const double* const* points, std::size_t corners, std::size_t dimension,
                         double radius);

}  // namespace delone::internal
