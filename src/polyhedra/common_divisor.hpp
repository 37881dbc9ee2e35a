// SPDX-License-Identifier: BSD-3-Clause
// Greatest common divisors of integers of 128 bits and of any size.
#pragma once

#include "kernel/fractions.hpp"
#include "kernel/int128.hpp"

namespace delone::polyhedra {

using kernel::Int128;
using kernel::Integer;

/// Of numbers ≥ 0.
Int128 common_divisor(Int128 a, Int128 b);
/// Of numbers of any sign; not negative.
Integer common_divisor(Integer a, Integer b);

}  // namespace delone::polyhedra
