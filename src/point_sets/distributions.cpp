// SPDX-License-Identifier: BSD-3-Clause
// Normal variables, directions and balls by rejection, and the sine by its series.
#include "point_sets/distributions.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace delone::point_sets {

bool bernoulli_exp(double t, Generator& generator) {
  // P(a run t > u_1 > … of length ≥ m) = t^m/m!, so an even length has probability Σ (−t)^m/m!.
  bool even = true;
  for (double previous = t;;) {
    const double u = generator.uniform();
    if (u >= previous) return even;
    previous = u;
    even = !even;
  }
}

double normal(Generator& generator) {
  for (;;) {
    // k ≥ 0 with probability ∝ exp(−k²/2), as exp(−k/2)·exp(−1/2)^(k(k−1)).
    int k = 0;
    while (bernoulli_exp(0.5, generator)) ++k;
    bool accept = true;
    for (int i = 0; i < k * (k - 1) && accept; ++i) accept = bernoulli_exp(0.5, generator);
    if (!accept) continue;
    // x in [0, 1) with density ∝ exp(−x(2k+x)/2), in k+1 equal factors.
    const double x = generator.uniform();
    for (int i = 0; i <= k && accept; ++i) accept = bernoulli_exp(x * (2 * k + x) / (2 * k + 2), generator);
    if (!accept) continue;
    const double y = k + x;
    return generator.coin() ? y : -y;
  }
}

double sin_pi(double x) {
  constexpr double pi = 3.14159265358979323846;
  const double t = pi * (x <= 0.5 ? x : 1 - x);
  // |t| ≤ π/2: the term of degree 25 is below 6e-21. Horner from the smallest term.
  double sum = 0;
  for (int degree = 23; degree >= 3; degree -= 2) sum = (1 + sum) * (-(t * t) / (degree * (degree - 1)));
  return t + t * sum;
}

void random_direction(std::span<double> x, Generator& generator) {
  double squares = 0;
  while (squares == 0) {
    for (double& v : x) {
      v = normal(generator);
      squares += v * v;
    }
  }
  const double norm = std::sqrt(squares);
  for (double& v : x) v /= norm;
}

void random_in_ball(std::span<double> x, Generator& generator) {
  random_direction(x, generator);
  // The largest of d uniform variables has the distribution of the radius, P(≤ r) = r^d.
  double radius = 0;
  for (std::size_t i = 0; i < x.size(); ++i) radius = std::max(radius, generator.uniform());
  for (double& v : x) v *= radius;
}

}  // namespace delone::point_sets
