// SPDX-License-Identifier: BSD-3-Clause
// The points of a periodic set, read one after the other: each on the grid of the set and in the box of its
// lattice. And what is known of all of them before the first tile.
#pragma once

#include "periodic/extent.hpp"
#include "periodic/periodic_set.hpp"
#include "tiles/point_stream.hpp"
#include "tiles/survey.hpp"

#include <delone/tiles.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

namespace delone::tiles {

/// What is known of a set without its points, of rows of so many numbers. The options outlive the result.
/// Throws bad_dimension if the lattice has another dimension.
periodic::SetInput input_of_set(int row_size, const TilesOptions& options);

/// Reads the points once if the lattice has less than d vectors. Throws as PeriodicTriangulation.
periodic::PeriodicSet make_set(PointStream& points, const TilesOptions& options);

/// The lattice on its grid, in the numbers of the caller.
Lattice lattice_of(const periodic::PeriodicSet& set);

/// The points of another stream as numbers of a set. Both outlive the object.
class PlacedPoints final : public PointStream {
 public:
  /// `first_row` returns the row of the first point of those that the other stream has returned last; if it
  /// is not given, rows are counted.
  PlacedPoints(PointStream& points, const periodic::PeriodicSet& set,
               std::function<std::int64_t()> first_row = {})
      : points_(points), set_(set), first_row_(std::move(first_row)) {}

  int dimension() const override { return points_.dimension(); }
  std::optional<std::uint64_t> size_hint() const override { return points_.size_hint(); }
  bool next(std::vector<double>& rows) override;
  void rewind() override;

  /// Sees each point that is read, and its row.
  std::function<void(const double*, std::int64_t)> observer;

 private:
  PointStream& points_;
  const periodic::PeriodicSet& set_;
  const std::function<std::int64_t()> first_row_;
  std::int64_t num_read_ = 0;
};

struct PeriodicSurvey {
  SurveyResult result;
  periodic::Extent extent;
  int finest_bit;  ///< of lattice and points, for periodic_hash.hpp
};

/// From the survey of the points in the box, to that of all their translates: their affine dimension, and
/// along the lattice the box has no ends.
void add_translates(const periodic::PeriodicSet& set, Survey& survey);

/// Reads the points once, as make_survey(), and adds their translates.
PeriodicSurvey make_periodic_survey(PlacedPoints& points, const periodic::PeriodicSet& set,
                                    std::size_t sample_size = default_sample_size, std::uint64_t seed = 0);

}  // namespace delone::tiles
