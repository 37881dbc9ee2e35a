// SPDX-License-Identifier: BSD-3-Clause
// Text in UTF-8, character by character.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace delone::io {

/// The character that `text` begins with. Bytes that begin no character of UTF-8 stand alone, with is_valid
/// false.
struct Character {
  std::uint32_t code = 0;
  std::size_t size = 1;
  bool is_valid = false;
};

/// Appends a character; U+FFFD in the place of what is none.
void append_utf8(std::string& text, std::uint32_t code);

/// REQUIRES a text that is not empty.
Character first_character(std::string_view text);

/// The text as a JSON value; bytes that are no UTF-8 become U+FFFD.
std::string json_of_text(const std::string& text);

}  // namespace delone::io
