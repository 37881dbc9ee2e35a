// SPDX-License-Identifier: BSD-3-Clause
// What a tile knows of the points that are not its own, and asks for those that are in conflict with a cell:
// the points of other tiles, and in a periodic set translates of all points.
#pragma once

#include "pages/page_tree.hpp"
#include "pages/pages.hpp"
#include "tiles/survey.hpp"

#include <compare>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

namespace delone::tiles {

using pages::PageSource;
using pages::PageTree;
using pages::PointPlace;

/// A point of a page, translated by a shift; 0 is no translation.
struct ForeignPlace {
  std::uint32_t shift = 0;
  PointPlace point;
  friend auto operator<=>(const ForeignPlace&, const ForeignPlace&) = default;
};

/// What a search has found.
struct ForeignAnswer {
  bool is_open = false;     ///< a point is in conflict: `place`
  bool is_waiting = false;  ///< a page that may hold a better one is not here yet
  ForeignPlace place;
};

/// Whether a point, its weight included, is in conflict with the cell that is asked about. Exact.
using IsInConflict = std::function<bool(const double*)>;

/// The questions of one thread. question.hpp says what is asked, and which point is found.
class ForeignSearch {
 public:
  virtual ~ForeignSearch() = default;
  /// Of a finite cell with the vertex p and this center, correctly rounded.
  virtual ForeignAnswer within_sphere(const double* p, const double* center,
                                      const IsInConflict& is_in_conflict) = 0;
  /// Of an infinite cell with the vertex p: the outward unit normal of its facet, with an error below 1e-12.
  virtual ForeignAnswer beyond_facet(const double* p, const double* normal,
                                     const IsInConflict& is_in_conflict) = 0;
  virtual std::uint64_t num_pages() const = 0;  ///< looked at
  virtual std::uint64_t num_exact() const = 0;  ///< points that rounded numbers did not decide
};

/// Points that a triangulation begins with besides those of the tile: rows of coordinates, and a weight if
/// there is one; the rows of the input, and the shifts.
struct StartingPoints {
  std::vector<double> points;
  std::vector<std::int64_t> rows;
  std::vector<std::uint32_t> shifts;
};

class Surroundings {
 public:
  virtual ~Surroundings() = default;
  /// The points that settle the affine dimension.
  virtual StartingPoints starting_points() = 0;
  /// A search for one thread. REQUIRES that one thread makes all searches. `largest_weight`: a bound of |w|
  /// of all points.
  virtual std::unique_ptr<ForeignSearch> make_search(double largest_weight) = 0;
  /// Whether it is certain that no translate but that by shift 0 is in the ball.
  virtual bool is_within_period(const double* center, double radius) const = 0;
  /// The row of the input, and the point itself, weight included, if its page is here.
  virtual std::int64_t copy_point(const ForeignPlace& place, double* point) = 0;
  /// A point that was inserted is no answer from now on.
  virtual void know(const ForeignPlace& place) = 0;
  virtual bool knows(std::size_t page, std::size_t slot) const = 0;
  /// How many vectors of the lattice a shift consists of, and their sum. Empty in an open set.
  virtual std::span<const std::int32_t> offset(std::uint32_t shift) const = 0;
  virtual std::span<const double> translation(std::uint32_t shift) const = 0;
  /// The number of vectors of the lattice; 0: an open set.
  virtual std::size_t rank() const = 0;
};

/// Those of a tile of an open set. All references outlive the result.
std::unique_ptr<Surroundings> open_surroundings(const Survey& survey, const PageTree& tree,
                                                PageSource& source, std::size_t tile);

}  // namespace delone::tiles
