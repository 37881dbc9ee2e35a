// SPDX-License-Identifier: BSD-3-Clause
// Points of a tile that are there more than once: pages hold each point once, under its first row.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::tiles {

/// A row of the input that repeats an earlier one.
struct Duplicate {
  std::int64_t row = 0, first_row = 0;
};

/// Takes records that repeat another one out, and returns their rows. A record is a point, its weight if it
/// has one, and its coded row (page_order.hpp); its point, weight included, is what is compared, with −0 = 0.
/// Of equal records the one of the smallest row stays. The order of the others does not change. O(n).
std::vector<Duplicate> take_duplicates(std::vector<double>& records, std::size_t row_size);

}  // namespace delone::tiles
