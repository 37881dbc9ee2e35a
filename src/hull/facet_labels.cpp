// SPDX-License-Identifier: BSD-3-Clause
#include "hull/facet_labels.hpp"

#include "base/progress_meter.hpp"
#include "hull/flat_distance.hpp"
#include "hull/hull_measure.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace delone::hull {

namespace {

class Labels {
 public:
  Labels(const BoundarySites& sites, const SimplicialHull& hull, double tolerance)
      : sites_(sites),
        hull_(hull),
        near_(sites.ambient, hull.dimension, tolerance),
        label_(hull.num_cells(), invalid_index),
        sizes_(hull.num_cells()) {
    double largest = 0;
    for (const double x : sites.coordinates) largest = std::max(largest, std::fabs(x));
    if (largest > 0) exponent_ = -std::ilogb(largest);
  }

  /// The seed of each cell's facet. Cells that cannot grow are no work: they are facets of their own, unless
  /// a larger one has reached them.
  std::vector<Index> seed_of_cells() {
    const std::size_t m = hull_.num_cells();
    std::vector<Index> growing;
    for (std::size_t c = 0; c < m && hull_.dimension > 1; ++c)
      if (can_grow(static_cast<Index>(c))) growing.push_back(static_cast<Index>(c));
    put_in_order(growing);
    for (const Index c : growing)
      if (label_[c] == invalid_index) grow(c);
    for (std::size_t c = 0; c < m; ++c)
      if (label_[c] == invalid_index) label_[c] = static_cast<Index>(c);
    return std::move(label_);
  }

 private:
  void set_plane(Index c) {
    points_.clear();
    for (const Index site : hull_.cell(c)) points_.push_back(sites_.point(site));
    near_.set(points_);
  }
  /// Whether all vertices of a cell are near the plane of the seed.
  bool is_near(Index cell, Index seed) {
    const auto corners = hull_.cell(seed);
    const auto vertices = hull_.cell(cell);
    return std::all_of(vertices.begin(), vertices.end(), [&](Index v) {
      return std::find(corners.begin(), corners.end(), v) != corners.end() || near_.contains(sites_.point(v));
    });
  }
  bool can_grow(Index c) {
    set_plane(c);
    const auto neighbors = hull_.neighbors_of(c);
    return std::any_of(neighbors.begin(), neighbors.end(), [&](Index n) { return is_near(n, c); });
  }

  bool is_before(const double* a, const double* b) const {
    return std::lexicographical_compare(a, a + sites_.ambient, b, b + sites_.ambient);
  }
  auto before() const {
    return [this](const double* a, const double* b) { return is_before(a, b); };
  }
  /// What decides which of two cells begins a facet first.
  struct Size {
    double content = -1;  // not yet known
    std::vector<const double*> points;
  };
  const Size& size_of(Index c) {
    Size& size = sizes_[c];
    if (size.content >= 0) return size;
    size.points.clear();
    for (const Index site : hull_.cell(c)) size.points.push_back(sites_.point(site));
    std::sort(size.points.begin(), size.points.end(), before());
    // Scaled, so that products of lengths are in the range of doubles.
    const auto d = static_cast<std::size_t>(sites_.ambient);
    std::vector<double>& coordinates = scaled_coordinates_;
    coordinates.clear();
    const double scale = std::ldexp(1.0, exponent_);
    const bool has_scale = scale > 0 && scale <= std::numeric_limits<double>::max();
    for (const double* const p : size.points)
      for (std::size_t j = 0; j < d; ++j)
        coordinates.push_back(has_scale ? p[j] * scale : std::ldexp(p[j], exponent_));
    scaled_.clear();
    for (std::size_t i = 0; i < size.points.size(); ++i) scaled_.push_back(&coordinates[i * d]);
    size.content = simplex_volume(scaled_, sites_.ambient).value;
    return size;
  }
  bool precedes(Index c, Index other) {
    const Size &a = size_of(c), &b = size_of(other);
    if (a.content != b.content) return a.content > b.content;
    return std::lexicographical_compare(a.points.begin(), a.points.end(), b.points.begin(), b.points.end(),
                                        before());
  }
  void put_in_order(std::vector<Index>& cells) {
    std::sort(cells.begin(), cells.end(), [this](Index a, Index b) { return precedes(a, b); });
  }

  void grow(Index seed) {
    set_plane(seed);
    label_[seed] = seed;
    std::vector<Index> facet{seed};
    for (std::size_t next = 0; next < facet.size(); ++next) {
      internal::cancellation_point();
      for (const Index across : hull_.neighbors_of(facet[next]))
        if (label_[across] == invalid_index && is_near(across, seed) && !precedes(across, seed)) {
          label_[across] = seed;
          facet.push_back(across);
        }
    }
  }

  const BoundarySites& sites_;
  const SimplicialHull& hull_;
  NearFlat near_;
  std::vector<Index> label_;
  std::vector<const double*> points_;
  std::vector<Size> sizes_;  // by cell
  std::vector<double> scaled_coordinates_;
  std::vector<const double*> scaled_;
  int exponent_ = 0;  // of the power of two that makes the coordinates less than 2
};

}  // namespace

PolytopeFaces label_facets(const BoundarySites& sites, const SimplicialHull& hull, double tolerance) {
  PolytopeFaces faces;
  faces.is_extreme.assign(sites.size(), 0);
  for (const Index site : hull.cells) faces.is_extreme[site] = 1;
  std::vector<Index> seeds;
  if (hull.num_cells() > 0) seeds = Labels(sites, hull, tolerance).seed_of_cells();
  std::vector<Index> number(seeds.size(), invalid_index);  // by seed
  for (const Index seed : seeds) {
    if (number[seed] == invalid_index) {
      number[seed] = static_cast<Index>(faces.seeds.size());
      faces.seeds.push_back(seed);
    }
    faces.facet_of_cell.push_back(number[seed]);
  }
  list_cells_of_facets(faces, faces.seeds.size());
  return faces;
}

}  // namespace delone::hull
