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

#include <algorithm>
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
  /// A cell that has been found: the numbers of its vertices around the border, and its neighbors.
  struct Triangle {
    std::array<std::uint32_t, 3> corners;
    std::array<Index, 3> neighbors;
  };
  /// What a cell of a rebuild costs, and an exact comparison, in looks at a vertex.
  static constexpr std::size_t looks_per_cell = 50, per_exact_test = 100;
  static constexpr std::uint32_t none = static_cast<std::uint32_t>(-1);

  void make_room(std::size_t num_sectors) {
    created_.resize(num_sectors - 2);
    if (ring_.size() >= num_sectors) return;
    within_.resize(2 * num_sectors);
    triangles_.resize(2 * num_sectors);
    polygons_.resize(2 * num_sectors);
    rows_.resize(2 * num_sectors);
    ring_.resize(2 * num_sectors);  // last, so that it tells what there is room for
  }

  bool find_triangles(const G& geometry, StageCounts& counts) {
    const std::span<const StarInPlane::Sector> sectors = star_.sectors();
    make_room(sectors.size());
    std::transform(sectors.begin(), sectors.end(), ring_.begin(), [](const auto& s) { return s.vertex; });
    const auto last = static_cast<std::uint32_t>(sectors.size()) - 1;
    polygons_[0] = {0, last, none, 0};
    std::size_t num_polygons = 1;  // that are left
    for (std::uint32_t number = 0; num_polygons > 0; ++number) {
      const Polygon polygon = polygons_[--num_polygons];
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
      const Index cell = sectors[number].cell;
      Triangle& triangle = triangles_[number];
      triangle.corners = {polygon.first, apex, polygon.last};
      if (polygon.triangle == none) {
        triangle.neighbors[1] = sectors[last].survivor;
        within_[last] = cell;
      } else {
        triangle.neighbors[1] = sectors[polygon.triangle].cell;
        triangles_[polygon.triangle].neighbors[static_cast<std::size_t>(polygon.slot)] = cell;
      }
      const auto go_on = [&](std::uint32_t from, std::uint32_t to, int slot) {
        if (to > from + 1) {
          polygons_[num_polygons++] = {from, to, number, slot};
          return;
        }
        triangle.neighbors[static_cast<std::size_t>(slot)] = sectors[from].survivor;
        within_[from] = cell;
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
    sphere.log().reserve_new(created_.size());
    sphere.log().note(sphere.cells(), dying_);
  }

  void write(Sphere<2, G>& sphere) noexcept {
    CellStore<2>& cells = sphere.cells();
    const std::span<const StarInPlane::Sector> sectors = star_.sectors();
    for (std::size_t i = 0; i < sectors.size(); ++i)
      cells.neighbors(sectors[i].survivor)[sectors[i].mirror] = within_[i];
    for (std::size_t i = 0; i < sectors.size(); ++i)
      sphere.geometry().write_row_of(sectors[i].vertex, rows_[i].data());
    for (std::size_t i = 0; i < created_.size(); ++i) {
      const Triangle& triangle = triangles_[i];
      const Index cell = created_[i] = sectors[i].cell;
      std::array<double, 9> rows;
      for (std::size_t slot = 0; slot < 3; ++slot) {
        cells.set_vertex(cell, static_cast<int>(slot), ring_[triangle.corners[slot]]);
        cells.neighbors(cell)[slot] = triangle.neighbors[slot];
        std::copy_n(rows_[triangle.corners[slot]].data(), 3, rows.data() + 3 * slot);
      }
      sphere.geometry().create_triangle(cell, rows.data());
    }
    for (std::size_t i = created_.size(); i < sectors.size(); ++i) cells.release(sectors[i].cell);
    sphere.log().note_new(std::span<const Index>(created_));
    sphere.effort().created_cells += created_.size();
    sphere.workspace().last_cell = created_.front();
  }

  StarInPlane star_;
  std::size_t looks_left_ = 0;
  // At least as many as sectors:
  std::vector<Index> ring_;    // the vertices of the border
  std::vector<Index> within_;  // the new cells within its edges
  std::vector<Triangle> triangles_;
  std::vector<Polygon> polygons_;
  std::vector<std::array<double, 3>> rows_;  // of the vertices of the border
  std::vector<Index> created_, dying_;
};

}  // namespace delone::engine
