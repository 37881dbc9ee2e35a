// SPDX-License-Identifier: BSD-3-Clause
// The canonical orders of inequalities and of generators.
#pragma once

#include "polyhedra/integer_rows.hpp"

#include <cstddef>
#include <vector>

namespace delone::polyhedra {

/// Sorts inequalities a·x ≤ b, which rows (−a, b) stand for, by (a, b). Returns the numbers that they had.
/// `threads`: as Options::threads.
std::vector<std::size_t> sort_inequalities(Rows& rows, unsigned threads);

/// Sorts vertices by their coordinates, and behind them rays by theirs. Returns the same.
std::vector<std::size_t> sort_generators(Rows& rows, unsigned threads);

}  // namespace delone::polyhedra
