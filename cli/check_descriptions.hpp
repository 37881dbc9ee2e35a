// SPDX-License-Identifier: BSD-3-Clause
// delone check --same-as: two files that describe one polyhedron.
#pragma once

#include <cstdint>
#include <string>

namespace delone::cli {

/// Proves that two descriptions, of inequalities or generators, are those of one polyhedron, or prints what
/// one of them has beyond the other. Returns the exit status.
int run_check_descriptions(const std::string& path, const std::string& other, std::uint64_t max_stream_bytes,
                           unsigned threads);

}  // namespace delone::cli
