// SPDX-License-Identifier: BSD-3-Clause
#include "base/require_dimension.hpp"

#include <delone/error.hpp>

#include <string>

namespace delone::internal {

void require_dimension(int dimension) {
  if (dimension < 1) throw Error(Errc::bad_dimension, "the dimension must be at least 1");
  if (dimension > largest_dimension)
    throw Error(Errc::bad_dimension, "the dimension is " + std::to_string(dimension) + "; the largest is " +
                                         std::to_string(largest_dimension));
}

}  // namespace delone::internal
