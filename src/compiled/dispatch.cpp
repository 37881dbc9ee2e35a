// SPDX-License-Identifier: BSD-3-Clause
#include "compiled/dispatch.hpp"

namespace delone {

std::unique_ptr<Hull> make_hull(const std::vector<int>& axes, const VertexPoints& points,
                                const geometry::Frame& frame, const engine::Effort& effort,
                                bool force_runtime_dimension) {
  return internal::with_compiled_dimension(force_runtime_dimension ? 0 : axes.size(), [&](auto dimension) {
    return make_hull<dimension()>(axes, points, frame, effort);
  });
}

}  // namespace delone
