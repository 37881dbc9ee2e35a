// SPDX-License-Identifier: BSD-3-Clause
// The names of the kinds of data.
#include <delone/data.hpp>

#include <array>
#include <cstddef>

namespace delone {
namespace {

struct Words {
  std::string_view name, description;
};

/// In the order of DataKind.
constexpr std::array<Words, 17> words{{{"", "a triangulation"},
                                       {"delaunay", "a Delaunay triangulation"},
                                       {"regular", "a regular triangulation"},
                                       {"furthest_site", "a furthest-site Delaunay triangulation"},
                                       {"alpha_complex", "an alpha complex"},
                                       {"alpha_boundary", "the boundary of an alpha complex"},
                                       {"trimmed", "a trimmed triangulation"},
                                       {"lower_hull", "a lower hull"},
                                       {"upper_hull", "an upper hull"},
                                       {"periodic_delaunay", "a periodic Delaunay triangulation"},
                                       {"periodic_regular", "a periodic regular triangulation"},
                                       {"hull_boundary", "the boundary of a convex hull"},
                                       {"convex_hull", "a convex hull"},
                                       {"halfspace_intersection", "an intersection of halfspaces"},
                                       {"voronoi", "a Voronoi diagram"},
                                       {"power_diagram", "a power diagram"},
                                       {"furthest_voronoi", "a furthest-site Voronoi diagram"}}};
static_assert(words.size() == static_cast<std::size_t>(DataKind::furthest_voronoi) + 1);

}  // namespace

std::string_view name_of(DataKind kind) { return words[static_cast<std::size_t>(kind)].name; }

std::string_view description_of(DataKind kind) { return words[static_cast<std::size_t>(kind)].description; }

std::optional<DataKind> find_data_kind(std::string_view name) {
  for (std::size_t i = 1; i < words.size(); ++i)
    if (words[i].name == name) return static_cast<DataKind>(i);
  return std::nullopt;
}

}  // namespace delone
