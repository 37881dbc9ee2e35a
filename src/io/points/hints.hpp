// SPDX-License-Identifier: BSD-3-Clause
// What a text looks like that a reader of points has refused.
#pragma once

#include <delone/error.hpp>

#include <string>
#include <string_view>

namespace delone::io {

/// Whether a text is in Qhull's form, as rbox writes it: a dimension, with or without a comment; a number of
/// points; their coordinates. False for all that can be white space separated rows instead.
bool is_qhull_form(std::string_view text);

/// Whether a text is in the chemists' xyz format: a count; a line of comment; an element and at least three
/// numbers. False for all that can be white space separated rows, or Qhull's form, instead.
bool is_xyz_form(std::string_view text);

/// A clause that says what a file of this format looks like instead, and what may be done: a separator that
/// is another one, a header, a binary file. Empty if nothing is to be seen.
std::string hint_for(std::string_view bytes, std::string_view format);

/// Runs a reader, and adds the hint to what it says of a bad format.
template <class Read>
auto with_hint(std::string_view bytes, std::string_view format, const Read& read) {
  try {
    return read();
  } catch (const Error& e) {
    if (e.code() != Errc::bad_format) throw;
    const std::string hint = hint_for(bytes, format);
    if (hint.empty()) throw;
    throw Error(e.code(), std::string(e.what()) + "; " + hint, e.rows());
  }
}

}  // namespace delone::io
