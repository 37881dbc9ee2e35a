// SPDX-License-Identifier: BSD-3-Clause
// The surroundings of a tile of an open set: the pages of other tiles.
#include "base/compiled_dimension.hpp"
#include "tiles/surroundings.hpp"

namespace delone::tiles {

using pages::Answer;
using pages::KnownPoints;
using pages::PageSearch;
using pages::Question;
using pages::Tile;

namespace {

template <int D>
class OpenSearch final : public ForeignSearch {
 public:
  OpenSearch(const PageTree& tree, PageSource& source, const KnownPoints& known, const Tile& tile,
             double largest_weight)
      : question_(static_cast<std::size_t>(tree.table().dimension), tree.table().weighted),
        search_(tree, source, known, tile.first_page, tile.last_page) {
    question_.set_largest_weight(largest_weight);
  }
  ForeignAnswer within_sphere(const double* p, const double* center,
                              const IsInConflict& is_in_conflict) override {
    question_.ask_within_sphere(p, center);
    return find(is_in_conflict);
  }
  ForeignAnswer beyond_facet(const double* p, const double* normal,
                             const IsInConflict& is_in_conflict) override {
    question_.ask_beyond_facet(p, normal);
    return find(is_in_conflict);
  }
  std::uint64_t num_pages() const override { return search_.num_visited; }
  std::uint64_t num_exact() const override { return search_.num_exact; }

 private:
  ForeignAnswer find(const IsInConflict& is_in_conflict) {
    const Answer answer = search_.find(question_, is_in_conflict);
    return {answer.is_open, answer.is_waiting, {0, answer.place}};
  }

  Question<D> question_;
  PageSearch search_;
};

class OpenSurroundings final : public Surroundings {
 public:
  OpenSurroundings(const Survey& survey, const PageTree& tree, PageSource& source, std::size_t tile)
      : survey_(survey), tree_(tree), source_(source), tile_(tile), known_(tree.table().num_pages()) {}

  StartingPoints starting_points() override {
    return {survey_.landmarks, survey_.landmark_rows,
            std::vector<std::uint32_t>(survey_.landmark_rows.size(), 0)};
  }
  std::unique_ptr<ForeignSearch> make_search(double largest_weight) override {
    std::unique_ptr<ForeignSearch> made;
    internal::with_compiled_dimension<1, 5>(static_cast<std::size_t>(survey_.dimension), [&](auto d) {
      made = std::make_unique<OpenSearch<d()>>(tree_, source_, known_, tree_.table().tiles[tile_],
                                               largest_weight);
    });
    return made;
  }
  bool is_within_period(const double*, double) const override { return true; }
  std::int64_t copy_point(const ForeignPlace& place, double* point) override {
    const auto page = source_.find(place.point.page);
    page->copy_point(place.point.slot, point);
    return page->rows[place.point.slot];
  }
  void know(const ForeignPlace& place) override {
    known_.add(place.point.page, place.point.slot, tree_.table().page_size(place.point.page));
  }
  bool knows(std::size_t page, std::size_t slot) const override { return known_.contains(page, slot); }
  std::span<const std::int32_t> offset(std::uint32_t) const override { return {}; }
  std::span<const double> translation(std::uint32_t) const override { return {}; }
  std::size_t rank() const override { return 0; }

 private:
  const Survey& survey_;
  const PageTree& tree_;
  PageSource& source_;
  const std::size_t tile_;
  KnownPoints known_;
};

}  // namespace

std::unique_ptr<Surroundings> open_surroundings(const Survey& survey, const PageTree& tree,
                                                PageSource& source, std::size_t tile) {
  return std::make_unique<OpenSurroundings>(survey, tree, source, tile);
}

}  // namespace delone::tiles
