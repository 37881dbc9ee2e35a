// SPDX-License-Identifier: BSD-3-Clause
// Rough quantities in words, for forecasts and limits.
#pragma once

#include <delone/export.hpp>

#include <string>

namespace delone::messages {

/// "840 MB", "1.4 GB": powers of 1000, two or three digits; "more than 1000 EB".
DELONE_EXPORT std::string readable_bytes(double bytes);
/// "0.25 seconds", "4 minutes", "2.5 hours"; two digits; "more than 1000 years".
DELONE_EXPORT std::string readable_seconds(double seconds);

}  // namespace delone::messages
