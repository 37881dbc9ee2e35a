// SPDX-License-Identifier: BSD-3-Clause
// Edits one after the other whose result is known: what each of them kills and makes, hides and brings back;
// all short sequences in low affine dimensions; steps that are taken back; large sets to the last point.
#include "edit_history.hpp"
#include "edit_points.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>
#include <delone/point_sets.hpp>

#include <algorithm>
#include <array>
#include <cstdint>
#include <string>
#include <type_traits>
#include <vector>

namespace delone {
namespace {

using test::EditHistory;
using test::EditLists;
using test::EditWorld;
using test::Random;
using test::SeenTriangulation;

template <class Product>
struct EditsOneByOne : testing::Test {};
using Products = testing::Types<Delaunay<>, Regular<>, FurthestSite<>>;
struct Names {
  template <class Product>
  static std::string GetName(int) {
    return std::is_same_v<Product, Delaunay<>>  ? "Delaunay"
           : std::is_same_v<Product, Regular<>> ? "Regular"
                                                : "FurthestSite";
  }
};
TYPED_TEST_SUITE(EditsOneByOne, Products, Names);

template <class Product>
Product triangulation_of(const std::vector<double>& points, const std::vector<double>& weights, int d,
                         const Options& options = {}) {
  Product product(d, options);
  if constexpr (std::is_same_v<Product, Regular<>>)
    product.insert_range(points, weights);
  else
    product.insert_range(points);
  return product;
}
std::vector<double> some_weights(std::size_t n) {
  std::vector<double> weights = make_point_set("uniform", 1, n, 4);
  for (double& w : weights) w *= 0.02;
  return weights;
}
std::vector<double> row_of_points(const std::vector<double>& points, std::size_t row, int d) {
  const auto first = points.begin() + static_cast<std::ptrdiff_t>(row) * d;
  return {first, first + d};
}

/// Points that span a line, a plane, …; the last ones are within.
std::vector<double> corner(int d, int number) {
  std::vector<double> x(static_cast<std::size_t>(d), 0.0);
  if (number > d)
    x.assign(x.size(), 0.25);
  else if (number > 0)
    x[static_cast<std::size_t>(number - 1)] = 1;
  return x;
}

/// The points of the numbers from `first` on that the bits of a sequence name come and go in turn.
template <class Product>
void expect_sequence(int d, int first, int num_points, std::uint64_t sequence, int length) {
  Options options;
  options.force_runtime_dimension = sequence % 2 == 1;
  EditHistory<Product> history(d, options, true, true);
  for (int number = 0; number < first; ++number) history.insert(corner(d, number), 0);
  std::vector<std::size_t> row_of(static_cast<std::size_t>(num_points), CompactedIds::no_row);
  for (int step = 0; step < length; ++step, sequence /= static_cast<std::uint64_t>(num_points)) {
    const auto point = sequence % static_cast<std::uint64_t>(num_points);
    if (row_of[point] == CompactedIds::no_row) {
      row_of[point] = history.num_rows();
      history.insert(corner(d, first + static_cast<int>(point)), 0);
    } else {
      history.remove(row_of[point]);
      row_of[point] = CompactedIds::no_row;
    }
    history.compare_with_batch();
    ASSERT_EQ(history.fault(), "") << "step " << step;
  }
  history.undo();
  history.compare_with_batch();
  history.check_all_levels();
  ASSERT_EQ(history.fault(), "");
}

TYPED_TEST(EditsOneByOne, InEveryShortSequenceInLowAffineDimensions) {
  constexpr int length = 6, num_points = 3;
  for (int d = 1; d <= 6; ++d)
    for (int first = 0; first <= d; first += 1 + d / 3)
      for (std::uint64_t sequence = 0; sequence < 729;
           sequence += test::scale() == test::Scale::small ? 41 : 1 + static_cast<std::uint64_t>(d)) {
        SCOPED_TRACE(testing::Message() << d << "D, " << first << " points before, sequence " << sequence);
        ASSERT_NO_FATAL_FAILURE((expect_sequence<TypeParam>(d, first, num_points, sequence, length)));
      }
}

TYPED_TEST(EditsOneByOne, InsertInsertRemoveInsert) {
  for (int d = 1; d <= 6; ++d)
    for (const std::size_t gone : {0u, 1u}) {
      EditHistory<TypeParam> history(d, {}, true, true);
      history.insert(corner(d, 0), 0);
      history.insert(corner(d, 1), 0);
      history.remove(gone);
      history.compare_with_batch();
      history.insert(corner(d, 2), 0);
      history.compare_with_batch();
      history.check_all_levels();
      ASSERT_EQ(history.fault(), "") << d << "D";
      EXPECT_EQ(history.product().affine_dimension(), 1);
      EXPECT_EQ(history.product().num_rows(), 3u);
      EXPECT_EQ(history.product().num_points(), 2u);
    }
}

/// Of a flat, of one point and of none, too.
TYPED_TEST(EditsOneByOne, LeaveCellsThatCanBeVisited) {
  for (int d = 1; d <= 6; ++d) {
    EditHistory<TypeParam> history(d, {}, true, false);
    for (int number = 0; number <= d; ++number) history.insert(corner(d, number), 0);
    for (int left = d; left >= 0; --left) {
      const TypeParam& t = history.product();
      ASSERT_EQ(t.affine_dimension(), left);
      std::size_t finite = 0, infinite = 0;
      for (const CellId c : t.finite_cells()) {
        ++finite;
        EXPECT_EQ(t.vertices(c).size(), static_cast<std::size_t>(left) + 1);
        for (const VertexId v : t.vertices(c)) EXPECT_EQ(t.point(v).size(), static_cast<std::size_t>(d));
      }
      for (const CellId c : t.infinite_cells()) {
        ++infinite;
        EXPECT_GE(t.complex().infinite_index(c), 0);
      }
      EXPECT_EQ(finite, 1u);
      EXPECT_EQ(infinite, static_cast<std::size_t>(left) + 1);
      EXPECT_EQ(t.axes().size(), static_cast<std::size_t>(left));
      history.remove(static_cast<std::size_t>(left));
      ASSERT_EQ(history.fault(), "");
    }
    EXPECT_EQ(history.product().affine_dimension(), -1);
    EXPECT_EQ(history.product().num_all_cells(), 0u);
    EXPECT_EQ(history.product().num_rows(), static_cast<std::size_t>(d) + 1);
  }
}

TYPED_TEST(EditsOneByOne, KillAndMakeWhatTheyMust) {
  for (int d = 1; d <= 5; ++d) {
    SCOPED_TRACE(testing::Message() << d << "D");
    const std::size_t n = d <= 3 ? 60 : 25;
    const std::vector<double> points = make_point_set("uniform", d, n, 3);
    TypeParam t = triangulation_of<TypeParam>(points, some_weights(n), d);
    t.record_changes();
    Random random(7);
    for (std::size_t row = 0; row < n / 2; ++row) {
      const VertexId v = t.vertex_at(row);
      if (v == invalid_vertex) {
        t.remove(row);
        EXPECT_TRUE(t.changes().removed_cells.empty() && t.changes().created_cells.empty());
        EXPECT_EQ(t.changes().removed_vertices.size(), 1u);
        continue;
      }
      std::vector<CellId> star = t.complex().star(v);
      std::sort(star.begin(), star.end());
      t.remove(row);
      EXPECT_EQ(t.changes().removed_vertices, std::vector{v});
      // Cells of points that come back may be created and removed on the way.
      if (t.changes().reappeared_vertices.empty()) {
        EXPECT_EQ(t.changes().removed_cells, star);
      }
      for (const CellId c : star)
        EXPECT_TRUE(
            std::binary_search(t.changes().removed_cells.begin(), t.changes().removed_cells.end(), c));

      const std::vector<double> x = test::new_point(EditWorld::uniform, d, random);
      std::vector<CellId> zone;
      InsertResult inserted;
      if constexpr (std::is_same_v<TypeParam, Regular<>>) {
        zone = t.conflict_zone(x, 0.01);
        inserted = t.insert(x, 0.01);
      } else {
        zone = t.conflict_zone(x);
        inserted = t.insert(x);
      }
      std::sort(zone.begin(), zone.end());
      EXPECT_EQ(t.changes().removed_cells, zone);
      EXPECT_EQ(t.changes().added_vertices.size(), 1u);
      if (!inserted.inserted) continue;
      EXPECT_EQ(t.changes().added_vertices, std::vector{inserted.vertex});
      std::vector<CellId> made = t.complex().star(inserted.vertex);
      std::sort(made.begin(), made.end());
      EXPECT_EQ(t.changes().created_cells, made);
    }
  }
}

/// To look at each of its neighbors for each of its cells would take longer than to build all anew.
TEST(EditsOfHubs, RemoveAndMoveThem) {
  for (const int d : {2, 3}) {
    SCOPED_TRACE(testing::Message() << d << "D");
    constexpr std::size_t n = 1500;
    const std::vector<double> sphere = make_point_set("sphere", d, n, 5);
    const Delaunay<> without(sphere, d);
    std::vector<double> points = sphere;
    points.resize(points.size() + static_cast<std::size_t>(d), 0.0);
    Delaunay<> t(points, d);
    const CanonicalHash with = t.hash();
    const VertexId hub = t.vertex_at(n);
    EXPECT_GT(t.complex().star(hub).size(), n / 2);
    t.record_undo();
    t.record_changes();
    t.remove(n);
    EXPECT_EQ(t.hash(), without.hash());
    EXPECT_EQ(t.changes().removed_vertices, std::vector{hub});
    t.undo();
    EXPECT_EQ(t.hash(), with);
    points.back() = 0.125;
    t.move(n, std::span(points).last(static_cast<std::size_t>(d)));
    EXPECT_EQ(t.hash(), Delaunay<>(points, d).hash());
    t.remove(n);
    EXPECT_EQ(t.hash(), without.hash());
  }
}

/// A heavy point hides all others around it, and they come back with their ids.
TEST(EditsOfHiddenPoints, BringThemBack) {
  for (int d = 1; d <= 4; ++d) {
    SCOPED_TRACE(testing::Message() << d << "D");
    const std::size_t n = 40;
    Regular<> t(make_point_set("uniform", d, n, 1), std::vector<double>(n, 0.0), d);
    t.record_changes();
    const SeenTriangulation before(t);
    const std::vector<double> center(static_cast<std::size_t>(d), 0.5);
    const double heavy = 0.1 * d;
    t.insert(center, heavy);
    const std::vector<VertexId> hid = t.changes().hidden_vertices;
    EXPECT_EQ(t.num_hidden(), hid.size());
    EXPECT_GT(hid.size(), 0u);
    t.set_weight(n, 0.5 * heavy);
    t.set_weight(n, 1.5 * heavy);
    EXPECT_GE(t.num_hidden(), hid.size());
    t.move(n, std::vector<double>(static_cast<std::size_t>(d), 0.45));
    t.move(n, center);
    t.set_weight(n, heavy);
    EXPECT_EQ(t.num_hidden(), hid.size());
    t.remove(n);
    EXPECT_EQ(t.changes().reappeared_vertices, hid);
    EXPECT_EQ(t.num_hidden(), 0u);
    SeenTriangulation now(t);
    now.vertex_at.pop_back();
    EXPECT_EQ(now.vertex_at, before.vertex_at);
  }
}

/// A heavy point hides many others, in part duplicates, and others are far from it. If it is one that hides
/// most of all, cells are built anew once it has gone.
TEST(EditsOfHiddenPoints, ThatAreManyBringThemBack) {
  for (int d = 1; d <= 3; ++d)
    for (const bool are_most : {true, false})
      for (const bool on_record : {true, false}) {
        SCOPED_TRACE(testing::Message()
                     << d << "D, " << (are_most ? "most" : "some") << (on_record ? ", on record" : ""));
        Random random(static_cast<std::uint64_t>(d));
        EditHistory<Regular<>> history(d, {}, on_record, on_record);
        EditLists lists;
        const auto add = [&](std::vector<double> x, double weight) {
          lists.insert.insert(lists.insert.end(), x.begin(), x.end());
          lists.insert_weights.push_back(weight);
        };
        const auto any_point = [&] { return test::new_point(EditWorld::uniform, d, random); };
        const std::size_t num_far = are_most ? 20 : 600, num_hidden = 200;
        for (std::size_t i = 0; i < num_far; ++i) {
          std::vector<double> x = any_point();
          x[0] += 100;
          add(x, 0);
        }
        for (int corner = 0; corner < 1 << d; ++corner) {
          std::vector<double> x(static_cast<std::size_t>(d), -60);
          for (int j = 0; j < d; ++j)
            if ((corner >> j & 1) != 0) x[static_cast<std::size_t>(j)] = 60;
          add(x, 0);
        }
        const std::vector<double> center(static_cast<std::size_t>(d), 0.5);
        const std::size_t heavy = lists.insert_weights.size();
        add(center, 1000);
        history.edit(lists);
        lists = {};
        for (std::size_t i = 0; i < num_hidden; ++i) {
          const std::vector<double> x = any_point();
          add(x, 1e-6 * random.integer(0, 1));
          if (i % 5 == 0) add(x, lists.insert_weights.back());
        }
        history.edit(lists);
        ASSERT_EQ(history.fault(), "");
        EXPECT_EQ(history.product().num_hidden(), lists.insert_weights.size());
        const Index cells_before = history.product().num_all_cells();
        // Alone, then with others that move, come and go; some of the hidden ones among them.
        for (const bool with_others : {false, true}) {
          lists = {};
          lists.remove = {heavy};
          if (with_others) {
            lists.remove.insert(lists.remove.end(), {0, heavy + 3});
            lists.move = {1, heavy + 5};
            for (int i = 0; i < 2; ++i) {
              const std::vector<double> x = any_point();
              lists.to.insert(lists.to.end(), x.begin(), x.end());
            }
            lists.reweight = {2, heavy + 5};
            lists.weights = {0.01, 2e-6};
            add(history.point(heavy + 1), history.weight(heavy + 1));
            add(any_point(), 0);
          }
          history.edit(lists);
          ASSERT_EQ(history.fault(), "");
          EXPECT_LT(history.product().num_hidden(), num_hidden / 2);
          if (on_record) {
            EXPECT_EQ(history.product().changes().removed_cells.size() == cells_before, are_most);
          }
          history.compare_with_batch();
          history.check_all_levels();
          if (!on_record) break;
          history.undo();
          ASSERT_EQ(history.fault(), "");
          EXPECT_EQ(history.product().num_all_cells(), cells_before);
        }
        history.insert(center, 500);
        history.remove(heavy + 1 + (on_record ? 0u : 1u));
        history.compare_with_batch();
        ASSERT_EQ(history.fault(), "");
      }
}

/// Cells are built anew of points in one place, the heaviest of which is the vertex before and after.
TEST(EditsOfHiddenPoints, ThatAreLeftInOnePlaceKeepTheVertex) {
  for (std::size_t heaviest = 0; heaviest < 4; ++heaviest) {
    EditHistory<Regular<>> history(2, {}, true, true);
    EditLists lists;
    for (std::size_t row = 0; row < 4; ++row) {
      lists.insert.insert(lists.insert.end(), {0, 0});
      lists.insert_weights.push_back(row == heaviest ? 1 : 0.5);
    }
    history.edit(lists);
    EditLists others, gone;
    for (int i = 0; i < 20; ++i) {
      others.insert.insert(others.insert.end(), {10.0 + i, 1.0 * i * i});
      others.insert_weights.push_back(0);
      gone.remove.push_back(4 + static_cast<std::size_t>(i));
    }
    history.edit(others);
    history.edit(gone);
    EXPECT_EQ(history.fault(), "") << heaviest;
    EXPECT_TRUE(history.product().changes().hidden_vertices.empty()) << heaviest;
    history.undo();
    history.undo();
    EXPECT_EQ(history.fault(), "") << heaviest;
  }
}

/// Points inside the hull are hidden until the corners go.
TEST(EditsOfHiddenPoints, AreThoseOfFurthestSites) {
  FurthestSite<2> t(std::vector<double>{0, 0, 9, 0, 9, 9, 0, 9, 1, 1, 8, 8, 5, 4});
  t.record_changes();
  EXPECT_EQ(t.hidden_rows(), (std::vector<std::size_t>{4, 5, 6}));
  t.remove(0);
  EXPECT_EQ(t.changes().reappeared_vertices.size(), 1u);
  EXPECT_EQ(t.hidden_rows(), (std::vector<std::size_t>{5, 6}));
  t.move(2, {9, 8.5});
  EXPECT_TRUE(t.is_hidden(6));
  t.remove(std::vector<std::size_t>{1, 2, 3});
  EXPECT_EQ(t.num_hidden(), 0u);
  EXPECT_EQ(t.num_vertices(), 3u);
}

TEST(EditsOfOneType, TakeThePointsThatTheDimensionAsksFor) {
  Delaunay<3> t(std::vector<double>{0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 1, 1, 1});
  const VertexId v = t.vertex_at(4);
  t.move(4, {2, 2, 2});
  EXPECT_EQ(t.vertex_at(4), v);
  EXPECT_EQ(t.point(v)[0], 2.0);
  const std::vector<std::array<double, 3>> points{{3, 3, 3}, {0.5, 0.25, 0.125}};
  const std::vector<std::size_t> gone{1}, moving{2};
  t.edit({.remove = gone,
          .move = moving,
          .to = std::vector<std::array<double, 3>>{{0, 2, 0}},
          .insert = points});
  EXPECT_EQ(t.num_points(), 6u);
  EXPECT_EQ(t.num_rows(), 7u);
  EXPECT_FALSE(t.has_row(1));
  EXPECT_EQ(t.vertex_at(1), invalid_vertex);
  EXPECT_EQ(t.row_of(t.vertex_at(5)), 5u);
  Regular<2> r(std::vector<double>{0, 0, 1, 0, 0, 1, 1, 1}, std::vector<double>{0, 0, 0, 0});
  const std::vector<std::size_t> rows{0, 3};
  const std::vector<double> weights{0.25, 0.5};
  r.set_weights(rows, weights);
  EXPECT_EQ(r.weight(r.vertex_at(3)), 0.5);
  r.edit({.reweight = rows, .weights = std::vector<double>{0, 0}});
  EXPECT_EQ(r.weight(r.vertex_at(3)), 0.0);
}

/// Small steps, some of which are taken back: as in annealing.
TYPED_TEST(EditsOneByOne, AreTakenOrTakenBack) {
  for (int d = 1; d <= 4; ++d) {
    SCOPED_TRACE(testing::Message() << d << "D");
    const std::size_t n = d <= 2 ? 400 : d == 3 ? 150 : 50;
    std::vector<double> points = make_point_set("uniform", d, n, 5);
    const std::vector<double> weights = some_weights(n);
    TypeParam t = triangulation_of<TypeParam>(points, weights, d);
    t.record_undo();
    Random random(static_cast<std::uint64_t>(d));
    for (std::size_t step = 0; step < test::scaled_count(200); ++step) {
      const std::size_t row = random.bits() % n;
      const CanonicalHash before = t.hash();
      std::vector<double> to = row_of_points(points, row, d);
      for (double& x : to) x += (step % 8 == 0 ? 1 : 0.01) * (random.real() - 0.5);
      t.move(row, to);
      if (random.integer(0, 2) != 0) {
        t.undo();
        ASSERT_EQ(t.hash(), before);
        continue;
      }
      std::copy(to.begin(), to.end(), points.begin() + static_cast<std::ptrdiff_t>(row) * d);
    }
    EXPECT_EQ(t.hash(), triangulation_of<TypeParam>(points, weights, d).hash());
  }
}

/// A copy is a snapshot.
TYPED_TEST(EditsOneByOne, LeaveCopiesAlone) {
  const std::size_t n = 200;
  const std::vector<double> points = make_point_set("uniform", 3, n, 5);
  TypeParam t = triangulation_of<TypeParam>(points, some_weights(n), 3);
  t.record_undo();
  t.remove(7);
  const TypeParam copy = t.clone();
  const SeenTriangulation before(copy);
  EXPECT_TRUE(before == SeenTriangulation(t));
  for (std::size_t row = 20; row < 60; ++row) t.remove(row);
  t.move(3, std::vector<double>{2, 2, 2});
  t.undo();
  EXPECT_TRUE(SeenTriangulation(copy) == before);
  EXPECT_FALSE(SeenTriangulation(t) == before);
}

/// From many points to none and back, one by one and in large batches, in one thread and in several.
template <class Product>
void expect_all_to_go_and_come(int d, const std::string& kind, std::size_t n, unsigned threads) {
  SCOPED_TRACE(testing::Message() << kind << ", " << d << "D, " << threads << " threads");
  Options options;
  options.threads = threads;
  const std::vector<double> points = make_point_set(kind, d, n, 9), weights = some_weights(n);
  Product t = triangulation_of<Product>(points, weights, d, options);
  t.record_undo();
  const std::vector<std::size_t> order = test::random_order(n, 3);
  const auto expect_left = [&](std::size_t gone) {
    std::vector<std::size_t> left(order.begin() + static_cast<std::ptrdiff_t>(gone), order.end());
    std::sort(left.begin(), left.end());
    std::vector<double> of_left;
    for (const std::size_t row : left) of_left.push_back(weights[row]);
    const Product batch = triangulation_of<Product>(test::reordered(points, d, left), of_left, d);
    ASSERT_EQ(t.num_vertices(), batch.num_vertices()) << gone << " points are gone";
    ASSERT_EQ(t.hash(), batch.hash()) << gone << " points are gone";
  };
  std::size_t gone = 0;
  for (const std::size_t batch : {n / 50 + 1, n / 3, n / 10, n}) {  // some by removals, some by building anew
    const std::vector<std::size_t> rows(
        order.begin() + static_cast<std::ptrdiff_t>(gone),
        order.begin() + static_cast<std::ptrdiff_t>(std::min(n, gone + batch)));
    const CanonicalHash before = t.hash();
    t.remove(rows);
    t.undo();
    ASSERT_EQ(t.hash(), before);
    for (std::size_t i = 0; i < std::min<std::size_t>(rows.size(), n / 20); ++i) t.remove(rows[i]);
    if (rows.size() > n / 20) t.remove(std::span(rows).subspan(n / 20));
    gone += rows.size();
    ASSERT_NO_FATAL_FAILURE(expect_left(gone));
  }
  EXPECT_EQ(t.affine_dimension(), -1);
  EXPECT_EQ(t.num_rows(), n);
  EXPECT_EQ(t.num_points(), 0u);
  if constexpr (std::is_same_v<Product, Regular<>>)
    t.insert_range(points, weights);
  else
    t.insert_range(points);
  EXPECT_EQ(t.hash(), triangulation_of<Product>(points, weights, d).hash());
  t.undo();
  EXPECT_EQ(t.num_points(), 0u);
}

/// However many threads have built the cells anew.
TEST(EditsByThreads, LeaveTheSameCellsSorted) {
  for (const int d : {2, 3}) {
    SCOPED_TRACE(testing::Message() << d << "D");
    constexpr std::size_t n = 4000;
    std::vector<double> points = make_point_set("uniform", d, n, 2);
    std::copy_n(points.begin(), 20 * d, points.begin() + 100 * d);  // duplicates
    const std::vector<double> others = make_point_set("uniform", d, n / 2, 6);
    const std::vector<std::size_t> rows = test::random_order(n, 8);
    std::vector<ComplexData> sorted;
    for (const unsigned threads : {1u, 2u, 3u}) {
      Options options;
      options.threads = threads;
      Delaunay<> t(points, d, options);
      t.move(std::span(rows).first(n / 2), others);
      t.sort_cells();
      sorted.push_back(t.to_data());
    }
    EXPECT_EQ(sorted[0].cells, sorted[1].cells);
    EXPECT_EQ(sorted[0].neighbors, sorted[1].neighbors);
    EXPECT_EQ(sorted[0].cells, sorted[2].cells);
    EXPECT_EQ(sorted[0].vertex_of_point, sorted[2].vertex_of_point);
  }
}

/// Cells that were sorted are so after a batch that is taken back: sort_cells() has nothing to do.
TEST(EditsByThreads, AreUndoneAfterABatchThatWasCancelled) {
  bool is_wanted = true;
  Options options;
  options.threads = 3;
  options.progress = [&](double) { return is_wanted; };
  const std::vector<double> points = make_point_set("uniform", 3, 3000, 2);
  Delaunay<> t(points, 3, options);
  t.sort_cells();
  is_wanted = false;
  EXPECT_THROW(t.insert_range(make_point_set("uniform", 3, 20000, 3)), Error);
  is_wanted = true;
  t.record_undo();
  const CanonicalHash before = t.hash();
  t.remove(7);
  t.sort_cells();
  ASSERT_TRUE(t.can_undo());
  t.undo();
  EXPECT_EQ(t.hash(), before);
}

TYPED_TEST(EditsOneByOne, ToNoneAndBack) {
  const std::size_t n = test::scaled_size(1500, 200);
  for (const unsigned threads : {1u, 3u}) {
    expect_all_to_go_and_come<TypeParam>(2, "uniform", n, threads);
    expect_all_to_go_and_come<TypeParam>(3, "uniform", n / 2, threads);
  }
  expect_all_to_go_and_come<TypeParam>(1, "uniform", n, 1);
  expect_all_to_go_and_come<TypeParam>(2, "grid", n, 1);
  expect_all_to_go_and_come<TypeParam>(3, "sphere", n / 3, 1);
  expect_all_to_go_and_come<TypeParam>(4, "uniform", n / 10, 1);
  expect_all_to_go_and_come<TypeParam>(7, "uniform", 30, 1);
}

}  // namespace
}  // namespace delone
