// SPDX-License-Identifier: BSD-3-Clause
// Triangles and tetrahedra have formulas of their own; other cells go by flags-inl.hpp.
//
// Errors, up to terms of second order (`slack`). Of the neighbors e, |e|², α and s² are given with relative
// errors u per coordinate, 5u, and 6u times s·|e|/2. Let ρ = Π|e_i|/D ≥ 1. Below, 1.155 = 2/√3 bounds the
// ratio of the norm of (|b_y·c_z| + |b_z·c_y|, …) to |b|·|c|.
#include "particles/pass/pieces_kernel.hpp"

#include "base/compiled_dimension.hpp"
#include "particles/pass/exact_sums.hpp"

#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "particles/pass/pieces_kernel.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#include "particles/pass/flags-inl.hpp"

#include <algorithm>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace delone::particles {
namespace HWY_NAMESPACE {

using kernel::unit_roundoff;

/// The records of the corners of as many cells as there are lanes, number j of corner i as one vector.
template <bool Weighted>
class CornerBlock {
 public:
  using Tag = hn::CappedTag<double, 8>;
  /// The last cell stands in for those that are not there.
  HWY_INLINE CornerBlock(std::size_t d, std::size_t first, std::size_t count,
                         const double* HWY_RESTRICT records, const std::uint32_t* HWY_RESTRICT corners) {
    const std::size_t size = record_size(d), used = Weighted ? size : d + square + 1,
                      lanes = hn::Lanes(Tag());
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::uint32_t* const of_cell = corners + std::min(first + lane, count - 1) * d;
      for (std::size_t i = 0; i < d; ++i) {
        const double* const record = records + of_cell[i] * size;
        for (std::size_t j = 0; j < used; ++j) numbers_[(i * size + j) * lanes + lane] = record[j];
      }
    }
  }
  HWY_INLINE auto operator()(std::size_t d, std::size_t i, std::size_t j) const {
    const auto load = [&](std::size_t at) {
      return hn::Load(Tag(), numbers_ + (i * record_size(d) + at) * hn::Lanes(Tag()));
    };
    if (Weighted || j < d) return load(j);
    return j == d + alpha ? 0.5 * load(d + square) : load(d + square);
  }

 private:
  alignas(64) double numbers_[most_lanes_dimension * record_size(most_lanes_dimension) * 8];
};

/// Cells of vertices a, b in the plane. With m_ab = |a|²·α_b − (a·b)·α_a, W_a = m_ab/D. m_ab is off by
/// 6.5u·(|a|²·s_b·|b| + |a||b|·s_a·|a|), D by 4.7u·|a||b|. As t_a·|a| ≤ s_a/2, that sums up to
///     ½·(6.5u·ρ·(s_a² + s_b²) + 4.7u·ρ·Σ|t·W|).
/// t_a is off by 3u·s_a/|a|, and |W_a| is at most ½·ρ·|a|·(s_a + s_b): another 1.5u·ρ·(s_a² + s_b²).
template <class V, class Load, class Store>
HWY_INLINE void find_triangle(Load load, Store store) {
  const V ax = load(0, 0), ay = load(0, 1), la = load(0, 2 + square), alpha_a = load(0, 2 + alpha);
  const V bx = load(1, 0), by = load(1, 1), lb = load(1, 2 + square), alpha_b = load(1, 2 + alpha);
  const V determinant = ax * by - ay * bx, inverse = number<V>(1) / determinant, box = abs(inverse);
  const V ab = ax * bx + ay * by;
  const V wa = (la * alpha_b - ab * alpha_a) * box, wb = (lb * alpha_a - ab * alpha_b) * box;
  const V xx = (alpha_a * by - alpha_b * ay) * inverse, xy = (alpha_b * ax - alpha_a * bx) * inverse;
  const V va = wa * (alpha_a / la), vb = wb * (alpha_b / lb);
  const V share = 1.0 / 6 * (va + vb);
  store(0, wa);
  store(1, wb);
  store(2, share * xx);
  store(3, share * xy);
  const V size = 0.5 * (abs(va) + abs(vb));
  store(4, size);
  const V rho = root(la * lb) * box;
  const V s2 = load(0, 2 + magnitude) + load(1, 2 + magnitude);
  store(5, slack * unit_roundoff * (rho * (5.0 * s2 + 4.7 * size) + 10.0 * size));
}

template <class V>
struct Vector3 {
  V x, y, z;
};
template <class V>
HWY_INLINE V dot(const Vector3<V>& a, const Vector3<V>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class V>
HWY_INLINE Vector3<V> cross(const Vector3<V>& a, const Vector3<V>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Cells of vertices a, b, c in space. With n_c = a × b, …, D = |a·n_a|, y = Σ α·n = ±D·x, and
/// q_c = (y·n_c)/(|n_c|²·D), the height of x over the face ab divided by |n_c|,
///     W_a = ½·(m_ab·q_c + m_ac·q_b),    m_ab = |a|²·α_b − (a·b)·α_a.
/// All pieces have the same x, so that what it is off by cancels in sums of thin cells.
///
/// Errors. n_c is off by 4.7u·|a||b|, D by 9.3u·Π|e|, and y by ½·Π|e|·Σs·(4.7 + 9)u. So x is off by
/// u·ρ·(7·Σs + 9.3·|x|) + 2u·|x|, and q_c, as |a||b|/|n_c| ≤ ρ, by u·ρ·(7·Σs + 36·|x|)/|n_c|. The square of
/// the parentheses is at most 300·Σs² + 2600·|x|². With B_c = |t_a·m_ab| + |t_b·m_ba| and by Cauchy's
/// inequality, the volumes that result are off by
///     ⅙·Σ_f B_f·|δq_f| ≤ ⅙·u·ρ·√(3·Σ_f B_f²/|n_f|²·(300·Σs² + 2600·|x|²)).
/// m_ab is off by 6.5u·(|a|²·s_b·|b| + |a||b|·s_a·|a|), and t_a·|a| ≤ s_a/2: another 2.2u·ρ·|x|·Σs².
/// t_a is off by 3u·s_a/|a|, and |W_a| is at most ½·ρ·|a|·|x|·Σs: another 1.5u·ρ·|x|·Σs².
template <bool Weighted, class V, class Load, class Store>
HWY_INLINE void find_tetrahedron(Load load, Store store) {
  const Vector3<V> a{load(0, 0), load(0, 1), load(0, 2)}, b{load(1, 0), load(1, 1), load(1, 2)},
      c{load(2, 0), load(2, 1), load(2, 2)};
  const V la = load(0, 3 + square), lb = load(1, 3 + square), lc = load(2, 3 + square);
  const V alpha_a = load(0, 3 + alpha), alpha_b = load(1, 3 + alpha), alpha_c = load(2, 3 + alpha);
  const Vector3<V> na = cross(b, c), nb = cross(c, a), nc = cross(a, b);
  const V determinant = dot(a, na), box = abs(determinant);
  const Vector3<V> y{alpha_a * na.x + alpha_b * nb.x + alpha_c * nc.x,
                     alpha_a * na.y + alpha_b * nb.y + alpha_c * nc.y,
                     alpha_a * na.z + alpha_b * nb.z + alpha_c * nc.z};
  const V one = number<V>(1), inverse = one / box;
  const V ra = one / dot(na, na), rb = one / dot(nb, nb), rc = one / dot(nc, nc);
  const V za = dot(y, na) * ra, zb = dot(y, nb) * rb, zc = dot(y, nc) * rc;
  const V qa = za * inverse, qb = zb * inverse, qc = zc * inverse;
  const V ab = dot(a, b), bc = dot(b, c), ca = dot(c, a);
  const V mab = la * alpha_b - ab * alpha_a, mba = lb * alpha_a - ab * alpha_b;
  const V mbc = lb * alpha_c - bc * alpha_b, mcb = lc * alpha_b - bc * alpha_c;
  const V mca = lc * alpha_a - ca * alpha_c, mac = la * alpha_c - ca * alpha_a;
  store(0, 0.5 * (mab * qc + mac * qb));
  store(1, 0.5 * (mbc * qa + mba * qc));
  store(2, 0.5 * (mca * qb + mcb * qa));
  const V half = number<V>(0.5);
  const V ta = Weighted ? alpha_a / la : half, tb = Weighted ? alpha_b / lb : half,
          tc = Weighted ? alpha_c / lc : half;
  const V va = tb * mbc + tc * mcb, vb = tc * mca + ta * mac, vc = ta * mab + tb * mba;
  // Twice the volumes over each face, times 3, and the centers of faces: x − z·n/D.
  const V ga = va * qa, gb = vb * qb, gc = vc * qc;
  const V signed_inverse = hn::CopySign(inverse, determinant),
          share = 1.0 / 12 * (ga + gb + gc) * signed_inverse;
  const V sa = 1.0 / 24 * (ga * za) * signed_inverse, sb = 1.0 / 24 * (gb * zb) * signed_inverse,
          sc = 1.0 / 24 * (gc * zc) * signed_inverse;
  store(3, share * y.x - (sa * na.x + sb * nb.x + sc * nc.x));
  store(4, share * y.y - (sa * na.y + sb * nb.y + sc * nc.y));
  store(5, share * y.z - (sa * na.z + sb * nb.z + sc * nc.z));
  const V ba = abs(tb * mbc) + abs(tc * mcb), bb = abs(tc * mca) + abs(ta * mac),
          bc2 = abs(ta * mab) + abs(tb * mba);
  const V size = 1.0 / 6 * (ba * abs(qa) + bb * abs(qb) + bc2 * abs(qc));
  store(6, size);
  const V s2 = load(0, 3 + magnitude) + load(1, 3 + magnitude) + load(2, 3 + magnitude);
  const V x2 = dot(y, y) * (inverse * inverse), product = la * lb * lc;
  const V spread = 3.0 * (ba * ba * ra + bb * bb * rb + bc2 * bc2 * rc) * (300.0 * s2 + 2600.0 * x2);
  const V rho2 = product * (inverse * inverse);
  const V error = 1.0 / 6 * root(rho2 * spread) + 4.0 * (root(rho2 * x2) * s2) + 10.0 * size;
  const V infinite = number<V>(std::numeric_limits<double>::infinity());
  store(7, select(rho2 < 1e24, slack * unit_roundoff * error, infinite));
}

template <int K, bool Weighted>
void find_simplex(const CornerBlock<Weighted>& block, std::size_t stride, double* pieces) {
  using V = hn::Vec<hn::CappedTag<double, 8>>;
  constexpr std::size_t k = static_cast<std::size_t>(K);
  Remainders<V, V, K, K> edges(k, k);
  V lambda[k], squares[k];
  for (std::size_t i = 0; i < k; ++i) {
    for (std::size_t j = 0; j < k; ++j) edges.r[i * k + j] = block(k, i, j);
    squares[i] = block(k, i, k + square);
    lambda[i] = root(squares[i]);
    edges.alpha[i] = block(k, i, k + alpha);
    edges.epsilon[i] = unit_roundoff * lambda[i];
    edges.tau[i] =
        static_cast<double>(k + 3) * unit_roundoff * (root(block(k, i, k + magnitude)) * lambda[i]);
  }
  Flags<V, K, K> flags(k, k);
  eliminate<V, V, K, K>(flags, lambda, unit_roundoff, Zero<K>(), Zero<K>(), edges);
  sum_flags<V, K, K>(flags, squares, [&](std::size_t i, V x) {
    hn::StoreU(x, hn::CappedTag<double, 8>(), pieces + i * stride);
  });
}

template <int K, bool Weighted>
void find(std::size_t count, const double* HWY_RESTRICT records, const std::uint32_t* HWY_RESTRICT corners,
          std::size_t stride, double* HWY_RESTRICT pieces) {
  const hn::CappedTag<double, 8> d;
  using V = hn::Vec<decltype(d)>;
  constexpr std::size_t k = static_cast<std::size_t>(K);
  for (std::size_t first = 0; first < count; first += hn::Lanes(d)) {
    const CornerBlock<Weighted> block(k, first, count, records, corners);
    const auto load = [&](std::size_t i, std::size_t j) { return block(k, i, j); };
    const auto store = [&](std::size_t i, V x) { hn::StoreU(x, d, pieces + i * stride + first); };
    if constexpr (K == 2)
      find_triangle<V>(load, store);
    else if constexpr (K == 3)
      find_tetrahedron<Weighted, V>(load, store);
    else
      find_simplex<K>(block, stride, pieces + first);
  }
}

void find_pieces_here(std::size_t d, bool weighted, std::size_t count, const double* records,
                      const std::uint32_t* corners, std::size_t stride, double* pieces) {
  internal::with_compiled_dimension<2, most_lanes_dimension>(d, [&](auto k) {
    if constexpr (k() > 0) {
      if (weighted)
        find<k(), true>(count, records, corners, stride, pieces);
      else
        find<k(), false>(count, records, corners, stride, pieces);
    }
  });
}

/// A column of `count` numbers, and zeros after it.
class Column {
 public:
  using Tag = hn::CappedTag<double, 8>;
  using V = hn::Vec<Tag>;
  HWY_INLINE Column(const double* numbers, std::size_t count) : numbers_(numbers), count_(count) {}
  HWY_INLINE V operator[](std::size_t first) const {
    if (first + hn::Lanes(Tag()) <= count_) return hn::LoadU(Tag(), numbers_ + first);
    return hn::MaskedLoad(hn::FirstN(Tag(), count_ - first), Tag(), numbers_ + first);
  }
  HWY_INLINE double largest() const {
    V result = hn::Zero(Tag());
    for (std::size_t c = 0; c < count_; c += hn::Lanes(Tag())) result = hn::Max(result, hn::Abs((*this)[c]));
    return hn::GetLane(hn::MaxOfLanes(Tag(), result));
  }

 private:
  const double* numbers_;
  std::size_t count_;
};

PieceTotals find_totals_here(std::size_t count, const double* sizes, const double* errors) {
  const auto total = [&](const double* numbers) {
    const Column column(numbers, count);
    const auto constant = number<Column::V>(TermSplitter(column.largest(), count).constant());
    auto sum = number<Column::V>(0);
    for (std::size_t c = 0; c < count; c += hn::Lanes(Column::Tag()))
      sum = sum + ((column[c] + constant) - constant);
    return hn::GetLane(hn::SumOfLanes(Column::Tag(), sum));
  };
  return {total(sizes), total(errors)};
}

void split_pieces_here(std::size_t k, std::size_t d, std::size_t count, std::size_t stride,
                       double* HWY_RESTRICT pieces, double* HWY_RESTRICT first_parts,
                       double* HWY_RESTRICT moment) {
  using V = Column::V;
  const Column::Tag tag;
  const auto column = [&](std::size_t i) { return Column(pieces + i * stride, count); };
  const auto constants = [&](std::size_t begin, std::size_t end) {
    double largest = 0;
    for (std::size_t i = begin; i < end; ++i) largest = std::max(largest, column(i).largest());
    TermSplitter splitter(largest, count);
    const V first = number<V>(splitter.constant());
    return std::pair(first, splitter.next() ? number<V>(splitter.constant()) : number<V>(0));
  };
  const auto [a, b] = constants(0, k);
  for (std::size_t i = 0; i < k; ++i)
    for (std::size_t c = 0; c < count; c += hn::Lanes(tag)) {
      const V x = column(i)[c], first = (x + a) - a;
      hn::StoreU(first, tag, first_parts + i * stride + c);
      hn::StoreU(((x - first) + b) - b, tag, pieces + i * stride + c);
    }
  const auto [a2, b2] = constants(k, k + d);
  for (std::size_t j = 0; j < d; ++j) {
    V first_sum = number<V>(0), second_sum = first_sum;
    for (std::size_t c = 0; c < count; c += hn::Lanes(tag)) {
      const V x = column(k + j)[c], first = (x + a2) - a2;
      first_sum = first_sum + first;
      second_sum = second_sum + (((x - first) + b2) - b2);
    }
    moment[j] = hn::GetLane(hn::SumOfLanes(tag, first_sum)) + hn::GetLane(hn::SumOfLanes(tag, second_sum));
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::particles
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::particles {

HWY_EXPORT(find_pieces_here);
HWY_EXPORT(find_totals_here);
HWY_EXPORT(split_pieces_here);

void find_pieces_in_lanes(std::size_t d, bool weighted, std::size_t count, const double* records,
                          const std::uint32_t* corners, std::size_t stride, double* pieces) {
  HWY_DYNAMIC_DISPATCH(find_pieces_here)(d, weighted, count, records, corners, stride, pieces);
}

PieceTotals find_totals(std::size_t count, const double* sizes, const double* errors) {
  return HWY_DYNAMIC_DISPATCH(find_totals_here)(count, sizes, errors);
}

void split_pieces(std::size_t k, std::size_t d, std::size_t count, std::size_t stride, double* pieces,
                  double* first_parts, double* moment) {
  HWY_DYNAMIC_DISPATCH(split_pieces_here)(k, d, count, stride, pieces, first_parts, moment);
}

}  // namespace delone::particles
#endif
