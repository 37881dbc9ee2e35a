// SPDX-License-Identifier: BSD-3-Clause
// The pieces of single cells: integers against fractions, pairs of doubles and lanes against integers, within
// their own bounds.
#include "particles/pass/wide_pieces.hpp"

#include "particles/pass/pieces_kernel.hpp"

#include <gtest/gtest.h>
#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <random>
#include <vector>

namespace delone::particles {
namespace {

using Rational = boost::multiprecision::cpp_rational;

/// k neighbors in R^d, and what the stages read of them.
struct Cell {
  std::size_t k, d;
  std::vector<double> high, low, weight_high, weight_low, records;
  std::vector<std::uint32_t> corners;

  ExactNeighbors exact() const { return {k, d, high, low, weight_high, weight_low}; }
  double t(std::size_t i) const {
    return records[i * record_size(d) + d + alpha] / records[i * record_size(d) + d + square];
  }
};

Cell make_cell(std::size_t k, std::size_t d, const std::vector<double>& edges,
               const std::vector<double>& weights) {
  Cell cell{
      k,  d, edges, std::vector<double>(edges.size(), 0.0), weights, std::vector<double>(weights.size(), 0.0),
      {}, {}};
  cell.corners.resize(k);
  std::iota(cell.corners.begin(), cell.corners.end(), 0u);
  for (std::size_t i = 0; i < k; ++i) {
    double sum = 0;
    for (std::size_t j = 0; j < d; ++j) {
      cell.records.push_back(edges[i * d + j]);
      sum += edges[i * d + j] * edges[i * d + j];
    }
    const double weight = weights.empty() ? 0 : weights[i];
    cell.records.push_back(sum);
    cell.records.push_back((sum + weight) / 2);
    cell.records.push_back((sum + std::abs(weight)) * (sum + std::abs(weight)) / sum);
  }
  return cell;
}

/// Σ W_i·t_i/k, with exact t_i.
double volume_of(const Cell& cell, const std::vector<double>& pieces) {
  double volume = 0;
  for (std::size_t i = 0; i < cell.k; ++i) volume += pieces[i] * cell.t(i) / static_cast<double>(cell.k);
  return volume;
}

/// Edges with entries in [−1, 1]; the last is within `thickness` of the span of the others.
std::vector<double> random_edges(std::size_t k, std::size_t d, double thickness, std::mt19937_64& random) {
  std::uniform_real_distribution<> entry(-1, 1);
  std::vector<double> edges(k * d);
  for (double& x : edges) x = entry(random);
  edges[0] = 0.75;
  if (k < 2 || thickness >= 1) return edges;
  for (std::size_t j = 0; j < d; ++j) {
    double sum = 0;
    for (std::size_t i = 0; i + 1 < k; ++i) sum += edges[i * d + j] / static_cast<double>(k);
    edges[(k - 1) * d + j] = sum + thickness * entry(random);
  }
  return edges;
}

/// In the plane, from W_a = (|a|²·α_b − (a·b)·α_a)/D.
TEST(WidePieces, IntegersAgreeWithFractions) {
  std::mt19937_64 random(1);
  for (const double thickness : {1.0, 1e-3, 1e-8, 1e-15})
    for (int round = 0; round < 50; ++round) {
      const std::vector<double> e = random_edges(2, 2, thickness, random);
      const std::vector<double> weights{0.25, -0.125 * round};
      const Cell cell = make_cell(2, 2, e, weights);
      std::vector<double> pieces(piece_size(2, 2));
      const Rational ax = e[0], ay = e[1], bx = e[2], by = e[3], half(1, 2);
      const Rational la = ax * ax + ay * ay, lb = bx * bx + by * by, ab = ax * bx + ay * by,
                     det = ax * by - ay * bx;
      if (det == 0) continue;
      find_pieces_exactly(cell.exact(), cell.corners.data(), pieces.data());
      const Rational alpha_a = half * (la + Rational(weights[0])),
                     alpha_b = half * (lb + Rational(weights[1]));
      const Rational box = det < 0 ? Rational(-det) : det;
      EXPECT_DOUBLE_EQ(pieces[0], static_cast<double>((la * alpha_b - ab * alpha_a) / box));
      EXPECT_DOUBLE_EQ(pieces[1], static_cast<double>((lb * alpha_a - ab * alpha_b) / box));
    }
}

/// In space, from W_a = ½·(m_ab·q_c + m_ac·q_b).
TEST(WidePieces, IntegersAgreeWithFractionsInSpace) {
  std::mt19937_64 random(2);
  for (const double thickness : {1.0, 1e-8, 1e-15})
    for (int round = 0; round < 20; ++round) {
      const std::vector<double> e = random_edges(3, 3, thickness, random);
      const Cell cell = make_cell(3, 3, e, {});
      const auto at = [&](std::size_t i, std::size_t j) { return Rational(e[3 * i + j % 3]); };
      const auto dot = [&](std::size_t a, std::size_t b) {
        return Rational(at(a, 0) * at(b, 0) + at(a, 1) * at(b, 1) + at(a, 2) * at(b, 2));
      };
      std::vector<std::vector<Rational>> n(3, std::vector<Rational>(3));
      for (std::size_t i = 0; i < 3; ++i)
        for (std::size_t j = 0; j < 3; ++j)
          n[i][j] = at((i + 1) % 3, j + 1) * at((i + 2) % 3, j + 2) -
                    at((i + 1) % 3, j + 2) * at((i + 2) % 3, j + 1);
      Rational det = 0;
      for (std::size_t j = 0; j < 3; ++j) det += at(0, j) * n[0][j];
      if (det == 0) continue;
      std::vector<Rational> y(3), q(3);
      for (std::size_t j = 0; j < 3; ++j)
        for (std::size_t i = 0; i < 3; ++i) y[j] += dot(i, i) / 2 * n[i][j];
      for (std::size_t f = 0; f < 3; ++f) {
        Rational along = 0, square_of_n = 0;
        for (std::size_t j = 0; j < 3; ++j) {
          along += y[j] * n[f][j];
          square_of_n += n[f][j] * n[f][j];
        }
        q[f] = along / square_of_n / (det < 0 ? Rational(-det) : det);
      }
      std::vector<double> pieces(piece_size(3, 3));
      find_pieces_exactly(cell.exact(), cell.corners.data(), pieces.data());
      for (std::size_t a = 0; a < 3; ++a) {
        Rational w = 0, size = 0;
        for (const std::size_t b : {(a + 1) % 3, (a + 2) % 3}) {
          const Rational part = (dot(a, a) * dot(b, b) - dot(a, b) * dot(a, a)) / 4 * q[3 - a - b];
          w += part;
          size += part < 0 ? Rational(-part) : part;
        }
        EXPECT_NEAR(pieces[a], static_cast<double>(w), 1e-14 * static_cast<double>(size));
      }
    }
}

/// Every stage keeps its bound, and its size is that of the exact pieces up to this bound.
TEST(WidePieces, StagesKeepTheirBounds) {
  std::mt19937_64 random(3);
  for (std::size_t k = 1; k <= 6; ++k)
    for (const std::size_t d : {k, k + 1})
      for (const double thickness : {1.0, 1e-2, 1e-5, 1e-9, 1e-13, 1e-16})
        for (int round = 0; round < 8; ++round) {
          std::vector<double> weights;
          if (round % 2 == 1)
            for (std::size_t i = 0; i < k; ++i)
              weights.push_back(std::uniform_real_distribution<>(-0.5, 0.5)(random));
          const Cell cell = make_cell(k, d, random_edges(k, d, thickness, random), weights);
          const std::size_t size = piece_size(k, d);
          std::vector<double> exact(size), one(size), pairs(size), lanes(8 * size);
          find_pieces_exactly(cell.exact(), cell.corners.data(), exact.data());
          find_pieces(k, d, cell.records.data(), cell.corners.data(), one.data());
          find_pieces_in_pairs(cell.exact(), cell.corners.data(), pairs.data());
          const double volume = volume_of(cell, exact), sum = exact[k + d],
                       roundings = exact[k + d + 1] + 1e-15 * sum;
          const auto expect_bound = [&](const std::vector<double>& found, const char* stage) {
            SCOPED_TRACE(stage);
            const double error = found[k + d + 1];
            EXPECT_GE(error, 0);
            if (std::isinf(error)) return;  // nothing is known
            EXPECT_LE(std::abs(volume_of(cell, found) - volume), error + roundings);
            EXPECT_LE(std::abs(found[k + d] - sum), error + roundings);
          };
          EXPECT_LE(exact[k + d + 1], 1e-13 * sum);
          expect_bound(one, "doubles");
          expect_bound(pairs, "pairs");
          if (thickness >= 1e-9) {
            EXPECT_LE(pairs[k + d + 1], 1e-12 * sum);
          }
          if (thickness == 1 && k < 4) {
            EXPECT_LT(one[k + d + 1], 1e-8 * sum);
          }
          if (!has_lanes(k, d)) continue;
          find_pieces_in_lanes(d, !weights.empty(), 1, cell.records.data(), cell.corners.data(), 8,
                               lanes.data());
          std::vector<double> in_lane;
          for (std::size_t i = 0; i < size; ++i) in_lane.push_back(lanes[8 * i]);
          expect_bound(in_lane, "lanes");
        }
}

}  // namespace
}  // namespace delone::particles
