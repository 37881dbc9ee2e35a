// SPDX-License-Identifier: BSD-3-Clause
// Positions in texts, numbers, and the collection of points. See text_cursor.hpp.
#include "io/text_cursor.hpp"

#include "io/file.hpp"
#include "messages/in_quotes.hpp"

#include <charconv>

namespace delone::io {

std::optional<double> to_number(std::string_view text) {
  double value = 0;
  const char* end = text.data() + text.size();
  if (text.empty() || parse_number(text.data(), end, value) != end) return std::nullopt;
  return value;
}

std::optional<std::uint64_t> to_count(std::string_view text) {
  std::uint64_t value = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, value);
  if (text.empty() || stop != end || error != std::errc{}) return std::nullopt;
  return value;
}

std::string_view text_of(std::string_view bytes, const std::string& name) {
  if (bytes.starts_with("\xff\xfe") || bytes.starts_with("\xfe\xff"))
    fail(Errc::bad_format, "{}: this is UTF-16 text; save it as UTF-8", name);
  if (bytes.starts_with("\xef\xbb\xbf")) bytes.remove_prefix(3);
  if (bytes.empty()) fail(Errc::bad_format, "{}: the file is empty", name);
  return bytes;
}

std::string_view TextCursor::rest_of_line() {
  skip_blanks();
  const char* start = p_;
  skip_to_line_end();
  const char* stop = p_;
  while (stop != start && is_blank(stop[-1])) --stop;
  return {start, static_cast<std::size_t>(stop - start)};
}

std::uint64_t TextCursor::count(std::string_view what, std::uint64_t largest) {
  const std::string_view text = next_token();
  if (text.empty()) fail(Errc::bad_format, "{}: the file ends before {}", place(), what);
  const auto value = to_count(text);
  if (!value)
    fail(Errc::bad_format, "{}: {} is {}, which is not a count", place(), what, messages::in_quotes(text));
  if (*value > largest)
    fail(Errc::bad_format, "{}: {} is {}, more than the {} possible here", place(), what, *value, largest);
  return *value;
}

void TextCursor::fail_number(std::string_view what) {
  const std::string_view text = token();
  fail(Errc::bad_format, "{}: {}: {} is not a number", place(), what, messages::in_quotes(text));
}

}  // namespace delone::io
