// SPDX-License-Identifier: BSD-3-Clause
#include "hull/hull_faces.hpp"

#include "base/progress_meter.hpp"
#include "base/random.hpp"
#include "base/spread.hpp"
#include "base/union_find.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>
#include <utility>

namespace delone::hull {

namespace {

/// For each key 0 … num_keys−1, the distinct values paired with it, in increasing order.
Lists grouped(std::vector<std::pair<Index, Index>> pairs, std::size_t num_keys) {
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  Lists lists;
  lists.items.reserve(pairs.size());
  std::size_t next = 0;
  for (std::size_t key = 0; key < num_keys; ++key) {
    for (; next < pairs.size() && pairs[next].first == key; ++next) lists.items.push_back(pairs[next].second);
    lists.offsets.push_back(lists.items.size());
  }
  return lists;
}

std::vector<Index> intersection(std::span<const Index> a, std::span<const Index> b) {
  std::vector<Index> common;
  std::set_intersection(a.begin(), a.end(), b.begin(), b.end(), std::back_inserter(common));
  return common;
}

/// Whether the given facets have a common site besides v. If so, v is not a vertex of the polytope.
bool has_company(Index v, const Lists& sites_of_facet, std::span<const Index> facets) {
  const auto smallest = std::min_element(facets.begin(), facets.end(), [&](Index a, Index b) {
    return sites_of_facet[a].size() < sites_of_facet[b].size();
  });
  const auto candidates = sites_of_facet[*smallest];
  return std::any_of(candidates.begin(), candidates.end(), [&](Index w) {
    return w != v && std::all_of(facets.begin(), facets.end(), [&](Index f) {
             const auto sites = sites_of_facet[f];
             return std::binary_search(sites.begin(), sites.end(), w);
           });
  });
}

/// Numbers the facets in the order of their first cells.
void number_facets(const SimplicialHull& hull, std::span<const std::pair<Index, Index>> coplanar,
                   PolytopeFaces& faces) {
  const std::size_t m = hull.num_cells();
  if (coplanar.empty()) {  // each cell is a facet
    faces.facet_of_cell.resize(m);
    std::iota(faces.facet_of_cell.begin(), faces.facet_of_cell.end(), Index{0});
    faces.cells_of_facet.items = faces.facet_of_cell;
    faces.cells_of_facet.offsets.resize(m + 1);
    std::iota(faces.cells_of_facet.offsets.begin(), faces.cells_of_facet.offsets.end(), std::size_t{0});
    return;
  }
  internal::UnionFind sets(m);
  for (const auto& [a, b] : coplanar) sets.unite(a, b);
  faces.facet_of_cell.resize(m);
  Index num_facets = 0;
  for (std::size_t c = 0; c < m; ++c) {
    const Index root = sets.root(static_cast<Index>(c));
    faces.facet_of_cell[c] = root == c ? num_facets++ : faces.facet_of_cell[root];
  }
  list_cells_of_facets(faces, num_facets);
}

/// Calls visit(facet, neighbor, cell, vertex) once for each ridge, in increasing order of the pairs (facet,
/// neighbor) with facet < neighbor. The ridge, or a part of it, is opposite `vertex` in `cell`, a cell of
/// `facet`. Two facets of a polytope share at most one ridge.
template <class Visit>
void for_each_ridge(const SimplicialHull& hull, const PolytopeFaces& faces, Visit visit) {
  struct Side {
    Index facet, cell;
    std::size_t vertex;
  };
  std::vector<Side> sides;
  for (Index f = 0; hull.dimension > 1 && f < faces.num_facets(); ++f) {
    internal::cancellation_point();
    sides.clear();
    for (const Index c : faces.cells_of_facet[f]) {
      const auto neighbors = hull.neighbors_of(c);
      for (std::size_t i = 0; i < neighbors.size(); ++i)
        if (const Index other = faces.facet_of_cell[neighbors[i]]; other > f) sides.push_back({other, c, i});
    }
    std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.facet < b.facet; });
    for (std::size_t i = 0; i < sides.size(); ++i)
      if (i == 0 || sides[i].facet != sides[i - 1].facet)
        visit(f, sides[i].facet, sides[i].cell, sides[i].vertex);
  }
}

/// The faces of one dimension, numbered in the order in which they are met.
struct FaceLevel {
  Lists faces;

  /// The number of the face with these vertices, in increasing order. Adds it if it is new.
  Index number(std::span<const Index> sites) {
    if (2 * (faces.size() + 1) > table.size()) grow();
    const std::size_t place = find(sites);
    if (table[place] == invalid_index) {
      table[place] = static_cast<Index>(faces.size());
      faces.add(sites);
    }
    return table[place];
  }

 private:
  std::size_t find(std::span<const Index> sites) const {
    std::uint64_t key = sites.size();
    for (const Index v : sites) key = random::mix(key ^ v);
    std::size_t place = key & (table.size() - 1);
    const auto is_here = [&](Index number) {
      return std::equal(sites.begin(), sites.end(), faces[number].begin(), faces[number].end());
    };
    while (table[place] != invalid_index && !is_here(table[place])) place = (place + 1) & (table.size() - 1);
    return place;
  }
  void grow() {
    table.assign(std::max<std::size_t>(64, 2 * table.size()), invalid_index);
    for (std::size_t f = 0; f < faces.size(); ++f) table[find(faces[f])] = static_cast<Index>(f);
  }

  std::vector<Index> table;  // numbers of faces; its size is 0 or a power of two
};

}  // namespace

Lists lists_with_each(const Lists& lists, std::size_t num_items) {
  Lists result;
  internal::spread(num_items, result.offsets, result.items, [&](const auto& put) {
    for (std::size_t l = 0; l < lists.size(); ++l)
      for (const Index item : lists[l]) put(item, static_cast<Index>(l));
  });
  return result;
}

void list_cells_of_facets(PolytopeFaces& faces, std::size_t num_facets) {
  internal::spread(num_facets, faces.cells_of_facet.offsets, faces.cells_of_facet.items,
                   [&](const auto& put) {
                     for (std::size_t c = 0; c < faces.facet_of_cell.size(); ++c)
                       put(faces.facet_of_cell[c], static_cast<Index>(c));
                   });
}

PolytopeFaces find_faces(const SimplicialHull& hull, std::size_t num_sites,
                         std::span<const std::pair<Index, Index>> coplanar) {
  PolytopeFaces faces;
  number_facets(hull, coplanar, faces);
  faces.is_extreme.assign(num_sites, 0);
  if (coplanar.empty()) {
    for (std::size_t c = 0; c < hull.num_cells(); ++c) {
      internal::cancellation_point();
      for (const Index site : hull.cell(c)) faces.is_extreme[site] = 1;
    }
    return faces;
  }
  std::vector<Index> merged;  // cells of facets with several cells
  for (std::size_t c = 0; c < hull.num_cells(); ++c)
    if (faces.cells_of_facet[faces.facet_of_cell[c]].size() > 1)
      merged.push_back(static_cast<Index>(c));
    else
      for (const Index site : hull.cell(c)) faces.is_extreme[site] = 1;

  std::vector<std::pair<Index, Index>> facet_and_site, site_and_facet;
  for (const Index c : merged)
    for (const Index site : hull.cell(c)) {
      facet_and_site.emplace_back(faces.facet_of_cell[c], site);
      if (!faces.is_extreme[site]) site_and_facet.emplace_back(site, faces.facet_of_cell[c]);
    }
  const Lists sites_of_facet = grouped(std::move(facet_and_site), faces.num_facets());
  const Lists facets_of_site = grouped(std::move(site_and_facet), num_sites);
  for (std::size_t v = 0; v < num_sites; ++v) {
    internal::cancellation_point();
    if (const auto facets = facets_of_site[v]; !facets.empty())
      faces.is_extreme[v] = !has_company(static_cast<Index>(v), sites_of_facet, facets);
  }
  return faces;
}

Lists find_facet_sites(const SimplicialHull& hull, const PolytopeFaces& faces) {
  Lists lists;
  lists.offsets.reserve(faces.num_facets() + 1);
  lists.items.reserve(faces.num_facets() * hull.corners());
  std::vector<Index> sites;
  for (std::size_t f = 0; f < faces.num_facets(); ++f) {
    internal::cancellation_point();
    sites.clear();
    for (const Index c : faces.cells_of_facet[f])
      for (const Index site : hull.cell(c))
        if (faces.is_extreme[site]) sites.push_back(site);
    std::sort(sites.begin(), sites.end());
    sites.erase(std::unique(sites.begin(), sites.end()), sites.end());
    lists.add(sites);
  }
  return lists;
}

std::size_t count_ridges(const SimplicialHull& hull, const PolytopeFaces& faces) {
  if (hull.dimension > 1 && faces.num_facets() == hull.num_cells()) return hull.neighbors.size() / 2;
  std::size_t count = 0;
  for_each_ridge(hull, faces, [&](Index, Index, Index, std::size_t) { ++count; });
  return count;
}

std::vector<Index> neighboring_facets(const SimplicialHull& hull, const PolytopeFaces& faces) {
  std::vector<Index> facets;
  facets.reserve(hull.neighbors.size());
  for_each_ridge(hull, faces, [&](Index a, Index b, Index, std::size_t) {
    facets.push_back(a);
    facets.push_back(b);
  });
  return facets;
}

PolytopeRidges find_ridges(const SimplicialHull& hull, const PolytopeFaces& faces, const Lists& facet_sites) {
  PolytopeRidges ridges;
  std::vector<Index> sites;
  for_each_ridge(hull, faces, [&](Index a, Index b, Index c, std::size_t vertex) {
    ridges.facets.insert(ridges.facets.end(), {a, b});
    if (!faces.seeds.empty() || (faces.cells_of_facet[a].size() > 1 && faces.cells_of_facet[b].size() > 1)) {
      ridges.sites.add(intersection(facet_sites[a], facet_sites[b]));
      return;
    }
    // One of the two facets is a simplex, so the ridge is the face of `c` opposite `vertex`.
    const auto cell = hull.cell(c);
    sites.assign(cell.begin(), cell.end());
    sites.erase(sites.begin() + static_cast<std::ptrdiff_t>(vertex));
    std::sort(sites.begin(), sites.end());
    ridges.sites.add(sites);
  });
  return ridges;
}

std::vector<Index> common_vertices(const Lists& facets, std::span<const Index> which) {
  std::vector<Index> common;
  for (std::size_t i = 0; i < which.size(); ++i) {
    const auto facet = facets[which[i]];
    common = i == 0 ? std::vector<Index>(facet.begin(), facet.end()) : intersection(common, facet);
  }
  return common;
}

std::vector<std::size_t> count_faces(const Lists& facets, int dimension) {
  std::vector<std::size_t> counts(static_cast<std::size_t>(std::max(dimension, 0)), 0);
  FaceLevel level;
  for (std::size_t f = 0; f < facets.size(); ++f) level.number(facets[f]);
  std::vector<std::pair<Index, Index>> pairs;
  for (std::size_t f = 0; f < facets.size(); ++f)
    for (const Index v : facets[f]) pairs.emplace_back(v, static_cast<Index>(f));
  const Lists facets_of =
      pairs.empty() ? Lists{}
                    : grouped(pairs, std::max_element(pairs.begin(), pairs.end())->first + std::size_t{1});
  // For each face of the level one face of the level above that contains it, and for each of those all faces
  // of the level in it. Facets are in the polytope.
  std::vector<Index> parent;
  Lists within;

  std::vector<std::size_t> num_common(facets.size(), 0);
  std::vector<Index> touching, cut;
  std::vector<std::vector<Index>> cuts;
  std::vector<Index> numbers;
  for (std::size_t j = counts.size(); j-- > 0;) {
    counts[j] = level.faces.size();
    if (j == 0) break;
    FaceLevel next;
    std::vector<Index> next_parent;
    Lists next_within;
    const auto add = [&](std::size_t face, std::span<const Index> sites) {
      const Index number = next.number(sites);
      if (number == next_parent.size()) next_parent.push_back(static_cast<Index>(face));
      numbers.push_back(number);
    };
    for (std::size_t f = 0; f < level.faces.size(); ++f) {
      internal::cancellation_point();
      const auto face = level.faces[f];
      numbers.clear();
      if (face.size() == j + 1) {  // a simplex
        for (std::size_t i = 0; i <= j; ++i) {
          cut.assign(face.begin(), face.end());
          cut.erase(cut.begin() + static_cast<std::ptrdiff_t>(i));
          add(f, cut);
        }
      } else {
        // A face of dimension j − 1 has at least j vertices.
        cuts.clear();
        const auto meet = [&](std::span<const Index> other) {
          std::vector<Index> common = intersection(face, other);
          if (j <= common.size() && common.size() < face.size()) cuts.push_back(std::move(common));
        };
        if (parent.empty()) {
          touching.clear();
          for (const Index v : face)
            for (const Index g : facets_of[v])
              if (num_common[g]++ == 0) touching.push_back(g);
          for (const Index g : touching)
            if (std::exchange(num_common[g], 0) >= j) meet(facets[g]);
        } else {
          for (const Index g : within[parent[f]])
            if (g != f) meet(level.faces[g]);
        }
        std::sort(cuts.begin(), cuts.end(), [](const auto& a, const auto& b) { return a.size() > b.size(); });
        std::size_t num_largest = 0;
        for (std::size_t i = 0; i < cuts.size(); ++i) {
          const auto begin = cuts.begin(), end = begin + static_cast<std::ptrdiff_t>(num_largest);
          if (std::any_of(begin, end, [&](const auto& other) {
                return std::includes(other.begin(), other.end(), cuts[i].begin(), cuts[i].end());
              }))
            continue;
          if (i != num_largest) std::swap(cuts[num_largest], cuts[i]);
          ++num_largest;
        }
        for (std::size_t i = 0; i < num_largest; ++i) add(f, cuts[i]);
      }
      next_within.add(numbers);
    }
    level = std::move(next);
    parent = std::move(next_parent);
    within = std::move(next_within);
  }
  return counts;
}

}  // namespace delone::hull
