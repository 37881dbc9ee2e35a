// SPDX-License-Identifier: BSD-3-Clause
#include "hull/point_sieve.hpp"

#include "base/infinity.hpp"
#include "base/progress_meter.hpp"
#include "base/random.hpp"
#include "hull/growing_flat.hpp"
#include "hull/outermost_sites.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace delone::hull {
namespace {

/// Both directions of each axis.
LinearFunctions axis_directions(std::size_t d) {
  LinearFunctions functions{std::vector<double>(d, 0.0), std::vector<double>(2 * d * d, 0.0)};
  for (std::size_t j = 0; j < d; ++j) {
    functions.normals[2 * j * d + j] = -1;
    functions.normals[(2 * j + 1) * d + j] = 1;
  }
  return functions;
}

/// The axes and, in few dimensions, the diagonals of the box, in units of its half extents; for few points
/// others, too: a larger shell saves passes.
LinearFunctions first_directions(const CenteredBox& box, std::size_t num_points) {
  constexpr std::size_t few_points = 2048, num_others = 32;
  const std::size_t d = box.center.size();
  LinearFunctions functions = axis_directions(d);
  functions.origin = box.center;
  for (std::size_t signs = 0; d <= most_axes_with_diagonals && signs < std::size_t{1} << d; ++signs)
    for (std::size_t j = 0; j < d; ++j) functions.normals.push_back((signs >> j & 1 ? 1 : -1) / box.reach[j]);
  random::Generator generator(d);
  for (std::size_t i = 0; num_points < few_points && d > 3 && i < num_others * d; ++i)
    for (std::size_t j = 0; j < d; ++j)
      functions.normals.push_back((static_cast<double>(generator.bits() >> 11) * 0x1p-52 - 1) / box.reach[j]);
  return functions;
}

/// Tilts each function by about 2^−20, in a direction of its own.
void tilt(LinearFunctions& functions, const CenteredBox& box) {
  const std::size_t d = functions.origin.size();
  for (std::size_t i = 0; i < functions.size(); ++i) {
    double* const normal = functions.normals.data() + i * d;
    double largest = 0;
    for (std::size_t j = 0; j < d; ++j) largest = std::max(largest, std::fabs(normal[j]) * box.reach[j]);
    for (std::size_t j = 0; j < d; ++j) {
      const auto bits = static_cast<std::int64_t>(random::mix(i * d + j + 1));
      normal[j] += static_cast<double>(bits) * 0x1p-63 * 0x1p-20 * largest / box.reach[j];
    }
  }
}

}  // namespace

PointSieve::PointSieve(std::span<const double> coordinates, int dimension, double relative_error,
                       unsigned threads)
    : dimension_(dimension), relative_error_(relative_error), threads_(threads), points_(coordinates) {}

std::vector<Index> PointSieve::remaining_rows() const {
  if (!rows_.empty() || points_.empty()) return rows_;
  std::vector<Index> all(num_remaining());
  std::iota(all.begin(), all.end(), Index{0});
  return all;
}

std::vector<std::size_t> PointSieve::extremes_among(std::span<const double> points, LinearFunctions functions,
                                                    bool tilted) const {
  if (tilted) tilt(functions, box_);
  std::vector<Extreme> found(functions.size(), Extreme{-internal::infinity, Extreme::nowhere});
  find_extremes(points, functions, found, threads_);
  std::vector<std::size_t> which;
  for (const Extreme& extreme : found) which.push_back(extreme.at);
  return which;
}

/// False if the box is flat, or so large or small that reciprocals are not numbers.
bool PointSieve::find_box(std::vector<std::size_t>& outermost) {
  const std::size_t d = ambient();
  std::vector<Extreme> ends(2 * d, Extreme{-internal::infinity, Extreme::nowhere});
  find_extremes(points_, axis_directions(d), ends, threads_);  // exact
  for (std::size_t j = 0; j < d; ++j) {
    const double low = -ends[2 * j].value, high = ends[2 * j + 1].value;
    const double center = low / 2 + high / 2;
    const double reach = std::max(high - center, center - low) * (1 + 0x1p-50);
    if (!(reach > 0x1p-900 && reach < 0x1p900)) return false;
    box_.center.push_back(center);
    box_.reach.push_back(reach);
    if (relative_error_ > 0)
      box_.error.push_back(1.01 * relative_error_ * (std::fabs(center) + reach) + 0x1p-1072);
  }
  outermost = extremes(first_directions(box_, num_remaining()));
  put_well_spread_first(outermost);
  return true;
}

/// The shell begins with the simplex of the first rows: with a flat one, of one rounded face perhaps, no
/// double would be inside.
void PointSieve::put_well_spread_first(std::vector<std::size_t>& which) const {
  const std::size_t d = ambient();
  std::erase(which, Extreme::nowhere);
  if (which.size() <= d) return;
  std::vector<const double*> points;
  for (const std::size_t i : which) points.push_back(points_.data() + i * d);
  GrowingFlat flat(std::move(points), dimension_);
  for (std::size_t k = 0; k < d; ++k) flat.grow();
  for (std::size_t k = 0; k < flat.basis().size(); ++k) {
    const auto i = static_cast<std::size_t>(flat.basis()[k] - points_.data()) / d;
    const auto rest = which.begin() + static_cast<std::ptrdiff_t>(k);
    if (const auto at = std::find(rest, which.end(), i); at != which.end()) std::iter_swap(rest, at);
  }
}

bool PointSieve::add_to_shell(std::span<const std::size_t> which) {
  const std::size_t d = ambient();
  std::vector<double> added;
  if (shell_ == nullptr) shell_ = std::make_unique<HullState>(dimension_);
  for (const std::size_t i : which) {
    if (i == Extreme::nowhere || !chosen_.insert(remaining_row(i)).second) continue;
    added.insert(added.end(), points_.data() + i * d, points_.data() + (i + 1) * d);
    shell_rows_.push_back(remaining_row(i));
  }
  Options in_turn;
  in_turn.order = InsertionOrder::as_given;
  if (!added.empty()) shell_->insert_range(added, in_turn);
  return shell_->affine_hull().dimension() == dimension_;
}

void PointSieve::remove(std::span<const char> is_interior) {
  const std::size_t d = ambient(), n = num_remaining();
  std::vector<double> points;
  std::vector<Index> rows;
  const auto left = static_cast<std::size_t>(std::count(is_interior.begin(), is_interior.end(), 0));
  points.reserve(left * d);
  rows.reserve(left);
  for (std::size_t i = 0; i < n; ++i) {
    if (is_interior[i] != 0) continue;
    rows.push_back(remaining_row(i));
    points.insert(points.end(), points_.data() + i * d, points_.data() + (i + 1) * d);
  }
  own_points_ = std::move(points);
  points_ = own_points_;
  rows_ = std::move(rows);
}

HullPlanes PointSieve::planes_of_shell() const {
  const SimplicialHull& hull = shell_->hull();
  std::vector<Index> cells(hull.num_cells());
  std::iota(cells.begin(), cells.end(), Index{0});
  return hull_planes(shell_->sites(), hull, cells, box_);
}

/// One pass with the planes of the shell; false if it removes too little for another one.
bool PointSieve::remove_interior(const HullPlanes& planes) {
  constexpr std::size_t least_share = 8, sample = 512;
  const std::size_t d = ambient(), n = num_remaining();
  std::vector<char> is_interior(n, 0);
  if (n > 8 * sample) {  // some rows at even distances
    std::vector<double> some;
    for (std::size_t i = 0; i < sample; ++i) {
      const double* point = points_.data() + i * (n / sample) * d;
      some.insert(some.end(), point, point + d);
    }
    find_below(some, planes.functions, planes.low, std::span(is_interior).first(sample));
    const auto found = std::count(is_interior.begin(), is_interior.begin() + sample, 1);
    if (static_cast<std::size_t>(found) < sample / least_share) return false;
  }
  find_below(points_, planes.functions, planes.low, is_interior, threads_);
  const auto removed = static_cast<std::size_t>(std::count(is_interior.begin(), is_interior.end(), 1));
  if (removed == 0) return false;
  remove(is_interior);
  return removed >= n / least_share;
}

void PointSieve::run() {
  // Below, an insertion costs no more than a pass; above, a pass costs more than it saves.
  constexpr std::size_t least_rows = 256, most_work = 1500;
  // What is inserted into shells is no part of what is done.
  const std::function<bool(double)> no_function;
  const internal::ProgressMeter meter(no_function, 1);
  std::vector<std::size_t> outermost;
  if (points_.empty() || !find_box(outermost)) return;
  if (!add_to_shell(outermost)) {
    shell_.reset();
    shell_rows_.clear();
    chosen_.clear();
    return;
  }
  for (;;) {
    internal::cancellation_point();
    HullPlanes planes = planes_of_shell();
    if (!remove_interior(planes) || num_remaining() < least_rows || planes.low.size() * ambient() > most_work)
      return;
    add_to_shell(extremes(std::move(planes.functions)));
  }
}

}  // namespace delone::hull
