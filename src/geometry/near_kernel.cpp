// SPDX-License-Identifier: BSD-3-Clause
// Proofs: docs/predicates.md, "Near a cell" and "By edges".
#include "geometry/near_kernel.hpp"

#include "base/compiled_dimension.hpp"
#include "geometry/certificate.hpp"
#include "geometry/pair.hpp"
#include "kernel/determinant.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cmath>

#if defined(__x86_64__) || defined(_M_X64)
#undef HWY_DISABLED_TARGETS  // Here CMake's definition lacks SSE4.
// Their vectors are as short as those of SSE2, and the unrolled minors are slow to compile.
#define HWY_DISABLED_TARGETS (HWY_SSSE3 | HWY_SSE4)
#endif
#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "geometry/near_kernel.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include "kernel/minors-inl.hpp"

#ifndef DELONE_NEAR_LIMITS
#define DELONE_NEAR_LIMITS
namespace delone::geometry {

/// In sums of products of so few edges that exceed this, nothing that matters is lost to underflow.
constexpr double smallest_sum = 0x1p-800;
constexpr int most_dimensions = 16;
constexpr double slack = 1 + 0x1p-30;  // covers all relative errors

/// n^(n/2), rounded up: a bound on the permanent of the magnitudes of n vectors of R^n over the product of
/// their lengths.
constexpr double most_terms_over_lengths[] = {1, 1, 2, 5.197, 16, 55.91, 216};

static_assert(can_find_thresholds(most_dimensions) && !can_find_thresholds(most_dimensions + 1));

}  // namespace delone::geometry
#endif

HWY_BEFORE_NAMESPACE();
namespace delone::geometry {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

/// Sums of products of the squared lengths d_i² of edges from a point and their squared heights t_i² over a
/// plane through it, of all edges but one. Computed without divisions.
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
  V all;  ///< Π d_i²
  V one_missing, one_replaced,
      flat;  ///< Σ_i Π_(j≠i) d_j², Σ_i t_i²·Π_(j≠i) d_j², Σ_i Σ_(j≠i) t_j²·Π_(l≠i,j) d_l²
};

/// The input of the computations, one cell per lane. K is k, or 0 for any k.
template <int K>
class Gathered {
 public:
  HWY_INLINE explicit Gathered(const NearTask& task) : k_(task.k) {
    const hn::CappedTag<double, near_lanes> d;
    if (task.cells.size() == near_lanes) return;
    for (std::size_t i = 0; i < num_entries() * near_lanes; i += hn::Lanes(d)) {
      hn::Store(hn::Zero(d), d, entries_ + i);
      // Keeps the compiler from a string instruction, which is slow to start.
      std::atomic_signal_fence(std::memory_order_seq_cst);
    }
  }

  /// Gathers the functionals, and the first `width` entries or one more of the rows of `num_vertices`
  /// vertices of each cell, two cells at a time. The vertex `apart` is none of them, and the infinite vertex,
  /// if there is one, the last.
  HWY_INLINE void gather(const NearTask& task, Index apart, std::size_t num_vertices, std::size_t width) {
    const cells::CellLayout<K> layout(task.k, task.ids);
    const cells::CellRecords<K, const double> records(layout, task.functionals, task.certificates);
    constexpr Index infinite = index(infinite_vertex);
    const auto list_vertices = [&](Index cell, Index* vertices) {
      const Index* const all = task.links + cell * layout.link_stride();
      std::size_t n = 0;
      for (std::size_t i = 0; i <= k(); ++i) {  // without a branch, as it would be unpredictable
        const Index vertex = layout.vertex(all, static_cast<int>(i));
        vertices[n] = vertex;
        n += static_cast<std::size_t>((vertex != apart) & (vertex != infinite));
      }
      vertices[num_vertices - 1] = n < num_vertices ? infinite : vertices[num_vertices - 1];
    };
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
      Index vertices_of_one[most + 1], vertices_of_two[most + 1];
      list_vertices(one, vertices_of_one);
      list_vertices(two, vertices_of_two);
      for (std::size_t i = 0; i < num_vertices; ++i) {
        const auto row_of_one = task.rows.template row<K>(vertices_of_one[i], static_cast<int>(k()));
        const auto row_of_two = task.rows.template row<K>(vertices_of_two[i], static_cast<int>(k()));
        put(vertex(i, 0), &row_of_one[0], &row_of_two[0],
            width + width % 2 <= k() + 1 ? width + width % 2 : width);
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

/// A bound on the square of s·(|x| + edge_error), from (s·x)² and s².
template <class D, class V>
HWY_INLINE V widened(D d, const NearTask& task, V square, V square_of_scale) {
  const V error = hn::Set(d, 17 * task.edge_error * task.edge_error);
  return hn::MulAdd(hn::Set(d, 1.0625), square, hn::Mul(error, square_of_scale));
}

/// The fields of certificates, one cell per lane.
struct Unpacked {
  HWY_INLINE Unpacked(const NearTask& task, const double* certificates) {
    for (std::size_t lane = 0; lane < near_lanes; ++lane) {
      const auto packed = std::bit_cast<std::uint64_t>(certificates[lane]);
      thresholds[lane] = certificate::threshold(packed);
      errors[lane] = certificate::error(packed);
      determinants[lane] = certificate::determinant(packed);
      lifts[lane] = certificate::infinite(packed) ? 0 : task.largest_lift;
    }
  }
  HWY_ALIGN double thresholds[near_lanes], errors[near_lanes], determinants[near_lanes];
  HWY_ALIGN double lifts[near_lanes];  ///< the contribution of the lift to the magnitude of a functional: 0
                                       ///< for infinite cells
};

/// Replaces the cached threshold by one from a bound on the sum of the magnitudes of the determinants of all
/// edges but one, if that is smaller. `is_proved`: whether that bound holds.
template <class D, class V, class M>
HWY_INLINE void lower_threshold(D d, const NearTask& task, V sum, V magnitude, V inverse_determinant,
                                M is_proved, V error, double* threshold) {
  const V rounding = hn::Mul(hn::Set(d, task.evaluation_error), magnitude);
  const V bound = hn::Mul(hn::MulAdd(error, hn::Mul(sum, inverse_determinant), rounding), hn::Set(d, slack));
  const V cached = hn::Load(d, threshold);
  hn::Store(hn::IfThenElse(hn::And(is_proved, hn::Lt(bound, cached)), bound, cached), d,
            threshold);  // NaN leaves the cached one
}

/// For any dimension, from the lengths of edges.
void find_thresholds_by_lengths(const NearTask& task, double* thresholds) {
  const hn::CappedTag<double, near_lanes> d;
  using V = hn::Vec<decltype(d)>;
  const auto k = static_cast<std::size_t>(task.k);
  const auto n = static_cast<double>(k);
  Gathered<0> gathered(task);
  gathered.gather(task, index(infinite_vertex), k + 1, k);
  Unpacked cached(task, gathered.certificate());
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  for (std::size_t lane = 0; lane < task.cells.size(); lane += hn::Lanes(d)) {
    const auto coefficient = [&](std::size_t r) { return hn::Load(d, gathered.functional(r) + lane); };
    const auto normal = [&](std::size_t r) {
      return hn::Add(coefficient(r), hn::Set(d, 2 * task.lift_weight[r] * task.row[r]));
    };
    // Heights are over the plane that touches, at the row, the sphere's concentric one through it, times the
    // length of a normal.
    V square_of_normal = zero, magnitude = hn::Load(d, cached.lifts + lane);
    const auto is_finite = hn::Gt(magnitude, zero);
    for (std::size_t r = 0; r < k; ++r) {
      square_of_normal = hn::MulAdd(normal(r), normal(r), square_of_normal);
      magnitude = hn::Add(magnitude, hn::Abs(coefficient(r)));
    }
    magnitude = hn::Add(magnitude, hn::Abs(coefficient(k)));
    // Divisions have the longest latency: none depends on the edges.
    const V inverse_square_of_normal = hn::Div(one, square_of_normal);
    const V inverse_determinant = hn::Div(one, hn::Load(d, cached.determinants + lane));
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
    const V of_finite =
        hn::Min(edges.one_missing, hn::Mul(hn::Mul(hn::Set(d, n), edges.flat), inverse_square_of_normal));
    const V square =
        hn::IfThenElse(is_finite, hn::Mul(hn::Set(d, n + 1), of_finite), hn::Mul(hn::Set(d, n), of_infinite));
    lower_threshold(d, task, hn::Sqrt(square), magnitude, inverse_determinant,
                    hn::Gt(square, hn::Set(d, smallest_sum)), hn::Load(d, cached.errors + lane),
                    cached.thresholds + lane);
  }
  std::copy_n(cached.thresholds, task.cells.size(), thresholds);
}

/// In place of an edge to the infinite vertex: the unit vector of the coordinate in which the functional of
/// an infinite cell has the coefficient ±1. A determinant with it is that of the other edges without this
/// coordinate.
template <class D, class V>
HWY_INLINE V edge_to_infinity(D d, V coefficient) {
  const V one = hn::Set(d, 1.0);
  return hn::IfThenElseZero(hn::Eq(hn::Abs(coefficient), one), one);
}

/// From the determinants of edges themselves.
template <int K>
void find_thresholds_by_minors(const NearTask& task, double* thresholds) {
  const hn::CappedTag<double, near_lanes> d;
  using V = hn::Vec<decltype(d)>;
  constexpr double expansion_error =
      1.01 * (K * (K + 1) / 2) * kernel::unit_roundoff * most_terms_over_lengths[K];
  Gathered<K> gathered(task);
  gathered.gather(task, index(infinite_vertex), K + 1, K);
  Unpacked cached(task, gathered.certificate());
  HWY_ALIGN double edge_entries[K * (K + 1) * near_lanes];  // an edge per column
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0),
          square_of_edge_error = hn::Set(d, task.edge_error * task.edge_error);
  for (std::size_t lane = 0; lane < task.cells.size(); lane += hn::Lanes(d)) {
    V magnitude = hn::Load(d, cached.lifts + lane), num_normal = zero;
    const auto is_finite = hn::Gt(magnitude, zero);
    const V inverse_determinant = hn::Div(one, hn::Load(d, cached.determinants + lane));
    for (std::size_t r = 0; r <= K; ++r)
      magnitude = hn::Add(magnitude, hn::Abs(hn::Load(d, gathered.functional(r) + lane)));
    EdgeProducts<V> edges{one, zero, zero, zero};
    V of_infinite = zero;  // without the infinite vertex, which is the last
    for (std::size_t i = 0; i <= K; ++i) {
      of_infinite = edges.one_missing;
      V square = zero;
      for (std::size_t r = 0; r < K; ++r) {
        V entry = hn::Sub(hn::Load(d, gathered.vertex(i, r) + lane), hn::Set(d, task.row[r]));
        if (i == K) {
          const V to_infinity = edge_to_infinity(d, hn::Load(d, gathered.functional(r) + lane));
          num_normal = hn::Add(num_normal, to_infinity);
          entry = hn::IfThenElse(is_finite, entry, to_infinity);
        }
        square = hn::MulAdd(entry, entry, square);
        hn::Store(entry, d, edge_entries + (r * (K + 1) + i) * near_lanes + lane);
      }
      edges.add(widened(d, task, square, one), square_of_edge_error);
    }
    V minors[std::size_t{1} << (K + 1)];
    kernel::HWY_NAMESPACE::tabulate_minors<K>(
        kernel::HWY_NAMESPACE::Entries<K + 1, near_lanes, decltype(d)>{d, edge_entries + lane}, minors);
    constexpr std::size_t all = (std::size_t{1} << (K + 1)) - 1;
    V sum = hn::IfThenElseZero(is_finite, hn::Abs(minors[all & ~(std::size_t{1} << K)]));
    for (std::size_t i = 0; i < K; ++i) sum = hn::Add(sum, hn::Abs(minors[all & ~(std::size_t{1} << i)]));
    const V by_lengths = hn::Sqrt(hn::Mul(hn::Set(d, K + 1.0), edges.one_missing));
    sum = hn::Add(hn::MulAdd(hn::Set(d, expansion_error), by_lengths, sum),
                  hn::Sqrt(hn::Mul(hn::Set(d, K * (K + 1.0)), edges.flat)));
    // Where several coordinates have the coefficient ±1, the bound is by lengths.
    sum = hn::IfThenElse(hn::Or(is_finite, hn::Eq(num_normal, one)), sum,
                         hn::Sqrt(hn::Mul(hn::Set(d, K), of_infinite)));
    lower_threshold(d, task, sum, magnitude, inverse_determinant,
                    hn::Gt(hn::Min(of_infinite, edges.one_missing), hn::Set(d, smallest_sum)),
                    hn::Load(d, cached.errors + lane), cached.thresholds + lane);
  }
  std::copy_n(cached.thresholds, task.cells.size(), thresholds);
}

void find_thresholds_here(const NearTask& task, double* thresholds) {
  internal::with_compiled_dimension<2, 6>(static_cast<std::size_t>(task.k), [&](auto k) {
    if constexpr (k() > 0)
      find_thresholds_by_minors<k()>(task, thresholds);
    else
      find_thresholds_by_lengths(task, thresholds);
  });
}

/// For the vectors of cofactors of the rows of a matrix of edges from one point: the sum of the magnitudes of
/// their components along a unit vector, and the sum of the squared lengths of their components across it.
template <class V>
struct CofactorSums {
  V along, square_across;
};

template <int K, class E, class V>
HWY_INLINE CofactorSums<V> sum_cofactors(const E& edges, const V* minors, const V* unit) {
  V below[std::size_t{1} << K];
  kernel::HWY_NAMESPACE::tabulate_minors<K - 1>(kernel::HWY_NAMESPACE::FromLastRow<E>{edges}, below);
  CofactorSums<V> sums{hn::Zero(edges.d), hn::Zero(edges.d)};
  const auto add_row = [&]<int Row, int... Column>(std::integral_constant<int, Row>,
                                                   std::integer_sequence<int, Column...>) {
    const V cofactors[] = {kernel::HWY_NAMESPACE::cofactor<K, Row, Column>(minors, below)...};
    V product = hn::Zero(edges.d);
    for (int r = 0; r < K; ++r) product = hn::MulAdd(cofactors[r], unit[r], product);
    sums.along = hn::Add(sums.along, hn::Abs(product));
    for (int r = 0; r < K; ++r) {
      const V across = hn::NegMulAdd(product, unit[r], cofactors[r]);
      sums.square_across = hn::MulAdd(across, across, sums.square_across);
    }
  };
  [&]<int... Row>(std::integer_sequence<int, Row...>) {
    (add_row(std::integral_constant<int, Row>{}, std::make_integer_sequence<int, K>{}), ...);
  }
  (std::make_integer_sequence<int, K>{});
  return sums;
}

/// The sign that the coefficient ±1 of an infinite cell has if the determinant of its edges from the apex is
/// positive.
template <int K>
double sign_of_normal(const NearTask& task, Index cell, Index apex) {
  const cells::CellLayout<K> layout(task.k, task.ids);
  const Index* const links = task.links + cell * layout.link_stride();
  const auto slot_of = [&](Index v) {
    int slot = 0;
    while (slot < K && layout.vertex(links, slot) != v) ++slot;
    return slot;
  };
  const int infinite_slot = slot_of(index(infinite_vertex)), slot = slot_of(apex);
  return (slot + infinite_slot - (infinite_slot > slot) + K) % 2 == 0 ? 1 : -1;
}

template <int K>
void certify_by_edges_in(const NearTask& task, Index apex, EdgeCertificate* certificates) {
  constexpr double gain = 16;  // the factor that elimination must gain to be worth its cost
  constexpr double finer = 4;  // by this factor at most its bounds on determinants are tighter
  // Thresholds that are low enough without cofactors. (Up to four dimensions cofactors are cheap and always
  // used.)
  constexpr double low_per_square = 0x1p-9, low_per_radius = 0x1p-10, low_of_infinite = 0x1p-24;
  constexpr double expansion_error =
      1.01 * (K * (K + 1) / 2) * kernel::unit_roundoff * most_terms_over_lengths[K];
  constexpr double cofactor_error =
      1.01 * (K * (K + 1) / 2 + (1 << (K - 1))) * kernel::unit_roundoff * most_terms_over_lengths[K] +
      0x1p-43;
  const hn::CappedTag<double, near_lanes> d;
  using V = hn::Vec<decltype(d)>;
  Gathered<K> gathered(task);
  gathered.gather(task, apex, K, K + 1);
  Unpacked cached(task, gathered.certificate());
  HWY_ALIGN double edge_entries[K * K * near_lanes];  // an edge per row
  HWY_ALIGN double thresholds[near_lanes], errors[near_lanes], determinants[near_lanes], open[near_lanes];
  HWY_ALIGN double signs[near_lanes] = {};
  for (std::size_t lane = 0; lane < task.cells.size(); ++lane)
    if (cached.lifts[lane] == 0) signs[lane] = sign_of_normal<K>(task, task.cells[lane], apex);
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0),
          square_of_edge_error = hn::Set(d, task.edge_error * task.edge_error);
  const V diagonal = hn::Set(d, 2.01 * std::sqrt(static_cast<double>(K)));  // of the box of images
  for (std::size_t lane = 0; lane < task.cells.size(); lane += hn::Lanes(d)) {
    V functional[K + 1], normal[K], magnitude = hn::Load(d, cached.lifts + lane), square_of_normal = zero;
    const auto is_finite = hn::Gt(magnitude, zero);
    for (std::size_t r = 0; r <= K; ++r) {
      functional[r] = hn::Load(d, gathered.functional(r) + lane);
      magnitude = hn::Add(magnitude, hn::Abs(functional[r]));
    }
    V at_apex = hn::Add(hn::IfThenElseZero(is_finite, hn::Set(d, task.row[K])), functional[K]);
    for (std::size_t r = 0; r < K; ++r) {
      at_apex = hn::MulAdd(functional[r], hn::Set(d, task.row[r]), at_apex);
      normal[r] = hn::Add(functional[r],
                          hn::Set(d, 2 * task.lift_weight[r] * task.row[r]));  // of a finite cell's sphere
      square_of_normal = hn::MulAdd(normal[r], normal[r], square_of_normal);
    }
    V residual = hn::Abs(at_apex), num_normal = zero, normal_sign = zero;
    EdgeProducts<V> edges{one, zero, zero, zero};
    for (std::size_t i = 0; i < K; ++i) {
      V value =
            hn::Add(hn::IfThenElseZero(is_finite, hn::Load(d, gathered.vertex(i, K) + lane)), functional[K]),
        square = zero;
      for (std::size_t r = 0; r < K; ++r) {
        const V image = hn::Load(d, gathered.vertex(i, r) + lane);
        V entry = hn::Sub(image, hn::Set(d, task.row[r]));
        value = hn::MulAdd(functional[r], image, value);
        if (i == K - 1) {
          const V to_infinity = edge_to_infinity(d, functional[r]);
          num_normal = hn::Add(num_normal, to_infinity);
          normal_sign = hn::MulAdd(to_infinity, functional[r], normal_sign);
          entry = hn::IfThenElse(is_finite, entry, to_infinity);
        }
        square = hn::MulAdd(entry, entry, square);
        hn::Store(entry, d, edge_entries + (i * K + r) * near_lanes + lane);
      }
      if (i == K - 1) value = hn::IfThenElseZero(is_finite, value);
      residual = hn::Max(residual, hn::Abs(value));
      edges.add(widened(d, task, square, one), square_of_edge_error);
    }
    const kernel::HWY_NAMESPACE::Entries<K, near_lanes, decltype(d)> entries{d, edge_entries + lane};
    V minors[std::size_t{1} << K];
    kernel::HWY_NAMESPACE::tabulate_minors<K>(entries, minors);
    const V others = hn::Sqrt(hn::Mul(hn::Set(d, K), edges.one_missing));  // ≥ Σ_i Π_(j≠i) of the lengths
    const V determinant_error = hn::MulAdd(hn::Set(d, task.edge_error), others,
                                           hn::Mul(hn::Set(d, expansion_error), hn::Sqrt(edges.all)));
    const V signed_determinant = minors[(std::size_t{1} << K) - 1];
    const V by_edges = hn::NegMulAdd(determinant_error, hn::Set(d, slack), hn::Abs(signed_determinant));
    const V by_pencil = hn::Load(d, cached.determinants + lane);
    const V determinant = hn::Max(by_edges, by_pencil);  // the pencil's bound may be the larger one
    // The functional of an infinite cell might have the wrong sign: it must have that of the orientation,
    // which must be certain.
    const V sign = hn::Mul(hn::Mul(signed_determinant, hn::Load(d, signs + lane)), normal_sign);
    const auto has_sign = hn::Or(
        is_finite, hn::And(hn::And(hn::Gt(by_edges, zero), hn::Gt(sign, zero)), hn::Eq(num_normal, one)));

    const V rounding = hn::Mul(hn::Set(d, task.evaluation_error), magnitude),
            error = hn::Add(residual, rounding);
    const auto is_proved =
        hn::And(hn::And(hn::Le(error, hn::Mul(hn::Set(d, gain), rounding)), hn::Lt(rounding, one)),
                hn::And(hn::Gt(determinant, hn::Set(d, certificate::smallest)), has_sign));
    const auto is_hopeless =
        hn::And(hn::And(hn::Eq(by_pencil, zero), hn::Lt(error, hn::Set(d, certificate::largest))),
                hn::Lt(hn::Mul(hn::Set(d, finer), hn::Abs(signed_determinant)), determinant_error));
    // Over a sum of lengths of cofactors.
    const V gradient_error = hn::Div(hn::Mul(hn::Set(d, 2.01), error), determinant);
    const V at_vertices = hn::Add(error, rounding);
    V threshold = hn::MulAdd(hn::Mul(gradient_error, others), diagonal, at_vertices);
    const V length_of_normal = hn::Sqrt(square_of_normal);  // for finite cells of the order of the radius
    const V low = hn::IfThenElse(is_finite,
                                 hn::Min(hn::Mul(square_of_normal, hn::Set(d, low_per_square)),
                                         hn::Mul(length_of_normal, hn::Set(d, low_per_radius))),
                                 hn::Set(d, low_of_infinite));
    if (K <= 4 || !hn::AllFalse(d, hn::And(is_proved, hn::Gt(threshold, low)))) {
      const V bend = hn::Set(d, task.bend);
      const auto is_large = hn::And(hn::And(is_finite, hn::Gt(bend, zero)), hn::Ge(square_of_normal, one));
      const V inverse_normal = hn::IfThenElseZero(is_large, hn::Div(one, length_of_normal));
      for (std::size_t r = 0; r < K; ++r) normal[r] = hn::Mul(normal[r], inverse_normal);
      const CofactorSums<V> cofactors = sum_cofactors<K>(entries, minors, normal);
      const V cofactor_errors = hn::MulAdd(hn::Set(d, cofactor_error), others,
                                           hn::Sqrt(hn::Mul(hn::Set(d, K * (K - 1)), edges.flat)));
      const V along = hn::Add(cofactors.along, cofactor_errors);
      const V across = hn::Add(hn::Sqrt(hn::Mul(hn::Set(d, K), cofactors.square_across)), cofactor_errors);
      const V kappa = hn::Mul(hn::Mul(gradient_error, along), inverse_normal);
      const V in_plane = hn::MulAdd(hn::Mul(gradient_error, across), diagonal, at_vertices);
      const V in_box = hn::MulAdd(hn::Mul(gradient_error, along), diagonal, in_plane);
      const V near_plane =
          hn::Mul(hn::MulAdd(kappa, bend, in_plane), hn::MulAdd(hn::Set(d, 3.0), kappa, one));
      const auto is_flat = hn::And(is_large, hn::Le(kappa, hn::Set(d, 0.25)));
      threshold = hn::Min(threshold, hn::IfThenElse(is_flat, hn::Min(in_box, near_plane), in_box));
    }
    hn::Store(hn::IfThenElse(is_proved, hn::Mul(threshold, hn::Set(d, slack)), hn::Inf(d)), d,
              thresholds + lane);
    hn::Store(error, d, errors + lane);
    hn::Store(hn::IfThenElseZero(is_proved, determinant), d, determinants + lane);
    hn::Store(hn::IfThenZeroElse(hn::Or(is_proved, is_hopeless), one), d, open + lane);
  }
  for (std::size_t lane = 0; lane < task.cells.size(); ++lane)
    certificates[lane] = {thresholds[lane], errors[lane], determinants[lane], open[lane] == 0};
}

void certify_by_edges_here(const NearTask& task, Index apex, EdgeCertificate* certificates) {
  internal::with_compiled_dimension<2, 6>(static_cast<std::size_t>(task.k), [&](auto k) {
    if constexpr (k() > 0) certify_by_edges_in<k()>(task, apex, certificates);
  });
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::geometry
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::geometry {

HWY_EXPORT(find_thresholds_here);
HWY_EXPORT(certify_by_edges_here);

void find_thresholds(const NearTask& task, double* thresholds) {
  HWY_DYNAMIC_DISPATCH(find_thresholds_here)(task, thresholds);
}

void certify_by_edges(const NearTask& task, Index apex, EdgeCertificate* certificates) {
  HWY_DYNAMIC_DISPATCH(certify_by_edges_here)(task, apex, certificates);
}

}  // namespace delone::geometry
#endif
