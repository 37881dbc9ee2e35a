// SPDX-License-Identifier: BSD-3-Clause
// The levels of check() of a triangulation and what they hand to each other.
#pragma once

#include "check/levels.hpp"
#include "kernel/flat.hpp"

#include <delone/check.hpp>
#include <delone/data.hpp>

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace delone::internal {

/// What points are lifted to: their cells are the lower hull of that.
enum class Lift {
  paraboloid,  ///< |x|², less the weight if there are weights: no point is inside the sphere of a cell
  inverted,    ///< −|x|²: no point is outside the sphere of a cell
  heights,     ///< what stands in the place of weights: points are compositions
};

/// The cells, plus what the topological stages derive from them.
struct Examined {
  const ComplexData& data;
  std::size_t corners;  ///< k+1, vertices of a cell
  Lift lift = Lift::paraboloid;
  unsigned threads = 1;  ///< as Execution::threads
  /// For weighted points: each point and then its weight. Filled after level 1.
  std::vector<double> weighted_rows{};

  /// Filled by level 2, from the cells alone: m×(k+1), −1 beyond the hull.
  std::vector<SignedIndex> neighbors{};
  /// Filled by level 3: the hull facets as (cell, opposite vertex), their k vertices each, in the order they
  /// have in the cell, and for each of those vertices the hull facet across the ridge opposite to it.
  std::vector<std::pair<std::size_t, std::size_t>> hull{};
  std::vector<SignedIndex> hull_vertices{}, hull_neighbors{};

  std::span<const SignedIndex> cell(std::size_t c) const {
    return {data.cells.data() + c * corners, corners};
  }
  std::span<const SignedIndex> hull_facet(std::size_t h) const {
    return {hull_vertices.data() + h * (corners - 1), corners - 1};
  }
  bool weighted() const { return !data.weights.empty(); }
  bool furthest() const { return lift == Lift::inverted; }
  /// Whether points may be neither vertices nor equal to one.
  bool may_hide() const { return weighted() || furthest(); }
  kernel::RowForm form() const {
    return furthest()   ? kernel::RowForm::furthest_point
           : weighted() ? kernel::RowForm::weighted_point
                        : kernel::RowForm::point;
  }
  std::size_t row_size() const { return static_cast<std::size_t>(data.dimension) + (weighted() ? 1 : 0); }
  /// The coordinates of a point, and its weight if it has one.
  const double* point(SignedIndex row) const {
    return (weighted() ? weighted_rows : data.points).data() + static_cast<std::size_t>(row) * row_size();
  }
};

/// Cells, facets or rows that one thread examines at a time; levels that take them in the order of their
/// numbers find the same first violation for every number of threads.
inline constexpr std::size_t part_of_check = 4096;

/// A set of points for a message: "{3, 17, 20}".
std::string braces(std::span<const SignedIndex> rows);
/// A facet for a message: the vertices of a cell but one.
std::vector<SignedIndex> facet_vertices(std::span<const SignedIndex> cell, std::size_t opposite);

/// For the message of a violation that a part of a triangulation has at this level though nothing is wrong.
/// Empty for data that say what they are.
std::string no_fault_of_a_part(const ComplexData& data, int level);

/// Pairs equal facets: for each of the m·corners facets (cell, opposite vertex) the cell on its other side,
/// or −1. Vertex sets are hashed, then compared exactly; expected O(m·corners²). Throws Violation when three
/// cells share a facet. For the facets of a hull, which share ridges, `hull` translates them into cells for
/// the message.
std::vector<SignedIndex> paired_facets(std::span<const SignedIndex> cells, std::size_t corners,
                                       const std::vector<std::pair<std::size_t, std::size_t>>& hull = {},
                                       unsigned threads = 1);

/// Whether the facets of a opposite a[i] and of b opposite b[j] have the same vertices, which are distinct in
/// each.
bool equal_facets(std::span<const SignedIndex> a, std::size_t i, std::span<const SignedIndex> b,
                  std::size_t j);
/// For cells a and b that share the facet opposite a[i]: the index j of the vertex of b opposite that facet.
std::size_t mirror(std::span<const SignedIndex> a, std::size_t i, std::span<const SignedIndex> b);
/// True if the permutation that turns a, with a[i] replaced by b[j], into b is odd: then a and b, which lie
/// on different sides of their common facet, are oriented alike. `scratch` saves an allocation.
bool coherent(std::span<const SignedIndex> a, std::size_t i, std::span<const SignedIndex> b, std::size_t j,
              std::vector<SignedIndex>& scratch);

/// Calls visit(c, other, are_coherent) for the two cells of each facet inside, by several threads;
/// are_coherent: coherent(). Throws what it throws for the first pair.
void for_neighbors(const Examined& examined,
                   const std::function<void(std::size_t, std::size_t, bool)>& visit);

/// What level 4 finds: the axes on which orientations were taken, and the orientation of each cell.
struct Volumes {
  std::vector<int> axes;
  std::vector<Sign> orientation;
};

/// Each point followed by its weight; nothing where points have none.
std::vector<double> weighted_rows(const ComplexData& data);

/// `may_hide`: whether rows may have no vertex though there are no weights.
void check_storage(const ComplexData& data, bool may_hide = false, unsigned threads = 1);
void check_incidence(Examined& examined, bool oriented);
void check_sphere(Examined& examined);
Volumes check_volume(const Examined& examined, bool oriented);
/// The part of the next that looks at facets between two cells; it returns the ties.
std::size_t check_inner_facets(const Examined& examined, const Volumes& volumes, bool canonical);
std::size_t check_local_convexity(const Examined& examined, const Volumes& volumes,
                                  bool canonical);  // returns the ties
/// Points that are no vertices nor equal to one must be hidden, if they may be: in the closed simplex of a
/// cell that is not in conflict with them.
void check_hidden(const Examined& examined, const Volumes& volumes, std::span<const std::size_t> rows,
                  bool canonical);
void check_completeness(const Examined& examined, const Volumes& volumes, bool canonical);

/// All six levels, under these names.
CheckReport check_lifted(const ComplexData& data, const CheckOptions& options, unsigned threads, Lift lift,
                         std::span<const CheckLevel> levels);

}  // namespace delone::internal
