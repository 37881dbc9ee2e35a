// SPDX-License-Identifier: BSD-3-Clause
// Which of the rows of a cone are needed, from the rays that lie on them.
#pragma once

#include "polyhedra/bit_rows.hpp"

#include <cstddef>
#include <vector>

namespace delone::polyhedra {

/// What a row x ↦ row·x ≥ 0 of a cone is to it.
enum class ConeRow : unsigned char {
  whole,      ///< all rays lie on it: an equation
  facet,      ///< the first row whose rays are those of a facet
  duplicate,  ///< the same, but not the first one
  redundant,  ///< all others
};

struct ConeRows {
  std::vector<ConeRow> kinds;
  std::vector<std::size_t> first;  ///< of a duplicate: the first row with the same rays; else itself
};

/// `zeros`: for each ray the rows that it lies on; `columns`: the same, transposed. A face is a facet iff its
/// set of rays is in no larger one but that of the whole cone, and each facet is among the rows.
ConeRows classify_rows(const BitRows& zeros, const BitRows& columns);

}  // namespace delone::polyhedra
