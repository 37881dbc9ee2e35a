// SPDX-License-Identifier: BSD-3-Clause
// Rational numbers of any size, as arguments and results of what is exact.
#pragma once

#include <delone/error.hpp>
#include <delone/export.hpp>

#include <compare>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace delone {
namespace polyhedra {
struct Fraction;
}

/// A rational number in lowest terms; the denominator is positive. Copies share what is large.
class DELONE_EXPORT Rational {
 public:
  Rational() = default;
  template <std::integral T>
  requires(std::signed_integral<T> || sizeof(T) < sizeof(std::int64_t)) Rational(T integer)
      : numerator_(integer) {}
  template <std::unsigned_integral T>
  requires(sizeof(T) == sizeof(std::int64_t)) Rational(T)
  = delete;
  /// The number as it is, a multiple of a power of two. Throws Errc::not_finite.
  Rational(double number);
  /// "-12", "3/7", "0.25", "1.5e-3": the number that the digits say. Throws Errc::bad_format for other texts,
  /// and for a denominator of 0.
  explicit Rational(std::string_view text);
  /// Throws Errc::invalid_argument for a denominator of 0.
  Rational(const Rational& numerator, const Rational& denominator);
  /// The integer of these words, the lowest first.
  static Rational from_words(std::span<const std::uint64_t> magnitude, bool is_negative = false);

  Rational numerator() const;
  Rational denominator() const;
  bool is_integer() const;
  bool is_negative() const;
  /// The number, if it is an integer that fits.
  std::optional<std::int64_t> to_int64() const;
  /// The magnitude of the numerator, the lowest word first and the highest one not 0; none for 0.
  std::vector<std::uint64_t> to_words() const;
  /// Decimal digits, "3/7" or "-12".
  std::string to_string() const;
  /// The nearest double, ties to even; ±infinity beyond all doubles.
  double to_double() const;

  DELONE_EXPORT friend bool operator==(const Rational& a, const Rational& b);
  DELONE_EXPORT friend std::strong_ordering operator<=>(const Rational& a, const Rational& b);

 private:
  friend struct polyhedra::Fraction;
  std::int64_t numerator_ = 0, denominator_ = 1;
  std::shared_ptr<const polyhedra::Fraction> large_;  // instead, if one of them does not fit
};

/// A matrix of rational numbers, row by row.
class DELONE_EXPORT RationalRows {
 public:
  RationalRows() = default;
  /// {{1, 0}, {Rational("1/3"), 2}}. Throws Errc::bad_dimension unless all rows have the same width.
  RationalRows(std::initializer_list<std::initializer_list<Rational>> rows);
  /// Throws Errc::bad_dimension unless the number of entries is a multiple of the width.
  RationalRows(std::vector<Rational> entries, std::size_t width);
  /// Doubles as they are. Throws the same, and Errc::not_finite; rows() names the rows.
  RationalRows(std::span<const double> entries, std::size_t width);

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  /// The entries of each row; 0 if there has been no row.
  std::size_t width() const { return width_; }
  std::span<const Rational> operator[](std::size_t row) const {
    return {entries_.data() + row * width_, width_};
  }
  const std::vector<Rational>& entries() const { return entries_; }
  /// Throws Errc::bad_dimension for a row of another width.
  void push_back(std::span<const Rational> row);
  /// The nearest doubles.
  std::vector<double> to_doubles() const;
  /// The same of rows of integers that mean what their positive multiples mean: a row that has an integer of
  /// more than 1000 bits among its first `leading` entries is divided by a power of two.
  std::vector<double> to_scaled_doubles(std::size_t leading) const;

  friend bool operator==(const RationalRows&, const RationalRows&) = default;

 private:
  std::size_t size_ = 0, width_ = 0;
  std::vector<Rational> entries_;
};

}  // namespace delone
