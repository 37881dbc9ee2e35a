// SPDX-License-Identifier: BSD-3-Clause
// Functionals of cells in hyperplanes that are known: those of coordinates, and those of other cells.
#pragma once

#include "cells/cell_memory.hpp"
#include "geometry/certificate.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <bit>
#include <cmath>

namespace delone::geometry {

/// Writes the functional h = 1 + g·X, not lifted, of a cell of which all vertices have the same entry t on
/// axis r, given the image of t. Returns false, and does nothing, if the hyperplane is too near the centre.
///
/// It is h = 1 − X_r/t. Both images have one rounding, the quotient and its product with X_r another one
/// each, and the sum a last one; so h̃ is off by less than 6·2^−53·(1 + |g_r|) where |X_r| ≤ 1. What underflow
/// takes from an image is below 2^−1074, and |g_r| below 2^100. No determinant is known.
template <int K>
bool write_coordinate_functional(cells::CellMemory<K>& memory, Index cell, int r, double image) {
  const double g = -1 / image;
  if (!(std::fabs(g) < 0x1p100)) return false;
  double* const functional = memory.records().functional(cell);
  std::fill_n(functional, memory.layout().num_coefficients(), 0.0);
  functional[r] = g;
  const double error = 6 * 0x1p-53 * (1 + std::fabs(g));
  *memory.records().certificate(cell) = std::bit_cast<double>(certificate::pack(error, error, 0, false));
  return true;
}

/// Copies the functional, not lifted, of a cell in the same hyperplane. Its threshold bounds errors
/// everywhere in the box. No determinant is known.
template <int K>
void copy_functional(cells::CellMemory<K>& memory, Index cell, Index from) {
  const auto records = memory.records();
  std::copy_n(records.functional(from), memory.layout().num_coefficients(), records.functional(cell));
  const double threshold = certificate::threshold(std::bit_cast<std::uint64_t>(*records.certificate(from)));
  *records.certificate(cell) = std::bit_cast<double>(certificate::pack(threshold, threshold, 0, false));
}

}  // namespace delone::geometry
