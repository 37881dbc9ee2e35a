// SPDX-License-Identifier: BSD-3-Clause
#include "construction/landmarks.hpp"

#include "base/compiler.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delone::construction {

Landmarks::Landmarks(const geometry::Frame& frame, std::size_t dimension)
    : low_(frame.low().begin(), frame.low().begin() + static_cast<std::ptrdiff_t>(dimension)),
      table_(std::size_t{1} << log2_capacity_) {
  double half = 0;
  for (std::size_t j = 0; j < dimension; ++j) half = std::max(half, frame.high()[j] / 2 - low_[j] / 2);
  scale_ = std::min(std::ldexp(1.0, smallest) / half, std::numeric_limits<double>::max());
}

std::uint32_t Landmarks::key(const double* point, int level) const {
  constexpr double last_place = 0x1p52 - 1;
  static_assert(smallest == 52);
  std::uint64_t hash = static_cast<std::uint64_t>(level + 1) * 0xd6e8feb86659fd93u;
  for (std::size_t j = 0; j < low_.size(); ++j) {
    const double place = std::clamp((point[j] / 2 - low_[j] / 2) * scale_, 0.0, last_place);
    hash = (hash ^ static_cast<std::uint64_t>(place) >> (smallest - level)) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return static_cast<std::uint32_t>(hash);
}

Index Landmarks::find(std::uint32_t key) const {
  const std::size_t mask = table_.size() - 1;
  for (std::size_t at = home(key);; at = (at + 1) & mask)
    if (table_[at].vertex == none || table_[at].key == key) return table_[at].vertex;
}

int Landmarks::deepest(const double* point) const {
  for (int level = std::max(typical_ - 1, 0); level <= std::min(typical_ + 1, smallest); ++level)
    internal::prefetch(&table_[home(key(point, level))]);
  // The cubes around a point have vertices down to some level. Doubling steps bracket it, bisection finds it.
  int known = -1, unknown = smallest + 1;
  for (int level = typical_, step = 1; known + 1 < unknown; step *= 2) {
    (find(key(point, level)) != none ? known : unknown) = level;
    level = unknown > smallest ? std::min(known + step, smallest)
            : known < 0        ? std::max(unknown - step, 0)
                               : (known + unknown) / 2;
  }
  return known;
}

void Landmarks::put(Entry entry) {
  const std::size_t mask = table_.size() - 1;
  std::size_t at = home(entry.key);
  while (table_[at].vertex != none) at = (at + 1) & mask;
  table_[at] = entry;
}

void Landmarks::grow() {
  std::vector<Entry> entries(2 * table_.size());
  entries.swap(table_);
  ++log2_capacity_;
  for (const Entry& entry : entries)
    if (entry.vertex != none) put(entry);
}

void Landmarks::add(Index vertex, const double* point) {
  const int level = deepest(point) + 1;
  if (level > smallest || size_ == most) return;
  if (2 * (size_ + 1) > table_.size()) grow();
  put({key(point, level), vertex});
  ++size_;
  typical_ += (level > typical_) - (level < typical_);
}

}  // namespace delone::construction
