// SPDX-License-Identifier: BSD-3-Clause
// Matrices that are not points, one per value of MISUSE; 0 is the correct program.
#include <delone/points.hpp>

#include <Eigen/Core>

void take(const delone::AnyPoints<3>&) {}

void misuse(const Eigen::MatrixXd& columns, const Eigen::MatrixXf& floats) {
#if MISUSE == 0
  take(columns.transpose());
  (void)floats;
#elif MISUSE == 1  // column-major
  take(columns);
#elif MISUSE == 2  // floats
  take(floats.transpose());
#endif
}
