// SPDX-License-Identifier: BSD-3-Clause
#include "voronoi/face_volumes.hpp"

#include "base/progress_meter.hpp"
#include "base/random.hpp"
#include "voronoi/roundoff.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

namespace delone::voronoi {
namespace {

/// A volume is accurate if its error is `accurate` of it, or no more than errors of corners make inevitable
/// and `coarse` of it.
constexpr double accurate = 1e-11, coarse = 1e-6;

std::uint64_t key_of(Index label) { return random::mix(label + 0x9e3779b97f4a7c15u); }

}  // namespace

void FaceVolumes::clear() {
  x_.clear();
  errors_.clear();
  labels_.clear();
}

void FaceVolumes::add_corner(std::span<const double> x, double error, std::span<const Index> labels) {
  x_.insert(x_.end(), x.begin(), x.end());
  errors_.push_back(error);
  labels_.insert(labels_.end(), labels.begin(), labels.end());
}

/// Modified Gram–Schmidt of the edges at the first point. The relative error is an estimate: a few roundings
/// of each edge, relative to its height.
void FaceVolumes::measure_simplex(std::span<const Index> labels, double& volume, double& error) {
  volume = 1;
  error = 0;
  const std::size_t num_edges = labels.size() - 1;
  edges_.resize(std::max(edges_.size(), num_edges * d_));
  lengths_.resize(std::max(lengths_.size(), num_edges));
  const double* const from = point(labels[0]);
  for (std::size_t i = 0; i < num_edges; ++i) {
    double* const edge = edges_.data() + i * d_;
    const double* const to = point(labels[i + 1]);
    double square = 0;
    for (std::size_t j = 0; j < d_; ++j) {
      edge[j] = to[j] - from[j];
      square += edge[j] * edge[j];
    }
    lengths_[i] = square;
  }
  for (std::size_t i = 0; i < num_edges; ++i) {
    const double* const edge = edges_.data() + i * d_;
    double square = 0;
    for (std::size_t j = 0; j < d_; ++j) square += edge[j] * edge[j];
    volume *= square;
    error += static_cast<double>(d_ + 4 * i + 12) * std::sqrt(lengths_[i] / square);
    const double inverse = 1 / square;
    // The later edges do not depend on each other, so their sums overlap in time.
    for (std::size_t later = i + 1; later < num_edges; ++later) {
      double* const other = edges_.data() + later * d_;
      double dot = 0;
      for (std::size_t j = 0; j < d_; ++j) dot += edge[j] * other[j];
      dot *= inverse;
      for (std::size_t j = 0; j < d_; ++j) other[j] -= dot * edge[j];
    }
  }
  volume = std::sqrt(volume);
  error *= u;
}

FaceVolumes::Level FaceVolumes::corners_as_faces() const {
  Level level;
  level.size = m_ + 1;
  level.labels = labels_;
  const std::size_t n = num_corners();
  level.keys.resize(n);
  level.corners.resize(n);
  for (std::size_t c = 0; c < n; ++c) {
    level.corners[c] = static_cast<Index>(c);
    for (const Index label : level.labels_of(c)) level.keys[c] += key_of(label);
  }
  level.volumes.assign(n, 1.0);
  level.errors.assign(n, 0.0);
  level.least_errors.assign(n, 0.0);
  level.simplices.assign(n, 0.0);  // not needed, as edges are measured by their corners
  level.simplex_errors.assign(n, 0.0);
  return level;
}

FaceVolumes::Level FaceVolumes::next(const Level& level, const std::vector<unsigned char>& wanted) {
  Level made;
  made.size = level.size - 1;
  const double dimension = static_cast<double>(m_ + 1 - made.size);
  table_.assign(std::bit_ceil(std::max<std::size_t>(64, 2 * level.count())), invalid_index);
  const auto grow = [&] {
    table_.assign(2 * table_.size(), invalid_index);
    for (std::size_t f = 0; f < made.count(); ++f) {
      std::size_t place = made.keys[f] & (table_.size() - 1);
      while (table_[place] != invalid_index) place = (place + 1) & (table_.size() - 1);
      table_[place] = static_cast<Index>(f);
    }
  };
  std::vector<Index> sites(made.size);
  for (std::size_t facet = 0; facet < level.count(); ++facet) {
    internal::cancellation_point();
    const auto labels = level.labels_of(facet);
    std::size_t num_wanted = 0;
    for (const Index label : labels) num_wanted += wanted[label];
    const double* const x = corner(level.corners[facet]);
    for (std::size_t i = 0; i < labels.size(); ++i) {
      const Index w = labels[i];
      if (num_wanted == wanted[w]) continue;
      std::copy(labels.begin(), labels.begin() + static_cast<std::ptrdiff_t>(i), sites.begin());
      std::copy(labels.begin() + static_cast<std::ptrdiff_t>(i) + 1, labels.end(),
                sites.begin() + static_cast<std::ptrdiff_t>(i));
      const std::uint64_t key = level.keys[facet] - key_of(w);
      std::size_t place = key & (table_.size() - 1);
      while (table_[place] != invalid_index &&
             !(made.keys[table_[place]] == key &&
               std::equal(sites.begin(), sites.end(), made.labels_of(table_[place]).begin())))
        place = (place + 1) & (table_.size() - 1);
      if (table_[place] == invalid_index) {  // its corner is on this facet
        table_[place] = static_cast<Index>(made.count());
        made.labels.insert(made.labels.end(), sites.begin(), sites.end());
        made.keys.push_back(key);
        made.volumes.push_back(0);
        made.errors.push_back(0);
        made.least_errors.push_back(0);
        made.corners.push_back(level.corners[facet]);
        measure_simplex(sites, made.simplices.emplace_back(), made.simplex_errors.emplace_back());
        if (2 * made.count() > table_.size()) grow();
        continue;
      }
      const std::size_t face = table_[place];
      const Index origin = made.corners[face];
      const auto at_origin = labels_of_corner(origin);
      if (std::find(at_origin.begin(), at_origin.end(), w) != at_origin.end()) continue;
      const double* const o = corner(origin);
      if (std::equal(x, x + d_, o)) continue;
      const double* const p = point(w);
      const double* const s = point(sites[0]);
      double square = 0, along = 0, size = 0;
      for (std::size_t j = 0; j < d_; ++j) {
        const double t = x[j] - o[j], normal = p[j] - s[j];
        square += t * t;
        along += t * normal;
        size += normal * normal;
      }
      const double distance = std::sqrt(square);
      const double rounding = static_cast<double>(d_ + 4) * u * distance;
      const double of_corners =
          std::sqrt(static_cast<double>(d_)) * (errors_[level.corners[facet]] + errors_[origin]);
      double height = distance, error = of_corners + rounding;
      if (dimension > 1) {
        const double n = level.simplices[facet] / made.simplices[face];
        height = std::max(along, 0.0) / n;
        error = std::sqrt(size) * error / n +
                height * (level.simplex_errors[facet] + made.simplex_errors[face] + 4 * u);
      }
      const double volume = level.volumes[facet];
      made.volumes[face] += volume * height / dimension;
      made.errors[face] +=
          (volume * error + level.errors[facet] * (height + error)) / dimension + u * made.volumes[face];
      made.least_errors[face] +=
          (volume * (of_corners + rounding) + level.least_errors[facet] * height) / dimension;
    }
  }
  return made;
}

void FaceVolumes::measure(std::size_t size, const std::vector<unsigned char>& wanted,
                          const std::function<void(const Face&)>& visit) {
  Level level = corners_as_faces();
  while (level.size > size) level = next(level, wanted);
  for (std::size_t f = 0; f < level.count(); ++f) {
    const double volume = level.volumes[f], error = level.errors[f];
    const bool is_accurate = std::isfinite(volume) && std::isfinite(error) && error <= coarse * volume &&
                             error <= accurate * volume + level.least_errors[f];
    visit({level.labels_of(f), volume, is_accurate});
  }
}

}  // namespace delone::voronoi
