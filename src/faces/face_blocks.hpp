// SPDX-License-Identifier: BSD-3-Clause
// Questions about the orthospheres of many faces of a level, in blocks and by several threads.
#pragma once

#include "base/parallel_parts.hpp"
#include "faces/face_level.hpp"
#include "faces/orthosphere.hpp"
#include "faces/orthosphere_kernel.hpp"
#include "triangulation/stored_points.hpp"

#include <delone/triangulation.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace delone::internal {

using sites::VertexPoints;

inline constexpr std::size_t faces_in_part = 8192;

/// The exponent of a unit that all coordinates are multiples of, and its square all weights.
inline int unit_of(const Triangulation& triangulation) {
  const VertexPoints& points = triangulation::StoredPoints::of(triangulation);
  return unit_of(points.coordinates, points.weighted() ? static_cast<std::size_t>(points.ambient) : 0);
}

/// The faces of a level, or some of them, in blocks of orthosphere_block.
class FaceBlocks {
 public:
  FaceBlocks(const VertexPoints& points, int unit, const FaceLevel& level)
      : points_(points),
        level_(level),
        spheres_(points.ambient, points.weighted(), unit, level.corners()),
        of_block_(orthosphere_block * level.corners()) {}

  /// Calls take(face, answer) for these faces.
  template <class Take>
  void find(std::span<const std::size_t> faces, Orthospheres::Want want, const Take& take) {
    Orthospheres::Answer answers[orthosphere_block];
    for_each_block(faces, [&](std::span<const std::size_t> block) {
      spheres_.find_block(block.size(), of_block_.data(), want, answers);
      for (std::size_t i = 0; i < block.size(); ++i) take(block[i], answers[i]);
    });
  }
  /// Calls take(face) for those that are within the bound.
  template <class Take>
  void find_within(std::span<const std::size_t> faces, const SquareBound& bound, const Take& take) {
    bool is_within[orthosphere_block];
    for_each_block(faces, [&](std::span<const std::size_t> block) {
      spheres_.is_within_block(block.size(), of_block_.data(), bound, is_within);
      for (std::size_t i = 0; i < block.size(); ++i)
        if (is_within[i]) take(block[i]);
    });
  }

 private:
  template <class Work>
  void for_each_block(std::span<const std::size_t> faces, const Work& work) {
    const std::size_t corners = level_.corners();
    for (std::size_t first = 0; first < faces.size(); first += orthosphere_block) {
      const auto block = faces.subspan(first, std::min(orthosphere_block, faces.size() - first));
      const double** to = of_block_.data();
      for (const std::size_t face : block)
        for (std::size_t i = 0; i < corners; ++i)
          *to++ = points_.point(static_cast<Index>(level_.vertices[face * corners + i]));
      work(block);
    }
  }

  const VertexPoints& points_;
  const FaceLevel& level_;
  Orthospheres spheres_;
  std::vector<const double*> of_block_;
};

/// Calls work(blocks, faces) for parts of those faces of a level for which is_wanted(face); it may reorder
/// these.
template <class IsWanted, class Work>
void for_wanted_faces(const Triangulation& triangulation, const FaceLevel& level, int unit, unsigned threads,
                      const IsWanted& is_wanted, const Work& work) {
  const VertexPoints& points = triangulation::StoredPoints::of(triangulation);
  work_in_parts(threads, level.size(), faces_in_part, [&] {
    return [&, blocks = FaceBlocks(points, unit, level), wanted = std::vector<std::size_t>()](
               std::size_t first, std::size_t last, const StopPoint& stop) mutable {
      constexpr std::size_t between_stops = 16 * orthosphere_block;
      for (std::size_t begin = first; begin < last; begin += between_stops) {
        stop();
        wanted.clear();
        for (std::size_t face = begin; face < std::min(last, begin + between_stops); ++face)
          if (is_wanted(face)) wanted.push_back(face);
        work(blocks, std::span<std::size_t>(wanted));
      }
    };
  });
}

/// For each face the facets beyond which its center is, in as few bytes as they need.
class Masks {
 public:
  Masks(std::size_t count, std::size_t corners) : stride_((corners + 7) / 8), bytes_(count * stride_, 0) {}
  void set(std::size_t face, std::uint64_t bits) {
    for (std::size_t b = 0; b < stride_; ++b)
      bytes_[face * stride_ + b] = static_cast<unsigned char>(bits >> (8 * b));
  }
  bool has(std::size_t face, std::size_t bit) const {
    return (bytes_[face * stride_ + bit / 8] >> (bit % 8) & 1) != 0;
  }

 private:
  std::size_t stride_;
  std::vector<unsigned char> bytes_;
};

}  // namespace delone::internal
