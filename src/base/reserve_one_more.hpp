// SPDX-License-Identifier: BSD-3-Clause
// Room for what is added later, when nothing may fail any more.
#pragma once

#include <vector>

namespace delone::internal {

/// Makes sure that one push_back cannot fail, growing geometrically.
template <class T>
void reserve_one_more(std::vector<T>& items) {
  if (items.size() == items.capacity()) items.reserve(2 * items.size() + 2);
}

}  // namespace delone::internal
