// SPDX-License-Identifier: BSD-3-Clause
#include "base/guarded.hpp"
#include "base/progress_meter.hpp"
#include "base/require_finite.hpp"
#include "kernel/grid.hpp"
#include "polyhedra/arithmetic.hpp"
#include "polyhedra/common_divisor.hpp"
#include "polyhedra/fraction.hpp"

#include <delone/arithmetic.hpp>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

namespace delone {

using polyhedra::bit_length;
using polyhedra::Fraction;
using polyhedra::Integer;

namespace {

namespace mp = boost::multiprecision;

[[noreturn]] void throw_no_number(std::string_view text) {
  constexpr std::size_t most = 60;
  throw Error(Errc::bad_format, "\"" + std::string(text.substr(0, most)) + (text.size() > most ? "…" : "") +
                                    "\" is not a rational number");
}

bool are_all_digits(std::string_view text) {
  return std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
}

/// A leading 0 would mean octal digits to Boost.
Integer integer_of_digits(std::string_view digits) {
  digits.remove_prefix(std::min(digits.find_first_not_of('0'), digits.size()));
  return digits.empty() ? Integer(0) : Integer(std::string(digits));
}

/// Digits with a point and a power of ten, without a sign.
Fraction parse_decimal(std::string_view text, std::string_view whole) {
  int exponent = 0;
  if (const std::size_t e = text.find_first_of("eE"); e != std::string_view::npos) {
    std::string_view digits = text.substr(e + 1);
    if (!digits.empty() && digits.front() == '+') digits.remove_prefix(1);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), exponent);
    constexpr int largest = 100'000;  // larger powers are a mistake, and would take all memory
    if (error != std::errc() || end != digits.data() + digits.size() || std::abs(exponent) > largest)
      throw_no_number(whole);
    text = text.substr(0, e);
  }
  const std::size_t point = text.find('.');
  std::string digits(text.substr(0, point));
  if (point != std::string_view::npos) {
    digits += text.substr(point + 1);
    exponent -= static_cast<int>(text.size() - point - 1);
  }
  if (digits.empty() || !are_all_digits(digits)) throw_no_number(whole);
  Fraction result{integer_of_digits(digits), 1};
  const Integer power = mp::pow(Integer(10), static_cast<unsigned>(std::abs(exponent)));
  (exponent < 0 ? result.denominator : result.numerator) *= power;
  return result;
}

Fraction parse(std::string_view text) {
  std::string_view rest = text;
  const bool is_negative = !rest.empty() && rest.front() == '-';
  if (!rest.empty() && (rest.front() == '-' || rest.front() == '+')) rest.remove_prefix(1);
  Fraction result;
  if (const std::size_t slash = rest.find('/'); slash != std::string_view::npos) {
    const std::string_view above = rest.substr(0, slash), below = rest.substr(slash + 1);
    if (above.empty() || below.empty() || !are_all_digits(above) || !are_all_digits(below))
      throw_no_number(text);
    result = {integer_of_digits(above), integer_of_digits(below)};
    if (result.denominator == 0)
      throw Error(Errc::bad_format, "\"" + std::string(text) + "\" has the denominator 0");
  } else {
    result = parse_decimal(rest, text);
  }
  if (is_negative) result.numerator = -result.numerator;
  return result;
}

bool fits(const Integer& x) {
  return x >= std::numeric_limits<std::int64_t>::min() && x <= std::numeric_limits<std::int64_t>::max();
}

}  // namespace

namespace polyhedra {

Fraction Fraction::of(const Rational& x) {
  return x.large_ ? *x.large_ : Fraction{Integer(x.numerator_), Integer(x.denominator_)};
}

Rational Fraction::to_rational(Integer numerator, Integer denominator) {
  if (denominator != 1) {
    if (denominator < 0) {
      numerator = -numerator;
      denominator = -denominator;
    }
    const Integer common = common_divisor(numerator, denominator);
    if (common != 1) {
      numerator /= common;
      denominator /= common;
    }
  }
  Rational result;
  if (fits(numerator) && fits(denominator)) {
    result.numerator_ = static_cast<std::int64_t>(numerator);
    result.denominator_ = static_cast<std::int64_t>(denominator);
  } else {
    result.large_ = std::make_shared<const Fraction>(Fraction{std::move(numerator), std::move(denominator)});
  }
  return result;
}

Row common_integers(std::span<const Rational> numbers) {
  Row row;
  row.reserve(numbers.size() + 1);
  Integer common = 1;
  bool are_integers = true;
  for (const Rational& x : numbers) are_integers = are_integers && x.is_integer();
  if (!are_integers)
    for (const Rational& x : numbers) common = mp::lcm(common, Fraction::of(x).denominator);
  for (const Rational& x : numbers) {
    Fraction fraction = Fraction::of(x);
    row.push_back(are_integers ? std::move(fraction.numerator)
                               : Integer(fraction.numerator * (common / fraction.denominator)));
  }
  row.push_back(common);
  return row;
}

}  // namespace polyhedra

Rational::Rational(double number) {
  const ArithmeticScope arithmetic;
  if (!std::isfinite(number)) throw Error(Errc::not_finite, "a number is not finite");
  constexpr double largest = 0x1p62;
  if (std::abs(number) < largest && number == std::trunc(number)) {
    numerator_ = static_cast<std::int64_t>(number);
    return;
  }
  internal::guarded("a number", [&] {
    const int exponent = std::min(0, kernel::trailing_exponent(number));
    *this = Fraction::to_rational(kernel::scaled_integer(number, exponent), Integer(1) << -exponent);
  });
}

Rational::Rational(std::string_view text) {
  internal::guarded("a number", [&] {
    Fraction fraction = parse(text);
    *this = Fraction::to_rational(std::move(fraction.numerator), std::move(fraction.denominator));
  });
}

Rational::Rational(const Rational& numerator, const Rational& denominator) {
  if (denominator == Rational()) throw Error(Errc::invalid_argument, "a fraction has the denominator 0");
  internal::guarded("a number", [&] {
    const Fraction above = Fraction::of(numerator), below = Fraction::of(denominator);
    *this = Fraction::to_rational(above.numerator * below.denominator, above.denominator * below.numerator);
  });
}

Rational Rational::from_words(std::span<const std::uint64_t> magnitude, bool is_negative) {
  return internal::guarded("a number", [&] {
    Integer integer;
    if (!magnitude.empty()) mp::import_bits(integer, magnitude.begin(), magnitude.end(), 64, false);
    return Fraction::to_rational(is_negative ? Integer(-integer) : std::move(integer));
  });
}

Rational Rational::numerator() const {
  return large_ ? Fraction::to_rational(large_->numerator) : numerator_;
}
Rational Rational::denominator() const {
  return large_ ? Fraction::to_rational(large_->denominator) : denominator_;
}
bool Rational::is_integer() const { return large_ ? large_->denominator == 1 : denominator_ == 1; }
bool Rational::is_negative() const { return large_ ? large_->numerator < 0 : numerator_ < 0; }

std::optional<std::int64_t> Rational::to_int64() const {
  return large_ || denominator_ != 1 ? std::nullopt : std::optional(numerator_);
}

std::vector<std::uint64_t> Rational::to_words() const {
  return internal::guarded("a number", [&] {
    std::vector<std::uint64_t> words;
    const Integer magnitude = mp::abs(large_ ? large_->numerator : Integer(numerator_));
    if (magnitude != 0) mp::export_bits(magnitude, std::back_inserter(words), 64, false);
    return words;
  });
}

std::string Rational::to_string() const {
  if (!large_)
    return std::to_string(numerator_) + (denominator_ == 1 ? "" : "/" + std::to_string(denominator_));
  return large_->numerator.str() + (is_integer() ? "" : "/" + large_->denominator.str());
}

double Rational::to_double() const {
  const ArithmeticScope arithmetic;
  const Fraction fraction = Fraction::of(*this);
  return kernel::nearest_double(fraction.numerator, fraction.denominator, 0);
}

bool operator==(const Rational& a, const Rational& b) {
  if (!a.large_ || !b.large_)  // what fits is never large
    return !a.large_ && !b.large_ && a.numerator_ == b.numerator_ && a.denominator_ == b.denominator_;
  return a.large_->numerator == b.large_->numerator && a.large_->denominator == b.large_->denominator;
}

std::strong_ordering operator<=>(const Rational& a, const Rational& b) {
  const Fraction x = Fraction::of(a), y = Fraction::of(b);
  const int sign = Integer(x.numerator * y.denominator - y.numerator * x.denominator).sign();
  return sign <=> 0;
}

RationalRows::RationalRows(std::initializer_list<std::initializer_list<Rational>> rows) {
  for (const auto& row : rows) push_back({row.begin(), row.size()});
}

RationalRows::RationalRows(std::vector<Rational> entries, std::size_t width)
    : size_(width == 0 ? 0 : entries.size() / width), width_(width), entries_(std::move(entries)) {
  if (size_ * width_ != entries_.size())
    throw Error(Errc::bad_dimension, "the number of entries is not a multiple of the width of a row");
}

RationalRows::RationalRows(std::span<const double> entries, std::size_t width)
    : RationalRows(
          [&] {
            internal::require_finite(entries, std::max<std::size_t>(width, 1), "an entry", "row");
            return std::vector<Rational>(entries.begin(), entries.end());
          }(),
          width) {}

void RationalRows::push_back(std::span<const Rational> row) {
  if (size_ == 0 && width_ == 0) width_ = row.size();
  if (row.size() != width_)
    throw Error(Errc::bad_dimension,
                "row " + std::to_string(size_) + " has " + std::to_string(row.size()) + " entries, not " +
                    std::to_string(width_),
                {size_});
  entries_.insert(entries_.end(), row.begin(), row.end());
  ++size_;
}

std::vector<double> RationalRows::to_doubles() const {
  std::vector<double> numbers;
  numbers.reserve(entries_.size());
  for (const Rational& x : entries_) {
    internal::cancellation_point();
    numbers.push_back(x.to_double());
  }
  return numbers;
}

std::vector<double> RationalRows::to_scaled_doubles(std::size_t leading) const {
  constexpr int most_bits = 1000;
  std::vector<double> numbers;
  numbers.reserve(entries_.size());
  internal::guarded("numbers", [&] {
    for (std::size_t row = 0; row < size_; ++row) {
      internal::cancellation_point();
      const std::span<const Rational> entries = (*this)[row];
      int bits = 0;
      for (const Rational& x : entries.first(leading))
        if (!x.to_int64()) bits = std::max(bits, bit_length(Fraction::of(x).numerator));
      const int shift = std::max(bits - most_bits, 0);
      for (const Rational& x : entries)
        numbers.push_back(shift == 0 ? x.to_double()
                                     : kernel::nearest_double(Fraction::of(x).numerator, 1, -shift));
    }
  });
  return numbers;
}

}  // namespace delone
