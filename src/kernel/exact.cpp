// SPDX-License-Identifier: BSD-3-Clause
// Every finite double is an integer multiple of a power of two. A positive factor of a column does not change
// the sign of a determinant, so each coordinate is taken in units of the coarsest grid that its values lie
// on, and the entries become integers. Their number of bits bounds the determinant, which selects the
// narrowest integer type that holds every minor: 64 or 128 bits for lattices, 512 or 1024 bits for most
// doubles, unbounded integers for the rest.
#include "kernel/exact.hpp"

#include "base/progress_meter.hpp"
#include "kernel/binary.hpp"
#include "kernel/double_double_determinant.hpp"
#include "kernel/grid.hpp"
#include "kernel/int128.hpp"
#include "kernel/integer_determinant.hpp"
#include "kernel/zero_by_primes.hpp"

#include <boost/multiprecision/cpp_int.hpp>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace delone::kernel {

using internal::TwoWords;

namespace {

namespace mp = boost::multiprecision;
template <unsigned Bits>
using FixedInteger =
    mp::number<mp::cpp_int_backend<Bits, Bits, mp::signed_magnitude, mp::unchecked, void>, mp::et_off>;
using BigInteger = mp::number<mp::cpp_int_backend<>, mp::et_off>;

/// x·2^−grid as an integer. REQUIRES x on that grid, and that Integer holds the result.
template <class Integer>
Integer to_integer(double x, int grid) {
  if (x == 0) return Integer(0);
  const Binary binary = decompose(x);
  const int shift = binary.exponent - grid;
  if (shift <= 0)
    return Integer(binary.mantissa >> -shift);  // exact: x lies on the grid, so the bits shifted out are zero
  return Integer(binary.mantissa) * (Integer(1) << shift);
}

/// An integer modulo 2^(64·Limbs), lowest limb first: a signed one of 64·Limbs bits in two's complement.
template <int Limbs>
struct WideInteger {
  std::uint64_t limbs[Limbs];

  WideInteger() = default;  // uninitialised: a table has room for more minors than most determinants have
  explicit WideInteger(const Int128& x) {
    const TwoWords size = magnitude(x);
    const std::uint64_t sign = x < 0 ? ~std::uint64_t{0} : 0;  // −size is the complement of size, plus 1
    limbs[0] = (size.low ^ sign) - sign;
    limbs[1] = (size.high ^ sign) + static_cast<std::uint64_t>(sign != 0 && size.low == 0);
    for (int i = 2; i < Limbs; ++i) limbs[i] = x < 0 ? ~std::uint64_t{0} : 0;
  }
  /// Adds or subtracts factor·x·2^(64·shift).
  void add_product(std::uint64_t factor, const WideInteger& x, int shift, bool subtracts) {
    std::uint64_t high = 0, carry = 0;
    for (int i = 0; i + shift < Limbs; ++i) {
      const TwoWords product = internal::multiply_add(x.limbs[i], factor, high);
      high = product.high;
      const TwoWords sum = subtracts ? internal::subtract(limbs[i + shift], product.low, carry)
                                     : internal::add(limbs[i + shift], product.low, carry);
      limbs[i + shift] = sum.low;
      carry = sum.high;
    }
  }
  Sign sign() const {
    if ((limbs[Limbs - 1] >> 63) != 0) return Sign::negative;
    return std::any_of(limbs, limbs + Limbs, [](std::uint64_t limb) { return limb != 0; }) ? Sign::positive
                                                                                           : Sign::zero;
  }
};

/// The same expansion where all minors have fewer than 64·Limbs − 1 bits; about five times as fast as
/// integers whose size is known at run time.
template <int Limbs>
Sign sign_by_wide_minors(const std::vector<Int128>& a, int n) {
  constexpr int most_columns = 8;
  WideInteger<Limbs> minors[std::size_t{1} << most_columns];
  const std::size_t all = (std::size_t{1} << n) - 1;
  for (std::size_t subset = 1; subset <= all; ++subset) {
    const int row = std::popcount(subset) - 1;
    const Int128* const entries = a.data() + static_cast<std::ptrdiff_t>(row) * n;
    WideInteger<Limbs>& sum = minors[subset];
    if (row == 0) {
      sum = WideInteger<Limbs>(entries[std::countr_zero(subset)]);
      continue;
    }
    std::ranges::fill(sum.limbs, std::uint64_t{0});
    bool negate = (row & 1) != 0;
    for (std::size_t rest = subset; rest != 0; rest &= rest - 1, negate = !negate) {
      const int c = std::countr_zero(rest);
      const Int128& entry = entries[c];
      const bool subtracts = (entry < 0) != negate;
      const TwoWords size = magnitude(entry);
      const WideInteger<Limbs>& minor = minors[subset & ~(std::size_t{1} << c)];
      if (size.low != 0) sum.add_product(size.low, minor, 0, subtracts);
      if (size.high != 0) sum.add_product(size.high, minor, 1, subtracts);
    }
  }
  return minors[all].sign();
}

/// One determinant. Its rows are p_i − base, or as given without a base; its columns are the axes of the flat
/// and, for a sphere, the squared length less the difference of the weights.
class Problem {
 public:
  Problem(const Flat& flat, const double* const* points, const double* base, bool with_lift)
      : flat_(flat),
        points_(points),
        base_(base),
        with_lift_(with_lift),
        n_(static_cast<int>(flat.axes.size()) + (with_lift ? 1 : 0)) {}

  Sign sign() {
    internal::cancellation_point();
    measure();
    if (has_zero_column_) return Sign::zero;
    if (bits() <= 62 && n_ <= most_columns_for_minors)
      return sign_by_integer_minors(entries<std::int64_t>(), n_);
    if (widest_entry_ <= 126) return sign_of_narrow(entries<Int128>());
    if (n_ > most_columns_for_minors) return sign_by_integer_elimination(entries<BigInteger>(), n_);
    if (bits() <= 510) return sign_by_integer_minors(entries<FixedInteger<512>>(), n_);
    if (bits() <= 1022) return sign_by_integer_minors(entries<FixedInteger<1024>>(), n_);
    return sign_by_integer_minors(entries<BigInteger>(), n_);
  }

 private:
  static constexpr int most_columns_for_minors = 8;

  /// All minors are below 2 to this: one of size s is at most s! times the product of its columns' largest
  /// entries.
  double bits() const {
    double factorial_bits = 1;
    for (int i = 2; i <= n_; ++i) factorial_bits += std::log2(i);
    return entry_bits_ + std::ceil(factorial_bits);
  }

  /// The sign for entries below 2^126.
  Sign sign_of_narrow(std::vector<Int128> a) const {
    const double size = bits();
    if (n_ > most_columns_for_minors || size > 510) {
      if (size <= 62) return sign_by_integer_elimination(std::move(a), n_);
      if (is_zero_by_primes(a, n_, size)) return Sign::zero;
      if (n_ > most_columns_for_minors) return sign_by_integer_elimination(converted<BigInteger>(a), n_);
      if (size <= 1022) return sign_by_integer_minors(converted<FixedInteger<1024>>(a), n_);
      return sign_by_integer_minors(converted<BigInteger>(a), n_);
    }
    if (size <= 126) return sign_by_integer_minors(a, n_);
    if (size <= 254) return sign_by_wide_minors<4>(a, n_);
    if (size <= 318) return sign_by_wide_minors<5>(a, n_);
    return sign_by_wide_minors<8>(a, n_);
  }

  template <class Integer>
  static std::vector<Integer> converted(const std::vector<Int128>& a) {
    std::vector<Integer> result;
    result.reserve(a.size());
    for (const Int128& entry : a) result.push_back(static_cast<Integer>(entry));
    return result;
  }

  double base(std::size_t j) const { return base_ == nullptr ? 0.0 : base_[j]; }

  /// A grid that entry j of all rows and of the base lies on, and the number of bits of the differences in
  /// its units, 0 if all differences are zero.
  struct Extent {
    int grid = std::numeric_limits<int>::max();
    int bits = 0;
  };
  Extent extent(std::size_t j) const {
    const double origin = base(j);
    int grid = std::numeric_limits<int>::max();
    int top = std::numeric_limits<int>::min();  // every |entry| is below 2^top
    bool all_equal = true;
    const auto include = [&](double x) {
      if (x == 0) return;
      grid = std::min(grid, trailing_exponent(x));
      top = std::max(top, std::ilogb(x) + 1);
    };
    include(origin);
    for (std::size_t i = 0; i < static_cast<std::size_t>(n_); ++i) {
      include(points_[i][j]);
      all_equal = all_equal && points_[i][j] == origin;
    }
    return all_equal ? Extent{} : Extent{grid, top + 1 - grid};
  }

  /// Finds the grid of each axis, and the number of bits of a term of the determinant: the sum over the
  /// columns of the bits of their largest entries.
  void measure() {
    const auto ambient = static_cast<std::size_t>(flat_.ambient);
    grid_.resize(ambient);
    std::vector<int> bits(ambient, 0);
    finest_ = std::numeric_limits<int>::max();
    for (std::size_t axis = 0; axis < ambient; ++axis) {
      const Extent along = extent(axis);
      grid_[axis] = along.grid;
      bits[axis] = along.bits;
      finest_ = std::min(finest_, along.grid);
    }
    entry_bits_ = 0;
    for (const int axis : flat_.axes) {
      if (bits[static_cast<std::size_t>(axis)] == 0) has_zero_column_ = true;
      entry_bits_ += bits[static_cast<std::size_t>(axis)];
      widest_entry_ = std::max(widest_entry_, static_cast<double>(bits[static_cast<std::size_t>(axis)]));
    }
    widest_ = 0;
    for (std::size_t axis = 0; axis < bits.size(); ++axis)
      if (bits[axis] > 0) widest_ = std::max(widest_, bits[axis] + grid_[axis] - finest_);
    lift_bits_ = widest_ == 0 ? 0 : 2.0 * widest_ + ambient_bits();
    lift_grid_ = widest_ == 0 ? std::numeric_limits<int>::max() : 2 * finest_;
    if (!with_lift_) return;
    if (flat_.weighted()) measure_weights();
    if (lift_bits_ == 0) has_zero_column_ = true;
    entry_bits_ += lift_bits_;
    widest_entry_ = std::max(widest_entry_, lift_bits_);
  }

  /// Squares are integers of lift_bits_ bits on lift_grid_; their differences with weights lie on the finer
  /// of the two grids.
  void measure_weights() {
    const Extent weights = extent(static_cast<std::size_t>(flat_.ambient));
    weight_grid_ = weights.grid;
    if (weights.bits == 0) return;
    const int finer = std::min(lift_grid_, weights.grid);
    const double square_bits = lift_bits_ == 0 ? 0 : lift_bits_ + lift_grid_ - finer;
    lift_bits_ = 1 + std::max(square_bits, static_cast<double>(weights.bits) + weights.grid - finer);
    lift_grid_ = finer;
  }

  /// The matrix, row by row. Differences of coordinates and their squares are taken in the narrowest type
  /// that holds them.
  template <class Integer>
  std::vector<Integer> entries() const {
    if (lift_bits_ <= 126) return entries_from<Integer, Int128, Int128>();
    if (widest_ <= 126) return entries_from<Integer, Int128, Integer>();
    return entries_from<Integer, Integer, Integer>();
  }

  template <class Integer, class Difference, class Lift>
  std::vector<Integer> entries_from() const {
    const std::size_t n = static_cast<std::size_t>(n_);
    std::vector<Integer> a(n * n);
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t r = 0; r < flat_.axes.size(); ++r)
        a[i * n + r] =
            static_cast<Integer>(difference<Difference>(i, static_cast<std::size_t>(flat_.axes[r])));
      if (!with_lift_) continue;
      Lift lift(0);
      for (std::size_t axis = 0; axis < grid_.size(); ++axis) {
        if (points_[i][axis] == base_[axis]) continue;
        const Lift d =
            static_cast<Lift>(difference<Difference>(i, axis)) * (Lift(1) << (grid_[axis] - finest_));
        lift += d * d;
      }
      if (widest_ > 0 && lift_grid_ < 2 * finest_) lift *= Lift(1) << (2 * finest_ - lift_grid_);
      const auto weight = static_cast<std::size_t>(flat_.ambient);
      if (flat_.weighted() && points_[i][weight] != base_[weight])
        lift -= (to_integer<Lift>(points_[i][weight], weight_grid_) -
                 to_integer<Lift>(base_[weight], weight_grid_)) *
                (Lift(1) << (weight_grid_ - lift_grid_));
      a[i * n + n - 1] = static_cast<Integer>(lift);
    }
    return a;
  }

  template <class Integer>
  Integer difference(std::size_t i, std::size_t axis) const {
    return to_integer<Integer>(points_[i][axis], grid_[axis]) - to_integer<Integer>(base(axis), grid_[axis]);
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
  int weight_grid_ = 0;
  int lift_grid_ = 0;     // of the last column
  double lift_bits_ = 0;  // of its entries, in units of that grid
  double entry_bits_ = 0, widest_entry_ = 0;
  bool has_zero_column_ = false;
};

}  // namespace

Sign exact_orientation(const Flat& flat, const double* const* points, const double* base) {
  return Problem(flat, points, base, false).sign();
}

Sign exact_sphere(const Flat& flat, const double* const* points, const double* q) {
  return Problem(flat, points, q, true).sign();
}

/// Rows are not differences, which cancel. So twice the precision of binary64 decides nearly all signs that
/// are not zero, in a fifth of the time of integers.
Sign exact_determinant(std::span<const int> axes, const double* const* rows) {
  if (const auto sign = double_double_determinant(axes, rows)) return *sign;
  const int row_size = axes.empty() ? 0 : *std::max_element(axes.begin(), axes.end()) + 1;
  return Problem(Flat{row_size, axes, RowForm::homogeneous}, rows, nullptr, false).sign();
}

Sign exact_affine_form(const double* row, const double* p, int dimension) {
  internal::cancellation_point();
  int grid = std::numeric_limits<int>::max();
  const auto include = [&](int exponent, bool is_zero) {
    if (!is_zero) grid = std::min(grid, exponent);
  };
  include(decompose(row[dimension]).exponent, row[dimension] == 0);
  for (int j = 0; j < dimension; ++j)
    include(decompose(row[j]).exponent + decompose(p[j]).exponent, row[j] == 0 || p[j] == 0);
  BigInteger sum(0);
  const auto add = [&](const BigInteger& mantissa, int exponent) {
    if (mantissa != 0) sum += mantissa << (exponent - grid);
  };
  add(decompose(row[dimension]).mantissa, decompose(row[dimension]).exponent);
  for (int j = 0; j < dimension; ++j) {
    const Binary a = decompose(row[j]), b = decompose(p[j]);
    add(BigInteger(a.mantissa) * b.mantissa, a.exponent + b.exponent);
  }
  return sign_of_integer(sum);
}

}  // namespace delone::kernel
