// SPDX-License-Identifier: BSD-3-Clause
// Changes of neighbors as arrays.
#pragma once

#include "arrays.hpp"

#include <delone/neighbor_changes.hpp>

#include <utility>

namespace delone::python {

/// With the GIL: the pairs that began and those that ended, and the offsets of both.
inline py::tuple as_tuple(NeighborChanges&& changes) {
  const std::size_t began = changes.num_began(), ended = changes.num_ended(),
                    rank = static_cast<std::size_t>(changes.rank);
  return py::make_tuple(rows_view(std::move(changes.began), began, std::size_t{2}),
                        rows_view(std::move(changes.ended), ended, std::size_t{2}),
                        rows_view(std::move(changes.began_offsets), began, rank),
                        rows_view(std::move(changes.ended_offsets), ended, rank));
}

}  // namespace delone::python
