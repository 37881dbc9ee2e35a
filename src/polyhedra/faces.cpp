// SPDX-License-Identifier: BSD-3-Clause
#include "polyhedra/faces.hpp"

#include "base/progress_meter.hpp"
#include "base/random.hpp"

#include <algorithm>
#include <unordered_set>
#include <utility>

namespace delone::polyhedra {
namespace {

using FaceSet = std::unordered_set<Face, FaceHash>;

Face full_set(std::size_t size, std::size_t words) {
  Face face(words, 0);
  for (std::size_t i = 0; i < size; ++i) insert(face, i);
  return face;
}

/// The parts of all faces of a level, each once, that have a member of `needed`, or all if that is empty.
FaceSet next_level(const FaceSet& level, const BitRows& sets, const Face& needed) {
  FaceSet next;
  for (const Face& face : level)
    for (Face& part : largest_parts(face, sets)) {
      bool has_needed = needed.empty();
      for (std::size_t w = 0; w < needed.size() && !has_needed; ++w) has_needed = (part[w] & needed[w]) != 0;
      if (has_needed) next.insert(std::move(part));
    }
  return next;
}

/// From the polyhedron down to its minimal faces, as sets of generators, of which one is a vertex.
std::vector<std::size_t> count_downwards(const Description& own, const BitRows& facets) {
  const auto k = static_cast<std::size_t>(own.affine_dimension());
  std::vector<std::size_t> counts(k, 0);
  const Face vertices = full_set(own.num_vertices, facets.words());
  FaceSet level{full_set(own.generators.size(), facets.words())};
  for (std::size_t j = k; j-- > own.lines.size();) {
    level = next_level(level, facets, vertices);
    counts[j] = level.size();
  }
  return counts;
}

/// From the lineality space of its cone up, as sets of facets. Those on infinity are faces of the cone only.
std::vector<std::size_t> count_upwards(const Description& own) {
  const auto k = static_cast<std::size_t>(own.affine_dimension());
  std::vector<std::size_t> counts(k, 0);
  const std::size_t infinity = own.facets.size();
  const BitRows sets = own.incidence_with_infinity();
  FaceSet level{full_set(infinity + 1, sets.words())};
  for (std::size_t j = own.lines.size(); j < k; ++j) {
    level = next_level(level, sets, {});
    counts[j] = static_cast<std::size_t>(
        std::count_if(level.begin(), level.end(), [&](const Face& face) { return !test(face, infinity); }));
  }
  return counts;
}

}  // namespace

std::size_t FaceHash::operator()(const Face& face) const {
  std::uint64_t hash = 0;
  for (const std::uint64_t word : face) hash = random::mix(hash + 0x9e3779b97f4a7c15u + word);
  return static_cast<std::size_t>(hash);
}

std::vector<Face> largest_parts(const Face& face, const BitRows& sets) {
  internal::cancellation_point();
  struct Part {
    std::size_t size;
    Face face;
  };
  std::vector<Part> parts;
  const std::size_t size = count(face);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    Face part = face;
    for (std::size_t w = 0; w < part.size(); ++w) part[w] &= sets[i][w];
    if (const std::size_t members = count(part); members < size) parts.push_back({members, std::move(part)});
  }
  std::sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) {
    return a.size != b.size ? a.size > b.size : a.face < b.face;
  });
  std::vector<Face> largest;
  for (Part& part : parts)
    if (std::none_of(largest.begin(), largest.end(),
                     [&](const Face& other) { return contains(other, part.face); }))
      largest.push_back(std::move(part.face));
  return largest;
}

std::vector<std::size_t> count_faces(const Description& description, const BitRows& generators_of_facets) {
  return description.generators.size() < description.facets.size()
             ? count_upwards(description)
             : count_downwards(description, generators_of_facets);
}

}  // namespace delone::polyhedra
