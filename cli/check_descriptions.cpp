// SPDX-License-Identifier: BSD-3-Clause
#include "check_descriptions.hpp"

#include "command.hpp"
#include "output.hpp"

#include <delone/polyhedron_io.hpp>

#include <fmt/format.h>

#include <optional>
#include <set>
#include <span>
#include <utility>
#include <vector>

namespace delone::cli {
namespace {

struct Described {
  std::string name;
  PolyhedronRows rows;
};

/// What a comparison finds: a violation, the common hash, or neither.
struct Found {
  std::optional<std::string> violation;
  std::optional<CanonicalHash> hash;
};

Described read_description(const std::string& path, std::uint64_t max_stream_bytes) {
  const std::string name = input_name(path);
  return {name, about(name, [&] { return read_polyhedron(path, max_stream_bytes); })};
}

/// Throws Errc::time_limit after so many seconds, if they are not 0.
Polyhedron convert(const Described& description, unsigned threads, double seconds = 0) {
  return about(description.name, [&] {
    Options options;
    options.threads = threads;
    options.time_limit = seconds;
    return to_polyhedron(description.rows, options);
  });
}

std::string contents(const Described& description) {
  const PolyhedronRows& rows = description.rows;
  const std::string parts =
      rows.has_generators ? fmt::format("{}, {}, {}", counted(rows.vertices.size(), "point"),
                                        counted(rows.rays.size(), "ray"), counted(rows.lines.size(), "line"))
                          : fmt::format("{}, {}",
                                        rows.inequalities.size() == 1
                                            ? std::string("1 inequality")
                                            : fmt::format("{} inequalities", rows.inequalities.size()),
                                        counted(rows.equations.size(), "equation"));
  return fmt::format("{}: {} in dimension {}\n", description.name, parts, rows.dimension);
}

std::string in_words(std::span<const Rational> x) {
  std::string text;
  for (const Rational& entry : x) text += (text.empty() ? "(" : ", ") + entry.to_string();
  return text.empty() ? "()" : text + ")";
}

/// Looks for something that `part` has and `whole` does not.
std::optional<std::string> excess(const Polyhedron& part, const std::string& name, const Polyhedron& whole,
                                  const std::string& name_of_whole) {
  if (whole.includes(part)) return std::nullopt;
  const RationalRows vertices = part.vertices();
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (!whole.contains(vertices[i]))
      return fmt::format("{} has the vertex {}, which is not in {}", name, in_words(vertices[i]),
                         name_of_whole);
  return fmt::format("{} has a ray or a line that {} does not have", name, name_of_whole);
}

/// Compares by converting both.
Found compare(const Described& a, const Described& b, unsigned threads) {
  const Polyhedron p = convert(a, threads), q = convert(b, threads);
  Found found{excess(p, a.name, q, b.name), p.hash()};
  if (!found.violation) found.violation = excess(q, b.name, p, a.name);
  return found;
}

/// Compares by converting the generators. Their polyhedron P lies in that of the inequalities, Q, if the
/// largest value of each row on P says so. If the equations of Q are as many as those of P, Q lies in the
/// affine hull of P. If also some inequality of Q holds with equality on each facet of P and nowhere else, it
/// is that of the facet up to equations, so Q lies in P.
Found compare_inequalities(const Polyhedron& p, const std::string& name, const Described& of) {
  if (p.is_empty()) return {};
  using Face = std::pair<std::vector<std::size_t>, std::vector<std::size_t>>;
  std::set<Face> supported;
  const auto d = static_cast<std::size_t>(p.dimension());
  const auto beyond = [&](const char* what, std::size_t row) {
    return Found{fmt::format("{} has points that {} {} of {} excludes", name, what, row + 1, of.name), {}};
  };
  for (std::size_t i = 0; i < of.rows.inequalities.size(); ++i) {
    const std::span<const Rational> row = of.rows.inequalities[i];
    const Optimum largest = p.maximize(row.first(d));
    if (largest.state != Optimum::State::attained || largest.value > row[d]) return beyond("inequality", i);
    if (largest.value == row[d]) supported.emplace(largest.vertices, largest.rays);
  }
  for (std::size_t i = 0; i < of.rows.equations.size(); ++i) {
    const std::span<const Rational> row = of.rows.equations[i];
    for (const Optimum& bound : {p.maximize(row.first(d)), p.minimize(row.first(d))})
      if (bound.state != Optimum::State::attained || bound.value != row[d]) return beyond("equation", i);
  }
  const Polyhedron flat = Polyhedron::from_inequalities({}, of.rows.equations, p.dimension());
  bool are_all_there = flat.num_equations() == p.num_equations();
  for (std::size_t f = 0; f < p.num_inequalities() && are_all_there; ++f)
    are_all_there = supported.count({p.vertices_of_facet(f), p.rays_of_facet(f)}) != 0;
  return {{}, are_all_there ? std::optional(p.hash()) : std::nullopt};
}

/// Compares by converting the inequalities to a polytope: it must contain all points, and each of its
/// vertices must be one of them.
Found compare_points(const Polyhedron& p, const std::string& name, const Described& of) {
  if (!p.is_bounded() || !of.rows.rays.empty() || !of.rows.lines.empty()) return {};
  std::set<std::vector<Rational>> points;
  for (std::size_t i = 0; i < of.rows.vertices.size(); ++i) {
    const std::span<const Rational> point = of.rows.vertices[i];
    if (!p.contains(point))
      return {fmt::format("{} has the point {}, which is not in {}", of.name, in_words(point), name), {}};
    points.emplace(point.begin(), point.end());
  }
  const RationalRows vertices = p.vertices();
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (points.count({vertices[i].begin(), vertices[i].end()}) == 0)
      return {fmt::format("{} has the vertex {}, which is not in {}", name, in_words(vertices[i]), of.name),
              {}};
  return {{}, p.hash()};
}

/// One of the two conversions may take far longer than the other one.
Found compare_kinds(const Described& generators, const Described& inequalities, unsigned threads) {
  constexpr double growth = 8;
  for (double seconds = 1; seconds < 1e6; seconds *= growth) {
    for (const bool of_generators : {true, false}) {
      const Described& from = of_generators ? generators : inequalities;
      const Described& other = of_generators ? inequalities : generators;
      try {
        const Polyhedron p = convert(from, threads, seconds);
        Found found =
            of_generators ? compare_inequalities(p, from.name, other) : compare_points(p, from.name, other);
        return found.violation || found.hash ? found : compare(generators, inequalities, threads);
      } catch (const Error& error) {
        if (error.code() != Errc::time_limit) throw;
      }
    }
  }
  return compare(generators, inequalities, threads);
}

}  // namespace

int run_check_descriptions(const std::string& path, const std::string& other, std::uint64_t max_stream_bytes,
                           unsigned threads) {
  const Described a = read_description(path, max_stream_bytes), b = read_description(other, max_stream_bytes);
  if (a.rows.dimension != b.rows.dimension)
    throw UsageError(fmt::format("{} is in dimension {}, and {} in {}", a.name, a.rows.dimension, b.name,
                                 b.rows.dimension));
  const Found found = a.rows.has_generators == b.rows.has_generators ? compare(a, b, threads)
                      : a.rows.has_generators                        ? compare_kinds(a, b, threads)
                                                                     : compare_kinds(b, a, threads);
  print_output(contents(a) + contents(b) +
               (found.violation
                    ? fmt::format("violation: {}\n", *found.violation)
                    : fmt::format("proved: both are the polyhedron with the hash {}\n", found.hash->hex())));
  return found.violation ? exit_status::check_failed : exit_status::ok;
}

}  // namespace delone::cli
