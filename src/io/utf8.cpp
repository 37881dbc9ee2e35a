// SPDX-License-Identifier: BSD-3-Clause
#include "io/utf8.hpp"

#include <nlohmann/json.hpp>

namespace delone::io {

void append_utf8(std::string& text, std::uint32_t code) {
  if (code > 0x10ffff || (code >= 0xd800 && code < 0xe000)) code = 0xfffd;
  if (code < 0x80) {
    text += static_cast<char>(code);
    return;
  }
  const int further = code < 0x800 ? 1 : code < 0x10000 ? 2 : 3;
  constexpr unsigned char first[] = {0, 0xc0, 0xe0, 0xf0};
  text += static_cast<char>(first[further] | (code >> (6 * further)));
  for (int i = further; i-- > 0;) text += static_cast<char>(0x80 | ((code >> (6 * i)) & 0x3f));
}

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

std::string json_of_text(const std::string& text) {
  return nlohmann::json(text).dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace delone::io
