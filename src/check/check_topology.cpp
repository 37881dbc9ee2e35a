// SPDX-License-Identifier: BSD-3-Clause
// Levels 2 and 3 of check(): the cells with the infinite cells added form a closed pseudomanifold, oriented,
// connected, with connected stars, and with the Euler characteristic of a sphere. No coordinate is looked at.
#include "base/parallel_parts.hpp"
#include "base/progress_meter.hpp"
#include "base/random.hpp"
#include "check/check_stages.hpp"

#include <delone/error.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <mutex>
#include <utility>

namespace delone::internal {

namespace {

bool contains(std::span<const SignedIndex> rows, SignedIndex row) {
  return std::find(rows.begin(), rows.end(), row) != rows.end();
}

}  // namespace

bool equal_facets(std::span<const SignedIndex> a, std::size_t i, std::span<const SignedIndex> b,
                  std::size_t j) {
  for (std::size_t t = 0; t < a.size(); ++t)
    if (t != i && (a[t] == b[j] || !contains(b, a[t]))) return false;
  return true;
}

namespace {

/// Pairs the facets whose keys are in one class.
class FacetPairing {
 public:
  /// Facets that share a facet are equal in `cells`; `across` gets the cells. `count`: of the facets to come.
  FacetPairing(std::span<const SignedIndex> cells, std::size_t corners, std::vector<SignedIndex>& across,
               std::size_t count)
      : cells_(cells),
        corners_(corners),
        across_(across),
        // A sphere fills half of the table at most; a heap of unrelated cells still leaves one place empty.
        table_(std::bit_ceil(count + 1)) {}

  /// Returns the facet equal to this one that was added first, if two were added already; or none.
  std::size_t add(std::size_t facet, std::uint64_t key) {
    const std::size_t mask = table_.size() - 1, cell = facet / corners_;
    std::size_t at = key & mask;
    for (; table_[at].facet != 0; at = (at + 1) & mask) {
      if (table_[at].key != key) continue;
      const std::size_t first = table_[at].facet - 1, other = first / corners_;
      if (!equal_facets(cells_.subspan(cell * corners_, corners_), facet % corners_,
                        cells_.subspan(other * corners_, corners_), first % corners_))
        continue;
      if (across_[first] >= 0) return first;
      across_[first] = static_cast<SignedIndex>(cell);
      across_[facet] = static_cast<SignedIndex>(other);
      return none;
    }
    table_[at] = {key, facet + 1};
    return none;
  }
  static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

 private:
  struct Place {
    std::uint64_t key = 0;
    std::size_t facet = 0;  // 1 + cell·corners + i; 0 is an empty place
  };
  std::span<const SignedIndex> cells_;
  std::size_t corners_;
  std::vector<SignedIndex>& across_;
  std::vector<Place> table_;
};

/// Calls each(facet, key) for the facets of a cell; equal facets have equal keys.
template <class Each>
void for_facet_keys(std::span<const SignedIndex> cells, std::size_t corners, std::size_t cell, Each each) {
  const auto a = cells.subspan(cell * corners, corners);
  std::uint64_t total = 0;
  for (const SignedIndex row : a) total += random::mix(static_cast<std::uint64_t>(row) + 1);
  for (std::size_t i = 0; i < corners; ++i)
    each(cell * corners + i, random::mix(total - random::mix(static_cast<std::uint64_t>(a[i]) + 1)));
}

/// The first facet, in the order of their numbers, that two earlier ones are equal to, and the first of
/// these. Threads pair one class of keys each, so that they share no table.
std::pair<std::size_t, std::size_t> pair_facets(std::span<const SignedIndex> cells, std::size_t corners,
                                                unsigned threads, std::vector<SignedIndex>& across) {
  constexpr std::size_t none = FacetPairing::none;
  const std::size_t m = cells.size() / corners, classes = threads_for_parts(threads, m / part_of_check);
  if (classes == 1) {
    FacetPairing pairing(cells, corners, across, cells.size());
    std::pair<std::size_t, std::size_t> third{none, none};
    for (std::size_t c = 0; c < m && third.first == none; ++c) {
      cancellation_point();
      for_facet_keys(cells, corners, c, [&](std::size_t facet, std::uint64_t key) {
        if (third.first != none) return;
        const std::size_t first = pairing.add(facet, key);
        if (first != none) third = {facet, first};
      });
    }
    return third;
  }
  std::vector<std::uint64_t> keys(cells.size());
  for_parts(threads, m, part_of_check, [&](std::size_t first, std::size_t last, const StopPoint& stop) {
    stop();
    for (std::size_t c = first; c < last; ++c)
      for_facet_keys(cells, corners, c, [&](std::size_t facet, std::uint64_t key) { keys[facet] = key; });
  });
  // The lowest bits are places in the tables.
  const auto class_of = [&](std::uint64_t key) { return (key >> 32) * classes >> 32; };
  std::vector<std::pair<std::size_t, std::size_t>> thirds(classes, {none, none});
  run_workers(static_cast<unsigned>(classes), [&](unsigned worker) {
    std::size_t count = 0;
    for (const std::uint64_t key : keys) count += class_of(key) == worker ? 1 : 0;
    FacetPairing pairing(cells, corners, across, count);
    for (std::size_t facet = 0; facet < keys.size(); ++facet) {
      if (class_of(keys[facet]) != worker) continue;
      const std::size_t first = pairing.add(facet, keys[facet]);
      if (first == none) continue;
      thirds[worker] = {facet, first};
      return;
    }
  });
  return *std::min_element(thirds.begin(), thirds.end());
}

}  // namespace

std::vector<SignedIndex> paired_facets(std::span<const SignedIndex> cells, std::size_t corners,
                                       const std::vector<std::pair<std::size_t, std::size_t>>& hull,
                                       unsigned threads) {
  std::vector<SignedIndex> across(cells.size(), -1);
  const auto [facet, first] = pair_facets(cells, corners, threads, across);
  if (facet == FacetPairing::none) return across;
  std::vector<std::size_t> three{first / corners, static_cast<std::size_t>(across[first]), facet / corners};
  if (!hull.empty())
    for (std::size_t& facet_of_hull : three) facet_of_hull = hull[facet_of_hull].first;
  throw Violation{
      fmt::format("{}the cells {}, {} and {} share the {} {}", hull.empty() ? "" : "hull facets of ",
                  three[0], three[1], three[2], hull.empty() ? "facet" : "ridge",
                  braces(facet_vertices(cells.subspan(facet / corners * corners, corners), facet % corners))),
      three};
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

void for_neighbors(const Examined& examined,
                   const std::function<void(std::size_t, std::size_t, bool)>& visit) {
  const std::size_t corners = examined.corners;
  for_parts(examined.threads, examined.neighbors.size(), part_of_check,
            [&](std::size_t first, std::size_t last, const StopPoint& stop) {
              stop();
              std::vector<SignedIndex> scratch;
              for (std::size_t at = first; at < last; ++at) {
                const std::size_t c = at / corners, i = at % corners;
                const SignedIndex across = examined.neighbors[at];
                if (across < 0 || static_cast<std::size_t>(across) < c) continue;
                const auto other = static_cast<std::size_t>(across);
                const auto a = examined.cell(c), b = examined.cell(other);
                visit(c, other, coherent(a, i, b, mirror(a, i, b), scratch));
              }
            });
}

void check_incidence(Examined& examined, bool oriented) {
  const ComplexData& data = examined.data;
  const std::size_t corners = examined.corners;
  examined.neighbors = paired_facets(data.cells, corners, {}, examined.threads);

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
  for_neighbors(examined, [&](std::size_t c, std::size_t other, bool are_coherent) {
    if (!are_coherent)
      throw Violation{fmt::format("the cells {} {} and {} {} are not oriented coherently", c,
                                  braces(examined.cell(c)), other, braces(examined.cell(other))),
                      {c, other}};
  });
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

  if (k > 0)
    examined.hull_neighbors = paired_facets(examined.hull_vertices, k, examined.hull, examined.threads);
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

  // Adds the counts to those of another counter, and resets them.
  void move_counts_to(FaceCounter& sum) {
    sum.complete_ = sum.complete_ && complete_;
    for (std::size_t j = 0; j < all_.size(); ++j) {
      sum.all_[j] += std::exchange(all_[j], 0);
      sum.infinite_[j] += std::exchange(infinite_[j], 0);
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

/// The cells around one vertex after the other.
class Stars {
 public:
  explicit Stars(const Closed& closed) : closed_(closed), reached_from_(closed.num_cells, -1) {}

  /// Those that are reached from one of them.
  const std::vector<std::size_t>& reached(SignedIndex vertex, std::size_t cell) {
    star_.assign(1, cell);
    reached_from_[cell] = vertex;
    for (std::size_t next = 0; next < star_.size(); ++next) {
      const std::size_t first = star_[next] * closed_.corners;
      for (std::size_t i = 0; i < closed_.corners; ++i) {
        const auto other = static_cast<std::size_t>(closed_.neighbors[first + i]);
        if (closed_.cells[first + i] == vertex || reached_from_[other] == vertex) continue;
        reached_from_[other] = vertex;
        star_.push_back(other);
      }
    }
    return star_;
  }

 private:
  const Closed& closed_;
  std::vector<SignedIndex> reached_from_;
  std::vector<std::size_t> star_;
};

}  // namespace

void check_sphere(Examined& examined) {
  if (examined.data.num_cells() == 0) throw Violation{"there is no cell"};
  const Closed closed = closed_complex(examined);

  const std::size_t corners = closed.corners;
  std::vector<std::size_t> star_size(closed.num_vertices, 0), incident(closed.num_vertices, 0);
  for (std::size_t at = 0; at < closed.cells.size(); ++at) {
    cancellation_point();
    ++star_size[static_cast<std::size_t>(closed.cells[at])];
    incident[static_cast<std::size_t>(closed.cells[at])] = at / corners;
  }
  FaceCounter faces(closed);
  std::mutex mutex;
  constexpr std::size_t vertices_in_part = 1024;
  // The first part is whether the complex is connected: a question for one thread.
  const std::size_t num_parts = 1 + (closed.num_vertices + vertices_in_part - 1) / vertices_in_part;
  const auto make_work = [&] {
    return [&, own = FaceCounter(closed), stars = Stars(closed)](std::size_t part, std::size_t,
                                                                 const StopPoint& stop) mutable {
      if (part == 0) return check_connected(closed);
      const std::size_t end = std::min(part * vertices_in_part, closed.num_vertices);
      for (std::size_t v = (part - 1) * vertices_in_part; v < end; ++v) {
        if (star_size[v] == 0) continue;
        stop();
        const std::vector<std::size_t>& star = stars.reached(static_cast<SignedIndex>(v), incident[v]);
        if (star.size() != star_size[v]) {
          if (v + 1 == closed.num_vertices)
            throw Violation{
                fmt::format("the hull falls apart: {} of its {} facets are reached from one of cell {}",
                            star.size(), star_size[v], examined.hull[incident[v] - closed.num_finite].first)};
          throw Violation{
              fmt::format("the cells around the vertex {} fall apart: {} of {} are reached from one of them",
                          v, star.size(), star_size[v]),
              star.front() < closed.num_finite ? std::vector{star.front()} : std::vector<std::size_t>{},
              {v}};
        }
        own.add_star(static_cast<SignedIndex>(v), star);
      }
      const std::lock_guard lock(mutex);
      own.move_counts_to(faces);
    };
  };
  work_in_parts(examined.threads, num_parts, 1, make_work);
  faces.finish();
}

}  // namespace delone::internal
