// SPDX-License-Identifier: BSD-3-Clause
// Certificates from the edges between points. Those of the pencil hold in the whole box, and know of a cell its sphere only; of
// flat cells, as among points of a surface, they say too little near the cell, where nearly all queries are. Proofs:
// docs/predicates.md, "Near a cell".
#pragma once

#include "geometry/functionals.hpp"
#include "kernel/minors.hpp"

#include <algorithm>
#include <cmath>

namespace delone::geometry {

/// Sums of products of the squared lengths d_i² of edges from a point and their squared heights t_i² over a plane through it,
/// of all edges but one. No term is divided by another.
class EdgeProducts {
 public:
  void add(double square, double square_of_height = 0) {
    flat_ = flat_ * square + one_missing_ * square_of_height + one_replaced_;
    one_replaced_ = one_replaced_ * square + all_ * square_of_height;
    one_missing_ = one_missing_ * square + all_;
    all_ *= square;
  }
  double all() const { return all_; }                  ///< Π d_i²
  double one_missing() const { return one_missing_; }  ///< Σ_i Π_(j≠i) d_j²
  double flat() const { return flat_; }                ///< Σ_i Σ_(j≠i) t_j²·Π_(l≠i,j) d_l²

  /// Sums beyond it, of so few edges, have lost nothing by underflow that matters.
  static constexpr double smallest = 0x1p-800;
  static constexpr int most_edges = 16;

 private:
  double all_ = 1, one_missing_ = 0, one_replaced_ = 0, flat_ = 0;
};

template <int K, bool Lifted>
template <bool WithHeights>
EdgeProducts Functionals<K, Lifted>::edges_from(const double* row, Index cell, const VertexRows& rows, const double* normal,
                                                double square_of_normal) const requires(Lifted) {
  const Index* vertices = memory_.links(cell);
  EdgeProducts edges;
  for (int i = 0; i <= k(); ++i) {
    if (vertices[i] == index(infinite_vertex)) continue;
    const auto vertex = rows.template row<K>(vertices[i], k());
    double square = 0, height = 0;
    for (int r = 0; r < k(); ++r) {
      const double entry = vertex[r] - row[r];
      square += entry * entry;
      if constexpr (WithHeights) height += entry * normal[r];
    }
    edges.add(widened(square), WithHeights ? widened(height * height, square_of_normal) : 0);
  }
  return edges;
}

template <int K, bool Lifted>
[[gnu::noinline]] double Functionals<K, Lifted>::threshold_at(Index cell, const VertexRows& rows, const double* row) const
    requires(Lifted) {
  if (k() > EdgeProducts::most_edges) return threshold(cell);
  const std::uint64_t bits = packed(cell);
  double square;  // of a bound on the sum of the magnitudes of determinants
  if (certificate::infinite(bits)) {
    square = k() * edges_from<false>(row, cell, rows, nullptr, 0).one_missing();
  } else {
    // Heights are over the plane that touches the sphere's concentric one through the row, times the length of a normal.
    kernel::Buffer<double, K> normal(static_cast<std::size_t>(k()));
    double square_of_normal = 0;
    for (int r = 0; r < k(); ++r) {
      const auto j = static_cast<std::size_t>(r);
      normal[j] = functional(cell)[r] + 2 * lift_weight_[j] * row[r];
      square_of_normal += normal[j] * normal[j];
    }
    const EdgeProducts edges = edges_from<true>(row, cell, rows, normal.data(), square_of_normal);
    square = (k() + 1) * std::min(edges.one_missing() * square_of_normal, k() * edges.flat()) / square_of_normal;
  }
  const double spread = std::sqrt(square) / certificate::determinant(bits);
  const double bound = (certificate::error(bits) * spread + evaluation_error_ * magnitude(cell)) * (1 + 0x1p-30);
  return square > EdgeProducts::smallest && bound < threshold(cell) ? bound : threshold(cell);
}

template <int K, bool Lifted>
bool Functionals<K, Lifted>::certify_by_edges(Index cell, int apex, const VertexRows& rows) requires(Lifted) {
  if constexpr (!kernel::tabulates_minors<K>) {
    return false;
  } else {
    constexpr double gain = 16;  // what elimination may gain before it is worth its time
    const double* functional = this->functional(cell);
    const auto row = [&](int slot) { return rows.template row<K>(memory_.links(cell)[slot], K); };
    const auto value_at = [&](const auto& x) {
      double sum = x[K] + functional[K];
      for (int r = 0; r < K; ++r) sum += functional[r] * x[r];
      return sum;
    };
    const auto origin = row(apex);
    double residual = std::fabs(value_at(origin));
    double entries[K * K];
    EdgeProducts edges;
    for (int i = 0, filled = 0; i <= K; ++i) {
      if (i == apex) continue;
      const auto vertex = row(i);
      residual = std::max(residual, std::fabs(value_at(vertex)));
      double square = 0;
      for (int r = 0; r < K; ++r) {
        const double entry = vertex[r] - origin[r];
        entries[filled++] = entry;
        square += entry * entry;
      }
      edges.add(widened(square));
    }
    const double rounding = evaluation_error_ * magnitude(cell), error = residual + rounding;
    if (!(error <= gain * rounding && rounding < 1)) return false;

    const double others = std::sqrt(K * edges.one_missing());  // ≥ Σ_i Π_(j≠i) of the lengths
    constexpr double expansion_error = 1.01 * (K * (K + 1) / 2) * kernel::unit_roundoff;
    const double most_terms = std::sqrt(std::pow(static_cast<double>(K), K) * edges.all());  // ≥ the permanent of magnitudes
    const double determinant_error = edge_error_ * others + expansion_error * most_terms;
    const double determinant = std::fabs(kernel::determinant_by_minors<K>(entries)) - determinant_error * (1 + 0x1p-30);
    if (!(determinant > certificate::smallest)) return false;
    const double spread = 1 + 4.01 * std::sqrt(static_cast<double>(K)) * others / determinant;
    certify(cell, error * spread + rounding, error, determinant, false);
    return true;
  }
}

}  // namespace delone::geometry
