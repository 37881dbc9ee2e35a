// SPDX-License-Identifier: BSD-3-Clause
// What the fuzz targets of histories share: bytes as a source of choices, and coordinates that are mostly
// degenerate.
#pragma once

#include <delone/check.hpp>
#include <delone/error.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

namespace delone::fuzz {

inline void require(bool condition, const char* what, const std::string& detail = {}) {
  if (condition) return;
  std::fprintf(stderr, "fault: %s %s\n", what, detail.c_str());
  std::abort();
}

template <class Data>
void require_checked(const Data& data, const char* what, const CheckOptions& options = {}) {
  const CheckReport report = check(data, options);
  require(report.ok, what, report.violation);
}

/// Choices that are read from the input; zeros after its end.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}
  bool empty() const { return size_ == 0; }
  std::uint8_t next() {
    if (size_ == 0) return 0;
    --size_;
    return *data_++;
  }
  std::size_t below(std::size_t bound) { return next() % bound; }

  /// How coordinates are made of bytes: small integers; of a grid turned by an angle with sine 0.6; with some
  /// one ulp off, or scaled by 2^±500; any finite doubles; in clusters that are 2^-30 wide; on a paraboloid,
  /// that is with many cospherical or coplanar lifts.
  enum class Style { integers, turned, ulps, any, clusters, curve };
  static constexpr std::size_t num_styles = 6;

  double coordinate(Style style) {
    const std::uint8_t byte = next();
    double value = byte % 5;
    switch (style) {
      case Style::integers:
      case Style::curve:
        return value;
      case Style::turned:
        return 0.6 * value - 0.8 * (byte / 5 % 5);
      case Style::ulps:
        if (byte >= 192) value = std::nextafter(value, 8.0);
        return (byte & 48) == 48 ? std::ldexp(value, (byte & 8) != 0 ? 500 : -500) : value;
      case Style::clusters:
        return byte % 3 + std::ldexp(byte / 3 % 8, -30);
      default:
        break;
    }
    std::uint8_t all[8] = {byte};
    for (int i = 1; i < 8; ++i) all[i] = next();
    std::memcpy(&value, all, sizeof value);
    return std::isfinite(value) ? value : byte;
  }
  std::vector<double> row(std::size_t size, Style style) {
    std::vector<double> result(size);
    for (double& x : result) x = coordinate(style);
    if (style == Style::curve && size > 1) {
      result.back() = 0;
      for (std::size_t j = 0; j + 1 < size; ++j) result.back() += result[j] * result[j];
    }
    return result;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_;
};

/// Runs what may be cancelled or refused; whether it was.
template <class Action>
bool is_refused(Action action) {
  try {
    action();
    return false;
  } catch (const Error& error) {
    require(!std::string(error.what()).empty(), "an error without a message");
    return true;
  }
}

}  // namespace delone::fuzz
