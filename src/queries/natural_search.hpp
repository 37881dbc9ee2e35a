// SPDX-License-Identifier: BSD-3-Clause
// The natural neighbors of one point after the other, with their coordinates of Sibson and the gradients of
// these.
#pragma once

#include "base/stamped_table.hpp"
#include "queries/dual_volumes.hpp"
#include "solve/cell_center.hpp"
#include "triangulation/stored_points.hpp"

#include <delone/triangulation.hpp>

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

namespace delone::queries {

/// No coordinate is off by more, in a flat of dimension k.
constexpr double largest_natural_error(std::size_t k) { return k <= 3 ? 0x1p-36 : 0x1p-30; }

/// What all searches in one triangulation share.
class NaturalCenters {
 public:
  /// `stored`: the centers of all finite cells are computed now, d doubles each, and not with each query.
  NaturalCenters(const Triangulation& triangulation, bool stored);

  const Triangulation& triangulation() const { return triangulation_; }
  const Complex& complex() const { return complex_; }
  const solve::CenterFinder& finder() const { return finder_; }
  std::span<const int> axes() const { return axes_; }
  std::size_t dimension() const { return d_; }
  const double* point(VertexId v) const { return points_.point(index(v)); }
  /// The center of a finite cell less its first vertex.
  void offset(CellId c, double* result) const;
  void corners(CellId c, std::vector<const double*>& points) const;

 private:
  const Triangulation& triangulation_;
  Complex complex_;
  const sites::VertexPoints& points_;
  std::vector<int> axes_;
  std::size_t d_;
  solve::CenterFinder finder_;
  std::vector<double> offsets_;
};

/// One search after the other, each thread with its own object.
class NaturalSearch {
 public:
  explicit NaturalSearch(const NaturalCenters& centers) : centers_(centers) {}

  /// Finds the natural neighbors of a point in the hull that is no vertex; `hint`: a finite cell that
  /// contains it. On the boundary of the hull: those within the smallest face of the hull that contains it.
  void find(const double* q, CellId hint, bool with_gradients);
  /// As if there were only these vertices, different from the point, which is in their convex hull.
  void find_among(std::span<const VertexId> some, const double* q, bool with_gradients);

  /// Those with positive coordinates.
  std::vector<VertexId> vertices;
  /// Their coordinates, with sum 1 up to rounding.
  std::vector<double> weights;
  /// The gradients of their coordinates, d numbers each, tangent to the smallest face of the hull.
  std::vector<double> gradients;
  /// Whether binary64 did not settle the last search, and integers did.
  bool was_exact = false;
  /// The cells in conflict with the point of the last search.
  std::span<const CellId> zone() const { return zone_; }

 private:
  bool collect(const std::vector<CellId>& zone);
  void find_on_boundary(const double* q, const std::vector<CellId>& zone, bool with_gradients);
  bool find_rounded(const double* q, bool with_gradients);
  void find_exactly(const double* q, bool with_gradients);
  void corners_of(std::size_t cell, const double* q, std::vector<const double*>& points) const;
  void finish(const double* q, bool with_gradients);

  const NaturalCenters& centers_;
  internal::StampedTable locals_, in_zone_;
  ZoneSphere sphere_;
  std::vector<CellId> zone_;           // the first cells of the sphere; the others contain q
  std::vector<VertexId> local_;        // by number in the sphere; 0 is q
  std::vector<double> shares_;         // by number: the coordinate
  std::vector<double> first_moments_;  // by number: M over k! times the volume of the region
  std::vector<double> x_;
  std::vector<const double*> points_;
  DualVolumes<double> rounded_;
  DualVolumes<kernel::Integer> exact_;
};

}  // namespace delone::queries
