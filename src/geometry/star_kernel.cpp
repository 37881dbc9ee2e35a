// SPDX-License-Identifier: BSD-3-Clause
// The pencil identity. With a = h_A(q) ≤ 0 and b = h_B(q) ≥ 0, the functional of the cell that joins q to the
// common facet of A and B is (b·h_A − a·h_B)/ν, where ν is
//   A, B finite         b − a                                a convex combination
//   A finite, B not     b
//   B finite, A not     −a
//   neither finite      the largest |b·g_A,r − a·g_B,r|      so that the largest coefficient becomes ±1
// and in all four cases ν is the height of q over the facet in the units in which that of the opposite vertex
// of A (in the third row, of B) is the value there of the other functional. Weights are non-negative, so
// errors at the facet's vertices combine with the same weights and grow with the number of generations at
// most linearly; at q the error is one evaluation's. The determinant of the new cell's edge vectors follows
// from that of A (or B) by the ratio of heights over the facet. Proofs: docs/predicates.md, "The pencil".
#include "geometry/star_kernel.hpp"

#include "base/compiled_dimension.hpp"
#include "geometry/cache_line.hpp"
#include "geometry/certificate.hpp"
#include "geometry/pair.hpp"

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstdint>

#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "geometry/star_kernel.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#ifndef DELONE_STAR_BLOCK
#define DELONE_STAR_BLOCK
namespace delone::geometry {

/// Facets are processed in blocks that fit in the L1 cache.
constexpr std::size_t block_size = 32;
/// A threshold beyond this fraction of the functional's scale would leave too many tests open.
constexpr double weakest = 0x1p-7;
/// The same fractions of the radius of a sphere that is far larger than the box, and of the normal of an
/// infinite cell. Values are much smaller near such cells. Up to four dimensions the fractions are small, as
/// better certificates, by edges, are cheap there.
constexpr double weakest_of_large(std::size_t k) { return k <= 4 ? 0x1p-25 : 0x1p-10; }
constexpr double weakest_of_infinite(std::size_t k) { return k <= 4 ? 0x1p-20 : 0x1p-7; }
/// The least factor by which thresholds of such spheres must shrink, and the largest part of a value that may
/// be an error.
constexpr double least_shrinking = 2, most_kappa = 0.25;
/// The arrays of a block, `block_size` entries of 64 bits each. A and B are the cells of a facet, N the new
/// cell.
enum BlockArray : std::size_t {
  value_a,
  value_b,
  certificate_a,   // in the end that of N
  certificate_b,   // in the end not zero if the certificate of N is too weak
  opposite_value,  // of the other functional at the vertex opposite the facet
  coefficients     // those of A, in the end those of N; then those of B
};

}  // namespace delone::geometry
#endif

HWY_BEFORE_NAMESPACE();
namespace delone::geometry {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

inline std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }

/// The functionals and certificates of all cells. K is k, or 0 for any.
template <int K>
cells::CellRecords<K> records_of(const StarTask& task) {
  return {cells::CellLayout<K>(task.k, task.ids), task.functionals, task.certificates};
}

/// The value of B at the vertex of A opposite the facet; with A alone infinite, the other way round.
template <int K>
HWY_INLINE double value_at_opposite(const StarTask& task, const cells::CellRecords<K>& records,
                                    const cells::HorizonFacet& facet) {
  const auto k = static_cast<std::size_t>(K > 0 ? K : task.k);
  const auto is_infinite = [&](Index cell) {
    return certificate::infinite(bits_of(*records.certificate(cell)));
  };
  // The dead one and not the other is infinite: without a branch, as it would be unpredictable.
  const bool swapped = is_infinite(facet.dead) > is_infinite(facet.survivor);
  const Index cell = swapped ? facet.dead : facet.survivor;
  const Index vertex = swapped ? facet.survivor_opposite : facet.dead_opposite;
  const double* functional = records.functional(cell);
  const auto row = task.rows.row<K>(vertex, static_cast<int>(k));
  const double last = row[k];
  Pair sums{task.lifted ? functional[k] : functional[k] * last, 0};
  for (std::size_t r = 0; r + 1 < k; r += 2) sums += load_pair(functional + r) * load_pair(&row[r]);
  double value = sums[0] + sums[1];
  if (k % 2 == 1) value += functional[k - 1] * row[k - 1];
  const std::uint64_t reference =
      bits_of(task.lifted ? last : 1.0) & certificate::finite_mask(bits_of(*records.certificate(cell)));
  return value + std::bit_cast<double>(reference);
}

/// Gathers the input of a block, one facet per lane, two facets at a time. K is k, or 0 for any k.
template <int K>
void gather(const StarTask& task, std::span<const cells::HorizonFacet> facets, double* HWY_RESTRICT block) {
  const auto entries = static_cast<std::size_t>(K > 0 ? K : task.k) + 1;
  const cells::CellRecords<K> records = records_of<K>(task);
  for (std::size_t lane = 0; lane < facets.size(); lane += 2) {
    const cells::HorizonFacet& one = facets[lane];
    const cells::HorizonFacet& two = facets[std::min(lane + 1, facets.size() - 1)];
    // Keeps this one loop: several would cost a branch misprediction each, at their ends.
    std::atomic_signal_fence(std::memory_order_seq_cst);
    const auto put = [&](std::size_t array, double of_one, double of_two) {
      store_pair(block + array * block_size + lane, Pair{of_one, of_two});
    };
    const auto put_cells = [&](Index of_one, Index of_two, std::size_t first_coefficient,
                               std::size_t certificate) {
      const double* f = records.functional(of_one);
      const double* g = records.functional(of_two);
      for (std::size_t r = 0; r + 1 < entries; r += 2) {
        const Pair from_one = load_pair(f + r), from_two = load_pair(g + r);
        put(first_coefficient + r, from_one[0], from_two[0]);
        put(first_coefficient + r + 1, from_one[1], from_two[1]);
      }
      if (entries % 2 == 1) put(first_coefficient + entries - 1, f[entries - 1], g[entries - 1]);
      put(certificate, *records.certificate(of_one), *records.certificate(of_two));
    };
    put_cells(one.dead, two.dead, coefficients, certificate_a);
    put_cells(one.survivor, two.survivor, coefficients + entries, certificate_b);
    put(value_a, one.dead_value, two.dead_value);
    put(value_b, one.survivor_value, two.survivor_value);
    put(opposite_value, value_at_opposite(task, records, one), value_at_opposite(task, records, two));
  }
}

/// Computes a block in place. K is k, or 0 for any.
template <int K>
void compute(const StarTask& task, std::size_t count, double* HWY_RESTRICT block) {
  const hn::CappedTag<double, block_size> d;
  const hn::RebindToUnsigned<decltype(d)> du;
  const hn::RebindToSigned<decltype(d)> di;
  using V = hn::Vec<decltype(d)>;
  using U = hn::Vec<decltype(du)>;
  const auto k = static_cast<std::size_t>(K > 0 ? K : task.k);
  const FrameConstants& frame = task.frame;
  constexpr double slack = 0x1p-40;  // covers the few roundings of positive quantities
  const V zero = hn::Zero(d), one = hn::Set(d, 1.0);
  const U bias = hn::Set(du, certificate::bias);
  for (std::size_t lane = 0; lane < count; lane += hn::Lanes(d)) {
    const auto load = [&](std::size_t array) { return hn::Load(d, block + array * block_size + lane); };
    const auto coefficient_a = [&](std::size_t r) { return load(coefficients + r); };
    const auto coefficient_b = [&](std::size_t r) { return load(coefficients + k + 1 + r); };
    const U of_a = hn::BitCast(du, load(certificate_a)), of_b = hn::BitCast(du, load(certificate_b));
    const auto is_infinite = [&](U packed) {
      return hn::RebindMask(
          d, hn::MaskFromVec(hn::BroadcastSignBit(hn::BitCast(di, hn::ShiftLeft<32>(packed)))));
    };
    const auto unpack = [&](U bits) {
      return hn::BitCast(d, hn::Add(hn::ShiftLeft<certificate::fraction_shift>(bits), bias));
    };
    const auto unpack_short = [&](U bits) {
      return hn::BitCast(d, hn::Add(hn::ShiftLeft<certificate::short_shift>(bits), bias));
    };
    const U threshold_bits = hn::Set(du, 0x7fffffff), short_bits = hn::Set(du, 0x7fff);
    // Exact stages may have decided that the signs are these: then 0 is closer to the true value than a
    // computed value of the wrong sign.
    const V a = hn::Min(load(value_a), zero), b = hn::Max(load(value_b), zero), minus_a = hn::Neg(a);
    // Bounds the error of a value; for flat cells the threshold alone does so only for values within it.
    const auto error_of = [&](V threshold, V value) {
      return hn::MulAdd(hn::Mul(threshold, value), hn::Set(d, frame.per_bend), threshold);
    };
    const V t_a = error_of(unpack(hn::And(of_a, threshold_bits)), minus_a);
    const V t_b = error_of(unpack(hn::And(of_b, threshold_bits)), b);
    const V e_a = unpack_short(hn::And(hn::ShiftRight<32>(of_a), short_bits));
    const V e_b = unpack_short(hn::And(hn::ShiftRight<32>(of_b), short_bits));
    const auto a_is_infinite = is_infinite(of_a), b_is_infinite = is_infinite(of_b);
    const auto infinite = hn::And(a_is_infinite, b_is_infinite);
    const auto swapped = hn::AndNot(b_is_infinite, a_is_infinite);
    const auto swapped_bits = hn::RebindMask(du, swapped);
    const U packed_determinant =
        hn::And(hn::ShiftRight<48>(hn::IfThenElse(swapped_bits, of_b, of_a)), short_bits);
    const V old_determinant = hn::IfThenZeroElse(hn::RebindMask(d, hn::Eq(packed_determinant, hn::Zero(du))),
                                                 unpack_short(packed_determinant));

    V height = hn::IfThenElse(b_is_infinite, b, hn::IfThenElse(a_is_infinite, minus_a, hn::Sub(b, a)));
    V height_error = hn::Add(hn::IfThenZeroElse(b_is_infinite, t_a), hn::IfThenZeroElse(a_is_infinite, t_b));
    const bool some_infinite = !hn::AllFalse(d, infinite);
    if (some_infinite) {
      V largest = zero, normal_a = zero, normal_b = zero;
      for (std::size_t r = 0; r < k; ++r) {
        const V from_a = coefficient_a(r), from_b = coefficient_b(r);
        const V g = hn::Abs(hn::Add(hn::Mul(b, from_a), hn::Mul(minus_a, from_b)));
        const auto larger = hn::Gt(g, largest);
        largest = hn::IfThenElse(larger, g, largest);
        normal_a = hn::IfThenElse(larger, hn::Abs(from_a), normal_a);
        normal_b = hn::IfThenElse(larger, hn::Abs(from_b), normal_b);
      }
      const V error = hn::Add(hn::Mul(hn::Add(hn::Add(b, normal_b), t_b), t_a),
                              hn::Mul(hn::Add(hn::Add(normal_a, minus_a), t_a), t_b));
      height = hn::IfThenElse(infinite, largest, height);
      height_error = hn::IfThenElse(infinite, error, height_error);
    }
    // Divisions have the longest latency: as few as possible, and none depends on the radius.
    const V inverse_height = hn::Div(one, height), x = hn::Mul(b, inverse_height),
            y = hn::Mul(minus_a, inverse_height);
    const V opposite = load(opposite_value),
            opposite_threshold = unpack(hn::And(hn::IfThenElse(swapped_bits, of_a, of_b), threshold_bits));
    const V opposite_height = hn::Add(opposite, error_of(opposite_threshold, hn::Abs(opposite)));
    const V moved_determinant = hn::Mul(old_determinant, hn::Sub(height, height_error));
    const V det = hn::Mul(hn::Div(moved_determinant, opposite_height), hn::Set(d, 1 - slack));
    const V inverse_det =
        hn::Mul(hn::Div(opposite_height, moved_determinant), hn::Set(d, 1 + 2 * slack));  // ≥ 1/det

    const V largest_reference = hn::Set(d, frame.largest_reference);
    const V reference_weight = hn::IfThenZeroElse(infinite, one);
    V parts = hn::Mul(hn::Add(hn::IfThenZeroElse(a_is_infinite, x), hn::IfThenZeroElse(b_is_infinite, y)),
                      largest_reference);
    V magnitude = hn::Mul(reference_weight, largest_reference);
    V at_q = hn::Mul(reference_weight, hn::Set(d, task.lifted ? task.query_row[k] : 1.0));
    V gradient_square = zero;  // in the metric of lifts
    auto normal_is_due = infinite;
    V g = zero;
    for (std::size_t r = 0; r <= k; ++r) {
      const V from_a = hn::Mul(x, coefficient_a(r)), from_b = hn::Mul(y, coefficient_b(r));
      g = hn::Add(from_a, from_b);
      parts = hn::Add(parts, hn::Add(hn::Abs(from_a), hn::Abs(from_b)));
      magnitude = hn::Add(magnitude, hn::Abs(g));
      if (some_infinite && r < k) {
        // The normal coefficient is the first whose unscaled magnitude is the height.
        const V unscaled = hn::Abs(hn::Add(hn::Mul(b, coefficient_a(r)), hn::Mul(minus_a, coefficient_b(r))));
        const auto is_normal = hn::And(normal_is_due, hn::Eq(unscaled, height));
        normal_is_due = hn::AndNot(is_normal, normal_is_due);
        g = hn::IfThenElse(is_normal, hn::CopySign(one, g), g);
      }
      at_q = hn::MulAdd(g, hn::Set(d, r < k || !task.lifted ? task.query_row[r] : 1.0), at_q);
      if (r < k) {
        const V t = hn::Mul(g, hn::Set(d, frame.extent_ratio[r]));
        gradient_square = hn::MulAdd(t, t, gradient_square);
      }
      hn::Store(g, d, block + (coefficients + r) * block_size + lane);
    }

    const V rounding = hn::Mul(hn::Set(d, frame.evaluation_error), magnitude);
    const V error_at_facet =
        hn::Add(hn::Add(hn::Mul(x, e_a), hn::Mul(y, e_b)), hn::Mul(hn::Set(d, 6 * 0x1p-53), parts));
    const V error = hn::Mul(hn::Max(error_at_facet, hn::Add(hn::Abs(at_q), rounding)), hn::Set(d, 1 + slack));
    V power = hn::Set(d, frame.finite_spread);
    V limit = hn::Mul(hn::Set(d, weakest), height);  // without a radius, values near the cell are this large
    V radius_square = zero, radius_error = zero;
    if (frame.uses_radius) {
      // All vertices are within R of the centre of the approximate sphere: |h̃| ≤ error there.
      radius_error = hn::Mul(hn::Set(d, 8 * 0x1p-53), hn::Add(magnitude, gradient_square));
      radius_square =
          hn::Add(hn::Add(hn::Sub(hn::Mul(gradient_square, hn::Set(d, 0.25)), g), error), radius_error);
      const V square = hn::Min(radius_square, hn::Set(d, frame.largest_radius * frame.largest_radius));
      for (std::size_t r = 2; r < k; r += 2) power = hn::Mul(power, square);
      if (k % 2 == 0) power = hn::Mul(power, hn::Sqrt(square));
      limit = hn::Mul(hn::Set(d, weakest), radius_square);
    }
    power = hn::IfThenElse(infinite, hn::Set(d, frame.infinite_spread), power);
    limit = hn::IfThenElse(infinite, hn::Set(d, weakest_of_infinite(k)), limit);
    // In the box, besides the error at the vertices.
    V distance_error = hn::Mul(error, hn::Mul(power, inverse_det));
    V flat_growth = hn::Set(d, 1 + slack);
    if (frame.bend > 0) {
      // Spheres far larger than the box are nearly planes in it: small values are near the cell's plane.
      const double least_radius = least_shrinking * frame.flatness * frame.bend;
      const auto is_large =
          hn::AndNot(infinite, hn::Gt(radius_square, hn::Set(d, least_radius * least_radius)));
      if (!hn::AllFalse(d, is_large)) {
        const V margin = hn::Add(radius_error, error);
        // A lower bound.
        const V radius = hn::Sqrt(hn::Max(hn::NegMulAdd(hn::Set(d, 2.0), margin, radius_square), one));
        const V kappa = hn::Mul(distance_error, hn::Div(hn::Set(d, frame.flatness), radius));
        const auto is_flat = hn::And(
            hn::And(is_large, hn::Le(kappa, hn::Set(d, most_kappa))),
            hn::And(hn::Lt(margin, hn::Set(d, frame.bend / 1024)), hn::Gt(radius, hn::Set(d, least_radius))));
        distance_error =
            hn::IfThenElse(is_flat, hn::Mul(kappa, hn::Set(d, 1.004 * frame.bend)), distance_error);
        flat_growth = hn::IfThenElse(is_flat, hn::MulAdd(hn::Set(d, 3.001), kappa, flat_growth), flat_growth);
        limit = hn::IfThenElse(is_large, hn::Mul(radius, hn::Set(d, weakest_of_large(k))), limit);
      }
    }
    const V threshold = hn::Mul(hn::Add(hn::Add(error, distance_error), rounding), flat_growth);
    // If anything is NaN, a comparison fails.
    const V smallest = hn::Set(d, certificate::smallest), largest = hn::Set(d, certificate::largest);
    const auto usable = hn::And(hn::And(hn::Ge(det, smallest), hn::Le(det, largest)),
                                hn::And(hn::Le(threshold, limit), hn::Lt(threshold, largest)));
    const auto pack = [&](V positive) { return hn::Sub(hn::BitCast(du, positive), bias); };
    // The determinant and the infinite bit of a certificate are read even if it is too weak, so no field may
    // overflow into another.
    const auto clamped = [&](V bound) {
      return hn::IfThenElse(hn::Lt(bound, largest), hn::Max(bound, smallest), largest);
    };
    const U up =
        hn::Add(hn::ShiftRight<certificate::fraction_shift>(pack(clamped(threshold))), hn::Set(du, 1));
    const U error_up =
        hn::Add(hn::ShiftRight<certificate::short_shift>(pack(clamped(error))), hn::Set(du, 1));
    const auto has_determinant = hn::RebindMask(du, hn::And(hn::Ge(det, smallest), hn::Le(det, largest)));
    const U down = hn::IfThenElseZero(has_determinant, hn::ShiftRight<certificate::short_shift>(pack(det)));
    const U infinite_bit =
        hn::IfThenElseZero(hn::RebindMask(du, infinite), hn::Set(du, std::uint64_t{1} << 31));
    const U packed =
        hn::Or(hn::Or(up, infinite_bit), hn::Or(hn::ShiftLeft<32>(error_up), hn::ShiftLeft<48>(down)));
    hn::Store(hn::BitCast(d, packed), d, block + certificate_a * block_size + lane);
    hn::Store(hn::IfThenZeroElse(usable, one), d, block + certificate_b * block_size + lane);
  }
}

/// Writes the functionals and certificates of a block. Returns how many entries of `weak` it has written.
template <int K>
std::size_t scatter(const StarTask& task, std::span<const cells::HorizonFacet> facets, std::size_t first,
                    const double* HWY_RESTRICT block, std::uint32_t* HWY_RESTRICT weak) {
  const auto entries = static_cast<std::size_t>(K > 0 ? K : task.k) + 1;
  const double* result = block + coefficients * block_size;
  const cells::CellRecords<K> records = records_of<K>(task);
  std::size_t num_weak = 0;
  for (std::size_t lane = 0; lane < facets.size(); ++lane) {
    double* HWY_RESTRICT functional = records.functional(facets[lane].created);
    double* HWY_RESTRICT certificate = records.certificate(facets[lane].created);
    const double packed = block[certificate_a * block_size + lane];
    const auto entry = [&](std::size_t r) { return result[r * block_size + lane]; };
    for (std::size_t r = 0; r + 1 < entries; r += 2) store_pair(functional + r, Pair{entry(r), entry(r + 1)});
    if (entries % 2 == 0) {
      *certificate = packed;
    } else if (certificate == functional + entries) {
      store_pair(functional + entries - 1, Pair{entry(entries - 1), packed});
    } else {
      functional[entries - 1] = entry(entries - 1);
      *certificate = packed;
    }
    weak[num_weak] = static_cast<std::uint32_t>(first + lane);
    num_weak += bits_of(block[certificate_b * block_size + lane]) != 0;
  }
  return num_weak;
}

template <int K>
std::size_t combine_blocks(const StarTask& task, double* block) {
  const int k = K > 0 ? K : task.k;
  std::size_t num_weak = 0;
  for (std::size_t first = 0; first < task.facets.size(); first += block_size) {
    const auto facets = task.facets.subspan(first, std::min(block_size, task.facets.size() - first));
    // Vertices are scattered in memory: all rows of a block are prefetched together.
    for (const cells::HorizonFacet& facet : facets) {
      task.rows.prefetch(facet.dead_opposite, k);
      task.rows.prefetch(facet.survivor_opposite, k);
    }
    gather<K>(task, facets, block);
    compute<K>(task, facets.size(), block);
    num_weak += scatter<K>(task, facets, first, block, task.weak + num_weak);
  }
  return num_weak;
}

std::size_t combine_star_here(const StarTask& task, double* block) {
  return internal::with_compiled_dimension<2, 7>(static_cast<std::size_t>(task.k),
                                                 [&](auto k) { return combine_blocks<k()>(task, block); });
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::geometry
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::geometry {

HWY_EXPORT(combine_star_here);

std::size_t star_scratch(int k) {
  return block_size * (coefficients + 2 * (static_cast<std::size_t>(k) + 1)) + cache_line_of<double>;
}

std::size_t combine_star(const StarTask& task) {
  return HWY_DYNAMIC_DISPATCH(combine_star_here)(task, at_cache_line(task.scratch));
}

}  // namespace delone::geometry
#endif
