// SPDX-License-Identifier: BSD-3-Clause
// Results as one self-contained page for a browser, in which they can be turned, sliced, colored and queried.
//
// Positions are rounded to 2^24 steps along each axis of the bounding box, at most 3·10⁻⁸ of its side, the
// precision of graphics hardware; the page says by how much. Circumradii and qualities are computed in double
// precision from the unrounded coordinates and stored to 4 digits, values to 2^-24 of their range. If the
// library was built with zlib, the page is about two thirds as large.
#pragma once

#include <delone/data.hpp>
#include <delone/execution.hpp>
#include <delone/export.hpp>

#include <optional>
#include <string>
#include <vector>

namespace delone {

class Diagram;

/// The items to which the values of a page belong.
enum class ValuesAt {
  automatic,  ///< the first of the following whose number is that of the values
  points,     ///< rows, of points or halfspaces
  cells,      ///< cells of triangulations and hulls, regions
  facets,     ///< of hulls and intersections
};

struct HtmlOptions {
  std::string title{};  ///< empty: what is shown
  /// The names of the d coordinates; empty: those of the data, or x, y, z, or x0, x1, …
  std::vector<std::string> column_names{};
  std::vector<double> values{};  ///< numbers to color by; NaN: none. Empty: no values
  ValuesAt values_at = ValuesAt::automatic;
  std::string value_name = "value";
};

/// A page that shows a triangulation: its cells with their circumradii and qualities
/// (QualityMeasure::radius_ratio; flat cells, which files can have, have neither), its hull, and for k = d =
/// 2, 3 its Voronoi diagram. Rows that were removed are left out. In more than three dimensions the viewer
/// chooses three coordinates or principal axes. Throws Errc::invalid_argument if options do not suit the
/// data, if values are infinite, and if the arrays disagree; not_finite; too_many beyond 2^32 − 2 rows;
/// out_of_memory; cancelled. Cost: linear, and one sort of the vertices; about 13 bytes of page for each
/// triangle or tetrahedron, 20 without zlib.
DELONE_EXPORT std::string to_html(const ComplexData& data, const HtmlOptions& options = {},
                                  const Execution& how = {});

/// A page that shows a convex hull: its facets, and all of its points if there are at most 200 000. Throws as
/// above, and Errc::invalid_argument for a hull without its points.
DELONE_EXPORT std::string to_html(const HullData& data, const HtmlOptions& options = {},
                                  const Execution& how = {});

/// A page that shows an intersection of halfspaces: facets for d = 3, edges otherwise; unbounded ones are cut
/// off. Throws as above, Errc::invalid_argument for an intersection without interior points, and not_finite
/// if vertices are beyond the range of doubles.
DELONE_EXPORT std::string to_html(const IntersectionData& data, const HtmlOptions& options = {},
                                  const Execution& how = {});

/// A page that shows the regions of a Voronoi or power diagram within a box (by default bounding_box()), with
/// their volumes in it. Throws as Diagram::for_each_clipped_region(); Errc::unsupported for d > 3.
DELONE_EXPORT std::string to_html(const Diagram& diagram, const HtmlOptions& options = {},
                                  const std::optional<Box>& box = {}, const Execution& how = {});

}  // namespace delone
