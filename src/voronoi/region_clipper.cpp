// SPDX-License-Identifier: BSD-3-Clause
// Cutting a simple polytope by a hyperplane is the insertion of a point into the dual complex. Corners are
// its cells, planes its vertices, and neighbor i of a corner is across the edge that leaves plane i. The
// corners beyond the plane are connected. Every edge from one of them to a corner that stays gets a new
// corner, and new corners that share all but one of their planes are neighbors.
//
// Perturbation. Plane m moves outward by ε_m, with ε_0 ≫ ε_1 ≫ …. With A·y = b + ε at a corner, plane m
// compares
//     b_m + ε_m − a_m·A⁻¹(b + ε) = (b_m − a_m·A⁻¹b) − Σ_i (a_m·A⁻¹)_i·ε_i + ε_m
// with zero. So on a tie the first plane i of the corner, in the order of planes, with (a_m·A⁻¹)_i ≠ 0
// decides; if there were none, ε_m would. Planes cut in the order of their numbers, so m is larger than the
// numbers of the corner's planes.
#include "voronoi/region_clipper.hpp"

#include "base/progress_meter.hpp"
#include "kernel/grid.hpp"
#include "voronoi/clipper_limits.hpp"
#include "voronoi/roundoff.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

namespace delone::voronoi {

using namespace clipper_limits;

void require_container(const Box& box, std::span<const double> halfspaces, int dimension) {
  const auto d = static_cast<std::size_t>(dimension);
  const auto wrong = [](const std::string& what) { throw Error(Errc::invalid_argument, what); };
  if (box.low.size() != d || box.high.size() != d)
    wrong("the box has not as many coordinates as the space, " + std::to_string(dimension));
  for (std::size_t j = 0; j < d; ++j)
    if (!std::isfinite(box.low[j]) || !std::isfinite(box.high[j]) || !(box.low[j] < box.high[j]))
      wrong("the box must have finite limits, low below high, along axis " + std::to_string(j));
  constexpr int largest_dimension = 12;  // 2^d corners of the box
  if (dimension > largest_dimension)
    throw Error(Errc::unsupported,
                "clipping to a box is available up to dimension " + std::to_string(largest_dimension));
  if (halfspaces.size() % (d + 1) != 0) wrong("halfspaces are rows of " + std::to_string(d + 1) + " numbers");
  for (std::size_t i = 0; i < halfspaces.size(); i += d + 1) {
    const auto row = halfspaces.subspan(i, d + 1);
    if (!std::all_of(row.begin(), row.end(), [](double x) { return std::isfinite(x); }) ||
        std::all_of(row.begin(), row.end() - 1, [](double x) { return x == 0; }))
      wrong("halfspace " + std::to_string(i / (d + 1)) + " needs finite numbers and a normal that is not 0");
  }
}

RegionClipper::RegionClipper(const Box& box, bool furthest, std::span<const double> halfspaces)
    : d_(box.low.size()), box_(box), furthest_(furthest), halfspaces_(halfspaces) {
  is_moderate_ = true;
  for (std::size_t j = 0; j < d_; ++j) {
    const double side = box.high[j] / 2 - box.low[j] / 2;
    extent_ = std::max(extent_, 2 * side);
    is_moderate_ = is_moderate_ && side > least_extent && side < largest_extent;
  }
  is_moderate_ = is_moderate_ && has_moderate_sides();
  matrix_.resize(d_ * d_);
  work_.resize(d_ * d_);
  inverse_.resize(d_ * d_);
  right_.resize(d_);
  scales_.resize(d_);
}

void RegionClipper::clip(const Site& site, std::span<const Site> others) {
  site_ = site;
  others_ = others;
  has_grid_ = has_ties_ = false;
  make_box();
  make_halfspaces();
  make_bisectors(others);
  for (std::size_t plane = 2 * d_; plane < planes_.size(); ++plane) cut(plane);
}

void RegionClipper::make_box() {
  planes_.assign(2 * d_, {});
  for (std::size_t j = 0; j < d_; ++j) {
    Plane &low = planes_[2 * j], &high = planes_[2 * j + 1];
    low.a.assign(d_, 0.0);
    high.a.assign(d_, 0.0);
    low.a[j] = -1;
    high.a[j] = 1;
    low.b = site_.point[j] - box_.low[j];
    high.b = box_.high[j] - site_.point[j];
    low.b_error = u * std::abs(low.b);
    high.b_error = u * std::abs(high.b);
  }
  const std::size_t corners = std::size_t{1} << d_;
  planes_of_.resize(corners * d_);
  neighbors_.resize(corners * d_);
  positions_.resize(corners * d_);
  radii_.assign(corners, 0.0);
  alive_.assign(corners, 1);
  beyond_.assign(corners, 0);
  free_.clear();
  for (Corner c = 0; c < corners; ++c)
    for (std::size_t j = 0; j < d_; ++j) {
      const bool is_high = (c >> j & 1) != 0;
      planes_of(c)[j] = 2 * j + (is_high ? 1 : 0);
      neighbors(c)[j] = c ^ (std::size_t{1} << j);
      position(c)[j] = is_high ? planes_[2 * j + 1].b : -planes_[2 * j].b;
      radii_[c] = std::max(radii_[c], 1.01 * planes_[planes_of(c)[j]].b_error);
    }
}

/// a·x + c ≤ 0 gives a·y ≤ −c − a·site. Products and partial sums are off by u each.
void RegionClipper::make_halfspaces() {
  for (std::size_t plane = 2 * d_; plane < num_fixed_planes(); ++plane) {
    const double* const row = halfspace(plane);
    Plane& made = planes_.emplace_back();
    made.a.assign(row, row + d_);
    made.b = -row[d_];
    double magnitude = std::abs(made.b);
    for (std::size_t j = 0; j < d_; ++j) {
      const double product = row[j] * site_.point[j];
      made.b -= product;
      magnitude += std::abs(product);
    }
    made.b_error = 1.01 * static_cast<double>(d_ + 1) * u * magnitude + underflow;
  }
}

/// Half the difference of the powers of x with respect to the sites s and t gives
/// (t − s)·y ≤ (|t − s|² − (w_t − w_s))/2, for furthest sites (s − t)·y ≤ −|t − s|²/2. The bisectors that
/// leave least on the side of the site come first, which keeps the polytope small.
void RegionClipper::make_bisectors(std::span<const Site> others) {
  std::vector<double> distances(others.size());
  std::vector<Plane> made(others.size());
  for (std::size_t o = 0; o < others.size(); ++o) {
    Plane& plane = made[o];
    double square = 0;
    for (std::size_t j = 0; j < d_; ++j) {
      plane.a.push_back(others[o].point[j] - site_.point[j]);
      square += plane.a.back() * plane.a.back();
    }
    const double weights = others[o].weight - site_.weight;
    plane.b = (square - weights) / 2;
    // A square is off by 3u, their sum by another d·u, and both differences by u each.
    plane.b_error = 1.01 * static_cast<double>(d_ + 4) * u * (square + std::abs(weights)) + underflow;
    if (furthest_) {
      for (double& x : plane.a) x = -x;
      plane.b = -plane.b;
    }
    distances[o] = plane.b / std::sqrt(square);
  }
  order_.resize(others.size());
  std::iota(order_.begin(), order_.end(), std::size_t{0});
  std::stable_sort(order_.begin(), order_.end(),
                   [&](std::size_t a, std::size_t b) { return distances[a] < distances[b]; });
  other_of_plane_.assign(num_fixed_planes(), 0);
  for (const std::size_t o : order_) {
    planes_.push_back(std::move(made[o]));
    other_of_plane_.push_back(o);
  }
}

/// The errors of both vectors give |a·y − ã·ỹ| ≤ Σ|a_j|·(r + u|y_j|). On top come d + 1 roundings of partial
/// sums of at most |b| + Σ|a_j||y_j|.
int RegionClipper::certain_side(const double* y, double radius, std::size_t plane) const {
  const Plane& p = planes_[plane];
  double value = p.b, magnitude = std::abs(p.b), size = 0;
  for (std::size_t j = 0; j < d_; ++j) {
    const double product = p.a[j] * y[j];
    value -= product;
    magnitude += std::abs(product);
    size += std::abs(p.a[j]);
  }
  const double bound =
      1.01 * (size * radius + static_cast<double>(d_ + 3) * u * magnitude + p.b_error) + underflow;
  if (!is_moderate_ || !(magnitude < largest_extent * largest_extent)) return 0;
  return value < -bound ? 1 : value > bound ? -1 : 0;
}

bool RegionClipper::is_beyond(Corner corner, std::size_t plane) {
  const int side = certain_side(position(corner), radii_[corner], plane);
  return side == 0 ? is_beyond_exactly(corner, plane) : side > 0;
}

const std::vector<kernel::Integer>& RegionClipper::exact_plane(std::size_t plane) {
  if (!has_grid_) {  // all coordinates are multiples of 2^grid, all weights of 2^(2·grid)
    grid_ = std::numeric_limits<int>::max();
    const auto include = [&](double x) { grid_ = std::min(grid_, kernel::trailing_exponent(x)); };
    const auto include_site = [&](const Site& site) {
      for (std::size_t j = 0; j < d_; ++j) include(site.point[j]);
      grid_ = std::min(grid_, kernel::square_exponent(site.weight));
    };
    include_site(site_);
    for (const Site& other : others_) include_site(other);
    for (std::size_t j = 0; j < d_; ++j) {
      include(box_.low[j]);
      include(box_.high[j]);
    }
    has_grid_ = true;
  }
  Plane& p = planes_[plane];
  if (!p.exact.empty()) return p.exact;
  const auto integer = [&](double x) { return kernel::scaled_integer(x, grid_); };
  if (plane < 2 * d_) {
    const std::size_t axis = plane / 2;
    const bool is_high = plane % 2 == 1;
    p.exact.assign(d_ + 1, kernel::Integer(0));
    p.exact[axis] = is_high ? 1 : -1;
    p.exact[d_] = is_high ? integer(box_.high[axis]) - integer(site_.point[axis])
                          : integer(site_.point[axis]) - integer(box_.low[axis]);
    return p.exact;
  }
  if (plane < num_fixed_planes()) {
    const double* const row = halfspace(plane);
    int grid = row[d_] == 0 ? std::numeric_limits<int>::max() : kernel::trailing_exponent(row[d_]) - grid_;
    for (std::size_t j = 0; j < d_; ++j) grid = std::min(grid, kernel::trailing_exponent(row[j]));
    kernel::Integer bound = -kernel::scaled_integer(row[d_], grid + grid_);
    for (std::size_t j = 0; j < d_; ++j) {
      p.exact.push_back(kernel::scaled_integer(row[j], grid));
      bound -= p.exact.back() * integer(site_.point[j]);
    }
    p.exact.push_back(std::move(bound));
    return p.exact;
  }
  const Site& other = others_[other_of_plane_[plane]];
  kernel::Integer square = 0;
  for (std::size_t j = 0; j < d_; ++j) {
    kernel::Integer difference = integer(other.point[j]) - integer(site_.point[j]);
    square += difference * difference;
    p.exact.push_back(difference * 2);
  }
  if (other.weight != site_.weight)
    square -=
        kernel::scaled_integer(other.weight, 2 * grid_) - kernel::scaled_integer(site_.weight, 2 * grid_);
  p.exact.push_back(std::move(square));
  if (furthest_)
    for (kernel::Integer& x : p.exact) x = -x;
  return p.exact;
}

bool RegionClipper::is_beyond_exactly(Corner corner, std::size_t plane) {
  std::vector<std::size_t> through(planes_of(corner), planes_of(corner) + d_);
  std::sort(through.begin(), through.end());
  std::vector<kernel::Integer> normals, bordered;
  for (const std::size_t p : through) {
    const auto& row = exact_plane(p);
    normals.insert(normals.end(), row.begin(), row.end() - 1);
    bordered.insert(bordered.end(), row.begin(), row.end());
  }
  const auto& row = exact_plane(plane);
  bordered.insert(bordered.end(), row.begin(), row.end());
  // det [A b; a_m b_m] = det A · (b_m − a_m·A⁻¹b)
  const bool is_negative = kernel::exact_determinant(normals, d_) < 0;
  const kernel::Integer value = kernel::exact_determinant(std::move(bordered), d_ + 1);
  if (value != 0) return (value < 0) != is_negative;
  has_ties_ = true;
  for (std::size_t i = 0; i < d_; ++i) {  // (a_m·A⁻¹)_i = det(A with row i replaced by a_m) / det A
    std::vector<kernel::Integer> replaced = normals;
    std::copy(row.begin(), row.end() - 1, replaced.begin() + static_cast<std::ptrdiff_t>(i * d_));
    const kernel::Integer coefficient = kernel::exact_determinant(std::move(replaced), d_);
    if (coefficient != 0) return (coefficient > 0) != is_negative;
  }
  return false;
}

RegionClipper::Corner RegionClipper::new_corner() {
  if (!free_.empty()) {
    const Corner c = free_.back();
    free_.pop_back();
    alive_[c] = 1;
    beyond_[c] = 0;
    return c;
  }
  const Corner c = alive_.size();
  planes_of_.resize(planes_of_.size() + d_);
  neighbors_.resize(neighbors_.size() + d_);
  positions_.resize(positions_.size() + d_);
  radii_.push_back(0);
  alive_.push_back(1);
  beyond_.push_back(0);
  return c;
}

void RegionClipper::cut(std::size_t plane) {
  internal::cancellation_point();
  bool any = false;
  for (Corner c = 0; c < alive_.size(); ++c) {
    beyond_[c] = alive_[c] != 0 && is_beyond(c, plane) ? 1 : 0;
    any = any || beyond_[c] != 0;
  }
  if (!any) return;
  struct Edge {
    Corner kept;
    std::size_t slot;  // of the neighbor that is beyond
  };
  std::vector<Edge> horizon;
  for (Corner c = 0; c < alive_.size(); ++c)
    if (alive_[c] != 0 && beyond_[c] == 0)
      for (std::size_t i = 0; i < d_; ++i)
        if (beyond_[neighbors(c)[i]] != 0) horizon.push_back({c, i});
  fresh_.clear();
  for (const auto& [kept, slot] : horizon) {
    const Corner fresh = new_corner();
    fresh_.push_back(fresh);
    std::copy_n(planes_of(kept), d_, planes_of(fresh));
    planes_of(fresh)[slot] = plane;
    neighbors(fresh)[slot] = kept;
    neighbors(kept)[slot] = fresh;
    find_coordinates(fresh);
  }
  for (Corner c = 0; c < alive_.size(); ++c)
    if (beyond_[c] != 0) {
      alive_[c] = beyond_[c] = 0;
      free_.push_back(c);
    }
  link_new_corners(plane);
}

/// Each set of d − 1 planes that includes the new one belongs to two new corners, which are neighbors.
void RegionClipper::link_new_corners(std::size_t plane) {
  if (d_ == 1) return;
  struct Edge {
    std::size_t key;  // the position of its d − 2 other planes, sorted, in `keys`
    Corner corner;
    std::size_t slot;
  };
  const std::size_t width = d_ - 2;
  std::vector<std::size_t> keys;
  std::vector<Edge> edges;
  for (const Corner c : fresh_)
    for (std::size_t i = 0; i < d_; ++i) {
      if (planes_of(c)[i] == plane) continue;
      edges.push_back({keys.size(), c, i});
      for (std::size_t j = 0; j < d_; ++j)
        if (j != i && planes_of(c)[j] != plane) keys.push_back(planes_of(c)[j]);
      std::sort(keys.end() - static_cast<std::ptrdiff_t>(width), keys.end());
    }
  std::sort(edges.begin(), edges.end(), [&](const Edge& a, const Edge& b) {
    const std::size_t *x = keys.data() + a.key, *y = keys.data() + b.key;
    return std::lexicographical_compare(x, x + width, y, y + width);
  });
  for (std::size_t e = 0; e + 1 < edges.size(); e += 2) {
    neighbors(edges[e].corner)[edges[e].slot] = edges[e + 1].corner;
    neighbors(edges[e + 1].corner)[edges[e + 1].slot] = edges[e].corner;
  }
}

double RegionClipper::volume() {
  if (is_far()) return measures_from_a_corner().volume;
  if (const std::vector<int> exponents = exponents_of_extents(); !exponents.empty())
    return measures_by_axis(exponents).volume;
  if (d_ >= 4 && is_moderate_)
    if (const auto volume = volume_by_faces()) return *volume;
  polytope_.start(d_, d_);
  for (Corner c = 0; c < alive_.size(); ++c)
    if (alive_[c] != 0) polytope_.add_corner(position(c), {planes_of(c), d_});
  return polytope_.volume();
}

/// The region and its planes are labels: the site is the origin, and the points of planes are their normals.
std::optional<double> RegionClipper::volume_by_faces() {
  const double scale = std::ldexp(1.0, -std::ilogb(extent_) - 1);
  std::vector<double> points(d_, 0.0), x(d_);
  for (const Plane& plane : planes_) {
    double largest = 0;
    for (const double a : plane.a) largest = std::max(largest, std::abs(a));
    const double unit = std::ldexp(1.0, -std::ilogb(largest));
    for (const double a : plane.a) points.push_back(a * unit);
  }
  FaceVolumes faces(d_, d_);
  faces.set_points(points);
  std::vector<Index> labels;
  for (Corner c = 0; c < alive_.size(); ++c) {
    if (alive_[c] == 0) continue;
    labels.assign(1, 0);
    for (std::size_t i = 0; i < d_; ++i) labels.push_back(static_cast<Index>(planes_of(c)[i] + 1));
    std::sort(labels.begin(), labels.end());
    for (std::size_t j = 0; j < d_; ++j) x[j] = position(c)[j] * scale;
    faces.add_corner(x, radii_[c] * scale, labels);
  }
  std::vector<unsigned char> wanted(planes_.size() + 1, 0);
  wanted[0] = 1;
  std::optional<double> volume;
  faces.measure(1, wanted, [&](const FaceVolumes::Face& face) {
    constexpr double least_volume = 1e-120;  // smaller ones may have lost digits to underflow
    if (face.is_accurate && face.volume > least_volume) volume = face.volume;
  });
  for (std::size_t i = 0; i < d_ && volume; ++i) *volume /= scale;
  return volume;
}

std::vector<RegionClipper::Corner> RegionClipper::corners() const {
  std::vector<Corner> result;
  for (Corner c = 0; c < alive_.size(); ++c)
    if (alive_[c] != 0) result.push_back(c);
  return result;
}

/// Whether the way around a plane, from a corner along the plane `along` away from the plane `leaves`, is
/// counterclockwise seen from outside: whether the outward normal of `along` is on its right. With normals F,
/// G of the two and H of the last the way is t = −sign(det(F, G, H))·F×G, as t·H < 0, and then G·(t×F) has
/// the sign of −det(F, G, H). In the plane there is no F, and det(G, H) in place of that.
bool RegionClipper::is_counterclockwise(std::size_t plane, std::size_t along, std::size_t leaves) {
  std::vector<kernel::Integer> normals;
  const auto append = [&](std::size_t p) {
    const auto& row = exact_plane(p);
    normals.insert(normals.end(), row.begin(), row.end() - 1);
  };
  if (d_ == 3) append(plane);
  append(along);
  append(leaves);
  return kernel::exact_determinant(std::move(normals), d_) < 0;
}

/// The corners on a plane in the order of its polygon, counterclockwise; for d = 2, all corners.
std::vector<Index> RegionClipper::cycle(std::size_t plane, const std::vector<Index>& number,
                                        const std::vector<Corner>& corners) {
  const auto is_around = [&](std::size_t p) { return d_ == 3 && p == plane; };
  const auto start =
      std::find_if(corners.begin(), corners.end(), [&](Corner c) { return d_ == 2 || is_on(c, plane); });
  std::vector<Index> face;
  if (start == corners.end()) return face;
  std::size_t slots[2], count = 0;  // of the two ways from the first corner
  for (std::size_t i = 0; i < d_; ++i)
    if (!is_around(planes_of(*start)[i])) slots[count++] = i;
  const std::size_t first = planes_of(*start)[slots[0]], second = planes_of(*start)[slots[1]];
  Corner at = *start, next = neighbors(at)[is_counterclockwise(plane, second, first) ? slots[0] : slots[1]];
  do {
    if (face.empty() || face.back() != number[at]) face.push_back(number[at]);
    const Corner before = std::exchange(at, next);
    for (std::size_t i = 0; i < d_; ++i)
      if (!is_around(planes_of(at)[i]) && neighbors(at)[i] != before) next = neighbors(at)[i];
  } while (at != *start);
  while (face.size() > 1 && face.front() == face.back()) face.pop_back();
  return face;
}

std::vector<Index> RegionClipper::ordered_facet(std::size_t plane, const std::vector<Index>& number) {
  const std::vector<Corner> all = corners();
  if (d_ == 3) return cycle(plane, number, all);
  std::vector<Index> ends;
  bool is_reversed = false;
  for (const Corner c : all)
    if (is_on(c, plane)) {
      const std::size_t other = planes_of(c)[planes_of(c)[0] == plane ? 1 : 0];
      if (ends.empty()) is_reversed = !is_counterclockwise(plane, plane, other);
      ends.push_back(number[c]);
    }
  if (is_reversed) std::swap(ends.front(), ends.back());
  return ends;
}

std::vector<std::vector<Index>> RegionClipper::faces(const std::vector<Index>& number) {
  const std::vector<Corner> all = corners();
  std::vector<std::vector<Index>> result;
  for (std::size_t plane = 0; plane < (d_ == 2 ? 1 : planes_.size()); ++plane)
    if (std::vector<Index> face = cycle(plane, number, all); face.size() > 2)
      result.push_back(std::move(face));
  return result;
}

std::vector<RegionClipper::Corner> RegionClipper::number_corners(std::vector<Index>& number) {
  // After a tie several corners may coincide. Correctly rounded, they become equal.
  std::vector<Corner> sorted = corners();
  if (has_ties_)
    for (const Corner c : sorted) find_coordinates_exactly(c);
  const auto less = [&](Corner a, Corner b) {
    return std::lexicographical_compare(position(a), position(a) + d_, position(b), position(b) + d_);
  };
  std::sort(sorted.begin(), sorted.end(), less);
  number.assign(alive_.size(), invalid_index);
  Index count = 0;
  for (std::size_t i = 0; i < sorted.size(); ++i)
    number[sorted[i]] = i > 0 && !less(sorted[i - 1], sorted[i]) ? count - 1 : count++;
  return sorted;
}

ClippedRegion RegionClipper::geometry() {
  ClippedRegion region;
  std::vector<Index> number;
  Index count = 0;
  for (const Corner c : number_corners(number)) {
    if (number[c] != count) continue;
    ++count;
    for (std::size_t j = 0; j < d_; ++j)
      region.corners.push_back(std::clamp(position(c)[j] + site_.point[j], box_.low[j], box_.high[j]));
  }
  if (d_ == 1 && count == 2) region.faces = {{0, 1}};
  if (d_ > 1) region.faces = faces(number);
  if (region.faces.size() < (d_ == 3 ? 4 : 1)) return {};
  return region;
}

}  // namespace delone::voronoi
