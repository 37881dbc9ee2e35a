// SPDX-License-Identifier: BSD-3-Clause
// Between the rational numbers of the interface and integers.
#pragma once

#include "polyhedra/integer_rows.hpp"

#include <delone/rational.hpp>

#include <span>

namespace delone::polyhedra {

/// A numerator and a denominator, which is positive.
struct Fraction {
  Integer numerator, denominator = 1;

  static Fraction of(const Rational& x);
  /// In lowest terms. REQUIRES a denominator that is not 0.
  static Rational to_rational(Integer numerator, Integer denominator = 1);
};

/// The numbers times their least common denominator, followed by that.
Row common_integers(std::span<const Rational> numbers);

}  // namespace delone::polyhedra
