// SPDX-License-Identifier: BSD-3-Clause
// Points on the faces of their bounding box, as floors and walls mostly are.
#pragma once

#include <span>
#include <vector>

namespace delone::hull {

/// For each row whether it is on a face of the box of all, together with many others, without being extreme
/// among them. Such a point is in the hull of the others, and on its boundary. Empty if there is none.
/// `threads`: as Options::threads. O(rows·d), and the extreme points of each such face.
std::vector<char> find_inner_rows_of_box_faces(std::span<const double> coordinates, int dimension,
                                               unsigned threads);

}  // namespace delone::hull
