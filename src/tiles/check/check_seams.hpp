// SPDX-License-Identifier: BSD-3-Clause
// What the parts of a folder of tiles are to each other: the facets that no part has two cells of, and the
// ridges of the hull.
#pragma once

#include "tiles/check/check_part.hpp"
#include "tiles/record_buckets.hpp"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace delone::tiles {

class SeamChecker {
 public:
  /// `facets`: about how many will come. REQUIRES that the reference outlives this.
  SeamChecker(const TilesIndex& index, const Reference& reference, std::string scratch, std::uint64_t facets,
              std::uint64_t memory, bool canonical);

  /// Takes the facets of a part that have one cell there.
  void add(const CheckedPart& part);
  /// Level 2: facets that are equal belong to two cells, which name each other and are oriented coherently;
  /// others are on the hull. Level 5 across seams.
  void match_facets(Findings& findings);
  /// Level 3: each ridge of the hull is that of two of its facets. Level 5 at the hull: it is convex.
  void match_ridges(Findings& findings);

  std::int64_t num_hull_facets() const { return num_hull_facets_; }
  std::size_t ties() const { return ties_; }

 private:
  struct Facet;
  struct Ridge;
  Facet facet_at(std::span<const std::int64_t> words) const;
  void match(const Facet& a, const Facet& b, Findings& findings);
  void add_hull_facet(const Facet& facet, Findings& findings);
  void append(std::span<const double> values);

  int dimension_;
  std::size_t k_, row_size_, facet_size_, ridge_size_;
  const Reference& reference_;
  std::string scratch_;
  bool canonical_;
  std::unique_ptr<RecordBuckets> facets_, ridges_;
  std::vector<std::int64_t> record_;
  std::int64_t num_hull_facets_ = 0;
  std::size_t ties_ = 0;
};

}  // namespace delone::tiles
