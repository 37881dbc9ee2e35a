// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/duplicates.hpp"

#include "complex/canonical_hash.hpp"
#include "pages/page_order.hpp"

#include <algorithm>
#include <bit>
#include <limits>

namespace delone::tiles {

using pages::row_of;

std::vector<Duplicate> take_duplicates(std::vector<double>& records, std::size_t row_size) {
  const std::size_t record_size = row_size + 1, n = records.size() / record_size;
  // Places of records that were kept, by hash, in a table that is at most half full.
  using Place = std::uint32_t;
  constexpr Place none = std::numeric_limits<Place>::max();
  std::vector<Place> table(std::bit_ceil(2 * n + 1), none);
  const std::size_t mask = table.size() - 1;
  std::vector<Duplicate> duplicates;  // first_row is a place until the end
  std::size_t kept = 0;
  for (std::size_t i = 0; i < n; ++i) {
    double* const record = records.data() + i * record_size;
    std::size_t at = complex::point_tag(record, static_cast<int>(row_size)).low & mask;
    const auto kept_record = [&] { return records.data() + std::size_t{table[at]} * record_size; };
    while (table[at] != none && !std::equal(record, record + row_size, kept_record())) at = (at + 1) & mask;
    if (table[at] == none) {
      table[at] = static_cast<Place>(kept);
      std::copy_n(record, record_size, records.data() + kept++ * record_size);
      continue;
    }
    double& first_row = kept_record()[row_size];
    if (row_of(record[row_size]) < row_of(first_row)) std::swap(record[row_size], first_row);
    duplicates.push_back({row_of(record[row_size]), table[at]});
  }
  records.resize(kept * record_size);
  for (Duplicate& duplicate : duplicates)
    duplicate.first_row =
        row_of(records[static_cast<std::size_t>(duplicate.first_row) * record_size + row_size]);
  return duplicates;
}

}  // namespace delone::tiles
