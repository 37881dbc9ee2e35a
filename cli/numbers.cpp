// SPDX-License-Identifier: BSD-3-Clause
#include "numbers.hpp"

#include <fast_float/fast_float.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <string>
#include <system_error>

namespace delone::cli {
namespace {

/// number · unit, if it is whole. In digits it is exact, otherwise a product of doubles.
std::optional<std::uint64_t> scaled(std::string_view number, std::uint64_t unit) {
  // Signs, inf and nan begin otherwise.
  if (number.empty() || std::string_view("0123456789.").find(number[0]) == std::string_view::npos)
    return std::nullopt;
  const char* const all = number.data() + number.size();
  std::uint64_t digits = 0;
  if (const auto [end, error] = std::from_chars(number.data(), all, digits); end == all)
    return error != std::errc() || digits > beyond_numbers / unit ? beyond_numbers : digits * unit;
  const std::optional<double> real = parse_real(number);
  if (!real) return std::nullopt;
  const double value = *real * static_cast<double>(unit);
  if (value != std::trunc(value)) return std::nullopt;
  return value < 0x1p64 ? static_cast<std::uint64_t>(value) : beyond_numbers;
}

/// Nothing if there is no such unit.
std::optional<std::uint64_t> bytes_of(std::string unit) {
  for (char& c : unit)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  if (unit.empty() || unit == "b") return 1;
  const std::size_t power = std::string_view("kmgt").find(unit[0]);
  const std::string_view rest = std::string_view(unit).substr(1);
  if (power == std::string_view::npos || (!rest.empty() && rest != "b" && rest != "ib")) return std::nullopt;
  const std::uint64_t base = rest == "b" ? 1000 : 1024;
  std::uint64_t bytes = base;
  for (std::size_t i = 0; i < power; ++i) bytes *= base;
  return bytes;
}

}  // namespace

// std::from_chars of a double is missing in libc++ before version 20.
std::optional<double> parse_real(std::string_view text) {
  double value = 0;
  const auto [end, error] = fast_float::from_chars(text.data(), text.data() + text.size(), value);
  const bool is_number = error == std::errc() || error == std::errc::result_out_of_range;
  if (!is_number || end != text.data() + text.size() || std::isinf(value)) return std::nullopt;
  return value;
}

std::optional<std::uint64_t> parse_count(std::string_view text) { return scaled(text, 1); }

std::optional<std::uint64_t> parse_size(std::string_view text) {
  const std::size_t end = text.find_last_of("0123456789.") + 1;  // 0 if there is none
  std::string_view unit = text.substr(end);
  if (!unit.empty() && unit[0] == ' ') unit.remove_prefix(1);
  const auto bytes = bytes_of(std::string(unit));
  return bytes ? scaled(text.substr(0, end), *bytes) : std::nullopt;
}

std::optional<double> parse_duration(std::string_view text) {
  const std::size_t end = text.find_last_of("0123456789.") + 1;  // 0 if there is none
  std::string_view unit = text.substr(end);
  if (!unit.empty() && unit[0] == ' ') unit.remove_prefix(1);
  const double seconds = unit.empty() || unit == "s" ? 1
                         : unit == "m"               ? 60
                         : unit == "h"               ? 3600
                         : unit == "d"               ? 86400
                                                     : 0;
  const std::optional<double> number = parse_real(text.substr(0, end));
  if (!number || !(*number * seconds > 0) || !std::isfinite(*number * seconds)) return std::nullopt;
  return *number * seconds;
}

std::vector<std::string> split_list(const std::string& list) {
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    parts.push_back(list.substr(begin, end - begin));
    begin = end + 1;
  }
  return parts;
}

}  // namespace delone::cli
