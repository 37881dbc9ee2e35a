// SPDX-License-Identifier: BSD-3-Clause
#include "front_ends/dispatch.hpp"

namespace delone {

std::unique_ptr<Hull> make_hull(const std::vector<int>& axes, const VertexPoints& points, const geometry::Frame& frame,
                                const engine::Effort& effort, bool force_runtime_dimension) {
  static_assert(largest_compiled_dimension == 8);
  switch (force_runtime_dimension ? 0 : axes.size()) {
    case 1:
      return make_hull<1>(axes, points, frame, effort);
    case 2:
      return make_hull<2>(axes, points, frame, effort);
    case 3:
      return make_hull<3>(axes, points, frame, effort);
    case 4:
      return make_hull<4>(axes, points, frame, effort);
    case 5:
      return make_hull<5>(axes, points, frame, effort);
    case 6:
      return make_hull<6>(axes, points, frame, effort);
    case 7:
      return make_hull<7>(axes, points, frame, effort);
    case 8:
      return make_hull<8>(axes, points, frame, effort);
    default:
      return make_hull<0>(axes, points, frame, effort);
  }
}

}  // namespace delone
