// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/making/periodic_surroundings.hpp"

#include "base/compiled_dimension.hpp"
#include "periodic/image_search.hpp"
#include "periodic/images.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <cmath>
#include <mutex>
#include <string>

namespace delone::tiles {

using pages::KnownPoints;
using pages::Tile;

namespace {

using periodic::Extent;
using periodic::PeriodicSet;
using periodic::Shift;

std::uint64_t count_shifts(const PeriodicSet& set) {
  std::uint64_t count = 1;  // periodic_set.cpp refuses 2^62
  for (std::size_t i = 0; i < set.rank; ++i) count *= 2 * static_cast<std::uint64_t>(set.period.reach(i)) + 1;
  return count;
}

/// The pages of all tiles, and their translations. Each thread makes those it needs. Their numbers do not
/// depend on the order of first use, so files do not depend on threads.
class TileImages {
 public:
  TileImages(const PeriodicSet& set, const Extent& extent, const PageTree& tree, PageSource& source)
      : set_(set), extent_(extent), tree_(tree), source_(source), shifts_(count_shifts(set)) {
    shift_number(std::vector<std::int32_t>(set.rank, 0));
  }

  const PeriodicSet& set() const { return set_; }
  const Extent& extent() const { return extent_; }
  const PageTree& tree() const { return tree_; }
  PageSource& source() { return source_; }

  /// 0 for k = 0; others in lexicographic order.
  std::uint32_t shift_number(std::span<const std::int32_t> k) {
    std::uint64_t code = 0, zero = 0;
    for (std::size_t i = 0; i < k.size(); ++i) {
      const auto reach = static_cast<std::uint64_t>(set_.period.reach(i)), base = 2 * reach + 1;
      code = code * base + static_cast<std::uint64_t>(k[i] + set_.period.reach(i));
      zero = zero * base + reach;
    }
    const std::uint64_t number = code == zero ? 0 : code < zero ? code + 1 : code;
    const std::lock_guard lock(mutex_);
    if (!shifts_[number]) {
      auto made = std::make_unique<Shift>(Shift{{k.begin(), k.end()},
                                                std::vector<double>(set_.dimension, 0.0),
                                                KnownPoints(tree_.table().num_pages())});
      set_.period.translate(k, made->by.data());
      shifts_[number] = std::move(made);
    }
    return static_cast<std::uint32_t>(number);
  }
  /// REQUIRES a number that shift_number() has returned, to any thread.
  Shift& shift(std::uint32_t number) { return *shifts_[number]; }
  const Shift& shift(std::uint32_t number) const { return *shifts_[number]; }

 private:
  const PeriodicSet& set_;
  const Extent& extent_;
  const PageTree& tree_;
  PageSource& source_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Shift>> shifts_;
};

template <int D>
class PeriodicSearch final : public ForeignSearch {
 public:
  PeriodicSearch(TileImages& images, const Tile& tile)
      : set_(images.set()), search_(images, tile.first_page, tile.last_page) {}

  ForeignAnswer within_sphere(const double* p, const double* center,
                              const IsInConflict& is_in_conflict) override {
    return answer_of(search_.find(p, center, is_in_conflict));
  }
  /// Beyond a facet that is not parallel to the lattice is a translate of p, at least. Beyond another one all
  /// translates of a point are, or none.
  ForeignAnswer beyond_facet(const double* p, const double* normal,
                             const IsInConflict& is_in_conflict) override {
    std::vector<std::int32_t> k(set_.rank, 0);
    std::vector<double> image(p, p + set_.row_size());
    for (std::size_t i = 0; i < set_.rank; ++i)
      for (const std::int32_t sign : {-1, 1}) {
        for (std::size_t j = 0; j < set_.dimension; ++j) image[j] = p[j] + sign * set_.period.vector(i)[j];
        if (!is_in_conflict(image.data())) continue;
        k[i] = sign;
        return answer_of(search_.find_beyond(p, normal, k, is_in_conflict));
      }
    return answer_of(search_.find_beyond(p, normal, k, is_in_conflict));
  }
  std::uint64_t num_pages() const override { return search_.num_pages(); }
  std::uint64_t num_exact() const override { return search_.num_exact(); }

 private:
  static ForeignAnswer answer_of(const periodic::FoundImage& found) {
    return {found.is_open, found.is_waiting, {found.shift, found.place}};
  }

  const PeriodicSet& set_;
  periodic::ImageSearch<D, TileImages> search_;
};

class PeriodicSurroundings final : public Surroundings {
 public:
  PeriodicSurroundings(const PeriodicSet& set, const Extent& extent, const Survey& survey,
                       const PageTree& tree, PageSource& source, std::size_t tile)
      : set_(set),
        extent_(extent),
        survey_(survey),
        tile_(tree.table().tiles[tile]),
        images_(set, extent, tree, source) {}

  StartingPoints starting_points() override {
    StartingPoints start{survey_.landmarks, survey_.landmark_rows,
                         std::vector<std::uint32_t>(survey_.landmark_rows.size(), 0)};
    const std::vector<std::vector<std::int32_t>> shifts = extent_.frame_shifts();
    for (const Extent::Extreme& extreme : extent_.extremes())
      for (const std::vector<std::int32_t>& k : shifts) {
        std::vector<double> image = extreme.point;
        set_.period.translate(k, image.data());
        start.points.insert(start.points.end(), image.begin(), image.end());
        start.rows.push_back(extreme.row);
        start.shifts.push_back(images_.shift_number(k));
      }
    return start;
  }
  std::unique_ptr<ForeignSearch> make_search(double) override {
    std::unique_ptr<ForeignSearch> made;
    internal::with_compiled_dimension<1, 5>(
        set_.dimension, [&](auto d) { made = std::make_unique<PeriodicSearch<d()>>(images_, tile_); });
    return made;
  }
  bool is_within_period(const double* center, double radius) const override {
    for (std::size_t i = 0; i < set_.rank; ++i) {
      const periodic::Extent::Range range = extent_.fractions_in_ball(i, center, radius);
      if (!(range.low > 0 && range.high < 1)) return false;
    }
    return true;
  }
  std::int64_t copy_point(const ForeignPlace& place, double* point) override {
    const auto page = images_.source().find(place.point.page);
    page->copy_point(place.point.slot, point);
    for (std::size_t j = 0; j < set_.dimension; ++j) point[j] += images_.shift(place.shift).by[j];
    return page->rows[place.point.slot];
  }
  void know(const ForeignPlace& place) override {
    images_.shift(place.shift)
        .known.add(place.point.page, place.point.slot, images_.tree().table().page_size(place.point.page));
  }
  bool knows(std::size_t page, std::size_t slot) const override {
    return images_.shift(0).known.contains(page, slot);
  }
  std::span<const std::int32_t> offset(std::uint32_t shift) const override { return images_.shift(shift).k; }
  std::span<const double> translation(std::uint32_t shift) const override { return images_.shift(shift).by; }
  std::size_t rank() const override { return set_.rank; }

 private:
  const PeriodicSet& set_;
  const Extent& extent_;
  const Survey& survey_;
  const Tile& tile_;
  TileImages images_;
};

}  // namespace

void require_few_shifts(const PeriodicSet& set) {
  constexpr std::uint64_t most = std::uint64_t{1} << 20;
  if (count_shifts(set) > most)
    throw Error(
        Errc::unsupported,
        "tiles: the lattice has too many dimensions, or is too flat: " + std::to_string(count_shifts(set)) +
            " translations have to be looked at, and tiles take " + std::to_string(most) + " at most");
}

std::unique_ptr<Surroundings> periodic_surroundings(const PeriodicSet& set, const Extent& extent,
                                                    const Survey& survey, const PageTree& tree,
                                                    PageSource& source, std::size_t tile) {
  return std::make_unique<PeriodicSurroundings>(set, extent, survey, tree, source, tile);
}

}  // namespace delone::tiles
