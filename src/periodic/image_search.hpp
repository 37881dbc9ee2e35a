// SPDX-License-Identifier: BSD-3-Clause
// The search for the image that a growing sphere through a point of the set meets first: the question of
// pages/question.hpp, asked in each translated copy of the pages that the sphere may reach. Points of a tile
// ask, too, for those of other tiles: the copy that is not translated.
//
// Which copies. The part of a ball of center c and radius R between two planes orthogonal to a free direction
// is within √(R² − h²) of c along the lattice, h the distance of c from the planes. With c − p = λ(a + b), a
// along the lattice and b in the free directions, p between the planes and t from the one that c is beyond,
// that is λ²|a|² + Σ t(2λ|b_i| − t), where a free direction with λ|b_i| ≤ t adds λ²b_i² instead. So a huge
// ball that only just reaches the set is no reason to look far. Fractions of what it has are within that
// times |g_i| of those of c. All of this is rounded, and widened by much more than its errors.
//
// In a box of few points these are (2R)^r copies, and the ball is a small part of them. So translations are
// chosen from the last to the first, in orthonormal directions e_i in which a_j has no component for j < i.
// Once k_i … are chosen, the distance of c from the points of the copy along e_i … is fixed. Where it exceeds
// the radius, no choice of the others will do (Fincke and Pohst 1985, doi:10.1090/S0025-5718-1985-0777278-8).
#pragma once

#include "base/progress_meter.hpp"
#include "base/stamped_table.hpp"
#include "periodic/images.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace delone::periodic {

struct FoundImage {
  bool is_open = false;
  bool is_waiting = false;  ///< a page that may hold a better one is not here yet
  std::uint32_t shift = 0;
  pages::PointPlace place;
};

/// `Copies`: Images, or what a tile has instead.
template <int D, class Copies>
class ImageSearch {
 public:
  /// The points that ask are those of the pages first … last − 1.
  ImageSearch(Copies& images, std::size_t first, std::size_t last)
      : images_(images),
        extent_(images.extent()),
        set_(images.set()),
        has_others_(first > 0 || last < images.tree().table().num_pages()),
        question_(set_.dimension, set_.weighted),
        search_(images.tree(), images.source(), untranslated_known(), 0, 0),
        search_of_others_(images.tree(), images.source(), untranslated_known(), first, last),
        moved_p_(set_.row_size()),
        moved_c_(set_.dimension),
        image_(set_.row_size()),
        fraction_of_p_(set_.rank),
        step_(set_.rank),
        slack_(set_.rank),
        k_(set_.rank),
        low_(set_.rank),
        high_(set_.rank),
        steps_(set_.rank * set_.rank),
        of_p_(set_.rank),
        of_step_(set_.rank),
        at_(set_.rank),
        beyond_(extent_.num_free_directions()),
        depth_(extent_.num_free_directions()) {
    question_.set_largest_weight(extent_.weight_range());
    for (std::size_t i = 0; i < set_.rank; ++i)
      for (std::size_t j = 0; j < set_.rank; ++j) steps_[i * set_.rank + j] = along(i, set_.period.vector(j));
    for (const double largest : set_.largest) size_ += largest;
  }

  /// For a cell of this center, correctly rounded, and a vertex p of it that is a point of the set.
  /// `is_in_conflict(x)` decides where rounded numbers do not.
  template <class Exact>
  FoundImage find(const double* p, const double* center, const Exact& is_in_conflict) {
    measure(p, center);
    const double start = set_.period.shortest() / 2;
    double part = radius_ <= start || !std::isfinite(radius_) ? 1 : start / radius_;
    FoundImage found;
    pages::Answer best;
    asked_.clear(1);
    for (;; part = std::min(1.0, 2 * part)) {
      find_range(part);
      for (std::size_t i = 0; i < set_.rank; ++i) at_[i] = of_p_[i] + part * of_step_[i];
      each_shift(set_.rank, 0, [&] {
        if (has_others_ || !is_zero(k_)) ask(p, center, is_in_conflict, best, found);
      });
      found.is_waiting = best.is_waiting;
      if (found.is_open || found.is_waiting || part == 1) return found;
    }
  }
  /// Beyond a facet with the vertex p and this outward unit normal, with an error below 1e-12, in the copy
  /// that is translated by k.
  template <class Exact>
  FoundImage find_beyond(const double* p, const double* normal, std::span<const std::int32_t> k,
                         const Exact& is_in_conflict) {
    k_.assign(k.begin(), k.end());
    pages::Answer best;
    FoundImage found;
    ask_in_copy(p, is_in_conflict, best, found,
                [&](const Shift&) { question_.ask_beyond_facet(moved_p_.data(), normal); });
    found.is_waiting = best.is_waiting;
    return found;
  }

  std::uint64_t num_pages() const { return search_.num_visited + search_of_others_.num_visited; }
  std::uint64_t num_exact() const { return search_.num_exact + search_of_others_.num_exact; }

 private:
  double along(std::size_t i, const double* x) const {
    double sum = 0;
    for (std::size_t j = 0; j < set_.dimension; ++j) sum += extent_.lattice_direction(i)[j] * x[j];
    return sum;
  }

  /// Calls visit() with all k_ in the range whose copies may have points in the ball; those from `chosen` on
  /// are chosen, and have copies at this squared distance at least.
  template <class Visit>
  void each_shift(std::size_t chosen, double squared, const Visit& visit) {
    if (chosen == 0) {
      visit();
      return;
    }
    const std::size_t i = chosen - 1;
    for (k_[i] = low_[i]; k_[i] <= high_[i]; ++k_[i]) {
      internal::cancellation_point();
      double at = at_[i];
      for (std::size_t j = i; j < set_.rank; ++j) at -= k_[j] * steps_[i * set_.rank + j];
      const double apart =
          std::max({extent_.lattice_low(i) - at, at - extent_.lattice_high(i), 0.0}) - slack_of_distance_;
      const double sum = squared + (apart > 0 ? apart * apart : 0.0);
      if (sum > squared_radius_) continue;
      each_shift(i, sum, visit);
    }
  }

  /// What find_range() needs of p and c.
  void measure(const double* p, const double* c) {
    const std::size_t d = set_.dimension;
    const Period& period = set_.period;
    double squared = 0;
    along_ = 0;
    for (std::size_t j = 0; j < d; ++j) squared += (c[j] - p[j]) * (c[j] - p[j]);
    radius_ = std::sqrt(squared);
    double along_slack = 0, lateral = 0, magnitude_of_c = size_;
    for (std::size_t j = 0; j < d; ++j) {
      moved_c_[j] = c[j] - p[j];
      magnitude_of_c += std::abs(c[j]);
    }
    slack_of_distance_ = 0x1p-40 * magnitude_of_c;
    for (std::size_t i = 0; i < set_.rank; ++i) {
      of_p_[i] = along(i, p);
      of_step_[i] = along(i, moved_c_.data());
    }
    for (std::size_t i = 0; i < set_.rank; ++i) {
      double step = 0, magnitude = 0;
      for (std::size_t j = 0; j < d; ++j) {
        step += period.gradient(i)[j] * (c[j] - p[j]);
        magnitude += std::abs(period.gradient(i)[j]) * (std::abs(c[j]) + std::abs(p[j]));
      }
      step_[i] = step;
      fraction_of_p_[i] = period.fraction(i, p);
      slack_[i] = 0x1p-44 * magnitude + 2 * extent_.fraction_slack(i);
      along_slack += slack_[i] / period.gradient_length(i);
    }
    for (std::size_t j = 0; j < d; ++j) {
      double coordinate = 0;
      for (std::size_t i = 0; i < set_.rank; ++i) {
        coordinate += step_[i] * period.vector(i)[j];
        along_slack +=
            0x1p-44 * std::abs(step_[i] * period.vector(i)[j]) + slack_[i] * std::abs(period.vector(i)[j]);
      }
      lateral += coordinate * coordinate;
    }
    along_ = std::sqrt(lateral) + along_slack;
    for (std::size_t i = 0; i < beyond_.size(); ++i) {
      double b = 0, at = 0;
      for (std::size_t j = 0; j < d; ++j) {
        b += extent_.free_direction(i)[j] * (c[j] - p[j]);
        at += extent_.free_direction(i)[j] * p[j];
      }
      beyond_[i] = std::abs(b) + 0x1p-44 * radius_;
      depth_[i] = std::max(b >= 0 ? extent_.high(i) - at : at - extent_.low(i), 0.0);
      // A direction that rounding may turn to the other side.
      if (std::abs(b) <= 0x1p-44 * radius_) depth_[i] = extent_.high(i) - extent_.low(i);
    }
    gain_ = set_.weighted ? std::max(extent_.largest_weight() - p[d], 0.0) : 0.0;
  }

  /// The shifts with images that the ball around p + part·(c − p) may have.
  void find_range(double part) {
    double squared = part * along_ * part * along_ + gain_;
    for (std::size_t i = 0; i < beyond_.size(); ++i) {
      const double b = part * beyond_[i], t = depth_[i];
      squared += b <= t ? b * b : t * (2 * b - t);
    }
    const double radius = std::sqrt(squared) * (1 + 0x1p-30);
    squared_radius_ = radius * radius;
    for (std::size_t i = 0; i < set_.rank; ++i) {
      const int reach = set_.period.reach(i);
      const double middle = fraction_of_p_[i] + part * step_[i],
                   width = radius * set_.period.gradient_length(i) + slack_[i];
      const double low = std::floor(middle - width), high = std::floor(middle + width);
      // Comparisons with NaN are false.
      low_[i] = low > -reach ? static_cast<std::int32_t>(std::min<double>(low, reach)) : -reach;
      high_[i] = high < reach ? static_cast<std::int32_t>(std::max<double>(high, -reach)) : reach;
    }
  }

  template <class Exact>
  void ask(const double* p, const double* c, const Exact& is_in_conflict, pages::Answer& best,
           FoundImage& found) {
    // A copy that a smaller part of the ball has asked has nothing for the whole ball.
    if (!asked_.insert(images_.shift_number(k_), 0).second) return;
    ask_in_copy(p, is_in_conflict, best, found, [&](const Shift& shift) {
      for (std::size_t j = 0; j < set_.dimension; ++j) moved_c_[j] = c[j] - shift.by[j];
      question_.ask_within_moved_sphere(moved_p_.data(), moved_c_.data(), c);
    });
  }
  /// In the copy of k_. put_question(shift) puts it where the copy is not translated.
  template <class Exact, class PutQuestion>
  void ask_in_copy(const double* p, const Exact& is_in_conflict, pages::Answer& best, FoundImage& found,
                   const PutQuestion& put_question) {
    const std::uint32_t number = images_.shift_number(k_);
    const Shift& shift = images_.shift(number);
    const std::size_t d = set_.dimension;
    for (std::size_t j = 0; j < d; ++j) moved_p_[j] = p[j] - shift.by[j];
    if (set_.weighted) moved_p_[d] = p[d];
    put_question(shift);
    const pages::Answer before = best;
    best = (is_zero(k_) ? search_of_others_ : search_)
               .find_better(
                   question_,
                   [&](const double* x) {
                     std::copy_n(x, image_.size(), image_.data());
                     for (std::size_t j = 0; j < d; ++j) image_[j] += shift.by[j];
                     return is_in_conflict(image_.data());
                   },
                   shift.known, best);
    if (!best.is_open || (found.is_open && best.key == before.key && best.place == before.place)) return;
    found = {true, false, number, best.place};
  }

  static bool is_zero(std::span<const std::int32_t> k) {
    return std::all_of(k.begin(), k.end(), [](std::int32_t one) { return one == 0; });
  }
  /// Searches are told for each question what is known.
  const pages::KnownPoints& untranslated_known() {
    const std::uint32_t number = images_.shift_number(std::vector<std::int32_t>(set_.rank, 0));
    return images_.shift(number).known;
  }

  Copies& images_;
  const Extent& extent_;
  const PeriodicSet& set_;
  const bool has_others_;  // points in other pages
  pages::Question<D> question_;
  pages::PageSearch search_, search_of_others_;
  std::vector<double> moved_p_, moved_c_, image_;
  std::vector<double> fraction_of_p_, step_, slack_;  // of c − p, by the axes of the lattice
  std::vector<std::int32_t> k_, low_, high_;
  std::vector<double> steps_, of_p_, of_step_, at_;  // a_j, p, c − p and the center along e_i
  std::vector<double> beyond_, depth_;               // |b_i| and t, by free directions
  internal::StampedTable asked_;                     // shifts of this find()
  double radius_ = 0, along_ = 0, gain_ = 0, squared_radius_ = 0, slack_of_distance_ = 0, size_ = 0;
};

}  // namespace delone::periodic
