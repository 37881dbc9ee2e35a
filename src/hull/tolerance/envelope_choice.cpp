// SPDX-License-Identifier: BSD-3-Clause
#include "hull/tolerance/envelope_choice.hpp"

#include "hull/cell_height.hpp"

#include <delone/convex_hull.hpp>
#include <delone/lower_hull.hpp>

#include <algorithm>
#include <numeric>
#include <optional>
#include <utility>

namespace delone::hull {

namespace {

/// The lower hull of some of the points; its rows are places among them.
struct Part {
  Part(const std::vector<Index>& members, const std::vector<const double*>& points, int width)
      : rows(members) {
    std::vector<double> coordinates;
    for (const Index v : rows) coordinates.insert(coordinates.end(), points[v], points[v] + width);
    if (width > 1) {
      hull.emplace(PointsView(coordinates, width));
      return;
    }
    lowest = *std::min_element(rows.begin(), rows.end(),
                               [&](Index a, Index b) { return points[a][0] < points[b][0]; });
  }
  /// The vertices of a cell.
  std::vector<Index> cell(std::size_t c) const {
    if (!hull) return {lowest};
    const auto corners = static_cast<std::size_t>(hull->composition_dimension() + 1);
    std::vector<Index> result;
    for (const SignedIndex row : hull->cells().subspan(c * corners, corners))
      result.push_back(rows[static_cast<std::size_t>(row)]);
    return result;
  }
  std::optional<std::size_t> find(const double* point, int width) const {
    if (!hull) return 0;
    return hull->find_cell(std::span(point, static_cast<std::size_t>(width) - 1));
  }

  std::vector<Index> rows;
  std::optional<LowerHull<>> hull;
  Index lowest = 0;
};

class Choice {
 public:
  Choice(std::vector<const double*> points, int width, double tolerance, const std::function<void()>& alive)
      : points_(std::move(points)),
        width_(width),
        tolerance_(tolerance),
        alive_(alive),
        is_kept_(points_.size(), 0),
        is_fixed_(points_.size(), 0) {}

  void keep_domain() {
    if (width_ == 1) {
      keep(0);
    } else {
      std::vector<double> compositions;
      for (const double* p : points_) compositions.insert(compositions.end(), p, p + width_ - 1);
      const ConvexHull<> domain(compositions, width_ - 1);
      for (std::size_t v = 0; v < points_.size(); ++v)
        if (domain.kind(v) == PointKind::extreme) keep(static_cast<Index>(v));
    }
    is_fixed_ = is_kept_;
  }

  /// Keeps the farthest below each cell, until none is too far.
  void complete() {
    std::vector<Index> pending;
    for (std::size_t v = 0; v < points_.size(); ++v)
      if (is_kept_[v] == 0) pending.push_back(static_cast<Index>(v));
    while (!pending.empty()) {
      const Part part(sorted_kept(), points_, width_);
      struct Farthest {
        std::size_t cell;
        double distance;
        Index point;
      };
      std::vector<Farthest> farthest;
      std::erase_if(pending, [&](Index v) {
        alive_();
        const std::size_t c = part.find(points_[v], width_).value();
        const HeightOfPlane height = height_over(part, c, v);
        if (!height.exceeds(tolerance_)) return true;
        farthest.push_back({c, height.above(), v});
        return false;
      });
      std::stable_sort(farthest.begin(), farthest.end(), [](const Farthest& a, const Farthest& b) {
        return a.cell != b.cell ? a.cell < b.cell : a.distance > b.distance;
      });
      std::vector<Index> chosen;
      for (std::size_t i = 0; i < farthest.size(); ++i)
        if (i == 0 || farthest[i].cell != farthest[i - 1].cell) chosen.push_back(farthest[i].point);
      std::sort(chosen.begin(), chosen.end());
      for (const Index v : chosen) keep(v);
      std::erase_if(pending, [&](Index v) { return is_kept_[v] != 0; });
    }
  }

  void reduce() {
    while (drop_some()) {
    }
  }

  EnvelopeChoice result(std::span<const SignedIndex> rows) const {
    EnvelopeChoice choice;
    const Part part(sorted_kept(), points_, width_);
    for (std::size_t v = 0; v < points_.size(); ++v) {
      if (is_kept_[v] != 0) {
        choice.rows.push_back(rows[v]);
        continue;
      }
      const std::size_t c = part.find(points_[v], width_).value();
      choice.max_distance = std::max(
          choice.max_distance, std::min(tolerance_, height_over(part, c, static_cast<Index>(v)).above()));
    }
    return choice;
  }

 private:
  void keep(Index v) {
    is_kept_[v] = 1;
    kept_.push_back(v);
  }
  std::vector<Index> sorted_kept() const {
    std::vector<Index> rows;
    for (std::size_t v = 0; v < points_.size(); ++v)
      if (is_kept_[v] != 0) rows.push_back(static_cast<Index>(v));
    return rows;
  }
  HeightOfPlane height_over(const Part& part, std::size_t c, Index v) const {
    std::vector<const double*> cell;
    for (const Index corner : part.cell(c)) cell.push_back(points_[corner]);
    return {cell, points_[v], width_};
  }

  /// Drops vertices, no two of them neighbors. Returns false if none can be dropped; then none ever can.
  bool drop_some() {
    const Part part(sorted_kept(), points_, width_);
    if (!part.hull) return false;
    const std::size_t m = part.hull->num_cells(), num_facets = part.hull->num_facets();
    const auto facet_of = [&](std::size_t c) {
      return static_cast<std::size_t>(part.hull->facet_of_cell()[c]);
    };
    std::vector<std::vector<Index>> corners(num_facets), below(num_facets);
    std::vector<std::vector<std::size_t>> facets_of(points_.size());
    for (std::size_t c = 0; c < m; ++c)
      for (const Index v : part.cell(c)) {
        corners[facet_of(c)].push_back(v);
        facets_of[v].push_back(facet_of(c));
      }
    for (std::size_t v = 0; v < points_.size(); ++v)
      if (is_kept_[v] == 0)
        below[facet_of(part.find(points_[v], width_).value())].push_back(static_cast<Index>(v));
    bool dropped = false;
    std::vector<char> is_blocked(points_.size(), 0);
    for (std::size_t i = kept_.size(); i-- > 0;) {
      const Index s = kept_[i];
      if (is_fixed_[s] != 0 || is_blocked[s] != 0) continue;
      std::vector<Index> neighbors, concerned{s};
      for (const std::size_t f : facets_of[s]) {
        neighbors.insert(neighbors.end(), corners[f].begin(), corners[f].end());
        concerned.insert(concerned.end(), below[f].begin(), below[f].end());
      }
      for (std::vector<Index>* list : {&neighbors, &concerned}) {
        std::sort(list->begin(), list->end());
        list->erase(std::unique(list->begin(), list->end()), list->end());
      }
      std::erase(neighbors, s);
      if (!covers(neighbors, concerned)) {
        is_fixed_[s] = 1;
        continue;
      }
      for (const Index v : neighbors) is_blocked[v] = 1;
      is_kept_[s] = 0;
      dropped = true;
    }
    std::erase_if(kept_, [&](Index v) { return is_kept_[v] == 0; });
    return dropped;
  }
  bool covers(const std::vector<Index>& members, const std::vector<Index>& concerned) const {
    const Part part(members, points_, width_);
    if (part.hull && part.hull->composition_dimension() + 1 < width_) return false;
    return std::all_of(concerned.begin(), concerned.end(), [&](Index v) {
      alive_();
      const std::optional<std::size_t> c = part.find(points_[v], width_);
      return c && !height_over(part, *c, v).exceeds(tolerance_);
    });
  }

  std::vector<const double*> points_;
  int width_;
  double tolerance_;
  const std::function<void()>& alive_;
  std::vector<char> is_kept_, is_fixed_;
  std::vector<Index> kept_;  // in the order in which they came
};

}  // namespace

EnvelopeChoice choose_envelope(std::span<const double> points, int width,
                               std::span<const SignedIndex> vertices, double tolerance,
                               const std::function<void()>& alive) {
  const auto n = static_cast<std::size_t>(width);
  const auto point = [&](SignedIndex row) { return points.data() + static_cast<std::size_t>(row) * n; };
  std::vector<SignedIndex> rows(vertices.begin(), vertices.end());
  std::sort(rows.begin(), rows.end(), [&](SignedIndex a, SignedIndex b) {
    return std::lexicographical_compare(point(a), point(a) + n, point(b), point(b) + n);
  });
  std::vector<const double*> places;
  for (const SignedIndex row : rows) places.push_back(point(row));
  Choice choice(std::move(places), width, tolerance, alive);
  choice.keep_domain();
  choice.complete();
  choice.reduce();
  return choice.result(rows);
}

}  // namespace delone::hull
