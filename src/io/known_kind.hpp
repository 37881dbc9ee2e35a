// SPDX-License-Identifier: BSD-3-Clause
// What files say that they hold.
#pragma once

#include <delone/data.hpp>

#include <string>
#include <string_view>

namespace delone::io {

/// The kind of that name. Throws bad_format, with all names, for another one.
DataKind known_kind(std::string_view kind, const std::string& name);

}  // namespace delone::io
