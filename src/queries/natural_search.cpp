// SPDX-License-Identifier: BSD-3-Clause
// The coordinates of Sibson from the conflict zone of a query, without inserting it.
//
// The region that q would have takes from each natural neighbor p a part of volume u_p, and λ_p = u_p / Σ u.
// The parts are bounded by the centers of the cells that an insertion would replace and create, and these are
// points of the closed region: however far away a center is, the volumes do not cancel. dual_volumes.hpp adds
// them up, in binary64 with an error bound, and where that is not far below Σ u, in integers: centers
// are then rounded to ever finer grids until the bound suffices. It does in the end, as the region has an
// interior. In a flat the projections on its axes have the volumes divided by one number, which quotients do
// not show.
//
// Errors in binary64. Coordinate j of a center less q is (p − q)_j + o_j, where o is the offset from a vertex
// p (CenterFinder::find_offset). Let S be the largest magnitude of coordinate j of a center or neighbor, less
// q. Then |o_j| ≤ 2S and the extent of the cell is at most 2S, so the error is at most u·S for the
// difference, 5/4·u·2S + 1/4·u·2S for the offset, and u·S for the sum: 5u·S, with factors 1 + O(u) that 8u·S
// covers. Axes are scaled by powers of two such that S is in [1/2, 1), which changes no quotient of volumes.
//
// Degenerate zones. Cells with a common sphere share a center, and every way to divide their points into
// cells gives the same parts: the coordinates do not depend on the perturbation.
//
// Boundary. As q tends to a point of a face of the hull, its region grows beyond all bounds along the normals
// of the face. Far away, the diagram is that of the vertices within the face, and so are the limits of the
// coordinates. An insertion of q joins it to all its natural neighbors within the face, hence these are among
// its neighbors in the hull: a triangulation of those in the face has the same answer.
//
// Gradients (Piper 1993, doi:10.1007/978-3-7091-6916-2_18). If q moves by δ, a point x of the facet between q
// and p moves along its normal by (x − q)·δ/|p − q|, so ∇u_p = A·(g − q)/|p − q| with the area A and the
// centroid g of the facet. The cone of the facet from q has volume W/k! = A·|p − q|/(2k), thus k!·∇u_p =
// 2k·W·(g − q)/|p − q|² = 2M/|p − q|².
#include "queries/natural_search.hpp"

#include "base/progress_meter.hpp"
#include "kernel/predicates.hpp"

#include <delone/delaunay.hpp>
#include <delone/error.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace delone::queries {
namespace {

using kernel::Integer;

/// The exponent of the power of two next above |x|.
int exponent_above(double x) {
  int exponent = 0;
  std::frexp(x, &exponent);
  return exponent;
}

/// floor(log2 |x|) for x ≠ 0.
int log2_of(const Integer& x) {
  return static_cast<int>(boost::multiprecision::msb(Integer(boost::multiprecision::abs(x))));
}

}  // namespace

NaturalCenters::NaturalCenters(const Triangulation& triangulation, bool stored)
    : triangulation_(triangulation),
      complex_(triangulation.complex()),
      points_(triangulation::StoredPoints::of(triangulation)),
      axes_(triangulation.axes()),
      d_(static_cast<std::size_t>(triangulation.dimension())),
      finder_(triangulation.dimension(), axes_,
              triangulation.affine_dimension() == triangulation.dimension()) {
  if (triangulation.kind() != TriangulationKind::delaunay)
    throw Error(Errc::unsupported, "natural neighbors are those of a Delaunay triangulation");
  if (!stored || complex_.affine_dimension() < 1) return;
  std::vector<double> offsets(static_cast<std::size_t>(complex_.num_cell_slots()) * d_);
  std::vector<const double*> points;
  for (const CellId c : complex_.finite_cells()) {
    internal::cancellation_point();
    corners(c, points);
    finder_.find_offset(points.data(), offsets.data() + index(c) * d_);
  }
  offsets_ = std::move(offsets);
}

void NaturalCenters::corners(CellId c, std::vector<const double*>& points) const {
  points.clear();
  for (const VertexId v : complex_.vertices(c)) points.push_back(point(v));
}

void NaturalCenters::offset(CellId c, double* result) const {
  if (!offsets_.empty()) {
    std::copy_n(offsets_.data() + index(c) * d_, d_, result);
    return;
  }
  std::vector<const double*> points;
  corners(c, points);
  finder_.find_offset(points.data(), result);
}

/// Makes the sphere of the zone. Returns false if the zone has an infinite cell.
bool NaturalSearch::collect(const std::vector<CellId>& zone) {
  const Complex& complex = centers_.complex();
  const auto size = static_cast<std::size_t>(complex.affine_dimension()) + 1;
  sphere_.k = size - 1;
  sphere_.cells.clear();
  sphere_.signs.clear();
  zone_ = zone;
  local_.assign(1, infinite_vertex);
  locals_.clear();
  in_zone_.clear();
  for (const CellId c : zone) {
    if (complex.is_infinite(c)) return false;
    in_zone_.insert(index(c), 0);
  }
  for (const CellId c : zone) {
    const std::size_t first = sphere_.cells.size();
    bool odd = false;
    for (const VertexId v : complex.vertices(c)) {
      const auto [number, is_new] = locals_.insert(index(v), static_cast<std::uint32_t>(local_.size()));
      if (is_new) local_.push_back(v);
      sphere_.cells.push_back(number);
      for (std::size_t i = sphere_.cells.size() - 1; i > first && sphere_.cells[i] < sphere_.cells[i - 1];
           --i) {
        std::swap(sphere_.cells[i], sphere_.cells[i - 1]);
        odd = !odd;
      }
    }
    sphere_.signs.push_back(odd ? -1 : 1);
  }
  for (std::size_t t = 0; t < zone.size(); ++t)
    for (std::size_t i = 0; i < size; ++i) {
      if (in_zone_.contains(index(complex.neighbor(zone[t], static_cast<int>(i))))) continue;
      const std::uint32_t opposite = *locals_.find_value(index(complex.vertex(zone[t], static_cast<int>(i))));
      sphere_.cells.push_back(0);
      bool negative = sphere_.signs[t] > 0;
      for (std::size_t j = 0, position = 0; j < size; ++j) {
        const std::uint32_t v = sphere_.cells[t * size + j];
        if (v != opposite)
          sphere_.cells.push_back(v);
        else
          position = j;
        if (v == opposite && position % 2 == 1) negative = !negative;
      }
      sphere_.signs.push_back(negative ? -1 : 1);
    }
  sphere_.num_vertices = local_.size();
  return true;
}

/// The corners of a cell of the sphere, q first if it is one.
void NaturalSearch::corners_of(std::size_t cell, const double* q, std::vector<const double*>& points) const {
  if (cell < zone_.size()) return centers_.corners(zone_[cell], points);
  points.clear();
  const std::size_t size = sphere_.k + 1;
  for (std::size_t i = 0; i < size; ++i) {
    const std::uint32_t v = sphere_.cells[cell * size + i];
    points.push_back(v == 0 ? q : centers_.point(local_[v]));
  }
}

void NaturalSearch::find(const double* q, CellId hint, bool with_gradients) {
  const std::vector<CellId> zone =
      triangulation::StoredPoints::conflict_zone(centers_.triangulation(), {q, centers_.dimension()}, hint);
  was_exact = false;
  if (!collect(zone)) return find_on_boundary(q, zone, with_gradients);
  if (!find_rounded(q, with_gradients)) {
    was_exact = true;
    find_exactly(q, with_gradients);
  }
  finish(q, with_gradients);
}

void NaturalSearch::find_on_boundary(const double* q, const std::vector<CellId>& zone, bool with_gradients) {
  const Complex& complex = centers_.complex();
  std::vector<VertexId> in_face;
  for (const CellId c : zone)
    for (const VertexId v : complex.vertices(c))
      if (v != infinite_vertex) in_face.push_back(v);
  std::sort(in_face.begin(), in_face.end());
  in_face.erase(std::unique(in_face.begin(), in_face.end()), in_face.end());
  const kernel::Flat flat{static_cast<int>(centers_.dimension()), centers_.axes()};
  for (const CellId c : zone) {
    const int infinite = complex.infinite_index(c);
    if (infinite < 0) continue;
    points_.clear();
    for (const VertexId v : complex.vertices(c))
      points_.push_back(v == infinite_vertex ? nullptr : centers_.point(v));
    std::erase_if(in_face, [&](VertexId v) {
      points_[static_cast<std::size_t>(infinite)] = centers_.point(v);
      return kernel::orientation(flat, points_) != Sign::zero;
    });
  }
  find_among(in_face, q, with_gradients);
}

void NaturalSearch::find_among(std::span<const VertexId> some, const double* q, bool with_gradients) {
  const std::size_t d = centers_.dimension();
  std::vector<double> coordinates;
  for (const VertexId v : some)
    coordinates.insert(coordinates.end(), centers_.point(v), centers_.point(v) + d);
  const Delaunay<> triangulation(coordinates, static_cast<int>(d));
  const NaturalCenters centers(triangulation, false);
  NaturalSearch search(centers);
  search.find(q, *triangulation.finite_cells().begin(), with_gradients);
  vertices.clear();
  for (const VertexId v : search.vertices) vertices.push_back(some[triangulation.row_of(v)]);
  weights = std::move(search.weights);
  gradients = std::move(search.gradients);
  was_exact = search.was_exact;
}

/// Returns false if the error is not certainly small.
bool NaturalSearch::find_rounded(const double* q, bool with_gradients) {
  const std::size_t d = centers_.dimension(), count = sphere_.num_cells();
  x_.resize(count * d);
  std::vector<double> largest(d, 0.0);
  for (std::size_t t = 0; t < count; ++t) {
    double* const x = x_.data() + t * d;
    if (t < zone_.size()) {
      centers_.offset(zone_[t], x);
      const double* const origin = centers_.point(centers_.complex().vertex(zone_[t], 0));
      for (std::size_t j = 0; j < d; ++j) x[j] += origin[j] - q[j];
    } else {
      corners_of(t, q, points_);
      centers_.finder().find_offset(points_.data(), x);
    }
    for (std::size_t j = 0; j < d; ++j) largest[j] = std::max(largest[j], std::fabs(x[j]));
  }
  for (std::size_t v = 1; v < local_.size(); ++v)
    for (std::size_t j = 0; j < d; ++j)
      largest[j] = std::max(largest[j], std::fabs(centers_.point(local_[v])[j] - q[j]));
  std::vector<double> scale(d, 1.0);
  for (std::size_t j = 0; j < d; ++j) {
    if (largest[j] == 0) continue;
    if (!(largest[j] > 0x1p-900 && largest[j] < 0x1p900)) return false;
    scale[j] = std::ldexp(1.0, -exponent_above(largest[j]));
  }
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t j = 0; j < d; ++j) x_[t * d + j] *= scale[j];
  rounded_.compute(sphere_, centers_.axes(), d, x_.data(),
                   8 * 0x1p-53 * std::sqrt(static_cast<double>(sphere_.k)), with_gradients);
  const double total = -rounded_.volumes[0];
  double error = 0;
  for (const double e : rounded_.errors) error = std::max(error, e);
  if (!(1.01 * (error + rounded_.errors[0]) < largest_natural_error(sphere_.k) / 4 * std::fabs(total)))
    return false;
  shares_.resize(local_.size());
  first_moments_.resize(with_gradients ? local_.size() * d : 0);
  for (std::size_t v = 1; v < local_.size(); ++v) {
    shares_[v] = rounded_.volumes[v] / total;
    for (std::size_t j = 0; with_gradients && j < d; ++j)
      first_moments_[v * d + j] = rounded_.moments[v * d + j] / total / scale[j];
  }
  // finish() divides by the sum of what is positive.
  double sum = 0;
  for (std::size_t v = 1; v < local_.size(); ++v) sum += std::max(shares_[v], 0.0);
  return std::fabs(sum - 1) < largest_natural_error(sphere_.k) / 4;
}

void NaturalSearch::find_exactly(const double* q, bool with_gradients) {
  const std::size_t d = centers_.dimension(), count = sphere_.num_cells();
  int grid = std::numeric_limits<int>::max();
  const auto include = [&](const double* p) {
    for (std::size_t j = 0; j < d; ++j) grid = std::min(grid, kernel::trailing_exponent(p[j]));
  };
  include(q);
  for (std::size_t v = 1; v < local_.size(); ++v) include(centers_.point(local_[v]));
  // Twice the centers less q, in units of 2^grid, and their binary logarithms.
  std::vector<Integer> numerators(count * d), denominators(count);
  std::vector<int> most(d, std::numeric_limits<int>::min());
  for (std::size_t t = 0; t < count; ++t) {
    corners_of(t, q, points_);
    solve::CenterFinder::ExactOffset offset = centers_.finder().find_offset_exactly(points_.data());
    for (std::size_t j = 0; j < d; ++j) {
      const Integer origin = kernel::scaled_integer(points_[0][j], grid) - kernel::scaled_integer(q[j], grid);
      Integer& x = numerators[t * d + j];
      x = (offset.twice.numerators[j] << (offset.grid - grid)) + 2 * origin * offset.twice.denominator;
      if (x != 0) most[j] = std::max(most[j], log2_of(x) - log2_of(offset.twice.denominator) + 1);
    }
    denominators[t] = std::move(offset.twice.denominator);
  }
  std::vector<Integer> x(count * d);
  std::vector<int> shift(d, 0);
  for (int bits = 128;; bits *= 2) {
    for (std::size_t j = 0; j < d; ++j)
      shift[j] = most[j] == std::numeric_limits<int>::min() ? 0 : bits - most[j];
    for (std::size_t i = 0; i < x.size(); ++i) {
      const int s = shift[i % d];
      const Integer& denominator = denominators[i / d];
      x[i] = s >= 0 ? Integer((numerators[i] << s) / denominator)
                    : Integer(numerators[i] / Integer(denominator << -s));
    }
    exact_.compute(sphere_, centers_.axes(), d, x.data(), Integer(sphere_.k), with_gradients);
    const Integer total = -exact_.volumes[0];
    Integer error = 0;
    for (const Integer& e : exact_.errors) error = std::max(error, e);
    if (((error + exact_.errors[0]) << 38) >= boost::multiprecision::abs(total)) continue;
    shares_.resize(local_.size());
    first_moments_.resize(with_gradients ? local_.size() * d : 0);
    for (std::size_t v = 1; v < local_.size(); ++v) {
      shares_[v] = kernel::nearest_double(exact_.volumes[v], total, 0);
      for (std::size_t j = 0; with_gradients && j < d; ++j)
        first_moments_[v * d + j] =
            kernel::nearest_double(exact_.moments[v * d + j], total, grid - 1 - shift[j]);
    }
    return;
  }
}

/// Divides shares and moments by the total: the weights and their gradients.
void NaturalSearch::finish(const double* q, bool with_gradients) {
  const std::size_t d = centers_.dimension();
  double sum = 0;
  for (std::size_t v = 1; v < local_.size(); ++v) {
    shares_[v] = std::max(shares_[v], 0.0);
    sum += shares_[v];
  }
  std::vector<double> total(d, 0.0);
  if (with_gradients)
    for (std::size_t v = 1; v < local_.size(); ++v) {
      const double* const p = centers_.point(local_[v]);
      double* const m = first_moments_.data() + v * d;
      double largest = 0, square = 0;
      for (std::size_t j = 0; j < d; ++j) largest = std::max(largest, std::fabs(p[j] - q[j]));
      const int exponent = exponent_above(largest);
      for (std::size_t j = 0; j < d; ++j) {
        const double r = std::ldexp(p[j] - q[j], -exponent);
        square += r * r;
      }
      for (std::size_t j = 0; j < d; ++j) {
        m[j] = std::ldexp(2 * std::ldexp(m[j], -exponent) / square, -exponent);
        total[j] += m[j];
      }
    }
  vertices.clear();
  weights.clear();
  gradients.clear();
  for (std::size_t v = 1; v < local_.size(); ++v) {
    if (shares_[v] == 0) continue;
    vertices.push_back(local_[v]);
    weights.push_back(shares_[v] / sum);
    for (std::size_t j = 0; with_gradients && j < d; ++j)
      gradients.push_back(first_moments_[v * d + j] - weights.back() * total[j]);
  }
}

}  // namespace delone::queries
