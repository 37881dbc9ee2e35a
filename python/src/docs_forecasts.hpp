// SPDX-License-Identifier: BSD-3-Clause
// Docstrings: forecasts. In the form of numpydoc; text() removes the line break in front.
#pragma once

#include "docstring.hpp"

namespace delone::python::docs::forecasts {

inline constexpr const char* forecast = R"(
Predict the cost of a Delaunay triangulation of points of a kind.

Parameters
----------
dimension : int
    The number d >= 1 of coordinates.
num_points : int
    The number of points.
kind : str, default 'uniform'
    A kind of `generate`: 'uniform', 'ball', 'sphere', 'grid', ...
threads : int, default 0
    As for `Delaunay`.

Returns
-------
Forecast
    The predicted cells, memory and time.

Raises
------
ValueError
    If the kind is unknown, or an argument is out of range.

See Also
--------
estimate : A forecast for given points.

Notes
-----
Uniform points have a closed form, with times scaled to this machine, which takes about 50 milliseconds once. Of other kinds samples
are generated and triangulated, as by `estimate`. Cells, bytes and seconds are within a factor of 1.5 of the truth in up to 8
dimensions; beyond, ranges are wider, and every kind is forecast as uniform points are. Sources: Miles 1974 and Moller 1994 (Poisson-Delaunay constants), Dwyer 1991,
doi:10.1007/BF02574694 (uniform points), McMullen 1970 (most cells).

Examples
--------
>>> import delone
>>> f = delone.forecast(3, 1_000_000)
>>> 6e6 < f.cells < 7.5e6
True)";

inline constexpr const char* estimate = R"(
Predict the cost of a Delaunay triangulation of given points.

Triangulates samples, random subsets of growing size.

Parameters
----------
points : (n, d) array_like or pandas.DataFrame
    The points.
threads : int, default 0
    The threads of the construction, as for `Delaunay`.
sample_seconds : float, default 1.0
    About the most seconds for samples.
progress : bool or callable, optional
    As for `Delaunay`.

Returns
-------
Forecast
    The predicted cells, memory and time.

Raises
------
InputError
    If a number is NaN or infinite.
ValueError
    If an argument has another shape or is out of range.
CancelledError
    If the progress function cancels the call.

See Also
--------
forecast : A forecast without points.

Notes
-----
Beyond the largest sample the number of cells is compared with that of points that are spread evenly, and the difference goes on as it
did among the samples. Lattices are recognized, and duplicates counted. The result depends on the set of points, and on the size of the samples, which depends on time: at least 20 000 cells, then
about a twentieth of the construction or 0.3 seconds, and at most `sample_seconds`. A sample that has not ended 0.2 seconds after
`sample_seconds`, or after a second if that is later, is given up, and the range is wide. Reading the points costs O(n d).

Examples
--------
>>> import delone
>>> delone.estimate(delone.generate("uniform", 1000, 2)).num_points
1000)";

inline constexpr const char* result = R"(
Predicted cost of a Delaunay triangulation.

Made by `forecast` and `estimate`. `vertices`, `cells`, `bytes` and `seconds` are expected values; the ranges hold the truth for nine of
ten forecasts.

Examples
--------
>>> import delone
>>> f = delone.forecast(2, 1000)
>>> f.dimension, f.num_sampled
(2, 0))";

}  // namespace delone::python::docs::forecasts
