// SPDX-License-Identifier: BSD-3-Clause
// Levels 2 and 3 of check(): the cells with the infinite cells added form a closed pseudomanifold, oriented,
// connected, with connected stars, and with the Euler characteristic of a sphere. No coordinate is looked at.
#include "base/progress_meter.hpp"
#include "base/random.hpp"
#include "check/check_stages.hpp"

#include <delone/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>

namespace delone::internal {

namespace {

bool contains(std::span<const SignedIndex> rows, SignedIndex row) {
  return std::find(rows.begin(), rows.end(), row) != rows.end();
}

// Whether the facets of a opposite a[i] and of b opposite b[j] have the same vertices, which are distinct in
// each.
bool equal_facets(std::span<const SignedIndex> a, std::size_t i, std::span<const SignedIndex> b,
                  std::size_t j) {
  for (std::size_t t = 0; t < a.size(); ++t)
    if (t != i && (a[t] == b[j] || !contains(b, a[t]))) return false;
  return true;
}

}  // namespace

std::vector<SignedIndex> paired_facets(std::span<const SignedIndex> cells, std::size_t corners,
                                       const std::vector<std::pair<std::size_t, std::size_t>>& hull) {
  struct Place {
    std::uint64_t key = 0;
    std::size_t facet = 0;  // 1 + cell·corners + i; 0 is an empty place
  };
  // A sphere fills half of the table at most; a heap of unrelated cells still leaves one place empty.
  std::vector<Place> table(std::bit_ceil(cells.size() + 1));
  const std::size_t mask = table.size() - 1;
  std::vector<SignedIndex> across(cells.size(), -1);
  for (std::size_t first = 0; first < cells.size(); first += corners) {
    cancellation_point();
    const auto a = cells.subspan(first, corners);
    std::uint64_t total = 0;
    for (const SignedIndex row : a) total += random::mix(static_cast<std::uint64_t>(row) + 1);
    for (std::size_t i = 0; i < corners; ++i) {
      const std::uint64_t key = random::mix(total - random::mix(static_cast<std::uint64_t>(a[i]) + 1));
      std::size_t at = key & mask;
      for (; table[at].facet != 0; at = (at + 1) & mask) {
        if (table[at].key != key) continue;
        const std::size_t facet = table[at].facet - 1, other = facet / corners;
        if (!equal_facets(a, i, cells.subspan(other * corners, corners), facet % corners)) continue;
        const std::size_t cell = first / corners;
        if (across[facet] >= 0) {
          std::vector<std::size_t> three{other, static_cast<std::size_t>(across[facet]), cell};
          if (!hull.empty())
            for (std::size_t& facet_of_hull : three) facet_of_hull = hull[facet_of_hull].first;
          throw Violation{fmt::format("{}the cells {}, {} and {} share the {} {}",
                                      hull.empty() ? "" : "hull facets of ", three[0], three[1], three[2],
                                      hull.empty() ? "facet" : "ridge", braces(facet_vertices(a, i))),
                          three};
        }
        across[facet] = static_cast<SignedIndex>(cell);
        across[first + i] = static_cast<SignedIndex>(other);
        break;
      }
      if (table[at].facet == 0) table[at] = {key, first + i + 1};
    }
  }
  return across;
}

std::size_t mirror(std::span<const SignedIndex> a, std::size_t i, std::span<const SignedIndex> b) {
  std::size_t j = 0;
  while (j + 1 < b.size() && (contains(a.first(i), b[j]) || contains(a.subspan(i + 1), b[j]))) ++j;
  return j;
}

bool coherent(std::span<const SignedIndex> a, std::size_t i, std::span<const SignedIndex> b, std::size_t j,
              std::vector<SignedIndex>& scratch) {
  scratch.assign(b.begin(), b.end());
  bool odd = false;
  for (std::size_t t = 0; t < a.size(); ++t) {
    const SignedIndex wanted = t == i ? b[j] : a[t];
    if (scratch[t] == wanted) continue;
    std::iter_swap(scratch.begin() + static_cast<std::ptrdiff_t>(t),
                   std::find(scratch.begin() + static_cast<std::ptrdiff_t>(t), scratch.end(), wanted));
    odd = !odd;
  }
  return odd;
}

void check_incidence(Examined& examined, bool oriented) {
  const ComplexData& data = examined.data;
  const std::size_t corners = examined.corners, m = data.num_cells();
  examined.neighbors = paired_facets(data.cells, corners);

  for (std::size_t at = 0; at < data.neighbors.size(); ++at) {
    const SignedIndex given = data.neighbors[at], derived = examined.neighbors[at];
    if (given == derived) continue;
    const std::size_t c = at / corners, i = at % corners;
    const std::string facet = braces(facet_vertices(examined.cell(c), i));
    const auto given_cell = static_cast<std::size_t>(given), derived_cell = static_cast<std::size_t>(derived);
    if (given < 0)
      throw Violation{
          fmt::format("neighbor {} of cell {} is missing: cell {} shares the facet {}", i, c, derived, facet),
          {c, derived_cell}};
    if (derived < 0)
      throw Violation{fmt::format("neighbor {} of cell {} is cell {}, which does not share the facet {}", i,
                                  c, given, facet),
                      {c, given_cell}};
    throw Violation{fmt::format("neighbor {} of cell {} is cell {}, but cell {} shares the facet {}", i, c,
                                given, derived, facet),
                    {c, given_cell, derived_cell}};
  }

  if (!oriented) return;
  std::vector<SignedIndex> scratch;
  for (std::size_t c = 0; c < m; ++c)
    for (std::size_t i = 0; i < corners; ++i) {
      const SignedIndex across = examined.neighbors[c * corners + i];
      if (across < 0 || static_cast<std::size_t>(across) < c) continue;
      const auto other = static_cast<std::size_t>(across);
      const auto a = examined.cell(c), b = examined.cell(other);
      if (!coherent(a, i, b, mirror(a, i, b), scratch))
        throw Violation{fmt::format("the cells {} {} and {} {} are not oriented coherently", c, braces(a),
                                    other, braces(b)),
                        {c, other}};
    }
}

namespace {

// The cells with one infinite cell per hull facet: the facet's vertices, then the infinite vertex, which is
// row n.
struct Closed {
  std::size_t num_finite, num_cells, corners, num_vertices;  // num_vertices = n + 1
  std::vector<SignedIndex> cells, neighbors;

  std::span<const SignedIndex> cell(std::size_t c) const { return {cells.data() + c * corners, corners}; }
};

Closed closed_complex(Examined& examined) {
  const ComplexData& data = examined.data;
  const std::size_t corners = examined.corners, m = data.num_cells(), k = corners - 1;
  for (std::size_t at = 0; at < examined.neighbors.size(); ++at)
    if (examined.neighbors[at] < 0) {
      examined.hull.emplace_back(at / corners, at % corners);
      const auto facet = facet_vertices(examined.cell(at / corners), at % corners);
      examined.hull_vertices.insert(examined.hull_vertices.end(), facet.begin(), facet.end());
    }
  const std::size_t h = examined.hull.size();
  if (h == 0) throw Violation{"there is no hull: every facet is shared by two cells"};
  if (k == 0 && h > 1) throw Violation{"an affine dimension of 0 allows one cell only", {0, 1}};
  if (m + h > static_cast<std::size_t>(max_index))
    throw Error(Errc::too_many,
                fmt::format("delone::check: {} cells and {} hull facets are too many for this build", m, h));

  if (k > 0) examined.hull_neighbors = paired_facets(examined.hull_vertices, k, examined.hull);
  Closed closed{m, m + h, corners, data.num_points() + 1, data.cells, examined.neighbors};
  std::size_t infinite = m;
  for (SignedIndex& neighbor : closed.neighbors)
    if (neighbor < 0) neighbor = static_cast<SignedIndex>(infinite++);
  for (std::size_t facet = 0; facet < h; ++facet) {
    for (std::size_t i = 0; i < k; ++i) {
      const SignedIndex across = examined.hull_neighbors[facet * k + i];
      if (across < 0) {
        const auto ridge = facet_vertices(examined.hull_facet(facet), i);
        throw Violation{fmt::format("the hull has an edge: only one hull facet, of cell {}, has the ridge {}",
                                    examined.hull[facet].first, braces(ridge)),
                        {examined.hull[facet].first}};
      }
      closed.cells.push_back(examined.hull_vertices[facet * k + i]);
      closed.neighbors.push_back(static_cast<SignedIndex>(m + static_cast<std::size_t>(across)));
    }
    closed.cells.push_back(static_cast<SignedIndex>(data.num_points()));
    closed.neighbors.push_back(static_cast<SignedIndex>(examined.hull[facet].first));
  }
  return closed;
}

void check_connected(const Closed& closed) {
  std::vector<bool> reached(closed.num_cells, false);
  std::vector<std::size_t> waiting{0};
  reached[0] = true;
  for (std::size_t count = 1; !waiting.empty();) {
    cancellation_point();
    const std::size_t c = waiting.back();
    waiting.pop_back();
    for (std::size_t i = 0; i < closed.corners; ++i) {
      const auto next = static_cast<std::size_t>(closed.neighbors[c * closed.corners + i]);
      if (reached[next]) continue;
      reached[next] = true;
      waiting.push_back(next);
      ++count;
    }
    if (waiting.empty() && count < closed.num_cells) {
      const auto other =
          static_cast<std::size_t>(std::find(reached.begin(), reached.end(), false) - reached.begin());
      throw Violation{fmt::format("the complex falls apart: cell {} cannot be reached from cell 0", other),
                      {0, other}};
    }
  }
}

// Counts faces of dimension 0…k of the closed complex, all of them and those with the infinite vertex. A face
// is counted at its lowest vertex, while the star of that vertex is at hand. Vertices, edges, facets and
// cells cost nothing extra; the dimensions 2…k−2 need k ≤ 6, and numbers of neighbors that fit the bits.
class FaceCounter {
 public:
  static constexpr int max_dimension = 6;
  static constexpr std::size_t max_faces = 50'000'000;

  explicit FaceCounter(const Closed& closed)
      : closed_(closed),
        k_(static_cast<int>(closed.corners) - 1),
        all_(closed.corners, 0),
        infinite_(closed.corners, 0),
        faces_(closed.corners),
        seen_(closed.num_vertices, -1),
        local_(closed.num_vertices, 0) {
    // 2^(k+1) is the number of subsets of a cell; in spheres of these dimensions faces are shared by four
    // cells and more.
    complete_ =
        k_ <= max_dimension && (k_ <= 3 || closed.num_cells * (std::size_t{1} << (k_ + 1)) / 4 <= max_faces);
  }

  void add_star(SignedIndex vertex, std::span<const std::size_t> star) {
    if (!complete_) return;
    const auto infinite = static_cast<SignedIndex>(closed_.num_vertices - 1);
    ++all_[0];
    infinite_[0] += vertex == infinite;
    if (k_ < 3) return;
    const unsigned bits = k_ < 4 ? 64 : 64 / static_cast<unsigned>(k_ - 2);
    for (auto& faces : faces_) faces.clear();
    std::uint64_t num_local = 1;  // the local number 0 is that of the infinite vertex
    for (const std::size_t c : star) {
      others_.clear();
      for (const SignedIndex other : closed_.cell(c)) {
        if (other <= vertex) continue;
        const auto at = static_cast<std::size_t>(other);
        if (seen_[at] != vertex) {
          seen_[at] = vertex;
          local_[at] = other == infinite ? 0 : num_local++;
          ++all_[1];
          infinite_[1] += other == infinite;
        }
        others_.push_back(local_[at]);
      }
      if (k_ >= 4) add_subsets(bits);
    }
    if (bits < 64 && (num_local >> bits) != 0) complete_ = false;
    for (std::size_t size = 2; size + 1 < closed_.corners - 1; ++size) {
      auto& faces = faces_[size];
      std::sort(faces.begin(), faces.end());
      const auto last = std::unique(faces.begin(), faces.end());
      all_[size] += static_cast<std::size_t>(last - faces.begin());
      // Subsets are packed in increasing order: the infinite vertex, number 0, leaves the highest digit
      // empty.
      const std::uint64_t finite_from = std::uint64_t{1} << (bits * (size - 1));
      infinite_[size] +=
          static_cast<std::size_t>(std::lower_bound(faces.begin(), last, finite_from) - faces.begin());
    }
  }

  // Throws unless the characteristics are those of spheres of dimension k, and k−1 for the hull.
  void finish() {
    if (!complete_) return;
    const auto k = static_cast<std::size_t>(k_), infinite_cells = closed_.num_cells - closed_.num_finite;
    if (k >= 2) {
      all_[k - 1] = closed_.num_cells * (k + 1) / 2;
      infinite_[k - 1] = infinite_cells * k / 2;
    }
    if (k >= 1) {
      all_[k] = closed_.num_cells;
      infinite_[k] = infinite_cells;
    }
    expect(all_, k_, "the complex with its infinite cells");
    if (k >= 1) expect({infinite_.begin() + 1, infinite_.end()}, k_ - 1, "the hull");
  }

 private:
  void add_subsets(unsigned bits) {
    std::sort(others_.begin(), others_.end());
    for (unsigned subset = 1; subset < (1u << others_.size()); ++subset) {
      const auto size = static_cast<std::size_t>(std::popcount(subset));
      if (size < 2 || size + 2 > static_cast<std::size_t>(k_)) continue;
      std::uint64_t packed = 0;
      for (std::size_t i = 0; i < others_.size(); ++i)
        if ((subset >> i) & 1) packed = (packed << bits) | others_[i];
      faces_[size].push_back(packed);
    }
  }

  static void expect(const std::vector<std::size_t>& counts, int dimension, const char* what) {
    std::ptrdiff_t characteristic = 0;
    for (std::size_t j = counts.size(); j-- > 0;)
      characteristic = static_cast<std::ptrdiff_t>(counts[j]) - characteristic;
    const std::ptrdiff_t sphere = dimension % 2 == 0 ? 2 : 0;
    if (characteristic != sphere)
      throw Violation{fmt::format("{} has the Euler characteristic {}, a sphere of dimension {} has {}", what,
                                  characteristic, dimension, sphere)};
  }

  const Closed& closed_;
  int k_;
  bool complete_ = true;
  std::vector<std::size_t> all_, infinite_;        // by dimension
  std::vector<std::vector<std::uint64_t>> faces_;  // at the present vertex, by number of further vertices
  std::vector<SignedIndex> seen_;
  std::vector<std::uint64_t> local_, others_;
};

}  // namespace

void check_sphere(Examined& examined) {
  if (examined.data.num_cells() == 0) throw Violation{"there is no cell"};
  const Closed closed = closed_complex(examined);
  check_connected(closed);

  const std::size_t corners = closed.corners;
  std::vector<std::size_t> star_size(closed.num_vertices, 0), incident(closed.num_vertices, 0);
  for (std::size_t at = 0; at < closed.cells.size(); ++at) {
    cancellation_point();
    ++star_size[static_cast<std::size_t>(closed.cells[at])];
    incident[static_cast<std::size_t>(closed.cells[at])] = at / corners;
  }
  FaceCounter faces(closed);
  std::vector<SignedIndex> reached_from(closed.num_cells, -1);
  std::vector<std::size_t> star;
  for (std::size_t v = 0; v < closed.num_vertices; ++v) {
    if (star_size[v] == 0) continue;
    const auto vertex = static_cast<SignedIndex>(v);
    star.assign(1, incident[v]);
    reached_from[incident[v]] = vertex;
    for (std::size_t next = 0; next < star.size(); ++next) {
      const std::size_t first = star[next] * corners;
      for (std::size_t i = 0; i < corners; ++i) {
        const auto other = static_cast<std::size_t>(closed.neighbors[first + i]);
        if (closed.cells[first + i] == vertex || reached_from[other] == vertex) continue;
        reached_from[other] = vertex;
        star.push_back(other);
      }
    }
    if (star.size() != star_size[v]) {
      if (v + 1 == closed.num_vertices)
        throw Violation{
            fmt::format("the hull falls apart: {} of its {} facets are reached from one of cell {}",
                        star.size(), star_size[v], examined.hull[incident[v] - closed.num_finite].first)};
      throw Violation{
          fmt::format("the cells around the vertex {} fall apart: {} of {} are reached from one of them", v,
                      star.size(), star_size[v]),
          star.front() < closed.num_finite ? std::vector{star.front()} : std::vector<std::size_t>{},
          {v}};
    }
    faces.add_star(vertex, star);
  }
  faces.finish();
}

}  // namespace delone::internal
