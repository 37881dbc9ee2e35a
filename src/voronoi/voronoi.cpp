// SPDX-License-Identifier: BSD-3-Clause
// Diagram: built by VoronoiBuilder; volumes and clipping.
#include <delone/arithmetic.hpp>
#include <delone/voronoi.hpp>

#include "base/compensated_sum.hpp"
#include "base/guarded.hpp"
#include "base/infinity.hpp"
#include "base/length.hpp"
#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "base/require_tolerance.hpp"
#include "base/spread.hpp"
#include "solve/simple_polytope.hpp"
#include "voronoi/clipped_regions.hpp"
#include "voronoi/diagram_simplifier.hpp"
#include "voronoi/region_clipper.hpp"
#include "voronoi/region_volumes.hpp"
#include "voronoi/ridge_volumes.hpp"
#include "voronoi/voronoi_builder.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <new>

namespace delone {
namespace {

using internal::infinity;

DataKind kind_of_dual(TriangulationKind kind) {
  switch (kind) {
    case TriangulationKind::delaunay:
      return DataKind::voronoi;
    case TriangulationKind::regular:
      return DataKind::power_diagram;
    case TriangulationKind::furthest_site:
      break;
  }
  return DataKind::furthest_voronoi;
}

constexpr std::size_t ridges_in_part = 2048;

double distance(const double* p, const double* q, std::size_t d) {
  return internal::length_of(d, [&](std::size_t j) { return q[j] - p[j]; });
}

/// The area of the triangle o, p, q in R^d: half of base times height, the height by orthogonalisation.
double triangle_area(const double* o, const double* p, const double* q, std::size_t d) {
  const double base = distance(o, p, d);
  if (!(base > 0) || !std::isfinite(base)) return base;
  double along = 0;
  for (std::size_t j = 0; j < d; ++j) along += (p[j] - o[j]) / base * (q[j] - o[j]);
  const double height =
      internal::length_of(d, [&](std::size_t j) { return (q[j] - o[j]) - along * ((p[j] - o[j]) / base); });
  return base / 2 * height;
}

/// The regions that share a ridge with each region.
struct Neighbors {
  std::vector<std::size_t> offsets, others;

  explicit Neighbors(const Diagram& diagram) {
    const auto region = [&](std::size_t i) {
      return static_cast<std::size_t>(
          diagram.point_region()[static_cast<std::size_t>(diagram.ridge_points()[i])]);
    };
    internal::spread(diagram.num_regions(), offsets, others, [&](const auto& put) {
      for (std::size_t i = 0; i < diagram.ridge_points().size(); ++i) put(region(i), region(i ^ 1));
    });
  }
};

/// Clips the regions of a diagram.
class DiagramClipper {
 public:
  DiagramClipper(const Diagram& diagram, const Neighbors& neighbors, const Box& box,
                 std::span<const double> halfspaces = {})
      : diagram_(diagram),
        neighbors_(neighbors),
        clipper_(box, diagram.kind() == DataKind::furthest_voronoi, halfspaces) {}

  /// Whether a region may have interior points: the others of a diagram have a ridge. Ties of a power diagram
  /// can leave a region that is flat or a single point.
  bool may_have_interior(std::size_t region) const {
    return diagram_.num_regions() == 1 || neighbors_.offsets[region] < neighbors_.offsets[region + 1];
  }

  /// REQUIRES may_have_interior().
  voronoi::RegionClipper& clip(std::size_t region) {
    others_.clear();
    for (std::size_t i = neighbors_.offsets[region]; i < neighbors_.offsets[region + 1]; ++i)
      others_.push_back(site(neighbors_.others[i]));
    clipper_.clip(site(region), others_);
    return clipper_;
  }

 private:
  voronoi::RegionClipper::Site site(std::size_t r) const {
    return {diagram_.site(r).data(), diagram_.weight(r)};
  }

  const Diagram& diagram_;
  const Neighbors& neighbors_;
  voronoi::RegionClipper clipper_;
  std::vector<voronoi::RegionClipper::Site> others_;
};

}  // namespace

Diagram::Diagram(const Triangulation& triangulation, const std::function<double(VertexId)>& weight,
                 const DiagramOptions& options, const Execution& how)
    : dimension_(triangulation.dimension()),
      affine_dimension_(triangulation.affine_dimension()),
      kind_(kind_of_dual(triangulation.kind())) {
  const internal::ProgressMeter meter(how.progress);
  internal::guarded("the diagram", [&] {
    const internal::AxisScale scale(options.tolerance, options.axis_tolerances, dimension_);
    tolerance_ = scale.tolerance();
    axis_tolerances_ = scale.tolerances();
    has_ridges_ = options.parts == DiagramParts::all || tolerance_ > 0;
    voronoi::VoronoiBuilder(triangulation, weight, how.threads, *this).run();
    if (tolerance_ > 0) simplify();
  });
  if (options.parts == DiagramParts::all || !has_ridges_) return;
  has_ridges_ = false;
  ridge_points_ = ridge_vertices_ = {};
  ridge_offsets_ = {0};
  cell_regions_ = cell_vertex_ = {};
  ridge_of_exact_ = {};
  exact_ = nullptr;
}

/// Replaces the exact diagram by the simplified one, and keeps it for volumes and clipping.
void Diagram::simplify() {
  if (num_regions() < 2) return;
  const internal::AxisScale scale(tolerance_, axis_tolerances_, dimension_);
  internal::require_tolerance_within(tolerance_, sites_, ambient(), {}, scale.factors());
  const std::shared_ptr<Diagram> exact(new Diagram(std::move(*this)),
                                       [](Diagram* diagram) { delete diagram; });
  sites_ = exact->sites_;
  weights_ = exact->weights_;
  hidden_ = exact->hidden_;
  region_points_ = exact->region_points_;
  point_region_ = exact->point_region_;
  bounded_ = exact->bounded_;
  axis_tolerances_ = exact->axis_tolerances_;
  // Moved from: all other arrays are empty.
  if (voronoi::DiagramSimplifier(*exact, scale).run(*this))
    exact_ = exact;
  else
    *this = std::move(*exact);
}

Diagram::Diagram(detail::Clone, const Diagram& other) try : Diagram(other) {
} catch (const std::bad_alloc&) {
  throw Error(Errc::out_of_memory, "not enough memory for the diagram");
}

std::size_t Diagram::num_unbounded_regions() const {
  return static_cast<std::size_t>(std::count(bounded_.begin(), bounded_.end(), 0));
}

/// The distance of a site from its bisector with another; negative if the site is on the other's side.
double Diagram::bisector_distance(std::size_t from, std::size_t to) const {
  const double length = distance(site(from).data(), site(to).data(), ambient());
  return length / 2 - (weight(to) - weight(from)) / length / 2;
}

double Diagram::ridge_volume(std::size_t i, const std::vector<std::vector<Index>>& cells_of_region) const {
  const auto corners = ridge(i);
  if (affine_dimension_ == 1) return 1;
  if (corners.front() < 0) return infinity;
  const auto at = [&](std::size_t corner) {
    return vertex(static_cast<std::size_t>(corners[corner])).data();
  };
  if (affine_dimension_ == 2) return distance(at(0), at(1), ambient());
  if (affine_dimension_ == 3) {
    double area = 0;
    for (std::size_t c = 1; c + 1 < corners.size(); ++c)
      area += triangle_area(at(0), at(c), at(c + 1), ambient());
    return area;
  }
  // The dual face of an edge of the triangulation: one corner for each cell around the edge, on a facet for
  // each further site.
  const auto [a, b] = voronoi::regions_of_ridge(ridge_points_, point_region_, i);
  const std::size_t k = static_cast<std::size_t>(affine_dimension_);
  std::vector<Index> star;
  std::set_intersection(cells_of_region[a].begin(), cells_of_region[a].end(), cells_of_region[b].begin(),
                        cells_of_region[b].end(), std::back_inserter(star));
  solve::SimplePolytope polytope;
  polytope.start(k - 1, ambient());
  std::vector<std::size_t> labels;
  for (const Index cell : star) {
    labels.clear();
    for (std::size_t j = 0; j <= k; ++j) {
      const auto region = static_cast<std::size_t>(cell_regions_[cell * (k + 1) + j]);
      if (region != a && region != b) labels.push_back(region);
    }
    polytope.add_corner(vertex(static_cast<std::size_t>(cell_vertex_[cell])).data(), labels);
  }
  return polytope.volume();
}

std::vector<std::vector<Index>> Diagram::cells_of_regions() const {
  std::vector<std::vector<Index>> cells(num_regions());
  const std::size_t corners = static_cast<std::size_t>(affine_dimension_ + 1);
  for (std::size_t i = 0; i < cell_regions_.size(); ++i)
    cells[static_cast<std::size_t>(cell_regions_[i])].push_back(static_cast<Index>(i / corners));
  return cells;
}

std::vector<double> Diagram::ridge_volumes(const Execution& how) const {
  require_ridges();
  if (exact_ != nullptr) {
    const std::vector<double> exact = exact_->ridge_volumes(how);
    return internal::guarded("the diagram", [&] {
      std::vector<double> volumes;
      for (const Index ridge : ridge_of_exact_) volumes.push_back(exact[ridge]);
      return volumes;
    });
  }
  return internal::guarded("the diagram", [&] {
    const internal::ProgressMeter meter(how.progress);
    const auto cells = cells_of_regions();
    std::vector<double> volumes = voronoi::measure_ridges(
        {static_cast<std::size_t>(affine_dimension_), ambient(), sites_, vertices_, cell_regions_,
         cell_vertex_, cells, ridge_points_, point_region_, ridge_vertices_, ridge_offsets_},
        std::vector<unsigned char>(num_regions(), 1));
    internal::for_parts(how.threads, volumes.size(), ridges_in_part,
                        [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                          for (std::size_t i = first; i < last; ++i) {
                            stop();
                            if (std::isnan(volumes[i])) volumes[i] = ridge_volume(i, cells);
                          }
                        });
    return volumes;
  });
}

/// Volumes of the regions for which `wanted` holds, which are bounded; 0 for the others. Where they are not
/// sums of pieces, the terms are added up in the order of the ridges, whatever the number of threads.
std::vector<double> Diagram::volumes_of(const std::vector<unsigned char>& wanted, unsigned threads) const {
  const auto k = static_cast<std::size_t>(affine_dimension_);
  if (kind_ != DataKind::furthest_voronoi && k >= 1 && k <= voronoi::most_dimension_of_pieces)
    return voronoi::measure_regions(
        {k, ambient(), sites_,
         kind_ == DataKind::power_diagram ? std::span<const double>(weights_) : std::span<const double>(),
         cell_regions_},
        wanted, threads);
  const auto cells = cells_of_regions();
  const auto region = [&](std::size_t i) {
    return static_cast<std::size_t>(point_region_[static_cast<std::size_t>(ridge_points_[i])]);
  };
  std::vector<internal::CompensatedSum> sums(num_regions());
  const std::vector<double> of_ridges = voronoi::measure_ridges(
      {static_cast<std::size_t>(affine_dimension_), ambient(), sites_, vertices_, cell_regions_, cell_vertex_,
       cells, ridge_points_, point_region_, ridge_vertices_, ridge_offsets_},
      wanted);
  constexpr std::size_t block = std::size_t{1} << 16;
  std::vector<double> terms(2 * std::min(block, num_ridges()));
  for (std::size_t begin = 0; begin < num_ridges(); begin += block) {
    const std::size_t count = std::min(block, num_ridges() - begin);
    const auto find_terms = [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
      for (std::size_t i = first; i < last; ++i) {
        stop();
        const std::size_t a = region(2 * (begin + i)), b = region(2 * (begin + i) + 1);
        if (!wanted[a] && !wanted[b]) continue;
        const double known = of_ridges[begin + i];
        const double volume =
            (std::isnan(known) ? ridge_volume(begin + i, cells) : known) / affine_dimension_;
        if (wanted[a]) terms[2 * i] = volume * bisector_distance(a, b);
        if (wanted[b]) terms[2 * i + 1] = volume * bisector_distance(b, a);
      }
    };
    internal::for_parts(threads, count, ridges_in_part, find_terms);
    for (std::size_t i = 0; i < 2 * count; ++i)
      if (const std::size_t r = region(2 * begin + i); wanted[r]) sums[r].add(terms[i]);
  }
  std::vector<double> volumes(num_regions(), 0.0);
  for (std::size_t r = 0; r < volumes.size(); ++r)
    if (wanted[r]) volumes[r] = std::isnan(sums[r].value()) ? infinity : std::max(sums[r].value(), 0.0);
  return volumes;
}

std::vector<double> Diagram::region_volumes(const Execution& how) const {
  require_ridges();
  if (exact_ != nullptr) return exact_->region_volumes(how);
  return internal::guarded("the diagram", [&] {
    const internal::ProgressMeter meter(how.progress);
    std::vector<double> volumes = volumes_of(bounded_, how.threads);
    for (std::size_t r = 0; r < volumes.size(); ++r)
      if (!bounded_[r]) volumes[r] = infinity;
    return volumes;
  });
}

VoronoiData Diagram::to_data() const {
  require_ridges();
  return internal::guarded("the diagram", [&] {
    VoronoiData data{dimension_,
                     affine_dimension_,
                     {},
                     {},
                     vertices_,
                     ridge_points_,
                     ridge_vertices_,
                     region_vertices_,
                     point_region_,
                     ridge_offsets_,
                     region_offsets_,
                     ray_vertices_,
                     ray_points_,
                     ray_directions_,
                     tolerance_,
                     axis_tolerances_,
                     {},
                     kind_};
    const double* hidden = hidden_.data();
    for (const SignedIndex region : point_region_) {
      const double* point = region < 0 ? hidden : site(static_cast<std::size_t>(region)).data();
      data.points.insert(data.points.end(), point, point + ambient());
      if (kind_ == DataKind::power_diagram)
        data.weights.push_back(region < 0 ? hidden[ambient()] : weight(static_cast<std::size_t>(region)));
      if (region < 0) hidden += ambient() + 1;
    }
    return data;
  });
}

void Diagram::require_ridges() const {
  if (!has_ridges_) throw Error(Errc::invalid_argument, "the diagram was made without ridges");
}

void Diagram::check_box(const Box& box) const {
  require_ridges();
  voronoi::require_container(box, {}, dimension_);
}

bool Diagram::is_inside(std::size_t r, const Box& box) const {
  if (!bounded_[r] || affine_dimension_ != dimension_) return false;
  for (const SignedIndex v : region(r))
    for (std::size_t j = 0; j < ambient(); ++j) {
      const double x = vertex(static_cast<std::size_t>(v))[j];
      if (!(x >= box.low[j] && x <= box.high[j])) return false;
    }
  return true;
}

std::vector<double> Diagram::region_volumes(const Box& box, const Execution& how) const {
  const ArithmeticScope arithmetic;
  check_box(box);
  if (exact_ != nullptr) return exact_->region_volumes(box, how);
  return internal::guarded("the diagram", [&] {
    const internal::ProgressMeter meter(how.progress);
    std::vector<unsigned char> inside(num_regions());
    for (std::size_t r = 0; r < num_regions(); ++r) inside[r] = is_inside(r, box) ? 1 : 0;
    std::vector<double> volumes = volumes_of(inside, how.threads);
    const Neighbors neighbors(*this);
    constexpr std::size_t regions_in_part = 64;
    internal::work_in_parts(how.threads, num_regions(), regions_in_part, [&] {
      return [&, clipper = DiagramClipper(*this, neighbors, box)](std::size_t first, std::size_t last,
                                                                  const internal::StopPoint& stop) mutable {
        for (std::size_t r = first; r < last; ++r) {
          if (inside[r]) continue;
          stop();
          volumes[r] = clipper.may_have_interior(r) ? clipper.clip(r).volume() : 0;
        }
      };
    });
    return volumes;
  });
}

void Diagram::for_each_clipped_region(const Box& box,
                                      const std::function<void(std::size_t, const ClippedRegion&)>& visit,
                                      const Execution& how) const {
  const ArithmeticScope arithmetic;
  check_box(box);
  if (dimension_ > 3)
    throw Error(Errc::unsupported, "the geometry of clipped regions is available up to dimension 3");
  const Diagram& exact = exact_ != nullptr ? *exact_ : *this;
  const Neighbors neighbors(exact);
  DiagramClipper clipper(exact, neighbors, box);
  internal::ProgressMeter meter(how.progress, num_regions());
  for (std::size_t r = 0; r < num_regions(); ++r) {
    meter(r);
    visit(r, clipper.may_have_interior(r) ? clipper.clip(r).geometry() : ClippedRegion{});
  }
}

ClippedRegions Diagram::clipped_regions(const Box& box, std::span<const double> halfspaces,
                                        const Execution& how) const {
  const ArithmeticScope arithmetic;
  check_box(box);
  if (dimension_ != 2 && dimension_ != 3)
    throw Error(Errc::unsupported, "clipped regions as arrays are available in dimensions 2 and 3");
  voronoi::require_container(box, halfspaces, dimension_);
  return internal::guarded("the clipped regions", [&] {
    const Diagram& exact = exact_ != nullptr ? *exact_ : *this;
    const Neighbors neighbors(exact);
    DiagramClipper clipper(exact, neighbors, box, halfspaces);
    voronoi::RegionCollector regions(ambient());
    internal::ProgressMeter meter(how.progress, num_regions());
    for (std::size_t r = 0; r < num_regions(); ++r) {
      meter(r);
      if (clipper.may_have_interior(r))
        regions.add(r, clipper.clip(r), std::span(neighbors.others).subspan(neighbors.offsets[r]));
      else
        regions.add_empty();
    }
    return std::move(regions).finish();
  });
}

Box Diagram::bounding_box(double margin) const {
  const ArithmeticScope arithmetic;
  if (!(margin >= 0) || !std::isfinite(margin))
    throw Error(Errc::invalid_argument, "the margin must be a number of at least 0");
  Box box{std::vector<double>(ambient(), 0.0), std::vector<double>(ambient(), 0.0)};
  double longest = 0;
  for (std::size_t j = 0; j < ambient(); ++j)
    for (std::size_t r = 0; r < num_regions(); ++r) {
      const double x = site(r)[j];
      box.low[j] = r == 0 ? x : std::min(box.low[j], x);
      box.high[j] = r == 0 ? x : std::max(box.high[j], x);
      longest = std::max(longest, box.high[j] - box.low[j]);
    }
  const double added = longest > 0 ? margin * longest : 1;
  constexpr double largest = std::numeric_limits<double>::max() / 4;
  for (std::size_t j = 0; j < ambient(); ++j) {
    box.low[j] = std::max(std::min(box.low[j] - added, std::nextafter(box.low[j], -largest)), -largest * 4);
    box.high[j] = std::min(std::max(box.high[j] + added, std::nextafter(box.high[j], largest)), largest * 4);
  }
  return box;
}

}  // namespace delone
