// SPDX-License-Identifier: BSD-3-Clause
// Point sets that are hard on purpose: flat in every dimension, full of ties, one unit in the last place away
// from either, or at the ends of the exponent range. Degeneracy is built here, not hoped for. Reproducible
// from their arguments.
#pragma once

#include <delone/point_sets.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace delone::test {

/// splitmix64: the same numbers on every platform.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  /// Uniform in low…high, both included.
  int integer(int low, int high) {
    return low + static_cast<int>(bits() % static_cast<std::uint64_t>(high - low + 1));
  }
  /// Uniform in [0, 1).
  double real() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

 private:
  std::uint64_t state_;
};

struct PointSet {
  std::string name;
  int dimension;
  std::vector<double> points;
  std::size_t size() const { return points.size() / static_cast<std::size_t>(dimension); }
};

/// The rows in the given order.
inline std::vector<double> reordered(const std::vector<double>& points, int dimension,
                                     const std::vector<std::size_t>& order) {
  std::vector<double> result;
  const auto d = static_cast<std::size_t>(dimension);
  for (const std::size_t row : order)
    for (std::size_t j = 0; j < d; ++j) result.push_back(points[row * d + j]);
  return result;
}

inline std::vector<std::size_t> random_order(std::size_t n, std::uint64_t seed) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  Random random(seed);
  for (std::size_t i = n; i > 1; --i) std::swap(order[i - 1], order[random.bits() % i]);
  return order;
}

inline PointSet permuted(PointSet set, std::uint64_t seed) {
  set.points = reordered(set.points, set.dimension, random_order(set.size(), seed));
  return set;
}

/// n rows drawn from the set (all, shuffled, if it has no more).
inline PointSet sampled(PointSet set, std::size_t n, std::uint64_t seed) {
  auto order = random_order(set.size(), seed);
  order.resize(std::min(n, order.size()));
  set.points = reordered(set.points, set.dimension, order);
  return set;
}

/// Integers in low…high: the smaller the range, the more ties, duplicates and flats.
inline PointSet small_integers(int dimension, std::size_t n, int low, int high, std::uint64_t seed) {
  PointSet set{"integers", dimension, {}};
  Random random(seed);
  for (std::size_t i = 0; i < n * static_cast<std::size_t>(dimension); ++i)
    set.points.push_back(random.integer(low, high));
  return set;
}

/// Carries points of R^k into R^dimension. Axis-aligned: the further coordinates are constant. Tilted: they
/// are integer combinations of the k coordinates, and the axes are shuffled, so that no coordinate plane
/// holds the flat.
inline PointSet embedded(const PointSet& flat, int dimension, bool tilted, std::uint64_t seed) {
  PointSet set{flat.name + (tilted ? " tilted" : " axis-aligned") + " in a flat", dimension, {}};
  Random random(seed);
  const auto d = static_cast<std::size_t>(dimension), k = static_cast<std::size_t>(flat.dimension);
  std::vector<std::vector<int>> weight(d, std::vector<int>(k, 0));
  for (std::size_t j = 0; j < d; ++j)
    for (std::size_t i = 0; i < k; ++i) weight[j][i] = j < k ? i == j : tilted ? random.integer(-2, 2) : 0;
  std::vector<int> offset(d);
  for (int& value : offset) value = random.integer(-3, 3);
  const auto axes = tilted ? random_order(d, random.bits()) : [&] {
    std::vector<std::size_t> same(d);
    std::iota(same.begin(), same.end(), std::size_t{0});
    return same;
  }();
  for (std::size_t row = 0; row < flat.size(); ++row)
    for (std::size_t j = 0; j < d; ++j) {
      double x = offset[axes[j]];
      for (std::size_t i = 0; i < k; ++i) x += weight[axes[j]][i] * flat.points[row * k + i];
      set.points.push_back(x);
    }
  return set;
}

/// The integer lattice {0…side−1}^dimension; side 2 is the set of 0/1 vectors.
inline PointSet lattice(int dimension, int side) {
  PointSet set{"lattice " + std::to_string(side), dimension, {}};
  std::vector<int> at(static_cast<std::size_t>(dimension), 0);
  for (std::size_t j = 0; j < at.size();) {
    set.points.insert(set.points.end(), at.begin(), at.end());
    for (j = 0; j < at.size() && ++at[j] == side; ++j) at[j] = 0;
  }
  return set;
}

/// Lattice points on one sphere around the origin: all of squared norm `squared_radius` with coordinates up
/// to its root.
inline PointSet cospherical(int dimension, int squared_radius) {
  const int side = static_cast<int>(std::sqrt(squared_radius));
  PointSet set{"cospherical", dimension, {}};
  const PointSet box = lattice(dimension, 2 * side + 1);
  const auto d = static_cast<std::size_t>(dimension);
  for (std::size_t row = 0; row < box.size(); ++row) {
    double norm = 0;
    for (std::size_t j = 0; j < d; ++j)
      norm += (box.points[row * d + j] - side) * (box.points[row * d + j] - side);
    if (norm != squared_radius) continue;
    for (std::size_t j = 0; j < d; ++j) set.points.push_back(box.points[row * d + j] - side);
  }
  return set;
}

/// Every third coordinate or so moved to the next or the previous double. Zeros stay unless `zeros_too`:
/// next to them are the smallest denormals, and exact arithmetic over the whole exponent range is slow.
inline PointSet nudged(PointSet set, std::uint64_t seed, bool zeros_too = false) {
  Random random(seed);
  set.name += " nudged";
  for (double& x : set.points)
    if (const int move = random.integer(-1, 4); (move == 0 || move == 1) && (x != 0 || zeros_too))
      x = std::nextafter(x, (move == 0 ? -1 : 1) * std::numeric_limits<double>::infinity());
  return set;
}

inline PointSet shifted(PointSet set, const std::vector<double>& offset, double scale) {
  set.name += " shifted";
  for (std::size_t i = 0; i < set.points.size(); ++i)
    set.points[i] =
        offset[i % static_cast<std::size_t>(set.dimension) % offset.size()] + scale * set.points[i];
  return set;
}

inline PointSet scaled(PointSet set, double scale) {
  set.name += " scaled";
  for (double& x : set.points) x *= scale;
  return set;
}

/// Signs and few-bit mantissas at exponents from the denormals to the largest doubles, zeros among them.
inline PointSet mixed_exponents(int dimension, std::size_t n, int lowest, int highest, std::uint64_t seed) {
  PointSet set{"mixed exponents", dimension, {}};
  Random random(seed);
  for (std::size_t i = 0; i < n * static_cast<std::size_t>(dimension); ++i)
    set.points.push_back(random.integer(0, 7) == 0
                             ? 0.0
                             : std::ldexp(random.integer(-7, 7) | 1, random.integer(lowest, highest)));
  return set;
}

/// All kinds above for one dimension, each with at most n points.
inline std::vector<PointSet> degenerate_sets(int dimension, std::size_t n, std::uint64_t seed) {
  std::vector<PointSet> sets;
  std::uint64_t next = seed * 1000;
  // For numbers from one end of the exponent range to the other: each exact determinant has thousands of
  // bits.
  const std::size_t few = std::min(n, 80 / static_cast<std::size_t>(dimension));
  const auto add = [&](PointSet set) { sets.push_back(sampled(std::move(set), n, ++next)); };

  for (int k = 0; k <= dimension; ++k)
    for (const bool tilted : {false, true}) {
      if (k == dimension && tilted) continue;
      const PointSet flat =
          k == 0 ? PointSet{"point", 1, {2, 2, 2}} : sampled(lattice(k, k <= 3 ? 4 : 3), n, ++next);
      const PointSet random_flat = small_integers(std::max(k, 1), n, -4, 4, ++next);
      if (k == 0) {
        PointSet point{"one point", dimension, {}};
        for (int i = 0; i < 3 * dimension; ++i) point.points.push_back(i % dimension + 1);
        add(point);
        continue;
      }
      add(embedded(flat, dimension, tilted, ++next));
      add(embedded(random_flat, dimension, tilted, ++next));
      add(nudged(embedded(flat, dimension, tilted, seed + 7), ++next));
    }
  add(lattice(dimension, 2));
  add(sampled(nudged(lattice(dimension, 2), seed + 8, true), few, ++next));
  add(small_integers(dimension, n, 0, 1, ++next));
  add(small_integers(dimension, n, -1, 1, ++next));
  add(small_integers(dimension, n, -9, 9, ++next));
  for (const int squared_radius : {1, 3, 9}) add(cospherical(dimension, squared_radius));
  add(nudged(cospherical(dimension, 9), ++next));
  // Metres with two decimals, far from the origin as in map projections: no decimal is a double.
  add(shifted(small_integers(dimension, n, 0, 5, ++next), {448252.0, 5411932.0, 35.0}, 0.01));
  add(shifted(lattice(dimension, 3), {4.5e15, 1e8, -3e15}, 1.0));
  add(mixed_exponents(dimension, few, -1070, 990, ++next));
  add(mixed_exponents(dimension, n, -20, 20, ++next));
  add(scaled(lattice(dimension, 3), 0x1p-1074));
  add(scaled(lattice(dimension, 3), 0x1p+1020));
  add(scaled(small_integers(dimension, n, -9, 9, ++next), 1e-310));
  add(scaled(small_integers(dimension, n, -9, 9, ++next), 1e307));
  return sets;
}

}  // namespace delone::test
