// SPDX-License-Identifier: BSD-3-Clause
// Rough quantities for messages.
#pragma once

#include <string>

namespace delone::internal {

/// "840 MB", "1.4 GB": powers of 1000, two or three digits.
std::string readable_bytes(double bytes);
/// "0.25 seconds", "4 minutes", "2.5 hours", "3 days"; two digits.
std::string readable_seconds(double seconds);

}  // namespace delone::internal
