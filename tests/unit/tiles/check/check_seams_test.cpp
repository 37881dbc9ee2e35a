// SPDX-License-Identifier: BSD-3-Clause
// Facets and ridges of cells in parts of their own, in the plane and on a line.
#include "tiles/check/check_seams.hpp"

#include "../../io/io_support.hpp"

#include <gtest/gtest.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace delone::tiles {
namespace {

/// A cell: its rows, and the neighbor that its part gives opposite each of them.
struct OneCell {
  std::vector<std::int64_t> rows, neighbors;
};

class CheckSeams : public delone_test::TemporaryDirectory {
 protected:
  /// Cell i is part i. `points`: of all rows.
  void start(int dimension, int affine_dimension, std::vector<double> points,
             const std::vector<OneCell>& cells, bool canonical = false) {
    index_.dimension = dimension;
    index_.affine_dimension = affine_dimension;
    reference_ = {};
    findings_ = Findings(CheckOptions::all);
    const auto d = static_cast<std::size_t>(dimension);
    seams_.emplace(index_, reference_, path("."), 100, 1000, canonical);
    for (std::size_t c = 0; c < cells.size(); ++c) {
      CheckedPart part;
      part.number = c;
      part.first_cell = static_cast<std::int64_t>(c);
      part.data.dimension = dimension;
      part.data.affine_dimension = affine_dimension;
      for (const std::int64_t row : cells[c].rows) {
        const auto at = points.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(row) * d);
        part.data.points.insert(part.data.points.end(), at, at + dimension);
        part.data.cells.push_back(static_cast<SignedIndex>(part.data.cells.size()));
      }
      part.tile.rows = cells[c].rows;
      part.tile.seams = cells[c].neighbors;
      for (std::size_t i = 0; i < cells[c].neighbors.size(); ++i)
        part.tile.neighbors.push_back(-2 - static_cast<std::int32_t>(i));
      if (c == 0) make_reference(part);
      change_(part);
      seams_->add(part);
    }
  }
  void match() {
    seams_->match_facets(findings_);
    seams_->match_ridges(findings_);
  }
  void expect_sound() {
    match();
    for (int level = 1; level <= 6; ++level) EXPECT_NO_THROW(findings_.require(level)) << level;
  }
  void expect_found(int level, const std::string& message, const std::vector<std::size_t>& cells) {
    match();
    for (int below = 1; below < level; ++below) EXPECT_NO_THROW(findings_.require(below)) << below;
    try {
      findings_.require(level);
      ADD_FAILURE() << "nothing at level " << level << "; expected " << message;
    } catch (const Violation& violation) {
      EXPECT_NE(violation.message.find(message), std::string::npos) << violation.message;
      EXPECT_EQ(violation.cells, cells);
    }
  }

  std::function<void(CheckedPart&)> change_ = [](CheckedPart&) {};
  TilesIndex index_;
  Reference reference_;
  Findings findings_{CheckOptions::all};
  std::optional<SeamChecker> seams_;

 private:
  void make_reference(const CheckedPart& part) {
    reference_.cell = part.first_cell;
    reference_.rows = part.tile.rows;
    reference_.points = part.data.points;
    reference_.row_size = static_cast<std::size_t>(index_.dimension);
    reference_.hull = kernel::AffineHull(index_.dimension);
    for (std::size_t i = 0; i < reference_.rows.size(); ++i) reference_.hull.add(reference_.point(i));
    reference_.axes = reference_.hull.axes();
  }
};

const std::vector<double> square{0, 0, 2, 0, 2, 2, 0, 2};

TEST_F(CheckSeams, SoundOnesPass) {
  start(2, 2, square, {{{0, 1, 2}, {-1, 1, -1}}, {{0, 2, 3}, {-1, -1, 0}}});
  expect_sound();
  EXPECT_EQ(seams_->num_hull_facets(), 4);
  EXPECT_EQ(seams_->ties(), 1u);
  start(1, 1, {0, 1, 3}, {{{0, 1}, {1, -1}}, {{1, 2}, {-1, 0}}});
  expect_sound();
  EXPECT_EQ(seams_->num_hull_facets(), 2);
  start(2, 0, {1, 2}, {{{0}, {-1}}});
  expect_sound();
}

TEST_F(CheckSeams, OneTriangulationOfTiesIsCanonical) {
  const std::vector<OneCell> one{{{0, 1, 2}, {-1, 1, -1}}, {{0, 2, 3}, {-1, -1, 0}}},
      other{{{0, 1, 3}, {1, -1, -1}}, {{1, 2, 3}, {-1, 0, -1}}};
  int found = 0;
  for (const std::vector<OneCell>& cells : {one, other}) {
    start(2, 2, square, cells);
    expect_sound();
    start(2, 2, square, cells, true);
    match();
    try {
      findings_.require(5);
    } catch (const Violation& violation) {
      ++found;
      EXPECT_NE(violation.message.find("is on, and when ties are perturbed inside, the sphere of cell 0"),
                std::string::npos)
          << violation.message;
    }
  }
  EXPECT_EQ(found, 1);
}

TEST_F(CheckSeams, AFacetHasTwoCells) {
  const std::vector<double> points{0, 0, 2, 0, 1, 2, 1, -2, 1, 5};
  start(2, 2, points, {{{0, 1, 2}, {-1, -1, 1}}, {{1, 0, 3}, {-1, -1, 0}}, {{0, 1, 4}, {-1, -1, 1}}});
  expect_found(2, "the cells 0, 1 and 2 share the facet {0, 1}", {0, 1, 2});
}

TEST_F(CheckSeams, CellsAreOnDifferentSides) {
  // Coherent, and folded over their facet; or one of them is flat.
  for (const double y : {3.0, 0.0}) {
    start(2, 2, {0, 0, 2, 0, 1, 2, 1, y}, {{{0, 1, 2}, {-1, -1, 1}}, {{1, 0, 3}, {-1, -1, 0}}});
    expect_found(4, "the cells 0 and 1 do not lie on different sides of their facet {0, 1}", {0, 1});
  }
}

TEST_F(CheckSeams, PointsAreTheSameInAllParts) {
  change_ = [](CheckedPart& part) {
    if (part.number == 1) part.data.points[0] = 1e-300;
  };
  start(2, 2, square, {{{0, 1, 2}, {-1, 1, -1}}, {{0, 2, 3}, {-1, -1, 0}}});
  expect_found(2, "the parts of the cells 0 and 1 have different coordinates for point 0", {0, 1});
}

TEST_F(CheckSeams, NeighborsNameEachOther) {
  start(2, 2, square, {{{0, 1, 2}, {-1, 1, -1}}, {{0, 2, 3}, {-1, -1, 7}}});
  expect_found(2, "cell 1 shares the facet {0, 2} with cell 0, but has 7 for its neighbor there", {1, 0});
  start(2, 2, square, {{{0, 1, 2}, {-1, -1, -1}}, {{0, 2, 3}, {-1, -1, 0}}});
  expect_found(2, "cell 0 shares the facet {0, 2} with cell 1, but has none for its neighbor there", {0, 1});
  start(2, 2, square, {{{0, 1, 2}, {-1, 1, 5}}, {{0, 2, 3}, {-1, -1, 0}}});
  expect_found(2, "the neighbor of cell 0 at the facet {0, 1} is cell 5, which does not share it", {0, 5});
  start(2, 2, square, {{{0, 1, 2}, {-1, 1, -1}}, {{2, 0, 3}, {-1, -1, 0}}});
  expect_found(2, "the cells 0 and 1 with the facet {0, 2} are not oriented coherently", {0, 1});
}

TEST_F(CheckSeams, ClosedSurfacesHaveNoHull) {
  // Four triangles around a tetrahedron, by their rows. What is below level 3 is right, and what their
  // places are is not looked at.
  start(2, 2, {0, 0, 0, 0, 0, 0, 0, 0},
        {{{0, 2, 1}, {2, 1, 3}}, {{0, 1, 3}, {2, 3, 0}}, {{1, 2, 3}, {3, 1, 0}}, {{0, 3, 2}, {2, 0, 1}}});
  findings_ = Findings(3);
  expect_found(3, "there is no hull: every facet is shared by two cells", {});
}

TEST_F(CheckSeams, OnePointHasOneCell) {
  start(2, 0, {1, 2, 3, 4}, {{{0}, {-1}}, {{1}, {-1}}});
  match();
  EXPECT_THROW(findings_.require(2), Violation) << "both have the empty facet";
}

}  // namespace
}  // namespace delone::tiles
