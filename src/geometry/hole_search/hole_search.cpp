// SPDX-License-Identifier: BSD-3-Clause
#include "geometry/hole_search/hole_search.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace delone::geometry {

void HoleSearch::begin(int k, std::size_t num_candidates, std::size_t num_vertices) {
  k_ = k;
  num_candidates_ = num_candidates;
  stride_ = (num_candidates + 15) / 16 * 16;
  const auto width = static_cast<std::size_t>(k) + 1;
  if (rows_.size() < (num_vertices + 1) * width) rows_.resize(2 * (num_vertices + 1) * width);
  if (lanes_.size() < stride_ * width) lanes_.resize(2 * stride_ * width);
  if (found_.size() < stride_ * width) found_.resize(2 * stride_ * width);
  bits_.resize(words_of_candidates(stride_) * width);
  ends_.resize(width + 1);
  if (values_.size() < 2 * stride_) values_.resize(4 * stride_);
  own_.resize(width);
  matrix_.resize(2 * width * width);
}

void HoleSearch::arrange() {
  const auto width = static_cast<std::size_t>(k_) + 1;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  largest_lift_ = 0;
  for (std::size_t i = 0; i < num_candidates_; ++i) {
    const double* const row = rows_.data() + (i + 1) * width;
    for (std::size_t r = 0; r < width; ++r) lanes_[r * stride_ + i] = row[r];
    largest_lift_ = std::max(largest_lift_, std::fabs(row[width - 1]));
  }
  for (std::size_t i = num_candidates_; i < stride_; ++i)
    for (std::size_t r = 0; r < width; ++r) lanes_[r * stride_ + i] = r + 1 < width ? 0 : infinity;
}

/// Inverts the matrix whose rows are (image, 1) by Gauss-Jordan elimination with row exchanges. Column i of
/// the inverse is barycentric coordinate i.
void HoleSearch::solve(const Index* vertices, double* functions) {
  const auto k = static_cast<std::size_t>(k_), n = k + 1, stride = 2 * n;
  double* const m = matrix_.data();
  for (std::size_t i = 0; i < n; ++i) {
    const double* const image = row(vertices[i]);
    std::copy_n(image, k, m + i * stride);
    m[i * stride + k] = 1;
    for (std::size_t c = 0; c < n; ++c) m[i * stride + n + c] = c == i ? 1 : 0;
  }
  for (std::size_t s = 0; s < n; ++s) {
    std::size_t largest = s;
    for (std::size_t i = s + 1; i < n; ++i)
      if (std::fabs(m[i * stride + s]) > std::fabs(m[largest * stride + s])) largest = i;
    if (largest != s) std::swap_ranges(m + s * stride, m + (s + 1) * stride, m + largest * stride);
    const double factor = 1 / m[s * stride + s];
    for (std::size_t c = s; c < stride; ++c) m[s * stride + c] *= factor;
    for (std::size_t i = 0; i < n; ++i) {
      if (i == s) continue;
      const double times = m[i * stride + s];
      for (std::size_t c = s; c < stride; ++c) m[i * stride + c] -= times * m[s * stride + c];
    }
  }
  const std::size_t width = width_of_functions(k_);
  std::fill_n(functions, size_of_functions(k_), 0.0);
  for (std::size_t r = 0; r < n; ++r) {
    double height = 0;
    for (std::size_t i = 0; i < n; ++i) {
      functions[r * width + i] = m[r * stride + n + i];
      height -= row(vertices[i])[k] * functions[r * width + i];
    }
    functions[r * width + n] = height;
  }
}

void HoleSearch::search(const double* functions, std::span<const int> slots, bool beyond, bool may_stay,
                        const Index* vertices) {
  const auto k = static_cast<std::size_t>(k_);
  std::size_t num_own = 0;
  for (std::size_t i = 0; i <= k; ++i)
    if (vertices[i] != 0 && vertices[i] <= num_candidates_ &&
        !(may_stay && std::find(slots.begin(), slots.end(), static_cast<int>(i)) != slots.end()))
      own_[num_own++] = static_cast<std::uint32_t>(vertices[i] - 1);
  find_first({k_, functions, slots.data(), slots.size(), beyond ? -1.0 : 1.0, lanes_.data(), stride_,
              largest_lift_, values_.data(), values_.data() + stride_, own_.data(), num_own},
             bits_.data());
  const std::uint64_t* word = bits_.data();
  std::size_t num_found = 0;
  for (std::size_t facet = 0; facet < slots.size(); ++facet) {
    for (std::uint32_t first = 1; first <= stride_; first += 64)
      for (std::uint64_t bits = *word++; bits != 0; bits &= bits - 1)
        found_[num_found++] = first + static_cast<std::uint32_t>(std::countr_zero(bits));
    ends_[facet + 1] = num_found;
  }
}

}  // namespace delone::geometry
