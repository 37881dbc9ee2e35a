// SPDX-License-Identifier: BSD-3-Clause
// Cubic interpolation on triangles, for delone.interpolate.CloughTocher2DInterpolator: gradients of least
// curvature at the vertices, and the Clough-Tocher element. Rounded numbers; nothing combinatorial is decided
// with them.
//
// P. Alfeld, A trivariate Clough-Tocher scheme for tetrahedral data, doi:10.1016/0167-8396(84)90029-3;
// G. Farin, Triangular Bernstein-Bezier patches, doi:10.1016/0167-8396(86)90016-6;
// G. M. Nielson, A method for interpolating scattered data based upon a minimum norm network,
// doi:10.1090/S0025-5718-1983-0679444-7; R. J. Renka, A. K. Cline, A triangle-based C1 interpolation method,
// doi:10.1216/RMJ-1984-14-1-223. The direction of the cross derivatives (from centroid to centroid), the
// order of relaxation and its stopping rule are those of scipy.interpolate, Copyright (C) Pauli Virtanen,
// 2010, BSD-3-Clause, so that results agree with it.
#include "arrays.hpp"
#include "module.hpp"
#include "running.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;
using Rows = py::array_t<SignedIndex, py::array::c_style | py::array::forcecast>;
using Offsets = py::array_t<std::int64_t, py::array::c_style | py::array::forcecast>;
using Reals = py::array_t<double, py::array::c_style | py::array::forcecast>;
using Vector = std::array<double, 2>;

bool in_range(const Rows& rows, SignedIndex lowest, py::ssize_t count) {
  return std::all_of(rows.data(), rows.data() + rows.size(),
                     [&](SignedIndex row) { return row >= lowest && row < count; });
}

/// Relaxation of the network of edges: for every vertex in turn, the gradient that minimizes the sum of ∫
/// W''² over its edges, for the cubic W on each edge and the present gradients of the other ends. With the
/// edge vector e of length L, this is the solution of Q g = -s with Q = Σ 4 e eᵀ / L³ and s = Σ (6 (f - f') +
/// 2 e·g') e / L³.
class Network {
 public:
  Network(const double* points, const std::int64_t* offsets, const SignedIndex* ends, std::size_t count)
      : offsets_(offsets),
        ends_(ends),
        count_(count),
        edges_(static_cast<std::size_t>(offsets[count])),
        inverse_(count) {
    for (std::size_t p = 0; p < count; ++p) {
      double xx = 0, xy = 0, yy = 0;
      for (auto i = offsets[p]; i < offsets[p + 1]; ++i) {
        const double* const other = points + 2 * static_cast<std::size_t>(ends[i]);
        const double x = other[0] - points[2 * p], y = other[1] - points[2 * p + 1];
        const double length = std::sqrt(x * x + y * y), cubed = length * length * length;
        edges_[static_cast<std::size_t>(i)] = {{x, y}, {x / cubed, y / cubed}};
        xx += 4 * x * x / cubed;
        xy += 4 * x * y / cubed;
        yy += 4 * y * y / cubed;
      }
      const double determinant = xx * yy - xy * xy;
      inverse_[p] = {yy / determinant, xy / determinant, xx / determinant};
    }
  }

  /// Relaxes gradients, which hold 0 at first, for the values at stride `step`, at most `limit` times.
  /// Returns whether the last change was less than `tolerance`, relative to gradients above 1.
  template <class GoOn>
  bool relax(const double* values, double* gradients, std::size_t step, double tolerance, int limit,
             GoOn go_on) const {
    for (int round = 0; round < limit; ++round) {
      double error = 0;
      for (std::size_t p = 0; p < count_; ++p) {
        if (offsets_[p] == offsets_[p + 1]) continue;
        go_on();
        double* const own = gradients + 2 * step * p;
        const Vector next = gradient(p, values, gradients, step);
        const double change = std::max(std::fabs(own[0] - next[0]), std::fabs(own[1] - next[1]));
        error = std::max(error, change / std::max({1.0, std::fabs(next[0]), std::fabs(next[1])}));
        own[0] = next[0];
        own[1] = next[1];
      }
      if (error < tolerance) return true;
    }
    return false;
  }

 private:
  struct Edge {
    Vector vector, over_cube;  // e and e / L³
  };

  Vector gradient(std::size_t p, const double* values, const double* gradients, std::size_t step) const {
    Vector sum{};
    for (auto i = offsets_[p]; i < offsets_[p + 1]; ++i) {
      const Edge& edge = edges_[static_cast<std::size_t>(i)];
      const auto q = static_cast<std::size_t>(ends_[i]);
      const double* const other = gradients + 2 * step * q;
      const double factor = 6 * (values[step * p] - values[step * q]) +
                            2 * (edge.vector[0] * other[0] + edge.vector[1] * other[1]);
      sum[0] += factor * edge.over_cube[0];
      sum[1] += factor * edge.over_cube[1];
    }
    const auto& [yy, xy, xx] = inverse_[p];
    return {-(yy * sum[0] - xy * sum[1]), -(xx * sum[1] - xy * sum[0])};
  }

  const std::int64_t* offsets_;
  const SignedIndex* ends_;
  std::size_t count_;
  std::vector<Edge> edges_;
  std::vector<std::array<double, 3>> inverse_;
};

py::tuple gradients(const Reals& points, const Offsets& offsets, const Rows& ends, const Reals& values,
                    double tolerance, int limit) {
  const py::ssize_t count = points.ndim() == 2 ? points.shape(0) : -1;
  if (count < 0 || points.shape(1) != 2 || values.ndim() != 2 || values.shape(0) != count ||
      offsets.ndim() != 1 || offsets.shape(0) != count + 1 || ends.ndim() != 1 || offsets.at(0) != 0 ||
      offsets.at(count) != ends.shape(0) ||
      !std::is_sorted(offsets.data(), offsets.data() + offsets.size()) || !in_range(ends, 0, count))
    throw py::value_error("points (n, 2), offsets (n+1,), ends and values (n, c) do not fit");
  const auto columns = static_cast<std::size_t>(values.shape(1));
  py::array_t<double> result({count, values.shape(1), py::ssize_t{2}});
  std::fill_n(result.mutable_data(), result.size(), 0.0);
  bool converged = true;
  Supervisor supervisor;
  supervisor.run([&, out = result.mutable_data()] {
    const Network network(points.data(), offsets.data(), ends.data(), static_cast<std::size_t>(count));
    for (std::size_t c = 0; c < columns; ++c)
      converged &= network.relax(values.data() + c, out + 2 * c, columns, tolerance, limit,
                                 [&] { cancellation_point(); });
  });
  return py::make_tuple(result, converged);
}

double area(const double* a, const double* b, const Vector& c) {
  return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

/// The three cubics of an element. Coefficients are named by their multi-indices.
struct Cubics {
  double c3000, c0300, c0030, c2100, c2010, c1200, c0210, c1020, c0120, c2001, c0201, c0021, c0111, c1011,
      c1101, c1002, c0102, c0012, c0003;

  /// The value at barycentric coordinates b.
  double operator()(const std::array<double, 3>& b) const {
    const auto [x, y, z, m] = in_part(b);
    return x * x * x * c3000 + y * y * y * c0300 + z * z * z * c0030 + m * m * m * c0003 +
           3 * (x * x * (y * c2100 + z * c2010 + m * c2001) + y * y * (x * c1200 + z * c0210 + m * c0201) +
                z * z * (x * c1020 + y * c0120 + m * c0021) + m * m * (x * c1002 + y * c0102 + z * c0012)) +
           6 * m * (x * y * c1101 + x * z * c1011 + y * z * c0111);
  }

  /// The derivatives with respect to b.
  std::array<double, 3> derivatives(const std::array<double, 3>& b) const {
    const auto [x, y, z, m] = in_part(b);
    std::array<double, 3> result{
        3 * (x * x * c3000 + 2 * x * (y * c2100 + z * c2010 + m * c2001) + y * y * c1200 + z * z * c1020 +
             m * m * c1002 + 2 * m * (y * c1101 + z * c1011)),
        3 * (y * y * c0300 + 2 * y * (x * c1200 + z * c0210 + m * c0201) + x * x * c2100 + z * z * c0120 +
             m * m * c0102 + 2 * m * (x * c1101 + z * c0111)),
        3 * (z * z * c0030 + 2 * z * (x * c1020 + y * c0120 + m * c0021) + x * x * c2010 + y * y * c0210 +
             m * m * c0012 + 2 * m * (x * c1011 + y * c0111))};
    const double by_m =
        3 * (m * m * c0003 + 2 * m * (x * c1002 + y * c0102 + z * c0012) + x * x * c2001 + y * y * c0201 +
             z * z * c0021 + 2 * (x * y * c1101 + x * z * c1011 + y * z * c0111));
    // The least coordinate l enters as x − l, y − l, z − l and m = 3l.
    const auto least = std::min_element(b.begin(), b.end()) - b.begin();
    result[static_cast<std::size_t>(least)] += 3 * by_m - result[0] - result[1] - result[2];
    return result;
  }

 private:
  /// In the part opposite the least coordinate, that one is 0 and the centroid's 3 times the least.
  static std::array<double, 4> in_part(const std::array<double, 3>& b) {
    const double least = std::min({b[0], b[1], b[2]});
    return {b[0] - least, b[1] - least, b[2] - least, 3 * least};
  }
};

/// One triangle of the Clough-Tocher split: three cubics that meet in its centroid, the fourth vertex.
class Element {
 public:
  /// corners: of the triangle; across: of the neighbor opposite each vertex, or null.
  Element(const std::array<const double*, 3>& corners,
          const std::array<std::array<const double*, 3>, 3>& across) {
    for (int k = 0; k < 3; ++k) {
      const auto [i, j] = others(k);
      edge_[k] = {corners[j][0] - corners[i][0], corners[j][1] - corners[i][1]};
      // The gradient in the direction w = V4' - V4, from centroid to centroid, is linear along the edge: both
      // triangles agree on w, and w is affinely invariant. w is proportional to (V4 - Vi) + tilt (Vj - Vi).
      // The tilt follows from the areas that V4' spans with the edges of this triangle; areas instead of
      // barycentric coordinates, so that slivers do not divide by zero.
      tilt_[k] = -0.5;
      if (!across[k][0]) continue;
      Vector centroid;
      for (int axis = 0; axis < 2; ++axis)
        centroid[axis] = (across[k][0][axis] + across[k][1][axis] + across[k][2][axis]) / 3;
      const double own = area(corners[i], corners[j], centroid),
                   at_i = area(corners[j], corners[k], centroid),
                   at_j = area(corners[k], corners[i], centroid), divisor = 2 * own - at_i - at_j;
      if (divisor != 0) tilt_[k] = (at_j - own) / divisor;
    }
  }

  /// The cubics for values f and gradients g at the corners.
  Cubics cubics(const std::array<double, 3>& f, const std::array<const double*, 3>& g) const {
    // Edge 2 is from corner 0 to 1, edge 0 from 1 to 2, edge 1 from 2 to 0.
    const auto along = [&](int corner, int edge) {
      return (g[corner][0] * edge_[edge][0] + g[corner][1] * edge_[edge][1]) / 3;
    };
    const double c3000 = f[0], c0300 = f[1], c0030 = f[2];
    const double c2100 = f[0] + along(0, 2), c2010 = f[0] - along(0, 1), c1200 = f[1] - along(1, 2),
                 c0210 = f[1] + along(1, 0), c1020 = f[2] + along(2, 1), c0120 = f[2] - along(2, 0);
    const double c2001 = (c2100 + c2010 + c3000) / 3, c0201 = (c1200 + c0300 + c0210) / 3,
                 c0021 = (c1020 + c0120 + c0030) / 3;
    const double c0111 =
        (tilt_[0] * (-c0300 + 3 * c0210 - 3 * c0120 + c0030) + (-c0300 + 2 * c0210 - c0120 + c0021 + c0201)) /
        2;
    const double c1011 =
        (tilt_[1] * (-c0030 + 3 * c1020 - 3 * c2010 + c3000) + (-c0030 + 2 * c1020 - c2010 + c2001 + c0021)) /
        2;
    const double c1101 =
        (tilt_[2] * (-c3000 + 3 * c2100 - 3 * c1200 + c0300) + (-c3000 + 2 * c2100 - c1200 + c2001 + c0201)) /
        2;
    const double c1002 = (c1101 + c1011 + c2001) / 3, c0102 = (c1101 + c0111 + c0201) / 3,
                 c0012 = (c1011 + c0111 + c0021) / 3;
    const double c0003 = (c1002 + c0102 + c0012) / 3;
    return {c3000, c0300, c0030, c2100, c2010, c1200, c0210, c1020, c0120, c2001,
            c0201, c0021, c0111, c1011, c1101, c1002, c0102, c0012, c0003};
  }

  /// The gradient of a function of barycentric coordinates with these derivatives.
  Vector gradient(const std::array<double, 3>& derivatives) const {
    const double area = edge_[0][0] * edge_[1][1] - edge_[0][1] * edge_[1][0];
    Vector sum{};
    for (int k = 0; k < 3; ++k) {
      sum[0] -= derivatives[k] * edge_[k][1] / area;
      sum[1] += derivatives[k] * edge_[k][0] / area;
    }
    return sum;
  }

 private:
  static constexpr std::array<int, 2> others(int k) { return {(k + 1) % 3, (k + 2) % 3}; }

  std::array<Vector, 3> edge_;
  std::array<double, 3> tilt_;
};

py::array evaluate(const Reals& points, const Rows& cells, const Rows& neighbors, const Reals& values,
                   const Reals& slopes, const Rows& found, const Reals& weights, const Reals& fill,
                   bool wants_gradients) {
  if (points.ndim() != 2 || points.shape(1) != 2 || cells.ndim() != 2 || cells.shape(1) != 3 ||
      neighbors.ndim() != 2 || neighbors.shape(0) != cells.shape(0) || neighbors.shape(1) != 3 ||
      values.ndim() != 2 || values.shape(0) != points.shape(0) || slopes.size() != 2 * values.size() ||
      found.ndim() != 1 || weights.ndim() != 2 || weights.shape(0) != found.shape(0) ||
      weights.shape(1) != 3 || fill.size() != values.shape(1) * (wants_gradients ? 2 : 1) ||
      !in_range(cells, 0, points.shape(0)) || !in_range(neighbors, -1, cells.shape(0)) ||
      !in_range(found, -1, cells.shape(0)))
    throw py::value_error("the arrays of the element do not fit each other");
  const auto columns = static_cast<std::size_t>(values.shape(1)),
             count = static_cast<std::size_t>(found.shape(0));
  const std::size_t width = wants_gradients ? 2 * columns : columns;
  py::array_t<double> result({count, width});
  Supervisor supervisor;
  supervisor.run([&, out = result.mutable_data()] {
    const auto corners_of = [&, p = points.data(), c = cells.data()](SignedIndex cell) {
      const SignedIndex* const rows = c + 3 * static_cast<std::size_t>(cell);
      const auto at = [&](int i) { return p + 2 * static_cast<std::size_t>(rows[i]); };
      return std::array<const double*, 3>{at(0), at(1), at(2)};
    };
    for (std::size_t q = 0; q < count; ++q) {
      cancellation_point();
      double* const row = out + q * width;
      const SignedIndex cell = found.data()[q];
      if (cell < 0) {
        std::copy_n(fill.data(), width, row);
        continue;
      }
      const std::size_t first = 3 * static_cast<std::size_t>(cell);
      std::array<std::array<const double*, 3>, 3> across{};
      std::array<double, 3> b;
      std::array<std::size_t, 3> rows;
      for (std::size_t k = 0; k < 3; ++k) {
        if (const SignedIndex next = neighbors.data()[first + k]; next >= 0) across[k] = corners_of(next);
        b[k] = weights.data()[3 * q + k];
        rows[k] = static_cast<std::size_t>(cells.data()[first + k]) * columns;
      }
      const Element element(corners_of(cell), across);
      for (std::size_t c = 0; c < columns; ++c) {
        const double *const f = values.data() + c, *const g = slopes.data() + 2 * c;
        const Cubics cubics = element.cubics({f[rows[0]], f[rows[1]], f[rows[2]]},
                                             {g + 2 * rows[0], g + 2 * rows[1], g + 2 * rows[2]});
        if (wants_gradients) {
          const Vector gradient = element.gradient(cubics.derivatives(b));
          std::copy(gradient.begin(), gradient.end(), row + 2 * c);
        } else {
          row[c] = cubics(b);
        }
      }
    }
  });
  return result;
}

}  // namespace

void bind_clough_tocher(py::module_& module) {
  module.def("_least_curvature_gradients", &gradients, "points"_a, "offsets"_a, "ends"_a, "values"_a,
             "tolerance"_a, "limit"_a,
             "(gradients (n, c, 2), whether they converged): see "
             "delone.interpolate.CloughTocher2DInterpolator. The ends of the "
             "edges at point p are ends[offsets[p]:offsets[p+1]].");
  module.def("_clough_tocher", &evaluate, "points"_a, "cells"_a, "neighbors"_a, "values"_a, "gradients"_a,
             "found"_a, "weights"_a, "fill"_a, "wants_gradients"_a = false,
             "(q, c): the cubic at barycentric coordinates, (q, 3), in triangles, (q,); fill, (c,), in "
             "triangle -1. Or its gradients, with two numbers in place of each.");
}

}  // namespace delone::python
