// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "triangulation.hpp"

#include <memory>

namespace delone::python {

/// Delaunay, Regular and FurthestSite, which are derived from `base`, and how they change.
void bind_edits(py::module_& module, py::class_<HeldTriangulation, std::shared_ptr<HeldTriangulation>>& base);

}  // namespace delone::python
