// SPDX-License-Identifier: BSD-3-Clause
// Options by name: what delone_options holds, as the options of the C++ interface.
#pragma once

#include <delone/delone.h>
#include <delone/check.hpp>
#include <delone/interpolation.hpp>
#include <delone/io.hpp>
#include <delone/options.hpp>
#include <delone/periodic.hpp>
#include <delone/point_locator.hpp>
#include <delone/tiles.hpp>
#include <delone/voronoi.hpp>

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

struct delone_options {
  unsigned threads = 1;
  double tolerance = 0;
  std::vector<double> axis_tolerances;
  delone::Options build;  // seed and order
  delone::Outside outside = delone::Outside::fill;
  double fill = std::numeric_limits<double>::quiet_NaN();
  bool proper_faces = false, vertices = false;  // of cells of sites
  delone::PeriodicOptions periodic;
  delone::CheckOptions check;
  delone::ReadOptions read;    // format, columns, max_stream_bytes
  delone::TilesOptions tiles;  // what is for tiles alone
};

namespace delone::c {

/// The options themselves, or the defaults for NULL.
const delone_options& given(const delone_options* options);

/// For constructions that take a tolerance, and for those that take none.
Options with_tolerance(const delone_options* options);
Options without_tolerance(const delone_options* options);

/// Throws invalid_argument for `outside` = "nearest" and "error".
Execution execution(const delone_options* options);
LocateOptions locate_options(const delone_options* options);
TilesOptions tiles_options(const delone_options* options);

/// Of a lattice of `num_vectors` rows of the caller.
Lattice lattice_of(const double* vectors, std::size_t num_vectors, int dimension);

}  // namespace delone::c
