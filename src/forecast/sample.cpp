// SPDX-License-Identifier: BSD-3-Clause
#include "forecast/sample.hpp"

#include "base/progress_meter.hpp"
#include "complex/canonical_hash.hpp"

#include <algorithm>
#include <limits>

namespace delone::cost_model {
namespace {

struct TaggedRow {
  std::uint64_t tag;
  std::size_t row;
  friend bool operator<(const TaggedRow& a, const TaggedRow& b) {
    return a.tag != b.tag ? a.tag < b.tag : a.row < b.row;
  }
};

/// Of rows with equal hashes, the first.
void distinct_only(std::vector<TaggedRow>& tagged) {
  std::sort(tagged.begin(), tagged.end());
  tagged.erase(std::unique(tagged.begin(), tagged.end(),
                           [](const TaggedRow& a, const TaggedRow& b) { return a.tag == b.tag; }),
               tagged.end());
}

}  // namespace

Sample sample_of(std::span<const double> coordinates, int dimension, std::size_t most) {
  const auto d = static_cast<std::size_t>(dimension);
  const std::size_t n = coordinates.size() / d;
  const auto tags_below = [&](std::uint64_t bound) {
    std::vector<TaggedRow> tagged;
    for (std::size_t row = 0; row < n; ++row) {
      if (row % 1024 == 0) internal::cancellation_point();
      const std::uint64_t tag = complex::point_tag(coordinates.data() + row * d, dimension).high;
      if (tag <= bound) tagged.push_back({tag, row});
    }
    return tagged;
  };
  // Hashes are spread evenly: this part of them is below the bound.
  double share = n <= most ? 1.0 : static_cast<double>(most) / static_cast<double>(n);
  constexpr std::uint64_t all = std::numeric_limits<std::uint64_t>::max();
  std::vector<TaggedRow> tagged = tags_below(n <= most ? all : static_cast<std::uint64_t>(share * 0x1p64));
  distinct_only(tagged);
  if (share < 1 && tagged.size() < most / 64) {  // nearly all rows are duplicates
    share = 1;
    tagged = tags_below(all);
    distinct_only(tagged);
  }
  Sample sample;
  for (const TaggedRow& entry : tagged) sample.rows.push_back(entry.row);
  sample.is_all = share == 1;
  sample.num_distinct = static_cast<double>(tagged.size()) / share;
  return sample;
}

}  // namespace delone::cost_model
