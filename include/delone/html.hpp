// SPDX-License-Identifier: BSD-3-Clause
// Results as one page for a browser, which needs nothing else: to turn, slice, color and ask.
//
// Positions are rounded to 2^24 steps along each axis of the bounding box: by at most 3·10⁻⁸ of its side,
// which is what graphics hardware works with; the page says by how much. Circumradii and qualities are
// computed from the coordinates as they are, in double precision, and stored to 4 digits, values to 2^-24 of
// their range. Where the library was built with zlib the page is about two thirds as large.
#pragma once

#include <delone/data.hpp>
#include <delone/export.hpp>

#include <optional>
#include <string>
#include <vector>

namespace delone {

class Diagram;

/// What the values of a page belong to.
enum class ValuesAt {
  automatic,  ///< whichever there are as many of: of several in this order
  points,     ///< rows, of points or halfspaces
  cells,      ///< cells of triangulations and hulls, regions
  facets,     ///< of hulls and intersections
};

struct HtmlOptions {
  std::string title{};  ///< empty: what is shown
  /// d, of the coordinates; empty: those of the data, or x, y, z, or x0, x1, …
  std::vector<std::string> column_names{};
  std::vector<double> values{};  ///< numbers to color by; NaN: none. Empty: no values
  ValuesAt values_at = ValuesAt::automatic;
  std::string value_name = "value";
};

/// A page that shows a triangulation: its cells with their circumradii and qualities
/// (QualityMeasure::radius_ratio; flat cells, which files can have, have neither), its hull, and for
/// k = d = 2, 3 its Voronoi diagram. In more than three dimensions three coordinates or principal axes are
/// chosen there.
/// Errors: invalid_argument for options that do not suit the data, for infinite values, and where the arrays
/// disagree; not_finite; too_many beyond 2^32 − 2 rows; out_of_memory. A ProgressScope can stop it. Cost:
/// linear, and one sort of the vertices; about 20 bytes of page for each triangle of the plane.
DELONE_EXPORT std::string to_html(const ComplexData& data, const HtmlOptions& options = {});

/// A page that shows a convex hull: its facets, and all of its points if these are at most 200 000.
DELONE_EXPORT std::string to_html(const HullData& data, const HtmlOptions& options = {});

/// A page that shows an intersection of halfspaces: facets for d = 3, edges otherwise; unbounded ones are cut
/// off. invalid_argument for one without interior points; not_finite where vertices are beyond the range of
/// doubles.
DELONE_EXPORT std::string to_html(const IntersectionData& data, const HtmlOptions& options = {});

/// A page that shows the regions of a Voronoi or power diagram within a box (by default bounding_box()), with
/// their volumes in it. Errors: as Diagram::for_each_clipped_region(); unsupported for d > 3.
DELONE_EXPORT std::string to_html(const Diagram& diagram, const HtmlOptions& options = {},
                                  const std::optional<Box>& box = {});

}  // namespace delone
