// SPDX-License-Identifier: BSD-3-Clause
// The cost of a Delaunay triangulation before it is made: cells, memory and time.
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

/// A predicted quantity.
struct ForecastQuantity {
  double expected = 0;
  double low = 0, high = 0;  ///< a range that holds the truth for nine of ten forecasts
};

/// The predicted cost of `Delaunay<>(points, dimension)`.
struct Forecast {
  int dimension = 0;          ///< d
  int affine_dimension = -1;  ///< k ≤ d, if known from points; −1 for no points
  std::size_t num_points = 0;
  unsigned threads = 1;         ///< the number that will build
  std::size_t num_sampled = 0;  ///< points of the largest triangulated sample; 0: only the model
  ForecastQuantity vertices;    ///< distinct points
  ForecastQuantity cells;       ///< finite ones
  ForecastQuantity bytes;       ///< the peak, on top of the points themselves
  ForecastQuantity seconds;     ///< wall-clock time on this machine if it is otherwise idle
};

/// A forecast for n points of a kind (point_set_kinds()), without any points.
///
/// Uses closed forms if there are any (Poisson–Delaunay constants, Miles 1974, Møller 1994, which are limits
/// for uniform points by Dwyer 1991, doi:10.1007/BF02574694; the moment curve by Gale's evenness condition;
/// lattices by volume). The influence of the border and all costs are fitted to recorded constructions
/// (benchmarks/fit_forecast.py). Times are scaled to this machine by building a small set, which takes about
/// 50 milliseconds. For the recorded kinds, cells, bytes and seconds are within a factor of 1.5 of the truth
/// in up to 8 dimensions; beyond 8 they are extrapolated and rough. `threads` as in Options.
///
/// Throws Errc::bad_dimension unless dimension ≥ 1, and Errc::invalid_argument for an unknown kind.
DELONE_EXPORT Forecast forecast(int dimension, std::size_t num_points, std::string_view kind = "uniform",
                                unsigned threads = 1);

struct EstimateOptions {
  unsigned threads = 1;  ///< of the construction, as in Options; one thread builds the samples
  /// About the most seconds spent on samples once they have 20 000 cells; less if that exceeds a twentieth of
  /// the construction. Must be finite and > 0.
  double sample_seconds = 1;
  std::function<bool(double)> progress = {};  ///< as in Options
};

/// A forecast for given points, from triangulations of samples: random subsets of growing size, chosen by a
/// hash of the coordinates. Their size depends on time, all else on the set of points alone. Beyond the
/// largest sample the growth is that of the recorded kinds that grew like the samples. A lattice, which no
/// subset reveals, is recognized by the distances of nearest neighbors; its cells follow from its volume.
/// Duplicates are counted.
///
/// Cost: about a twentieth of the construction or 0.3 seconds, at most sample_seconds, and O(n·d) to read the
/// points, up to 15 times. Throws Errc::not_finite, bad_dimension, cancelled, out_of_memory, and
/// invalid_argument for sample_seconds.
DELONE_EXPORT Forecast estimate(const AnyPoints<>& points, int dimension,
                                const EstimateOptions& options = {});

}  // namespace delone
