// SPDX-License-Identifier: BSD-3-Clause
// Foreign text in messages. See printable.hpp.
#include <fmt/format.h>
#include <delone/printable.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>

namespace delone {

namespace {

/// The character that `text` begins with. Bytes that begin no character of UTF-8 stand alone, with is_valid
/// false.
struct Character {
  std::uint32_t code = 0;
  std::size_t size = 1;
  bool is_valid = false;
};

Character first_character(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<unsigned char>(text[i]); };
  const Character invalid{.code = byte(0)};
  if (byte(0) < 0x80) return {byte(0), 1, true};
  const std::size_t size = byte(0) >= 0xf0 ? 4 : byte(0) >= 0xe0 ? 3 : 2;
  if (byte(0) < 0xc2 || byte(0) > 0xf4 || text.size() < size) return invalid;
  std::uint32_t code = byte(0) & (0x7fu >> size);
  for (std::size_t i = 1; i < size; ++i) {
    if ((byte(i) & 0xc0) != 0x80) return invalid;
    code = code << 6 | (byte(i) & 0x3fu);
  }
  // Longer than need be, a half of a pair of UTF-16, or beyond Unicode.
  const std::uint32_t least = size == 2 ? 0x80 : size == 3 ? 0x800 : 0x10000;
  if (code < least || (code >= 0xd800 && code < 0xe000) || code > 0x10ffff) return invalid;
  return {code, size, true};
}

/// Controls, marks of the direction of writing, and what has no width: none of it can be seen, and a terminal
/// may act on it.
bool is_hidden(std::uint32_t code) {
  struct Range {
    std::uint32_t first, last;
  };
  static constexpr Range hidden[] = {{0, 0x1f},        {0x7f, 0x9f},     {0xad, 0xad},
                                     {0x61c, 0x61c},   {0x180e, 0x180e}, {0x200b, 0x200f},
                                     {0x2028, 0x202e}, {0x2060, 0x206f}, {0xfe00, 0xfe0f},
                                     {0xfeff, 0xfeff}, {0xfff0, 0xfffb}, {0xe0000, 0xe0fff}};
  return std::any_of(std::begin(hidden), std::end(hidden),
                     [code](const Range& range) { return code >= range.first && code <= range.last; });
}

}  // namespace

std::string printable(std::string_view foreign, std::size_t most) {
  std::string out;
  std::size_t used = 0;  // characters
  while (!foreign.empty()) {
    const Character c = first_character(foreign);
    const bool is_escaped = !c.is_valid || is_hidden(c.code), is_byte = !c.is_valid || c.code < 0x80;
    const std::string escape = !is_escaped ? std::string()
                               : is_byte   ? fmt::format("\\x{:02x}", c.code)
                                           : fmt::format("\\u{{{:x}}}", c.code);
    const std::size_t width = is_escaped ? escape.size() : 1;
    if (width > most - used) {
      out.append("…");
      break;
    }
    out.append(is_escaped ? std::string_view(escape) : foreign.substr(0, c.size));
    used += width;
    foreign.remove_prefix(c.size);
  }
  return out;
}

std::string in_quotes(std::string_view foreign) { return fmt::format("'{}'", printable(foreign)); }

}  // namespace delone
