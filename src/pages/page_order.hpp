// SPDX-License-Identifier: BSD-3-Clause
// The points of a tile in the order of a k-d tree, cut into pages.
#pragma once

#include "pages/pages.hpp"

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace delone::pages {

/// Points and their rows in one array: d coordinates, the weight if there is one, and the bits of the row.
/// Rows are far below 2^52, so that none reads as a NaN.
inline double coded_row(std::int64_t row) { return std::bit_cast<double>(row); }
inline std::int64_t row_of(double coded) { return std::bit_cast<std::int64_t>(coded); }

/// The page of these records.
std::shared_ptr<const Page> page_of_records(std::span<const double> records, std::size_t row_size);

/// Enough for about a million pages, 64 at least.
std::size_t points_per_page(std::uint64_t num_points);

/// Puts the records of a tile in the order of a k-d tree and appends its pages, of at most `page_points`
/// points each, and the tile itself to the table, of which first_point has to be set up: {0} before the first
/// tile. Which points are on a page does not depend on the order of the
/// records. The box of the tile is left to the caller. O(n log n).
void order_pages(std::vector<double>& records, std::size_t page_points, PageTable& table);

}  // namespace delone::pages
