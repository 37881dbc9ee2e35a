// SPDX-License-Identifier: BSD-3-Clause
// A picture of a triangulation in the plane: the larger side of the bounding box takes 1000 units, y points
// up.
#include "io/atomic_file.hpp"
#include "io/complexes/write_complex.hpp"
#include "io/file.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace delone::io {

namespace {

constexpr double side = 1000, margin = 20;
constexpr std::size_t most_circles = 20000;

/// Maps points into the picture. Works on halved coordinates, whose differences cannot overflow.
class Frame {
 public:
  explicit Frame(const ComplexData& data) : data_(data) {
    for (std::size_t axis = 0; axis < 2; ++axis) {
      double low = 0, high = 0;
      for (std::size_t row = 0; row < data.num_points(); ++row) {
        const double half = data.points[2 * row + axis] / 2;
        low = row == 0 ? half : std::min(low, half);
        high = row == 0 ? half : std::max(high, half);
      }
      low_[axis] = low;
      extent_[axis] = high - low;
    }
    largest_ = std::max(extent_[0], extent_[1]);
  }

  double width() const { return 2 * margin + side * ratio(0); }
  double height() const { return 2 * margin + side * ratio(1); }
  std::array<double, 2> place(std::size_t row) const {
    return {margin + along(row, 0), height() - margin - along(row, 1)};
  }

 private:
  double ratio(std::size_t axis) const { return largest_ > 0 ? extent_[axis] / largest_ : 0; }
  double along(std::size_t row, std::size_t axis) const {
    return largest_ > 0 ? side * ((data_.points[2 * row + axis] / 2 - low_[axis]) / largest_) : 0;
  }

  const ComplexData& data_;
  std::array<double, 2> low_{}, extent_{};
  double largest_ = 0;
};

}  // namespace

void write_svg(AtomicFile& file, const ComplexData& data) {
  if (data.dimension != 2)
    fail(Errc::unsupported, "{}: an .svg file is a picture of the plane, these points have dimension {}",
         file.name(), data.dimension);
  const Frame frame(data);
  const std::size_t n = data.num_points();
  // Lines get thinner as edges get shorter, which is as 1/sqrt(n).
  const double stroke = std::clamp(20 / std::sqrt(static_cast<double>(n) + 1), 0.1, 1.5);
  file.print(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0:.2f} {1:.2f}\" width=\"{0:.2f}\" "
      "height=\"{1:.2f}\">\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      frame.width(), frame.height());
  if (data.affine_dimension >= 1) {
    const auto corners = static_cast<std::size_t>(data.affine_dimension) + 1;
    file.print("<path fill=\"{}\" stroke=\"#1f4e79\" stroke-width=\"{:.2f}\" stroke-linejoin=\"round\" d=\"",
               corners == 3 ? "#dce9f5" : "none", stroke);
    for (std::size_t i = 0; i < data.cells.size(); ++i) {
      const auto [x, y] = frame.place(static_cast<std::size_t>(data.cells[i]));
      file.print("{}{:.2f},{:.2f}", i % corners == 0 ? 'M' : 'L', x, y);
      if ((i + 1) % corners == 0) file.write(corners == 3 ? "Z\n" : "\n");
    }
    file.write("\"/>\n");
  }
  if (n <= most_circles || data.affine_dimension == 0) {
    file.write("<g fill=\"#c0392b\">\n");
    const std::size_t circles = data.affine_dimension == 0 ? std::min<std::size_t>(n, 1) : n;
    for (std::size_t row = 0; row < circles; ++row) {
      const auto [x, y] = frame.place(row);
      file.print("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"/>\n", x, y, std::max(2 * stroke, 0.3));
    }
    file.write("</g>\n");
  }
  file.write("</svg>\n");
}

}  // namespace delone::io
