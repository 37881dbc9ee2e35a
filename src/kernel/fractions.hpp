// SPDX-License-Identifier: BSD-3-Clause
// Integers and fractions without error, where certified binary64 is not enough: doubles as multiples of a
// power of two, determinants, linear systems, and correctly rounded quotients.
#pragma once

#include <boost/multiprecision/cpp_int.hpp>

#include <cstddef>
#include <vector>

namespace delone::kernel {

using Integer =
    boost::multiprecision::number<boost::multiprecision::cpp_int_backend<>, boost::multiprecision::et_off>;

/// The largest e for which a finite x ≠ 0 is an integer multiple of 2^(2e). For 0: trailing_exponent(0).
int square_exponent(double x);

/// x·2^−grid. REQUIRES a finite x that is a multiple of 2^grid.
Integer scaled_integer(double x, int grid);

/// The double nearest to numerator/denominator·2^exponent, ties to even; ±infinity beyond the largest double,
/// never −0. REQUIRES denominator ≠ 0.
double nearest_double(Integer numerator, Integer denominator, int exponent);

/// The least double that is not below numerator/denominator·2^exponent; +infinity beyond the largest, never
/// −0. REQUIRES denominator ≠ 0.
double double_above(const Integer& numerator, const Integer& denominator, int exponent);

/// √(numerator/denominator)·2^exponent, rounded up: the least double that is not below; +infinity beyond the
/// largest. REQUIRES a fraction of at least 0.
double root_above(Integer numerator, Integer denominator, int exponent);

/// The determinant of an n×n matrix, row by row, by fraction-free elimination (Bareiss 1968,
/// doi:10.1090/S0025-5718-1968-0226829-0).
Integer exact_determinant(std::vector<Integer> a, std::size_t n);

/// The solution of A·x = b as x[j] = numerators[j]/denominator, where the denominator is det A; `augmented`
/// holds n rows of A and b. For det A = 0: no numerators, and the denominator 0.
struct Fractions {
  std::vector<Integer> numerators;
  Integer denominator;
};
Fractions solve_exactly(std::vector<Integer> augmented, std::size_t n);

}  // namespace delone::kernel
