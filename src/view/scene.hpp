// SPDX-License-Identifier: BSD-3-Clause
// What a page shows, whichever product it is of: vertices, and cells that are simplices or polytopes.
#pragma once

#include <delone/html.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

namespace delone::view {

struct Scene {
  std::string kind, title, summary, cell_word = "cell";
  std::vector<std::string> columns;
  int dimension = 1, affine_dimension = -1;
  int corners = 0;     ///< of each cell, all simplices; 0: cells are polytopes
  bool solid = false;  ///< polytopes of three dimensions, which share faces
  bool dual = false;   ///< whether the Voronoi diagram of the cells can be shown

  std::size_t num_cells = 0;
  std::vector<double> vertices;    ///< coordinates
  std::vector<SignedIndex> rows;   ///< of the input, of each vertex; empty: vertices are no rows
  std::vector<SignedIndex> cells;  ///< simplices: `corners` vertices each
  /// Polytopes: the number of faces of each, the number of vertices of each face, these vertices.
  std::vector<SignedIndex> face_counts, face_sizes, face_vertices;
  std::vector<SignedIndex> segments;  ///< pairs of vertices that are drawn besides

  std::vector<double> weights;                  ///< of vertices
  std::vector<double> radius, quality, volume;  ///< of cells; each may be empty
  std::vector<double> values;                   ///< of cells, or of vertices
  bool values_of_vertices = false;              ///< which of the two
  std::string value_name;                       ///< of the values
  std::vector<SignedIndex> groups, names;       ///< of cells: facets of a hull, rows of halfspaces
  std::vector<double> sites;                    ///< points that are shown besides
  std::vector<SignedIndex> site_rows;           ///< of the sites, of each cell

  std::size_t num_vertices() const { return vertices.size() / static_cast<std::size_t>(dimension); }
};

/// A scene of these options; `column_names` are those of the data. Throws invalid_argument for names that are
/// not d.
Scene scene_of(const HtmlOptions& options, int dimension, const char* kind,
               const std::vector<std::string>& column_names = {});

/// Keeps of `points`, d coordinates each, those that cells and segments refer to, as vertices in an order in
/// which neighbors are close to each other, and renumbers. Others may be NaN. `rows` becomes the numbers that
/// points had. With `merge`, points at the same place after rounding become one.
void take_vertices(Scene& scene, std::span<const double> points, bool merge = false);

/// The values of the options. `row_of`: the row of each vertex (`of_vertices`) or of each cell;
/// `group_of_cell`: the facet of each cell, where these are not facets themselves.
struct ValuePlaces {
  std::size_t num_rows = 0;
  std::span<const SignedIndex> row_of{};
  bool of_vertices = false;
  std::size_t num_facets = 0;
  std::span<const SignedIndex> group_of_cell{};
};
void take_values(Scene& scene, const HtmlOptions& options, const ValuePlaces& places);

/// The page.
std::string page_of(const Scene& scene);

}  // namespace delone::view
