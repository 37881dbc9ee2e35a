// SPDX-License-Identifier: BSD-3-Clause
// Which coordinates a predicate looks at.
#pragma once

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

}  // namespace delone::kernel
