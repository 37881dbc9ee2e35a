// SPDX-License-Identifier: BSD-3-Clause
// What .svg pictures share: the map from the plane to the picture, whose larger side takes 1000 units and
// whose y points up, the opening of the file, and the points.
#pragma once

#include "io/atomic_file.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace delone::io {

class PictureFrame {
 public:
  /// With that many points or regions in the box low … high: the more, the shorter are edges, as 1/sqrt(n),
  /// and the thinner are lines.
  PictureFrame(std::array<double, 2> low, std::array<double, 2> high, std::size_t count)
      : stroke_(std::clamp(20 / std::sqrt(static_cast<double>(count) + 1), 0.1, 1.5)) {
    // Differences of halved coordinates do not overflow.
    for (std::size_t axis = 0; axis < 2; ++axis) {
      half_low_[axis] = low[axis] / 2;
      half_extent_[axis] = high[axis] / 2 - low[axis] / 2;
    }
    largest_ = std::max(half_extent_[0], half_extent_[1]);
  }

  double stroke() const { return stroke_; }
  std::array<double, 2> place(double x, double y) const {
    return {margin + side * ratio(x / 2 - half_low_[0]),
            height() - margin - side * ratio(y / 2 - half_low_[1])};
  }

  /// The root element and a white ground.
  void open(AtomicFile& file) const {
    file.print(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.2f} {1:.2f}\" width=\"{0:.2f}\" "
        "height=\"{1:.2f}\">\n"
        "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
        width(), height());
  }
  /// The start of a path of all edges; its points and "\"/>\n" follow.
  void open_path(AtomicFile& file, const char* fill) const {
    file.print("<path fill=\"{}\" stroke=\"#1f4e79\" stroke-width=\"{:.2f}\" stroke-linejoin=\"round\" d=\"",
               fill, stroke_);
  }
  void put_point(AtomicFile& file, double x, double y) const {
    const auto [left, top] = place(x, y);
    file.print("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"/>\n", left, top, std::max(2 * stroke_, 0.3));
  }

  static constexpr const char* cell_fill = "#dce9f5";
  static constexpr const char* points_group = "<g fill=\"#c0392b\">\n";
  /// With more points than this none is drawn.
  static constexpr std::size_t most_points = 20000;

 private:
  static constexpr double side = 1000, margin = 20;

  double ratio(double half) const { return largest_ > 0 ? half / largest_ : 0; }
  double width() const { return 2 * margin + side * ratio(half_extent_[0]); }
  double height() const { return 2 * margin + side * ratio(half_extent_[1]); }

  double stroke_;
  std::array<double, 2> half_low_{}, half_extent_{};
  double largest_ = 0;
};

}  // namespace delone::io
