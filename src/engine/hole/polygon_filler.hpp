// SPDX-License-Identifier: BSD-3-Clause
// Removes a vertex inside of a triangulation of the plane. Its cells make a polygon. Across one edge of it
// lies the triangle whose apex comes first in the pencil of circles through the edge, of all other vertices;
// what remains are a polygon on each side. Each triangle is right by the predicates that have chosen its
// apex, and knows its neighbors as it is found, so there is nothing to prove or to match afterwards. The new
// cells take the slots of old ones; two slots are left over.
#pragma once

#include "base/progress_meter.hpp"
#include "engine/change.hpp"
#include "engine/hole/star_in_plane.hpp"
#include "engine/sphere.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace delone::engine {

/// Memory is kept from one removal to the next.
template <Geometry G>
class PolygonFiller {
 public:
  /// Removes vertex v, one of whose cells is `cell`: done, or costly. Nothing is returned, and nothing has
  /// changed, if v is on the hull or in all finite cells. Strong guarantee.
  std::optional<Outcome> remove(Sphere<2, G>& sphere, Index v, Index cell) {
    CellStore<2>& cells = sphere.cells();
    Workspace& work = sphere.workspace();
    work.clear();
    if (!star_.find(cells, sphere.geometry(), v, cell)) return std::nullopt;
    if (star_.size() == cells.num_cells() - sphere.num_infinite()) return std::nullopt;
    looks_left_ = looks_per_cell * (std::size_t{cells.num_cells()} + 4000);
    if (!find_triangles(sphere.geometry(), sphere.effort().stages)) return Outcome::costly;
    reserve(sphere);
    for (const StarInPlane::Sector& sector : star_.sectors())
      work.zone.cells[work.zone.num_cells++] = sector.cell;
    write(sphere);
    return Outcome::done;
  }
  /// The cells that were created last.
  std::span<const Index> created() const { return created_; }

 private:
  /// The vertices first, …, last of the border make a polygon. Beyond its edge from the last to the first is
  /// a triangle, in whose slot it goes, or for the whole polygon a survivor.
  struct Polygon {
    std::uint32_t first, last, triangle;
    int slot;
  };
  /// A cell that has been found, and its neighbors.
  struct Triangle {
    std::array<Index, 3> vertices, neighbors;
  };
  /// What a cell of a rebuild costs, and an exact comparison, in looks at a vertex.
  static constexpr std::size_t looks_per_cell = 50, per_exact_test = 100;
  static constexpr std::uint32_t none = static_cast<std::uint32_t>(-1);

  bool find_triangles(const G& geometry, StageCounts& counts) {
    const std::span<const StarInPlane::Sector> sectors = star_.sectors();
    ring_.clear();
    for (const StarInPlane::Sector& sector : sectors) ring_.push_back(sector.vertex);
    created_.resize(sectors.size());  // for now, the cells within the edges of the border
    triangles_.clear();
    const auto last = static_cast<std::uint32_t>(sectors.size()) - 1;
    polygons_.assign(1, {0, last, none, 0});
    while (!polygons_.empty()) {
      const Polygon polygon = polygons_.back();
      polygons_.pop_back();
      std::uint32_t apex = polygon.first + 1;
      if (const std::size_t count = polygon.last - apex; count > 1) {
        const std::uint64_t exact_before = counts.exact;
        apex += static_cast<std::uint32_t>(geometry.first_of_plane(
            ring_[polygon.first], ring_[polygon.last], std::span(ring_).subspan(apex, count), counts));
        const std::size_t looks =
            count + per_exact_test * static_cast<std::size_t>(counts.exact - exact_before);
        if (looks > looks_left_) return false;
        looks_left_ -= looks;
        if (count > 1024) internal::cancellation_point();
      }
      const auto number = static_cast<std::uint32_t>(triangles_.size());
      const Index cell = sectors[number].cell;
      triangles_.push_back({{ring_[polygon.first], ring_[apex], ring_[polygon.last]}, {}});
      if (polygon.triangle == none) {
        triangles_[number].neighbors[1] = sectors[last].survivor;
        created_[last] = cell;
      } else {
        triangles_[number].neighbors[1] = sectors[polygon.triangle].cell;
        triangles_[polygon.triangle].neighbors[static_cast<std::size_t>(polygon.slot)] = cell;
      }
      const auto go_on = [&](std::uint32_t from, std::uint32_t to, int slot) {
        if (to > from + 1) return polygons_.push_back({from, to, number, slot});
        triangles_[number].neighbors[static_cast<std::size_t>(slot)] = sectors[from].survivor;
        created_[from] = cell;
      };
      go_on(polygon.first, apex, 2);
      go_on(apex, polygon.last, 0);
    }
    return true;
  }

  void reserve(Sphere<2, G>& sphere) {
    ConflictZone& zone = sphere.workspace().zone;
    zone.num_marked = zone.num_infinite = zone.num_undecided = zone.num_open = 0;
    zone.reserve(star_.size(), 3);
    sphere.cells().reserve_vacancies(2);
    if (!sphere.log().is_on()) return;
    dying_.clear();
    for (const StarInPlane::Sector& sector : star_.sectors()) dying_.push_back(sector.cell);
    sphere.log().reserve_new(triangles_.size());
    sphere.log().note(sphere.cells(), dying_);
  }

  void write(Sphere<2, G>& sphere) noexcept {
    CellStore<2>& cells = sphere.cells();
    const std::span<const StarInPlane::Sector> sectors = star_.sectors();
    for (std::size_t i = 0; i < sectors.size(); ++i)
      cells.neighbors(sectors[i].survivor)[sectors[i].mirror] = created_[i];
    created_.resize(triangles_.size());
    for (std::size_t i = 0; i < triangles_.size(); ++i) {
      const Triangle& triangle = triangles_[i];
      const Index cell = created_[i] = sectors[i].cell;
      for (std::size_t slot = 0; slot < 3; ++slot) {
        cells.set_vertex(cell, static_cast<int>(slot), triangle.vertices[slot]);
        cells.neighbors(cell)[slot] = triangle.neighbors[slot];
      }
      sphere.geometry().create(cell, triangle.vertices.data(), -1, 0);
    }
    for (std::size_t i = triangles_.size(); i < sectors.size(); ++i) cells.release(sectors[i].cell);
    sphere.log().note_new(std::span<const Index>(created_));
    sphere.effort().created_cells += triangles_.size();
    sphere.workspace().last_cell = created_.front();
  }

  StarInPlane star_;
  std::size_t looks_left_ = 0;
  std::vector<Index> ring_;  // the vertices of the border
  std::vector<Polygon> polygons_;
  std::vector<Triangle> triangles_;
  std::vector<Index> created_, dying_;
};

}  // namespace delone::engine
