// SPDX-License-Identifier: BSD-3-Clause
// Why every removed point is within the greatest depth of what remains, in whatever order cells are removed.
//
// Let c be removed while its facets opposite the vertices E are exposed, and x be a point of c. The direction
// w of c's height never lets a coordinate λ_i, i ∈ E, decrease, so a path from x along w does not leave c
// through an exposed facet, and it does leave c: through another one, after a length of at most height(c). It
// is now in a facet, which removing c exposes, of a cell c′ that is still there. If c′ is removed later, the
// path goes on in the same way. Each cell of the path is removed after the one before it, so the path ends,
// in a cell that remains. Its cells c_1, c_2 … c_m have depth(c_1) ≥ height(c_1) and
// depth(c_i) ≥ depth(c_(i−1)) + height(c_i), since c_i was entered through a facet of depth depth(c_(i−1)).
// So the path has a length of at most Σ height(c_i) ≤ depth(c_m), and this is at most the tolerance.
//
// Heights. With the edges e_1 … e_k from v_0 and their Gram matrix G, the gradients of λ_1 … λ_k have the
// Gram matrix G⁻¹, and ∇λ_0 = −Σ∇λ_j. For s = Σ_E λ_i and y = G⁻¹c, c_j = [j ∈ E] − [0 ∈ E], ∇s·∇λ_j = y_j
// and |∇s|² = cᵀy. If all ∇s·∇λ_i with i ∈ E are at least 0, w = ∇s, along which s grows from at least 0 to
// at most 1: the length is at most 1/|∇s|. Otherwise w = Σ_E z_i·∇λ_i with ∇λ_i·w = 1 for i ∈ E, which is Γz
// = (1 … 1) for the Gram matrix Γ of these gradients: s grows by |E| over a length of |w| = √Σz_i, so the
// length is at most |w|/|E|. Either is at least min_E h_i/|E| with the heights h_i of the cell: in the first
// case |∇s| ≤ Σ 1/h_i, in the second |w| ≥ 1/|∇λ_i| = h_i. So a cell that is wider than (k+1)·tolerance is
// never removed.
#include <delone/arithmetic.hpp>
#include <delone/trim.hpp>

#include "base/guarded.hpp"
#include "base/infinity.hpp"
#include "base/progress_meter.hpp"
#include "base/require_tolerance.hpp"
#include "kernel/double_double.hpp"
#include "kernel/fractions.hpp"
#include "kernel/grid.hpp"
#include "kernel/width_test.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <queue>
#include <utility>

namespace delone {
namespace {

using internal::infinity;
using kernel::Integer;

/// a + b, rounded up.
double sum_above(double a, double b) {
  const kernel::DoubleDouble sum = kernel::two_sum(a, b);
  return sum.low > 0 ? std::nextafter(sum.high, infinity) : sum.high;
}

/// A cell in integers.
class ExactCell {
 public:
  ExactCell(const std::vector<const double*>& points, std::size_t d) : k_(points.size() - 1) {
    grid_ = std::numeric_limits<int>::max();
    for (const double* p : points)
      for (std::size_t j = 0; j < d; ++j) grid_ = std::min(grid_, kernel::trailing_exponent(p[j]));
    std::vector<Integer> edges;
    for (std::size_t i = 1; i <= k_; ++i)
      for (std::size_t j = 0; j < d; ++j)
        edges.push_back(kernel::scaled_integer(points[i][j], grid_) -
                        kernel::scaled_integer(points[0][j], grid_));
    for (std::size_t a = 0; a < k_; ++a)
      for (std::size_t b = 0; b < k_; ++b) {
        Integer dot = 0;
        for (std::size_t j = 0; j < d; ++j) dot += edges[a * d + j] * edges[b * d + j];
        gram_.push_back(std::move(dot));
      }
  }

  /// Over the facets opposite the vertices with a mark, not all of them; rounded up.
  double height(const std::vector<unsigned char>& marks) const {
    const auto [y, det] = gradients_times(marks);
    Integer square = 0;
    bool leads_away = true;
    for (std::size_t i = 0; i <= k_; ++i) {
      if (marks[i] == 0) continue;
      square += y[i];
      leads_away = leads_away && y[i] >= 0;
    }
    return leads_away ? kernel::root_above(det, square, grid_) : height_of_equal_growth(marks);
  }
  double volume() const {
    Integer factorial = 1;
    for (std::size_t i = 2; i <= k_; ++i) factorial *= i;
    return kernel::root_above(kernel::exact_determinant(gram_, k_), factorial * factorial,
                              static_cast<int>(k_) * grid_);
  }

 private:
  /// The products of ∇(Σ_marks λ_i) with all ∇λ_j, times det G, and det G > 0.
  std::pair<std::vector<Integer>, Integer> gradients_times(const std::vector<unsigned char>& marks) const {
    std::vector<Integer> system;
    for (std::size_t a = 0; a < k_; ++a) {
      system.insert(system.end(), gram_.begin() + static_cast<std::ptrdiff_t>(a * k_),
                    gram_.begin() + static_cast<std::ptrdiff_t>((a + 1) * k_));
      system.emplace_back(static_cast<int>(marks[a + 1]) - static_cast<int>(marks[0]));
    }
    kernel::Fractions y = kernel::solve_exactly(std::move(system), k_);
    Integer first = 0;
    for (const Integer& other : y.numerators) first -= other;
    y.numerators.insert(y.numerators.begin(), std::move(first));
    return {std::move(y.numerators), std::move(y.denominator)};
  }
  double height_of_equal_growth(const std::vector<unsigned char>& marks) const {
    std::vector<std::size_t> marked;
    for (std::size_t i = 0; i <= k_; ++i)
      if (marks[i] != 0) marked.push_back(i);
    std::vector<Integer> system;  // det G times Γ, and ones
    Integer det = 1;
    for (const std::size_t i : marked) {
      std::vector<unsigned char> only(k_ + 1, 0);
      only[i] = 1;
      auto [y, same_det] = gradients_times(only);
      for (const std::size_t l : marked) system.push_back(y[l]);
      system.emplace_back(1);
      det = std::move(same_det);
    }
    const kernel::Fractions z = kernel::solve_exactly(std::move(system), marked.size());
    Integer sum = 0;
    for (const Integer& part : z.numerators) sum += part;
    return kernel::root_above(sum * det, z.denominator * marked.size() * marked.size(), grid_);
  }

  std::size_t k_;
  int grid_;
  std::vector<Integer> gram_;  // of the edges from vertex 0, in units of 2^(2·grid)
};

class Trimming {
 public:
  Trimming(ComplexData data, double tolerance)
      : data_(std::move(data)),
        tolerance_(tolerance),
        d_(static_cast<std::size_t>(data_.dimension)),
        corners_(static_cast<std::size_t>(data_.affine_dimension + 1)),
        kept_(data_.num_cells(), 1),
        version_(data_.num_cells(), 0),
        facet_depth_(data_.cells.size(), -1) {}

  TrimResult run() && {
    remove_cells();
    TrimResult result;
    result.depth = depth_;
    result.lost_volume = lost_volume_;
    result.num_removed = num_removed_;
    if (num_removed_ > 0) {
      renumber(result);
      data_.kind = DataKind::trimmed;
    }
    result.kept = std::move(kept_);
    result.data = std::move(data_);
    return result;
  }

 private:
  struct Candidate {
    double depth;
    Index cell, version;
  };

  const double* point(Index cell, std::size_t corner) const {
    return data_.points.data() + static_cast<std::size_t>(data_.cells[cell * corners_ + corner]) * d_;
  }
  std::vector<const double*> points_of(Index cell) const {
    std::vector<const double*> points;
    for (std::size_t i = 0; i < corners_; ++i) points.push_back(point(cell, i));
    return points;
  }

  void remove_cells() {
    const auto comes_later = [this](const Candidate& a, const Candidate& b) {
      return a.depth != b.depth ? a.depth > b.depth : a.cell != b.cell && comes_before(b.cell, a.cell);
    };
    std::priority_queue<Candidate, std::vector<Candidate>, decltype(comes_later)> queue(comes_later);
    const auto consider = [&](Index cell) {
      const double depth = depth_of(cell);
      if (depth <= tolerance_) queue.push({depth, cell, version_[cell]});
    };
    for (std::size_t i = 0; i < data_.neighbors.size(); ++i)
      if (data_.neighbors[i] < 0) facet_depth_[i] = 0;
    for (Index cell = 0; cell < kept_.size(); ++cell)
      if (std::any_of(facets_of(cell), facets_of(cell) + corners_, [](double depth) { return depth >= 0; }))
        consider(cell);
    std::vector<Index> exposed;
    while (!queue.empty() && num_removed_ + 1 < kept_.size()) {
      const Candidate next = queue.top();
      queue.pop();
      if (kept_[next.cell] == 0 || version_[next.cell] != next.version) continue;
      remove(next, exposed);
      for (const Index cell : exposed) consider(cell);
    }
  }

  /// Depths at the facets of a cell; −1 where they are not exposed.
  double* facets_of(Index cell) { return facet_depth_.data() + cell * corners_; }

  double depth_of(Index cell) {
    internal::cancellation_point();
    const double* const facets = facets_of(cell);
    std::vector<unsigned char> marks;
    double depth = 0;
    for (std::size_t i = 0; i < corners_; ++i) {
      marks.push_back(facets[i] >= 0 ? 1 : 0);
      depth = std::max(depth, facets[i]);
    }
    if (std::find(marks.begin(), marks.end(), 0) == marks.end()) return infinity;
    const auto points = points_of(cell);
    if (width_.is_wide(points, corners_ - 1, d_, static_cast<double>(corners_) * tolerance_)) return infinity;
    return sum_above(depth, ExactCell(points, d_).height(marks));
  }

  void remove(const Candidate& cell, std::vector<Index>& exposed) {
    kept_[cell.cell] = 0;
    ++num_removed_;
    depth_ = std::max(depth_, cell.depth);
    lost_volume_ = sum_above(lost_volume_, ExactCell(points_of(cell.cell), d_).volume());
    exposed.clear();
    for (std::size_t i = 0; i < corners_; ++i) {
      const SignedIndex neighbor = data_.neighbors[cell.cell * corners_ + i];
      if (neighbor < 0) continue;
      const auto other = static_cast<Index>(neighbor);
      const auto back =
          std::find(data_.neighbors.begin() + static_cast<std::ptrdiff_t>(other * corners_),
                    data_.neighbors.begin() + static_cast<std::ptrdiff_t>((other + 1) * corners_),
                    static_cast<SignedIndex>(cell.cell));
      facet_depth_[static_cast<std::size_t>(back - data_.neighbors.begin())] = cell.depth;
      *back = -1;
      ++version_[other];
      exposed.push_back(other);
    }
  }

  /// By the sorted lists of vertices.
  bool comes_before(Index a, Index b) const {
    const auto less = [this](const double* p, const double* q) {
      return std::lexicographical_compare(p, p + d_, q, q + d_);
    };
    auto p = points_of(a), q = points_of(b);
    std::sort(p.begin(), p.end(), less);
    std::sort(q.begin(), q.end(), less);
    return std::lexicographical_compare(p.begin(), p.end(), q.begin(), q.end(), less);
  }

  void renumber(TrimResult& result) {
    std::vector<unsigned char> had_cell(data_.num_points(), 0), has_cell(had_cell);
    std::vector<SignedIndex> number(kept_.size(), -1);
    SignedIndex count = 0;
    for (std::size_t cell = 0; cell < kept_.size(); ++cell) {
      if (kept_[cell] != 0) number[cell] = count++;
      for (std::size_t i = 0; i < corners_; ++i) {
        const auto row = static_cast<std::size_t>(data_.cells[cell * corners_ + i]);
        had_cell[row] = 1;
        if (kept_[cell] != 0) has_cell[row] = 1;
      }
    }
    for (std::size_t row = 0; row < had_cell.size(); ++row)
      if (had_cell[row] != has_cell[row]) result.orphans.push_back(static_cast<SignedIndex>(row));
    std::size_t end = 0;
    for (std::size_t item = 0; item < data_.cells.size(); ++item) {
      if (kept_[item / corners_] == 0) continue;
      const SignedIndex neighbor = data_.neighbors[item];
      data_.cells[end] = data_.cells[item];
      data_.neighbors[end++] = neighbor < 0 ? -1 : number[static_cast<std::size_t>(neighbor)];
    }
    data_.cells.resize(end);
    data_.neighbors.resize(end);
  }

  ComplexData data_;  // neighbors lose removed cells at once
  const double tolerance_;
  const std::size_t d_, corners_;
  std::vector<unsigned char> kept_;
  std::vector<Index> version_;       // changes with the exposed facets of a cell
  std::vector<double> facet_depth_;  // of facet i of a cell; −1: not exposed
  std::size_t num_removed_ = 0;
  double depth_ = 0, lost_volume_ = 0;
  kernel::WidthTest width_;
};

}  // namespace

TrimResult trim(const Triangulation& triangulation, double tolerance, const Execution& how) {
  const ArithmeticScope arithmetic;
  const internal::ProgressMeter meter(how.progress);
  internal::require_tolerance(tolerance);
  return internal::guarded("the trimmed triangulation", [&] {
    ComplexData data = triangulation.to_data();
    internal::require_tolerance_within(tolerance, data.points, static_cast<std::size_t>(data.dimension));
    if (tolerance == 0 || data.affine_dimension < 1) {
      TrimResult result;
      result.kept.assign(data.num_cells(), 1);
      result.data = std::move(data);
      return result;
    }
    return Trimming(std::move(data), tolerance).run();
  });
}

}  // namespace delone
