// SPDX-License-Identifier: BSD-3-Clause
// A position in a text that knows its line: blanks, line ends (LF, CRLF or CR), '#' comments, tokens,
// numbers. The text formats are written on top of it.
#pragma once

#include <fast_float/fast_float.h>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>

namespace delone::io {

/// Parses the number that starts at `p`, correctly rounded: the end of it, or nullptr if there is none.
/// Magnitudes beyond binary64 give an infinity or a zero. An explicit plus sign is accepted, hexadecimal and
/// the like are not.
inline const char* parse_number(const char* p, const char* end, double& value) {
  if (p != end && *p == '+') {
    ++p;
    if (p != end && *p == '-') return nullptr;
  }
  const auto result = fast_float::from_chars(p, end, value);
  return result.ec == std::errc{} || result.ec == std::errc::result_out_of_range ? result.ptr : nullptr;
}

/// The whole of `text` as a number. Blanks around it are not accepted.
std::optional<double> to_number(std::string_view text);
/// The whole of `text` as a non-negative decimal integer of at most 64 bits.
std::optional<std::uint64_t> to_count(std::string_view text);

/// The text without a UTF-8 byte order mark. Throws bad_format for an empty file and for UTF-16.
std::string_view text_of(std::string_view bytes, const std::string& name);

class TextCursor {
 public:
  /// `line`: the number of the first line.
  TextCursor(std::string_view text, std::string name, std::size_t line = 1)
      : p_(text.data()), end_(text.data() + text.size()), name_(std::move(name)), line_(line) {}

  const char* position() const { return p_; }
  const char* end() const { return end_; }
  void move_to(const char* p) { p_ = p; }
  std::string_view rest() const { return {p_, remaining()}; }
  std::size_t remaining() const { return static_cast<std::size_t>(end_ - p_); }
  std::size_t line() const { return line_; }
  const std::string& name() const { return name_; }
  /// "FILE:LINE"
  std::string place() const { return name_ + ":" + std::to_string(line_); }

  bool at_end() const { return p_ == end_; }
  bool at_line_end() const { return p_ == end_ || *p_ == '\n' || *p_ == '\r'; }
  /// REQUIRES at_line_end(). Goes to the next line, if there is one.
  void take_line_end() {
    if (p_ == end_) return;
    if (*p_ == '\r' && p_ + 1 != end_ && p_[1] == '\n') ++p_;
    ++p_;
    ++line_;
  }
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\v' || c == '\f'; }
  void skip_blanks() {
    while (p_ != end_ && is_blank(*p_)) ++p_;
  }
  void skip_to_line_end() {
    while (!at_line_end()) ++p_;
  }
  /// Skips blanks and a comment; true if that reaches the end of the line.
  bool skip_to_content() {
    skip_blanks();
    if (p_ != end_ && *p_ == '#') skip_to_line_end();
    return at_line_end();
  }
  /// Goes to the next line end, comments and blanks included, until there is content; false at the end of the
  /// text.
  bool find_content() {
    while (skip_to_content()) {
      if (at_end()) return false;
      take_line_end();
    }
    return true;
  }
  /// The characters up to the next blank, line end or '#'. Empty at the end of the line.
  std::string_view token() {
    const char* start = p_;
    while (!at_line_end() && !is_blank(*p_) && *p_ != '#') ++p_;
    return {start, static_cast<std::size_t>(p_ - start)};
  }
  /// The next token, on this line or a later one; empty at the end of the text.
  std::string_view next_token() { return find_content() ? token() : std::string_view{}; }
  /// The rest of the line without blanks around it. Does not take the line end.
  std::string_view rest_of_line();

  /// Reads the number at the cursor, which must be followed by a blank, a line end or a comment. `what` names
  /// it in errors.
  double number(std::string_view what) {
    double value = 0;
    if (!try_number(value)) fail_number(what);
    return value;
  }
  /// The same; false, and no move, if there is no number.
  bool try_number(double& value) {
    const char* stop = parse_number(p_, end_, value);
    if (stop == nullptr ||
        (stop != end_ && !is_blank(*stop) && *stop != '\n' && *stop != '\r' && *stop != '#'))
      return false;
    p_ = stop;
    return true;
  }
  /// The next token as a count no larger than `largest`.
  std::uint64_t count(std::string_view what, std::uint64_t largest);

 private:
  [[noreturn]] void fail_number(std::string_view what);

  const char* p_;
  const char* end_;
  std::string name_;
  std::size_t line_;
};

}  // namespace delone::io
