// SPDX-License-Identifier: BSD-3-Clause
// Point sets drawn from continuous distributions, and the scales of real data that go with them.
#include "point_sets/distributions.hpp"
#include "point_sets/kinds.hpp"

#include <bit>
#include <cmath>
#include <span>

namespace delone::point_sets {
namespace {

std::span<double> row(Coordinates& x, std::size_t d, std::size_t i) { return {x.data() + i * d, d}; }

}  // namespace

Coordinates make_uniform(std::size_t d, std::size_t n, Generator& generator) {
  Coordinates x(n * d);
  for (double& v : x) v = generator.uniform();
  return x;
}

Coordinates make_ball(std::size_t d, std::size_t n, Generator& generator) {
  Coordinates x(n * d);
  for (std::size_t i = 0; i < n; ++i) random_in_ball(row(x, d, i), generator);
  return x;
}

Coordinates make_sphere(std::size_t d, std::size_t n, Generator& generator) {
  Coordinates x(n * d);
  for (std::size_t i = 0; i < n; ++i) random_direction(row(x, d, i), generator);
  return x;
}

Coordinates make_gaussian(std::size_t d, std::size_t n, Generator& generator) {
  Coordinates x(n * d);
  for (double& v : x) v = normal(generator);
  return x;
}

Coordinates make_clusters(std::size_t d, std::size_t n, Generator& generator) {
  // About √n/8 normal clusters around uniform centers, of five widths from 0.02 down to 0.00125.
  const auto num_clusters = static_cast<std::size_t>(std::sqrt(static_cast<double>(n)) / 8) + 1;
  const Coordinates centers = make_uniform(d, num_clusters, generator);
  std::vector<double> widths(num_clusters);
  for (double& w : widths) w = 0.02 / static_cast<double>(std::uint64_t{1} << generator.below(5));
  Coordinates x(n * d);
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t c = generator.below(num_clusters);
    for (std::size_t j = 0; j < d; ++j) x[i * d + j] = centers[c * d + j] + widths[c] * normal(generator);
  }
  return x;
}

Coordinates make_manifold(std::size_t d, std::size_t n, Generator& generator) {
  Coordinates x = make_uniform(d, n, generator);
  if (d > 1)
    for (std::size_t i = 0; i < n; ++i) x[i * d + d - 1] = sin_pi(x[i * d]);
  return x;
}

Coordinates make_moment(std::size_t d, std::size_t n, Generator& generator) {
  Coordinates x(n * d);
  for (std::size_t i = 0; i < n; ++i) {
    const double t = generator.uniform();
    double power = 1;
    for (double& v : row(x, d, i)) v = power *= t;
  }
  return x;
}

Coordinates make_plummer(std::size_t d, std::size_t n, Generator& generator) {
  // Mass within radius r ∝ s^d with s = r/√(1+r²): a point of the unit ball at radius s goes to r =
  // s/√(1−s²). For d = 3 this is the Plummer sphere with scale length 1; for d = 6 positions and velocities
  // of its equilibrium (G = M = 1), speeds by rejection from q²(1−q²)^(7/2) (Aarseth, Hénon, Wielen 1974).
  const bool phase_space = d == 6;
  const std::size_t positions = phase_space ? 3 : d;
  Coordinates x(n * d);
  for (std::size_t i = 0; i < n; ++i) {
    const std::span<double> position = row(x, d, i).first(positions);
    double squares = 1;
    while (squares >= 1) {
      random_in_ball(position, generator);
      squares = 0;
      for (double v : position) squares += v * v;
    }
    const double stretch = 1 / std::sqrt(1 - squares);
    for (double& v : position) v *= stretch;
    if (!phase_space) continue;
    double q = 0, density = 0;
    do {
      q = generator.uniform();
      const double rest = 1 - q * q;
      density = q * q * rest * rest * rest * std::sqrt(rest);
    } while (density <= 0.1 * generator.uniform());                  // the density is at most 0.0923
    const double speed = q * std::sqrt(2 * std::sqrt(1 - squares));  // escape speed √2 (1+r²)^(−1/4)
    random_direction(row(x, d, i).subspan(3), generator);
    for (double& v : row(x, d, i).subspan(3)) v *= speed;
  }
  return x;
}

Coordinates make_offset(std::size_t d, std::size_t n, Generator& generator) {
  // Decimal values as a file would hold them: the quotient is the double nearest to the decimal number.
  Coordinates x(n * d);
  for (double& v : x) v = static_cast<double>(std::uint64_t{4000000000} + generator.below(1000000)) / 1000;
  return x;
}

Coordinates make_mixed_scales(std::size_t d, std::size_t n, Generator& generator) {
  constexpr std::uint64_t bias = 1023, lowest = bias - 997, highest = bias + 498;  // 10^−300 and 10^150
  Coordinates x(n * d);
  for (double& v : x) {
    const bool denormal = generator.below(16) == 0;
    const std::uint64_t exponent = denormal ? 0 : lowest + generator.below(highest - lowest);
    const std::uint64_t random_bits = generator.bits();
    const std::uint64_t sign = random_bits >> 63 << 63, mantissa = random_bits & 0xfffffffffffffu;
    v = std::bit_cast<double>(sign | exponent << 52 | mantissa);
  }
  return x;
}

}  // namespace delone::point_sets
