// SPDX-License-Identifier: BSD-3-Clause
// The points of a periodic set in pages, and the translations that make images of them: which images are
// known, because a triangulation has them, and with which ones it begins.
#pragma once

#include "pages/page_tree.hpp"
#include "pages/pages.hpp"
#include "periodic/extent.hpp"
#include "periodic/periodic_set.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <unordered_map>
#include <vector>

namespace delone::periodic {

/// Goes to the next of all vectors low_i ≤ k_i ≤ high_i; false after the last one, which leaves the first.
inline bool next_in_range(std::span<std::int32_t> k, std::span<const std::int32_t> low,
                          std::span<const std::int32_t> high) {
  for (std::size_t i = 0; i < k.size(); ++i) {
    if (k[i]++ < high[i]) return true;
    k[i] = low[i];
  }
  return false;
}

/// A point of the set translated by a shift.
struct Image {
  std::uint32_t row = 0, shift = 0;
  friend bool operator==(const Image&, const Image&) = default;
};

/// The translation Σ k_i a_i, and the points whose images by it are known.
struct Shift {
  std::vector<std::int32_t> k;
  std::vector<double> by;
  pages::KnownPoints known;
};

class Images {
 public:
  /// REQUIRES that the set outlives the object.
  explicit Images(const PeriodicSet& set);
  Images(const Images&) = delete;
  Images& operator=(const Images&) = delete;

  const PeriodicSet& set() const { return set_; }
  const pages::PageTable& table() const { return table_; }
  const pages::PageTree& tree() const { return *tree_; }
  pages::PageSource& source() { return source_; }
  const Extent& extent() const { return extent_; }

  /// The number of a shift; 0 is that of k = 0. Shifts are made on first use and stay where they are.
  std::uint32_t shift_number(std::span<const std::int32_t> k);
  Shift& shift(std::uint32_t number) { return *shifts_[number]; }
  const Shift& shift(std::uint32_t number) const { return *shifts_[number]; }
  std::size_t num_shifts() const { return shifts_.size(); }
  /// The coordinates, and the weight, of an image. Exact.
  void copy_image(const Image& image, double* to) const;
  Image image_at(std::uint32_t shift, const pages::PointPlace& place) const {
    return {static_cast<std::uint32_t>(source_.pages[place.page]->rows[place.slot]), shift};
  }

  /// Far images around the box, so that every point of the set is in the interior of the convex hull of all
  /// that is along the lattice: those of Extent::extremes().
  std::vector<Image> frame();
  /// The images of a page that are nearer to the box than about `width` times the distance of neighbors on
  /// that page. They are known from here on.
  std::vector<Image> layer(double width);
  /// All images with f_i in (−known_below(i), 1 + known_above(i)) for all i are known or points of the set.
  double known_below(std::size_t i) const { return known_below_[i]; }
  double known_above(std::size_t i) const { return known_above_[i]; }
  const std::vector<double>& known_below() const { return known_below_; }
  const std::vector<double>& known_above() const { return known_above_; }
  /// From now on these are known, and so are these images.
  void set_known(std::vector<double> below, std::vector<double> above, std::span<const Image> images);
  /// None is known.
  void forget_known();

 private:
  class Source final : public pages::PageSource {
   public:
    std::shared_ptr<const pages::Page> find(std::size_t page) override { return pages[page]; }
    std::vector<std::shared_ptr<const pages::Page>> pages;
  };

  void make_pages();
  void take_layer_of(std::size_t page, double width, std::vector<Image>& images);

  const PeriodicSet& set_;
  pages::PageTable table_;
  Source source_;
  std::unique_ptr<pages::PageTree> tree_;
  Extent extent_;
  std::vector<std::unique_ptr<Shift>> shifts_;
  std::unordered_map<std::uint64_t, std::uint32_t> number_of_code_;
  std::vector<double> known_below_, known_above_;
};

}  // namespace delone::periodic
