// SPDX-License-Identifier: BSD-3-Clause
// Insertions, edits and queries that are refused, and those of triangulations of one point, of none, in a
// flat, and compacted: each refusal leaves all as it was.
#include "error_code.hpp"

#include <delone/check.hpp>
#include <delone/delaunay.hpp>
#include <delone/furthest_site.hpp>
#include <delone/point_sets.hpp>
#include <delone/regular.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace delone::triangulation {
namespace {

using test::code_of;
using Numbers = std::vector<double>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
constexpr CellId no_cell{1000000};

template <class Call>
std::string message_of(Call&& call) {
  try {
    call();
  } catch (const Error& error) {
    return error.what();
  }
  return "";
}

TEST(TriangulationImpl, RefusesWhatDoesNotFitAndStaysAsItWas) {
  Delaunay<> t(make_point_set("uniform", 2, 50, 1), 2);
  t.record_undo();
  t.remove(7);
  const CanonicalHash hash = t.hash();
  const Numbers three{1, 2, 3}, not_finite{0.5, nan}, fine{0.5, 0.5};
  EXPECT_EQ(code_of([&] { t.insert(three); }), Errc::bad_dimension);
  EXPECT_EQ(code_of([&] { t.insert(not_finite); }), Errc::not_finite);
  EXPECT_EQ(code_of([&] { t.insert(fine, no_cell); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { t.insert_range(three); }), Errc::bad_dimension);
  EXPECT_EQ(code_of([&] { t.insert_range(not_finite); }), Errc::not_finite);
  EXPECT_EQ(code_of([&] { t.move(3, three); }), Errc::bad_dimension);
  EXPECT_EQ(code_of([&] { t.move(3, not_finite); }), Errc::not_finite);
  EXPECT_EQ(code_of([&] { t.move(7, fine); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { t.remove(7); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { t.remove(50); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { t.locate(three); }), Errc::bad_dimension);
  EXPECT_EQ(code_of([&] { t.locate(not_finite); }), Errc::not_finite);
  EXPECT_EQ(code_of([&] { t.locate(fine, no_cell); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { t.conflict_zone(fine, no_cell); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { t.in_sphere(no_cell, fine); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { t.in_sphere(*t.infinite_cells().begin(), fine); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { t.point(infinite_vertex); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { t.row_of(VertexId{51}); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { t.is_hidden(50); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { t.changes(); }), Errc::invalid_argument);
  EXPECT_EQ(t.hash(), hash);
  EXPECT_EQ(t.num_rows(), 50u);
  ASSERT_TRUE(t.can_undo()) << "nothing has begun";
  t.undo();
  EXPECT_TRUE(t.has_row(7));
  EXPECT_EQ(message_of([&] { t.undo(); }),
            "there is nothing to undo; only edits after record_undo() can be undone");
}

TEST(TriangulationImpl, RefusesTheSameWithoutARecord) {
  Delaunay<> t(make_point_set("uniform", 3, 50, 1), 3);
  const CanonicalHash hash = t.hash();
  EXPECT_EQ(message_of([&] {
              t.move(3, Numbers{1, 2});
            }),
            "move: the number of coordinates is not a multiple of the dimension");
  EXPECT_EQ(message_of([&] { t.move(3, Numbers{1, 2, 3, 4, 5, 6}); }), "move: 2 points for 1 row");
  EXPECT_EQ(message_of([&] { t.move(3, Numbers{1, 2, nan}); }), "move: a coordinate for row 3 is not finite");
  EXPECT_EQ(message_of([&] { t.move(50, Numbers{1, 2, 3}); }), "move: row 50 is not a row of the input");
  EXPECT_EQ(message_of([&] { t.remove(50); }), "remove: row 50 is not a row of the input");
  EXPECT_EQ(t.hash(), hash);
  t.remove(4);
  EXPECT_EQ(message_of([&] { t.remove(4); }), "remove: row 4 was removed");
  EXPECT_EQ(message_of([&] { t.move(4, Numbers{1, 2, 3}); }), "move: row 4 was removed");
  EXPECT_EQ(t.num_points(), 49u);
}

TEST(TriangulationImpl, WeightsAreAsManyAsPoints) {
  Regular<> t(2);
  const Numbers points{0, 0, 1, 0}, one{1}, two{1, 2};
  EXPECT_EQ(message_of([&] { t.insert_range(points, one); }), "1 weights for 2 points");
  EXPECT_EQ(message_of([&] { t.insert_range(points, Numbers{}); }), "0 weights for 2 points");
  EXPECT_EQ(code_of([&] { t.insert_range(points, Numbers{1, nan}); }), Errc::not_finite);
  EXPECT_EQ(code_of([&] { t.insert({0, 0}, nan); }), Errc::not_finite);
  EXPECT_EQ(t.num_rows(), 0u);
  t.insert_range(Numbers{}, Numbers{});
  t.insert_range(points, two);
  EXPECT_EQ(t.weight(t.vertex_at(1)), 2);
}

TEST(TriangulationImpl, OfNoPointNothingIsInConflict) {
  const Delaunay<> t(2);
  const Numbers q{1, 2};
  EXPECT_EQ(t.locate(q).kind, Location::Kind::outside_affine_hull);
  EXPECT_TRUE(t.conflict_zone(q).empty());
  EXPECT_EQ(code_of([&] { t.in_sphere(CellId{0}, q); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { t.locate(q, CellId{0}); }), Errc::invalid_argument);
}

TEST(TriangulationImpl, OfOnePointTheHeavierIsInConflict) {
  const Numbers there{1, 2}, elsewhere{1, 3};
  const Delaunay<> t(there, 2);
  EXPECT_EQ(t.locate(there).kind, Location::Kind::on_vertex);
  EXPECT_EQ(t.locate(there).face, std::vector<VertexId>{t.vertex_at(0)});
  EXPECT_EQ(t.locate(elsewhere).kind, Location::Kind::outside_affine_hull);
  EXPECT_TRUE(t.conflict_zone(there).empty());
  EXPECT_EQ(t.in_sphere(CellId{0}, there), Side::on);
  EXPECT_EQ(code_of([&] { t.in_sphere(CellId{0}, elsewhere); }), Errc::invalid_argument);
  EXPECT_EQ(code_of([&] { t.in_sphere(CellId{1}, there); }), Errc::invalid_argument);
  const Regular<> weighted(there, Numbers{5}, 2);
  EXPECT_EQ(weighted.conflict_zone(there, 6), std::vector<CellId>{CellId{0}});
  EXPECT_TRUE(weighted.conflict_zone(there, 5).empty());
  EXPECT_TRUE(weighted.conflict_zone(elsewhere, 6).empty()) << "not in the flat";
  EXPECT_EQ(weighted.in_power_sphere(CellId{0}, there, 6), Side::inside);
  EXPECT_EQ(weighted.in_power_sphere(CellId{0}, there, 5), Side::on);
  EXPECT_EQ(weighted.in_power_sphere(CellId{0}, there, 4), Side::outside);
}

TEST(TriangulationImpl, InAFlatQueriesAreOfTheFlat) {
  const Delaunay<> t(Numbers{0, 0, 1, 2, 0, 1, 0, 2, 1}, 3);
  const CellId cell = *t.finite_cells().begin();
  EXPECT_EQ(t.in_sphere(cell, Numbers{1, 1, 1}), Side::inside);
  EXPECT_EQ(t.in_sphere(cell, Numbers{2, 2, 1}), Side::on);
  EXPECT_EQ(t.in_sphere(cell, Numbers{3, 2, 1}), Side::outside);
  EXPECT_EQ(code_of([&] { t.in_sphere(cell, Numbers{1, 1, 1.5}); }), Errc::invalid_argument);
  EXPECT_TRUE(t.conflict_zone(Numbers{0.5, 0.5, 1.5}).empty());
  EXPECT_EQ(t.conflict_zone(Numbers{0.5, 0.5, 1}), std::vector<CellId>{cell});
}

TEST(TriangulationImpl, OfFurthestSitesOutsideIsInConflict) {
  const FurthestSite<> t(Numbers{0, 0, 2, 0, 0, 2}, 2);
  const CellId cell = *t.finite_cells().begin();
  EXPECT_EQ(t.in_sphere(cell, Numbers{1, 1}), Side::inside);
  EXPECT_EQ(t.in_sphere(cell, Numbers{3, 3}), Side::outside);
  EXPECT_TRUE(t.conflict_zone(Numbers{0.5, 0.5}).empty());
  EXPECT_FALSE(t.conflict_zone(Numbers{3, 3}).empty());
}

TEST(TriangulationImpl, IsNotEditedByItsOwnProgressFunction) {
  std::vector<std::string> messages;
  Delaunay<>* building = nullptr;
  Options options;
  options.progress = [&](double) {
    if (building == nullptr || !messages.empty()) return true;
    for (const auto& call : std::vector<std::function<void()>>{
             [&] {
               building->insert({0, 0, 0});
             },
             [&] {
               building->insert_range(Numbers{0, 0, 0});
             },
             [&] { building->remove(0); }, [&] { building->undo(); }, [&] { building->compact(); },
             [&] { building->compact_ids(); }, [&] { building->sort_cells(); }})
      messages.push_back(message_of(call));
    return true;
  };
  Delaunay<> t(3, options);
  building = &t;
  const Numbers points = make_point_set("uniform", 3, 20000, 1);
  t.insert_range(points);
  EXPECT_EQ(messages, std::vector<std::string>(7, "the triangulation is being edited"));
  building = nullptr;
  EXPECT_EQ(t.num_rows(), 20000u);
  t.insert({2, 2, 2});  // it is not any more
  EXPECT_EQ(t.num_rows(), 20001u);
}

TEST(TriangulationImpl, IdsAreCompactedWhateverIsLeft) {
  Delaunay<> t(Numbers{0, 0, 1, 1, 1, 1, 3, 4}, 2);
  t.record_undo();
  t.remove(std::vector<std::size_t>{0, 3});
  EXPECT_EQ(t.affine_dimension(), 0);
  CompactedIds ids = t.compact_ids();
  EXPECT_FALSE(t.can_undo());
  EXPECT_EQ(ids.rows, (std::vector<std::size_t>{CompactedIds::no_row, 0, 1, CompactedIds::no_row}));
  EXPECT_EQ(t.vertex_at(0), VertexId{1});
  EXPECT_EQ(t.vertex_at(1), VertexId{1});
  EXPECT_EQ(t.point(VertexId{1})[0], 1);
  t.insert({5, 6});
  EXPECT_EQ(t.vertex_at(2), VertexId{2});
  EXPECT_EQ(t.affine_dimension(), 1);
  t.remove(std::vector<std::size_t>{0, 1, 2});
  ids = t.compact_ids();
  EXPECT_EQ(t.num_rows(), 0u);
  EXPECT_EQ(ids.vertices, (std::vector<VertexId>{infinite_vertex, invalid_vertex, invalid_vertex}));
  EXPECT_EQ(t.insert({5, 6}).vertex, VertexId{1});
}

TEST(TriangulationImpl, AfterCompactEveryChangeWorks) {
  const Numbers points = make_point_set("uniform", 3, 60, 1);
  const Delaunay<> expected(points, 3);
  for (const bool records : {false, true})
    for (int change = 0; change < 6; ++change) {
      Delaunay<> t(points, 3), same = expected.clone();
      t.record_undo(records);
      t.compact();
      t.compact();
      EXPECT_EQ(t.hash(), expected.hash());
      const auto apply = [&](Delaunay<>& to) {
        const CellId hint = *to.finite_cells().begin();
        if (change == 0) to.insert({0.5, 0.5, 0.5}, hint);
        if (change == 1) to.insert_range(Numbers{0.5, 0.5, 0.5, 2, 2, 2});
        if (change == 2) to.remove(11);
        if (change == 3) to.move(11, Numbers{0.5, 0.25, 0.125});
        if (change == 4) to.edit({.remove = std::vector<std::size_t>{1, 2}, .insert = Numbers{3, 3, 3}});
        if (change == 5) to.compact_ids();
      };
      apply(t);
      apply(same);
      EXPECT_EQ(t.hash(), same.hash()) << change;
      EXPECT_TRUE(check(t.to_data()).ok);
      EXPECT_EQ(t.can_undo(), records && change < 5);
      if (!t.can_undo()) continue;
      t.undo();
      EXPECT_EQ(t.hash(), expected.hash());
    }
  Delaunay<> one(Numbers{1, 2}, 2);  // without cells that could be compacted
  one.compact();
  one.insert({3, 4});
  EXPECT_EQ(one.num_vertices(), 2u);
}

TEST(TriangulationImpl, AnInsertionWithAHintIsThatWithout) {
  for (const bool records : {false, true}) {
    Delaunay<> hinted(make_point_set("uniform", 2, 200, 1), 2), other = hinted.clone();
    hinted.record_changes(records);
    const Numbers more = make_point_set("uniform", 2, 30, 2);
    for (std::size_t i = 0; i < more.size(); i += 2) {
      const auto point = std::span(more).subspan(i, 2);
      for (int twice = 0; twice < 2; ++twice) {
        const InsertResult a = hinted.insert(point, *hinted.all_cells().begin()), b = other.insert(point);
        EXPECT_EQ(a.vertex, b.vertex);
        EXPECT_EQ(a.inserted, twice == 0);
        EXPECT_EQ(b.inserted, twice == 0);
      }
    }
    EXPECT_EQ(hinted.hash(), other.hash());
    EXPECT_EQ(hinted.num_duplicates(), 30u);
  }
}

TEST(TriangulationImpl, HiddenPointsTellWhatHidesThem) {
  Regular<> t(Numbers{0, 0, 4, 0, 0, 4, 1, 1}, Numbers{0, 0, 0, -50}, 2);
  EXPECT_EQ(t.hidden_rows(), std::vector<std::size_t>{3});
  EXPECT_EQ(t.hiding_cell(3), *t.finite_cells().begin());
  EXPECT_EQ(message_of([&] { t.hiding_cell(0); }), "row 0 is not hidden");
  EXPECT_EQ(code_of([&] { t.hiding_cell(4); }), Errc::invalid_argument);
  const InsertResult hidden = t.insert({1, 2}, -50);
  EXPECT_EQ(hidden.vertex, invalid_vertex);
  EXPECT_FALSE(hidden.inserted);
  t.record_changes();
  EXPECT_EQ(t.insert({2, 1}, -50).vertex, invalid_vertex) << "the same on record";
  EXPECT_EQ(t.num_hidden(), 3u);
  t.remove(3);
  EXPECT_FALSE(t.is_hidden(3)) << "a row that was removed is not hidden";
  EXPECT_EQ(t.num_hidden(), 2u);
}

bool are_equal(const Changes& a, const Changes& b) {
  return a.removed_cells == b.removed_cells && a.created_cells == b.created_cells &&
         a.added_vertices == b.added_vertices && a.removed_vertices == b.removed_vertices &&
         a.hidden_vertices == b.hidden_vertices && a.reappeared_vertices == b.reappeared_vertices &&
         a.moved_vertices == b.moved_vertices;
}

/// Those of some cells, in ascending order, that are infinite.
std::vector<CellId> infinite_cells_of(const Triangulation& t, const std::vector<CellId>& among) {
  std::vector<CellId> cells;
  for (const CellId c : t.infinite_cells())
    if (std::binary_search(among.begin(), among.end(), c)) cells.push_back(c);
  std::sort(cells.begin(), cells.end());
  return cells;
}

/// A small edit, a batch, a step of all points, a rebuild, and an edit that lowers the dimension.
const std::vector<std::function<void(Delaunay<>&)>>& kinds_of_changes() {
  static const std::vector<std::function<void(Delaunay<>&)>> kinds{
      [](Delaunay<>& t) { t.remove(3); },
      [](Delaunay<>& t) { t.insert_range(make_point_set("uniform", 2, 300, 2)); },
      [](Delaunay<>& t) {
        std::vector<std::size_t> rows;
        Numbers to;
        for (std::size_t row = 0; row < t.num_rows(); ++row) {
          rows.push_back(row);
          const auto point = t.point(t.vertex_at(row));
          to.insert(to.end(), {point[0] + 0.004 * static_cast<double>(row % 3), point[1]});
        }
        t.edit({.move = rows, .to = to});
      },
      [](Delaunay<>& t) {
        std::vector<std::size_t> rows;
        for (std::size_t row = 0; row + 20 < t.num_rows(); ++row) rows.push_back(row);
        t.remove(rows);
      },
      [](Delaunay<>& t) {
        std::vector<std::size_t> rows;
        for (std::size_t row = 2; row < t.num_rows(); ++row) rows.push_back(row);
        t.remove(rows);
      }};
  return kinds;
}

TEST(TriangulationImpl, ChangesAreThoseOfTheLastCallWheneverTheyAreAskedFor) {
  bool goes_on = true;
  Options options;
  options.progress = [&](double) { return goes_on; };
  const Delaunay<> start(make_point_set("uniform", 2, 400, 1), 2, options);
  for (std::size_t kind = 0; kind < kinds_of_changes().size(); ++kind)
    for (const bool records_undo : {false, true}) {
      SCOPED_TRACE(testing::Message() << "change " << kind << ", undo " << records_undo);
      Delaunay<> early = start.clone(), late = start.clone(), copied = start.clone();
      for (Delaunay<>* t : {&early, &late, &copied}) {
        t->record_changes();
        t->record_undo(records_undo);
        kinds_of_changes()[kind](*t);
      }
      const Changes expected = early.changes();
      EXPECT_FALSE(expected.removed_cells.empty());
      const std::vector<CellId> infinite = infinite_cells_of(start, expected.removed_cells);
      EXPECT_EQ(early.removed_infinite_cells(), infinite);
      EXPECT_EQ(late.can_undo(), records_undo);
      EXPECT_TRUE(are_equal(copied.clone().changes(), expected)) << "of a copy";
      late.record_undo(!records_undo);
      EXPECT_EQ(late.can_undo(), false) << "what was not recorded cannot be undone";
      goes_on = false;  // a call that fails has no changes of its own
      EXPECT_EQ(code_of([&] { kinds_of_changes()[1](late); }), Errc::cancelled);
      goes_on = true;
      EXPECT_TRUE(are_equal(late.changes(), expected));
      EXPECT_EQ(late.removed_infinite_cells(), infinite);
      EXPECT_EQ(late.hash(), early.hash());
      if (!records_undo) continue;
      const std::vector<CellId> new_infinite = infinite_cells_of(early, expected.created_cells);
      early.undo();
      EXPECT_EQ(early.changes().removed_cells, expected.created_cells);
      EXPECT_EQ(early.removed_infinite_cells(), new_infinite);
      EXPECT_EQ(early.hash(), start.hash());
    }
}

TEST(TriangulationImpl, ChangesBeforeTheyWereWantedAreNone) {
  Delaunay<> t(make_point_set("uniform", 2, 50, 1), 2);
  t.record_undo();
  t.remove(7);
  t.record_changes();
  EXPECT_TRUE(are_equal(t.changes(), {}));
  ASSERT_TRUE(t.can_undo());
  t.undo();
  EXPECT_EQ(t.num_points(), 50u);
  t.remove(8);
  t.record_changes(false);
  ASSERT_TRUE(t.can_undo());
  t.record_undo(false);
  t.insert({0.5, 0.5});  // nothing of it is recorded any more
  EXPECT_TRUE(check(t.to_data()).ok);
  EXPECT_EQ(t.num_points(), 50u);
}

TEST(TriangulationImpl, SortingKeepsTheRecordOfACallThatMadeAllCells) {
  Options options;
  options.threads = 2;
  const Numbers points = make_point_set("uniform", 3, 4000, 1), more = make_point_set("uniform", 3, 1000, 2);
  Delaunay<> sorted(3, options);
  sorted.insert_range(points);
  sorted.sort_cells();
  for (const bool asks_before : {false, true}) {
    Delaunay<> t(3, options);
    t.sort_cells_later();
    t.record_changes();
    t.record_undo();
    t.insert_range(points);
    if (asks_before) {
      EXPECT_EQ(t.changes().created_cells.size(), std::size_t{t.num_all_cells()});
    }
    t.sort_cells();
    EXPECT_EQ(t.to_data().cells, sorted.to_data().cells);
    ASSERT_EQ(t.changes().created_cells.size(), std::size_t{t.num_all_cells()});
    for (const CellId c : t.changes().created_cells) EXPECT_TRUE(t.complex().is_cell(c));
    ASSERT_TRUE(t.can_undo());
    t.undo();
    EXPECT_EQ(t.num_rows(), 0u);
  }
  Delaunay<> t(3, options);
  t.insert_range(points);
  t.record_changes();
  t.record_undo();
  t.insert_range(more);
  EXPECT_FALSE(t.changes().removed_cells.empty());
  t.sort_cells();
  EXPECT_TRUE(are_equal(t.changes(), {}));
  EXPECT_FALSE(t.can_undo());
}

}  // namespace
}  // namespace delone::triangulation
