// SPDX-License-Identifier: BSD-3-Clause
// A time step: the points of a set have moved, most of them little, and a copy of the triangulation with
// ghosts follows.
//
// Each point goes on as the translate that is nearest to where it was, and its images with it. So a point
// that leaves the box becomes an image, and the image that comes in on the other side becomes the point. Any
// choice of names would do: the cells are those of the points that are there, whatever they are called, and
// the questions that follow certify them as they do after a construction.
//
// What is known beside the box. Let fractions of all points but some, the far ones, change by δ_i at most.
// Then an image of another point that has f_i in (−b_i + δ_i, 1 + c_i − δ_i) has come from (−b_i, 1 + c_i),
// where all images were known, so it is known. Images of far points in this range are inserted.
#include "periodic/ghost_triangulation.hpp"

#include "base/progress_meter.hpp"
#include "base/quick_rounds.hpp"
#include "kernel/predicates.hpp"
#include "triangulation/stored_points.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace delone::periodic {

class GhostTriangulation::Step {
 public:
  Step(GhostTriangulation& to, const GhostTriangulation& from)
      : to_(to),
        from_(from),
        set_(to.set_),
        before_(from.set_),
        images_(to.images_),
        n_(set_.num_points()),
        r_(set_.rank),
        most_new_(64 + n_ / 16) {}

  /// Whether much had been done before it was given up.
  bool has_begun() const { return has_begun_; }
  /// Returns false if a new construction is called for; `to` may have changed then.
  bool run() {
    if (!is_of_one_kind() || !find_translations() || !find_known() || !name_rows() || !is_promising())
      return false;
    has_begun_ = true;
    to_.made_.emplace(from_.made_->clone());
    if (!move_rows()) return false;
    insert_missing();
    if (!has_few_ghosts()) return false;
    images_.set_known(below_, above_, to_.image_of_row_);
    to_.enter_vertices();
    if (!to_.ask_and_insert(most_new_)) return false;
    to_.origin_ = from_.identity_;
    to_.num_constructed_ = from_.num_constructed_;
    to_.constructed_below_ = from_.constructed_below_;
    to_.constructed_above_ = from_.constructed_above_;
    return true;
  }

 private:
  /// Whether multiples of reduced lattice vectors mean the same before and after, and there is a
  /// triangulation that is worth a copy.
  bool is_of_one_kind() const {
    return n_ > 0 && n_ == before_.num_points() && set_.weighted == before_.weighted &&
           set_.dimension == before_.dimension && r_ == before_.rank && set_.scale == before_.scale &&
           set_.unit == before_.unit && set_.sums == before_.sums;
  }

  /// For each point the translate that is nearest to where it was, and which points are far from there.
  bool find_translations() {
    translations_.resize(n_ * r_);
    is_far_.assign(n_, 0);
    largest_step_.assign(r_, 0.0);
    constexpr double far = 1.0 / 8;
    std::size_t num_far = 0;
    internal::QuickRounds round;
    std::vector<double> steps(r_);
    for (std::size_t row = 0; row < n_; ++row) {
      round();
      for (std::size_t i = 0; i < r_; ++i) {
        const double apart =
            before_.period.fraction(i, before_.row(row)) - set_.period.fraction(i, set_.row(row));
        const double nearest = std::nearbyint(apart);
        translations_[row * r_ + i] = static_cast<std::int32_t>(nearest);
        steps[i] = std::abs(apart - nearest);
        const double known = std::min(from_.images_.known_below(i), from_.images_.known_above(i));
        if (known > 0 && steps[i] > far * known) is_far_[row] = 1;
      }
      num_far += is_far_[row];
      if (is_far_[row] == 0)
        for (std::size_t i = 0; i < r_; ++i) largest_step_[i] = std::max(largest_step_[i], steps[i]);
    }
    return num_far <= most_new_;
  }

  /// Returns false if too little is known after many steps.
  bool find_known() {
    for (std::size_t i = 0; i < r_; ++i) {
      const double lost = largest_step_[i] +
                          8 * (images_.extent().fraction_slack(i) + from_.images_.extent().fraction_slack(i));
      below_.push_back(std::max(from_.images_.known_below(i) - lost, 0.0));
      above_.push_back(std::max(from_.images_.known_above(i) - lost, 0.0));
      if (below_[i] < from_.constructed_below_[i] / 2 || above_[i] < from_.constructed_above_[i] / 2)
        return false;
    }
    return true;
  }

  /// Which image each row of the triangulation is from now on. Returns false if one is too far away.
  bool name_rows() {
    constexpr auto unknown = std::uint32_t(-1);
    std::vector<std::uint32_t> same_shift(from_.images_.num_shifts(), unknown);
    to_.own_row_.assign(n_, unknown);
    to_.image_of_row_.clear();
    to_.image_of_row_.reserve(from_.image_of_row_.size());
    std::vector<std::int32_t> k(r_);
    internal::QuickRounds round;
    for (const Image& image : from_.image_of_row_) {
      round();
      const std::int32_t* const by = translations_.data() + std::size_t{image.row} * r_;
      const bool stays = std::all_of(by, by + r_, [](std::int32_t one) { return one == 0; });
      std::uint32_t number = stays ? same_shift[image.shift] : unknown;
      if (number == unknown) {
        const std::vector<std::int32_t>& was = from_.images_.shift(image.shift).k;
        for (std::size_t i = 0; i < r_; ++i) {
          k[i] = was[i] + by[i];
          if (std::abs(k[i]) > set_.period.reach(i)) return false;
        }
        number = images_.shift_number(k);
        if (stays) same_shift[image.shift] = number;
      }
      if (number == 0) to_.own_row_[image.row] = static_cast<std::uint32_t>(to_.image_of_row_.size());
      to_.image_of_row_.push_back({image.row, number});
    }
    const auto num_missing =
        static_cast<std::size_t>(std::count(to_.own_row_.begin(), to_.own_row_.end(), unknown));
    return num_missing <= most_new_;
  }

  /// Whether few cells of a sample are not Delaunay any more, by the measure of the engine
  /// (engine/hole/relocation.hpp). Asked before anything is copied.
  bool is_promising() const {
    const Complex complex = from_.triangulation().complex();
    const auto k = static_cast<std::size_t>(std::max(complex.affine_dimension(), 0));
    if (k < set_.dimension) return true;
    const std::vector<int> axes = from_.triangulation().axes();
    const auto& points = triangulation::StoredPoints::of(from_.triangulation());
    const kernel::Flat flat{points.ambient, axes, points.form};
    constexpr std::size_t most = 512;
    const std::size_t step = complex.num_cell_slots() / most + 1, width = set_.row_size();
    std::vector<double> corners((k + 1) * width), apex(width);
    std::vector<const double*> simplex;
    for (std::size_t i = 0; i <= k; ++i) simplex.push_back(corners.data() + i * width);
    std::size_t num_tested = 0, num_bad = 0;
    for (std::size_t slot = 0; slot < complex.num_cell_slots(); slot += step) {
      const CellId cell{static_cast<Index>(slot)};
      if (!complex.is_cell(cell) || complex.is_infinite(cell)) continue;
      internal::cancellation_point();
      for (std::size_t i = 0; i <= k; ++i)
        copy_moved(complex.vertex(cell, static_cast<int>(i)), corners.data() + i * width);
      bool is_good = kernel::orientation(flat, simplex) == Sign::positive;
      for (int i = 0; i <= complex.affine_dimension() && is_good; ++i) {
        const VertexId v = complex.vertex(complex.neighbor(cell, i), complex.mirror_index(cell, i));
        if (v == infinite_vertex) continue;
        copy_moved(v, apex.data());
        const bool is_there = std::any_of(simplex.begin(), simplex.end(), [&](const double* corner) {
          return std::equal(apex.begin(), apex.end(), corner);
        });
        is_good = !is_there &&
                  kernel::in_sphere_perturbed(flat, simplex, Sign::positive, apex.data()) != Sign::negative;
      }
      ++num_tested;
      num_bad += is_good ? 0 : 1;
    }
    return num_bad * 8 * k <= num_tested;
  }
  /// The point that a vertex gets.
  void copy_moved(VertexId v, double* to) const {
    const Image& image = from_.image_of(v);
    std::copy_n(set_.row(image.row), set_.row_size(), to);
    std::vector<std::int32_t> k(from_.images_.shift(image.shift).k);
    for (std::size_t i = 0; i < r_; ++i) k[i] += translations_[std::size_t{image.row} * r_ + i];
    set_.period.translate(k, to);
  }

  /// Points that are not far move all at once, and then the others: far moves leave no cell as it was.
  bool move_rows() { return move_rows(false) && move_rows(true); }
  bool move_rows(bool far) {
    const std::size_t d = set_.dimension, count = to_.image_of_row_.size();
    std::vector<std::size_t> rows;
    std::vector<double> points, weights, x(set_.row_size());
    rows.reserve(far ? 0 : count);
    points.reserve(far ? 0 : count * d);
    internal::QuickRounds round;
    for (std::size_t row = 0; row < count; ++row) {
      round();
      const Image& image = to_.image_of_row_[row];
      if ((is_far_[image.row] != 0) != far) continue;
      images_.copy_image(image, x.data());
      rows.push_back(row);
      points.insert(points.end(), x.begin(), x.begin() + static_cast<std::ptrdiff_t>(d));
      if (set_.weighted) weights.push_back(x[d]);
    }
    if (rows.empty()) return true;
    construction::RowEdits edits{.move = rows, .to = points, .weights = weights};
    if (set_.weighted) edits.reweight = rows;
    return triangulation::StoredPoints::edit_in_place(to_.made_->get(), edits);
  }

  /// Points that no row of the triangulation is, and images of far points that are to be known.
  void insert_missing() {
    std::vector<Image> missing;
    for (std::uint32_t row = 0; row < n_; ++row)
      if (to_.own_row_[row] == std::uint32_t(-1)) {
        to_.own_row_[row] = static_cast<std::uint32_t>(to_.image_of_row_.size() + missing.size());
        missing.push_back({row, 0});
      }
    std::vector<std::pair<std::uint32_t, std::uint32_t>> there;
    for (const Image& image : to_.image_of_row_)
      if (is_far_[image.row] != 0) there.emplace_back(image.row, image.shift);
    std::sort(there.begin(), there.end());
    std::vector<std::int32_t> k(r_), low(r_, -1), high(r_, 1);
    for (std::uint32_t row = 0; row < n_; ++row) {
      if (is_far_[row] == 0) continue;
      k = low;
      do {
        if (!is_to_be_known(row, k)) continue;
        const std::uint32_t shift = images_.shift_number(k);
        if (shift != 0 && !std::binary_search(there.begin(), there.end(), std::pair(row, shift)))
          missing.push_back({row, shift});
      } while (next_in_range(k, low, high));
    }
    std::vector<double> x(set_.row_size());
    for (const Image& image : missing) {
      images_.copy_image(image, x.data());
      to_.made_->insert_row(x, std::nullopt);
      to_.image_of_row_.push_back(image);
    }
  }
  bool is_to_be_known(std::uint32_t row, std::span<const std::int32_t> k) const {
    for (std::size_t i = 0; i < r_; ++i) {
      const double at = set_.period.fraction(i, set_.row(row)) + k[i],
                   slack = 8 * images_.extent().fraction_slack(i) + 0x1p-50;
      if (at <= -below_[i] - slack || at >= 1 + above_[i] + slack) return false;
    }
    return true;
  }

  /// Ghosts that are not needed any more stay, until there are too many.
  bool has_few_ghosts() const {
    return to_.image_of_row_.size() <= from_.num_constructed_ + (from_.num_constructed_ - n_) / 4 + most_new_;
  }

  GhostTriangulation& to_;
  const GhostTriangulation& from_;
  const PeriodicSet &set_, &before_;
  Images& images_;
  const std::size_t n_, r_, most_new_;
  std::vector<std::int32_t> translations_;  // n×r: the point as its own image goes on as this image
  std::vector<std::uint8_t> is_far_;        // by row
  std::vector<double> largest_step_;        // of a fraction, of points that are not far
  std::vector<double> below_, above_;       // what is known now
  bool has_begun_ = false;
};

bool GhostTriangulation::step_from(const GhostTriangulation& before) {
  // Steps of one run are much alike. So after a repair has failed, some steps are not tried: about twice as
  // many after each further failure.
  constexpr std::uint32_t most = 5;
  if (before.num_skipped_ + 1 < std::uint32_t{1} << before.num_failures_) {
    num_failures_ = before.num_failures_;
    num_skipped_ = before.num_skipped_ + 1;
    return false;
  }
  Step step(*this, before);
  if (step.run()) return true;
  num_failures_ = step.has_begun() ? std::min(before.num_failures_ + 1, most) : 0;
  return false;
}

}  // namespace delone::periodic
