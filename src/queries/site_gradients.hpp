// SPDX-License-Identifier: BSD-3-Clause
// Gradients at vertices, estimated from the values at their neighbors.
#pragma once

#include "queries/natural_search.hpp"

#include <cstddef>
#include <span>
#include <vector>

namespace delone::queries {

/// The vector g of least length of those that minimise Σ w·(Δ − g·r)² over `weights`, rows of `columns`
/// differences Δ, and rows r of d numbers; columns×d numbers. Directions in which the weighted r have less
/// than 2^−40 of their extent in another do not count. Returns in how many directions they have at least
/// 2^−10 of the largest extent.
std::size_t fit_gradients(std::span<const double> weights, std::span<const double> differences,
                          std::size_t columns, std::span<const double> rows, std::size_t d, double* result);

/// Estimates the gradients at one vertex from `values`, `columns` numbers by vertex id; see
/// NaturalNeighborInterpolator.
void estimate_gradients(const NaturalCenters& centers, VertexId v, std::span<const double> values,
                        std::size_t columns, double* result);

}  // namespace delone::queries
