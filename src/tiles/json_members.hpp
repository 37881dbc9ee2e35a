// SPDX-License-Identifier: BSD-3-Clause
// The members of a JSON object that delone has written. A member that is missing, of another kind or out of
// range is an error that names it.
#pragma once

#include "io/atomic_file.hpp"
#include "io/file.hpp"
#include "messages/in_quotes.hpp"

#include <nlohmann/json.hpp>

#include <delone/periodic.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <utility>

namespace delone::tiles {

class JsonMembers {
 public:
  JsonMembers(const nlohmann::json& object, std::string name) : object_(object), name_(std::move(name)) {
    if (!object_.is_object()) io::fail(Errc::bad_format, "{}: expected a JSON object", name_);
  }

  /// Throws bad_format unless `format` is `expected`, and unsupported for a later version. `what`: as in "an
  /// index of tiles".
  void require_format(const char* expected, std::int64_t version, const char* what) const {
    if (const std::string found = text("format"); found != expected)
      io::fail(Errc::bad_format, "{}: not {}: its format is {}", name_, what, messages::in_quotes(found));
    if (const std::int64_t found = number("version", 1, std::numeric_limits<std::int64_t>::max());
        found > version)
      io::fail(Errc::unsupported, "{}: version {} of tiles; this program knows version {}", name_, found,
               version);
  }
  std::int64_t number(const char* member, std::int64_t least, std::int64_t largest) const {
    const nlohmann::json& value = find(member);
    // Compared with signed numbers, those of 2^63 and more would be negative.
    constexpr auto most = static_cast<std::uint64_t>(std::numeric_limits<std::int64_t>::max());
    const bool is_beyond = value.is_number_unsigned() && value.get<std::uint64_t>() > most;
    if (!value.is_number_integer() || is_beyond || value > largest || value < least)
      io::fail(Errc::bad_format, "{}: {}: expected a number from {} to {}, found {}", name_, member, least,
               largest, printable(value.dump()));
    return value.get<std::int64_t>();
  }
  double real(const char* member) const {
    const nlohmann::json& value = find(member);
    if (!value.is_number()) refuse(member, "a number", value);
    return value.get<double>();
  }
  bool flag(const char* member) const {
    const nlohmann::json& value = find(member);
    if (!value.is_boolean()) refuse(member, "true or false", value);
    return value.get<bool>();
  }
  std::string text(const char* member) const {
    const nlohmann::json& value = find(member);
    if (!value.is_string()) refuse(member, "a text", value);
    return value.get<std::string>();
  }
  /// A text of 16 hexadecimal digits per word.
  template <std::size_t n>
  std::array<std::uint64_t, n> words(const char* member) const {
    const std::string digits = text(member);
    std::array<std::uint64_t, n> result{};
    const bool is_hex = std::all_of(digits.begin(), digits.end(),
                                    [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); });
    if (digits.size() != 16 * n || !is_hex)
      io::fail(Errc::bad_format, "{}: {}: expected {} hexadecimal digits, found {}", name_, member, 16 * n,
               messages::in_quotes(digits));
    for (std::size_t i = 0; i < n; ++i) result[i] = std::stoull(digits.substr(16 * i, 16), nullptr, 16);
    return result;
  }
  const nlohmann::json& array(const char* member) const {
    const nlohmann::json& value = find(member);
    if (!value.is_array()) refuse(member, "an array", value);
    return value;
  }
  /// The lattice of a periodic set in R^dimension; none if there is no such member.
  Lattice lattice(int dimension) const {
    Lattice lattice{dimension, {}};
    if (!object_.contains("lattice")) return lattice;
    const nlohmann::json& numbers = array("lattice");
    const auto d = static_cast<std::size_t>(dimension);
    if (numbers.empty() || numbers.size() % d != 0 || numbers.size() > d * d)
      io::fail(Errc::bad_format, "{}: lattice: {} numbers are no vectors of R^{}", name_, numbers.size(), d);
    for (const nlohmann::json& number : numbers) {
      if (!number.is_number()) refuse("lattice", "numbers", number);
      lattice.vectors.push_back(number.get<double>());
    }
    return lattice;
  }
  /// That of a periodic set; 0 if there is no such member.
  double unit() const {
    if (!object_.contains("unit")) return 0;
    const double unit = real("unit");
    if (!(unit > 0 && std::isfinite(unit))) refuse("unit", "a finite number above 0", find("unit"));
    return unit;
  }
  const std::string& name() const { return name_; }

 private:
  const nlohmann::json& find(const char* member) const {
    const auto found = object_.find(member);
    if (found == object_.end()) io::fail(Errc::bad_format, "{}: there is no member '{}'", name_, member);
    return *found;
  }
  [[noreturn]] void refuse(const char* member, std::string_view expected, const nlohmann::json& found) const {
    io::fail(Errc::bad_format, "{}: {}: expected {}, found {}", name_, member, expected,
             printable(found.dump()));
  }

  const nlohmann::json& object_;
  std::string name_;
};

/// The JSON value that a file holds. Throws cannot_open or bad_format.
inline nlohmann::json read_json(const std::string& path) {
  const std::string name = io::input_name(path);
  const io::Bytes bytes = io::read_all(path, 0, [](std::string_view, bool) {});
  try {
    return nlohmann::json::parse(bytes.view());
  } catch (const nlohmann::json::exception& error) {
    io::fail(Errc::bad_format, "{}: {}", name, printable(error.what(), 200));
  }
}

/// Writes a JSON value, whole or not at all, also at a power cut if `durably`.
inline void write_json(const std::string& path, const nlohmann::ordered_json& json, bool durably) {
  io::guarded(io::output_name(path), [&] {
    io::AtomicFile file(path);
    file.write(json.dump(1) + "\n");
    if (durably)
      file.commit_durably();
    else
      file.commit();
  });
}

inline constexpr std::int64_t largest_crc32 = std::numeric_limits<std::uint32_t>::max();
/// Of points, cells or bytes.
inline constexpr std::int64_t largest_count = std::numeric_limits<std::int64_t>::max() - 1;

/// 16 hexadecimal digits per word.
template <std::size_t n>
std::string hex_text(const std::array<std::uint64_t, n>& words) {
  std::string text;
  for (const std::uint64_t word : words) text += fmt::format("{:016x}", word);
  return text;
}

}  // namespace delone::tiles
