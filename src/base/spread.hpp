// SPDX-License-Identifier: BSD-3-Clause
// Lists that are stored back to back, made by counting: what each list has, then where it begins.
#pragma once

#include "base/large_vector.hpp"

#include <cstddef>
#include <numeric>
#include <vector>

namespace delone::internal {

/// Spreads items over lists: list l becomes items[offsets[l]] up to items[offsets[l + 1]], in the order in
/// which its items come. `each(put)` calls put(l, item) for every item. It is called twice, and has to do the
/// same both times. Throws std::bad_alloc, and what `each` throws.
template <class Offset, class Item, class Each>
void spread(std::size_t num_lists, std::vector<Offset>& offsets, std::vector<Item>& items, const Each& each) {
  offsets.assign(num_lists + 2, 0);
  each([&](std::size_t list, const Item&) { ++offsets[list + 2]; });
  std::partial_sum(offsets.begin(), offsets.end(), offsets.begin());
  resize_large(items, static_cast<std::size_t>(offsets.back()));
  // Entry l + 1 is the place of the next item of list l, and in the end that of the first one of list l + 1.
  each([&](std::size_t list, const Item& item) {
    items[static_cast<std::size_t>(offsets[list + 1]++)] = item;
  });
  offsets.pop_back();
}

}  // namespace delone::internal
