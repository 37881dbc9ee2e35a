// SPDX-License-Identifier: BSD-3-Clause
// Boxes and sets of points for tests of periodic triangulations: coordinates with few bits, so that sums and
// translates are exact.
#pragma once

#include <delone/periodic.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <random>
#include <string>
#include <utility>
#include <vector>

namespace delone::test {

struct NamedLattice {
  const char* name;
  Lattice lattice;
};

/// Of rank 3 in space: cubic, oblong, triclinic, general, skewed and left-handed.
inline std::vector<NamedLattice> lattices_in_space() {
  return {{"cubic", {3, {1, 0, 0, 0, 1, 0, 0, 0, 1}}},
          {"oblong", {3, {1, 0, 0, 0, .5, 0, 0, 0, 3}}},
          {"triclinic", {3, {1, 0, 0, .25, 1, 0, -.375, .3125, 1}}},
          {"general",
           {3, {1.09375, .0703125, -.203125, .296875, .8984375, .1328125, -.2109375, .328125, 1.296875}}},
          {"skewed", {3, {1, 0, 0, 2.5, 1, 0, 1.75, -1.25, 1}}},
          {"left-handed", {3, {0, 1, 0, 1, 0, 0, .125, 0, 1}}}};
}

/// The first vectors only.
inline Lattice of_rank(const Lattice& lattice, int rank) {
  Lattice some = lattice;
  some.vectors.resize(static_cast<std::size_t>(rank * lattice.dimension));
  return some;
}

/// A multiple of 2^−24.
inline double coarse(double x) { return std::ldexp(std::nearbyint(std::ldexp(x, 24)), -24); }

/// Points by their fractions along r lattice vectors, and along axes for the rest.
inline std::vector<double> at_fractions(const std::vector<double>& fractions, const Lattice& lattice) {
  const auto d = static_cast<std::size_t>(lattice.dimension), r = static_cast<std::size_t>(lattice.rank());
  std::vector<double> points;
  for (std::size_t at = 0; at < fractions.size(); at += d)
    for (std::size_t j = 0; j < d; ++j) {
      double x = j >= r ? fractions[at + j] : 0;
      for (std::size_t i = 0; i < r; ++i) x += fractions[at + i] * lattice.vectors[i * d + j];
      points.push_back(coarse(x));
    }
  return points;
}

inline std::vector<double> random_fractions(std::size_t count, unsigned seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> fraction(0, 1);
  std::vector<double> numbers(count);
  for (double& x : numbers) x = fraction(random);
  return numbers;
}

enum class Crystal { simple, bcc, fcc, diamond };

/// m³ unit cells of a crystal, m a power of two.
inline std::vector<double> crystal_fractions(Crystal crystal, int m) {
  std::vector<std::array<double, 3>> basis{{0, 0, 0}};
  if (crystal == Crystal::bcc) basis.push_back({.5, .5, .5});
  if (crystal == Crystal::fcc || crystal == Crystal::diamond)
    basis.insert(basis.end(), {{.5, .5, 0}, {.5, 0, .5}, {0, .5, .5}});
  if (crystal == Crystal::diamond)
    basis.insert(basis.end(), {{.25, .25, .25}, {.75, .75, .25}, {.75, .25, .75}, {.25, .75, .75}});
  std::vector<double> fractions;
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
      for (int l = 0; l < m; ++l)
        for (const auto& [x, y, z] : basis) {
          fractions.push_back((i + x) / m);
          fractions.push_back((j + y) / m);
          fractions.push_back((l + z) / m);
        }
  return fractions;
}

/// Random points of small numbers, and crystals of one and of eight unit cells, as fractions.
inline std::vector<std::pair<std::string, std::vector<double>>> sets_in_space(std::size_t most_points) {
  std::vector<std::pair<std::string, std::vector<double>>> sets;
  for (const std::size_t n : {std::size_t{1}, std::size_t{2}, std::size_t{3}, std::size_t{4}, std::size_t{5},
                              std::size_t{100}, std::size_t{1000}})
    if (n <= most_points)
      sets.emplace_back(std::to_string(n) + " random points",
                        random_fractions(3 * n, static_cast<unsigned>(n)));
  constexpr const char* names[] = {"simple", "bcc", "fcc", "diamond"};
  for (int crystal = 0; crystal < 4; ++crystal)
    for (const int m : {1, 2, 4}) {
      std::vector<double> fractions = crystal_fractions(static_cast<Crystal>(crystal), m);
      if (fractions.size() / 3 <= most_points)
        sets.emplace_back(std::string(names[crystal]) + " " + std::to_string(m), std::move(fractions));
    }
  return sets;
}

}  // namespace delone::test
