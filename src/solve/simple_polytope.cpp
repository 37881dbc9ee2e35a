// SPDX-License-Identifier: BSD-3-Clause
#include "solve/simple_polytope.hpp"

#include "base/compensated_sum.hpp"
#include "base/progress_meter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace delone::solve {

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

std::size_t SimplePolytope::LabelsHash::operator()(const std::vector<std::size_t>& labels) const {
  std::uint64_t hash = 0;
  for (const std::size_t label : labels) {
    hash = (hash ^ label) * 0x9e3779b97f4a7c15u;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
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
  // Lengths are in units of a power of two near the diameter, so that no product overflows or underflows.
  const int exponent = std::ilogb(largest) + 1;
  scale_ = std::ldexp(1.0, -std::clamp(exponent, -1000, 1000));
  entries_.resize(std::max(entries_.size(), m_ + 1));
  best_normals_.resize(entries_.size());
  normal_.resize(d_);
  bases_.clear();
  known_.clear();
  on_.clear();
  face_.clear();
  for (std::size_t corner = 0; corner < x_.size(); ++corner) face_.push_back(corner);
  double volume = measure_face(m_, 0, face_.size()).volume;
  for (std::size_t i = 0; i < m_; ++i) volume = volume / scale_;
  return volume;
}

double SimplePolytope::height(std::size_t corner, const Face& face, std::size_t dimension) {
  const double *to = x_[corner], *from = x_[face.origin], *basis = bases_.data() + face.basis;
  double before = 0, after = 0;
  for (std::size_t j = 0; j < d_; ++j) {
    normal_[j] = to[j] * scale_ - from[j] * scale_;
    before += normal_[j] * normal_[j];
  }
  after = before;
  // Gram–Schmidt; a second pass makes up for cancellation in the first.
  for (int pass = 0; pass < 2 && dimension > 0; ++pass) {
    for (std::size_t b = 0; b < dimension * d_; b += d_) {
      double dot = 0;
      for (std::size_t j = 0; j < d_; ++j) dot += normal_[j] * basis[b + j];
      for (std::size_t j = 0; j < d_; ++j) normal_[j] -= dot * basis[b + j];
    }
    after = 0;
    for (std::size_t j = 0; j < d_; ++j) after += normal_[j] * normal_[j];
    if (after > before / 4) break;
  }
  const double length = std::sqrt(after);
  if (length > 0)
    for (double& x : normal_) x /= length;
  return length;
}

SimplePolytope::Face SimplePolytope::find_face(std::size_t dimension, std::size_t first, std::size_t last) {
  // Facets of the polytope occur once; edges and corners are cheaper to measure than to look up.
  if (dimension < 2 || dimension + 1 >= m_) return measure_face(dimension, first, last);
  if (const auto found = known_.find(on_); found != known_.end()) return found->second;
  const Face face = measure_face(dimension, first, last);
  known_.emplace(on_, face);
  return face;
}

SimplePolytope::Face SimplePolytope::measure_face(std::size_t dimension, std::size_t first,
                                                  std::size_t last) {
  const std::size_t origin = face_[first];
  if (dimension == 0) return {1, origin, bases_.size()};
  internal::cancellation_point();
  auto& entries = entries_[dimension];  // the recursion uses those of lower dimensions
  entries.clear();
  const std::size_t* of_origin = labels_.data() + origin * m_;
  for (std::size_t f = first + 1; f < last; ++f)
    for (std::size_t i = 0; i < m_; ++i) {
      const std::size_t label = labels_[face_[f] * m_ + i];
      // Skips the facets through the origin, which include those that contain the whole face.
      if (std::find(of_origin, of_origin + m_, label) == of_origin + m_) entries.push_back({label, face_[f]});
    }
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.label < b.label || (a.label == b.label && a.corner < b.corner);
  });
  internal::CompensatedSum sum;
  // The basis of the face is that of its facet with the largest part, plus the normal. The directions of a
  // thin facet are less accurate.
  double largest = 0;
  Face base{0, 0, 0};
  for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    const std::size_t corners = face_.size(), label = entries[begin].label;
    for (; end < entries.size() && entries[end].label == label; ++end) face_.push_back(entries[end].corner);
    on_.insert(std::lower_bound(on_.begin(), on_.end(), label), label);
    const Face facet = find_face(dimension - 1, corners, face_.size());
    on_.erase(std::lower_bound(on_.begin(), on_.end(), label));
    face_.resize(corners);
    if (!(facet.volume > 0)) continue;
    const double part = facet.volume * height(origin, facet, dimension - 1);
    sum.add(part);
    if (part > largest) {
      largest = part;
      base = facet;
      best_normals_[dimension].assign(normal_.begin(), normal_.end());
    }
  }
  if (!(largest > 0)) return {0, origin, 0};
  const std::size_t basis = bases_.size();
  bases_.resize(basis + dimension * d_);
  std::copy_n(bases_.begin() + static_cast<std::ptrdiff_t>(base.basis), (dimension - 1) * d_,
              bases_.begin() + static_cast<std::ptrdiff_t>(basis));
  std::copy(best_normals_[dimension].begin(), best_normals_[dimension].end(),
            bases_.end() - static_cast<std::ptrdiff_t>(d_));
  return {sum.value() / static_cast<double>(dimension), origin, basis};
}

}  // namespace delone::solve
