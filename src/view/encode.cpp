// SPDX-License-Identifier: BSD-3-Clause
#include "view/encode.hpp"

#include "base/infinity.hpp"
#include "base/quick_rounds.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delone::view {

namespace {

void put_number(std::string& bytes, std::uint64_t number) {
  for (; number > 127; number >>= 7) bytes.push_back(static_cast<char>((number & 127) | 128));
  bytes.push_back(static_cast<char>(number));
}

void put_difference(std::string& bytes, std::int64_t difference) {
  const auto doubled = static_cast<std::uint64_t>(difference) << 1;
  put_number(bytes, difference < 0 ? ~doubled : doubled);
}

constexpr std::uint64_t largest_code(int bytes) { return (std::uint64_t{1} << (8 * bytes)) - 1; }

}  // namespace

Box box_of(std::span<const double> points, int dimension, Box box) {
  const auto d = static_cast<std::size_t>(dimension);
  if (box.low.empty()) box.low.assign(d, internal::infinity), box.high.assign(d, -internal::infinity);
  for (std::size_t i = 0, axis = 0; i < points.size(); ++i, axis = axis + 1 == d ? 0 : axis + 1) {
    // A NaN is neither less nor greater.
    box.low[axis] = std::min(box.low[axis], points[i]);
    box.high[axis] = std::max(box.high[axis], points[i]);
  }
  for (std::size_t axis = 0; axis < d; ++axis)
    if (box.low[axis] > box.high[axis]) box.low[axis] = box.high[axis] = 0;
  return box;
}

std::vector<std::uint32_t> codes_of_positions(std::span<const double> points, const Box& box) {
  const std::size_t d = box.low.size();
  constexpr auto most = static_cast<double>(largest_code(position_bytes));
  std::vector<std::uint32_t> codes(points.size());
  internal::QuickRounds round;
  for (std::size_t i = 0, axis = 0; i < points.size(); ++i, axis = axis + 1 == d ? 0 : axis + 1) {
    round();
    // Differences of halved coordinates do not overflow.
    const double half = box.high[axis] / 2 - box.low[axis] / 2;
    const double place = half > 0 ? (points[i] / 2 - box.low[axis] / 2) / half : 0;
    codes[i] = std::isfinite(place)
                   ? static_cast<std::uint32_t>(std::clamp(std::round(place * most), 0.0, most))
                   : 0;
  }
  return codes;
}

double position_error(const Box& box) {
  double largest = 0;
  for (std::size_t axis = 0; axis < box.low.size(); ++axis)
    largest = std::max(largest, box.high[axis] / 2 - box.low[axis] / 2);
  // Half a step, and the rounding of the arithmetic, which is far smaller.
  return largest / static_cast<double>(largest_code(position_bytes)) * (1 + 1e-6);
}

Numbers codes_of_numbers(std::span<const double> numbers, int bytes, bool log) {
  Numbers result{.codes = std::vector<std::uint32_t>(numbers.size()), .bytes = bytes, .log = log};
  const auto place = [log](double x) {
    if (!std::isfinite(x) || (log && !(x > 0))) return std::numeric_limits<double>::quiet_NaN();
    return log ? std::log(x) : x;
  };
  result.low = internal::infinity, result.high = -result.low;
  internal::QuickRounds round;
  for (const double x : numbers) {
    round();
    const double value = place(x);
    if (std::isnan(value)) continue;
    result.low = std::min(result.low, value);
    result.high = std::max(result.high, value);
  }
  if (result.low > result.high) result.low = result.high = 0;
  const auto none = static_cast<std::uint32_t>(largest_code(bytes));
  const double half = result.high / 2 - result.low / 2;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    round();
    const double value = place(numbers[i]);
    const double part = half > 0 ? (value / 2 - result.low / 2) / half : 0;
    result.codes[i] = std::isnan(value) ? none : static_cast<std::uint32_t>(std::lround(part * (none - 1)));
  }
  return result;
}

std::string planes(std::span<const std::uint32_t> items, int bytes, std::size_t stride) {
  std::string result(items.size() * static_cast<std::size_t>(bytes), '\0');
  internal::QuickRounds round;
  for (std::size_t i = 0; i < items.size(); ++i) {
    round();
    const std::uint32_t difference = items[i] - (i < stride ? 0 : items[i - stride]);
    for (int b = 0; b < bytes; ++b)
      result[static_cast<std::size_t>(b) * items.size() + i] =
          static_cast<char>(static_cast<unsigned char>(difference >> (8 * b)));
  }
  return result;
}

int bytes_for(std::uint64_t largest) {
  int bytes = 1;
  while (bytes < 4 && largest > largest_code(bytes)) ++bytes;
  return bytes;
}

std::string simplices(std::span<const SignedIndex> cells, int corners) {
  std::string bytes;
  bytes.reserve(cells.size() * 2);
  std::int64_t first = 0, before = 0;
  internal::QuickRounds round;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    round();
    const std::int64_t vertex = cells[i];
    const bool opens = i % static_cast<std::size_t>(corners) == 0;
    put_difference(bytes, vertex - (opens ? first : before));
    if (opens) first = vertex;
    before = vertex;
  }
  return bytes;
}

std::string polytopes(std::span<const SignedIndex> face_counts, std::span<const SignedIndex> face_sizes,
                      std::span<const SignedIndex> face_vertices) {
  std::string bytes;
  bytes.reserve(face_vertices.size() * 2);
  std::int64_t before = 0;
  std::size_t face = 0, at = 0;
  internal::QuickRounds round;
  for (const SignedIndex count : face_counts) {
    round();
    put_number(bytes, static_cast<std::uint64_t>(count));
    for (SignedIndex f = 0; f < count; ++f, ++face) {
      put_number(bytes, static_cast<std::uint64_t>(face_sizes[face]));
      for (SignedIndex i = 0; i < face_sizes[face]; ++i, ++at) {
        put_difference(bytes, face_vertices[at] - before);
        before = face_vertices[at];
      }
    }
  }
  return bytes;
}

void append_base64(std::string& text, std::string_view bytes) {
  static constexpr std::string_view digits =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  text.reserve(text.size() + (bytes.size() + 2) / 3 * 4);
  const auto byte = [&](std::size_t i) {
    return i < bytes.size() ? static_cast<unsigned>(static_cast<unsigned char>(bytes[i])) : 0U;
  };
  internal::QuickRounds round;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    round();
    const unsigned three = byte(i) << 16 | byte(i + 1) << 8 | byte(i + 2);
    text.push_back(digits[three >> 18]);
    text.push_back(digits[three >> 12 & 63]);
    text.push_back(i + 1 < bytes.size() ? digits[three >> 6 & 63] : '=');
    text.push_back(i + 2 < bytes.size() ? digits[three & 63] : '=');
  }
}

}  // namespace delone::view
