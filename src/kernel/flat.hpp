// SPDX-License-Identifier: BSD-3-Clause
// Which coordinates a predicate looks at, and how its stages are counted.
#pragma once

#include <delone/types.hpp>

#include <cstdint>
#include <span>

namespace delone::kernel {

/// Points of R^ambient whose affine hull projects one-to-one on the coordinate axes `axes` (k of them, increasing).
/// Orientations are taken after that projection; squared lengths |x|² use all `ambient` coordinates, so that spheres are
/// those of the flat. In full dimension `axes` is 0 … ambient−1.
struct Flat {
  int ambient = 0;
  std::span<const int> axes;
  int dimension() const { return static_cast<int>(axes.size()); }
};

/// How often each stage of the conflict predicate decided.
struct StageCounts {
  std::uint64_t filter = 0;
  std::uint64_t direct = 0;
  std::uint64_t exact = 0;
  std::uint64_t perturbed = 0;
};

}  // namespace delone::kernel
