// SPDX-License-Identifier: BSD-3-Clause
// Triangulations, convex hulls and intersections of halfspaces in the text forms of Qhull's qdelaunay,
// qconvex and qhalf, after its manual. Facets are oriented as Qhull orients them: the determinant of the
// edges v_i − v_0 and of the outward normal is negative.
#include "io/complexes/qhull_outputs.hpp"
#include "io/file.hpp"

#include <delone/convex_hull.hpp>
#include <delone/halfspaces.hpp>
#include <delone/io.hpp>
#include <delone/predicates.hpp>
#include <delone/triangulation.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <unordered_map>

namespace delone {
namespace io {
namespace {

using Rows = std::vector<SignedIndex>;

void put_vertices(AtomicFile& file, const QhullFacets& facets) {
  file.print("{}\n", facets.vertices.size());
  put_counted(file, facets.vertices);
}

void put_neighbors(AtomicFile& file, const QhullFacets& facets) {
  file.print("{}\n", facets.neighbors.size());
  put_counted(file, facets.neighbors);
}

void put_points(AtomicFile& file, std::span<const double> points, std::size_t width) {
  file.print("{}\n{}\n", width, points.size() / width);
  put_rows(file, points, width);
}

/// Points and facets as Qhull's variant of OFF.
void put_off(AtomicFile& file, std::span<const double> points, std::size_t width, const QhullFacets& facets) {
  file.print("{}\n{} {} {}\n", width, points.size() / width, facets.oriented.size(), facets.num_ridges());
  put_rows(file, points, width);
  put_counted(file, facets.oriented);
}

/// Throws unsupported if a facet is no simplex, in more than 3 dimensions.
void put_incident(AtomicFile& file, const QhullFacets& facets, int dimension) {
  for (std::size_t i = 0; dimension > 3 && i < facets.oriented.size(); ++i)
    if (facets.oriented[i].size() > static_cast<std::size_t>(dimension))
      fail(Errc::unsupported,
           "output 'i': facet {} has {} vertices, for which Qhull adds a point of its own in dimension {}; "
           "take "
           "Fv, or the format txt for simplices",
           i, facets.oriented[i].size(), dimension);
  file.print("{}\n", facets.oriented.size());
  for (std::size_t i = 0; i < facets.oriented.size(); ++i) put_line(file, facets.oriented[i]);
}

void put_sizes(AtomicFile& file, double area, double volume) {
  file.write("0\n2 ");
  put_line(file, std::initializer_list<double>{area, volume});
}

// Triangulations

QhullFacets facets_of(const ComplexData& data) {
  QhullFacets facets;
  const auto corners = static_cast<std::size_t>(data.affine_dimension + 1);
  for (std::size_t cell = 0; cell < data.num_cells(); ++cell) {
    facets.vertices.add(std::span(data.cells).subspan(cell * corners, corners));
    facets.neighbors.add(std::span(data.neighbors).subspan(cell * corners, corners));
  }
  facets.oriented = facets.vertices;
  return facets;
}

/// The rows in facets without a neighbor, increasing.
Rows border_of(const ComplexData& data) {
  const auto corners = static_cast<std::size_t>(data.affine_dimension + 1);
  Rows rows;
  for (std::size_t i = 0; i < data.cells.size(); ++i)
    if (data.neighbors[i] < 0)
      for (std::size_t j = i - i % corners; j < i - i % corners + corners; ++j)
        if (j != i) rows.push_back(data.cells[j]);
  if (corners == 1) rows = data.cells;  // one point
  std::sort(rows.begin(), rows.end());
  rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
  return rows;
}

/// The points on the paraboloid, whose last coordinate is scaled to [0, the largest magnitude of the others]
/// as by option Qbb. Rounded; unscaled where that is beyond the range of doubles.
std::vector<double> lifted(const ComplexData& data) {
  const auto d = static_cast<std::size_t>(data.dimension);
  std::vector<double> heights(data.num_points());
  double largest = 0;
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    heights[i / d] += data.points[i] * data.points[i];
    largest = std::fmax(largest, std::fabs(data.points[i]));
  }
  const auto [low, high] = std::minmax_element(heights.begin(), heights.end());
  double shift = heights.empty() ? 0 : *low, scale = heights.empty() ? 1 : largest / (*high - *low);
  if (!(std::isfinite(scale) && scale > 0)) shift = 0, scale = 1;
  std::vector<double> points;
  points.reserve(data.points.size() + heights.size());
  for (std::size_t row = 0; row < heights.size(); ++row) {
    points.insert(points.end(), data.points.begin() + static_cast<std::ptrdiff_t>(row * d),
                  data.points.begin() + static_cast<std::ptrdiff_t>((row + 1) * d));
    points.push_back((heights[row] - shift) * scale);
  }
  return points;
}

/// The volume of all cells: that of the hull of the border.
double volume_of(const ComplexData& data) {
  const auto d = static_cast<std::size_t>(data.dimension);
  std::vector<double> points;
  for (const SignedIndex row : border_of(data))
    points.insert(points.end(), data.points.begin() + static_cast<std::ptrdiff_t>(at(row) * d),
                  data.points.begin() + static_cast<std::ptrdiff_t>((at(row) + 1) * d));
  return ConvexHull<>(points, data.dimension).volume().value;
}

// Hulls

/// The facets of a hull, from its cells and their merging into facets.
class HullFacets {
 public:
  explicit HullFacets(const HullData& data)
      : data_(data), k_(static_cast<std::size_t>(std::max(data.affine_dimension, 0))) {
    std::vector<SignedIndex> cell_of_facet(data.num_facets(), -1);
    for (std::size_t cell = 0; cell < data.num_cells(); ++cell) {
      SignedIndex& first = cell_of_facet[at(data.facet_of_cell[cell])];
      if (first < 0)
        first = static_cast<SignedIndex>(cell);
      else
        merged_[data.facet_of_cell[cell]].cells.push_back(cell);
    }
    for (auto& [facet, merged] : merged_) merged.cells.push_back(at(cell_of_facet[at(facet)]));
    for (std::size_t i = 0; i < data.ridge_facets.size(); ++i)
      if (const auto found = merged_.find(data.ridge_facets[i]); found != merged_.end())
        found->second.ridges.push_back(i);
    for (std::size_t f = 0; f < data.num_facets(); ++f)
      if (const auto found = merged_.find(static_cast<SignedIndex>(f)); found != merged_.end())
        add_merged(f, found->second);
      else
        add_cell(at(cell_of_facet[f]));
  }
  QhullFacets take() { return std::move(facets_); }

  /// The next vertex of each vertex along the cells of dimension 1, k = 2.
  static std::unordered_map<SignedIndex, SignedIndex> steps(const HullData& data) {
    std::unordered_map<SignedIndex, SignedIndex> next;
    for (std::size_t i = 0; i < data.cells.size(); i += 2) next[data.cells[i]] = data.cells[i + 1];
    return next;
  }

 private:
  struct Merged {
    std::vector<std::size_t> cells, ridges;  ///< ridges by places in data.ridge_facets
  };

  std::span<const SignedIndex> list(const Rows& items, const Rows& offsets, std::size_t i) const {
    return std::span(items).subspan(at(offsets[i]), at(offsets[i + 1]) - at(offsets[i]));
  }

  void add_oriented(Rows rows) {
    // What is positively oriented after a point inside has the sign (−1)^(k−1) in Qhull's convention.
    if (k_ % 2 == 1 && rows.size() == k_ && k_ > 1) std::swap(rows[0], rows[1]);
    if (k_ % 2 == 1 && rows.size() != k_) std::reverse(rows.begin(), rows.end());
    facets_.oriented.add(rows);
  }

  void add_cell(std::size_t cell) {
    const Rows rows(data_.cells.begin() + static_cast<std::ptrdiff_t>(cell * k_),
                    data_.cells.begin() + static_cast<std::ptrdiff_t>((cell + 1) * k_));
    Rows neighbors;
    for (std::size_t j = 0; j < k_; ++j)
      neighbors.push_back(data_.facet_of_cell[at(data_.neighbors[cell * k_ + j])]);
    facets_.vertices.add(rows);
    facets_.neighbors.add(neighbors);
    add_oriented(rows);
  }

  void add_merged(std::size_t facet, const Merged& merged) {
    const auto vertices = list(data_.facet_vertices, data_.facet_offsets, facet);
    Rows rows(vertices.begin(), vertices.end()), neighbors;
    if (rows.size() == k_ && merged.ridges.size() == k_) {
      if (is_negative(facet, rows)) std::swap(rows[0], rows[1]);
      neighbors.resize(k_);
      for (const std::size_t place : merged.ridges) {
        const auto ridge = list(data_.ridge_vertices, data_.ridge_offsets, place / 2);
        const auto opposite = std::find_if(rows.begin(), rows.end(), [&](SignedIndex row) {
          return !std::binary_search(ridge.begin(), ridge.end(), row);
        });
        if (opposite != rows.end())
          neighbors[static_cast<std::size_t>(opposite - rows.begin())] = data_.ridge_facets[place ^ 1];
      }
    } else {
      for (const std::size_t place : merged.ridges) neighbors.push_back(data_.ridge_facets[place ^ 1]);
    }
    facets_.vertices.add(rows);
    facets_.neighbors.add(neighbors);
    if (k_ == 3 && rows.size() > 3) rows = border_of(facet, merged, rows);
    add_oriented(rows);
  }

  /// Whether a simplex, put after a point inside, is negatively oriented. Says no where k < d.
  bool is_negative(std::size_t facet, const Rows& rows) const {
    const auto d = static_cast<std::size_t>(data_.dimension);
    if (k_ != d || k_ < 2) return false;
    const auto vertices = list(data_.facet_vertices, data_.facet_offsets, facet);
    const auto inside = std::find_if(data_.vertices.begin(), data_.vertices.end(), [&](SignedIndex row) {
      return !std::binary_search(vertices.begin(), vertices.end(), row);
    });
    std::vector<double> points;
    const auto add = [&](SignedIndex row) {
      points.insert(points.end(), data_.points.begin() + static_cast<std::ptrdiff_t>(at(row) * d),
                    data_.points.begin() + static_cast<std::ptrdiff_t>((at(row) + 1) * d));
    };
    add(*inside);
    for (const SignedIndex row : rows) add(row);
    return orientation(points, data_.dimension) == Sign::negative;
  }

  /// The extreme points of a polygon along its border, as its triangles are oriented. As they are where a
  /// tolerance has made a facet of another shape.
  Rows border_of(std::size_t facet, const Merged& merged, const Rows& extreme) const {
    std::map<SignedIndex, SignedIndex> next;
    for (const std::size_t cell : merged.cells)
      for (std::size_t j = 0; j < 3; ++j)
        if (at(data_.facet_of_cell[at(data_.neighbors[3 * cell + j])]) != facet)
          next[data_.cells[3 * cell + (j + 1) % 3]] = data_.cells[3 * cell + (j + 2) % 3];
    Rows border;
    SignedIndex row = next.begin()->first;
    for (std::size_t i = 0; i < next.size() && next.count(row) > 0; ++i, row = next[row])
      if (std::binary_search(extreme.begin(), extreme.end(), row)) border.push_back(row);
    Rows sorted = border;
    std::sort(sorted.begin(), sorted.end());
    return sorted == extreme ? border : extreme;
  }

  const HullData& data_;
  std::size_t k_;
  std::map<SignedIndex, Merged> merged_;  // facets of several cells
  QhullFacets facets_;
};

/// Extreme rows: counterclockwise in the plane, otherwise increasing.
Rows extreme_rows(const HullData& data) {
  if (data.affine_dimension != 2 || data.vertices.empty()) return data.vertices;
  const auto next = HullFacets::steps(data);
  Rows rows;
  SignedIndex row = data.vertices.front();
  do {
    if (std::binary_search(data.vertices.begin(), data.vertices.end(), row)) rows.push_back(row);
    row = next.at(row);
  } while (row != data.vertices.front());
  return rows;
}

std::vector<double> coordinates_of(std::span<const double> points, std::size_t width, const Rows& rows) {
  std::vector<double> chosen;
  for (const SignedIndex row : rows)
    for (std::size_t j = 0; j < width; ++j) chosen.push_back(points[at(row) * width + j]);
  return chosen;
}

void put_hull_summary(AtomicFile& file, const ConvexHullBase& hull, const QhullFacets& facets) {
  std::size_t others = 0;
  for (std::size_t f = 0; f < facets.vertices.size(); ++f)
    others += facets.vertices[f].size() > static_cast<std::size_t>(hull.dimension());
  file.print("\nConvex hull of {} points in {}-d:\n\n  Number of vertices: {}\n  Number of facets: {}\n",
             hull.num_points(), hull.dimension(), hull.num_vertices(), facets.vertices.size());
  if (others > 0) file.print("  Number of non-simplicial facets: {}\n", others);
  const double area = hull.area().value, volume = hull.volume().value;
  if (others == 0)
    file.print("\n  Total facet area:   {:.8g}\n  Total volume:       {:.8g}\n\n", area, volume);
  else  // Qhull's words where it has merged facets; ours are no more approximate than the others
    file.print("\n  Approximate facet area:    {:.8g}\n  Approximate volume:        {:.8g}\n\n", area,
               volume);
}

// Intersections of halfspaces

/// The vertices of a bounded intersection as the facets of the dual hull.
QhullFacets facets_of(const IntersectionData& data) {
  const auto d = static_cast<std::size_t>(data.dimension);
  std::vector<Rows> ends(data.num_vertices());  // of the edges at each vertex
  for (std::size_t i = 0; i < data.edges.size(); ++i) ends[at(data.edges[i])].push_back(data.edges[i ^ 1]);
  // d = 3: which facet has one vertex after another along its border.
  std::map<std::pair<SignedIndex, SignedIndex>, SignedIndex> left_of;
  for (std::size_t f = 0; d == 3 && f < data.num_facets(); ++f) {
    const auto border = data.facet(f);
    for (std::size_t i = 0; i < border.size(); ++i)
      left_of[{border[i], border[(i + 1) % border.size()]}] = data.facet_halfspaces[f];
  }
  const auto rows_of = [&](std::size_t vertex) {
    return std::span(data.vertex_halfspaces)
        .subspan(at(data.vertex_offsets[vertex]),
                 at(data.vertex_offsets[vertex + 1]) - at(data.vertex_offsets[vertex]));
  };
  QhullFacets facets;
  for (std::size_t v = 0; v < data.num_vertices(); ++v) {
    Rows rows(rows_of(v).begin(), rows_of(v).end()), neighbors = ends[v];
    if (rows.size() == d && neighbors.size() == d) {
      for (std::size_t i = 0; i < d; ++i)
        for (const SignedIndex w : ends[v])
          if (const auto there = rows_of(at(w));
              std::find(there.begin(), there.end(), rows[i]) == there.end())
            neighbors[i] = w;
    }
    facets.vertices.add(rows);
    facets.neighbors.add(neighbors);
    if (d == 3 && rows.size() > 3) {  // from facet to facet across the edges: clockwise from outside
      SignedIndex facet = rows.front();
      for (SignedIndex& row : rows) {
        row = facet;
        for (const SignedIndex w : ends[v])
          if (left_of[{static_cast<SignedIndex>(v), w}] == row)
            facet = left_of[{w, static_cast<SignedIndex>(v)}];
      }
    } else if (rows.size() == d && d > 1) {
      std::vector<double> normals(d, 0);  // after the origin, which is inside the dual hull
      for (const SignedIndex row : rows)
        for (std::size_t j = 0; j < d; ++j) normals.push_back(data.halfspaces[at(row) * (d + 1) + j]);
      const bool is_positive = orientation(normals, data.dimension) == Sign::positive;
      if (is_positive == (d % 2 == 1)) std::swap(rows[0], rows[1]);
    }
    facets.oriented.add(rows);
  }
  return facets;
}

/// The halfspaces of facets: in the plane in the order of their normals, counterclockwise.
Rows halfspaces_of(const IntersectionData& data, const QhullFacets& facets) {
  if (data.dimension != 2) return data.facet_halfspaces;
  std::map<SignedIndex, SignedIndex> next;
  for (std::size_t v = 0; v < facets.oriented.size(); ++v)
    next[facets.oriented[v][0]] = facets.oriented[v][1];
  Rows rows{data.facet_halfspaces.front()};
  while (rows.size() < next.size()) rows.push_back(next[rows.back()]);
  return rows;
}

/// What is made when the first output wants it.
template <class Make>
class Lazy {
 public:
  explicit Lazy(Make make) : make_(std::move(make)) {}
  const auto& operator()() {
    if (!made_) made_.emplace(make_());
    return *made_;
  }

 private:
  Make make_;
  std::optional<decltype(std::declval<Make>()())> made_;
};

}  // namespace
}  // namespace io

void write_qhull(const std::string& path, const Triangulation& triangulation, const std::string& outputs) {
  using namespace io;
  if (triangulation.kind() == TriangulationKind::regular)
    fail(Errc::unsupported, "Qhull has no output for regular triangulations");
  const auto d = static_cast<std::size_t>(triangulation.dimension());
  Lazy data([&] { return triangulation.to_data(); });
  Lazy facets([&] { return facets_of(data()); });
  write_qhull_outputs(
      path, outputs, "a triangulation",
      {{"o", [&](AtomicFile& file) { put_off(file, lifted(data()), d + 1, facets()); }},
       {"p", [&](AtomicFile& file) { put_points(file, lifted(data()), d + 1); }},
       {"i", [&](AtomicFile& file) { put_incident(file, facets(), triangulation.dimension() + 1); }},
       {"Fv", [&](AtomicFile& file) { put_vertices(file, facets()); }},
       {"Fx", [&](AtomicFile& file) { put_column(file, border_of(data())); }},
       {"Fn", [&](AtomicFile& file) { put_neighbors(file, facets()); }},
       {"FA",
        [&](AtomicFile& file) {
          file.print(
              "\n{}Delaunay triangulation by the convex hull of {} points in {}-d:\n\n  Number of input "
              "sites: {}\n  Number of Delaunay regions: {}\n\n  Total facet area:   {:.8g}\n\n",
              triangulation.kind() == TriangulationKind::furthest_site ? "Furthest-site " : "",
              triangulation.num_points(), d + 1, triangulation.num_points(), data().num_cells(),
              volume_of(data()));
        }},
       {"FS", [&](AtomicFile& file) { put_sizes(file, volume_of(data()), 0); }}});
}

void write_qhull(const std::string& path, const ConvexHullBase& hull, const std::string& outputs) {
  using namespace io;
  const auto d = static_cast<std::size_t>(hull.dimension());
  Lazy data([&] { return hull.to_data(); });
  Lazy facets([&] { return HullFacets(data()).take(); });
  write_qhull_outputs(
      path, outputs, "a convex hull",
      {{"o", [&](AtomicFile& file) { put_off(file, data().points, d, facets()); }},
       {"n",
        [&](AtomicFile& file) {
          file.print("{}\n{}\n", d + 1, data().num_facets());
          put_rows(file, data().equations, d + 1);
        }},
       {"p",
        [&](AtomicFile& file) { put_points(file, coordinates_of(data().points, d, data().vertices), d); }},
       {"i", [&](AtomicFile& file) { put_incident(file, facets(), hull.dimension()); }},
       {"Fv", [&](AtomicFile& file) { put_vertices(file, facets()); }},
       {"Fx", [&](AtomicFile& file) { put_column(file, extreme_rows(data())); }},
       {"Fn", [&](AtomicFile& file) { put_neighbors(file, facets()); }},
       {"FA", [&](AtomicFile& file) { put_hull_summary(file, hull, facets()); }},
       {"FS", [&](AtomicFile& file) { put_sizes(file, hull.area().value, hull.volume().value); }}});
}

void write_qhull(const std::string& path, const HalfspaceIntersectionBase& found,
                 const std::string& outputs) {
  using namespace io;
  const auto d = static_cast<std::size_t>(found.dimension());
  Lazy data([&] {
    if (found.state() != IntersectionState::full || !found.is_bounded())
      fail(Errc::unsupported, "Qhull's outputs need a bounded intersection with interior points; take json");
    return found.to_data();
  });
  Lazy facets([&] { return facets_of(data()); });
  write_qhull_outputs(path, outputs, "an intersection of halfspaces",
                      {{"o", [&](AtomicFile& file) { put_off(file, data().dual_points, d, facets()); }},
                       {"p",
                        [&](AtomicFile& file) {
                          put_points(file, coordinates_of(data().dual_points, d, data().facet_halfspaces), d);
                        }},
                       {"i", [&](AtomicFile& file) { put_incident(file, facets(), found.dimension()); }},
                       {"Fp", [&](AtomicFile& file) { put_points(file, data().vertices, d); }},
                       {"Fv", [&](AtomicFile& file) { put_vertices(file, facets()); }},
                       {"Fx", [&](AtomicFile& file) { put_column(file, halfspaces_of(data(), facets())); }},
                       {"Fn", [&](AtomicFile& file) { put_neighbors(file, facets()); }}});
}

}  // namespace delone
