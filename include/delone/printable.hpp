// SPDX-License-Identifier: BSD-3-Clause
// Foreign text in messages: text from files and arguments, made safe to print.
#pragma once

#include <delone/export.hpp>

#include <cstddef>
#include <string>
#include <string_view>

namespace delone {

/// Text of foreign origin (the name of a column, of a member of an archive, an argument) for a terminal: at
/// most `most` characters of it, then "…" if there are more. Control characters, invisible characters,
/// characters that change the direction of writing, and bytes that are not UTF-8 are written as `\x1b` or
/// `\u{202e}`.
DELONE_EXPORT std::string printable(std::string_view foreign, std::size_t most = 80);

}  // namespace delone
