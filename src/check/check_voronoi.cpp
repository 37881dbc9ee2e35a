// SPDX-License-Identifier: BSD-3-Clause
// check() of a diagram: the arrays against the diagram of their points, rebuilt from a
// triangulation that check() has examined.
//
// A Voronoi vertex is known by the regions it is in: the sites nearest to it are the corners of one Delaunay
// polytope of full dimension, and no two polytopes have the same corners. A ray is known by its vertex and
// the sites in the hyperplane of its hull facet. So the numbers of file and diagram translate into each other
// exactly, and all else is compared as it stands.
#include "base/progress_meter.hpp"
#include "check/levels.hpp"
#include "check/remade.hpp"

#include <delone/arithmetic.hpp>
#include <delone/check.hpp>
#include <delone/predicates.hpp>
#include <delone/voronoi.hpp>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace delone {
namespace {

using internal::Violation;
using Sites = std::vector<SignedIndex>;  // regions, increasing

std::string text_of(const char* what, std::size_t i) { return std::string(what) + " " + std::to_string(i); }

std::string text_of(const Sites& sites) {
  constexpr std::size_t most = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(sites.size(), most); ++i)
    text += (i == 0 ? "" : ", ") + std::to_string(sites[i]);
  return text + (sites.size() > most ? ", …" : "");
}

std::span<const SignedIndex> list(const std::vector<SignedIndex>& items,
                                  const std::vector<std::int64_t>& offsets, std::size_t i) {
  return std::span(items).subspan(static_cast<std::size_t>(offsets[i]),
                                  static_cast<std::size_t>(offsets[i + 1] - offsets[i]));
}

/// Whether two lists with the same entries, each at most once, are the same cycle. −1 is first in both or in
/// none.
bool same_cycle(std::span<const SignedIndex> a, std::vector<SignedIndex> b, bool any_direction) {
  if (a.size() != b.size()) return false;
  if (a.size() < 2) return std::equal(a.begin(), a.end(), b.begin());
  for (int direction = 0; direction < (any_direction ? 2 : 1); ++direction) {
    if (direction == 1) std::reverse(b.begin(), b.end());
    const auto start = std::find(b.begin(), b.end(), a[0]);
    if (start == b.end()) return false;
    std::rotate(b.begin(), start, b.end());
    if (std::equal(a.begin(), a.end(), b.begin())) return true;
  }
  return false;
}

class DiagramChecker {
 public:
  explicit DiagramChecker(const VoronoiData& data)
      : data_(data), d_(static_cast<std::size_t>(std::max(data.dimension, 0))) {}

  CheckReport check(const CheckOptions& options, unsigned threads) {
    return internal::run_levels<VoronoiData>(
        options, [&](CheckReport&) { check_storage(); },
        [&](CheckReport&) {
          make_diagram(threads);
          check_regions();
        },
        [&](CheckReport&) { check_vertices(); }, [&](CheckReport&) { check_ridges(); },
        [&](CheckReport&) { check_rays(); });
  }

 private:
  void check_kind() const;
  void check_storage() const;
  void make_diagram(unsigned threads);
  void check_regions();
  void check_vertices() const;
  void check_ridges() const;
  void check_rays() const;
  void check_list(const char* what, std::size_t i, std::span<const SignedIndex> items) const;

  bool is_furthest() const { return data_.kind == DataKind::furthest_voronoi; }
  const char* nearest() const { return is_furthest() ? "furthest from" : "nearest to"; }
  std::size_t k() const { return static_cast<std::size_t>(std::max(data_.affine_dimension, 0)); }
  std::span<const SignedIndex> region(std::size_t i) const {
    return list(data_.region_vertices, data_.region_offsets, i);
  }
  std::span<const SignedIndex> ridge(std::size_t i) const {
    return list(data_.ridge_vertices, data_.ridge_offsets, i);
  }
  /// The number in the diagram of a region of the file by a row of it, and of the vertices in a list.
  SignedIndex region_of_row(SignedIndex row) const {
    return diagram_->point_region()[static_cast<std::size_t>(row)];
  }
  std::vector<SignedIndex> translated(std::span<const SignedIndex> vertices) const {
    std::vector<SignedIndex> result;
    for (const SignedIndex v : vertices)
      result.push_back(v < 0 ? -1 : vertex_of_[static_cast<std::size_t>(v)]);
    return result;
  }
  using RayKey = std::pair<SignedIndex, Sites>;
  std::optional<RayKey> key_of_ray(SignedIndex vertex, std::span<const SignedIndex> rows) const;

  const VoronoiData& data_;
  const std::size_t d_;
  std::variant<std::monostate, Voronoi<>, PowerDiagram<>, FurthestVoronoi<>> any_;
  const Diagram* diagram_ = nullptr;    // the rebuilt diagram
  std::vector<SignedIndex> vertex_of_;  // of the diagram, by vertex of the file
  std::vector<Sites> sites_of_;         // by vertex of the diagram
};

void DiagramChecker::check_list(const char* what, std::size_t i, std::span<const SignedIndex> items) const {
  Sites sorted(items.begin(), items.end());
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
    throw Violation{text_of(what, i) + ": a vertex appears twice"};
  for (const SignedIndex v : items)
    if (v < -1 || v >= static_cast<SignedIndex>(data_.num_vertices()))
      throw Violation{text_of(what, i) + ": there is no vertex " + std::to_string(v)};
  if (!sorted.empty() && sorted[0] == -1 && items[0] != -1)
    throw Violation{text_of(what, i) + ": -1 is not first"};
}

void DiagramChecker::check_kind() const {
  const std::string what(description_of(data_.kind));
  switch (data_.kind) {
    case DataKind::unknown:
      break;
    case DataKind::voronoi:
    case DataKind::furthest_voronoi:
      if (!data_.weights.empty()) throw Violation{what + " has no weights, and these data have some"};
      break;
    case DataKind::power_diagram:
      if (data_.weights.empty() && data_.num_points() > 0)
        throw Violation{what + " has weights, and these data have none"};
      break;
    default:
      throw Violation{"the data say that they are " + what + ", which has other arrays"};
  }
}

void DiagramChecker::check_storage() const {
  check_kind();
  const VoronoiData& a = data_;
  if (a.dimension < 1 || a.affine_dimension < -1 || a.affine_dimension > a.dimension)
    throw Violation{"impossible dimensions"};
  if (!(a.tolerance >= 0) || !std::isfinite(a.tolerance))
    throw Violation{"the tolerance is not a finite number of at least 0"};
  internal::check_axis_tolerances(a.tolerance, a.axis_tolerances, a.dimension);
  const std::size_t n = a.num_points();
  const auto size = [](const char* name, std::size_t found, std::size_t expected) {
    if (found != expected)
      throw Violation{std::string(name) + ": " + std::to_string(expected) + " entries were expected, not " +
                      std::to_string(found)};
  };
  size("points", a.points.size(), n * d_);
  size("weights", a.weights.size(), a.weights.empty() ? 0 : n);
  for (std::size_t i = 0; i < a.points.size(); ++i)
    if (!std::isfinite(a.points[i]) && !a.is_removed(i / d_))
      throw Violation{text_of("point", i / d_) + " has a coordinate that is not finite"};
  for (std::size_t row = 0; row < a.weights.size(); ++row)
    if (!std::isfinite(a.weights[row]) && !a.is_removed(row))
      throw Violation{"the weight of " + text_of("point", row) + " is not finite"};
  size("vertices", a.vertices.size(), a.num_vertices() * d_);
  size("ridge_points", a.ridge_points.size(), 2 * a.num_ridges());
  size("ray_directions", a.ray_directions.size(), a.num_rays() * d_);
  size("ray_points", a.ray_points.size(), a.num_rays() * k());
  for (const auto& [name, offsets, items] : {std::tuple{"ridge_offsets", &a.ridge_offsets, &a.ridge_vertices},
                                             {"region_offsets", &a.region_offsets, &a.region_vertices}})
    if (offsets->empty() || offsets->front() != 0 || !std::is_sorted(offsets->begin(), offsets->end()) ||
        offsets->back() != static_cast<std::int64_t>(items->size()))
      throw Violation{std::string(name) + ": not increasing from 0 to the number of vertices listed"};
  for (std::size_t i = 0; i < a.num_regions(); ++i) check_list("region", i, region(i));
  for (std::size_t i = 0; i < a.num_ridges(); ++i) check_list("ridge", i, ridge(i));
  const auto in_range = [](const char* name, const std::vector<SignedIndex>& items, std::size_t count,
                           SignedIndex least) {
    for (std::size_t i = 0; i < items.size(); ++i)
      if (items[i] < least || items[i] >= static_cast<SignedIndex>(count))
        throw Violation{std::string(name) + ": entry " + std::to_string(i) + " is " +
                        std::to_string(items[i]) + ", of " + std::to_string(count)};
  };
  in_range("point_region", a.point_region, a.num_regions(), -1);
  in_range("ridge_points", a.ridge_points, n, 0);
  in_range("ray_points", a.ray_points, n, 0);
  in_range("ray_vertices", a.ray_vertices, a.num_vertices(), 0);
}

void DiagramChecker::make_diagram(unsigned threads) {
  const DiagramOptions options{.tolerance = data_.tolerance, .axis_tolerances = data_.axis_tolerances};
  const Execution how{.threads = threads};
  const TriangulationKind kind = is_furthest()           ? TriangulationKind::furthest_site
                                 : data_.weights.empty() ? TriangulationKind::delaunay
                                                         : TriangulationKind::regular;
  const internal::AnyTriangulation made = internal::remade(data_, kind, threads);
  if (const auto* const delaunay = std::get_if<Delaunay<>>(&made))
    diagram_ = &any_.emplace<Voronoi<>>(*delaunay, options, how);
  else if (const auto* const regular = std::get_if<Regular<>>(&made))
    diagram_ = &any_.emplace<PowerDiagram<>>(*regular, options, how);
  else
    diagram_ = &any_.emplace<FurthestVoronoi<>>(std::get<FurthestSite<>>(made), options, how);
}

void DiagramChecker::check_regions() {
  const Diagram& diagram = *diagram_;
  if (diagram.affine_dimension() != data_.affine_dimension)
    throw Violation{"the affine dimension is " + std::to_string(diagram.affine_dimension()) + ", not " +
                    std::to_string(data_.affine_dimension)};
  if (diagram.num_regions() != data_.num_regions())
    throw Violation{"there are " + std::to_string(diagram.num_regions()) + " regions, not " +
                    std::to_string(data_.num_regions())};
  // Regions of file and diagram by each other's numbers.
  std::vector<SignedIndex> there(diagram.num_regions(), -1), here(there);
  for (std::size_t row = 0; row < data_.num_points(); ++row) {
    internal::cancellation_point();
    const SignedIndex r = data_.point_region[row], s = diagram.point_region()[row];
    if (r < 0 && s < 0) continue;
    if (s < 0) throw Violation{text_of("point", row) + " is hidden, but has a region"};
    if (r < 0) throw Violation{text_of("point", row) + " has no region, but is not hidden"};
    SignedIndex &to = there[static_cast<std::size_t>(r)], &back = here[static_cast<std::size_t>(s)];
    if ((to >= 0 && to != s) || (back >= 0 && back != r))
      throw Violation{text_of("point", row) + " has the region of another site"};
    to = s;
    back = r;
  }
  // The regions at each vertex.
  sites_of_.resize(diagram.num_vertices());
  std::vector<Sites> sites_here(data_.num_vertices());
  for (std::size_t s = 0; s < diagram.num_regions(); ++s) {
    for (const SignedIndex v : diagram.region(s))
      if (v >= 0) sites_of_[static_cast<std::size_t>(v)].push_back(static_cast<SignedIndex>(s));
    const auto items = region(static_cast<std::size_t>(here[s]));
    for (const SignedIndex v : items)
      if (v >= 0) sites_here[static_cast<std::size_t>(v)].push_back(static_cast<SignedIndex>(s));
    if ((!items.empty() && items[0] < 0) == diagram.is_bounded(s) && diagram.affine_dimension() > 0)
      throw Violation{text_of("region", static_cast<std::size_t>(here[s])) + " is " +
                      (diagram.is_bounded(s) ? "bounded" : "unbounded")};
  }
  // Regions that a tolerance has left without volume may have two vertices with the same sites. Then
  // coordinates tell them apart.
  using Key = std::pair<Sites, std::vector<double>>;
  const auto key = [&](const Sites& sites, std::span<const double> coordinates, std::size_t v) {
    if (data_.tolerance == 0) return Key{sites, {}};
    const auto own = coordinates.subspan(v * d_, d_);
    return Key{sites, {own.begin(), own.end()}};
  };
  std::map<Key, SignedIndex> vertex_with;
  for (std::size_t v = 0; v < sites_of_.size(); ++v)
    vertex_with.emplace(key(sites_of_[v], diagram.vertices(), v), static_cast<SignedIndex>(v));
  for (std::size_t v = 0; v < sites_here.size(); ++v) {
    const auto found = vertex_with.find(key(sites_here[v], data_.vertices, v));
    if (found == vertex_with.end() || found->second < 0)
      throw Violation{text_of("vertex", v) +
                      (found == vertex_with.end() ? ": the sites of its regions, "
                                                  : ": another vertex has the same regions, ") +
                      text_of(sites_here[v]) +
                      (found == vertex_with.end()
                           ? std::string(", are not all that are ") + nearest() + " a point"
                           : std::string())};
    vertex_of_.push_back(std::exchange(found->second, -1));
  }
  if (data_.num_vertices() != diagram.num_vertices())
    throw Violation{"there are " + std::to_string(diagram.num_vertices()) + " vertices, not " +
                    std::to_string(data_.num_vertices())};
  if (data_.affine_dimension != 2) return;
  for (std::size_t s = 0; s < diagram.num_regions(); ++s) {
    const auto items = diagram.region(s), found = region(static_cast<std::size_t>(here[s]));
    if (!same_cycle(translated(found), {items.begin(), items.end()},
                    data_.affine_dimension < data_.dimension))
      throw Violation{text_of("region", static_cast<std::size_t>(here[s])) +
                      ": its vertices are not in cyclic order"};
  }
}

void DiagramChecker::check_vertices() const {
  for (std::size_t v = 0; v < vertex_of_.size(); ++v)
    for (std::size_t j = 0; j < d_; ++j)
      if (data_.vertices[v * d_ + j] != diagram_->vertex(static_cast<std::size_t>(vertex_of_[v]))[j])
        throw Violation{text_of("vertex", v) + ": coordinate " + std::to_string(j) +
                        " is not the double nearest to that of the exact centre"};
}

void DiagramChecker::check_ridges() const {
  const Diagram& diagram = *diagram_;
  std::map<std::pair<SignedIndex, SignedIndex>, std::size_t> ridges;  // by regions
  const auto regions_of = [&](std::span<const SignedIndex> rows, std::size_t i) {
    return std::pair{region_of_row(rows[2 * i]), region_of_row(rows[2 * i + 1])};
  };
  for (std::size_t i = 0; i < diagram.num_ridges(); ++i)
    ridges.emplace(regions_of(diagram.ridge_points(), i), i);
  for (std::size_t i = 0; i < data_.num_ridges(); ++i) {
    auto [r, s] = regions_of(data_.ridge_points, i);
    auto vertices = translated(ridge(i));
    // About the direction from the first site to the second.
    const bool is_reversed = r > s;
    if (is_reversed) std::swap(r, s);
    const auto found = ridges.find({r, s});
    if (found == ridges.end())
      throw Violation{text_of("ridge", i) +
                      ": its points have no common ridge, or another one is theirs, too"};
    const auto items = diagram.ridge(found->second);
    std::vector<SignedIndex> expected(items.begin(), items.end());
    ridges.erase(found);
    if (is_reversed) std::reverse(expected.begin(), expected.end());
    if (data_.affine_dimension == 3) {
      if (!same_cycle(vertices, expected, data_.dimension > 3))
        throw Violation{text_of("ridge", i) + ": these are not its vertices in cyclic order"};
      continue;
    }
    std::sort(vertices.begin(), vertices.end());
    std::sort(expected.begin(), expected.end());
    if (vertices != expected) throw Violation{text_of("ridge", i) + ": these are not its vertices"};
  }
  if (ridges.empty()) return;
  const auto missing = ridges.begin()->second;
  throw Violation{"there is no ridge of points " + std::to_string(diagram.ridge_points()[2 * missing]) +
                  " and " + std::to_string(diagram.ridge_points()[2 * missing + 1])};
}

/// The vertex and all its sites in the flat of k of them; nothing if the rows are not k independent sites of
/// the vertex.
std::optional<DiagramChecker::RayKey> DiagramChecker::key_of_ray(SignedIndex vertex,
                                                                 std::span<const SignedIndex> rows) const {
  const Sites& sites = sites_of_[static_cast<std::size_t>(vertex)];
  RayKey key{vertex, {}};
  std::vector<double> points;
  for (const SignedIndex row : rows) {
    const SignedIndex r = region_of_row(row);
    if (r < 0 || !std::binary_search(sites.begin(), sites.end(), r)) return {};
    const auto site = diagram_->site(static_cast<std::size_t>(r));
    points.insert(points.end(), site.begin(), site.end());
    key.second.push_back(r);
  }
  std::sort(key.second.begin(), key.second.end());
  if (std::adjacent_find(key.second.begin(), key.second.end()) != key.second.end()) return {};
  if (sites.size() == k() + 1) return key;
  const int dimension = affine_dimension(points, data_.dimension);
  if (dimension != static_cast<int>(k()) - 1) return {};
  key.second.clear();
  for (const SignedIndex r : sites) {
    const auto site = diagram_->site(static_cast<std::size_t>(r));
    points.resize(k() * d_);
    points.insert(points.end(), site.begin(), site.end());
    if (affine_dimension(points, data_.dimension) == dimension) key.second.push_back(r);
  }
  return key;
}

void DiagramChecker::check_rays() const {
  const Diagram& diagram = *diagram_;
  std::map<RayKey, std::size_t> rays;
  const auto points_of = [&](std::span<const SignedIndex> rows, std::size_t i) {
    return rows.subspan(i * k(), k());
  };
  for (std::size_t i = 0; i < diagram.num_rays(); ++i)
    if (const auto key = key_of_ray(diagram.ray_vertices()[i], points_of(diagram.ray_points(), i)))
      rays.emplace(*key, i);
  for (std::size_t i = 0; i < data_.num_rays(); ++i) {
    const SignedIndex vertex = vertex_of_[static_cast<std::size_t>(data_.ray_vertices[i])];
    const auto key = key_of_ray(vertex, points_of(data_.ray_points, i));
    const auto found = key ? rays.find(*key) : rays.end();
    if (found == rays.end())
      throw Violation{
          text_of("ray", i) +
          ": no unbounded edge from its vertex is equally far from its points, or another ray is that edge"};
    for (std::size_t j = 0; j < d_; ++j)
      if (!(std::abs(data_.ray_directions[i * d_ + j] - diagram.ray_directions()[found->second * d_ + j]) <=
            0x1p-30))
        throw Violation{text_of("ray", i) + (is_furthest()
                                                 ? ": not the inward direction across its points"
                                                 : ": not the outward direction across its points")};
    rays.erase(found);
  }
  if (rays.empty()) return;
  throw Violation{"there is no ray from the vertex of regions " +
                  text_of(sites_of_[static_cast<std::size_t>(rays.begin()->first.first)]) +
                  " across its sites " + text_of(rays.begin()->first.second)};
}

}  // namespace

CheckReport check(const VoronoiData& data, const CheckOptions& options, const Execution& how) {
  const ArithmeticScope arithmetic;
  const internal::ProgressMeter meter(how.progress);
  return DiagramChecker(data).check(options, how.threads);
}

}  // namespace delone
