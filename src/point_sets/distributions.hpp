// SPDX-License-Identifier: BSD-3-Clause
// Random variables made of + − × ÷ √ and comparisons only, so that IEEE arithmetic gives the same bits
// everywhere: no logarithm, no sine of a mathematics library, whose last bits differ from platform to
// platform.
#pragma once

#include "point_sets/generator.hpp"

#include <span>

namespace delone::point_sets {

/// True with probability exp(−t). REQUIRES 0 ≤ t ≤ 1. (von Neumann 1951: the parity of a decreasing run below
/// t.)
bool bernoulli_exp(double t, Generator& generator);

/// A standard normal variable: Karney 2016, "Sampling exactly from the normal distribution",
/// doi:10.1145/2710016, algorithm N, with uniform variables of 53 bits.
double normal(Generator& generator);

/// sin(π x) for 0 ≤ x ≤ 1, to about two units in the last place.
double sin_pi(double x);

/// A uniformly random direction: |x| = 1 up to rounding. In R^1: ±1.
void random_direction(std::span<double> x, Generator& generator);

/// A uniformly random point of the unit ball.
void random_in_ball(std::span<double> x, Generator& generator);

}  // namespace delone::point_sets
