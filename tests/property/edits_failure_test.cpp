// SPDX-License-Identifier: BSD-3-Clause
// Edits are made whole or not at all: refused, cancelled, or out of memory at any allocation, everything is
// as it was before, and the edit can be made again.
#include "allocations.hpp"
#include "edit_history.hpp"
#include "edit_points.hpp"
#include "scale.hpp"

#include <gtest/gtest.h>
#include <delone/point_sets.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <new>
#include <numeric>
#include <span>
#include <string>
#include <type_traits>
#include <vector>

namespace delone {
namespace {

using test::allocations;
using test::EditLists;
using test::Random;
using test::SeenTriangulation;

constexpr double infinity = std::numeric_limits<double>::infinity();

template <class Product>
constexpr bool has_weights = test::EditHistory<Product>::has_weights;
template <class Product>
void apply(Product& product, const EditLists& lists) {
  product.edit(test::EditHistory<Product>::to_edit(lists));
}

/// Of integers, with duplicates and hidden points, and with gaps in the ids.
template <class Product>
Product with_history(int d, std::size_t n, const Options& options = {}, bool records = true) {
  Random random(n);
  Product product(d, options);
  product.record_changes(records);
  product.record_undo(records);
  EditLists lists;
  for (std::size_t row = 0; row < n; ++row) {
    const std::vector<double> x =
        test::new_point(row % 3 == 0 ? test::EditWorld::lattice : test::EditWorld::uniform, d, random);
    lists.insert.insert(lists.insert.end(), x.begin(), x.end());
    lists.insert_weights.push_back(0.25 * random.integer(0, 2));
  }
  apply(product, lists);
  if (n > 3) product.remove(std::vector<std::size_t>{1, 3});
  return product;
}

template <class Product>
struct Edits : testing::Test {};
using Products = testing::Types<Delaunay<>, Regular<>, FurthestSite<>>;
struct Names {
  template <class Product>
  static std::string GetName(int) {
    return std::is_same_v<Product, Delaunay<>> ? "Delaunay"
           : has_weights<Product>              ? "Regular"
                                               : "FurthestSite";
  }
};
TYPED_TEST_SUITE(Edits, Products, Names);

/// The edit is refused with that code, these rows and this message, and nothing happens.
template <class Product>
void expect_refused(Product& product, const EditLists& lists, Errc code, std::vector<std::size_t> rows,
                    const std::string& message) {
  SCOPED_TRACE(message);
  const SeenTriangulation before(product);
  const Changes& changes = product.changes();
  const std::vector<CellId> created = changes.created_cells;
  try {
    apply(product, lists);
    ADD_FAILURE() << "was taken";
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_EQ(error.rows(), rows) << error.what();
    EXPECT_EQ(error.what(), message);
  }
  EXPECT_TRUE(SeenTriangulation(product) == before);
  EXPECT_EQ(product.changes().created_cells, created);
  EXPECT_TRUE(product.can_undo());
}

TYPED_TEST(Edits, AreRefused) {
  TypeParam product = with_history<TypeParam>(2, 20);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const auto expect = [&](const std::string& message, const EditLists& lists, Errc code,
                          std::vector<std::size_t> rows) {
    expect_refused(product, lists, code, std::move(rows), message);
  };
  constexpr Errc bad = Errc::invalid_argument;
  expect("remove[1]: row 20 is not a row of the input", {.remove = {2, 20}}, bad, {1});
  expect("remove: row 20 is not a row of the input", {.remove = {20}}, bad, {0});
  expect("remove[2]: row 3 was removed", {.remove = {0, 2, 3}}, bad, {2});
  expect("remove[2]: row 5 is given twice, see remove[0]", {.remove = {5, 0, 5}}, bad, {2});
  expect("move: row 25 is not a row of the input", {.move = {25}, .to = {0, 0}}, bad, {0});
  expect("move[1]: row 1 was removed", {.move = {0, 1}, .to = {0, 0, 1, 1}}, bad, {1});
  expect("move[1]: row 4 is given twice, see move[0]", {.move = {4, 4}, .to = {0, 0, 1, 1}}, bad, {1});
  expect("move[1]: row 4 is removed, see remove", {.remove = {4}, .move = {5, 4}, .to = {0, 0, 1, 1}}, bad,
         {1});
  expect("move[1]: row 4 is removed, see remove[2]",
         {.remove = {8, 7, 4}, .move = {5, 4}, .to = {0, 0, 1, 1}}, bad, {1});
  expect("move[1]: a coordinate for row 5 is not finite", {.move = {4, 5}, .to = {0, 0, 1, nan}},
         Errc::not_finite, {1});
  expect("move[0]: a coordinate for row 4 is not finite (and of 1 more)",
         {.move = {4, 5}, .to = {infinity, 0, 1, nan}}, Errc::not_finite, {0, 1});
  expect("move: 1 point for 2 rows", {.move = {4, 5}, .to = {0, 0}}, Errc::bad_dimension, {});
  expect("move: 2 points for 1 row", {.move = {4}, .to = {0, 0, 1, 1}}, Errc::bad_dimension, {});
  expect("move: the number of coordinates is not a multiple of the dimension", {.move = {4}, .to = {0}},
         Errc::bad_dimension, {});
  const std::vector<double> weights(has_weights<TypeParam> ? 2 : 0, 1.0);
  expect("insert[1]: a coordinate is not finite",
         {.remove = {0}, .insert = {0, 0, -infinity, 0}, .insert_weights = weights}, Errc::not_finite, {1});
  expect("insert: the number of coordinates is not a multiple of the dimension",
         {.insert = {0, 1, 0}, .insert_weights = weights}, Errc::bad_dimension, {});
  if (has_weights<TypeParam>) {
    expect("insert: 1 weight for 2 points", {.insert = {0, 0, 1, 1}, .insert_weights = {1}},
           Errc::bad_dimension, {});
    expect("insert[1]: the weight is not finite", {.insert = {0, 0, 1, 1}, .insert_weights = {1, infinity}},
           Errc::not_finite, {1});
    expect("set_weights: 1 weight for 2 rows", {.reweight = {4, 5}, .weights = {1}}, Errc::bad_dimension, {});
    expect("set_weights[1]: the weight for row 5 is not finite", {.reweight = {4, 5}, .weights = {1, nan}},
           Errc::not_finite, {1});
    expect("set_weights[2]: row 4 is given twice, see set_weights[0]",
           {.reweight = {4, 5, 4}, .weights = {1, 1, 1}}, bad, {2});
    expect("set_weights[1]: row 7 is removed, see remove[1]",
           {.remove = {4, 7}, .reweight = {5, 7}, .weights = {1, 1}}, bad, {1});
    expect("set_weights: row 1 was removed", {.reweight = {1}, .weights = {1}}, bad, {0});
  } else {
    expect("set_weights: points of this triangulation have no weights", {.reweight = {4}, .weights = {1}},
           bad, {});
  }
  const auto expect_message = [&](const std::string& message, const auto& call) {
    try {
      call();
      ADD_FAILURE() << "was taken, not refused as " << message;
    } catch (const Error& error) {
      EXPECT_EQ(error.what(), message);
    }
  };
  expect_message("remove: row 20 is not a row of the input", [&] { product.remove(20); });
  expect_message("remove[1]: row 0 is given twice, see remove[0]", [&] {
    product.remove(std::vector<std::size_t>{0, 0});
  });
  expect_message("move: row 1 was removed", [&] { product.move(1, {0, 0}); });
  expect_message("move: the number of coordinates is not a multiple of the dimension", [&] {
    product.move(0, {0, 0, 0});
  });
  const std::vector<double> solid{0, 0, 0};
  const std::vector<std::size_t> one_row{0};
  expect_message("move: points in 3 dimensions, not 2", [&] { product.move(one_row, PointsView(solid, 3)); });
  expect_message("insert: points in 3 dimensions, not 2",
                 [&] { product.edit({.insert = PointsView(solid, 3)}); });
  TypeParam large = with_history<TypeParam>(2, 100);  // in which few rows are sorted to find equal ones
  expect_message("remove[2]: row 5 is given twice, see remove[0]", [&] {
    large.remove(std::vector<std::size_t>{5, 0, 5});
  });
  if constexpr (!has_weights<TypeParam>) {
    const std::vector<double> origin{0, 0}, one_weight{1};
    expect_message("insert: points of this triangulation have no weights",
                   [&] { product.edit({.insert = PointsView(origin, 2), .insert_weights = one_weight}); });
  }
  const std::string no_row = "row 20 is not a row of the input";
  expect_message(no_row, [&] { product.has_row(20); });
  expect_message(no_row, [&] { product.vertex_at(20); });
  expect_message(no_row, [&] { product.is_hidden(20); });
  product.undo();  // that of rows 1 and 3 still
  EXPECT_TRUE(product.has_row(1) && product.has_row(3));
  EXPECT_THROW(product.undo(), Error);
  product.record_changes(false);
  EXPECT_THROW(product.changes(), Error);
}

TYPED_TEST(Edits, OfNothingChangeNothing) {
  TypeParam product = with_history<TypeParam>(3, 20);
  const SeenTriangulation before(product);
  const std::vector<CellId> created = product.changes().created_cells;
  apply(product, {});
  EXPECT_TRUE(SeenTriangulation(product) == before);
  EXPECT_EQ(product.changes().created_cells, created);  // those of the last call that changed something
  // To where it is.
  const auto there = product.point(product.vertex_at(0));
  product.move(0, std::vector<double>(there.begin(), there.end()));
  EXPECT_TRUE(SeenTriangulation(product) == before);
  const Changes& changes = product.changes();
  EXPECT_TRUE(changes.removed_cells.empty() && changes.created_cells.empty() &&
              changes.added_vertices.empty() && changes.removed_vertices.empty() &&
              changes.hidden_vertices.empty() && changes.reappeared_vertices.empty() &&
              changes.moved_vertices.empty());
  // It counts as an edit.
  EXPECT_TRUE(product.can_undo());
  product.undo();
  EXPECT_TRUE(SeenTriangulation(product) == before);
  EXPECT_FALSE(product.can_undo());
}

/// Few changes of many rows, or of all.
template <class Product>
EditLists changes_of(int d, std::size_t n, std::size_t every, bool moves) {
  Random random(every);
  EditLists lists;
  for (std::size_t row = 5; row < n; row += every) {
    if (row % 2 == 0 || !moves) {
      lists.remove.push_back(row);
      continue;
    }
    lists.move.push_back(row);
    const std::vector<double> to = test::new_point(test::EditWorld::uniform, d, random);
    lists.to.insert(lists.to.end(), to.begin(), to.end());
    if (has_weights<Product> && row % 3 == 0) {
      lists.reweight.push_back(row);
      lists.weights.push_back(0.1);
    }
  }
  for (std::size_t row = 0; row < n; row += 2 * every) {
    const std::vector<double> x = test::new_point(test::EditWorld::uniform, d, random);
    lists.insert.insert(lists.insert.end(), x.begin(), x.end());
    lists.insert_weights.push_back(0.0);
  }
  return lists;
}

TYPED_TEST(Edits, AreCancelled) {
  const std::size_t n = test::scaled_size(6000, 2000);
  for (const std::size_t every : {std::size_t{50}, std::size_t{2}}) {
    SCOPED_TRACE(testing::Message() << "every row in " << every);
    std::size_t left = static_cast<std::size_t>(-1), num_calls = 0;
    Options options;
    options.progress = [&](double done) {
      EXPECT_GE(done, 0);
      EXPECT_LE(done, 1);
      ++num_calls;
      return left == static_cast<std::size_t>(-1) || left-- > 1;
    };
    const EditLists lists = changes_of<TypeParam>(2, n, every, true);
    TypeParam product = with_history<TypeParam>(2, n, options);
    const SeenTriangulation before(product);
    num_calls = 0;
    apply(product, lists);
    const std::size_t all_calls = num_calls;
    const CanonicalHash right = product.hash();
    product.undo();
    EXPECT_TRUE(SeenTriangulation(product) == before);
    std::size_t num_cancelled = 0;
    for (std::size_t calls = 1; calls <= std::min<std::size_t>(all_calls, 4); ++calls) {
      left = calls;
      try {
        apply(product, lists);
        product.undo();
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), Errc::cancelled) << error.what();
        ++num_cancelled;
      }
      left = static_cast<std::size_t>(-1);
      ASSERT_TRUE(SeenTriangulation(product) == before) << calls << " calls";
    }
    EXPECT_TRUE(num_cancelled > 0 || all_calls == 0);
    apply(product, lists);
    EXPECT_EQ(product.hash(), right);
  }
}

/// `make` gives a triangulation and `act` changes it, with every allocation failing in turn, alone or with
/// all later ones.
template <class Make, class Act>
void expect_all_or_nothing(const char* name, Make make, Act act) {
  SCOPED_TRACE(name);
  std::size_t num_allocations;
  const auto done = [&] {
    auto product = make();
    allocations = {};
    act(product);
    num_allocations = allocations.count;
    return SeenTriangulation(product);
  };
  done();  // also allocates what stays for all later calls
  const SeenTriangulation right = done();
  const CanonicalHash hash = [&] {
    auto product = make();
    act(product);
    return product.hash();
  }();
  // In a small run every so many only.
  const std::size_t step = test::scale() == test::Scale::small ? 1 + num_allocations / 20 : 1;
  for (std::size_t failing = 1; failing <= num_allocations; failing += step)
    for (const bool all_later : {false, true}) {
      const std::int64_t live = test::num_live_allocations;
      bool is_same = true, is_right = true;
      {
        auto product = make();
        const SeenTriangulation before(product);
        bool has_failed = false;
        allocations = {0, failing, all_later};
        try {
          act(product);
        } catch (const Error& error) {
          allocations = {};
          has_failed = true;
          EXPECT_EQ(error.code(), Errc::out_of_memory) << error.what();
        } catch (const std::bad_alloc&) {  // without memory for a message
          has_failed = true;
        }
        allocations = {};
        if (has_failed) {
          is_same = SeenTriangulation(product) == before;
          act(product);
        }
        // Where memory was short, cells may be in other slots.
        const SeenTriangulation after(product);
        is_right = product.hash() == hash && after.vertex_at == right.vertex_at &&
                   after.first_rows == right.first_rows && after.points == right.points &&
                   after.is_hidden == right.is_hidden && after.num_points == right.num_points &&
                   after.cells.size() == right.cells.size();
      }
      const std::int64_t leaked = test::num_live_allocations - live;
      SCOPED_TRACE(testing::Message() << "allocation " << failing << " of " << num_allocations
                                      << (all_later ? " and all later" : ""));
      ASSERT_TRUE(is_same) << "something has changed";
      ASSERT_TRUE(is_right) << "another result";
      ASSERT_EQ(leaked, 0) << "allocations";
    }
}

/// Of few rows: an edit, and an edit taken back.
template <class Product>
class OutOfMemory {
 public:
  OutOfMemory(int d, bool runtime_dimension, bool records) : d_(d), records_(records) {
    options_.force_runtime_dimension = runtime_dimension;
  }

  void expect(const char* name, const EditLists& lists) {
    const auto make = [&] { return with_history<Product>(d_, num_rows, options_, records_); };
    expect_all_or_nothing(name, make, [&](Product& product) { apply(product, lists); });
    if (!records_) return;
    const auto edited = [&] {
      Product product = make();
      apply(product, lists);
      return product;
    };
    expect_all_or_nothing((std::string(name) + ", undone").c_str(), edited,
                          [](Product& product) { product.undo(); });
    expect_all_or_nothing((std::string(name) + ", and other ids").c_str(), edited,
                          [](Product& product) { product.compact_ids(); });
  }
  std::vector<double> at(double x) const { return std::vector<double>(static_cast<std::size_t>(d_), x); }

  static constexpr std::size_t num_rows = 16;

 private:
  int d_;
  bool records_;
  Options options_;
};

TYPED_TEST(Edits, WithoutMemory) {
  for (const int d : {1, 2, 3})
    for (const bool records : {true, false}) {
      const bool runtime_dimension = (d == 2) == records;
      SCOPED_TRACE(testing::Message() << d << "D" << (runtime_dimension ? ", at run time" : "")
                                      << (records ? ", on record" : ""));
      OutOfMemory<TypeParam> out(d, runtime_dimension, records);
      out.expect("a removal", {.remove = {2}});
      out.expect("a removal of a point of a lattice", {.remove = {0}});
      out.expect("a small step", {.move = {5}, .to = out.at(0.51)});
      out.expect("a step out of the hull", {.move = {5}, .to = out.at(-7)});
      out.expect("a step onto another point", {.move = {5}, .to = out.at(0)});
      out.expect("a point beyond the frame", {.insert = out.at(1e9), .insert_weights = {0}});
      if (has_weights<TypeParam>) {
        out.expect("a heavy point", {.reweight = {4}, .weights = {2}});
        out.expect("a light point", {.reweight = {4}, .weights = {-2}});
      }
      out.expect("a batch", changes_of<TypeParam>(d, out.num_rows, 7, false));
      out.expect("a large batch", changes_of<TypeParam>(d, out.num_rows, 2, true));
      EditLists all;
      for (std::size_t row = 0; row < out.num_rows; ++row)
        if (row != 1 && row != 3) all.remove.push_back(row);
      out.expect("a removal of all", all);
      if (testing::Test::HasFailure()) return;
    }
}

/// Points of a flat and one beyond it.
TYPED_TEST(Edits, ThatChangeTheDimensionWithoutMemory) {
  for (const int d : {1, 2, 3})
    for (const bool runtime_dimension : {false, true}) {
      SCOPED_TRACE(testing::Message() << d << "D" << (runtime_dimension ? ", at run time" : ""));
      const auto size = static_cast<std::size_t>(d);
      const auto make = [&](bool with_apex) {
        Options options;
        options.force_runtime_dimension = runtime_dimension;
        TypeParam product(d, options);
        product.record_changes();
        product.record_undo();
        Random random(5);
        EditLists lists;
        for (std::size_t row = 0; row < 7; ++row) {
          std::vector<double> x = test::new_point(test::EditWorld::lattice, d, random);
          x.back() = row == 0 && with_apex ? 1 : 0;
          lists.insert.insert(lists.insert.end(), x.begin(), x.end());
          lists.insert_weights.push_back(0.25 * random.integer(0, 1));
        }
        apply(product, lists);
        return product;
      };
      std::vector<double> apex(size, 1.0), flat(size, 0.0);
      const auto with = [&] { return make(true); };
      const auto without = [&] { return make(false); };
      expect_all_or_nothing("down", with, [](TypeParam& product) { product.remove(0); });
      expect_all_or_nothing("down by a move", with, [&](TypeParam& product) { product.move(0, flat); });
      expect_all_or_nothing("up by a move", without, [&](TypeParam& product) { product.move(3, apex); });
      const auto lowered = [&] {
        TypeParam product = make(true);
        product.remove(0);
        return product;
      };
      expect_all_or_nothing("up again", lowered, [](TypeParam& product) { product.undo(); });
      if (testing::Test::HasFailure()) return;
    }
}

/// A heavy point goes that hides so many that cells are built anew once it has been taken out.
TEST(EditsOfHiddenPoints, AreMadeWholeOrNot) {
  std::size_t calls_left = static_cast<std::size_t>(-1);
  Options options;
  options.progress = [&](double) { return calls_left > 0 && --calls_left > 0; };
  const std::size_t heavy = 10, num_hidden = 90;
  const std::vector<double> new_point{50, 50};
  const double new_weight = 0;
  for (const bool records : {true, false}) {
    SCOPED_TRACE(records);
    const auto make = [&](std::size_t n, const Options& given) {
      Regular<> product(2, given);
      product.record_changes(records);
      product.record_undo(records);
      Random random(3);
      std::vector<double> points, weights(heavy + 1 + n, 0.0);
      for (std::size_t row = 0; row <= heavy + n; ++row)
        for (const double x : test::new_point(test::EditWorld::uniform, 2, random))
          points.push_back(row < heavy ? 100 * x : 50 + x);
      weights[heavy] = 1000;
      product.insert_range(points, weights);
      EXPECT_GE(product.num_hidden(), n);
      return product;
    };
    const auto act = [&](Regular<>& product) {
      product.edit({.remove = std::span(&heavy, 1),
                    .insert = PointsView(new_point, 2),
                    .insert_weights = std::span(&new_weight, 1)});
    };
    expect_all_or_nothing(
        "many hidden", [&] { return make(num_hidden, {}); }, act);
    Regular<> product = make(test::scaled_size(20000, 10000), options);
    const SeenTriangulation before(product);
    std::size_t num_cancelled = 0;
    for (std::size_t calls = 1; calls < 4; ++calls) {
      calls_left = calls;
      try {
        act(product);
        break;
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), Errc::cancelled) << error.what();
        ++num_cancelled;
      }
      calls_left = static_cast<std::size_t>(-1);
      ASSERT_TRUE(SeenTriangulation(product) == before) << calls << " calls";
    }
    calls_left = static_cast<std::size_t>(-1);
    EXPECT_GT(num_cancelled, 0u);
  }
}

/// Any thread may be the one that runs out of memory.
TYPED_TEST(Edits, ThatAreBuiltAnewInThreadsWithoutMemory) {
  Options options;
  options.threads = 3;
  const std::size_t n = 1500;
  const EditLists lists = changes_of<TypeParam>(3, n, 1, false);
  std::size_t num_failures = 0;
  for (long allowed = 0;; allowed = allowed < 10 ? allowed + 1 : allowed + allowed / 3) {
    TypeParam product = with_history<TypeParam>(3, n, options);
    const SeenTriangulation before(product);
    bool has_failed = false;
    test::left_for_all_threads = allowed;
    try {
      apply(product, lists);
    } catch (const Error& error) {
      test::left_for_all_threads = -1;
      has_failed = true;
      EXPECT_EQ(error.code(), Errc::out_of_memory) << error.what();
    }
    test::left_for_all_threads = -1;
    if (!has_failed) break;
    ++num_failures;
    ASSERT_TRUE(SeenTriangulation(product) == before) << "after " << allowed << " allocations";
  }
  EXPECT_GT(num_failures, 10u);
}

/// All points move a little.
TEST(TimeSteps, InThreadsWithoutMemory) {
  Options options;
  options.threads = 3;
  const std::size_t n = 10000;
  const std::vector<double> points = make_point_set("uniform", 2, n, 5);
  std::vector<double> moved(points);
  for (double& x : moved) x += 1e-6 * std::sin(1e6 * x);
  std::vector<std::size_t> rows(n);
  std::iota(rows.begin(), rows.end(), std::size_t{0});
  Delaunay<> t(points, 2, options);
  const SeenTriangulation before(t);
  std::size_t num_failures = 0;
  for (long allowed = 0;; allowed = allowed < 60 ? allowed + 1 : allowed + allowed / 3) {
    test::left_for_all_threads = allowed;
    try {
      t.move(rows, moved);
    } catch (const Error& error) {
      test::left_for_all_threads = -1;
      EXPECT_EQ(error.code(), Errc::out_of_memory) << error.what();
      ++num_failures;
      ASSERT_TRUE(SeenTriangulation(t) == before) << "after " << allowed << " allocations";
      continue;
    }
    test::left_for_all_threads = -1;
    break;
  }
  EXPECT_GT(num_failures, 20u);
  EXPECT_EQ(t.hash(), Delaunay<>(moved, 2).hash());
}

}  // namespace
}  // namespace delone
