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
  const auto make_room = [&](auto& lanes) {
    if (lanes.rows.size() < stride_ * width) lanes.rows.resize(2 * stride_ * width);
    if (lanes.values.size() < 2 * stride_) lanes.values.resize(4 * stride_);
  };
  make_room(floats_);
  make_room(doubles_);
  are_doubles_there_ = false;
  const std::size_t num_words = words_of_candidates(stride_) * width;
  bits_.resize(num_words);
  if (found_.size() < 64 * num_words) found_.resize(128 * num_words);
  if (parts_.size() < width) {
    are_certain_ = std::make_unique<bool[]>(width);
    parts_.resize(width);  // last, so that it tells what there is room for
  }
  own_.resize(width);
  matrix_.resize(2 * width * width);
}

void HoleSearch::arrange() {
  const auto width = static_cast<std::size_t>(k_) + 1;
  largest_lift_ = 0;
  for (std::size_t i = 0; i < num_candidates_; ++i)
    largest_lift_ = std::max(largest_lift_, std::fabs(rows_[(i + 1) * width + width - 1]));
  arrange(floats_);
  are_doubles_there_ = false;
}

template <class T>
void HoleSearch::arrange(Lanes<T>& lanes) {
  const auto width = static_cast<std::size_t>(k_) + 1;
  T* const to = lanes.rows.data();
  for (std::size_t i = 0; i < num_candidates_; ++i)
    for (std::size_t r = 0; r < width; ++r) to[r * stride_ + i] = static_cast<T>(rows_[(i + 1) * width + r]);
  for (std::size_t i = num_candidates_; i < stride_; ++i)
    for (std::size_t r = 0; r < width; ++r)
      to[r * stride_ + i] = r + 1 < width ? T{0} : std::numeric_limits<T>::infinity();
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
  for (std::size_t i = 0; i <= k; ++i) {
    own_[num_own] = static_cast<std::uint32_t>(vertices[i] - 1);
    const bool may_be_found =
        may_stay && std::find(slots.begin(), slots.end(), static_cast<int>(i)) != slots.end();
    num_own += vertices[i] - 1 < num_candidates_ && !may_be_found;
  }
  find(floats_, functions, slots, beyond, num_own);
  unclear_.clear();
  std::size_t end = 0;
  for (std::size_t facet = 0; facet < slots.size(); ++facet) {
    end = list(facet, facet, end);
    if (parts_[facet].count > 1 || (parts_[facet].count == 1 && !parts_[facet].is_certain)) {
      end = parts_[facet].first;
      unclear_.push_back(facet);
    }
  }
  if (unclear_.empty()) [[likely]]
    return;
  // Several may be first in binary32.
  if (!are_doubles_there_) arrange(doubles_);
  are_doubles_there_ = true;
  unclear_slots_.clear();
  for (const std::size_t facet : unclear_) unclear_slots_.push_back(slots[facet]);
  find(doubles_, functions, unclear_slots_, beyond, num_own);
  for (std::size_t i = 0; i < unclear_.size(); ++i) end = list(i, unclear_[i], end);
}

template <class T>
void HoleSearch::find(Lanes<T>& lanes, const double* functions, std::span<const int> slots, bool beyond,
                      std::size_t num_own) {
  find_first(PencilTask<T>{k_, functions, slots.data(), slots.size(), beyond ? -1.0 : 1.0, lanes.rows.data(),
                           stride_, largest_lift_, lanes.values.data(), lanes.values.data() + stride_,
                           own_.data(), num_own, are_certain_.get()},
             bits_.data());
}

std::size_t HoleSearch::list(std::size_t i, std::size_t facet, std::size_t first) {
  const std::size_t num_words = words_of_candidates(stride_);
  const std::uint64_t* const words = bits_.data() + i * num_words;
  std::size_t end = first;
  for (std::size_t word = 0; word < num_words; ++word)
    for (std::uint64_t bits = words[word]; bits != 0; bits &= bits - 1)
      found_[end++] =
          static_cast<std::uint32_t>(64 * word + 1) + static_cast<std::uint32_t>(std::countr_zero(bits));
  parts_[facet] = {first, end - first, are_certain_[i]};
  return end;
}

}  // namespace delone::geometry
