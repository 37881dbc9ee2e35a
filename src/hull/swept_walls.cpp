// SPDX-License-Identifier: BSD-3-Clause
#include "hull/swept_walls.hpp"

#include "hull/hull_analysis.hpp"
#include "hull/wall_sweep.hpp"
#include "kernel/stages.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace delone::hull {
namespace {

/// A site of a wall.
struct Member {
  double first, second;  ///< the first coordinates, which mostly decide
  Index site;
};

/// Sorts members in an order that compares first coordinates first: those in strips of equal width, into
/// which they are put before. Numbers of strips are rounded, but never decrease as the coordinate increases.
template <class IsBefore>
void sort_members(std::vector<Member>& members, IsBefore is_before) {
  constexpr std::size_t few = 256;
  const std::size_t n = members.size();
  double low = members[0].first, high = low;
  for (const Member& member : members) {
    low = std::min(low, member.first);
    high = std::max(high, member.first);
  }
  const double strips_per_unit = static_cast<double>(n - 1) / (high - low);
  if (n < few || !(strips_per_unit > 0x1p-1000 && strips_per_unit < 0x1p1000))
    return std::sort(members.begin(), members.end(), is_before);
  const auto strip_of = [&](const Member& member) {
    return std::min(static_cast<std::size_t>((member.first - low) * strips_per_unit), n - 1);
  };
  std::vector<Index> ends(n + 1, 0);  // of the strips before, and then of each
  for (const Member& member : members) ++ends[strip_of(member) + 1];
  std::partial_sum(ends.begin(), ends.end(), ends.begin());
  std::vector<Member> sorted(n);
  for (const Member& member : members) sorted[ends[strip_of(member)]++] = member;
  for (std::size_t strip = 0, begin = 0; strip < n; begin = ends[strip++])
    if (ends[strip] - begin > 1)
      std::sort(sorted.begin() + static_cast<std::ptrdiff_t>(begin), sorted.begin() + ends[strip], is_before);
  members = std::move(sorted);
}

/// The walls of a hull, and the sites on each.
class Walls {
 public:
  explicit Walls(const HullState& state)
      : boundary_(*state.boundary()),
        sites_(state.sites()),
        hull_(state.hull()),
        analysis_(state),
        grid_(sites_.grid),
        walls_(cells_of_wall().size()),
        is_vertex_(sites_.size(), 0) {
    grid_.include(boundary_.center().data());
    for (const Index site : hull_.cells) is_vertex_[site] = 1;
    for (Index w = 0; w < walls_.size(); ++w) {
      const auto cell = hull_.cell(cells_of_wall()[w][0]);
      for (const int axis : sites_.axes) {  // none of these coordinates is the same everywhere in the flat
        const double value = point(cell[0])[axis];
        if (std::all_of(cell.begin(), cell.end(), [&](Index site) { return point(site)[axis] == value; }))
          axis_parallel_.push_back({axis, value, w});
      }
    }
  }

  /// Whether at least a quarter of some sites are on walls.
  bool have_many(std::span<const Index> sites) {
    constexpr std::size_t sample = 64;
    if (sites.size() < 2 * sample) return false;
    std::size_t on_walls = 0;
    for (std::size_t i = 0; i < sample; ++i)
      on_walls += place(sites[i * (sites.size() / sample)], [](Index) {}) ? 1 : 0;
    return on_walls >= sample / 4;
  }
  /// Sorts out sites; returns, by site, which are strictly inside.
  std::vector<char> add(std::span<const Index> sites) {
    std::vector<char> is_inside(sites_.size(), 0);
    std::vector<std::pair<Index, Index>> places;
    places.reserve(sites.size());
    std::vector<std::size_t> counts(walls_.size(), 0);
    for (const Index site : sites) {
      const auto note = [&](Index wall) {
        places.emplace_back(wall, site);
        ++counts[wall];
      };
      is_inside[site] = place(site, note) ? 0 : 1;
    }
    for (Index w = 0; w < walls_.size(); ++w) walls_[w].members.reserve(counts[w]);
    for (const auto& [wall, site] : places) add_member(wall, site);
    return is_inside;
  }
  void sweep(const std::function<void(std::size_t)>& tick);
  /// The cells of all walls.
  void assemble(SimplicialHull& hull, std::vector<Index>& planes);

 private:
  struct Wall {
    std::vector<Member> members;  ///< if there are any, with the vertices of the present cells
    SweptWall swept;              ///< their cells
    Index first_cell = 0;         ///< of these in the new hull
    bool is_new = false;          ///< has members that were not swept
  };
  /// A wall in the hyperplane of a coordinate with this value.
  struct AxisParallel {
    int axis;
    double value;
    Index wall;
  };

  const Lists& cells_of_wall() const { return analysis_.faces().cells_of_facet; }
  Index wall_of_cell(Index cell) const { return analysis_.faces().facet_of_cell[cell]; }
  const double* point(Index site) const { return sites_.point(site); }

  /// Calls add(wall) for a wall that a site is on, and for all walls in the hyperplane of a coordinate that
  /// it is on. A site of the hull that is on the hyperplane of a wall is on the wall. Returns whether it is
  /// on any.
  template <class Add>
  bool place(Index site, Add add) {
    bool is_placed = false;
    for (const auto& [axis, value, wall] : axis_parallel_)
      if (point(site)[axis] == value) {
        add(wall);
        is_placed = true;
      }
    if (is_placed) return true;
    const HullLocator::Result found = analysis_.locator()->locate_from(cell_, point(site), grid_);
    cell_ = found.cell;
    if (found.side == Sign::positive) return false;
    add(wall_of_cell(static_cast<Index>(cell_)));
    return true;
  }
  void add_member(Index wall, Index site) {
    walls_[wall].members.push_back(member_at(site));
    walls_[wall].is_new = true;
  }
  Member member_at(Index site) const { return {point(site)[0], point(site)[1], site}; }
  auto is_before() const {
    return [this](const Member& a, const Member& b) {
      if (a.first != b.first) return a.first < b.first;
      if (a.second != b.second) return a.second < b.second;
      return kernel::lexicographically_less(point(a.site), point(b.site), sites_.ambient);
    };
  }
  bool is_member(Index wall, Index site) const {
    const auto& members = walls_[wall].members;
    const auto at = std::lower_bound(members.begin(), members.end(), member_at(site), is_before());
    return at != members.end() && at->site == site;
  }
  void sweep(Index wall, const std::function<void(std::size_t)>& tick);
  void share_borders();
  void link(SimplicialHull& hull, const std::vector<std::size_t>& borders) const;

  const Boundary& boundary_;
  const BoundarySites& sites_;
  const SimplicialHull& hull_;
  HullAnalysis analysis_;
  kernel::Grid grid_;  // of the sites and the centre
  std::vector<Wall> walls_;
  std::vector<char> is_vertex_;  // of present cells, by site
  std::vector<AxisParallel> axis_parallel_;
  std::size_t cell_ = 0;  // where the last walk has ended
};

void Walls::sweep(Index w, const std::function<void(std::size_t)>& tick) {
  Wall& wall = walls_[w];
  if (wall.swept.cells.empty()) {
    std::vector<Index> vertices;
    for (const Index c : cells_of_wall()[w])
      vertices.insert(vertices.end(), hull_.cell(c).begin(), hull_.cell(c).end());
    std::sort(vertices.begin(), vertices.end());
    vertices.erase(std::unique(vertices.begin(), vertices.end()), vertices.end());
    for (const Index site : vertices) add_member(w, site);
  }
  sort_members(wall.members, is_before());
  std::vector<Index> order(wall.members.size());
  std::transform(wall.members.begin(), wall.members.end(), order.begin(),
                 [](const Member& m) { return m.site; });
  wall.swept = sweep_wall(sites_, order, tick);
  wall.is_new = false;
  std::vector<Index>&cells = wall.swept.cells, &neighbors = wall.swept.neighbors;
  std::vector<const double*> scratch;
  if (compiled::side_of_sites(sites_, std::span(cells).first(wall.swept.corners), boundary_.center().data(),
                              grid_, scratch) == Sign::positive)
    return;
  for (std::size_t at = 0; at < cells.size(); at += wall.swept.corners) {
    std::swap(cells[at], cells[at + 1]);
    std::swap(neighbors[at], neighbors[at + 1]);
  }
}

void Walls::sweep(const std::function<void(std::size_t)>& tick) {
  std::size_t done = 0;
  const auto sweep_new = [&] {
    for (Index w = 0; w < walls_.size(); ++w)
      if (walls_[w].is_new) {
        sweep(w, [&](std::size_t of_wall) { tick(done + of_wall); });
        done += walls_[w].members.size();
      }
  };
  sweep_new();
  if (axis_parallel_.size() == walls_.size()) return;
  share_borders();
  sweep_new();
}

/// Makes the sites of borders members of all walls that they are on. A site on several walls is a member of
/// one of them, and there it is in a ridge of the border.
void Walls::share_borders() {
  std::vector<std::pair<Index, Index>> shared;
  for (Index w = 0; w < walls_.size(); ++w) {
    const SweptWall& swept = walls_[w].swept;
    for (std::size_t at = 0; at < swept.cells.size(); ++at) {
      if (swept.neighbors[at] != invalid_index) continue;
      const std::size_t cell = at / swept.corners * swept.corners;
      for (std::size_t i = cell; i < cell + swept.corners; ++i)
        if (i != at && !is_vertex_[swept.cells[i]]) shared.emplace_back(swept.cells[i], w);
    }
  }
  std::sort(shared.begin(), shared.end());
  shared.erase(std::unique(shared.begin(), shared.end(),
                           [](const auto& a, const auto& b) { return a.first == b.first; }),
               shared.end());
  std::vector<std::pair<Index, Index>> missing;
  for (const auto& [site, wall] : shared)
    for (const Index c :
         analysis_.locator()->cells_on_side(cells_of_wall()[wall][0], Sign::zero, point(site), sites_.grid))
      if (const Index other = wall_of_cell(c); c == cells_of_wall()[other][0] && !is_member(other, site))
        missing.emplace_back(other, site);
  for (const auto& [wall, site] : missing) add_member(wall, site);
}

void Walls::assemble(SimplicialHull& hull, std::vector<Index>& planes) {
  const std::size_t k = hull_.corners();
  hull.dimension = hull_.dimension;
  std::vector<Index> number(hull_.num_cells(), invalid_index);  // of cells that stay
  std::vector<double> normal(k);
  std::size_t num_cells = hull_.num_cells();  // no fewer than there will be
  for (const Wall& wall : walls_) num_cells += wall.swept.num_cells();
  hull.cells.reserve(num_cells * k);
  planes.reserve(num_cells);
  for (Index w = 0; w < walls_.size(); ++w) {
    const SweptWall& swept = walls_[w].swept;
    const auto cells = cells_of_wall()[w];
    walls_[w].first_cell = static_cast<Index>(hull.num_cells());
    if (swept.cells.empty()) {
      for (const Index c : cells) {
        number[c] = static_cast<Index>(hull.num_cells());
        hull.cells.insert(hull.cells.end(), hull_.cell(c).begin(), hull_.cell(c).end());
        planes.push_back(hull_.slots[c]);
      }
      continue;
    }
    hull.cells.insert(hull.cells.end(), swept.cells.begin(), swept.cells.end());
    Index best = hull_.slots[cells[0]];
    double least = std::numeric_limits<double>::infinity();
    for (const Index c : cells)
      if (const double threshold = compiled::hyperplane(*boundary_.engine(), hull_.slots[c], normal.data());
          threshold < least) {
        least = threshold;
        best = hull_.slots[c];
      }
    planes.resize(hull.num_cells(), best);
  }
  std::vector<std::size_t> borders;  // places of vertices opposite ridges of two walls
  hull.neighbors.reserve(hull.cells.size());
  const auto add_neighbor = [&](Index first, Index neighbor) {
    if (neighbor == invalid_index) borders.push_back(hull.neighbors.size());
    hull.neighbors.push_back(neighbor == invalid_index ? neighbor : first + neighbor);
  };
  for (Index w = 0; w < walls_.size(); ++w) {
    const SweptWall& swept = walls_[w].swept;
    for (const Index neighbor : swept.neighbors) add_neighbor(walls_[w].first_cell, neighbor);
    if (!swept.cells.empty()) continue;
    for (const Index c : cells_of_wall()[w])
      for (const Index neighbor : hull_.neighbors_of(c)) add_neighbor(0, number[neighbor]);
  }
  link(hull, borders);
}

/// Links cells of different walls: each ridge between two of them is there twice.
void Walls::link(SimplicialHull& hull, const std::vector<std::size_t>& borders) const {
  const std::size_t k = hull.corners();
  std::vector<Index> ridges;  // their sites, sorted
  ridges.reserve(borders.size() * (k - 1));
  for (const std::size_t at : borders) {
    for (std::size_t i = at / k * k; i < at / k * k + k; ++i)
      if (i != at) ridges.push_back(hull.cells[i]);
    std::sort(ridges.end() - static_cast<std::ptrdiff_t>(k - 1), ridges.end());
  }
  std::vector<std::size_t> order(borders.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto ridge = [&](std::size_t i) { return std::span(ridges).subspan(i * (k - 1), k - 1); };
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::lexicographical_compare(ridge(a).begin(), ridge(a).end(), ridge(b).begin(), ridge(b).end());
  });
  for (std::size_t i = 0; i + 1 < order.size(); i += 2) {
    const std::size_t a = borders[order[i]], b = borders[order[i + 1]];
    hull.neighbors[a] = static_cast<Index>(b / k);
    hull.neighbors[b] = static_cast<Index>(a / k);
  }
}

}  // namespace

std::optional<SweptWalls> sweep_walls(const HullState& hull, std::span<const Index> sites,
                                      const std::function<void(std::size_t)>& tick) {
  const Boundary* const boundary = hull.boundary();
  if (boundary == nullptr || !HullLocator(hull.sites(), *boundary).has_fan()) return std::nullopt;
  Walls walls(hull);
  if (!walls.have_many(sites)) return std::nullopt;
  SweptWalls result;
  result.is_inside = walls.add(sites);
  walls.sweep(tick);
  walls.assemble(result.hull, result.planes);
  return result;
}

}  // namespace delone::hull
