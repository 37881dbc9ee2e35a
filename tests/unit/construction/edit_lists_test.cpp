// SPDX-License-Identifier: BSD-3-Clause
// What is wrong with the lists of an edit: the list, the place in it and the row are named.
#include "construction/edit_lists.hpp"

#include <delone/error.hpp>

#include <gtest/gtest.h>

#include <limits>
#include <string>
#include <vector>

namespace delone::construction {
namespace {

using RowNumbers = std::vector<std::size_t>;
using Numbers = std::vector<double>;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Rows in the plane, each at a vertex of its own; row 2 was removed.
State state_of(std::size_t num_rows, kernel::RowForm form = kernel::RowForm::point) {
  State state(2, form, {});
  state.sites.add_rows(num_rows);
  for (std::size_t row = 0; row < num_rows; ++row) {
    const double point[] = {static_cast<double>(row), 0, 0};
    state.sites.assign(row, state.sites.points().append(point));
  }
  state.sites.detach(2);
  return state;
}

/// The message, or nothing. `places`: those that the error lists.
std::string problem(const State& state, const RowEdits& edits, Errc code = Errc::invalid_argument,
                    const RowNumbers& places = {}) {
  try {
    require_valid(state, edits);
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), code) << error.what();
    EXPECT_EQ(error.rows(), places) << error.what();
    return error.what();
  }
  return "";
}

TEST(EditLists, OfOneLengthBelongTogether) {
  const State state = state_of(9);
  const RowNumbers two{0, 1};
  const Numbers three{1, 2, 3}, four{1, 2, 3, 4}, one{1};
  const auto wrong = [&](const RowEdits& edits) { return problem(state, edits, Errc::bad_dimension); };
  EXPECT_EQ(wrong({}), "");
  EXPECT_EQ(wrong({.move = two, .to = four, .insert = four}), "");
  EXPECT_EQ(wrong({.move = two, .to = three}),
            "move: the number of coordinates is not a multiple of the dimension");
  EXPECT_EQ(wrong({.insert = three}), "insert: the number of coordinates is not a multiple of the dimension");
  EXPECT_EQ(wrong({.move = two}), "move: 0 points for 2 rows");
  EXPECT_EQ(wrong({.to = std::span(four).first(2)}), "move: 1 point for 0 rows");
  EXPECT_EQ(wrong({.reweight = std::span(two).first(1)}), "set_weights: 0 weights for 1 row");
  const State weighted = state_of(9, kernel::RowForm::weighted_point);
  EXPECT_EQ(problem(weighted, {.insert = four, .insert_weights = one}, Errc::bad_dimension),
            "insert: 1 weight for 2 points");
  EXPECT_EQ(problem(weighted, {.insert_weights = one}, Errc::bad_dimension), "insert: 1 weight for 0 points");
}

TEST(EditLists, WeightsAreForPointsThatHaveThem) {
  const State state = state_of(9);
  const RowNumbers row{0};
  const Numbers weight{1}, point{1, 2};
  EXPECT_EQ(problem(state, {.reweight = row, .weights = weight}),
            "set_weights: points of this triangulation have no weights");
  EXPECT_EQ(problem(state, {.insert = point, .insert_weights = weight}),
            "insert: points of this triangulation have no weights");
  EXPECT_EQ(problem(state_of(9, kernel::RowForm::weighted_point),
                    {.reweight = row, .weights = weight, .insert = point, .insert_weights = weight}),
            "");
}

TEST(EditLists, RowsAreThereAndDifferent) {
  // Few rows of many are compared in another way.
  for (const std::size_t num_rows : {9u, 900u}) {
    const State state = state_of(num_rows);
    const RowNumbers beyond{num_rows}, removed{5, 2}, twice{0, 4, 6, 4};
    const Numbers points{1, 2, 3, 4, 5, 6, 7, 8};
    const std::string number = std::to_string(num_rows);
    EXPECT_EQ(problem(state, {.remove = beyond}, Errc::invalid_argument, {0}),
              "remove: row " + number + " is not a row of the input");
    EXPECT_EQ(problem(state, {.remove = removed}, Errc::invalid_argument, {1}),
              "remove[1]: row 2 was removed");
    EXPECT_EQ(problem(state, {.remove = twice}, Errc::invalid_argument, {3}),
              "remove[3]: row 4 is given twice, see remove[1]");
    EXPECT_EQ(problem(state, {.move = twice, .to = points}, Errc::invalid_argument, {3}),
              "move[3]: row 4 is given twice, see move[1]");
  }
}

TEST(EditLists, RemovedRowsAreInNoOtherList) {
  const State state = state_of(9, kernel::RowForm::weighted_point);
  const RowNumbers one{4}, several{6, 4}, moved{0, 4};
  const Numbers points{1, 2, 3, 4}, weights{1, 2};
  EXPECT_EQ(problem(state, {.remove = one, .move = moved, .to = points}, Errc::invalid_argument, {1}),
            "move[1]: row 4 is removed, see remove");
  EXPECT_EQ(
      problem(state, {.remove = several, .reweight = moved, .weights = weights}, Errc::invalid_argument, {1}),
      "set_weights[1]: row 4 is removed, see remove[1]");
  EXPECT_EQ(problem(state, {.move = moved, .reweight = moved, .to = points, .weights = weights}), "")
      << "a row may get another point and another weight";
}

TEST(EditLists, NumbersAreFinite) {
  const State state = state_of(9, kernel::RowForm::weighted_point);
  const RowNumbers rows{3, 5, 7}, row{3};
  const Numbers points{0, 0, 0, nan, nan, nan}, weights{nan, 0, nan}, fine{0, 0, 0, 0, 0, 0};
  const auto wrong = [&](const RowEdits& edits, const RowNumbers& places) {
    return problem(state, edits, Errc::not_finite, places);
  };
  EXPECT_EQ(wrong({.move = rows, .to = points}, {1, 2}),
            "move[1]: a coordinate for row 5 is not finite (and of 1 more)");
  EXPECT_EQ(wrong({.move = row, .to = std::span(points).subspan(2, 2)}, {0}),
            "move: a coordinate for row 3 is not finite");
  EXPECT_EQ(wrong({.reweight = rows, .weights = weights}, {0, 2}),
            "set_weights[0]: the weight for row 3 is not finite (and of 1 more)");
  EXPECT_EQ(wrong({.insert = points, .insert_weights = std::span(fine).first(3)}, {1, 2}),
            "insert[1]: a coordinate is not finite (and of 1 more)");
  EXPECT_EQ(wrong({.insert = fine, .insert_weights = weights}, {0, 2}),
            "insert[0]: the weight is not finite (and of 1 more)");
}

}  // namespace
}  // namespace delone::construction
