// SPDX-License-Identifier: BSD-3-Clause
// Rough quantities for messages.
#include "messages/readable.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <string>
#include <utility>

namespace delone::messages {
namespace {

/// Below ten with one digit after the point, if it is not 0. The same in every locale.
std::string rounded(double x) {
  const auto written = [x](std::chars_format form, int digits) {
    std::array<char, 64> text;
    return std::string(text.data(),
                       std::to_chars(text.data(), text.data() + text.size(), x, form, digits).ptr);
  };
  if (x < 0.95) return written(std::chars_format::general, x < 0.095 ? 1 : 2);
  return written(std::chars_format::fixed, x < 9.95 && std::round(10 * x) != 10 * std::round(x) ? 1 : 0);
}

}  // namespace

std::string readable_bytes(double bytes) {
  if (!(bytes >= 0)) return "an unknown number of bytes";
  if (bytes > 1e21) return "more than 1000 EB";
  constexpr std::array units{"bytes", "kB", "MB", "GB", "TB", "PB", "EB"};
  std::size_t unit = 0;
  for (; bytes >= 999.5 && unit + 1 < units.size(); bytes /= 1000) ++unit;
  return (unit == 0 ? std::to_string(static_cast<int>(bytes)) : rounded(bytes)) + " " + units[unit];
}

std::string readable_seconds(double seconds) {
  constexpr double year = 365.25 * 86400;
  constexpr std::array<std::pair<double, const char*>, 5> units{
      {{year, "year"}, {86400, "day"}, {3600, "hour"}, {60, "minute"}, {1, "second"}}};
  if (!(seconds >= 0)) return "an unknown time";
  if (seconds > 1000 * year) return "more than 1000 years";
  // From one and a half of a unit on it is that unit.
  const auto unit =
      std::find_if(units.begin(), units.end() - 1, [&](const auto& u) { return seconds >= 1.5 * u.first; });
  const std::string text = rounded(seconds / unit->first);
  return text + " " + unit->second + (text == "1" ? "" : "s");
}

}  // namespace delone::messages
