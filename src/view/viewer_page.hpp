// SPDX-License-Identifier: BSD-3-Clause
// viewer/dist/viewer.html, which `make viewer` makes, as the library holds it: CMake turns the file into a
// source (cmake/viewer.cmake).
#pragma once

#include <span>
#include <string_view>

namespace delone::view {

/// The page up to where its data go, and from there on, each in parts of a few thousand bytes.
std::span<const std::string_view> page_before_data();
std::span<const std::string_view> page_after_data();

}  // namespace delone::view
