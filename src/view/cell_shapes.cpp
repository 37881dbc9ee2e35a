// SPDX-License-Identifier: BSD-3-Clause
// With the edges e_i from corner 0 as the rows of E, the gradients g_i of the barycentric coordinates of
// corners 1 … k are the columns of its (pseudo-)inverse, and g_0 = −Σ g_i. The height over the facet opposite
// corner i is 1/|g_i|, the inradius 1/Σ|g_i|, and the centre of the sphere is corner 0 plus Σ g_i |e_i|²/2.
#include "view/cell_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>
#include <utility>

namespace delone::view {

namespace {

/// Inverts an n×n matrix, row-major, by Gauss-Jordan elimination with row pivots. False if it is singular.
bool invert(std::vector<double>& a, std::vector<double>& inverse, std::size_t n) {
  inverse.assign(n * n, 0);
  for (std::size_t i = 0; i < n; ++i) inverse[i * n + i] = 1;
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t pivot = c;
    for (std::size_t r = c + 1; r < n; ++r)
      if (std::abs(a[r * n + c]) > std::abs(a[pivot * n + c])) pivot = r;
    if (!(std::abs(a[pivot * n + c]) > 0)) return false;
    for (std::size_t j = 0; j < n && pivot != c; ++j) {
      std::swap(a[pivot * n + j], a[c * n + j]);
      std::swap(inverse[pivot * n + j], inverse[c * n + j]);
    }
    const double factor = 1 / a[c * n + c];
    for (std::size_t j = 0; j < n; ++j) a[c * n + j] *= factor, inverse[c * n + j] *= factor;
    for (std::size_t r = 0; r < n; ++r) {
      const double times = a[r * n + c];
      if (r == c || times == 0) continue;
      for (std::size_t j = 0; j < n; ++j) {
        a[r * n + j] -= times * a[c * n + j];
        inverse[r * n + j] -= times * inverse[c * n + j];
      }
    }
  }
  return true;
}

/// One simplex at a time, in room that is used again.
class Shape {
 public:
  Shape(int dimension, int corners)
      : d_(static_cast<std::size_t>(dimension)), k_(static_cast<std::size_t>(corners) - 1), edges_(k_ * d_) {}

  /// {radius, quality}
  std::pair<double, double> of(std::span<const double> points, std::span<const SignedIndex> cell) {
    constexpr double none = std::numeric_limits<double>::quiet_NaN();
    const double* const origin = points.data() + static_cast<std::size_t>(cell[0]) * d_;
    double scale = 0;  // edges become at most 1: no square overflows
    for (std::size_t i = 0; i < k_; ++i)
      for (std::size_t j = 0; j < d_; ++j) {
        edges_[i * d_ + j] = points[static_cast<std::size_t>(cell[i + 1]) * d_ + j] / 2 - origin[j] / 2;
        scale = std::max(scale, std::abs(edges_[i * d_ + j]));
      }
    if (!(scale > 0)) return {none, none};
    for (double& x : edges_) x /= scale;
    if (!find_gradients()) return {none, none};
    double sum = 0;
    center_.assign(d_, 0), first_.assign(d_, 0);
    for (std::size_t i = 0; i < k_; ++i) {
      double square = 0, length = 0;
      for (std::size_t j = 0; j < d_; ++j) square += edges_[i * d_ + j] * edges_[i * d_ + j];
      for (std::size_t j = 0; j < d_; ++j) {
        const double g = gradients_[j * k_ + i];
        center_[j] += g * square / 2;
        first_[j] -= g;
        length += g * g;
      }
      sum += std::sqrt(length);
    }
    double length = 0, radius = 0;
    for (std::size_t j = 0; j < d_; ++j) length += first_[j] * first_[j], radius += center_[j] * center_[j];
    sum += std::sqrt(length), radius = std::sqrt(radius);
    const double quality = std::min(static_cast<double>(k_) / (sum * radius), 1.0);
    return {2 * scale * radius, quality};
  }

 private:
  /// d×k: column i is the gradient of corner i+1.
  bool find_gradients() {
    if (k_ == d_) {
      work_ = edges_;
      return invert(work_, gradients_, k_);
    }
    // The pseudo-inverse: Eᵀ (E Eᵀ)⁻¹.
    work_.assign(k_ * k_, 0);
    for (std::size_t a = 0; a < k_; ++a)
      for (std::size_t b = 0; b < k_; ++b)
        for (std::size_t j = 0; j < d_; ++j) work_[a * k_ + b] += edges_[a * d_ + j] * edges_[b * d_ + j];
    if (!invert(work_, inverse_, k_)) return false;
    gradients_.assign(d_ * k_, 0);
    for (std::size_t j = 0; j < d_; ++j)
      for (std::size_t i = 0; i < k_; ++i)
        for (std::size_t a = 0; a < k_; ++a)
          gradients_[j * k_ + i] += edges_[a * d_ + j] * inverse_[a * k_ + i];
    return true;
  }

  std::size_t d_, k_;
  std::vector<double> edges_, gradients_, work_, inverse_, center_, first_;
};

}  // namespace

CellShapes cell_shapes(std::span<const double> points, int dimension, std::span<const SignedIndex> cells,
                       int corners) {
  const auto width = static_cast<std::size_t>(corners);
  const std::size_t count = cells.size() / width;
  CellShapes shapes{std::vector<double>(count), std::vector<double>(count)};
  Shape shape(dimension, corners);
  for (std::size_t cell = 0; cell < count; ++cell)
    std::tie(shapes.radius[cell], shapes.quality[cell]) =
        shape.of(points, cells.subspan(cell * width, width));
  return shapes;
}

}  // namespace delone::view
