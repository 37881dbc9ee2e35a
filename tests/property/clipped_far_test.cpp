// SPDX-License-Identifier: BSD-3-Clause
// Cells in boxes that are thin, seen from the sites: their volumes add up to that of the box.
#include <delone/delaunay.hpp>
#include <delone/point_sets.hpp>
#include <delone/site_cells.hpp>
#include <delone/voronoi.hpp>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <vector>

namespace delone {
namespace {

TEST(ClippedFar, VolumesAddUpToThoseOfThinBoxes) {
  for (int d = 2; d <= 4; ++d)
    for (const char* kind : {"uniform", "grid", "nudged_grid"})
      for (const double thickness : {0x1p-10, 1e-9, 1e-12, 1e-14, 0x1p-52}) {
        SCOPED_TRACE(std::string(kind) + " in " + std::to_string(d) + ", " +
                     std::to_string(std::log2(thickness)));
        std::vector<double> points = make_point_set(kind, d, 30, 8);
        for (std::size_t i = static_cast<std::size_t>(d) - 1; i < points.size();
             i += static_cast<std::size_t>(d))
          points[i] = points[i] * 0.7 - 3.3;  // differences from the box are not doubles
        Box box{std::vector<double>(static_cast<std::size_t>(d), 0.1),
                std::vector<double>(static_cast<std::size_t>(d), 0.9)};
        box.low.back() = 1;
        box.high.back() = 1 + thickness;
        double exact = box.high.back() - 1;
        for (int j = 0; j + 1 < d; ++j) exact *= box.high[0] - box.low[0];
        const Delaunay<> t(points, d);
        const SiteCells cells = site_cells(t, {.box = box});
        EXPECT_NEAR(std::accumulate(cells.volumes.begin(), cells.volumes.end(), 0.0), exact, 1e-11 * exact);
        const std::vector<double> regions = Voronoi<>(t).region_volumes(box);
        EXPECT_NEAR(std::accumulate(regions.begin(), regions.end(), 0.0), exact, 1e-11 * exact);
        for (std::size_t i = 0; i < cells.num_rows(); ++i)
          if (cells.volumes[i] > 0) {
            EXPECT_TRUE(std::all_of(cells.centroids.begin() + static_cast<std::ptrdiff_t>(i) * d,
                                    cells.centroids.begin() + static_cast<std::ptrdiff_t>(i + 1) * d,
                                    [](double x) { return std::isfinite(x); }));
          }
      }
}

}  // namespace
}  // namespace delone
