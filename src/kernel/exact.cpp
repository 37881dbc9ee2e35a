// SPDX-License-Identifier: BSD-3-Clause
// Every finite double is an integer multiple of a power of two. A column of a determinant may be scaled by any positive
// factor, so each coordinate gets the coarsest grid that its values lie on, and the entries become integers. Their number of
// bits bounds the determinant, and the narrowest integer type that holds every minor is chosen: 64 and 128 bits for lattices,
// 512 and 1024 bits for most doubles, unbounded integers for the rest.
#include "kernel/exact.hpp"

#include "kernel/grid.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace delone::kernel {
namespace {

namespace mp = boost::multiprecision;
template <unsigned Bits>
using FixedInteger = mp::number<mp::cpp_int_backend<Bits, Bits, mp::signed_magnitude, mp::unchecked, void>, mp::et_off>;
using BigInteger = mp::number<mp::cpp_int_backend<>, mp::et_off>;
__extension__ typedef __int128 Int128;  // NOLINT(modernize-use-using): the extension mark needs it

/// A finite double as mantissa·2^exponent, |mantissa| < 2^53.
struct Binary {
  std::int64_t mantissa;
  int exponent;
};
Binary decompose(double x) {
  const auto bits = std::bit_cast<std::uint64_t>(x);
  const auto fraction = static_cast<std::int64_t>(bits & ((std::uint64_t{1} << 52) - 1));
  const int biased = static_cast<int>(bits >> 52 & 0x7ff);
  const std::int64_t magnitude = biased == 0 ? fraction : fraction | std::int64_t{1} << 52;
  return {std::signbit(x) ? -magnitude : magnitude, std::max(biased, 1) - 1075};
}

/// x·2^−grid as an integer. REQUIRES x on that grid, and that Integer holds the result.
template <class Integer>
Integer to_integer(double x, int grid) {
  if (x == 0) return Integer(0);
  const Binary binary = decompose(x);
  const int shift = binary.exponent - grid;
  if (shift <= 0) return Integer(binary.mantissa >> -shift);  // exact: x lies on the grid, so the bits shifted out are zero
  return Integer(binary.mantissa) * (Integer(1) << shift);
}

template <class Integer>
Sign sign_of(const Integer& x) {
  return x > 0 ? Sign::positive : x < 0 ? Sign::negative : Sign::zero;
}

/// Laplace expansion over all minors of the first rows: n·2^(n−1) products of a minor and an entry, no division.
template <class Integer>
Sign sign_by_minors(const std::vector<Integer>& a, int n) {
  std::vector<Integer> minors(std::size_t{1} << n, Integer(0));
  minors[0] = 1;
  for (std::size_t subset = 1; subset < minors.size(); ++subset) {
    const int row = std::popcount(subset) - 1;
    Integer sum(0);
    bool negate = (row & 1) != 0;  // the sign of the cofactor of the lowest column of the subset
    for (std::size_t rest = subset; rest != 0; rest &= rest - 1, negate = !negate) {
      const int c = std::countr_zero(rest);
      const Integer& entry = a[static_cast<std::size_t>(row * n + c)];
      const Integer& minor = minors[subset & ~(std::size_t{1} << c)];
      if (entry == 0 || minor == 0) continue;
      if (negate)
        sum -= entry * minor;
      else
        sum += entry * minor;
    }
    minors[subset] = std::move(sum);
  }
  return sign_of(minors.back());
}

/// Fraction-free elimination (Bareiss 1968, doi:10.1090/S0025-5718-1968-0226829-0): every intermediate value is a minor.
template <class Integer>
Sign sign_by_elimination(std::vector<Integer> a, int n) {
  const auto at = [&](int r, int c) -> Integer& { return a[static_cast<std::size_t>(r * n + c)]; };
  Integer previous(1);
  bool negate = false;
  for (int s = 0; s + 1 < n; ++s) {
    int pivot = s;
    while (pivot < n && at(pivot, s) == 0) ++pivot;
    if (pivot == n) return Sign::zero;
    if (pivot != s) {
      for (int c = 0; c < n; ++c) std::swap(at(pivot, c), at(s, c));
      negate = !negate;
    }
    for (int r = s + 1; r < n; ++r)
      for (int c = s + 1; c < n; ++c) at(r, c) = (at(r, c) * at(s, s) - at(r, s) * at(s, c)) / previous;
    previous = at(s, s);
  }
  const Sign sign = sign_of(at(n - 1, n - 1));
  return negate ? -sign : sign;
}

/// One determinant: rows p_i − base, columns the axes of the flat and, for a sphere, the squared length.
class Problem {
 public:
  Problem(const Flat& flat, const double* const* points, const double* base, bool with_lift)
      : flat_(flat), points_(points), base_(base), with_lift_(with_lift), n_(flat.dimension() + (with_lift ? 1 : 0)) {}

  Sign sign() {
    measure();
    if (has_zero_column_) return Sign::zero;
    // A minor of size s is at most s! times the product of its columns' largest entries.
    double factorial_bits = 1;
    for (int i = 2; i <= n_; ++i) factorial_bits += std::log2(i);
    const double bits = entry_bits_ + std::ceil(factorial_bits);
    constexpr int largest_for_minors = 8;
    if (n_ <= largest_for_minors) {
      if (bits <= 62) return sign_by_minors(entries<std::int64_t>(), n_);
      if (bits <= 126) return sign_by_minors(entries<Int128>(), n_);
      if (bits <= 510) return sign_by_minors(entries<FixedInteger<512>>(), n_);
      if (bits <= 1022) return sign_by_minors(entries<FixedInteger<1024>>(), n_);
      return sign_by_minors(entries<BigInteger>(), n_);
    }
    if (bits <= 62) return sign_by_elimination(entries<Int128>(), n_);
    return sign_by_elimination(entries<BigInteger>(), n_);
  }

 private:
  /// The grid of each axis, and the bits of the determinant's entries: a sum over the columns of the bits of the largest.
  void measure() {
    const int ambient = flat_.ambient;
    const std::size_t rows = static_cast<std::size_t>(n_);
    grid_.resize(static_cast<std::size_t>(ambient));
    std::vector<int> bits(static_cast<std::size_t>(ambient), 0);
    finest_ = std::numeric_limits<int>::max();
    for (int j = 0; j < ambient; ++j) {
      int grid = trailing_exponent(base_[j]);
      int top = std::numeric_limits<int>::min();  // every |coordinate| is below 2^top
      bool all_equal = true;
      const auto include = [&](double x) {
        if (x == 0) return;
        grid = std::min(grid, trailing_exponent(x));
        top = std::max(top, std::ilogb(x) + 1);
      };
      include(base_[j]);
      for (std::size_t i = 0; i < rows; ++i) {
        include(points_[i][j]);
        all_equal = all_equal && points_[i][j] == base_[j];
      }
      const auto axis = static_cast<std::size_t>(j);
      if (all_equal) {
        grid_[axis] = std::numeric_limits<int>::max();  // all differences are zero
        continue;
      }
      grid_[axis] = grid;
      bits[axis] = top + 1 - grid;
      finest_ = std::min(finest_, grid);
    }
    entry_bits_ = 0;
    for (const int axis : flat_.axes) {
      if (bits[static_cast<std::size_t>(axis)] == 0) has_zero_column_ = true;
      entry_bits_ += bits[static_cast<std::size_t>(axis)];
    }
    widest_ = 0;
    for (std::size_t axis = 0; axis < bits.size(); ++axis)
      if (bits[axis] > 0) widest_ = std::max(widest_, bits[axis] + grid_[axis] - finest_);
    if (with_lift_) entry_bits_ += 2.0 * widest_ + ambient_bits();
  }

  /// The matrix, row by row. Differences of coordinates and their squares are taken in the narrowest type that holds them.
  template <class Integer>
  std::vector<Integer> entries() const {
    if (2 * widest_ + ambient_bits() <= 126) return entries_from<Integer, Int128, Int128>();
    if (widest_ <= 126) return entries_from<Integer, Int128, Integer>();
    return entries_from<Integer, Integer, Integer>();
  }

  template <class Integer, class Difference, class Lift>
  std::vector<Integer> entries_from() const {
    const std::size_t n = static_cast<std::size_t>(n_);
    std::vector<Integer> a(n * n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t r = 0; r < flat_.axes.size(); ++r)
        a[i * n + r] = static_cast<Integer>(difference<Difference>(i, static_cast<std::size_t>(flat_.axes[r])));
      if (!with_lift_) continue;
      Lift lift(0);
      for (std::size_t axis = 0; axis < grid_.size(); ++axis) {
        if (points_[i][axis] == base_[axis]) continue;
        const Lift d = static_cast<Lift>(difference<Difference>(i, axis)) * (Lift(1) << (grid_[axis] - finest_));
        lift += d * d;
      }
      a[i * n + n - 1] = static_cast<Integer>(lift);
    }
    return a;
  }

  template <class Integer>
  Integer difference(std::size_t i, std::size_t axis) const {
    return to_integer<Integer>(points_[i][axis], grid_[axis]) - to_integer<Integer>(base_[axis], grid_[axis]);
  }

  double ambient_bits() const { return std::ceil(std::log2(flat_.ambient) + 1); }

  const Flat& flat_;
  const double* const* points_;
  const double* base_;
  bool with_lift_;
  int n_;
  std::vector<int> grid_;
  int finest_ = 0;  // of the grids of all axes along which points differ
  int widest_ = 0;  // the bits of the largest difference, in units of the finest grid
  double entry_bits_ = 0;
  bool has_zero_column_ = false;
};

}  // namespace

Sign exact_orientation(const Flat& flat, const double* const* points, const double* base) {
  return Problem(flat, points, base, false).sign();
}

Sign exact_sphere(const Flat& flat, const double* const* points, const double* q) {
  return Problem(flat, points, q, true).sign();
}

}  // namespace delone::kernel
