// SPDX-License-Identifier: BSD-3-Clause
#include "front_ends/simple_polytope.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace delone::front_ends {

void CompensatedSum::add(double x) {
  const double next = sum_ + x;
  // Beyond the range of doubles there is nothing to compensate, and inf − inf would be no number.
  if (std::isfinite(next)) compensation_ += std::abs(sum_) >= std::abs(x) ? (sum_ - next) + x : (x - next) + sum_;
  sum_ = next;
}

void SimplePolytope::start(std::size_t m, std::size_t d) {
  m_ = m;
  d_ = d;
  x_.clear();
  labels_.clear();
}

void SimplePolytope::add_corner(const double* x, std::span<const std::size_t> labels) {
  x_.push_back(x);
  labels_.insert(labels_.end(), labels.begin(), labels.end());
}

double SimplePolytope::volume() {
  if (x_.empty()) return 0;
  double largest = 0;
  for (const double* x : x_)
    for (std::size_t j = 0; j < d_; ++j) {
      const double difference = std::abs(x[j] / 2 - x_[0][j] / 2);
      if (!std::isfinite(difference)) return std::numeric_limits<double>::infinity();
      largest = std::max(largest, difference);
    }
  if (largest == 0) return 0;
  // Lengths in units of a power of two near the diameter, so that no product leaves the range.
  const int exponent = std::ilogb(largest) + 1;
  scale_ = std::ldexp(1.0, -std::clamp(exponent, -1000, 1000));
  sum_ = {};
  basis_.clear();
  entries_.resize(std::max(entries_.size(), m_ + 1));
  face_.clear();
  for (std::size_t corner = 0; corner < x_.size(); ++corner) face_.push_back(corner);
  add_face(m_, 0, face_.size(), nullptr, 1.0);
  double factorial = 1;
  for (std::size_t i = 2; i <= m_; ++i) factorial *= static_cast<double>(i);
  double volume = sum_.value() / factorial;
  for (std::size_t i = 0; i < m_; ++i) volume = volume / scale_;
  return volume;
}

double SimplePolytope::push(const double* from, const double* to) {
  const std::size_t start = basis_.size();
  double before = 0, after = 0;
  for (std::size_t j = 0; j < d_; ++j) {
    basis_.push_back((to[j] * scale_) - (from[j] * scale_));
    before += basis_.back() * basis_.back();
  }
  double* vector = basis_.data() + start;
  for (int pass = 0; pass < 2 && start > 0; ++pass) {  // the second makes up for cancellation in the first
    for (std::size_t b = 0; b < start; b += d_) {
      double dot = 0;
      for (std::size_t j = 0; j < d_; ++j) dot += vector[j] * basis_[b + j];
      for (std::size_t j = 0; j < d_; ++j) vector[j] -= dot * basis_[b + j];
    }
    after = 0;
    for (std::size_t j = 0; j < d_; ++j) after += vector[j] * vector[j];
    if (after > before / 4) break;
  }
  const double length = std::sqrt(start > 0 ? after : before);
  if (length > 0)
    for (std::size_t j = 0; j < d_; ++j) vector[j] /= length;
  else
    basis_.resize(start);
  return length;
}

void SimplePolytope::add_face(std::size_t dimension, std::size_t first, std::size_t last, const double* apex, double product) {
  const double* origin = x_[face_[first]];
  const std::size_t basis_size = basis_.size();
  if (apex != nullptr) product *= push(apex, origin);
  if (product > 0 && dimension == 1) {
    if (last - first == 2) {
      const std::size_t before = basis_.size();
      sum_.add(product * push(origin, x_[face_[first + 1]]));
      basis_.resize(before);
    }
  } else if (product > 0) {
    auto& entries = entries_[dimension];
    entries.clear();
    const std::size_t* of_origin = labels_.data() + face_[first] * m_;
    for (std::size_t f = first + 1; f < last; ++f)
      for (std::size_t i = 0; i < m_; ++i) {
        const std::size_t label = labels_[face_[f] * m_ + i];
        // Not the facets through the apex; those that contain the whole face are among them.
        if (std::find(of_origin, of_origin + m_, label) == of_origin + m_) entries.push_back({label, face_[f]});
      }
    std::sort(entries.begin(), entries.end(),
              [](const Entry& a, const Entry& b) { return a.label < b.label || (a.label == b.label && a.corner < b.corner); });
    const std::size_t num_entries = entries.size();
    for (std::size_t begin = 0, end = 0; begin < num_entries; begin = end) {
      const std::size_t base = face_.size();
      for (; end < num_entries && entries_[dimension][end].label == entries_[dimension][begin].label; ++end)
        face_.push_back(entries_[dimension][end].corner);
      add_face(dimension - 1, base, face_.size(), origin, product);
      face_.resize(base);
    }
  }
  basis_.resize(basis_size);
}

}  // namespace delone::front_ends
