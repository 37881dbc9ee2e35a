// SPDX-License-Identifier: BSD-3-Clause
// Points as Eigen has them. The library does not include Eigen.
#include <delone/points.hpp>

#include <Eigen/Core>

#include <cstdio>
#include <vector>

namespace {

int failures = 0;

void expect(bool condition, const char* what) {
  if (condition) return;
  std::printf("failed: %s\n", what);
  ++failures;
}

template <int D>
bool holds(const delone::AnyPoints<D>& points, const std::vector<double>& expected) {
  const auto found = points.coordinates();
  return std::vector<double>(found.begin(), found.end()) == expected;
}

using RowMajor = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

void matrices() {
  RowMajor rows(2, 3);
  rows << 1, 2, 3, 4, 5, 6;
  const std::vector<double> expected{1, 2, 3, 4, 5, 6};
  expect(delone::AnyPoints<3>(rows).coordinates().data() == rows.data(),
         "a row-major matrix is read in place");
  expect(holds<3>(rows, expected), "the rows of a matrix");
  expect(delone::AnyPoints<>(rows).dimension() == 3, "the dimension of a matrix");

  const Eigen::MatrixXd columns = rows.transpose();  // a point per column
  const delone::AnyPoints<3> transposed(columns.transpose());
  expect(transposed.coordinates().data() == columns.data(), "a transposed matrix is read in place");
  expect(holds<3>(columns.transpose(), expected), "the columns of a matrix");

  RowMajor wide(2, 5);
  wide << 1, 2, 3, 0, 0, 4, 5, 6, 0, 0;
  expect(holds<3>(wide.leftCols(3), expected), "a block of a matrix is copied");
  using Strides = Eigen::Stride<Eigen::Dynamic, Eigen::Dynamic>;
  const std::vector<double> sparse{1, 0, 2, 0, 3, 0, 9, 4, 0, 5, 0, 6, 0, 9};
  const Eigen::Map<const RowMajor, 0, Strides> map(sparse.data(), 2, 3, Strides(7, 2));
  expect(holds<3>(map, expected), "a map with strides is copied");

  const Eigen::Matrix<double, Eigen::Dynamic, 3, Eigen::RowMajor> three = rows;
  expect(holds<3>(three, expected), "a matrix of three columns");
  expect(holds<3>(Eigen::VectorXd(rows.reshaped<Eigen::RowMajor>()), expected),
         "a vector of all coordinates");
  expect(holds<2>(Eigen::Map<const Eigen::VectorXd, 0, Eigen::InnerStride<2>>(sparse.data(), 2), {1, 2}),
         "a vector with gaps");
  expect(holds<3>(rows.rowwise(), expected), "the range of the rows of a matrix");
  try {
    const delone::AnyPoints<2> wrong(rows);
    expect(false, "another number of columns throws");
  } catch (const delone::Error& error) {
    expect(error.code() == delone::Errc::bad_dimension, "another number of columns is bad_dimension");
  }
}

void vectors() {
  const std::vector<Eigen::Vector3d> points{{1, 2, 3}, {4, 5, 6}};
  const delone::AnyPoints<3> seen(points);
  expect(seen.coordinates().data() == points[0].data(), "fixed-size vectors are read in place");
  expect(holds<3>(points, {1, 2, 3, 4, 5, 6}), "fixed-size vectors");
  expect(holds<2>(std::vector<Eigen::RowVector2d>{{1, 2}, {3, 4}}, {1, 2, 3, 4}), "rows of fixed size");
  expect(holds<3>(std::vector<Eigen::Vector3f>{{1, 2, 3}}, {1, 2, 3}), "vectors of floats are copied");
  expect(holds<2>(std::vector<Eigen::VectorXd>{Eigen::Vector2d(1, 2), Eigen::Vector2d(3, 4)}, {1, 2, 3, 4}),
         "vectors of any size are copied");
  const double four[] = {1, 2, 3, 4};
  using Map = Eigen::Map<const Eigen::Vector2d>;  // of the size of two doubles, which are not its coordinates
  expect(holds<2>(std::vector<Map>{Map(four), Map(four + 2)}, {1, 2, 3, 4}), "maps are copied");

  const auto is_234 = [](const delone::AnyPoint<3>& point) {
    return point.coordinates()[0] == 2 && point.coordinates()[1] == 3 && point.coordinates()[2] == 4;
  };
  expect(is_234(Eigen::Vector3d(2, 3, 4)), "a point");
  expect(is_234(Eigen::VectorXd(Eigen::Vector3d(2, 3, 4))), "a point as a vector of any size");
  expect(is_234(Eigen::Vector3d(1, 2, 3) + Eigen::Vector3d::Ones()), "a point as an expression");
  expect(is_234(Eigen::Map<const Eigen::Vector3d>(four + 1)), "a point as a map");
  expect(is_234(Eigen::RowVector3f(2, 3, 4)), "a point of floats");
}

}  // namespace

int main() {
  matrices();
  vectors();
  return failures;
}
