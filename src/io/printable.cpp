// SPDX-License-Identifier: BSD-3-Clause
// Foreign text in messages. See printable.hpp.
#include "io/utf8.hpp"

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
    const io::Character c = io::first_character(foreign);
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

}  // namespace delone
