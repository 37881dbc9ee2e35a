// SPDX-License-Identifier: BSD-3-Clause
// Data of every kind as their arrays (arrays.hpp), for NumPy and as JSON. The caller commits the file.
#pragma once

#include <delone/data.hpp>

#include <string>

namespace delone::io {

class AtomicFile;

/// Throws bad_dimension, or invalid_argument naming the array whose size or offsets do not fit the others.
template <PlainData Data>
void validate(const Data& data, const std::string& name);

// REQUIRE data that validate() has passed.
template <PlainData Data>
void write_npz(AtomicFile& file, const Data& data);
template <PlainData Data>
void write_json(AtomicFile& file, const Data& data);

}  // namespace delone::io
