// SPDX-License-Identifier: BSD-3-Clause
// Foreign text in quotes, for messages.
#pragma once

#include <delone/printable.hpp>

#include <string>
#include <string_view>

namespace delone::messages {

/// printable() in single quotes.
inline std::string in_quotes(std::string_view foreign) {
  std::string text(1, '\'');
  return text.append(printable(foreign)).append(1, '\'');
}

}  // namespace delone::messages
