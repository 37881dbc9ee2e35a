// SPDX-License-Identifier: BSD-3-Clause
// Collects clipped regions, and joins them: a vertex has one number in all regions.
#pragma once

#include "voronoi/region_clipper.hpp"

#include <delone/voronoi.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <unordered_map>
#include <vector>

namespace delone::voronoi {

class RegionCollector {
 public:
  /// REQUIRES 2 ≤ d ≤ 3.
  explicit RegionCollector(std::size_t d);
  /// The next region, number `region`, as it was clipped. `regions`: of the other sites.
  void add(std::size_t region, RegionClipper& clipper, std::span<const std::size_t> regions);
  /// The next region, one without interior.
  void add_empty() { result_.region_offsets.push_back(static_cast<std::int64_t>(result_.num_faces())); }
  ClippedRegions finish() &&;

 private:
  /// Sites and fixed planes that a corner is on, increasing. They name it, but a vertex may have many names.
  using Name = std::array<std::size_t, 4>;
  struct Hash {
    std::size_t operator()(const Name& name) const;
  };

  Index number_of(const Name& name, RegionClipper& clipper, RegionClipper::Corner corner);
  void leave_out_unused_vertices();
  void find_neighbors();

  std::size_t d_;
  ClippedRegions result_;
  std::unordered_map<Name, Index, Hash> numbers_;
  std::vector<RegionClipper::ExactCorner> exact_;                   // of each vertex
  std::map<std::array<double, 3>, std::vector<Index>> of_rounded_;  // the vertices with these coordinates
};

}  // namespace delone::voronoi
