// SPDX-License-Identifier: BSD-3-Clause
// What an edit is asked to do.
#pragma once

#include "construction/state.hpp"

#include <cstddef>
#include <span>

namespace delone::construction {

/// An Edit of any D: coordinates one after the other.
struct RowEdits {
  std::span<const std::size_t> remove = {}, move = {}, reweight = {};
  std::span<const double> to = {}, weights = {}, insert = {}, insert_weights = {};
  bool is_empty() const {
    return remove.empty() && move.empty() && reweight.empty() && to.empty() && weights.empty() &&
           insert.empty() && insert_weights.empty();
  }
};

/// Throws unless lists that belong together have one length, rows are there, none is given twice or both
/// removed and changed, and numbers are finite. Messages name the list, the place in it and the row.
void require_valid(const State& state, const RowEdits& edits);

}  // namespace delone::construction
