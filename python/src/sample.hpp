// SPDX-License-Identifier: BSD-3-Clause
// Samples of large triangulations, for the small pictures in notebooks.
#pragma once

#include "triangulation.hpp"

#include <cstddef>

namespace delone::python {

/// What pictures are drawn from, float64: the vertices of up to `limit` cells, (s, k+1, d), those of the
/// facets of the hull, (h, k, d), if there are no more, and the bounding box of these, (2, d). Of many cells
/// a sample: for every n-th row the incident cell of smallest rows, or for k > 3 the row alone, (s, 1, d). A
/// function of the points. Cost: O(limit) stars.
py::tuple sample(const HeldTriangulation& held, std::size_t limit);

}  // namespace delone::python
