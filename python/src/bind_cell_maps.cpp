// SPDX-License-Identifier: BSD-3-Clause
// Linear maps of many cells at once, rounded: barycentric coordinates, and hyperplanes on the paraboloid. For
// delone._transform and delone.spatial. They decide nothing combinatorial.
#include "arrays.hpp"
#include "module.hpp"
#include "running.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;
constexpr double nan = std::numeric_limits<double>::quiet_NaN();
using Rows = py::array_t<SignedIndex, py::array::c_style | py::array::forcecast>;
using Reals = py::array_t<double, py::array::c_style | py::array::forcecast>;

/// The matrix of a cell, whose rows are the edges from its last vertex, factored with partial pivoting.
class Edges {
 public:
  explicit Edges(std::size_t k) : k_(k), matrix_(k * k), place_(k), scratch_(k) {}

  /// Returns false if the matrix is singular or beyond the range of doubles.
  bool set(const double* points, const SignedIndex* cell) {
    const double* const last = point(points, cell[k_]);
    for (std::size_t i = 0; i < k_; ++i) {
      const double* const p = point(points, cell[i]);
      for (std::size_t j = 0; j < k_; ++j) matrix_[i * k_ + j] = p[j] - last[j];
    }
    norm_ = 0;
    for (std::size_t j = 0; j < k_; ++j) {
      double sum = 0;
      for (std::size_t i = 0; i < k_; ++i) sum += std::fabs(matrix_[i * k_ + j]);
      norm_ = std::max(norm_, sum);
    }
    return decompose();
  }
  /// The largest absolute column sum.
  double norm() const { return norm_; }

  /// Solves matrix · x = b.
  void solve(const double* b, double* x) {
    for (std::size_t i = 0; i < k_; ++i) {
      double sum = b[place_[i]];
      for (std::size_t j = 0; j < i; ++j) sum -= matrix_[i * k_ + j] * scratch_[j];
      scratch_[i] = sum;
    }
    for (std::size_t i = k_; i-- > 0;) {
      double sum = scratch_[i];
      for (std::size_t j = i + 1; j < k_; ++j) sum -= matrix_[i * k_ + j] * x[j];
      x[i] = sum / matrix_[i * k_ + i];
    }
  }

 private:
  const double* point(const double* points, SignedIndex row) const {
    return points + static_cast<std::size_t>(row) * k_;
  }

  bool decompose() {
    for (std::size_t i = 0; i < k_; ++i) place_[i] = i;
    for (std::size_t c = 0; c < k_; ++c) {
      std::size_t pivot = c;
      for (std::size_t i = c + 1; i < k_; ++i)
        if (std::fabs(matrix_[i * k_ + c]) > std::fabs(matrix_[pivot * k_ + c])) pivot = i;
      if (pivot != c) {
        std::swap_ranges(&matrix_[c * k_], &matrix_[c * k_] + k_, &matrix_[pivot * k_]);
        std::swap(place_[c], place_[pivot]);
      }
      const double divisor = matrix_[c * k_ + c];
      if (divisor == 0 || !std::isfinite(divisor)) return false;
      for (std::size_t i = c + 1; i < k_; ++i) {
        const double factor = matrix_[i * k_ + c] /= divisor;
        for (std::size_t j = c + 1; j < k_; ++j) matrix_[i * k_ + j] -= factor * matrix_[c * k_ + j];
      }
    }
    return true;
  }

  std::size_t k_;
  std::vector<double> matrix_;
  std::vector<std::size_t> place_;
  std::vector<double> scratch_;
  double norm_ = 0;
};

/// Checks that the arrays fit each other. Returns the number of cells.
std::size_t checked(const Reals& points, const Rows& cells) {
  if (points.ndim() != 2 || cells.ndim() != 2 || cells.shape(1) != points.shape(1) + 1)
    throw py::value_error("points (n, k) and cells (m, k+1) do not fit");
  const SignedIndex* const end = cells.data() + cells.size();
  if (std::any_of(cells.data(), end, [&](SignedIndex row) { return row < 0 || row >= points.shape(0); }))
    throw py::value_error("cells: not rows of points");
  return static_cast<std::size_t>(cells.shape(0));
}

py::tuple transforms(const Reals& points, const Rows& cells) {
  const std::size_t count = checked(points, cells), k = static_cast<std::size_t>(points.shape(1));
  py::array_t<double> maps({count, k + 1, k}), conditions(static_cast<py::ssize_t>(count));
  Supervisor supervisor;
  supervisor.run([&, p = points.data(), c = cells.data(), out = maps.mutable_data(),
                  condition = conditions.mutable_data()] {
    Edges edges(k);
    std::vector<double> unit(k);
    for (std::size_t i = 0; i < count; ++i) {
      cancellation_point();
      double* const map = out + i * (k + 1) * k;
      std::copy_n(p + static_cast<std::size_t>(c[i * (k + 1) + k]) * k, k, map + k * k);
      condition[i] = nan;
      if (!edges.set(p, c + i * (k + 1))) {
        std::fill_n(map, k * k, nan);
        continue;
      }
      double norm = 0;
      for (std::size_t j = 0; j < k; ++j) {
        unit.assign(k, 0.0);
        unit[j] = 1;
        edges.solve(unit.data(), map + j * k);
        double sum = 0;
        for (std::size_t l = 0; l < k; ++l) sum += std::fabs(map[j * k + l]);
        norm = std::max(norm, sum);
      }
      condition[i] = norm * edges.norm();
    }
  });
  return py::make_tuple(maps, conditions);
}

py::array hyperplanes(const Reals& points, const Rows& cells, const Reals& heights) {
  const std::size_t count = checked(points, cells), k = static_cast<std::size_t>(points.shape(1));
  if (heights.ndim() != 1 || heights.shape(0) != points.shape(0))
    throw py::value_error("heights: one for each point");
  py::array_t<double> planes({count, k + 2});
  Supervisor supervisor;
  supervisor.run([&, p = points.data(), c = cells.data(), h = heights.data(), out = planes.mutable_data()] {
    Edges edges(k);
    std::vector<double> rise(k);
    for (std::size_t i = 0; i < count; ++i) {
      cancellation_point();
      const SignedIndex* const cell = c + i * (k + 1);
      double* const plane = out + i * (k + 2);
      const double last = h[cell[k]];
      for (std::size_t j = 0; j < k; ++j) rise[j] = h[cell[j]] - last;
      if (!edges.set(p, cell)) {
        std::fill_n(plane, k + 2, nan);
        continue;
      }
      edges.solve(rise.data(), plane);
      double length = 1;
      for (std::size_t j = 0; j < k; ++j) length += plane[j] * plane[j];
      length = std::sqrt(length);
      const double* const at = p + static_cast<std::size_t>(cell[k]) * k;
      double offset = last / length;
      for (std::size_t j = 0; j < k; ++j) {
        plane[j] /= length;
        offset -= plane[j] * at[j];
      }
      plane[k] = -1 / length;
      plane[k + 1] = offset;
    }
  });
  return planes;
}

/// The cells with their vertices in increasing order, and the neighbors in the order of the vertices opposite
/// them.
py::tuple increasing(const Rows& cells, const Rows& neighbors) {
  if (cells.ndim() != 2 || neighbors.ndim() != 2 || cells.shape(0) != neighbors.shape(0) ||
      cells.shape(1) != neighbors.shape(1))
    throw py::value_error("cells and neighbors, both (m, k), do not fit");
  const auto count = static_cast<std::size_t>(cells.shape(0)), k = static_cast<std::size_t>(cells.shape(1));
  py::array_t<SignedIndex> sorted({count, k}), opposite({count, k});
  Supervisor supervisor;
  supervisor.run([&, from = cells.data(), beside = neighbors.data(), to = sorted.mutable_data(),
                  along = opposite.mutable_data()] {
    for (std::size_t i = 0; i < count * k; i += k) {
      cancellation_point();
      for (std::size_t j = 0; j < k; ++j) {  // insertion sort: k is small
        std::size_t place = i + j;
        for (; place > i && to[place - 1] > from[i + j]; --place) {
          to[place] = to[place - 1];
          along[place] = along[place - 1];
        }
        to[place] = from[i + j];
        along[place] = beside[i + j];
      }
    }
  });
  return py::make_tuple(sorted, opposite);
}

}  // namespace

void bind_cell_maps(py::module_& module) {
  module.def("_transforms", &transforms, "points"_a, "cells"_a,
             "(maps (m, k+1, k), conditions (m,)): see Delaunay.transform; conditions in the maximum norm, "
             "NaN if singular.");
  module.def("_hyperplanes", &hyperplanes, "points"_a, "cells"_a, "heights"_a,
             "(m, k+2): downward unit normal and offset of each cell lifted to heights, (n,); NaN if it is "
             "vertical.");
  module.def("_increasing", &increasing, "cells"_a, "neighbors"_a,
             "(cells, neighbors), both (m, k): vertices in increasing order, neighbors still opposite them.");
}

}  // namespace delone::python
