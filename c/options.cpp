// SPDX-License-Identifier: BSD-3-Clause
#include "options.hpp"

#include "call.hpp"
#include "messages/in_quotes.hpp"

#include <array>
#include <charconv>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <string_view>

namespace delone::c {
namespace {

[[noreturn]] void refuse(std::string_view name, const std::string& why) {
  throw Error(Errc::invalid_argument, "option " + std::string(name) + ": " + why);
}

/// The setters of one type of options, by name.
template <class Value>
struct Setter {
  std::string_view name;
  void (*set)(delone_options&, Value);
};

double finite_from_0(std::string_view name, double value) {
  if (value >= 0 && value < std::numeric_limits<double>::infinity()) return value;
  char text[32];
  const std::string shortest(text, std::to_chars(text, text + sizeof text, value).ptr);
  refuse(name, shortest + " is no finite number of at least 0");
}

std::uint64_t at_least_0(std::string_view name, std::int64_t value) {
  if (value < 0) refuse(name, std::to_string(value) + " is less than 0");
  return static_cast<std::uint64_t>(value);
}

bool as_bool(std::string_view name, std::int64_t value) {
  if (value != 0 && value != 1) refuse(name, std::to_string(value) + " is neither 0 nor 1");
  return value != 0;
}

int as_int(std::string_view name, std::int64_t value) {
  if (at_least_0(name, value) > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
    refuse(name, std::to_string(value) + " is too large");
  return static_cast<int>(value);
}

/// The number of a word in a list.
std::size_t as_choice(std::string_view name, std::string_view word,
                      std::span<const std::string_view> choices) {
  std::string all;
  for (std::size_t i = 0; i < choices.size(); ++i) {
    if (choices[i] == word) return i;
    all += (i == 0 ? "" : ", ") + std::string(choices[i]);
  }
  refuse(name, messages::in_quotes(word) + " is none of " + all);
}

constexpr std::array<std::string_view, 3> orders{"automatic", "as_given", "shuffled"};
static_assert(static_cast<int>(InsertionOrder::shuffled) == 2);
constexpr std::array<std::string_view, 4> outsides{"fill", "nearest", "error", "project"};
static_assert(static_cast<int>(Outside::project) == 3);

constexpr std::array integers{
    Setter<std::int64_t>{
        "threads",
        [](delone_options& o, std::int64_t v) { o.threads = static_cast<unsigned>(as_int("threads", v)); }},
    Setter<std::int64_t>{
        "seed", [](delone_options& o, std::int64_t v) { o.build.seed = static_cast<std::uint64_t>(v); }},
    Setter<std::int64_t>{"up_to",
                         [](delone_options& o, std::int64_t v) {
                           o.check.up_to = v == 0 ? CheckOptions::all : as_int("up_to", v);
                         }},
    Setter<std::int64_t>{
        "canonical", [](delone_options& o, std::int64_t v) { o.check.canonical = as_bool("canonical", v); }},
    Setter<std::int64_t>{
        "oriented", [](delone_options& o, std::int64_t v) { o.check.oriented = as_bool("oriented", v); }},
    Setter<std::int64_t>{"proper_faces", [](delone_options& o,
                                            std::int64_t v) { o.proper_faces = as_bool("proper_faces", v); }},
    Setter<std::int64_t>{"vertices",
                         [](delone_options& o, std::int64_t v) { o.vertices = as_bool("vertices", v); }},
    Setter<std::int64_t>{
        "furthest_site",
        [](delone_options& o, std::int64_t v) { o.check.furthest_site = as_bool("furthest_site", v); }},
    Setter<std::int64_t>{"max_stream_bytes",
                         [](delone_options& o, std::int64_t v) {
                           o.read.max_stream_bytes = at_least_0("max_stream_bytes", v);
                         }},
    Setter<std::int64_t>{"memory_limit",
                         [](delone_options& o, std::int64_t v) {
                           o.build.memory_limit = static_cast<std::size_t>(at_least_0("memory_limit", v));
                         }},
    Setter<std::int64_t>{"memory",
                         [](delone_options& o, std::int64_t v) { o.tiles.memory = at_least_0("memory", v); }},
    Setter<std::int64_t>{"tiles",
                         [](delone_options& o, std::int64_t v) {
                           o.tiles.tiles = static_cast<std::size_t>(at_least_0("tiles", v));
                         }},
    Setter<std::int64_t>{
        "weighted", [](delone_options& o, std::int64_t v) { o.tiles.weighted = as_bool("weighted", v); }},
    Setter<std::int64_t>{"raw",
                         [](delone_options& o, std::int64_t v) { o.tiles.columns = as_int("raw", v); }},
    Setter<std::int64_t>{"resume",
                         [](delone_options& o, std::int64_t v) { o.tiles.resume = as_bool("resume", v); }},
    Setter<std::int64_t>{
        "skip_missing",
        [](delone_options& o, std::int64_t v) { o.read.skip_missing = as_bool("skip_missing", v); }},
    Setter<std::int64_t>{"exact",
                         [](delone_options& o, std::int64_t v) { o.periodic.exact = as_bool("exact", v); }},
    Setter<std::int64_t>{"wrap",
                         [](delone_options& o, std::int64_t v) { o.periodic.wrap = as_bool("wrap", v); }},
    Setter<std::int64_t>{"vtu", [](delone_options& o, std::int64_t v) { o.tiles.vtu = as_bool("vtu", v); }},
};

constexpr std::array reals{
    Setter<double>{"tolerance",
                   [](delone_options& o, double v) { o.tolerance = finite_from_0("tolerance", v); }},
    Setter<double>{"time_limit",
                   [](delone_options& o, double v) { o.build.time_limit = finite_from_0("time_limit", v); }},
    Setter<double>{"unit", [](delone_options& o, double v) { o.periodic.unit = finite_from_0("unit", v); }},
    Setter<double>{"fill", [](delone_options& o, double v) { o.fill = v; }},
};

constexpr std::array texts{
    Setter<const char*>{"order",
                        [](delone_options& o, const char* v) {
                          o.build.order = static_cast<InsertionOrder>(as_choice("order", v, orders));
                        }},
    Setter<const char*>{"outside",
                        [](delone_options& o, const char* v) {
                          o.outside = static_cast<Outside>(as_choice("outside", v, outsides));
                        }},
    Setter<const char*>{"format", [](delone_options& o, const char* v) { o.read.format = v; }},
    Setter<const char*>{"columns", [](delone_options& o, const char* v) { o.read.columns.emplace_back(v); }},
    Setter<const char*>{"weights", [](delone_options& o, const char* v) { o.tiles.weights = v; }},
};

constexpr std::array lists{
    Setter<std::span<const double>>{"axis_tolerances",
                                    [](delone_options& o, std::span<const double> v) {
                                      for (const double each : v) finite_from_0("axis_tolerances", each);
                                      o.axis_tolerances.assign(v.begin(), v.end());
                                    }},
};

template <class Value>
const Setter<Value>* find(std::span<const Setter<Value>> setters, std::string_view name) {
  for (const Setter<Value>& setter : setters)
    if (setter.name == name) return &setter;
  return nullptr;
}

template <class Value>
std::string names_of(std::span<const Setter<Value>> setters) {
  std::string all;
  for (const Setter<Value>& setter : setters) all += (all.empty() ? "" : ", ") + std::string(setter.name);
  return all;
}

template <class Value>
const Setter<Value>& require_setter(std::span<const Setter<Value>> setters, const char* name,
                                    const char* type) {
  const std::string_view wanted = &required(name, "the name of the option");
  const Setter<Value>* const setter = find<Value>(setters, wanted);
  if (setter == nullptr)
    throw Error(Errc::invalid_argument, std::string("there is no ") + type + " option " +
                                            messages::in_quotes(wanted) + "; there are " +
                                            names_of<Value>(setters));
  return *setter;
}

}  // namespace

const delone_options& given(const delone_options* options) {
  static const delone_options defaults;
  return options == nullptr ? defaults : *options;
}

Options without_tolerance(const delone_options* options) {
  Options result = given(options).build;
  result.threads = given(options).threads;
  return result;
}

Options with_tolerance(const delone_options* options) {
  Options result = without_tolerance(options);
  result.tolerance = given(options).tolerance;
  return result;
}

Execution execution(const delone_options* options) { return {.threads = given(options).threads}; }

LocateOptions locate_options(const delone_options* options) {
  const delone_options& from = given(options);
  if (from.outside == Outside::nearest || from.outside == Outside::error)
    refuse("outside", "queries are located with \"fill\" or \"project\"");
  return {.tolerance = from.tolerance, .project = from.outside == Outside::project, .coordinates = true};
}

TilesOptions tiles_options(const delone_options* options) {
  const delone_options& from = given(options);
  TilesOptions result = from.tiles;
  result.threads = from.threads;
  result.format = from.tiles.columns > 0 ? "raw" : from.read.format;
  result.coordinates = from.read.columns;
  return result;
}

Lattice lattice_of(const double* vectors, std::size_t num_vectors, int dimension) {
  const PointsView rows = view_of(vectors, num_vectors, dimension, "lattice");
  return {dimension, {rows.coordinates().begin(), rows.coordinates().end()}};
}

}  // namespace delone::c

using namespace delone::c;

int delone_options_new(delone_options** options) {
  return make(options, [] { return std::make_unique<delone_options>(); });
}

void delone_options_free(delone_options* options) { delete options; }

int delone_set_integer(delone_options* options, const char* name, std::int64_t value) {
  return run([&] {
    delone_options& to = required(options, "the options");
    // A real number may be written as an integer.
    if (const auto* const real = find<double>(reals, &required(name, "the name of the option")))
      real->set(to, static_cast<double>(value));
    else
      require_setter<std::int64_t>(integers, name, "integer").set(to, value);
  });
}

int delone_set_real(delone_options* options, const char* name, double value) {
  return run([&] {
    delone_options& to = required(options, "the options");
    require_setter<double>(reals, name, "real").set(to, value);
  });
}

int delone_set_reals(delone_options* options, const char* name, const double* values, size_t count) {
  return run([&] {
    delone_options& to = required(options, "the options");
    require_setter<std::span<const double>>(lists, name, "array").set(to, matrix(values, count, 1, "values"));
  });
}

int delone_set_text(delone_options* options, const char* name, const char* value) {
  return run([&] {
    delone_options& to = required(options, "the options");
    const auto& setter = require_setter<const char*>(texts, name, "text");
    if (value == nullptr && setter.name == "columns")
      to.read.columns.clear();
    else
      setter.set(to, &required(value, "the value of the option"));
  });
}
