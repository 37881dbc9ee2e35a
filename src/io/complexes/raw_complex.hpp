// SPDX-License-Identifier: BSD-3-Clause
// The members of a triangulation as a file holds them, before it is known that their shapes agree.
#pragma once

#include <delone/io.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace delone::io {

struct IndexMatrix {
  std::vector<SignedIndex> items;
  std::size_t rows = 0, columns = 0;
};

struct RawComplex {
  PointTable points;
  std::optional<IndexMatrix> cells, neighbors;
  std::optional<std::vector<SignedIndex>> vertex_of_point;
  std::optional<std::vector<double>> weights;
  std::optional<std::int64_t> affine_dimension;
};

/// Puts the members together; bad_format, naming the member, where they disagree. Rows that are out of range
/// are left for `check` to name.
ComplexData assemble(RawComplex raw, const std::string& name);

ComplexData read_npz_complex(std::string_view bytes, const std::string& name);
ComplexData read_json_complex(std::string_view bytes, const std::string& name);
/// `format`: npz, json or off.
ComplexData read_complex_in(const std::string& format, std::string_view bytes, const std::string& name);

}  // namespace delone::io
