// SPDX-License-Identifier: BSD-3-Clause
#include "hull/tolerance/tolerant_hull.hpp"

#include "base/progress_meter.hpp"
#include "hull/growing_flat.hpp"
#include "hull/hull_analysis.hpp"
#include "hull/scaled_sites.hpp"
#include "hull/site_normals.hpp"
#include "hull/tolerance/vertex_choice.hpp"

#include <algorithm>
#include <functional>
#include <span>
#include <utility>
#include <vector>

namespace delone::hull {

namespace {

/// Sites that span the hull well come first: the boundary begins with their simplex, and rays from a point
/// inside it are what queries are located by. A simplex of vertices of one rounded face would have no double
/// inside.
std::vector<Index> well_spread_first(const BoundarySites& sites, std::vector<Index> vertices,
                                     std::size_t dimension) {
  std::vector<const double*> points;
  for (const Index site : vertices) points.push_back(sites.point(site));
  GrowingFlat flat(points, sites.ambient);
  for (std::size_t k = 0; k < dimension; ++k) flat.grow();
  std::size_t done = 0;
  for (const double* point : flat.basis()) {
    const auto rest = vertices.begin() + static_cast<std::ptrdiff_t>(done);
    const auto at = std::find_if(rest, vertices.end(), [&](Index v) { return sites.point(v) == point; });
    if (at == vertices.end()) continue;
    std::iter_swap(rest, at);
    ++done;
  }
  return vertices;
}

/// For each site the sum of the normals of its cells, where axes are scaled. Computed when first asked for.
class OutwardDirections {
 public:
  OutwardDirections(const HullState& exact, const internal::AxisScale& scale)
      : exact_(exact), scale_(scale) {}

  std::span<const double> operator()(Index site) {
    if (!is_known_) compute();
    const auto d = static_cast<std::size_t>(exact_.sites().ambient);
    return sums_.empty() ? std::span<const double>() : std::span(sums_).subspan(site * d, d);
  }

 private:
  /// Products with scaled points are those of the normals divided by the factors.
  void compute() {
    is_known_ = true;
    sums_ = sums_of_normals(exact_);
    const std::span<const double> factors = scale_.factors();
    for (std::size_t i = 0; i < sums_.size() && !factors.empty(); ++i)
      sums_[i] /= factors[i % factors.size()];
  }

  const HullState& exact_;
  const internal::AxisScale& scale_;
  bool is_known_ = false;
  std::vector<double> sums_;
};

}  // namespace

TolerantHull::TolerantHull(const HullState& exact, const internal::AxisScale& scale, const Options& options,
                           bool shows_progress)
    : exact_(exact) {
  const int k = exact.affine_hull().dimension();
  if (k < 1) return;
  const std::function<bool(double)> nobody;
  internal::ProgressMeter meter(shows_progress ? options.progress : nobody, 0);
  const std::function<void()> alive = [&] { meter(0); };
  const HullAnalysis analysis(exact);
  const ScaledSites scaled(exact.sites(), scale);
  const BoundarySites& sites = scaled.get();
  const ExtremeSites extreme(sites, analysis.facet_sites());
  VertexChoice choice;
  std::vector<int> axes = sites.axes;
  if (auto in_flat = choose_in_flat(sites, extreme, k, scale.tolerance(), alive)) {
    choice = std::move(in_flat->vertices);
    axes = std::move(in_flat->axes);
  } else {
    choice = choose_vertices(sites, extreme, scale.tolerance(), alive, OutwardDirections(exact, scale));
    // The cells of the exact hull may have corners in the middle of its faces.
    std::vector<char> is_corner(sites.size(), 0);
    for (const Index site : exact.hull().cells) is_corner[site] = 1;
    if (std::ssize(choice.sites) == std::count(is_corner.begin(), is_corner.end(), 1)) return;
  }
  max_distance_ = choice.max_distance;
  Options quiet;
  quiet.seed = options.seed;
  const auto vertices = well_spread_first(sites, std::move(choice.sites), axes.size());
  own_ = std::make_unique<const HullState>(exact, vertices, std::move(axes), quiet);
}

}  // namespace delone::hull
