// SPDX-License-Identifier: BSD-3-Clause
// Searches in the tree of pages against all points.
#include "../tiles/test_pages.hpp"
#include "degenerate.hpp"

#include <delone/point_sets.hpp>

#include <gtest/gtest.h>

namespace {

using namespace delone_test;

/// Of the points outside the tile, not known, and in conflict the one of the least key.
TEST(PageTree, FindsTheFirstPoint) {
  test::Random random(4);
  for (const std::size_t num_tiles : {1, 3, 9})
    for (int d = 2; d <= 4; ++d) {
      TestPages pages(make_point_set("uniform", d, 700, 2), d, num_tiles);
      const PageTree tree(pages.table);
      KnownPoints known(pages.table.num_pages());
      known.add(pages.table.num_pages() - 1, 0, pages.find(pages.table.num_pages() - 1)->size());
      for (int repeat = 0; repeat < 60; ++repeat) {
        const Tile& tile = pages.table.tiles[static_cast<std::size_t>(repeat) % num_tiles];
        PageSearch search(tree, pages, known, tile.first_page, tile.last_page);
        const std::vector<double> own = pages.own(static_cast<std::size_t>(repeat) % num_tiles).points;
        std::vector<double> center;
        for (int j = 0; j < d; ++j) center.push_back(own[static_cast<std::size_t>(j)] + random.real() - 0.5);
        Question<0> question(static_cast<std::size_t>(d), false);
        question.ask_within_sphere(own.data(), center.data());
        const Answer answer = search.find(question, [](const double*) { return false; });
        bool is_open = false;
        double least = 0;
        std::vector<double> x(static_cast<std::size_t>(d));
        for (std::size_t page = 0; page < pages.table.num_pages(); ++page) {
          if (page >= tile.first_page && page < tile.last_page) continue;
          for (std::size_t i = 0; i < pages.find(page)->size(); ++i) {
            pages.find(page)->copy_point(i, x.data());
            if (known.contains(page, i) || question.side(x.data()) != QuestionSide::inside) continue;
            least = is_open ? std::min(least, question.key(x.data())) : question.key(x.data());
            is_open = true;
          }
        }
        ASSERT_EQ(answer.is_open, is_open);
        if (is_open) {
          ASSERT_EQ(answer.key, least);
        }
        EXPECT_FALSE(answer.is_waiting);
      }
    }
}

TEST(PageTree, WaitsForPages) {
  class NoPages final : public PageSource {
   public:
    std::shared_ptr<const Page> find(std::size_t page) override {
      wanted.push_back(page);
      return nullptr;
    }
    std::vector<std::size_t> wanted;
  };
  TestPages pages(make_point_set("uniform", 2, 500, 1), 2, 2);
  NoPages nothing;
  const PageTree tree(pages.table);
  const KnownPoints known(pages.table.num_pages());
  PageSearch search(tree, nothing, known, 0, pages.table.tiles[0].last_page);
  const std::vector<double> p{0.5, 0.5}, center{0.6, 0.6};
  Question<2> question(2, false);
  question.ask_within_sphere(p.data(), center.data());
  const Answer answer = search.find(question, [](const double*) { return false; });
  EXPECT_TRUE(answer.is_waiting);
  EXPECT_FALSE(nothing.wanted.empty());
  for (const std::size_t page : nothing.wanted) EXPECT_GE(page, pages.table.tiles[1].first_page);
}

}  // namespace
