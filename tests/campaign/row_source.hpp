// SPDX-License-Identifier: BSD-3-Clause
// Where the rows of a campaign come from: simplices, some of them flat, on lattices or on a sphere, and
// queries near their spheres and hyperplanes.
#pragma once

#include "base/random.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace delone::campaign {

using Row = std::vector<double>;

inline constexpr std::size_t num_queries = 24;

/// A simplex and queries, as integers that doubles hold.
struct Rows {
  std::vector<Row> simplex, queries;
};

class RowSource {
 protected:
  explicit RowSource(std::uint64_t seed) : random_(seed) {}

  double integer_below(int bits) {  // in magnitude
    const auto range = std::uint64_t{1} << bits;
    return static_cast<double>(random_.below(2 * range + 1)) - static_cast<double>(range);
  }
  double nudge() {
    const std::uint64_t draw = random_.below(6);
    return draw < 3 ? 0 : draw == 3 ? 1 : draw == 4 ? -1 : integer_below(1);
  }
  /// Wide rows: 53 bits, of which each entry may be shifted.
  double entry(int bits, bool wide) {
    if (!wide) return integer_below(bits);
    return std::ldexp(integer_below(52), random_.coin() ? 0 : static_cast<int>(random_.below(40)));
  }

  /// The points of a simplex and its queries without weights, in the first k coordinates.
  Rows draw_points(std::size_t k, int bits, bool wide) {
    Rows rows;
    const std::uint64_t kind = random_.below(5);
    Row magnitudes(k);  // of points on one sphere, if kind is 2
    for (double& x : magnitudes) x = entry(bits - 1, wide);
    const double side =
        std::ldexp(1 + 2 * static_cast<double>(random_.below(4)),
                   static_cast<int>(random_.below(static_cast<std::uint64_t>(std::max(bits - 4, 1)))));
    const auto on_a_sphere = [&] {
      Row row = magnitudes;
      for (std::size_t j = k; j > 1; --j) std::swap(row[j - 1], row[random_.below(j)]);
      for (double& x : row) x = random_.coin() ? x : -x;
      return row;
    };
    const auto draw = [&] {
      if (kind == 2) return on_a_sphere();
      Row row(k);
      for (double& x : row) x = kind == 1 ? side * static_cast<double>(random_.below(3)) : entry(bits, wide);
      return row;
    };
    const double largest = std::ldexp(1.0, wide ? 92 : bits);
    const auto fits = [&](const Row& row) {
      return std::all_of(row.begin(), row.end(), [&](double x) { return std::fabs(x) <= largest; });
    };
    /// Near the affine hull of the first `size` points.
    const auto combination = [&](std::size_t size) {
      for (int trial = 0; trial < 4; ++trial) {
        Row row = rows.simplex[random_.below(size)];
        for (int step = 0; step < 2 && size > 1; ++step) {
          const Row &a = rows.simplex[random_.below(size)], &b = rows.simplex[random_.below(size)];
          for (std::size_t j = 0; j < k; ++j) row[j] += a[j] - b[j];
        }
        if (!wide)
          for (double& x : row)
            if (random_.below(k) == 0) x += nudge();
        if (fits(row)) return row;
      }
      return draw();
    };
    while (rows.simplex.size() <= k)
      rows.simplex.push_back(kind == 3 && rows.simplex.size() > 1 ? combination(rows.simplex.size())
                                                                  : draw());
    /// The other end of a chord of the sphere from the first point, rounded.
    const auto end_of_chord = [&] {
      const auto sphere = center_of(rows.simplex);
      if (!sphere) return draw();
      Row direction(k), row = rows.simplex[random_.below(k + 1)];
      double along = 0, square = 0;
      for (std::size_t j = 0; j < k; ++j) {
        direction[j] = random_.uniform() - 0.5;
        along += direction[j] * ((*sphere)[j] - row[j]);
        square += direction[j] * direction[j];
      }
      for (std::size_t j = 0; j < k; ++j) row[j] = std::nearbyint(row[j] + 2 * along / square * direction[j]);
      if (!wide) row[random_.below(k)] += nudge();
      return fits(row) ? row : draw();
    };
    while (rows.queries.size() < num_queries) switch (random_.below(4)) {
        case 0:
          rows.queries.push_back(draw());
          break;
        case 1:
          rows.queries.push_back(combination(k));
          break;
        case 2:
          rows.queries.push_back(kind == 2 || kind == 1 ? draw() : end_of_chord());
          if (kind == 2 && random_.coin() && !wide) rows.queries.back()[random_.below(k)] += nudge();
          break;
        default:
          rows.queries.push_back(random_.below(8) == 0 ? rows.simplex[random_.below(k + 1)] : end_of_chord());
      }
    return rows;
  }

  /// Approximately, by elimination in binary64; nullopt for flat simplices.
  static std::optional<Row> center_of(const std::vector<Row>& simplex) {
    const std::size_t k = simplex.size() - 1;
    std::vector<Row> a(k, Row(k + 1));
    for (std::size_t i = 0; i < k; ++i)
      for (std::size_t j = 0; j < k; ++j) {
        a[i][j] = simplex[i + 1][j] - simplex[0][j];
        a[i][k] += a[i][j] * a[i][j] / 2;
      }
    for (std::size_t s = 0; s < k; ++s) {
      std::size_t pivot = s;
      for (std::size_t r = s; r < k; ++r)
        if (std::fabs(a[r][s]) > std::fabs(a[pivot][s])) pivot = r;
      if (a[pivot][s] == 0) return std::nullopt;
      std::swap(a[s], a[pivot]);
      for (std::size_t r = 0; r < k; ++r) {
        if (r == s) continue;
        const double factor = a[r][s] / a[s][s];
        for (std::size_t c = s; c <= k; ++c) a[r][c] -= factor * a[s][c];
      }
    }
    Row center(k);
    for (std::size_t j = 0; j < k; ++j) center[j] = simplex[0][j] + a[j][k] / a[j][j];
    return center;
  }

  random::Generator random_;
};

}  // namespace delone::campaign
