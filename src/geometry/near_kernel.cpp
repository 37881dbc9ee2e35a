// SPDX-License-Identifier: BSD-3-Clause
// Proofs: docs/predicates.md, "Near a cell".
#include "geometry/near_kernel.hpp"

#include "cell_memory.hpp"
#include "geometry/certificate.hpp"
#include "geometry/pair.hpp"
#include "kernel/determinant.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "geometry/near_kernel.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include "kernel/minors-inl.hpp"

#ifndef DELONE_NEAR_LIMITS
#define DELONE_NEAR_LIMITS
namespace delone::geometry {

/// Sums of products beyond it, of so few edges, have lost nothing by underflow that matters.
constexpr double smallest_sum = 0x1p-800;
constexpr int most_dimensions = 16;
constexpr double slack = 1 + 0x1p-30;  // covers all relative errors

static_assert(can_find_thresholds(most_dimensions) && !can_find_thresholds(most_dimensions + 1));

}  // namespace delone::geometry
#endif

HWY_BEFORE_NAMESPACE();
namespace delone::geometry {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Sums of products of the squared lengths d_i² of edges from a point and their squared heights t_i² over a plane through it,
/// of all edges but one. No term is divided by another.
template <class V>
struct EdgeProducts {
  HWY_INLINE void add(V square) {
    one_missing = hn::MulAdd(one_missing, square, all);
    all = hn::Mul(all, square);
  }
  HWY_INLINE void add(V square, V square_of_height) {
    flat = hn::MulAdd(flat, square, hn::MulAdd(one_missing, square_of_height, one_replaced));
    one_replaced = hn::MulAdd(one_replaced, square, hn::Mul(all, square_of_height));
    add(square);
  }
  V all;                              ///< Π d_i²
  V one_missing, one_replaced, flat;  ///< Σ_i Π_(j≠i) d_j², Σ_i t_i²·Π_(j≠i) d_j², Σ_i Σ_(j≠i) t_j²·Π_(l≠i,j) d_l²
};

/// What is computed from, one cell per lane. K is k, or 0 for any.
template <int K>
class Gathered {
 public:
  HWY_INLINE explicit Gathered(const NearTask& task) : k_(task.k) {
    const hn::CappedTag<double, near_lanes> d;
    if (task.cells.size() == near_lanes) return;
    for (std::size_t i = 0; i < num_entries() * near_lanes; i += hn::Lanes(d)) {
      hn::Store(hn::Zero(d), d, entries_ + i);
      std::atomic_signal_fence(std::memory_order_seq_cst);  // else it would be an instruction that takes its time to start
    }
  }

  /// Gathers the functionals, and the first `width` entries or one more of the rows of `num_vertices` vertices, two cells at a
  /// time. The vertex `apart` of a cell is not among the first k.
  HWY_INLINE void gather(const NearTask& task, Index apart, std::size_t num_vertices, std::size_t width) {
    const CellLayout<K> layout(task.k);
    const CellRecords<K, const double> records(layout, task.functionals, task.certificates);
    for (std::size_t lane = 0; lane < task.cells.size(); lane += 2) {
      const Index one = task.cells[lane], two = task.cells[std::min(lane + 1, task.cells.size() - 1)];
      const auto put = [&](double* to, const double* from_one, const double* from_two, std::size_t count) {
        to += lane;
        std::size_t r = 0;
        for (; r + 1 < count; r += 2, to += 2 * near_lanes) {
          const Pair of_one = load_pair(from_one + r), of_two = load_pair(from_two + r);
          store_pair(to, Pair{of_one[0], of_two[0]});
          store_pair(to + near_lanes, Pair{of_one[1], of_two[1]});
        }
        if (r < count) store_pair(to, Pair{from_one[r], from_two[r]});
      };
      put(functional(0), records.functional(one), records.functional(two), k() + 1);
      put(certificate(), records.certificate(one), records.certificate(two), 1);
      const Index* const vertices_of_one = task.links + one * layout.link_stride();
      const Index* const vertices_of_two = task.links + two * layout.link_stride();
      for (std::size_t i = 0; i < num_vertices; ++i) {
        const auto row_of = [&](const Index* vertices) {
          // Which vertex it is cannot be predicted: there is no branch.
          const Index other = vertices[i < k() ? k() : 0], is_apart = Index{0} - static_cast<Index>(vertices[i] == apart);
          return task.rows.template row<K>((vertices[i] & ~is_apart) | (other & is_apart), static_cast<int>(k()));
        };
        const auto row_of_one = row_of(vertices_of_one), row_of_two = row_of(vertices_of_two);
        put(vertex(i, 0), &row_of_one[0], &row_of_two[0], width + width % 2 <= k() + 1 ? width + width % 2 : width);
      }
    }
  }
  HWY_INLINE double* functional(std::size_t r) { return entry(r); }
  HWY_INLINE double* certificate() { return entry(k() + 1); }
  HWY_INLINE double* vertex(std::size_t i, std::size_t r) { return entry(k() + 2 + i * (k() + 1) + r); }

 private:
  static constexpr std::size_t most = K > 0 ? K : most_dimensions;
  HWY_INLINE std::size_t k() const { return K > 0 ? K : static_cast<std::size_t>(k_); }
  HWY_INLINE std::size_t num_entries() const { return k() + 2 + (k() + 1) * (k() + 1); }
  HWY_INLINE double* entry(std::size_t i) { return entries_ + i * near_lanes; }

  int k_;
  HWY_ALIGN double entries_[(most + 2 + (most + 1) * (most + 1)) * near_lanes];
};

/// At least the square of s·(|x| + edge_error), from (s·x)² and s².
template <class D, class V>
HWY_INLINE V widened(D d, const NearTask& task, V square, V square_of_scale) {
  const V error = hn::Set(d, 17 * task.edge_error * task.edge_error);
  return hn::MulAdd(hn::Set(d, 1.0625), square, hn::Mul(error, square_of_scale));
}

template <int K>
void find_thresholds_in(const NearTask& task, double* thresholds) {
  const hn::CappedTag<double, near_lanes> d;
  using V = hn::Vec<decltype(d)>;
  const auto k = static_cast<std::size_t>(K > 0 ? K : task.k);
  const auto n = static_cast<double>(k);
  Gathered<K> gathered(task);
  gathered.gather(task, index(infinite_vertex), k + 1, k);
  HWY_ALIGN double cached[near_lanes], errors[near_lanes], determinants[near_lanes], lifts[near_lanes];
  for (std::size_t lane = 0; lane < near_lanes; ++lane) {
    const auto packed = std::bit_cast<std::uint64_t>(gathered.certificate()[lane]);
    cached[lane] = certificate::threshold(packed);
    errors[lane] = certificate::error(packed);
    determinants[lane] = certificate::determinant(packed);
    lifts[lane] = certificate::infinite(packed) ? 0 : task.largest_lift;
  }
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  for (std::size_t lane = 0; lane < task.cells.size(); lane += hn::Lanes(d)) {
    const auto coefficient = [&](std::size_t r) { return hn::Load(d, gathered.functional(r) + lane); };
    const auto normal = [&](std::size_t r) {
      return hn::Add(coefficient(r), hn::Set(d, 2 * task.lift_weight[r] * task.row[r]));
    };
    // Heights are over the plane that touches the sphere's concentric one through the row, times the length of a normal.
    V square_of_normal = zero, magnitude = hn::Load(d, lifts + lane);
    const auto is_finite = hn::Gt(magnitude, zero);
    for (std::size_t r = 0; r < k; ++r) {
      square_of_normal = hn::MulAdd(normal(r), normal(r), square_of_normal);
      magnitude = hn::Add(magnitude, hn::Abs(coefficient(r)));
    }
    magnitude = hn::Add(magnitude, hn::Abs(coefficient(k)));
    // Divisions take longest: none waits for the edges.
    const V inverse_square_of_normal = hn::Div(one, square_of_normal);
    const V inverse_determinant = hn::Div(one, hn::Load(d, determinants + lane));
    EdgeProducts<V> edges{one, zero, zero, zero};
    V of_infinite = zero;  // without the infinite vertex, which is the last
    for (std::size_t i = 0; i <= k; ++i) {
      of_infinite = edges.one_missing;
      V square = zero, height = zero;
      for (std::size_t r = 0; r < k; ++r) {
        const V entry = hn::Sub(hn::Load(d, gathered.vertex(i, r) + lane), hn::Set(d, task.row[r]));
        square = hn::MulAdd(entry, entry, square);
        height = hn::MulAdd(entry, normal(r), height);
      }
      edges.add(widened(d, task, square, one), widened(d, task, hn::Mul(height, height), square_of_normal));
    }
    const V of_finite = hn::Min(edges.one_missing, hn::Mul(hn::Mul(hn::Set(d, n), edges.flat), inverse_square_of_normal));
    const V square =  // of a bound on the sum of the magnitudes of determinants
        hn::IfThenElse(is_finite, hn::Mul(hn::Set(d, n + 1), of_finite), hn::Mul(hn::Set(d, n), of_infinite));
    const V spread = hn::Mul(hn::Sqrt(square), inverse_determinant);
    const V bound =
        hn::Mul(hn::MulAdd(hn::Load(d, errors + lane), spread, hn::Mul(hn::Set(d, task.evaluation_error), magnitude)),
                hn::Set(d, slack));
    const V threshold = hn::Load(d, cached + lane);
    const auto is_better = hn::And(hn::Gt(square, hn::Set(d, smallest_sum)), hn::Lt(bound, threshold));  // false for NaN
    hn::Store(hn::IfThenElse(is_better, bound, threshold), d, cached + lane);
  }
  std::copy_n(cached, task.cells.size(), thresholds);
}

void find_thresholds_here(const NearTask& task, double* thresholds) {
  switch (task.k) {
    case 2:
      return find_thresholds_in<2>(task, thresholds);
    case 3:
      return find_thresholds_in<3>(task, thresholds);
    case 4:
      return find_thresholds_in<4>(task, thresholds);
    case 5:
      return find_thresholds_in<5>(task, thresholds);
    case 6:
      return find_thresholds_in<6>(task, thresholds);
    default:
      return find_thresholds_in<0>(task, thresholds);
  }
}

template <int K>
void certify_by_edges_in(const NearTask& task, Index apex, EdgeCertificate* certificates) {
  constexpr double gain = 16;  // what elimination may gain before it is worth its time
  constexpr double expansion_error = 1.01 * (K * (K + 1) / 2) * kernel::unit_roundoff;
  const hn::CappedTag<double, near_lanes> d;
  using V = hn::Vec<decltype(d)>;
  Gathered<K> gathered(task);
  gathered.gather(task, apex, K, K + 1);
  HWY_ALIGN double edge_entries[K * K * near_lanes];
  HWY_ALIGN double thresholds[near_lanes], errors[near_lanes], determinants[near_lanes];
  const double most_terms_factor = std::pow(static_cast<double>(K), K),
               spread_factor = 4.01 * std::sqrt(static_cast<double>(K));
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  for (std::size_t lane = 0; lane < task.cells.size(); lane += hn::Lanes(d)) {
    V functional[K + 1], magnitude = hn::Set(d, task.largest_lift);
    for (std::size_t r = 0; r <= K; ++r) {
      functional[r] = hn::Load(d, gathered.functional(r) + lane);
      magnitude = hn::Add(magnitude, hn::Abs(functional[r]));
    }
    V at_apex = hn::Add(hn::Set(d, task.row[K]), functional[K]);
    for (std::size_t r = 0; r < K; ++r) at_apex = hn::MulAdd(functional[r], hn::Set(d, task.row[r]), at_apex);
    V residual = hn::Abs(at_apex);
    EdgeProducts<V> edges{one, zero, zero, zero};
    for (std::size_t i = 0; i < K; ++i) {
      V value = hn::Add(hn::Load(d, gathered.vertex(i, K) + lane), functional[K]), square = zero;
      for (std::size_t r = 0; r < K; ++r) {
        const V image = hn::Load(d, gathered.vertex(i, r) + lane), entry = hn::Sub(image, hn::Set(d, task.row[r]));
        value = hn::MulAdd(functional[r], image, value);
        square = hn::MulAdd(entry, entry, square);
        hn::Store(entry, d, edge_entries + (i * K + r) * near_lanes + lane);
      }
      residual = hn::Max(residual, hn::Abs(value));
      edges.add(widened(d, task, square, one));
    }
    V minors[std::size_t{1} << K];
    kernel::HWY_NAMESPACE::tabulate_minors<K>(
        kernel::HWY_NAMESPACE::Entries<K, near_lanes, decltype(d)>{d, edge_entries + lane}, minors);

    const V rounding = hn::Mul(hn::Set(d, task.evaluation_error), magnitude), error = hn::Add(residual, rounding);
    const V others = hn::Sqrt(hn::Mul(hn::Set(d, K), edges.one_missing));              // ≥ Σ_i Π_(j≠i) of the lengths
    const V most_terms = hn::Sqrt(hn::Mul(hn::Set(d, most_terms_factor), edges.all));  // ≥ the permanent of magnitudes
    const V determinant_error =
        hn::MulAdd(hn::Set(d, task.edge_error), others, hn::Mul(hn::Set(d, expansion_error), most_terms));
    const V determinant = hn::NegMulAdd(determinant_error, hn::Set(d, slack), hn::Abs(minors[(std::size_t{1} << K) - 1]));
    const V spread = hn::MulAdd(hn::Set(d, spread_factor), hn::Div(others, determinant), one);
    const auto is_proved = hn::And(hn::And(hn::Le(error, hn::Mul(hn::Set(d, gain), rounding)), hn::Lt(rounding, one)),
                                   hn::Gt(determinant, hn::Set(d, certificate::smallest)));  // false for NaN
    hn::Store(hn::MulAdd(error, spread, rounding), d, thresholds + lane);
    hn::Store(error, d, errors + lane);
    hn::Store(hn::IfThenElseZero(is_proved, determinant), d, determinants + lane);
  }
  for (std::size_t lane = 0; lane < task.cells.size(); ++lane)
    certificates[lane] = {thresholds[lane], errors[lane], determinants[lane]};
}

void certify_by_edges_here(const NearTask& task, Index apex, EdgeCertificate* certificates) {
  switch (task.k) {
    case 2:
      return certify_by_edges_in<2>(task, apex, certificates);
    case 3:
      return certify_by_edges_in<3>(task, apex, certificates);
    case 4:
      return certify_by_edges_in<4>(task, apex, certificates);
    case 5:
      return certify_by_edges_in<5>(task, apex, certificates);
    case 6:
      return certify_by_edges_in<6>(task, apex, certificates);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::geometry
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::geometry {

HWY_EXPORT(find_thresholds_here);
HWY_EXPORT(certify_by_edges_here);

void find_thresholds(const NearTask& task, double* thresholds) { HWY_DYNAMIC_DISPATCH(find_thresholds_here)(task, thresholds); }

void certify_by_edges(const NearTask& task, Index apex, EdgeCertificate* certificates) {
  HWY_DYNAMIC_DISPATCH(certify_by_edges_here)(task, apex, certificates);
}

}  // namespace delone::geometry
#endif
