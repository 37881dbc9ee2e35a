// SPDX-License-Identifier: BSD-3-Clause
#include "voronoi/ridge_volumes.hpp"

#include "voronoi/face_volumes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>

namespace delone::voronoi {
namespace {

/// So many faces, about, are measured at a time.
constexpr std::size_t most_faces = std::size_t{1} << 25;
/// Volumes at most this, in units of the extent of the sites, may have lost digits to underflow.
constexpr double least_volume = 1e-120;

/// A ridge, which is measured with the cells of region a.
struct SoughtRidge {
  std::size_t ridge;
  Index a, b;
};

std::vector<SoughtRidge> sought_ridges(const DiagramParts& diagram,
                                       const std::vector<unsigned char>& wanted) {
  std::vector<SoughtRidge> sought;
  for (std::size_t i = 0; i + 1 < diagram.ridge_offsets.size(); ++i) {
    auto [a, b] = regions_of_ridge(diagram.ridge_points, diagram.point_region, i);
    if (diagram.ridge_vertices[static_cast<std::size_t>(diagram.ridge_offsets[i])] < 0) continue;
    if (!wanted[a] && !wanted[b]) continue;
    if (!wanted[a]) std::swap(a, b);
    sought.push_back({i, static_cast<Index>(a), static_cast<Index>(b)});
  }
  std::sort(sought.begin(), sought.end(), [](const SoughtRidge& x, const SoughtRidge& y) {
    return std::pair(x.a, x.b) < std::pair(y.a, y.b);
  });
  return sought;
}

/// The exponent of a power of two near the extent of the sites.
int exponent_of_extent(const DiagramParts& diagram) {
  double largest = 0;
  for (std::size_t i = diagram.d; i < diagram.sites.size(); ++i)
    largest = std::max(largest, std::abs(diagram.sites[i] / 2 - diagram.sites[i % diagram.d] / 2));
  return largest > 0 ? std::clamp(std::ilogb(largest) + 1, -1000, 1000) : 0;
}

}  // namespace

std::vector<double> measure_ridges(const DiagramParts& diagram,
                                   const std::vector<unsigned char>& wanted_regions) {
  std::vector<double> volumes(diagram.ridge_offsets.size() - 1, std::numeric_limits<double>::quiet_NaN());
  if (diagram.k < 4) return volumes;
  const std::vector<SoughtRidge> ridges = sought_ridges(diagram, wanted_regions);
  if (ridges.empty()) return volumes;
  const std::size_t k = diagram.k, d = diagram.d;
  const double scale = std::ldexp(1.0, -exponent_of_extent(diagram));
  std::vector<double> points(diagram.sites.begin(), diagram.sites.end());
  for (double& x : points) x *= scale;
  FaceVolumes faces(k, d);
  faces.set_points(points);

  const std::size_t num_regions = diagram.sites.size() / d, num_cells = diagram.cell_vertex.size();
  const std::size_t most_cells = most_faces >> std::min<std::size_t>(k, 20);
  std::vector<unsigned char> wanted(num_regions), is_taken(num_cells);
  std::vector<Index> labels(k + 1), cells;
  std::vector<double> x(d);
  for (std::size_t begin = 0, end = 0; begin < ridges.size(); begin = end) {
    std::fill(wanted.begin(), wanted.end(), 0);
    cells.clear();
    while (end < ridges.size()) {
      const Index a = ridges[end].a;
      const auto& more = diagram.cells_of_region[a];
      if (end > begin && cells.size() + more.size() > most_cells) break;
      wanted[a] = 1;
      for (const Index cell : more)
        if (is_taken[cell] == 0) {
          is_taken[cell] = 1;
          cells.push_back(cell);
        }
      while (end < ridges.size() && ridges[end].a == a) ++end;
    }
    faces.clear();
    for (const Index cell : cells) {
      is_taken[cell] = 0;
      for (std::size_t i = 0; i <= k; ++i)
        labels[i] = static_cast<Index>(diagram.cell_regions[cell * (k + 1) + i]);
      std::sort(labels.begin(), labels.end());
      const double* from = diagram.vertices.data() + static_cast<std::size_t>(diagram.cell_vertex[cell]) * d;
      double largest = 0;
      for (std::size_t j = 0; j < d; ++j) {
        x[j] = from[j] * scale;
        largest = std::max(largest, std::abs(x[j]));
      }
      faces.add_corner(x, 0x1p-53 * largest, labels);
    }
    faces.measure(2, wanted, [&](const FaceVolumes::Face& face) {
      const auto find = [&](Index a, Index b) {
        const auto first = ridges.begin() + static_cast<std::ptrdiff_t>(begin);
        const auto last = ridges.begin() + static_cast<std::ptrdiff_t>(end);
        const auto found =
            std::lower_bound(first, last, std::pair(a, b),
                             [](const SoughtRidge& r, const auto& key) { return std::pair(r.a, r.b) < key; });
        if (found == last || found->a != a || found->b != b) return;
        if (!face.is_accurate || !(face.volume > least_volume)) return;
        double volume = face.volume;
        for (std::size_t i = 0; i + 1 < k; ++i) volume /= scale;
        volumes[found->ridge] = volume;
      };
      find(face.labels[0], face.labels[1]);
      find(face.labels[1], face.labels[0]);
    });
  }
  return volumes;
}

}  // namespace delone::voronoi
