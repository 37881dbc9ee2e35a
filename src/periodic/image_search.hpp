// SPDX-License-Identifier: BSD-3-Clause
// The search for the image that a growing sphere through a point of the set meets first: the question of
// pages/question.hpp, asked in each translated copy of the pages that the sphere may reach. Points of a tile
// ask, too, for those of other tiles: the copy that is not translated.
#pragma once

#include "base/stamped_table.hpp"
#include "periodic/images.hpp"
#include "periodic/shifts_in_ball.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
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
        set_(images.set()),
        has_others_(first > 0 || last < images.tree().table().num_pages()),
        in_ball_(set_, images.extent()),
        question_(set_.dimension, set_.weighted),
        search_(images.tree(), images.source(), untranslated_known(), 0, 0),
        search_of_others_(images.tree(), images.source(), untranslated_known(), first, last),
        moved_p_(set_.row_size()),
        moved_c_(set_.dimension),
        image_(set_.row_size()) {
    question_.set_largest_weight(images.extent().weight_range());
  }

  /// For a cell of this center, correctly rounded, and a vertex p of it that is a point of the set.
  /// `is_in_conflict(x)` decides where rounded numbers do not.
  template <class Exact>
  FoundImage find(const double* p, const double* center, const Exact& is_in_conflict) {
    in_ball_.set_ball(p, center);
    const double start = set_.period.shortest() / 2, radius = in_ball_.radius();
    double part = radius <= start || !std::isfinite(radius) ? 1 : start / radius;
    FoundImage found;
    pages::Answer best;
    asked_.clear(1);
    for (;; part = std::min(1.0, 2 * part)) {
      in_ball_.each(part, [&](std::span<const std::int32_t> k) {
        const bool is_translated = !is_zero(k);
        if (!is_translated && !has_others_) return;
        const std::uint32_t number = images_.shift_number(k);
        // A copy that a smaller part of the ball has asked has nothing for the whole ball.
        if (!asked_.insert(number, 0).second) return;
        const Shift& shift = move(p, number);
        for (std::size_t j = 0; j < set_.dimension; ++j) moved_c_[j] = center[j] - shift.by[j];
        question_.ask_within_moved_sphere(moved_p_.data(), moved_c_.data(), center);
        ask_in_copy(number, is_translated, is_in_conflict, best, found);
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
    const std::uint32_t number = images_.shift_number(k);
    pages::Answer best;
    FoundImage found;
    move(p, number);
    question_.ask_beyond_facet(moved_p_.data(), normal);
    ask_in_copy(number, !is_zero(k), is_in_conflict, best, found);
    found.is_waiting = best.is_waiting;
    return found;
  }

  std::uint64_t num_pages() const { return search_.num_visited + search_of_others_.num_visited; }
  std::uint64_t num_exact() const { return search_.num_exact + search_of_others_.num_exact; }

 private:
  /// Moves p to where this copy is not translated.
  const Shift& move(const double* p, std::uint32_t number) {
    const Shift& shift = images_.shift(number);
    const std::size_t d = set_.dimension;
    for (std::size_t j = 0; j < d; ++j) moved_p_[j] = p[j] - shift.by[j];
    if (set_.weighted) moved_p_[d] = p[d];
    return shift;
  }
  /// Of this copy, what question_ asks for where the copy is not translated.
  template <class Exact>
  void ask_in_copy(std::uint32_t number, bool is_translated, const Exact& is_in_conflict, pages::Answer& best,
                   FoundImage& found) {
    const Shift& shift = images_.shift(number);
    const pages::Answer before = best;
    best = (is_translated ? search_ : search_of_others_)
               .find_better(
                   question_,
                   [&](const double* x) {
                     std::copy_n(x, image_.size(), image_.data());
                     for (std::size_t j = 0; j < set_.dimension; ++j) image_[j] += shift.by[j];
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
  const PeriodicSet& set_;
  const bool has_others_;  // points in other pages
  ShiftsInBall in_ball_;
  pages::Question<D> question_;
  pages::PageSearch search_, search_of_others_;
  std::vector<double> moved_p_, moved_c_, image_;
  internal::StampedTable asked_;  // shifts of this find()
};

}  // namespace delone::periodic
