// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace delone::python {

/// The text of a raw string, without the line break that it begins with.
constexpr const char* text(const char* doc) { return doc + 1; }

}  // namespace delone::python
