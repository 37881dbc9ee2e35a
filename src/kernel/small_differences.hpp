// SPDX-License-Identifier: BSD-3-Clause
// Points at hand on a small grid of their own: determinants of their differences are exact in binary64,
// without a bound, whatever other points of the set are on (docs/predicates.md, "Small lattices").
#pragma once

#include "kernel/minors.hpp"

#include <delone/types.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>

namespace delone::kernel {

/// The most bits b of differences in K dimensions such that (K + 1)!·2^(Kb)·2^(2b)·K, a bound on the minors
/// of differences and lifts and on their partial sums, is at most 2⁵³.
template <int K>
constexpr int bits_of_small_differences() {
  double bound = K;
  for (int i = 2; i <= K + 1; ++i) bound *= i;
  int bits = 0;
  while (bound * static_cast<double>(std::uint64_t{1} << (K + 2)) <= 0x1p53) {
    bound *= static_cast<double>(std::uint64_t{1} << (K + 2));
    ++bits;
  }
  return bits;
}

/// Whether K coordinates of all points are multiples of a power of two u, and differences up to `largest` are
/// below 2^b·u, with the b of bits_of_small_differences(). Then these differences are exact, and so are all
/// minors of a determinant of differences and lifts.
///
/// With C = 2⁵²·u, |x| + C is at least 2⁵²·u, so rounded it is a multiple of u, and so is what is left when C
/// is subtracted: if that is |x|, x is a multiple of u. A difference of multiples of u that rounds to less
/// than 2⁵³·u is exact. With 2⁻⁹⁰ ≤ largest ≤ 2⁶⁰ no product underflows or overflows.
template <int K>
bool are_small_multiples(const double* const* points, int count, const double* q, double largest) {
  if (!(largest >= 0x1p-90 && largest <= 0x1p60)) return false;
  const int top = static_cast<int>(std::bit_cast<std::uint64_t>(largest) >> 52) - 1022;  // largest < 2^top
  const int unit = top - bits_of_small_differences<K>();
  const auto coarse = std::bit_cast<double>(static_cast<std::uint64_t>(unit + 52 + 1023) << 52);
  const auto is_multiple = [coarse](const double* p) {
    bool is = true;
    for (int r = 0; r < K; ++r) is &= std::fabs(p[r]) + coarse - coarse == std::fabs(p[r]);
    return is;
  };
  if (!is_multiple(q)) return false;
  for (int i = 0; i < count; ++i)
    if (!is_multiple(points[i])) return false;
  return true;
}

/// The tie-break of perturbed_in_sphere() from the differences of K + 1 points and q, which are exact, as are
/// their determinants. `keys` order the points, less that of q; they are changed.
template <int K>
Sign perturbed_in_sphere_of_differences(const double (&differences)[K + 1][K], double (&keys)[K + 1]) {
  for (;;) {
    int largest = 0;
    for (int i = 1; i <= K; ++i) largest = keys[i] > keys[largest] ? i : largest;
    if (!(keys[largest] > 0)) return Sign::positive;
    // The orientation with q in place of that point, which takes as many exchanges to come first.
    double others[K * K];
    for (int i = 0; i < K; ++i)
      for (int r = 0; r < K; ++r) others[i * K + r] = differences[i + (i >= largest)][r];
    const double volume = determinant_by_minors<K>(others);
    if (volume != 0) return (volume > 0) == (largest % 2 == 0) ? Sign::negative : Sign::positive;
    keys[largest] = 0;
  }
}

/// Orders points lexicographically by their differences from one of them. Two points differ by less than
/// 2^(b + 1) units on an axis: a unit of an axis outweighs all later ones. Keys have fewer bits than lifts
/// were given.
template <int K>
double key_of_small(const double* difference) {
  constexpr auto weight = static_cast<double>(std::uint64_t{1} << (bits_of_small_differences<K>() + 2));
  double key = 0;
  for (int r = 0; r < K; ++r) key = key * weight + difference[r];
  return key;
}

/// Writes the differences of K + 1 points of R^K from q. Returns whether they are small multiples.
template <int K>
bool find_small_differences(const double* const* points, const double* q, double (&differences)[K + 1][K]) {
  double largest = 0;
  for (int i = 0; i <= K; ++i)
    for (int r = 0; r < K; ++r) {
      differences[i][r] = points[i][r] - q[r];
      largest = std::fmax(largest, std::fabs(differences[i][r]));
    }
  return are_small_multiples<K>(points, K + 1, q, largest);
}

/// perturbed_in_sphere() of points of R^K, if they and q are on a small grid of their own.
template <int K>
std::optional<Sign> perturbed_in_sphere_of_small(const double* const* points, const double* q) {
  double differences[K + 1][K], keys[K + 1];
  if (!find_small_differences<K>(points, q, differences)) return std::nullopt;
  for (int i = 0; i <= K; ++i) keys[i] = key_of_small<K>(differences[i]);
  return perturbed_in_sphere_of_differences<K>(differences, keys);
}

/// in_sphere() of points of R^K and, on a tie, perturbed_in_sphere(), if they and q are on a small grid of
/// their own and q is none of them.
template <int K>
std::optional<Sign> side_of_small(const double* const* points, const double* q) {
  double differences[K + 1][K], keys[K + 1];
  if (!find_small_differences<K>(points, q, differences)) return std::nullopt;
  double lifted[(K + 1) * (K + 1)];
  for (int i = 0; i <= K; ++i) {
    double lift = 0;
    for (int r = 0; r < K; ++r) {
      lifted[i * (K + 1) + r] = differences[i][r];
      lift += differences[i][r] * differences[i][r];
    }
    if (lift == 0) return std::nullopt;
    lifted[i * (K + 1) + K] = lift;
  }
  const double side = determinant_by_minors<K + 1>(lifted);
  if (side != 0) return (side > 0) == (K % 2 != 0) ? Sign::positive : Sign::negative;
  for (int i = 0; i <= K; ++i) keys[i] = key_of_small<K>(differences[i]);
  return perturbed_in_sphere_of_differences<K>(differences, keys);
}

/// The cofactors of the last row of an N × N determinant, given its other rows.
template <int N>
void cofactors_of_last_row(const double* rows, double* cofactors) {
  for (int omitted = 0; omitted < N; ++omitted) {
    double minor[(N - 1) * (N - 1)];
    for (int i = 0; i < N - 1; ++i)
      for (int r = 0; r < N - 1; ++r) minor[i * (N - 1) + r] = rows[i * N + r + (r >= omitted)];
    const double value = determinant_by_minors<N - 1>(minor);
    cofactors[omitted] = (N - 1 + omitted) % 2 == 0 ? value : -value;
  }
}

/// Of candidates, the number of the one that makes a positively oriented simplex in place `place` of K + 1
/// corners, and whose sphere has no other such one inside, ties perturbed; `count` if there is none. What is
/// in that place does not matter. Nothing is returned unless all points are on a small grid of their own.
/// With cofactors of the facet, a candidate costs a scalar product instead of a determinant, which is the
/// same number.
template <int K>
std::optional<std::size_t> first_in_pencil_of_small(const double* const* corners, int place,
                                                    const double* const* candidates, std::size_t count) {
  const double* facet[K];
  for (int i = 0; i < K; ++i) facet[i] = corners[i + (i >= place)];
  const double* const base = facet[0];
  double rows[(K + 1) * (K + 1)];       // of the facet, from its second point on, then of the first candidate
  double edges[K * K];                  // the same without lifts
  double largest = 0, largest_key = 0;  // of the facet
  const auto take_differences = [&](const double* p, double* difference) {
    double lift = 0;
    for (int r = 0; r < K; ++r) {
      difference[r] = p[r] - base[r];
      largest = std::fmax(largest, std::fabs(difference[r]));
      lift += difference[r] * difference[r];
    }
    return lift;
  };
  for (int i = 0; i < K - 1; ++i) {
    double* const row = rows + i * (K + 1);
    row[K] = take_differences(facet[i + 1], row);
    std::copy_n(row, K, edges + i * K);
    largest_key = std::fmax(largest_key, key_of_small<K>(row));
  }
  for (std::size_t c = 0; c < count; ++c)
    for (int r = 0; r < K; ++r) largest = std::fmax(largest, std::fabs(candidates[c][r] - base[r]));
  if (!are_small_multiples<K>(facet + 1, K - 1, base, largest) ||
      !are_small_multiples<K>(candidates, static_cast<int>(count), base, largest))
    return std::nullopt;

  const double sign = (K - place) % 2 == 0 ? 1 : -1;  // for moving the place to the end
  double normal[K], sphere[K + 1], first_key = 0;
  cofactors_of_last_row<K>(edges, normal);
  std::size_t first = count;
  for (std::size_t c = 0; c < count; ++c) {
    double row[K + 1], height = 0, side = 0;
    row[K] = take_differences(candidates[c], row);
    for (int r = 0; r < K; ++r) height += normal[r] * row[r];
    if (!(sign * height > 0)) continue;
    const double key = key_of_small<K>(row);
    if (first < count) {
      for (int r = 0; r <= K; ++r) side += sphere[r] * row[r];
      side *= sign;
      if (side == 0) {
        if (std::fmax(key, first_key) >= largest_key) {
          // The largest point is one of the two candidates, and is lifted out of the sphere of the other one.
          side = key < first_key ? -1 : 1;
        } else {
          double differences[K + 1][K], keys[K + 1];
          for (int i = 0; i <= K; ++i) {
            const double* const p = i == place ? candidates[first] : corners[i];
            double from_base[K];
            for (int r = 0; r < K; ++r) {
              from_base[r] = p[r] - base[r];
              differences[i][r] = p[r] - candidates[c][r];
            }
            keys[i] = key_of_small<K>(from_base) - key;
          }
          side = perturbed_in_sphere_of_differences<K>(differences, keys) == Sign::negative ? -1 : 1;
        }
      }
      if (side > 0) continue;
    }
    first = c;
    first_key = key;
    std::copy_n(row, K + 1, rows + (K - 1) * (K + 1));
    cofactors_of_last_row<K + 1>(rows, sphere);
  }
  return first;
}

}  // namespace delone::kernel
