// SPDX-License-Identifier: BSD-3-Clause
// Why regions fit together. The perturbed polytope of a region tends to the exact one P. Each of its corners
// tends to a point of P on d planes with independent normals, which is a vertex of P; and its faces tend to
// faces of P, or to edges and vertices, which have fewer than three vertices. So what is left after equal
// corners are joined has the faces of P. Regions of a power diagram meet in common faces, and so do their
// intersections with a polytope. Thus a face has the same vertices in both of its regions.
#include "voronoi/clipped_regions.hpp"

#include "base/progress_meter.hpp"
#include "base/quick_rounds.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <limits>
#include <tuple>
#include <utility>

namespace delone::voronoi {
namespace {

bool are_equal(const RegionClipper::ExactCorner& a, const RegionClipper::ExactCorner& b) {
  const int grid = std::min(a.grid, b.grid);
  for (std::size_t j = 0; j < a.at.numerators.size(); ++j)
    if ((a.at.numerators[j] * b.at.denominator) << (a.grid - grid) != (b.at.numerators[j] * a.at.denominator)
                                                                          << (b.grid - grid))
      return false;
  return true;
}

}  // namespace

RegionCollector::RegionCollector(std::size_t d) : d_(d) { result_.dimension = static_cast<int>(d); }

std::size_t RegionCollector::Hash::operator()(const Name& name) const {
  std::uint64_t hash = 0;
  for (const std::size_t label : name) hash = (hash ^ label) * 0x9E3779B97F4A7C15U;
  return static_cast<std::size_t>(hash ^ hash >> 32);
}

Index RegionCollector::number_of(const Name& name, RegionClipper& clipper, RegionClipper::Corner corner) {
  const auto [entry, is_new] = numbers_.try_emplace(name, invalid_index);
  if (!is_new) return entry->second;
  RegionClipper::ExactCorner exact = clipper.exact_corner(corner);
  std::array<double, 3> rounded{};
  for (std::size_t j = 0; j < d_; ++j)
    rounded[j] = kernel::nearest_double(exact.at.numerators[j], exact.at.denominator, exact.grid);
  std::vector<Index>& there = of_rounded_[rounded];
  const auto same = std::find_if(there.begin(), there.end(),
                                 [&](Index vertex) { return are_equal(exact_[vertex], exact); });
  if (same != there.end()) return entry->second = *same;
  if (exact_.size() >= static_cast<std::size_t>(std::numeric_limits<SignedIndex>::max()))
    throw Error(Errc::too_many, "more vertices of clipped regions than 32 bits can number");
  const auto number = static_cast<Index>(exact_.size());
  there.push_back(number);
  exact_.push_back(std::move(exact));
  result_.vertices.insert(result_.vertices.end(), rounded.begin(),
                          rounded.begin() + static_cast<std::ptrdiff_t>(d_));
  return entry->second = number;
}

void RegionCollector::add(std::size_t region, RegionClipper& clipper, std::span<const std::size_t> regions) {
  const std::size_t fixed = clipper.num_fixed_planes();
  const std::vector<RegionClipper::Corner> corners = clipper.corners();
  std::vector<Index> number(corners.empty() ? 0 : corners.back() + 1, invalid_index);
  for (const RegionClipper::Corner corner : corners) {
    internal::cancellation_point();
    Name name{};
    name[0] = fixed + region;
    std::size_t count = 1;
    for (const std::size_t plane : clipper.planes_through(corner))
      name[count++] = plane < fixed ? plane : fixed + regions[clipper.other_of(plane)];
    std::sort(name.begin(), name.end());  // in the plane one entry is 0 always
    number[corner] = number_of(name, clipper, corner);
  }
  const auto faces = clipper.faces(number);
  if (faces.size() >= (d_ == 3 ? 4 : 1))
    for (const auto& face : faces) {
      result_.face_vertices.insert(result_.face_vertices.end(), face.begin(), face.end());
      result_.face_offsets.push_back(static_cast<std::int64_t>(result_.face_vertices.size()));
    }
  result_.region_offsets.push_back(static_cast<std::int64_t>(result_.num_faces()));
}

/// Regions without interior have left vertices that belong to no face.
void RegionCollector::leave_out_unused_vertices() {
  std::vector<SignedIndex> number(result_.num_vertices(), -1);
  for (const SignedIndex vertex : result_.face_vertices) number[static_cast<std::size_t>(vertex)] = 0;
  SignedIndex count = 0;
  internal::QuickRounds round;
  for (std::size_t v = 0; v < number.size(); ++v) {
    round();
    if (number[v] < 0) continue;
    number[v] = count++;
    std::copy_n(
        result_.vertices.begin() + static_cast<std::ptrdiff_t>(v * d_), d_,
        result_.vertices.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(number[v]) * d_));
  }
  result_.vertices.resize(static_cast<std::size_t>(count) * d_);
  for (SignedIndex& vertex : result_.face_vertices) vertex = number[static_cast<std::size_t>(vertex)];
}

/// A face has the same vertices in the other order in the region on its other side. Two faces have no two
/// edges in common, so a face is told by one of its vertices and the two beside it; in the plane an edge by
/// its ends.
void RegionCollector::find_neighbors() {
  struct Side {
    std::tuple<SignedIndex, SignedIndex, SignedIndex> key;
    std::size_t place;
    SignedIndex region;
  };
  std::vector<Side> sides;
  internal::QuickRounds round;
  const auto offset = [&](std::size_t face) { return static_cast<std::size_t>(result_.face_offsets[face]); };
  for (std::size_t r = 0; r < result_.num_regions(); ++r)
    for (auto f = static_cast<std::size_t>(result_.region_offsets[r]);
         f < static_cast<std::size_t>(result_.region_offsets[r + 1]); ++f) {
      const auto face = std::span(result_.face_vertices).subspan(offset(f), offset(f + 1) - offset(f));
      const auto at = [&](std::size_t i) { return face[i % face.size()]; };
      const auto region = static_cast<SignedIndex>(r);
      round();
      if (d_ == 2)
        for (std::size_t i = 0; i < face.size(); ++i)
          sides.push_back(
              {{0, std::min(at(i), at(i + 1)), std::max(at(i), at(i + 1))}, offset(f) + i, region});
      if (d_ == 2) continue;
      const auto least = static_cast<std::size_t>(std::min_element(face.begin(), face.end()) - face.begin());
      const auto [low, high] = std::minmax({at(least + 1), at(least + face.size() - 1)});
      sides.push_back({{at(least), low, high}, f, region});
    }
  result_.neighbors.assign(sides.size(), -1);
  std::sort(sides.begin(), sides.end(), [&](const Side& a, const Side& b) {
    round();
    return a.key < b.key;
  });
  for (std::size_t i = 0; i + 1 < sides.size(); ++i) {
    if (sides[i].key != sides[i + 1].key) continue;
    result_.neighbors[sides[i].place] = sides[i + 1].region;
    result_.neighbors[sides[i + 1].place] = sides[i].region;
  }
}

ClippedRegions RegionCollector::finish() && {
  leave_out_unused_vertices();
  find_neighbors();
  return std::move(result_);
}

}  // namespace delone::voronoi
