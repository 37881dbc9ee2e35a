// SPDX-License-Identifier: BSD-3-Clause
// Polyhedron: how it is made, and what it says about its two descriptions.
#include "base/random.hpp"
#include "base/require_dimension.hpp"
#include "polyhedra/adjacency.hpp"
#include "polyhedra/fraction.hpp"
#include "polyhedra/polyhedron_impl.hpp"

#include <delone/polyhedron.hpp>

#include <algorithm>
#include <string>

namespace delone {

using polyhedra::BitRows;
using polyhedra::ConstBits;
using polyhedra::Description;
using polyhedra::Fraction;
using polyhedra::Integer;
using polyhedra::Row;
using polyhedra::Rows;

namespace {

using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

std::size_t checked(int dimension) {
  if (dimension < 0) throw Error(Errc::bad_dimension, "the dimension must be at least 0");
  if (dimension > 0) internal::require_dimension(dimension);
  return static_cast<std::size_t>(dimension);
}

void require_width(const RationalRows& rows, std::size_t width, const char* what) {
  if (!rows.empty() && rows.width() != width)
    throw Error(Errc::bad_dimension, std::string(what) + " have " + std::to_string(rows.width()) +
                                         " entries, not " + std::to_string(width));
}

/// a·x ≤ b as −a·x + b·x_0 ≥ 0.
Rows homogeneous_inequalities(const RationalRows& rows) {
  Rows result;
  result.reserve(rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    internal::cancellation_point();
    Row row = polyhedra::common_integers(rows[i]);
    row.pop_back();
    for (std::size_t c = 0; c + 1 < row.size(); ++c) row[c] = -row[c];
    result.push_back(std::move(row));
  }
  return result;
}

void append_points(const RationalRows& points, Rows& rows) {
  for (std::size_t i = 0; i < points.size(); ++i) {
    internal::cancellation_point();
    rows.push_back(polyhedra::common_integers(points[i]));
  }
}

void append_directions(const RationalRows& directions, Rows& rows) {
  for (std::size_t i = 0; i < directions.size(); ++i) {
    internal::cancellation_point();
    rows.push_back(polyhedra::common_integers(directions[i]));
    rows.back().back() = 0;
  }
}

/// The first entries of a row, and of an inequality (a, b) those with the sign that they have to the left.
RationalRows to_public(const Rows& rows, std::size_t first, std::size_t last, std::size_t width,
                       bool negates) {
  std::vector<Rational> entries;
  entries.reserve((last - first) * width);
  for (std::size_t i = first; i < last; ++i) {
    internal::cancellation_point();
    for (std::size_t c = 0; c < width; ++c) {
      const bool is_negated = negates && c + 1 < width;
      entries.push_back(Fraction::to_rational(is_negated ? Integer(-rows[i][c]) : rows[i][c]));
    }
  }
  if (width > 0) return {std::move(entries), width};
  RationalRows none;  // of R^0
  for (std::size_t i = first; i < last; ++i) none.push_back({});
  return none;
}

std::vector<std::size_t> numbers_of(ConstBits set, std::size_t first, std::size_t last) {
  std::vector<std::size_t> numbers;
  polyhedra::for_each(set, [&](std::size_t i) {
    if (i >= first && i < last) numbers.push_back(i - first);
  });
  return numbers;
}

void require_number(std::size_t i, std::size_t count, const char* what) {
  if (i >= count)
    throw Error(Errc::invalid_argument, "there is no " + std::string(what) + " " + std::to_string(i));
}

/// The adjacent rays of a cone among `sets`, which are the rows that its rays lie on.
template <class Keep>
Pairs adjacent_pairs(const BitRows& sets, std::size_t width, std::size_t cone_dimension, Keep keep) {
  Pairs pairs;
  if (cone_dimension < 2) return pairs;
  polyhedra::Adjacency adjacency;
  adjacency.reset(sets.size(), width, cone_dimension);
  for (std::size_t i = 0; i < sets.size(); ++i)
    std::copy(sets[i].begin(), sets[i].end(), adjacency.rows(i).begin());
  const auto add = [&](std::uint32_t i, std::uint32_t j) {
    if (keep(i, j)) pairs.emplace_back(std::min(i, j), std::max(i, j));
  };
  for (const auto& [i, j] : adjacency.join_simple_rays()) add(i, j);
  adjacency.compare([](std::uint32_t i) { return i; }, keep, add);
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

void add_word_to_hash(std::uint64_t word, CanonicalHash& hash) {
  hash.high = random::mix(hash.high + 0x9e3779b97f4a7c15u + word);
  hash.low = random::mix((hash.low ^ word) + 0xd1342543de82ef95u);
}

/// Adds the digits of a number to a hash: words of 64 bits, and a last one with their number and the sign.
void add_to_hash(const Integer& x, CanonicalHash& hash) {
  std::uint64_t num_words = 1;
  if (x.backend().size() == 1) {
    add_word_to_hash(x.backend().limbs()[0], hash);
  } else {
    std::vector<std::uint64_t> words;
    boost::multiprecision::export_bits(boost::multiprecision::abs(x), std::back_inserter(words), 64);
    for (const std::uint64_t word : words) add_word_to_hash(word, hash);
    num_words = words.size();
  }
  add_word_to_hash(2 * num_words + (x < 0 ? 1 : 0), hash);
}

}  // namespace

Polyhedron::Polyhedron(std::shared_ptr<const Impl> impl) : impl_(std::move(impl)) {}
Polyhedron::Polyhedron() : Polyhedron(empty(0)) {}

Polyhedron Polyhedron::of(Description description, std::vector<RowKind> kinds) {
  return internal::guarded("the polyhedron", [&] {
    return Polyhedron(std::make_shared<const Impl>(std::move(description), std::move(kinds)));
  });
}

Polyhedron Polyhedron::from_inequalities(const RationalRows& inequalities, const RationalRows& equations,
                                         int dimension, const Options& options) {
  const std::size_t d = checked(dimension);
  require_width(inequalities, d + 1, "inequalities");
  require_width(equations, d + 1, "equations");
  return polyhedra::within_limits(options, [&] {
    std::vector<RowKind> kinds;
    Description description =
        polyhedra::from_inequalities(homogeneous_inequalities(inequalities),
                                     homogeneous_inequalities(equations), d, &kinds, options.threads);
    return of(std::move(description), std::move(kinds));
  });
}

Polyhedron Polyhedron::from_generators(const RationalRows& vertices, const RationalRows& rays,
                                       const RationalRows& lines, int dimension, const Options& options) {
  const std::size_t d = checked(dimension);
  require_width(vertices, d, "vertices");
  require_width(rays, d, "rays");
  require_width(lines, d, "lines");
  return polyhedra::within_limits(options, [&] {
    std::vector<RowKind> kinds;
    Rows generators, directions;
    append_points(vertices, generators);
    append_directions(rays, generators);
    append_directions(lines, directions);
    Description description =
        polyhedra::from_generators(std::move(generators), directions, d, &kinds, options.threads);
    return of(std::move(description), std::move(kinds));
  });
}

Polyhedron to_polyhedron(const IntersectionData& intersection, const Options& options) {
  const std::size_t width = checked(intersection.dimension) + 1;
  if (intersection.halfspaces.size() != width * intersection.num_halfspaces())
    throw Error(Errc::invalid_argument, "the data of the intersection are without halfspaces");
  std::vector<double> rows = intersection.halfspaces;  // n·x ≤ −c
  for (std::size_t i = width - 1; i < rows.size(); i += width) rows[i] = -rows[i];
  return Polyhedron::from_inequalities(RationalRows(rows, width), {}, intersection.dimension, options);
}

Polyhedron to_polyhedron(const HullData& hull, const Options& options) {
  const std::size_t d = checked(hull.dimension);
  if (hull.points.size() != d * hull.num_points())
    throw Error(Errc::invalid_argument, "the data of the hull are without points");
  std::vector<double> points;
  points.reserve(hull.vertices.size() * d);
  for (const SignedIndex row : hull.vertices) {
    const double* const point = hull.points.data() + static_cast<std::size_t>(row) * d;
    points.insert(points.end(), point, point + d);
  }
  return Polyhedron::from_generators(RationalRows(points, d), {}, {}, hull.dimension, options);
}

Polyhedron Polyhedron::empty(int dimension) {
  return internal::guarded("the polyhedron",
                           [&] { return of(polyhedra::from_generators({}, {}, checked(dimension))); });
}
Polyhedron Polyhedron::space(int dimension) {
  return internal::guarded("the polyhedron",
                           [&] { return of(polyhedra::from_inequalities({}, {}, checked(dimension))); });
}

int Polyhedron::dimension() const { return static_cast<int>(impl_->description.dimension); }
int Polyhedron::affine_dimension() const { return impl_->description.affine_dimension(); }
bool Polyhedron::is_empty() const { return impl_->description.is_empty(); }
bool Polyhedron::is_bounded() const { return num_rays() == 0 && num_lines() == 0; }
std::size_t Polyhedron::num_vertices() const { return impl_->description.num_vertices; }
std::size_t Polyhedron::num_rays() const { return impl_->description.num_rays(); }
std::size_t Polyhedron::num_lines() const { return impl_->description.lines.size(); }
std::size_t Polyhedron::num_inequalities() const { return impl_->description.facets.size(); }
std::size_t Polyhedron::num_equations() const { return impl_->description.equations.size(); }

RationalRows Polyhedron::vertices() const {
  return internal::guarded("vertices", [&] {
    const Description& own = impl_->description;
    if (own.dimension == 0) return to_public(own.generators, 0, own.num_vertices, 0, false);
    std::vector<Rational> entries;
    entries.reserve(own.num_vertices * own.dimension);
    for (std::size_t i = 0; i < own.num_vertices; ++i) {
      internal::cancellation_point();
      for (std::size_t c = 0; c < own.dimension; ++c)
        entries.push_back(Fraction::to_rational(own.generators[i][c], own.generators[i].back()));
    }
    return RationalRows(std::move(entries), own.dimension);
  });
}
RationalRows Polyhedron::vertex_integers() const {
  return internal::guarded("vertices", [&] {
    const Description& own = impl_->description;
    return to_public(own.generators, 0, own.num_vertices, own.width(), false);
  });
}
RationalRows Polyhedron::rays() const {
  return internal::guarded("rays", [&] {
    const Description& own = impl_->description;
    return to_public(own.generators, own.num_vertices, own.generators.size(), own.dimension, false);
  });
}
RationalRows Polyhedron::lines() const {
  return internal::guarded("lines", [&] {
    const Description& own = impl_->description;
    return to_public(own.lines, 0, own.lines.size(), own.dimension, false);
  });
}
RationalRows Polyhedron::inequalities() const {
  return internal::guarded("inequalities", [&] {
    const Description& own = impl_->description;
    return to_public(own.facets, 0, own.facets.size(), own.width(), true);
  });
}
/// The first entry of an equation is positive, as it is a·x = b.
RationalRows Polyhedron::equations() const {
  return internal::guarded("equations", [&] {
    const Description& own = impl_->description;
    Rows rows = own.equations;
    for (Row& row : rows)
      if (own.num_vertices > 0)
        for (Integer& x : row) x = -x;
    return to_public(rows, 0, rows.size(), own.width(), true);
  });
}

std::vector<std::size_t> Polyhedron::facets_of_vertex(std::size_t vertex) const {
  require_number(vertex, num_vertices(), "vertex");
  return numbers_of(impl_->description.incidence[vertex], 0, num_inequalities());
}
std::vector<std::size_t> Polyhedron::facets_of_ray(std::size_t ray) const {
  require_number(ray, num_rays(), "ray");
  return numbers_of(impl_->description.incidence[num_vertices() + ray], 0, num_inequalities());
}
std::vector<std::size_t> Polyhedron::vertices_of_facet(std::size_t facet) const {
  require_number(facet, num_inequalities(), "facet");
  return numbers_of(impl_->generators_of_facets[facet], 0, num_vertices());
}
std::vector<std::size_t> Polyhedron::rays_of_facet(std::size_t facet) const {
  require_number(facet, num_inequalities(), "facet");
  return numbers_of(impl_->generators_of_facets[facet], num_vertices(), num_vertices() + num_rays());
}

/// Generators are the rays of the cone of the polyhedron modulo its lines, and infinity is a row of it.
Pairs Polyhedron::adjacent_vertices() const {
  return internal::guarded("the edges", [&] {
    const Description& own = impl_->description;
    if (own.is_empty()) return Pairs();
    const auto cone_dimension = static_cast<std::size_t>(own.affine_dimension()) + 1 - own.lines.size();
    return adjacent_pairs(
        own.incidence_with_infinity(), own.facets.size() + 1, cone_dimension,
        [&](std::uint32_t i, std::uint32_t j) { return i < own.num_vertices && j < own.num_vertices; });
  });
}

/// Facets are the rays of the polar cone modulo the equations, and infinity is one of them unless a facet
/// contains all rays.
Pairs Polyhedron::adjacent_facets() const {
  return internal::guarded("the ridges", [&] {
    const Description& own = impl_->description;
    const BitRows& facets = impl_->generators_of_facets;
    if (own.is_empty()) return Pairs();
    const std::size_t n = own.generators.size();
    BitRows sets(facets.size() + 1, n);
    for (std::size_t f = 0; f < facets.size(); ++f)
      std::copy(facets[f].begin(), facets[f].end(), sets[f].begin());
    for (std::size_t i = own.num_vertices; i < n; ++i) polyhedra::insert(sets[facets.size()], i);
    const ConstBits rays = std::as_const(sets)[facets.size()];
    bool is_facet = true;
    for (std::size_t f = 0; f < facets.size() && is_facet; ++f)
      is_facet = !polyhedra::contains(facets[f], rays);
    if (!is_facet) sets.resize(facets.size());
    const auto cone_dimension = static_cast<std::size_t>(own.affine_dimension()) + 1 - own.lines.size();
    return adjacent_pairs(sets, n, cone_dimension, [&](std::uint32_t i, std::uint32_t j) {
      if (i >= facets.size() || j >= facets.size()) return false;
      for (std::size_t v = 0; v < own.num_vertices; ++v)
        if (polyhedra::test(facets[i], v) && polyhedra::test(facets[j], v)) return true;
      return false;
    });
  });
}

const std::vector<RowKind>& Polyhedron::row_kinds() const { return impl_->kinds; }

std::vector<std::size_t> Polyhedron::redundant_rows() const {
  std::vector<std::size_t> rows;
  for (std::size_t i = 0; i < impl_->kinds.size() && !is_empty(); ++i)
    if (impl_->kinds[i] == RowKind::duplicate || impl_->kinds[i] == RowKind::redundant) rows.push_back(i);
  return rows;
}

CanonicalHash Polyhedron::hash() const {
  const Description& own = impl_->description;
  CanonicalHash hash{0x452821e638d01377u, 0xbe5466cf34e90c6cu};  // digits of π
  for (const std::size_t size : {own.dimension, own.num_vertices, own.generators.size(), own.lines.size()})
    add_to_hash(Integer(size), hash);
  for (const Rows* rows : {&own.generators, &own.lines})
    for (const Row& row : *rows) {
      internal::cancellation_point();
      for (const Integer& x : row) add_to_hash(x, hash);
    }
  return hash;
}

bool operator==(const Polyhedron& a, const Polyhedron& b) {
  const Description &x = a.impl_->description, &y = b.impl_->description;
  return a.impl_ == b.impl_ || (x.dimension == y.dimension && x.num_vertices == y.num_vertices &&
                                x.generators == y.generators && x.lines == y.lines);
}

}  // namespace delone
