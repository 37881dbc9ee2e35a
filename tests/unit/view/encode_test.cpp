// SPDX-License-Identifier: BSD-3-Clause
// The bytes of pages, decoded by the words of encode.hpp.
#include "view/encode.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace {

using namespace delone;

std::vector<std::uint32_t> of_planes(const std::string& bytes, int width, std::size_t stride) {
  const std::size_t count = bytes.size() / static_cast<std::size_t>(width);
  std::vector<std::uint32_t> items(count, 0);
  for (std::size_t i = 0; i < bytes.size(); ++i)
    items[i % count] |= std::uint32_t{static_cast<unsigned char>(bytes[i])} << (8 * (i / count));
  const std::uint64_t modulus = std::uint64_t{1} << (8 * width);
  for (std::size_t i = stride; i < count; ++i)
    items[i] = static_cast<std::uint32_t>((std::uint64_t{items[i]} + items[i - stride]) % modulus);
  return items;
}

/// All numbers of seven bits a byte.
std::vector<std::uint64_t> of_varints(const std::string& bytes) {
  std::vector<std::uint64_t> numbers;
  std::uint64_t number = 0;
  int shift = 0;
  for (const char c : bytes) {
    const auto byte = static_cast<unsigned char>(c);
    number |= std::uint64_t{byte & 127U} << shift;
    shift += 7;
    if (byte < 128) numbers.push_back(number), number = 0, shift = 0;
  }
  return numbers;
}

std::int64_t difference(std::uint64_t code) {
  return code % 2 == 0 ? static_cast<std::int64_t>(code / 2) : -static_cast<std::int64_t>(code / 2) - 1;
}

TEST(ViewEncode, Planes) {
  const std::vector<std::uint32_t> items{0, 5, 16777215, 3, 70000, 70001, 255, 256};
  for (const std::size_t stride : {1, 2, 3})
    EXPECT_EQ(of_planes(view::planes(items, 3, stride), 3, stride), items);
  const std::vector<std::uint32_t> large{0xffffffffU, 0, 0x80000000U};
  EXPECT_EQ(of_planes(view::planes(large, 4, 1), 4, 1), large);
  EXPECT_EQ(view::planes({}, 2, 1), "");
  EXPECT_EQ(view::bytes_for(255), 1);
  EXPECT_EQ(view::bytes_for(256), 2);
  EXPECT_EQ(view::bytes_for(16777216), 4);
}

TEST(ViewEncode, Simplices) {
  const std::vector<SignedIndex> cells{7, 0, 300, 9, 2000000, 1};
  const auto codes = of_varints(view::simplices(cells, 3));
  ASSERT_EQ(codes.size(), cells.size());
  std::vector<SignedIndex> decoded;
  std::int64_t first = 0, before = 0;
  for (std::size_t i = 0; i < codes.size(); ++i) {
    before = difference(codes[i]) + (i % 3 == 0 ? first : before);
    if (i % 3 == 0) first = before;
    decoded.push_back(static_cast<SignedIndex>(before));
  }
  EXPECT_EQ(decoded, cells);
}

TEST(ViewEncode, Polytopes) {
  const std::vector<SignedIndex> counts{2, 0, 1}, sizes{3, 4, 3}, vertices{5, 1, 2, 9, 8, 7, 6, 0, 500, 3};
  const auto codes = of_varints(view::polytopes(counts, sizes, vertices));
  std::vector<SignedIndex> decoded;
  std::int64_t before = 0;
  std::size_t at = 0;
  for (const SignedIndex count : counts) {
    ASSERT_EQ(codes[at++], static_cast<std::uint64_t>(count));
    for (SignedIndex f = 0; f < count; ++f)
      for (std::uint64_t left = codes[at++]; left > 0; --left)
        decoded.push_back(static_cast<SignedIndex>(before += difference(codes[at++])));
  }
  EXPECT_EQ(at, codes.size());
  EXPECT_EQ(decoded, vertices);
}

TEST(ViewEncode, PositionsAreRoundedByAtMostTheirError) {
  for (const double size : {1.0, 1e-300, 1e300}) {
    std::vector<double> points;
    for (int i = 0; i < 50; ++i)
      points.push_back(size * std::sin(i)), points.push_back(size * std::cos(3.0 * i) / 1000);
    const view::Box box = view::box_of(points, 2);
    const auto codes = view::codes_of_positions(points, box);
    const double error = view::position_error(box);
    EXPECT_LT(error, 6.1e-8 * size);
    for (std::size_t i = 0; i < points.size(); ++i) {
      const double step = box.high[i % 2] / 16777215 - box.low[i % 2] / 16777215;
      EXPECT_LE(std::abs(box.low[i % 2] + codes[i] * step - points[i]), error);
    }
  }
  const view::Box widest = view::box_of(std::vector<double>{-1.7e308, 1.7e308, 0}, 1);
  EXPECT_EQ(view::codes_of_positions(std::vector<double>{-1.7e308, 0, 1.7e308}, widest),
            (std::vector<std::uint32_t>{0, 8388608, 16777215}));
  EXPECT_EQ(view::codes_of_positions(std::vector<double>{3, 3}, view::box_of(std::vector<double>{3, 3}, 2)),
            (std::vector<std::uint32_t>{0, 0}));
  // Removed rows are nowhere.
  const view::Box around = view::box_of(std::vector<double>{std::nan(""), std::nan(""), 2, 5, 1, 7}, 2);
  EXPECT_EQ(around.low, (std::vector<double>{1, 5}));
  EXPECT_EQ(around.high, (std::vector<double>{2, 7}));
  EXPECT_EQ(view::box_of(std::vector<double>{std::nan("")}, 1).high, std::vector<double>{0});
  // What is no place within the box has the lowest one.
  const double infinity = std::numeric_limits<double>::infinity();
  EXPECT_EQ(view::codes_of_positions(std::vector<double>{infinity, -infinity, std::nan(""), 2}, {{1}, {2}}),
            (std::vector<std::uint32_t>{0, 0, 0, 16777215}));
}

TEST(ViewEncode, DeflateOfAllSizes) {
  std::string random, text;
  std::uint64_t state = 1;
  for (int i = 0; i < 300000; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    random.push_back(static_cast<char>(state >> 56));
    text += i % 7 == 0 ? "abc" : "de";
  }
  for (std::string bytes : {std::string(), std::string("x"), random}) {
    const std::string before = bytes;
    EXPECT_FALSE(view::deflate(bytes));
    EXPECT_EQ(bytes, before);
  }
  const std::string before = text;
  if (view::deflate(text)) {
    EXPECT_LT(text.size(), before.size() / 20);
    EXPECT_EQ(text[0], 'x');  // the header of zlib
  }
}

TEST(ViewEncode, DeflateTellsHowMuchIsDone) {
  std::string text;
  for (int i = 0; i < 400000; ++i) text += "de";
  std::vector<double> parts;
  if (!view::deflate(text, [&](double part) { parts.push_back(part); })) GTEST_SKIP() << "built without zlib";
  ASSERT_GT(parts.size(), 4u);
  EXPECT_TRUE(std::is_sorted(parts.begin(), parts.end()));
  EXPECT_EQ(parts.front(), 0);
  EXPECT_GT(parts.back(), 0.8);
  EXPECT_LT(parts.back(), 1);
}

TEST(ViewEncode, Numbers) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto linear = view::codes_of_numbers(std::vector<double>{2, nan, 4, 3}, 2);
  EXPECT_EQ(linear.codes, (std::vector<std::uint32_t>{0, 65535, 65534, 32767}));
  EXPECT_EQ(linear.low, 2);
  EXPECT_EQ(linear.high, 4);
  const auto log = view::codes_of_numbers(std::vector<double>{1, 100, 10, 0, -1}, 2, true);
  EXPECT_EQ(log.codes, (std::vector<std::uint32_t>{0, 65534, 32767, 65535, 65535}));
  EXPECT_NEAR(log.high, std::log(100), 1e-12);
  EXPECT_EQ(view::codes_of_numbers(std::vector<double>{7, 7}, 1).codes, (std::vector<std::uint32_t>{0, 0}));
  EXPECT_EQ(view::codes_of_numbers(std::vector<double>{nan}, 1).codes, std::vector<std::uint32_t>{255});
}

TEST(ViewEncode, Base64) {
  const auto base64 = [](const std::string& bytes) {
    std::string text;
    view::append_base64(text, bytes);
    return text;
  };
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
}

}  // namespace
