// SPDX-License-Identifier: BSD-3-Clause
// What a Delaunay triangulation will take: cells, memory and time, before it is made.
#pragma once

#include <delone/export.hpp>
#include <delone/points.hpp>
#include <delone/readable.hpp>

#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>

namespace delone {

/// A quantity that is not known exactly.
struct ForecastQuantity {
  double expected = 0;
  double low = 0, high = 0;  ///< a range that nine of ten such forecasts are in
};

/// What `Delaunay<>(points, dimension)` will take.
struct Forecast {
  int dimension = 0;          ///< d
  int affine_dimension = -1;  ///< k ≤ d, as far as the points tell; −1 for none
  std::size_t num_points = 0;
  unsigned threads = 1;         ///< that will build
  std::size_t num_sampled = 0;  ///< points of the largest sample that was triangulated; 0: a model alone
  ForecastQuantity vertices;    ///< distinct points
  ForecastQuantity cells;       ///< finite ones
  ForecastQuantity bytes;       ///< the peak, on top of the points themselves
  ForecastQuantity seconds;     ///< wall-clock time on this machine, when it does nothing else
};

/// A forecast for a kind of points (point_set_kinds()), n of them, without having any.
///
/// Closed forms where there are (Poisson–Delaunay constants, Miles 1974, Møller 1994, which are limits for
/// uniform points by Dwyer 1991, doi:10.1007/BF02574694; the moment curve by Gale's evenness condition;
/// lattices by volume), with what points at the border change and all costs fitted to recorded constructions
/// (benchmarks/fit_forecast.py). Times are adapted to this machine by building a small set, some 50
/// milliseconds. On the kinds that were recorded, cells, bytes and seconds are within a factor of 1.5 of what
/// comes in up to 8 dimensions; beyond 8 they are continued, and rough. `threads` as in Options.
///
/// Throws Errc::bad_dimension unless dimension ≥ 1, and Errc::invalid_argument for a kind that there is not.
DELONE_EXPORT Forecast forecast(int dimension, std::size_t num_points, std::string_view kind = "uniform",
                                unsigned threads = 1);

struct EstimateOptions {
  unsigned threads = 1;  ///< of the construction, as in Options; samples are built by one
  /// At most about so long samples are built, once they have 20 000 cells; less if that is more than a
  /// twentieth of the construction. Must be finite and > 0.
  double sample_seconds = 1;
  std::function<bool(double)> progress = {};  ///< as in Options
};

/// The same for points, of which samples are triangulated: random subsets of growing size, from a hash of
/// coordinates. How large they become is a question of time, all else depends on the set of points alone. The
/// growth beyond the largest is that of the recorded kinds that have grown like the samples. Where the points
/// are those of a lattice, which no subset tells, it is noticed by the distances of nearest neighbors, and
/// the cells of the whole follow from its volume. Duplicates are counted.
///
/// Cost: about a twentieth of the construction or 0.3 seconds, at most sample_seconds, and O(n·d) to read the
/// points, up to 15 times. Throws Errc::not_finite, bad_dimension, cancelled, invalid_argument.
DELONE_EXPORT Forecast estimate(const AnyPoints<>& points, int dimension,
                                const EstimateOptions& options = {});

}  // namespace delone
