// SPDX-License-Identifier: BSD-3-Clause
#include "hull/tolerance/grown_choice.hpp"

#include "base/compiled_dimension.hpp"
#include "hull/cell_cones.hpp"
#include "hull/growing_flat.hpp"
#include "hull/hull_state.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace delone::hull {

namespace {

constexpr std::size_t least_share = 16;  // a round that adds fewer than one in so many is the last
constexpr int longest_walk = 400;
constexpr std::size_t between_signs_of_life = 1024;

class Growth {
 public:
  Growth(std::span<const double* const> points, int dimension, double tolerance,
         const std::function<void()>& alive)
      : points_(points),
        d_(static_cast<std::size_t>(dimension)),
        tolerance_(tolerance),
        alive_(alive),
        state_(dimension),
        is_kept_(points.size(), 0),
        order_(points.size()),
        cell_of_(points.size(), invalid_index),
        difference_(d_) {
    std::iota(order_.begin(), order_.end(), Index{0});
  }

  GrownChoice run(std::span<const Index> required) {
    keep_all({required.begin(), required.end()});
    keep_all(spanning());
    bool goes_on = true;
    while (goes_on && has_cells()) {
      const std::vector<Index> farthest = find_farthest();
      goes_on = farthest.size() * least_share >= kept_.size() && !farthest.empty();
      if (goes_on) keep_all(farthest);
    }
    return {kept_, has_cells() ? corners() : std::vector<Index>{}};
  }

 private:
  struct Farthest {
    double distance = 0;
    Index point = invalid_index;
  };

  bool has_cells() const {
    const Boundary* const boundary = state_.boundary();
    return state_.affine_hull().dimension() == static_cast<int>(d_) && boundary != nullptr &&
           boundary->has_center();
  }

  /// Points that span the space well.
  std::vector<Index> spanning() const {
    GrowingFlat flat({points_.begin(), points_.end()}, static_cast<int>(d_));
    for (std::size_t k = 0; k < d_; ++k) flat.grow();
    std::vector<Index> found;
    for (const double* const p : flat.basis())
      found.push_back(static_cast<Index>(std::find(points_.begin(), points_.end(), p) - points_.begin()));
    return found;
  }

  void keep_all(const std::vector<Index>& list) {
    std::vector<double> coordinates;
    for (const Index p : list) {
      if (is_kept_[p] != 0) continue;
      is_kept_[p] = 1;
      kept_.push_back(p);
      coordinates.insert(coordinates.end(), points_[p], points_[p] + d_);
    }
    Options quiet;
    quiet.tolerance = tolerance_;  // then every row gets a site
    if (!coordinates.empty()) state_.insert_range(coordinates, quiet);
  }

  /// Sets cell_of_ and puts points of a cell together, so that walks are short. Returns those farthest beyond
  /// the cells, increasing.
  std::vector<Index> find_farthest() {
    CellCones cones(state_, state_.boundary()->center().data());
    const std::size_t m = cones.hull().num_cells();
    std::vector<Farthest> farthest(m);
    std::vector<double> heights(m, 0);  // of the hyperplanes above the center
    std::size_t cell = 0, count = 0;
    for (const Index p : order_) {
      if (++count % between_signs_of_life == 0) alive_();
      const double sum = internal::with_compiled_dimension<2, 4>(
          d_, [&](auto dimension) { return walk<dimension()>(cones, p, cell); });
      cell_of_[p] = static_cast<Index>(cell);
      if (is_kept_[p] != 0 || !(sum > 1)) continue;
      if (heights[cell] == 0) heights[cell] = height_of(cones.inverse(cell));
      const double distance = (sum - 1) * heights[cell];
      Farthest& best = farthest[cell];
      if (distance > tolerance_ &&
          (distance > best.distance || (distance == best.distance && p < best.point)))
        best = {distance, p};
    }
    sort_by_cells(m);
    std::vector<Index> found;
    for (const Farthest& each : farthest)
      if (each.point != invalid_index) found.push_back(each.point);
    std::sort(found.begin(), found.end());
    return found;
  }

  /// Puts the points of a cell together; they stay in their order.
  void sort_by_cells(std::size_t num_cells) {
    std::vector<std::size_t> next(num_cells + 1, 0);
    for (const Index cell : cell_of_) ++next[cell + std::size_t{1}];
    std::partial_sum(next.begin(), next.end(), next.begin());
    std::vector<Index> sorted(order_.size());
    for (const Index p : order_) sorted[next[cell_of_[p]]++] = p;
    order_ = std::move(sorted);
  }

  /// Walks from a cell to the one whose cone contains p. Returns the sum of the weights there, which is more
  /// than 1 if p is beyond the cell.
  template <int D>
  double walk(CellCones& cones, Index p, std::size_t& cell) {
    const std::size_t d = D > 0 ? static_cast<std::size_t>(D) : d_;
    const double* const center = state_.boundary()->center().data();
    for (std::size_t j = 0; j < d; ++j) difference_[j] = points_[p][j] - center[j];
    double sum = 0;
    for (int step = 0; step < longest_walk; ++step) {
      const double* const inverse = cones.inverse(cell);
      double least = 0;
      std::size_t across = d;
      sum = 0;
      for (std::size_t i = 0; i < d; ++i) {
        double w = 0;
        for (std::size_t j = 0; j < d; ++j) w += inverse[i * d + j] * difference_[j];
        sum += w;
        if (w < least) least = w, across = i;
      }
      if (across == d) return sum;
      cell = cones.hull().neighbors_of(cell)[across];
    }
    return sum;
  }

  /// The weights sum to 1 on the hyperplane: their sum is linear, and its gradient is the sum of the rows.
  double height_of(const double* inverse) const {
    double square = 0;
    for (std::size_t j = 0; j < d_; ++j) {
      double sum = 0;
      for (std::size_t i = 0; i < d_; ++i) sum += inverse[i * d_ + j];
      square += sum * sum;
    }
    return 1 / std::sqrt(square);
  }

  std::vector<Index> corners() const {
    std::vector<Index> result;
    result.reserve(points_.size() * d_);
    const SimplicialHull& hull = state_.hull();
    for (const Index cell : cell_of_)
      for (const Index site : hull.cell(cell))
        result.push_back(kept_[static_cast<std::size_t>(state_.row(site))]);
    return result;
  }

  std::span<const double* const> points_;
  std::size_t d_;
  double tolerance_;
  const std::function<void()>& alive_;
  HullState state_;  // its rows are kept_
  std::vector<Index> kept_;
  std::vector<char> is_kept_;
  std::vector<Index> order_;    // of the walks
  std::vector<Index> cell_of_;  // by point, of the hull of the last round
  std::vector<double> difference_;
};

}  // namespace

GrownChoice grow_choice(std::span<const double* const> points, int dimension, double tolerance,
                        std::span<const Index> required, const std::function<void()>& alive) {
  return Growth(points, dimension, tolerance, alive).run(required);
}

}  // namespace delone::hull
