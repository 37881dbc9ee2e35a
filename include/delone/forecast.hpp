// SPDX-License-Identifier: BSD-3-Clause
// The cost of a Delaunay triangulation before it is made: cells, memory and time.
#pragma once

#include <delone/export.hpp>
#include <delone/points.hpp>

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
  std::size_t num_sampled = 0;  ///< points of the largest triangulated sample; 0: a closed form
  ForecastQuantity vertices;    ///< distinct points
  ForecastQuantity cells;       ///< finite ones
  ForecastQuantity bytes;       ///< the peak, on top of the points themselves
  ForecastQuantity seconds;     ///< wall-clock time on this machine if it is otherwise idle
};

/// Which construction is forecast, and how.
struct ForecastOptions {
  unsigned threads = 1;  ///< those of the construction, as in Options; one thread builds the samples
  /// About the most seconds spent on samples once they have 20 000 cells; less if that exceeds a twentieth of
  /// the construction. Must be finite and > 0.
  double sample_seconds = 1;
  std::function<bool(double)> progress = {};  ///< as Execution::progress, of the forecast itself
};

/// A forecast for n points of a kind (point_set_kinds()), without any points.
///
/// Uniform points have a closed form: the Poisson–Delaunay constant (Miles 1974, Møller 1994), which is their
/// limit (Dwyer 1991, doi:10.1007/BF02574694), with measured constants for the influence of the border and
/// for costs, from 9 dimensions on the same for all. Times are scaled to this machine by building a small
/// set, which takes about 50 milliseconds. Lattices have cells by their volume, and the moment curve by
/// Gale's evenness condition. What else is unknown follows from samples that are generated and triangulated,
/// as estimate() does it. Within a factor of 1.5 of the truth in up to 8 dimensions; beyond 8 every kind is
/// forecast as uniform points are, and the range is as wide as what has not been measured makes it.
///
/// Throws Errc::bad_dimension unless dimension ≥ 1, invalid_argument for an unknown kind and for
/// sample_seconds, cancelled, and out_of_memory.
DELONE_EXPORT Forecast forecast(int dimension, std::size_t num_points, std::string_view kind = "uniform",
                                const ForecastOptions& options = {});

/// A forecast for given points, from triangulations of samples: random subsets of growing size, chosen by a
/// hash of the coordinates. Their size depends on time, all else on the set of points alone. Beyond the
/// largest sample the number of cells is compared with that of points that are spread evenly, and the
/// difference goes on as it did among the samples. A lattice, which no subset reveals, is recognized by the
/// distances of nearest neighbors; its cells follow from its volume. Duplicates are counted.
///
/// Cost: about a twentieth of the construction or 0.3 seconds, at most sample_seconds, and O(n·d) to read the
/// points, up to 15 times. A sample is given up 0.2 seconds of processor time after sample_seconds, or after
/// a second if that is later; on a busy machine, after 0.3 seconds on the clock. Then the estimate rests on
/// smaller samples, or on points spread evenly, and the range shows it. Throws Errc::not_finite,
/// bad_dimension, cancelled, out_of_memory, and invalid_argument for sample_seconds.
DELONE_EXPORT Forecast estimate(const AnyPoints<>& points, int dimension,
                                const ForecastOptions& options = {});

/// What to tell a user before a construction makes the machine swap: a sentence if more memory is expected to
/// be needed than the system has available to this process, otherwise empty, as on systems that do not tell.
/// The command and the Python module ask it before they build without a limit of memory.
DELONE_EXPORT std::string memory_warning(const Forecast& forecast);

/// The same for given points: estimate() is asked only if so many points, spread evenly, would take a quarter
/// of what is available, or more. So smaller sets cost less than a microsecond, and those with four times as
/// many cells as points spread evenly may be missed. Throws as estimate().
DELONE_EXPORT std::string memory_warning(const AnyPoints<>& points, int dimension,
                                         const ForecastOptions& options = {});

/// Whether tiles (delone/tiles.hpp) are worth their cost where points, spread evenly, do not fit into
/// `memory` bytes: a tile that fits must insert no more points of other tiles than of its own. Tiles make the
/// largest piece smaller, and the whole larger; in many dimensions points of other tiles soon dominate. A
/// closed form. Throws Errc::bad_dimension unless dimension ≥ 1.
DELONE_EXPORT bool tiles_pay(int dimension, std::size_t num_points, std::size_t memory);

}  // namespace delone
