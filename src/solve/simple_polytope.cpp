// SPDX-License-Identifier: BSD-3-Clause
#include "solve/simple_polytope.hpp"

#include "base/compensated_sum.hpp"
#include "base/compiled_dimension.hpp"
#include "base/progress_meter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numeric>

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

/// Lengths are in units of a power of two near the diameter, so that no product overflows or underflows.
bool SimplePolytope::set_scale() {
  double largest = 0;
  for (const double* x : x_)
    for (std::size_t j = 0; j < d_; ++j) largest = std::max(largest, std::abs(x[j] / 2 - x_[0][j] / 2));
  if (!(largest > 0) || !std::isfinite(largest)) return false;
  const int exponent = std::ilogb(largest) + 1;
  scale_ = std::ldexp(1.0, -std::clamp(exponent, -1000, 1000));
  return true;
}

void SimplePolytope::start_measuring(bool with_centroids) {
  with_centroids_ = with_centroids;
  entries_.resize(std::max(entries_.size(), m_ + 1));
  best_normals_.resize(entries_.size());
  normal_.resize(d_);
  // Labels may be any numbers; tables by label pay if these are few.
  const auto largest = std::max_element(labels_.begin(), labels_.end());
  const bool are_few = largest != labels_.end() && *largest < labels_.size();
  is_of_origin_.assign(are_few ? *largest + 1 : 0, 0);
  bases_.clear();
  centroids_.clear();
  known_.clear();
  on_.clear();
  face_.clear();
}

double SimplePolytope::unscaled(double volume, std::size_t dimension) const {
  for (std::size_t i = 0; i < dimension; ++i) volume = volume / scale_;
  return volume;
}

double SimplePolytope::volume() {
  if (x_.empty()) return 0;
  for (const double* x : x_)
    for (std::size_t j = 0; j < d_; ++j)
      if (!std::isfinite(x[j] / 2 - x_[0][j] / 2)) return std::numeric_limits<double>::infinity();
  if (!set_scale()) return 0;
  start_measuring(false);
  for (std::size_t corner = 0; corner < x_.size(); ++corner) face_.push_back(corner);
  return unscaled(measure_face(m_, 0, face_.size()).volume, m_);
}

/// The pyramids from the first corner over all facets.
SimplePolytope::Measures SimplePolytope::measures() {
  Measures result;
  if (x_.empty()) return result;
  const bool has_extent = set_scale();
  start_measuring(true);
  std::vector<Entry> entries;
  for (std::size_t corner = 0; corner < x_.size(); ++corner)
    for (std::size_t i = 0; i < m_; ++i) entries.push_back({labels_[corner * m_ + i], corner});
  std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
    return a.label < b.label || (a.label == b.label && a.corner < b.corner);
  });
  internal::CompensatedSum volume;
  std::vector<double> sum(d_, 0.0);
  for (std::size_t begin = 0, end = 0; begin < entries.size(); begin = end) {
    const std::size_t label = entries[begin].label;
    face_.clear();
    for (; end < entries.size() && entries[end].label == label; ++end) face_.push_back(entries[end].corner);
    if (!has_extent) continue;
    on_.assign(1, label);
    const Face facet = measure_face(m_ - 1, 0, face_.size());
    result.facets.push_back({label, end - begin, unscaled(facet.volume, m_ - 1)});
    if (!(facet.volume > 0) || std::find(labels_.begin(), labels_.begin() + static_cast<std::ptrdiff_t>(m_),
                                         label) != labels_.begin() + static_cast<std::ptrdiff_t>(m_))
      continue;
    const double part = facet.volume * height(0, facet, m_ - 1);
    volume.add(part);
    add_pyramid(0, facet, m_, part, sum);
  }
  if (!(volume.value() > 0)) return result;
  result.volume = unscaled(volume.value() / static_cast<double>(m_), m_);
  for (double& x : sum) x = x / volume.value() / scale_;
  result.centroid = std::move(sum);
  return result;
}

/// The centroid of a pyramid of dimension m is that of its apex and of m points at the centroid of its base.
void SimplePolytope::add_pyramid(std::size_t apex, const Face& base, std::size_t dimension, double part,
                                 std::vector<double>& sum) const {
  const auto m = static_cast<double>(dimension);
  for (std::size_t j = 0; j < d_; ++j) {
    const double of_base = dimension == 1 ? x_[base.origin][j] * scale_ : centroids_[base.centroid + j];
    sum[j] += part * ((x_[apex][j] * scale_ + m * of_base) / (m + 1));
  }
}

double SimplePolytope::height(std::size_t corner, const Face& face, std::size_t dimension) {
  return internal::with_compiled_dimension<2, 4>(
      d_, [&](auto d) { return height_in<static_cast<std::size_t>(d())>(corner, face, dimension); });
}

/// D is d_, or 0.
template <std::size_t D>
double SimplePolytope::height_in(std::size_t corner, const Face& face, std::size_t dimension) {
  const std::size_t d = D > 0 ? D : d_;
  double* const normal = normal_.data();
  const double *to = x_[corner], *from = x_[face.origin], *basis = bases_.data() + face.basis;
  double before = 0, after = 0;
  for (std::size_t j = 0; j < d; ++j) {
    normal[j] = to[j] * scale_ - from[j] * scale_;
    before += normal[j] * normal[j];
  }
  after = before;
  // Gram–Schmidt; a second pass makes up for cancellation in the first.
  for (int pass = 0; pass < 2 && dimension > 0; ++pass) {
    for (std::size_t b = 0; b < dimension * d; b += d) {
      double dot = 0;
      for (std::size_t j = 0; j < d; ++j) dot += normal[j] * basis[b + j];
      for (std::size_t j = 0; j < d; ++j) normal[j] -= dot * basis[b + j];
    }
    after = 0;
    for (std::size_t j = 0; j < d; ++j) after += normal[j] * normal[j];
    if (after > before / 4) break;
  }
  const double length = std::sqrt(after);
  if (length > 0)
    for (std::size_t j = 0; j < d; ++j) normal[j] /= length;
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

/// An edge has two corners; most faces are edges.
SimplePolytope::Face SimplePolytope::measure_edge(std::size_t first, std::size_t last) {
  const std::size_t origin = face_[first];
  if (last - first < 2) return {0, origin, 0, 0};
  const double length = height(face_[first + 1], {1, origin, bases_.size()}, 0);
  if (!(length > 0)) return {0, origin, 0, 0};
  const std::size_t basis = bases_.size(), at = centroids_.size();
  bases_.insert(bases_.end(), normal_.begin(), normal_.end());
  for (std::size_t j = 0; with_centroids_ && j < d_; ++j)
    centroids_.push_back((x_[origin][j] * scale_ + x_[face_[first + 1]][j] * scale_) / 2);
  return {length, origin, basis, at};
}

/// The facets that do not contain the first corner of a face, with each of its corners on them, by facet.
/// Those through the first corner include those that contain the whole face.
void SimplePolytope::gather(std::size_t first, std::size_t last, std::vector<Entry>& entries) {
  constexpr std::size_t few = 16;  // are sorted sooner than all facets are counted
  entries.clear();
  const std::span<const std::size_t> of_origin(labels_.data() + face_[first] * m_, m_);
  const bool has_tables = !is_of_origin_.empty();
  const auto is_of_origin = [&](std::size_t label) {
    return has_tables ? is_of_origin_[label] != 0
                      : std::find(of_origin.begin(), of_origin.end(), label) != of_origin.end();
  };
  const auto mark_origin = [&](char mark) {
    if (has_tables)
      for (const std::size_t label : of_origin) is_of_origin_[label] = mark;
  };
  mark_origin(1);
  for (std::size_t f = first + 1; f < last; ++f)
    for (std::size_t i = 0; i < m_; ++i) {
      const std::size_t label = labels_[face_[f] * m_ + i];
      if (!is_of_origin(label)) entries.push_back({label, face_[f]});
    }
  mark_origin(0);
  // Corners come in increasing order, also in the lists that are made here.
  if (entries.size() <= few || !has_tables) {
    std::sort(entries.begin(), entries.end(), [](const Entry& a, const Entry& b) {
      return a.label < b.label || (a.label == b.label && a.corner < b.corner);
    });
    return;
  }
  places_.assign(is_of_origin_.size() + 1, 0);
  for (const Entry& entry : entries) ++places_[entry.label + 1];
  std::partial_sum(places_.begin(), places_.end(), places_.begin());
  sorted_.resize(entries.size());
  for (const Entry& entry : entries) sorted_[places_[entry.label]++] = entry;
  entries.swap(sorted_);
}

SimplePolytope::Face SimplePolytope::measure_face(std::size_t dimension, std::size_t first,
                                                  std::size_t last) {
  const std::size_t origin = face_[first];
  if (dimension == 0) return {1, origin, bases_.size()};
  if (dimension == 1) return measure_edge(first, last);
  internal::cancellation_point();
  auto& entries = entries_[dimension];  // the recursion uses those of lower dimensions
  gather(first, last, entries);
  internal::CompensatedSum sum;
  // The basis of the face is that of its facet with the largest part, plus the normal. The directions of a
  // thin facet are less accurate.
  double largest = 0;
  Face base{0, 0, 0};
  std::vector<double> centroid(with_centroids_ ? d_ : 0);
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
    if (with_centroids_) add_pyramid(origin, facet, dimension, part, centroid);
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
  const std::size_t at = centroids_.size();
  for (const double x : centroid) centroids_.push_back(x / sum.value());
  return {sum.value() / static_cast<double>(dimension), origin, basis, at};
}

}  // namespace delone::solve
