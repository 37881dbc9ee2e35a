// SPDX-License-Identifier: BSD-3-Clause
// A text in parts of whole lines, which several threads can read.
#pragma once

#include <cstddef>
#include <optional>
#include <string_view>
#include <vector>

namespace delone::io {

/// Begins where a line does, and ends after a line end or at the end of the text.
struct LinePart {
  std::string_view text;
  std::size_t first_line;  ///< its number
  std::size_t num_lines;
};

/// How a text is read: in parts of about so many bytes, which up to `threads` threads share (as
/// Options::threads). Nothing else depends on it.
struct ReadingInParts {
  unsigned threads = 1;
  std::size_t part_bytes = std::size_t{1} << 20;
};

/// The line ends in a text: LF, CRLF or CR.
std::size_t count_line_ends(std::string_view text);

/// Splits a text whose first line has the given number, and starts at its beginning or elsewhere. Nothing if
/// one thread should read it: if it is short, or contains the character `never` (0: none), as a quote, which
/// may stand around line ends.
std::vector<LinePart> split_lines(std::string_view text, std::size_t first_line, char never,
                                  const ReadingInParts& how);

}  // namespace delone::io
