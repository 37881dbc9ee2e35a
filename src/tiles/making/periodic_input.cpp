// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/making/periodic_input.hpp"

#include "kernel/predicates.hpp"
#include "periodic/periodic_hash.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <limits>
#include <string>

namespace delone::tiles {

periodic::SetInput input_of_set(int row_size, const TilesOptions& options) {
  const int d = row_size - (options.weighted ? 1 : 0);
  if (options.lattice.dimension != d)
    throw Error(Errc::bad_dimension, "the lattice has " + std::to_string(options.lattice.dimension) +
                                         " dimensions, not " + std::to_string(d));
  periodic::SetInput input;
  input.lattice = options.lattice.vectors;
  input.dimension = static_cast<std::size_t>(d);
  input.is_weighted = options.weighted;
  input.unit = options.unit;
  return input;
}

periodic::PeriodicSet make_set(PointStream& points, const TilesOptions& options) {
  const periodic::SetInput input = input_of_set(points.dimension(), options);
  const std::vector<double> free = periodic::free_extent(
      input, [&](const std::function<void(const double*)>& visit) { each_point(points, visit); });
  return periodic::make_set_without_rows(input, free);
}

Lattice lattice_of(const periodic::PeriodicSet& set) {
  Lattice lattice{static_cast<int>(set.dimension), {}};
  for (const double x : set.lattice) lattice.vectors.push_back(set.outer(x));
  return lattice;
}

bool PlacedPoints::next(std::vector<double>& rows) {
  if (!points_.next(rows)) return false;
  if (first_row_) num_read_ = first_row_();
  for (std::size_t at = 0; at < rows.size(); at += set_.row_size()) {
    set_.place(static_cast<std::size_t>(num_read_), &rows[at]);
    if (observer) observer(&rows[at], num_read_);
    ++num_read_;
  }
  return true;
}

void PlacedPoints::rewind() {
  points_.rewind();
  num_read_ = 0;
}

void add_translates(const periodic::PeriodicSet& set, Survey& survey) {
  if (survey.num_points == 0) return;
  kernel::AffineHull hull(survey.dimension);
  for (std::size_t at = 0; at < survey.landmarks.size(); at += set.row_size())
    hull.add(&survey.landmarks[at]);
  for (std::size_t i = 0; i < set.rank; ++i) {
    std::vector<double> image(survey.landmarks.begin(),
                              survey.landmarks.begin() + static_cast<std::ptrdiff_t>(set.dimension));
    for (std::size_t j = 0; j < set.dimension; ++j) {
      image[j] += set.period.vector(i)[j];
      if (set.period.vector(i)[j] == 0) continue;
      survey.low[j] = -std::numeric_limits<double>::infinity();
      survey.high[j] = std::numeric_limits<double>::infinity();
    }
    hull.add(image.data());
  }
  survey.affine_dimension = hull.dimension();
}

PeriodicSurvey make_periodic_survey(PlacedPoints& points, const periodic::PeriodicSet& set,
                                    std::size_t sample_size, std::uint64_t seed) {
  PeriodicSurvey made{{}, periodic::Extent(set), periodic::finest_bit(set.period)};
  points.observer = [&](const double* point, std::int64_t row) {
    made.extent.add(point, row);
    made.finest_bit = std::min(made.finest_bit, periodic::finest_bit(point, set.dimension));
  };
  made.result = make_survey(points, set.weighted, sample_size, seed);
  points.observer = {};
  add_translates(set, made.result.survey);
  return made;
}

}  // namespace delone::tiles
