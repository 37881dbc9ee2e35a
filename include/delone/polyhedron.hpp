// SPDX-License-Identifier: BSD-3-Clause
// Exact polyhedra in any dimension: from inequalities and equations to vertices, rays and lines, and back.
#pragma once

#include <delone/complex.hpp>
#include <delone/data.hpp>
#include <delone/error.hpp>
#include <delone/export.hpp>
#include <delone/options.hpp>
#include <delone/rational.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace delone {
namespace polyhedra {
struct Description;
}

/// What a row of the input is to a polyhedron.
enum class RowKind : std::uint8_t {
  essential,  ///< the first row of a facet, a vertex or a ray: the polyhedron would be another without it
  duplicate,  ///< gives the facet, vertex or ray of an earlier row
  implicit,   ///< an inequality that holds with equality everywhere, or a ray whose opposite is a direction,
              ///< too
  redundant,  ///< all others; all inequalities of the empty set
};

/// The largest value of a linear function on a polyhedron, and where it has it.
struct DELONE_EXPORT_TYPE Optimum {
  enum class State : std::uint8_t {
    attained,
    unbounded,  ///< there is no largest value
    empty,      ///< there is no point
  };
  State state = State::empty;
  Rational value;
  /// The face at which it is attained: numbers of its vertices and rays, increasing. The lines belong to it.
  std::vector<std::size_t> vertices, rays;
};

/// The bounds of a set along each axis; none where it has no bound.
struct DELONE_EXPORT_TYPE RationalBox {
  std::vector<std::optional<Rational>> lower, upper;
};

/// A polyhedron of R^d: the points that satisfy linear inequalities and equations, or, what is the same, the
/// convex hull of points plus the directions of rays and lines. It may be empty, one point, flat, unbounded,
/// contain lines, or be the whole space; d may be 0.
///
/// Both descriptions are minimal and canonical, so that equal sets have equal ones. Rows are integers without
/// a common divisor. Equations and lines are those of the reduced echelon form; inequalities have zeros where
/// equations have their first entries, and vertices and rays where lines have theirs. So a polyhedron with
/// lines has "vertices" that stand for its minimal faces. Vertices are sorted by their coordinates, other
/// rows lexicographically.
///
/// Method: the double description method (Motzkin et al. 1953; Fukuda and Prodon,
/// doi:10.1007/3-540-61576-8_77), or in few dimensions the insertion of points, if that ends first. Integers
/// have 64 bits, 128, or any size, as needed. Signs of products are certified in binary64 first.
/// Nothing is rounded but what is returned as doubles.
///
/// A Polyhedron does not change, and copies share it; `const` members may be called from several threads
/// at once. What makes one throws Errc::cancelled, too_many, out_of_memory and time_limit; of the options
/// threads, progress, memory_limit and time_limit count. Members with rows throw Errc::bad_dimension for rows
/// of a wrong width.
class DELONE_EXPORT Polyhedron {
 public:
  /// The empty set of R^0.
  Polyhedron();

  /// {x : a·x ≤ b for each row (a, b) of `inequalities`, a·x = b for each row of `equations`}. Rows may be
  /// redundant, duplicate, or contradict each other. Throws Errc::bad_dimension unless rows have d+1 entries.
  static Polyhedron from_inequalities(const RationalRows& inequalities, const RationalRows& equations,
                                      int dimension, const Options& options = {});
  /// The convex hull of the vertices, plus all sums of nonnegative multiples of the rays and of any multiples
  /// of the lines. Any of them may be redundant or duplicate. Without vertices, and with rays or lines, the
  /// origin is a vertex: a cone. Throws Errc::bad_dimension unless rows have d entries.
  static Polyhedron from_generators(const RationalRows& vertices, const RationalRows& rays,
                                    const RationalRows& lines, int dimension, const Options& options = {});
  /// The empty set, and the whole space. Throw Errc::bad_dimension for a negative dimension.
  static Polyhedron empty(int dimension);
  static Polyhedron space(int dimension);

  int dimension() const;  ///< d
  /// That of the affine hull; −1 for the empty set.
  int affine_dimension() const;
  bool is_empty() const;
  bool is_bounded() const;  ///< without rays and lines
  std::size_t num_vertices() const;
  std::size_t num_rays() const;
  std::size_t num_lines() const;         ///< the dimension of the lineality space
  std::size_t num_inequalities() const;  ///< the number of facets
  std::size_t num_equations() const;     ///< d − affine_dimension(); 1 for the empty set

  RationalRows vertices() const;  ///< d coordinates each
  /// d+1 integers each: numerators and their common denominator, without a common divisor.
  RationalRows vertex_integers() const;
  RationalRows rays() const;          ///< d integers each
  RationalRows lines() const;         ///< d integers each: a basis of the lineality space
  RationalRows inequalities() const;  ///< d+1 integers (a, b) each, for a·x ≤ b: one for each facet
  RationalRows equations() const;     ///< d+1 integers (a, b) each, for a·x = b: those of the affine hull

  /// The facets that a vertex lies on, and those that contain a ray, increasing. Throw
  /// Errc::invalid_argument unless there is such a vertex or ray.
  std::vector<std::size_t> facets_of_vertex(std::size_t vertex) const;
  std::vector<std::size_t> facets_of_ray(std::size_t ray) const;
  /// The vertices, and the rays, of a facet, increasing. Throw the same.
  std::vector<std::size_t> vertices_of_facet(std::size_t facet) const;
  std::vector<std::size_t> rays_of_facet(std::size_t facet) const;
  /// Pairs of vertices that are joined by a bounded edge; increasing, the smaller one first.
  std::vector<std::pair<std::size_t, std::size_t>> adjacent_vertices() const;
  /// Pairs of facets whose intersection is a ridge: a face of one dimension less, which has a point.
  std::vector<std::pair<std::size_t, std::size_t>> adjacent_facets() const;
  /// f_0 … f_(k−1), the numbers of faces of each dimension, k = affine_dimension(). With l lines there are
  /// none of dimensions below l. The cost is that of listing all faces.
  std::vector<std::size_t> f_vector() const;

  /// The kind of each inequality, or of each vertex and then each ray, of the call that made this polyhedron;
  /// empty for one that an operation has made.
  const std::vector<RowKind>& row_kinds() const;
  /// The rows of these that are duplicate or redundant: all may be left out at once. None if this is the
  /// empty set, where each row alone may be redundant.
  std::vector<std::size_t> redundant_rows() const;

  /// The d-dimensional volume, exact: 0 if the affine dimension is less than d; nothing if it is infinite.
  /// The 0-dimensional volume of a point is 1. The cost is at most that of listing all faces.
  std::optional<Rational> volume() const;
  /// The smallest box that contains it. Nothing for the empty set.
  std::optional<RationalBox> bounding_box() const;
  /// The smallest box with integer corners that contains it.
  std::optional<RationalBox> integer_bounding_box() const;

  bool contains(std::span<const Rational> point) const;
  bool includes(const Polyhedron& other) const;  ///< whether each point of `other` is in this one
  /// The largest value of c·x, and where it is attained.
  Optimum maximize(std::span<const Rational> c) const;
  Optimum minimize(std::span<const Rational> c) const;  ///< the smallest value

  Polyhedron intersection(const Polyhedron& other, const Options& options = {}) const;
  /// The smallest polyhedron that contains both; it is closed.
  Polyhedron convex_union(const Polyhedron& other, const Options& options = {}) const;
  Polyhedron minkowski_sum(const Polyhedron& other, const Options& options = {}) const;
  Polyhedron product(const Polyhedron& other) const;  ///< {(x, y)} in R^(d+e)
  /// {y : x·y ≤ 1 for each x of this one}.
  Polyhedron polar(const Options& options = {}) const;
  /// Keeps the coordinates `axes`, in this order. Throws Errc::invalid_argument for an axis that does
  /// not exist or appears twice.
  Polyhedron projection(std::span<const int> axes, const Options& options = {}) const;
  /// {M·x + t}: `matrix` has d columns, and `translation` is empty or has as many entries as M has rows. A
  /// matrix without rows gives a polyhedron of R^0.
  Polyhedron image(const RationalRows& matrix, std::span<const Rational> translation = {},
                   const Options& options = {}) const;
  /// {y : M·y + t is in this one}: `matrix` has d rows of e entries, `translation` none or d. `dimension`: e,
  /// which the matrix does not tell for d = 0.
  Polyhedron preimage(const RationalRows& matrix, int dimension, std::span<const Rational> translation = {},
                      const Options& options = {}) const;

  /// Depends on the set alone.
  CanonicalHash hash() const;
  /// Whether two are the same set.
  DELONE_EXPORT friend bool operator==(const Polyhedron& a, const Polyhedron& b);

 private:
  struct DELONE_HIDDEN Impl;
  explicit Polyhedron(std::shared_ptr<const Impl> impl);
  static Polyhedron of(polyhedra::Description description, std::vector<RowKind> kinds = {});

  std::shared_ptr<const Impl> impl_;
};

/// The polyhedron of the halfspaces of an intersection, whatever its state: flat ones, too, have vertices,
/// rays, lines and equations there. Throws Errc::invalid_argument if the data are without halfspaces,
/// otherwise as Polyhedron::from_inequalities().
DELONE_EXPORT Polyhedron to_polyhedron(const IntersectionData& intersection, const Options& options = {});
/// The polyhedron of the extreme points of a hull. With a tolerance, these are the vertices of its cells.
/// Throws Errc::invalid_argument if the data are without points, otherwise as Polyhedron::from_generators().
DELONE_EXPORT Polyhedron to_polyhedron(const HullData& hull, const Options& options = {});

/// What several polyhedra of a list have in common.
struct DELONE_EXPORT_TYPE PolyhedraIntersection {
  std::vector<std::size_t> members;  ///< numbers in the list, increasing, at least two
  Polyhedron polyhedron;
};

/// The intersections of two or more of the polyhedra, if they have full affine dimension d: first of two,
/// then of three, and so on, each number of members in lexicographic order. `most_members`: 2 finds pairs
/// alone; 0 is no limit. n polyhedra that all have a common part have 2^n − n − 1 of them. Throws
/// Errc::bad_dimension unless all have the same d, otherwise as what makes a Polyhedron.
DELONE_EXPORT std::vector<PolyhedraIntersection> intersections(std::span<const Polyhedron> polyhedra,
                                                               std::size_t most_members = 0,
                                                               const Options& options = {});

/// The d-dimensional volume of the union, exact; nothing if it is infinite, 0 without polyhedra. Each
/// polyhedron adds what the earlier ones do not have: its volume less that of the union of its intersections
/// with them. Intersections within others, and those without volume, are left out. Cost: that of the
/// remaining ones, which are 2^n if all polyhedra have a common part and nothing is left out. Throws as
/// intersections().
DELONE_EXPORT std::optional<Rational> union_volume(std::span<const Polyhedron> polyhedra,
                                                   const Options& options = {});

}  // namespace delone
