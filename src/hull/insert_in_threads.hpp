// SPDX-License-Identifier: BSD-3-Clause
// Insertion of many sites into the boundary of a hull by several threads.
#pragma once

#include "hull/hull_builder.hpp"

#include <cstddef>
#include <functional>
#include <span>

namespace delone::internal {

/// Inserts sites in their order, as the builder does. While many of those to come are in the interior
/// already, they are looked for before each round: walks that claim no cells are in nobody's way.
/// ConvexHullBuilder has the parameters. REQUIRES prepare_for_threads().
void insert_in_threads(ConvexHullBuilder& builder, std::span<const Index> sites,
                       std::span<const std::size_t> rounds, unsigned threads,
                       const std::function<void(std::size_t)>& tick,
                       const std::function<void(Index, Insertion)>& placed);

}  // namespace delone::internal
