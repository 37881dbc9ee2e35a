// SPDX-License-Identifier: BSD-3-Clause
#include "compiled/dispatch.hpp"

namespace delone::compiled {

std::unique_ptr<TriangulationEngine> make_triangulation_engine(const std::vector<int>& axes,
                                                               VertexPoints& points,
                                                               const geometry::Frame& frame,
                                                               const engine::Effort& effort,
                                                               bool force_runtime_dimension) {
  return internal::with_compiled_dimension(force_runtime_dimension ? 0 : axes.size(), [&](auto dimension) {
    return make_triangulation_engine<dimension()>(axes, points, frame, effort);
  });
}

}  // namespace delone::compiled
