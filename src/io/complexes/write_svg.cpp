// SPDX-License-Identifier: BSD-3-Clause
// Pictures of triangulations and of diagrams in the plane.
#include "io/complexes/picture_frame.hpp"
#include "io/complexes/pictures.hpp"
#include "io/file.hpp"

#include <delone/voronoi.hpp>

#include <algorithm>
#include <array>
#include <optional>
#include <span>

namespace delone::io {

namespace {

void require_plane(const AtomicFile& file, int dimension) {
  if (dimension != 2)
    fail(Errc::unsupported, "{}: an .svg file is a picture of the plane, these points have dimension {}",
         file.name(), dimension);
}

}  // namespace

void write_svg(AtomicFile& file, const ComplexData& data) {
  require_plane(file, data.dimension);
  const std::size_t n = data.num_points();
  const std::span points(data.points);
  std::array<double, 2> low{}, high{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    low[i % 2] = i < 2 ? points[i] : std::min(low[i % 2], points[i]);
    high[i % 2] = i < 2 ? points[i] : std::max(high[i % 2], points[i]);
  }
  const PictureFrame frame(low, high, n);
  frame.open(file);
  if (data.affine_dimension >= 1) {
    const auto corners = static_cast<std::size_t>(data.affine_dimension) + 1;
    frame.open_path(file, corners == 3 ? PictureFrame::cell_fill : "none");
    for (std::size_t i = 0; i < data.cells.size(); ++i) {
      const auto row = static_cast<std::size_t>(data.cells[i]);
      const auto [x, y] = frame.place(points[2 * row], points[2 * row + 1]);
      file.print("{}{:.2f},{:.2f}", i % corners == 0 ? 'M' : 'L', x, y);
      if ((i + 1) % corners == 0) file.write(corners == 3 ? "Z\n" : "\n");
    }
    file.write("\"/>\n");
  }
  if (n <= PictureFrame::most_points || data.affine_dimension == 0) {
    file.write(PictureFrame::points_group);
    const std::size_t drawn = data.affine_dimension == 0 ? std::min<std::size_t>(n, 1) : n;
    for (std::size_t row = 0; row < drawn; ++row) frame.put_point(file, points[2 * row], points[2 * row + 1]);
    file.write("</g>\n");
  }
  file.write("</svg>\n");
}

void write_svg(AtomicFile& file, const Diagram& diagram, const Box& box) {
  require_plane(file, diagram.dimension());
  const std::size_t n = diagram.num_regions();
  std::optional<PictureFrame> frame;
  // The box is known to be one of the plane as soon as there is a region of it.
  const auto open = [&] {
    if (frame) return;
    frame.emplace(std::array{box.low[0], box.low[1]}, std::array{box.high[0], box.high[1]}, n);
    frame->open(file);
    frame->open_path(file, PictureFrame::cell_fill);
  };
  diagram.for_each_clipped_region(box, [&](std::size_t, const ClippedRegion& region) {
    open();
    if (region.empty()) return;
    bool is_first = true;
    for (const Index corner : region.faces.front()) {
      const auto [x, y] = frame->place(region.corners[2 * corner], region.corners[2 * corner + 1]);
      file.print("{}{:.2f},{:.2f}", is_first ? 'M' : 'L', x, y);
      is_first = false;
    }
    file.write("Z\n");
  });
  open();
  file.write("\"/>\n");
  if (n <= PictureFrame::most_points) {
    file.write(PictureFrame::points_group);
    for (std::size_t r = 0; r < n; ++r) {
      const auto site = diagram.site(r);
      if (site[0] >= box.low[0] && site[0] <= box.high[0] && site[1] >= box.low[1] && site[1] <= box.high[1])
        frame->put_point(file, site[0], site[1]);
    }
    file.write("</g>\n");
  }
  file.write("</svg>\n");
}

}  // namespace delone::io
