// SPDX-License-Identifier: BSD-3-Clause
#include "forecast/model/cost.hpp"

#include "engine/wrap/is_worth_wrapping.hpp"
#include "forecast/model/cell_counts.hpp"

#include <algorithm>
#include <cmath>

namespace delone::cost_model {
namespace {

constexpr int largest_measured = 8;

template <std::size_t N>
double polynomial(const std::array<double, N>& c, double x) {
  double value = 0;
  for (std::size_t i = N; i-- > 0;) value = value * x + c[i];
  return value;
}

std::array<double, 4> first_four(const Curve& curve) {
  return {curve.cells[0], curve.cells[1], curve.cells[2], curve.cells[3]};
}

double finite_cells(const Curve& curve, double v, double hull_volume) {
  const int k = curve.affine_dimension;
  if (v <= k + 1) return v == k + 1 ? 1 : 0;
  const double s = std::pow(v, -1.0 / k), log_v = std::log(v);
  switch (curve.growth) {
    case Growth::line:
      return v - 1;
    case Growth::moment:
      return moment_curve_cells(k, v);
    case Growth::spread:
      return v * poisson_cells_per_point(k) * std::exp(s * polynomial(first_four(curve), s));
    case Growth::lattice:
      return factorial(k) * hull_volume * std::exp(polynomial(first_four(curve), s));
    case Growth::free:
      break;
  }
  double ratio = polynomial(first_four(curve), std::min(log_v, std::log(curve.last)));
  if (v > curve.last) ratio += curve.cells[4] * k * (1 - std::pow(v / curve.last, -1.0 / k));
  return v * std::exp(ratio);
}

/// What arrays take beyond their entries, as memory comes in large pages.
constexpr double page_bytes = 2.5e6;

/// Bytes per row and vertex: coordinates in the order of insertion, ids, images of the points for geometry.
double bytes_of_points(int d, double points, double vertices) {
  return points * (8.0 * d + 8) + vertices * 12;
}

}  // namespace

Cost cost_of(const Curve& curve, int d, double points, double vertices, double hull_volume) {
  Cost cost;
  cost.affine_dimension = curve.affine_dimension;
  cost.vertices = vertices;
  if (curve.growth == Growth::lattice && hull_volume == 0) {
    const LatticeHull hull = lattice_hull(d, vertices, grid_side(d, vertices));
    cost.affine_dimension = hull.affine_dimension;
    hull_volume = hull.volume;
  }
  // So few points span less: they are one simplex in their flat.
  if (vertices < cost.affine_dimension + 1)
    cost.affine_dimension = std::max(static_cast<int>(vertices), 1) - 1;
  const int k = cost.affine_dimension;
  if (vertices <= 1) {
    cost.affine_dimension = vertices < 1 ? -1 : 0;
    cost.cells = cost.infinite_cells = vertices < 1 ? 0 : 1;
    cost.bytes = bytes_of_points(d, points, vertices);
    return cost;
  }
  Curve used = curve;
  used.affine_dimension = k;
  const double most = most_cells(k, vertices);
  cost.cells = std::min(finite_cells(used, vertices, hull_volume), std::max(most - 1, 1.0));
  const double s = std::pow(vertices, -1.0 / k);
  cost.infinite_cells = std::min(cost.cells * std::exp(polynomial(curve.infinite, std::log(vertices))),
                                 std::max(most - cost.cells, k + 1.0));
  const double all = cost.cells + cost.infinite_cells;
  // The polynomial was fitted to what was measured.
  const double least_s = std::pow(std::max(vertices, curve.first), -1.0 / k);
  cost.created_cells = std::max(cost.cells * std::exp(polynomial(curve.created, std::min(s, least_s))), all);
  const bool is_wrapped = curve.wrapping_nanoseconds > 0 && is_worth_wrapping(k, points);
  const double points_seconds = 1e-9 * points * 60;  // to order them, and to meet duplicates
  if (is_wrapped) {
    cost.created_cells = all;
    cost.seconds = points_seconds + 1e-9 * curve.wrapping_nanoseconds * all;
    cost.bytes = curve.wrapping_bytes * all;
  } else {
    const double slower = std::pow(vertices / curve.last, curve.slowdown);
    cost.seconds = points_seconds + 1e-9 * curve.nanoseconds * slower * cost.created_cells;
    cost.bytes = curve.bytes * all;
  }
  cost.bytes += std::min(cost.bytes, page_bytes) + bytes_of_points(d, points, vertices);
  return cost;
}

const Curve* find_curve(std::string_view kind, int dimension) {
  const auto all = curves();
  const auto found = std::find_if(all.begin(), all.end(), [&](const Curve& curve) {
    return curve.dimension == dimension && curve.kind == kind;
  });
  return found == all.end() ? nullptr : &*found;
}

Curve curve_of_spread(int dimension) {
  if (const Curve* const curve = find_curve("uniform", dimension)) return *curve;
  // What inserting a point costs beyond its cells has been seen up to here; sizes of cells go on growing.
  Curve curve = *find_curve("uniform", largest_measured);
  curve.bytes *= static_cast<double>(dimension) / largest_measured;
  curve.nanoseconds *= static_cast<double>(dimension) / largest_measured;
  curve.wrapping_nanoseconds = curve.wrapping_bytes = 0;
  curve.dimension = curve.affine_dimension = dimension;
  return curve;
}

Cost cost_of_spread(int d, double points, double speed) {
  Cost cost = cost_of(curve_of_spread(d), d, points, points);
  cost.seconds /= speed;
  return cost;
}

bool is_worth_wrapping(int k, double points) {
  return engine::is_worth_wrapping(k, static_cast<std::size_t>(std::min(points, 1e9)));
}

double distinct_points(std::string_view kind, int d, double n) {
  const auto drawn_from = [&](double different) { return -different * std::expm1(-n / different); };
  if (kind == "equal") return std::min(n, 1.0);
  if (kind == "duplicates") return drawn_from(std::floor(n / 4) + 1);
  if (kind == "sphere" && d == 1) return std::min(n, 2.0);
  if (kind == "cube01") return std::min(n, std::pow(2.0, d));
  if (kind == "offset" && d == 1) return drawn_from(1e6);
  return n;
}

}  // namespace delone::cost_model
