// SPDX-License-Identifier: BSD-3-Clause
// What tiles of points that are spread evenly insert beyond their own points.
#pragma once

namespace delone::cost_model {

/// The inner faces of a tile: one per halving, two per axis at most.
double inner_faces(int k, double num_tiles);

/// Points of other tiles that a tile of n points inserts for each inner face, divided by n: c_k · n^(−1/k),
/// of which this is c_k.
double foreign_per_face(int k);

/// Whether points that are spread evenly over k dimensions, and do not fit in one piece, can be cut so that a
/// tile fits into `memory` bytes and inserts no more points of other tiles than of its own. `bytes`: of all
/// points in one piece. From 6 dimensions on this takes very large sets: neighbors of most points are
/// everywhere.
bool tiles_pay(int k, double points, double bytes, double memory);

}  // namespace delone::cost_model
