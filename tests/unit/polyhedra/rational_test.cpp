// SPDX-License-Identifier: BSD-3-Clause
// Rational numbers: what texts and doubles mean, order, and rounding.
#include <delone/rational.hpp>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace delone {
namespace {

TEST(Rational, OfTexts) {
  EXPECT_EQ(Rational("6/8").to_string(), "3/4");
  EXPECT_EQ(Rational("-6/3").to_string(), "-2");
  EXPECT_EQ(Rational("+007").to_string(), "7");
  EXPECT_EQ(Rational("0.250").to_string(), "1/4");
  EXPECT_EQ(Rational("-1.5e3").to_string(), "-1500");
  EXPECT_EQ(Rational(".5E-1").to_string(), "1/20");
  EXPECT_EQ(Rational("1.e+2").to_string(), "100");
  EXPECT_EQ(Rational("-0").to_string(), "0");
  const std::string digits = "123456789012345678901234567890123456789";
  EXPECT_EQ(Rational(digits + "/7").to_string(), digits + "/7");
  EXPECT_EQ(Rational("-" + digits).numerator().to_string(), "-" + digits);
  for (const char* const text : {"", "-", "1/", "/2", "1/0", "1/-2", "1.5/2", "x", "1e", "1e1.5", "--1",
                                 "1 2", ".", "nan", "inf", "1e999999999"})
    EXPECT_THROW(Rational{std::string_view(text)}, Error) << text;
}

TEST(Rational, OfDoubles) {
  EXPECT_EQ(Rational(0.5).to_string(), "1/2");
  EXPECT_EQ(Rational(-0.0), Rational(0));
  EXPECT_EQ(Rational(0.1).to_string(), "3602879701896397/36028797018963968");
  for (const double x : {1e300, -1e300, 5e-324, 0x1p62, -0x1p63, 0x1.fffffffffffffp-3, 1e18})
    EXPECT_EQ(Rational(x).to_double(), x);
  EXPECT_THROW(Rational(std::nan("")), Error);
  EXPECT_THROW(Rational{std::numeric_limits<double>::infinity()}, Error);
}

TEST(Rational, OfFractions) {
  constexpr auto least = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(Rational(least, -1).to_string(), "9223372036854775808");
  EXPECT_EQ(Rational(least, least), Rational(1));
  EXPECT_EQ(Rational(Rational("3/4"), Rational("-9/2")).to_string(), "-1/6");
  EXPECT_THROW(Rational(1, 0), Error);
}

TEST(Rational, OfWords) {
  using Words = std::vector<std::uint64_t>;
  const auto of = [](const Words& words, bool is_negative = false) {
    return Rational::from_words(words, is_negative);
  };
  EXPECT_EQ(of({}), Rational(0));
  EXPECT_EQ(of({0, 0}, true), Rational(0));
  EXPECT_EQ(of({7, 0}, true), Rational(-7));
  EXPECT_EQ(of({0, 1}).to_string(), "18446744073709551616");
  constexpr auto least = std::numeric_limits<std::int64_t>::min();
  EXPECT_EQ(of({std::uint64_t{1} << 63}, true), Rational(least));
  EXPECT_EQ(of({std::uint64_t{1} << 63}, true).to_int64(), least);
  EXPECT_EQ(of({std::uint64_t{1} << 63}).to_int64(), std::nullopt);
  EXPECT_EQ(Rational("1/2").to_int64(), std::nullopt);
  for (const char* const text :
       {"0", "-1", "18446744073709551615", "-123456789012345678901234567890123456789"})
    EXPECT_EQ(of(Rational(text).to_words(), Rational(text).is_negative()), Rational(text));
  EXPECT_EQ(Rational("-18446744073709551616/3").to_words(), (Words{0, 1}));
  EXPECT_EQ(Rational("-1/7").is_negative(), true);
  EXPECT_EQ(Rational("1e30").is_negative(), false);
}

TEST(Rational, IsOrdered) {
  const std::vector<Rational> increasing{Rational("-1e30"), Rational(-2),      Rational("-1/3"),
                                         Rational(0),       Rational("1e-30"), Rational("1/3"),
                                         Rational(0.5),     Rational("1e30"),  Rational("1e31")};
  for (std::size_t i = 0; i < increasing.size(); ++i)
    for (std::size_t j = 0; j < increasing.size(); ++j) {
      EXPECT_EQ(increasing[i] < increasing[j], i < j);
      EXPECT_EQ(increasing[i] == increasing[j], i == j);
    }
}

TEST(Rational, IsRoundedToTheNearest) {
  EXPECT_EQ(Rational("1/3").to_double(), 1.0 / 3.0);
  EXPECT_EQ(Rational("1e400").to_double(), std::numeric_limits<double>::infinity());
  EXPECT_EQ(Rational("9007199254740993").to_double(), 9007199254740992.0);
}

TEST(RationalRows, HaveOneWidth) {
  const RationalRows rows{{1, 2}, {3, Rational("1/2")}};
  EXPECT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows.width(), 2u);
  EXPECT_EQ(rows, RationalRows(std::vector<double>{1, 2, 3, 0.5}, 2));
  EXPECT_THAT(rows.to_doubles(), testing::ElementsAre(1, 2, 3, 0.5));
  EXPECT_THROW((RationalRows{{1, 2}, {3}}), Error);
  EXPECT_THROW(RationalRows(std::vector<Rational>(3), 2), Error);
  EXPECT_THROW(RationalRows(std::vector<Rational>(3), 0), Error);
  try {
    RationalRows(std::vector<double>{1, 2, std::nan(""), 0.5}, 2);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), Errc::not_finite);
    EXPECT_THAT(error.rows(), testing::ElementsAre(1));
  }
}

TEST(RationalRows, ScaledDoubles) {
  const std::string zeros(400, '0');
  const RationalRows rows{
      {3, -4, 5}, {Rational("1" + zeros), 1, Rational("-3" + zeros)}, {1, 2, Rational("1" + zeros)}};
  const std::vector<double> numbers = rows.to_scaled_doubles(2);
  EXPECT_EQ(numbers[1], -4);
  EXPECT_GE(numbers[3], 0x1p999);
  EXPECT_LT(numbers[3], 0x1p1000);
  EXPECT_EQ(numbers[5],
            Rational(Rational("-3" + zeros), Rational::from_words(Rational(0x1p329).to_words())).to_double());
  EXPECT_EQ(numbers[7], 2);
  EXPECT_EQ(numbers[8], std::numeric_limits<double>::infinity());
}

}  // namespace
}  // namespace delone
