// SPDX-License-Identifier: BSD-3-Clause
// to_html(): a scene of each kind of result.
#include "base/progress_meter.hpp"
#include "base/quick_rounds.hpp"
#include "faces/shapes_of_cells.hpp"
#include "io/collect.hpp"
#include "io/complexes/write_arrays.hpp"
#include "io/file.hpp"
#include "view/scene.hpp"

#include <delone/error.hpp>
#include <delone/html.hpp>
#include <delone/voronoi.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <utility>

namespace delone {
namespace view {
namespace {

constexpr std::size_t most_points = 200000;  // that are shown besides the vertices of a hull

std::string counted(std::size_t count, const std::string& one) {
  return fmt::format("{} {}{}", count, one, count == 1 ? "" : "s");
}
std::string vertices_of(std::size_t count) {
  return fmt::format("{} {}", count, count == 1 ? "vertex" : "vertices");
}

void require_rows(std::span<const SignedIndex> items, std::size_t count, const char* what) {
  internal::QuickRounds round;
  for (std::size_t i = 0; i < items.size(); ++i) {
    round();
    if (items[i] < 0 || static_cast<std::uint64_t>(items[i]) >= count)
      io::fail(Errc::invalid_argument, "{}: item {} is {} of {}", what, i, items[i], count);
  }
}

/// Of a ComplexData or HullData.
template <class Data>
Scene scene_of_cells(const HtmlOptions& options, const char* kind, const Data& data, int corners) {
  const int dimension = data.dimension;
  const std::vector<double>& points = data.points;
  const std::vector<SignedIndex>& cells = data.cells;
  Scene scene = scene_of(options, dimension, kind, data.column_names);
  scene.corners = corners;
  scene.cells = cells;
  scene.num_cells = corners == 0 ? 0 : cells.size() / static_cast<std::size_t>(corners);
  require_rows(cells, points.size() / static_cast<std::size_t>(dimension), "cells");
  return scene;
}

/// That the rows that are there are finite: those that were removed are left out.
void require_finite_rows(const ComplexData& data) {
  const auto d = static_cast<std::size_t>(data.dimension);
  const std::size_t n = data.num_points();
  for (std::size_t first = 0, end = 0; first < n; first = end + 1) {
    for (end = first; end < n && !data.is_removed(end);) ++end;
    io::require_finite(std::span(data.points).subspan(first * d, (end - first) * d), data.dimension, "page",
                       {}, first);
    if (!data.weights.empty())
      io::require_finite(std::span(data.weights).subspan(first, end - first), 1, "page: weights", {}, first);
  }
}

/// That what is shown of an intersection refers to what there is.
void require_numbers_of(const IntersectionData& data) {
  require_rows(data.facet_halfspaces, data.num_halfspaces(), "facet_halfspaces");
  require_rows(data.facet_vertices, data.num_vertices(), "facet_vertices");
  require_rows(data.facet_directions, data.num_directions(), "facet_directions");
  require_rows(data.edges, data.num_vertices(), "edges");
  for (std::size_t r = 0; r < data.num_rays(); ++r) {
    require_rows(std::span(data.rays).subspan(2 * r, 1), data.num_vertices(), "rays");
    require_rows(std::span(data.rays).subspan(2 * r + 1, 1), data.num_directions(), "rays");
  }
}

/// The corners and faces of the regions in the box. A face that rounding has left with fewer than three
/// corners is none.
void take_regions(Scene& scene, const Diagram& diagram, const delone::Box& box) {
  std::vector<double> corners;
  std::vector<std::pair<std::size_t, std::vector<Index>>> faces;  // with the region
  const auto d = static_cast<std::size_t>(scene.dimension);
  diagram.for_each_clipped_region(box, [&](std::size_t region, const ClippedRegion& clipped) {
    const std::size_t before = corners.size() / d;
    corners.insert(corners.end(), clipped.corners.begin(), clipped.corners.end());
    for (const auto& face : clipped.faces) {
      faces.emplace_back(region, face);
      for (Index& corner : faces.back().second) corner += static_cast<Index>(before);
    }
  });
  for (const auto& [region, face] : faces)
    for (const Index corner : face) scene.face_vertices.push_back(static_cast<SignedIndex>(corner));
  take_vertices(scene, corners, true);
  const std::vector<SignedIndex> numbers = std::exchange(scene.face_vertices, {});
  scene.face_counts.assign(scene.num_cells, 0);
  std::size_t at = 0;
  std::vector<SignedIndex> kept;
  for (const auto& [region, face] : faces) {
    kept.clear();
    for (std::size_t i = 0; i < face.size(); ++i)
      if (kept.empty() || kept.back() != numbers[at + i]) kept.push_back(numbers[at + i]);
    at += face.size();
    while (kept.size() > 1 && kept.front() == kept.back()) kept.pop_back();
    if (kept.size() < 3) continue;
    ++scene.face_counts[region];
    scene.face_sizes.push_back(static_cast<SignedIndex>(kept.size()));
    scene.face_vertices.insert(scene.face_vertices.end(), kept.begin(), kept.end());
  }
}

/// A point on each ray, far enough outside for the picture.
class RayEnds {
 public:
  explicit RayEnds(const IntersectionData& data) : data_(data), points_(data.vertices) {
    const auto d = static_cast<std::size_t>(data.dimension);
    for (std::size_t j = 0; j < d; ++j) {
      double low = std::numeric_limits<double>::infinity(), high = -low;
      for (std::size_t i = j; i < data.vertices.size(); i += d)
        low = std::min(low, data.vertices[i]), high = std::max(high, data.vertices[i]);
      if (low < high) length_ = std::max(length_, high / 2 - low / 2);
    }
    if (length_ == 0) length_ = 1;
  }
  SignedIndex end(SignedIndex vertex, SignedIndex direction) {
    const auto [known, is_new] =
        known_.try_emplace({vertex, direction}, static_cast<SignedIndex>(points_.size() / ambient()));
    if (!is_new) return known->second;
    const auto from = data_.vertex(static_cast<std::size_t>(vertex));
    const auto to = data_.direction(static_cast<std::size_t>(direction));
    constexpr double most = std::numeric_limits<double>::max();
    for (std::size_t j = 0; j < from.size(); ++j)
      points_.push_back(std::clamp(from[j] + length_ * to[j], -most, most));
    return known->second;
  }
  std::span<const double> points() const { return points_; }

 private:
  std::size_t ambient() const { return static_cast<std::size_t>(data_.dimension); }

  const IntersectionData& data_;
  std::vector<double> points_;
  std::map<std::pair<SignedIndex, SignedIndex>, SignedIndex> known_;  // the end of each ray
  double length_ = 0;
};

/// Facets of three dimensions as polygons; a facet without vertices has none.
void take_facets(Scene& scene, const IntersectionData& data, RayEnds& ends) {
  for (std::size_t f = 0; f < data.num_facets(); ++f) {
    const auto vertices = data.facet(f), directions = data.directions_of_facet(f);
    std::vector<SignedIndex> polygon(vertices.begin(), vertices.end());
    if (!polygon.empty() && directions.size() == 2) {
      const SignedIndex first = polygon.front(), last = polygon.back();
      polygon.push_back(ends.end(last, directions[0]));
      polygon.push_back(ends.end(first, directions[1]));
    }
    const bool is_shown = polygon.size() > 2;
    scene.face_counts.push_back(is_shown ? 1 : 0);
    if (!is_shown) continue;
    scene.face_sizes.push_back(static_cast<SignedIndex>(polygon.size()));
    scene.face_vertices.insert(scene.face_vertices.end(), polygon.begin(), polygon.end());
  }
}

}  // namespace
}  // namespace view

std::string to_html(const ComplexData& data, const HtmlOptions& options, const Execution& how) {
  const internal::ProgressMeter meter(how.progress);
  return io::guarded("page", [&] {
    io::validate(data, "page");
    if (data.is_periodic()) throw Error(Errc::unsupported, "there is no page of a periodic triangulation");
    view::require_finite_rows(data);
    const bool is_alpha = data.kind == DataKind::alpha_complex;
    view::Scene scene = view::scene_of_cells(options, is_alpha ? "alpha" : "triangulation", data,
                                             std::max(data.affine_dimension + 1, 0));
    const int k = data.affine_dimension;
    scene.affine_dimension = k;
    scene.dual = !is_alpha && k == data.dimension && (k == 2 || k == 3);
    if (k >= 1) {
      auto shapes = internal::shapes_of_cells(data.points, data.dimension, data.cells, k + 1);
      scene.radius = std::move(shapes.radius);
      if (k >= 2) scene.quality = std::move(shapes.ratio);
    }
    view::take_vertices(scene, data.points);
    for (const SignedIndex row : scene.rows)
      if (!data.weights.empty()) scene.weights.push_back(data.weights[static_cast<std::size_t>(row)]);
    view::take_values(scene, options,
                      {.num_rows = data.num_points(), .row_of = scene.rows, .of_vertices = true});
    if (scene.title.empty())
      scene.title = is_alpha               ? "Alpha complex"
                    : data.weights.empty() ? "Triangulation"
                                           : "Regular triangulation";
    scene.summary = fmt::format("{} and {}, dimension {}", view::counted(scene.num_cells, "cell"),
                                view::vertices_of(scene.num_vertices()), data.dimension);
    return view::page_of(scene);
  });
}

std::string to_html(const HullData& data, const HtmlOptions& options, const Execution& how) {
  const internal::ProgressMeter meter(how.progress);
  return io::guarded("page", [&] {
    io::validate(data, "page");
    io::require_finite(data.points, data.dimension, "page");
    if (data.points.empty() && data.num_points() > 0)
      io::fail(Errc::invalid_argument, "page: the hull was stored without its points");
    view::Scene scene = view::scene_of_cells(options, "hull", data, std::max(data.affine_dimension, 0));
    scene.affine_dimension = data.affine_dimension;
    view::require_rows(data.facet_of_cell, data.num_facets(), "facet_of_cell");
    scene.groups = data.facet_of_cell;
    if (data.affine_dimension == 3) scene.cell_word = "triangle";
    view::take_vertices(scene, data.points);
    view::take_values(scene, options,
                      {.num_rows = data.num_points(),
                       .row_of = scene.rows,
                       .of_vertices = true,
                       .num_facets = data.num_facets(),
                       .group_of_cell = scene.groups});
    if (data.num_points() <= view::most_points) scene.sites = data.points;
    if (scene.title.empty()) scene.title = "Convex hull";
    scene.summary = fmt::format("{}, {} and {}, dimension {}", view::counted(data.num_points(), "point"),
                                view::counted(data.num_facets(), "facet"),
                                view::vertices_of(data.vertices.size()), data.dimension);
    return view::page_of(scene);
  });
}

std::string to_html(const IntersectionData& data, const HtmlOptions& options, const Execution& how) {
  const internal::ProgressMeter meter(how.progress);
  return io::guarded("page", [&] {
    io::validate(data, "page");
    if (data.state != IntersectionState::full)
      io::fail(Errc::invalid_argument, "page: the intersection has no interior points");
    io::require_finite(data.vertices, data.dimension, "page: vertices");
    io::require_finite(data.directions, data.dimension, "page: directions");
    view::require_numbers_of(data);
    view::Scene scene = view::scene_of(options, data.dimension, "intersection");
    scene.affine_dimension = data.dimension;
    scene.cell_word = "facet";
    view::RayEnds ends(data);
    if (data.dimension == 3 && data.rank == 3) {
      scene.num_cells = data.num_facets();
      scene.names = data.facet_halfspaces;
      view::take_facets(scene, data, ends);
    }
    scene.segments = data.edges;
    for (std::size_t r = 0; r < data.num_rays(); ++r) {
      scene.segments.push_back(data.rays[2 * r]);
      scene.segments.push_back(ends.end(data.rays[2 * r], data.rays[2 * r + 1]));
    }
    view::take_vertices(scene, ends.points());
    scene.rows.clear();
    if (scene.num_cells > 0) scene.segments.clear();  // edges of faces are shown with them
    view::take_values(
        scene, options,
        {.num_rows = data.num_halfspaces(), .row_of = scene.names, .num_facets = scene.num_cells});
    if (scene.title.empty()) scene.title = "Intersection of halfspaces";
    scene.summary =
        fmt::format("{}, {} and {}, dimension {}{}", view::counted(data.num_halfspaces(), "halfspace"),
                    view::counted(data.num_facets(), "facet"), view::vertices_of(data.num_vertices()),
                    data.dimension, data.bounded ? "" : "; unbounded, cut off");
    return view::page_of(scene);
  });
}

std::string to_html(const Diagram& diagram, const HtmlOptions& options, const std::optional<Box>& box,
                    const Execution& how) {
  const internal::ProgressMeter meter(how.progress);
  return io::guarded("page", [&] {
    const int d = diagram.dimension();
    if (d > 3)
      io::fail(Errc::unsupported, "page: diagrams are shown in at most 3 dimensions, this one has {}", d);
    const Box shown = box ? *box : diagram.bounding_box();
    view::Scene scene = view::scene_of(options, d, "diagram");
    scene.affine_dimension = diagram.affine_dimension();
    scene.cell_word = "region";
    scene.num_cells = diagram.num_regions();
    scene.solid = d == 3;
    scene.volume = diagram.region_volumes(shown, how);
    view::take_regions(scene, diagram, shown);
    scene.rows.clear();
    bool is_weighted = false;
    for (std::size_t r = 0; r < scene.num_cells; ++r) {
      const auto site = diagram.site(r);
      scene.sites.insert(scene.sites.end(), site.begin(), site.end());
      is_weighted = is_weighted || diagram.weight(r) != 0;
    }
    scene.site_rows.assign(diagram.region_points().begin(), diagram.region_points().end());
    view::take_values(scene, options, {.num_rows = diagram.num_points(), .row_of = scene.site_rows});
    if (scene.title.empty()) scene.title = is_weighted ? "Power diagram" : "Voronoi diagram";
    scene.summary = fmt::format("{} and {}, dimension {}", view::counted(scene.num_cells, "region"),
                                view::vertices_of(diagram.num_vertices()), d);
    return view::page_of(scene);
  });
}

}  // namespace delone
