// SPDX-License-Identifier: BSD-3-Clause
// Everything: exact Delaunay triangulations in any dimension.
#pragma once

#include <delone/alpha.hpp>
#include <delone/cell_numbers.hpp>
#include <delone/check.hpp>
#include <delone/complex.hpp>
#include <delone/config.hpp>
#include <delone/convex_hull.hpp>
#include <delone/convex_hulls.hpp>
#include <delone/data.hpp>
#include <delone/delaunay.hpp>
#include <delone/error.hpp>
#include <delone/faces.hpp>
#include <delone/forecast.hpp>
#include <delone/furthest_site.hpp>
#include <delone/halfspaces.hpp>
#include <delone/html.hpp>
#include <delone/interpolation.hpp>
#include <delone/io.hpp>
#include <delone/lower_hull.hpp>
#include <delone/measures.hpp>
#include <delone/natural_neighbors.hpp>
#include <delone/options.hpp>
#include <delone/point_locator.hpp>
#include <delone/point_sets.hpp>
#include <delone/points.hpp>
#include <delone/predicates.hpp>
#include <delone/printable.hpp>
#include <delone/progress.hpp>
#include <delone/readable.hpp>
#include <delone/regular.hpp>
#include <delone/triangulation.hpp>
#include <delone/trim.hpp>
#include <delone/types.hpp>
#include <delone/voronoi.hpp>
