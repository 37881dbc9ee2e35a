// SPDX-License-Identifier: BSD-3-Clause
#include "check_descriptions.hpp"

#include "command.hpp"
#include "output.hpp"

#include <delone/polyhedron_io.hpp>

#include <fmt/format.h>

#include <optional>
#include <span>

namespace delone::cli {
namespace {

struct Described {
  std::string name;
  PolyhedronRows rows;
  Polyhedron polyhedron;
};

Described read_description(const std::string& path, std::uint64_t max_stream_bytes, unsigned threads) {
  Described result{input_name(path), {}, {}};
  about(result.name, [&] {
    result.rows = read_polyhedron(path, max_stream_bytes);
    Options options;
    options.threads = threads;
    result.polyhedron = to_polyhedron(result.rows, options);
  });
  return result;
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

/// What `part` has that `whole` does not.
std::optional<std::string> excess(const Described& part, const Described& whole) {
  if (whole.polyhedron.includes(part.polyhedron)) return std::nullopt;
  const RationalRows vertices = part.polyhedron.vertices();
  for (std::size_t i = 0; i < vertices.size(); ++i)
    if (!whole.polyhedron.contains(vertices[i]))
      return fmt::format("{} has the vertex {}, which is not in {}", part.name, in_words(vertices[i]),
                         whole.name);
  return fmt::format("{} has a ray or a line that {} does not have", part.name, whole.name);
}

}  // namespace

int run_check_descriptions(const std::string& path, const std::string& other, std::uint64_t max_stream_bytes,
                           unsigned threads) {
  const Described a = read_description(path, max_stream_bytes, threads),
                  b = read_description(other, max_stream_bytes, threads);
  std::string text = contents(a) + contents(b);
  if (a.rows.dimension != b.rows.dimension)
    throw UsageError(fmt::format("{} is in dimension {}, and {} in {}", a.name, a.rows.dimension, b.name,
                                 b.rows.dimension));
  std::optional<std::string> violation = excess(a, b);
  if (!violation) violation = excess(b, a);
  if (violation)
    text += fmt::format("violation: {}\n", *violation);
  else
    text += fmt::format("proved: both are the polyhedron with the hash {}\n", a.polyhedron.hash().hex());
  print_output(text);
  return violation ? exit_status::check_failed : exit_status::ok;
}

}  // namespace delone::cli
