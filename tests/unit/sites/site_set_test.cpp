// SPDX-License-Identifier: BSD-3-Clause
// Rows and vertices: whatever is done, a model of two maps tells the same; a journal brings back what was.
#include "sites/site_set.hpp"

#include "base/random.hpp"

#include <delone/error.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace delone::sites {
namespace {

/// Rows by vertex, and points by vertex.
struct Model {
  std::map<Index, std::set<std::size_t>> rows;
  std::map<Index, double> points;
  std::size_t num_rows = 0;
};

void expect_same(SiteSet& sites, const Model& model) {
  ASSERT_EQ(sites.num_rows(), model.num_rows);
  std::size_t num_present = 0;
  for (Index v = 1; v < sites.num_ids(); ++v) {
    const auto found = model.rows.find(v);
    const bool has_rows = found != model.rows.end() && !found->second.empty();
    ASSERT_EQ(sites.has_rows(v), has_rows) << v;
    ASSERT_EQ(*sites.point(v), model.points.at(v)) << v;
    if (!has_rows) continue;
    EXPECT_EQ(sites.row_of(v), *found->second.begin());
    EXPECT_EQ(sites.has_several(v), found->second.size() > 1);
    for (const std::size_t row : found->second) EXPECT_EQ(sites.vertex_of(row), VertexId{v});
    num_present += found->second.size();
  }
  EXPECT_EQ(sites.num_present_rows(), num_present);
}

class Random {
 public:
  explicit Random(std::uint64_t seed) : random_(seed) {}
  std::size_t below(std::size_t n) {
    return static_cast<std::size_t>(random_.uniform() * static_cast<double>(n));
  }
  double number() { return random_.uniform(); }

 private:
  random::Generator random_;
};

/// One random operation on both.
void step(SiteSet& sites, Model& model, Random& random, bool on_record) {
  std::vector<std::size_t> present;
  for (const auto& [v, rows] : model.rows) present.insert(present.end(), rows.begin(), rows.end());
  const std::size_t what = random.below(10);
  if (what < 5 || present.empty()) {  // a row, at a new vertex or an old one
    const std::size_t row = sites.add_rows(1);
    Index v = invalid_index;
    if (what < 2 && !present.empty()) {
      v = index(sites.vertex_of(present[random.below(present.size())]));
    } else {
      const double x = random.number();
      v = sites.points().append(&x);
      model.points[v] = x;
    }
    sites.assign(row, v);
    model.rows[v].insert(row);
    ++model.num_rows;
    return;
  }
  const std::size_t row = present[random.below(present.size())];
  const Index v = index(sites.vertex_of(row));
  if (what < 7) {
    sites.detach(row);
    model.rows[v].erase(row);
  } else if (what < 8) {
    const Index into = index(sites.vertex_of(present[random.below(present.size())]));
    if (into == v) return;
    sites.merge(v, into);
    model.rows[into].merge(model.rows[v]);
    model.rows[v].clear();
  } else if (on_record) {
    const double x = random.number();
    sites.move(v, &x);
    model.points[v] = x;
  }
}

TEST(SiteSet, DoesWhatAModelDoesAndGoesBack) {
  Random random(1);
  for (int round = 0; round < 40; ++round) {
    SiteSet sites(1, kernel::RowForm::point);
    Model model;
    for (int i = 0; i < 30; ++i) step(sites, model, random, false);
    expect_same(sites, model);
    for (int time = 0; time < 5; ++time) {
      const Model before = model;
      Journal journal;
      sites.begin(journal);
      for (int i = 0; i < 20; ++i) step(sites, model, random, true);
      expect_same(sites, model);
      if (time % 2 == 0) {
        sites.roll_back(journal);
        model = before;
      } else {
        sites.end();
      }
      expect_same(sites, model);
    }
  }
}

TEST(SiteSet, PutsManyRowsAtVerticesAtOnce) {
  for (const unsigned threads : {1u, 3u}) {
    SiteSet sites(1, kernel::RowForm::point);
    const double x = 0;
    sites.points().append(&x);
    sites.assign(sites.add_rows(1), 1);
    const std::vector<Index> order{2, 0, 1};
    const std::size_t first_row = sites.add_rows(3);
    for (int i = 0; i < 3; ++i) sites.points().append(&x);
    sites.assign_in_order(order, first_row, 2, threads);
    EXPECT_EQ(sites.num_present_rows(), 4u);
    EXPECT_EQ(sites.vertex_of(3), VertexId{2});
    EXPECT_EQ(sites.vertex_of(1), VertexId{3});
    EXPECT_EQ(sites.vertex_of(2), VertexId{4});
    EXPECT_EQ(sites.row_of(2), 3u);
  }
}

TEST(SiteSet, ClosesGapsOrChangesNothing) {
  SiteSet sites(2, kernel::RowForm::weighted_point);
  for (int i = 0; i < 5; ++i) {
    const double row[] = {1.0 * i, 2.0 * i, 3.0 * i};
    sites.assign(sites.add_rows(1), sites.points().append(row));
  }
  sites.assign(sites.add_rows(1), 4);
  sites.detach(1);
  sites.detach(3);
  CompactedIds ids;
  EXPECT_THROW(sites.compact(ids, [](std::span<const Index>) { throw Error(Errc::out_of_memory, ""); }),
               Error);
  EXPECT_EQ(sites.num_rows(), 6u);
  EXPECT_EQ(sites.point(5)[2], 12.0);
  std::vector<Index> given;
  sites.compact(ids, [&](std::span<const Index> new_ids) { given.assign(new_ids.begin(), new_ids.end()); });
  EXPECT_EQ(given, (std::vector<Index>{0, 1, invalid_index, 2, 3, 4}));
  EXPECT_EQ(sites.num_rows(), 4u);
  EXPECT_EQ(ids.rows, (std::vector<std::size_t>{0, CompactedIds::no_row, 1, CompactedIds::no_row, 2, 3}));
  EXPECT_EQ(sites.vertex_of(3), VertexId{3});  // the duplicate of row 3 has kept its vertex
  EXPECT_EQ(sites.row_of(3), 3u);
  EXPECT_EQ(sites.point(4)[2], 12.0);
}

}  // namespace
}  // namespace delone::sites
