// SPDX-License-Identifier: BSD-3-Clause
// Let B be the closed ball of radius τ about x, and H the convex hull.
//
// Thick cells within τ are found from any finite cell that meets B, through facets that meet B. This reaches
// every cell that meets B: let y be a point of the cell in B, and z one of the first cell. The segment from z
// to y lies in H ∩ B, which is convex, and where it passes from cell to cell, at a point y', the cells at y'
// are connected through facets that contain y', as H is convex near y', too. Best first, so that the ball
// shrinks to the nearest thick cell found. Facets are left out by certified lower bounds only, and the
// nearest of the cells found is picked exactly where bounds do not tell.
//
// The nearest point of H is found by descent. Let z be the nearest point of a cell, and F the smallest face
// that contains it. If no vertex p of a cell around F has (x − z)·(p − z) > 0, these cells have no nearer
// point. They cover H near z; so |x − z| has a local minimum over the convex set H, which is the global one.
// Otherwise the cell with such a p comes nearer. This holds in flats as well: distances are those of R^d.
//
// Where distances are a matter of rounding beside the cell (is_accurate()), x' is known up to rounding
// without more ado: the point found and the nearest one, z, of a convex set satisfy |x' − z|² ≤ |x − x'|² −
// |x − z|².
#include "queries/tolerant_location.hpp"

#include "base/progress_meter.hpp"
#include "queries/barycentric.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace delone::queries {

void TolerantLocation::load(CellId cell) {
  points_.clear();
  for (const VertexId v : where_.complex.vertices(cell)) points_.push_back(where_.point(v));
}

bool TolerantLocation::is_thick(CellId cell) {
  load(cell);
  return thick_->is_thick(cell, points_, where_.dimension, heights_);
}

std::vector<std::size_t> TolerantLocation::rows(std::span<const VertexId> vertices) const {
  std::vector<std::size_t> result;
  for (const VertexId v : vertices) result.push_back(where_.triangulation.row_of(v));
  std::sort(result.begin(), result.end());
  return result;
}

std::vector<std::size_t> TolerantLocation::rows_of_cell(CellId cell) const {
  return rows(std::vector<VertexId>(where_.complex.vertices(cell)));
}

/// Calls visit(cell) for all finite cells that contain a face of `cell`.
template <class Visit>
void TolerantLocation::visit_star(CellId cell, std::span<const VertexId> face, Visit visit) {
  std::vector<CellId> queue{cell};
  visited_.clear();
  visited_.insert(index(cell), 0);
  for (std::size_t next = 0; next < queue.size(); ++next) {
    const CellId c = queue[next];
    visit(c);
    for (int i = 0; i <= where_.affine_dimension; ++i) {
      if (std::find(face.begin(), face.end(), where_.complex.vertex(c, i)) != face.end()) continue;
      const CellId other = where_.complex.neighbor(c, i);
      if (where_.complex.is_infinite(other) || !visited_.insert(index(other), 0).second) continue;
      queue.push_back(other);
    }
  }
}

/// Whether the bounding box of the points is certainly farther than `radius`: a rounded difference is off by
/// a factor 1 ± u.
bool TolerantLocation::has_far_box(const std::vector<const double*>& points, const double* q,
                                   double radius) const {
  for (std::size_t j = 0; j < static_cast<std::size_t>(where_.dimension); ++j) {
    double low = points[0][j], high = low;
    for (const double* p : points) {
      low = std::min(low, p[j]);
      high = std::max(high, p[j]);
    }
    if (std::max(low - q[j], q[j] - high) * (1 - 0x1p-50) > radius) return true;
  }
  return false;
}

/// The nearest point of a cell, with certified bounds.
void TolerantLocation::find(CellId cell, const double* q, Candidate& result) {
  load(cell);
  nearest_.find(points_, q, where_.dimension);
  nearest_.prove();
  result.cell = cell;
  result.lower = nearest_.lower();
  result.upper = nearest_.upper();
  result.is_accurate = nearest_.weight_error() <= largest_weight_error;
  result.weights.assign(nearest_.weights().begin(), nearest_.weights().end());
  result.face.clear();
  for (const int i : nearest_.face()) result.face.push_back(where_.complex.vertex(cell, i));
}

/// Weights are off by at most |x' − z| divided by the least height.
bool TolerantLocation::is_accurate(const Candidate& candidate) {
  if (candidate.is_accurate) return true;
  if (candidate.upper == 0) return true;
  load(candidate.cell);
  if (points_.size() < 2) return true;
  const double height = heights_.least_height_down(points_, where_.dimension);
  const double l = candidate.lower / candidate.upper;
  const double off = candidate.upper * std::sqrt(std::max(0.0, (1 - l) * (1 + l)) + 0x1p-50);
  return off <= 0.9 * largest_weight_error * height;
}

void TolerantLocation::find_exactly(CellId cell, const double* q, Candidate& result) {
  find(cell, q, result);
  result.exact = kernel::nearest_in_hull_exactly(points_, q, where_.dimension, nearest_.face());
  result.is_accurate = true;
  std::fill(result.weights.begin(), result.weights.end(), 0.0);
  result.face.clear();
  for (std::size_t i = 0; i < result.exact.face.size(); ++i) {
    const int place = result.exact.face[i];
    result.weights[static_cast<std::size_t>(place)] =
        std::max(result.exact.weight(i), std::numeric_limits<double>::min());
    result.face.push_back(where_.complex.vertex(cell, place));
  }
}

bool TolerantLocation::is_within(const Candidate& candidate, const double* q) {
  if (candidate.upper <= options_.tolerance) return true;
  if (candidate.lower > options_.tolerance) return false;
  Candidate exact;
  find_exactly(candidate.cell, q, exact);
  return exact.exact.compare(options_.tolerance) != Sign::positive;
}

/// Whether a comes before b of the same distance: by the rows of the faces, then of the cells.
bool TolerantLocation::precedes(const Candidate& a, const Candidate& b) const {
  const auto face_a = rows(a.face), face_b = rows(b.face);
  return face_a != face_b ? face_a < face_b : rows_of_cell(a.cell) < rows_of_cell(b.cell);
}

/// Decides all cells, and keeps those that are thick.
void TolerantLocation::list_thick_cells() {
  thick_->keep_list([&] {
    std::vector<CellId> list;
    for (const CellId cell : where_.complex.finite_cells()) {
      internal::cancellation_point();
      if (is_thick(cell)) list.push_back(cell);
    }
    return list;
  });
}

/// Collects the thick cells within τ that may be nearest. A ball of many cells has few that are thick, or it
/// would have shrunk: then a list of all of them is the shorter way.
void TolerantLocation::search(const double* q, CellId start) {
  candidates_.clear();
  double radius = options_.tolerance;
  const auto look_at = [&](CellId cell) {
    Candidate candidate;
    find(cell, q, candidate);
    radius = std::min(radius, candidate.upper);
    if (candidate.lower <= radius) candidates_.push_back(std::move(candidate));
  };
  const std::size_t all = where_.complex.num_finite_cells();
  if (const auto* list = thick_->list(); list && list->size() < all / 64) {
    for (const CellId cell : *list) {
      load(cell);
      if (!has_far_box(points_, q, radius)) look_at(cell);
    }
  } else {
    std::size_t visited = 0;
    visit_ball(q, start, radius, [&](CellId cell) {
      ++visited;
      if (is_thick(cell)) look_at(cell);
      return true;
    });
    if (!list && visited > all / 16) list_thick_cells();
  }
  std::erase_if(candidates_, [&](const Candidate& c) { return c.lower > radius; });
}

/// The nearest point of the thick cells, if it is within τ. `start` meets the ball.
bool TolerantLocation::find_thick(const double* q, CellId start, Candidate& result) {
  search(q, start);
  if (candidates_.empty()) return false;
  const auto is_nearer = [](const Candidate& a, const Candidate& b) { return a.upper < b.upper; };
  const Candidate& first = *std::min_element(candidates_.begin(), candidates_.end(), is_nearer);
  bool is_certain = first.upper <= options_.tolerance;
  // Points at distances that are nothing beside the cells need no comparison. Neither do equal points.
  const bool is_tiny = [&] {
    if (first.upper == 0) return true;
    for (const Candidate& c : candidates_) {
      load(c.cell);
      const double height = heights_.least_height_down(points_, where_.dimension);
      if (!(first.upper <= 0.4 * largest_weight_error * height)) return false;
    }
    return true;
  }();
  const auto has_face_of_first = [&](const Candidate& c) { return rows(c.face) == rows(first.face); };
  is_certain = is_certain &&
               (is_tiny || std::all_of(candidates_.begin(), candidates_.end(), has_face_of_first)) &&
               is_accurate(first);
  if (is_certain) {
    const Candidate* best = &first;
    for (const Candidate& c : candidates_)
      if (c.upper <= first.upper && has_face_of_first(c) && precedes(c, *best)) best = &c;
    result = *best;
    return true;  // its upper bound is within τ
  }
  const Candidate* best = nullptr;
  for (Candidate& c : candidates_) {
    find_exactly(c.cell, q, c);
    const Sign order = best == nullptr ? Sign::negative : c.exact.compare(best->exact);
    if (order == Sign::negative || (order == Sign::zero && precedes(c, *best))) best = &c;
  }
  if (best->exact.compare(options_.tolerance) == Sign::positive) return false;
  result = *best;
  result.upper = std::min(result.upper, options_.tolerance);
  return true;
}

/// The nearest point of the hull.
void TolerantLocation::find_in_hull(const double* q, CellId start, Candidate& result) {
  CellId cell = start;
  for (;;) {
    CellId next = invalid_cell;
    bool is_known = false;
    find(cell, q, result);
    if (result.is_accurate) {
      is_known = true;
      visit_star(cell, result.face, [&](CellId c) {
        for (const VertexId v : where_.complex.vertices(c)) {
          if (std::find(result.face.begin(), result.face.end(), v) != result.face.end()) continue;
          const Sign side = nearest_.side(where_.point(v), q);
          if (side == Sign::negative && next == invalid_cell) next = c;
          is_known = is_known && side != Sign::zero;
        }
      });
    } else if (heights_.least_height_down(points_, where_.dimension) * largest_weight_error >= result.upper) {
      return;  // whatever the nearest point, it is as near to this one as rounding matters
    }
    if (next == invalid_cell && !is_known) {
      find_exactly(cell, q, result);
      std::vector<const double*> with;
      std::vector<int> guess;
      for (const VertexId v : result.face) {
        guess.push_back(static_cast<int>(with.size()));
        with.push_back(where_.point(v));
      }
      with.push_back(nullptr);
      visit_star(cell, result.face, [&](CellId c) {
        if (next != invalid_cell) return;
        for (const VertexId v : where_.complex.vertices(c)) {
          if (std::find(result.face.begin(), result.face.end(), v) != result.face.end()) continue;
          with.back() = where_.point(v);
          const auto other = kernel::nearest_in_hull_exactly(with, q, where_.dimension, guess);
          if (other.compare(result.exact) == Sign::negative) next = c;
        }
      });
    }
    if (next == invalid_cell) return;
    cell = next;
  }
}

/// For a query at a vertex: a thick cell that has it, the first by rows, if there is one.
void TolerantLocation::prefer_thick(LocatedPoint& found) {
  const auto place = std::max_element(found.barycentric.begin(), found.barycentric.end());
  const VertexId vertex =
      where_.complex.vertex(found.cell, static_cast<int>(place - found.barycentric.begin()));
  CellId best = invalid_cell;
  visit_star(found.cell, {&vertex, 1}, [&](CellId c) {
    if (is_thick(c) && (best == invalid_cell || rows_of_cell(c) < rows_of_cell(best))) best = c;
  });
  if (best == invalid_cell) return;
  weights_.assign(found.barycentric.size(), 0.0);
  weights_[static_cast<std::size_t>(where_.complex.index_of(best, vertex))] = 1;
  found.cell = best;
  found.barycentric = weights_;
}

void TolerantLocation::answer(const Candidate& candidate, LocatedPoint& found) {
  weights_ = candidate.weights;
  const auto size = static_cast<int>(candidate.face.size());
  found.kind = size == 1                        ? Location::Kind::on_vertex
               : size > where_.affine_dimension ? Location::Kind::in_cell
                                                : Location::Kind::on_face;
  found.cell = candidate.cell;
  found.barycentric = weights_;
  found.distance = candidate.upper;
  last_ = candidate.cell;
}

/// The cell of a query, one at the facet that it is beyond, or one that is likely near.
CellId TolerantLocation::finite_cell(const LocatedPoint& found) const {
  if (!found.barycentric.empty()) return found.cell;
  if (found.cell != invalid_cell)
    return where_.complex.neighbor(found.cell, where_.complex.infinite_index(found.cell));
  if (last_ != invalid_cell || where_.complex.num_finite_cells() == 0) return last_;
  return *where_.complex.finite_cells().begin();
}

void TolerantLocation::refine(const double* q, LocatedPoint& found) {
  Candidate candidate;
  if (!found.barycentric.empty()) {
    if (thick_ == nullptr || is_thick(found.cell)) return;
    if (found.kind == Location::Kind::on_vertex) return prefer_thick(found);
    if (find_thick(q, found.cell, candidate)) answer(candidate, found);
    return;
  }
  const CellId start = finite_cell(found);
  if (start == invalid_cell) return;
  bool has_searched = false;
  if (thick_ != nullptr) {
    find(start, q, candidate);
    if (candidate.upper <= options_.tolerance) {
      has_searched = true;
      if (find_thick(q, start, candidate)) return answer(candidate, found);
    }
  }
  find_in_hull(q, start, candidate);
  last_ = candidate.cell;
  if (thick_ != nullptr && is_within(candidate, q)) {
    const CellId cell = candidate.cell;
    Candidate thick;
    if (!has_searched && find_thick(q, cell, thick)) candidate = std::move(thick);
    candidate.upper = std::min(candidate.upper, options_.tolerance);
    return answer(candidate, found);
  }
  if (options_.project) answer(candidate, found);
}

}  // namespace delone::queries
