// SPDX-License-Identifier: BSD-3-Clause
// Files, checks and point sets: the compiled part of delone._files.
#include "data_members.hpp"
#include "module.hpp"
#include "running.hpp"

#include <delone/check.hpp>
#include <delone/io.hpp>
#include <delone/point_sets.hpp>

#include <string>
#include <utility>
#include <variant>

namespace delone::python {

namespace {

using namespace py::literals;

py::tuple read_any(const std::string& path, const std::string& format, std::uint64_t max_stream_bytes) {
  Supervisor supervisor;
  AnyData data = supervisor.run([&] { return delone::read(path, format, max_stream_bytes); });
  return std::visit([](auto& held) { return to_python(std::move(held)); }, data);
}

py::tuple read_table(const std::string& path, const std::string& format, std::vector<std::string> columns,
                     bool skip_missing, int threads, std::uint64_t max_stream_bytes) {
  ReadOptions options;
  options.format = format;
  options.columns = std::move(columns);
  options.skip_missing = skip_missing;
  options.max_stream_bytes = max_stream_bytes;
  const Execution how{.threads = as_threads(threads)};
  Supervisor supervisor;
  PointTable table = supervisor.run([&] { return read_points(path, options, how); });
  const std::size_t n = table.num_points();
  py::array_t<double> points({static_cast<py::ssize_t>(n), static_cast<py::ssize_t>(table.dimension)});
  std::copy(table.coordinates.begin(), table.coordinates.end(), points.mutable_data());
  py::list names;  // bytes that are not UTF-8 become U+FFFD
  for (const std::string& name : table.column_names)
    names.append(py::reinterpret_steal<py::str>(
        PyUnicode_DecodeUTF8(name.data(), static_cast<py::ssize_t>(name.size()), "replace")));
  py::array_t<std::int64_t> skipped(static_cast<py::ssize_t>(table.skipped_rows.size()));
  std::copy(table.skipped_rows.begin(), table.skipped_rows.end(), skipped.mutable_data());
  return py::make_tuple(points, names, skipped);
}

/// Calls use(Data{}) for the data of this kind.
template <class Use>
auto with_kind(const std::string& kind, Use use) {
  if (kind == kind_of<HullData>) return use(HullData{});
  if (kind == kind_of<IntersectionData>) return use(IntersectionData{});
  if (kind == kind_of<VoronoiData>) return use(VoronoiData{});
  return use(ComplexData{});
}

void write_any(const std::string& kind, const py::dict& members, const std::string& path,
               const std::string& format) {
  with_kind(kind, [&](auto empty) {
    const auto data = from_python<decltype(empty)>(members);
    Supervisor supervisor;
    supervisor.run([&] { write(path, data, format); });
  });
}

void write_table(const py::object& points, const std::vector<std::string>& names, const std::string& path,
                 const std::string& format) {
  const auto rows = as_points(points, "points");
  PointTable table;
  table.dimension = static_cast<int>(rows.shape(1));
  table.coordinates.assign(rows.data(), rows.data() + rows.size());
  table.column_names = names;
  Supervisor supervisor;
  supervisor.run([&] { write_points(path, table, format); });
}

py::dict check_any(const std::string& kind, const py::dict& members, std::optional<int> level, bool canonical,
                   bool oriented, bool furthest_site, int threads) {
  CheckOptions options;
  options.up_to = level.value_or(CheckOptions::all);
  options.canonical = canonical;
  options.oriented = oriented;
  options.furthest_site = furthest_site;
  const Execution how{.threads = as_threads(threads)};
  return with_kind(kind, [&](auto empty) {
    const auto data = from_python<decltype(empty)>(members);
    Supervisor supervisor;
    const CheckReport report = supervisor.run([&] { return check(data, options, how); });
    return py::dict(
        "ok"_a = report.ok, "level"_a = report.reached.number, "name"_a = std::string(report.reached.name),
        "violation"_a = report.violation, "cells"_a = py::tuple(py::cast(report.cells)),
        "points"_a = py::tuple(py::cast(report.points)), "vertices"_a = py::tuple(py::cast(report.vertices)),
        "halfspaces"_a = py::tuple(py::cast(report.halfspaces)), "ties"_a = report.ties,
        "not_examined"_a = report.not_examined);
  });
}

py::array generate(const std::string& kind, std::size_t n, int dimension, std::uint64_t seed) {
  Supervisor supervisor;
  const std::vector<double> points = supervisor.run([&] { return make_point_set(kind, dimension, n, seed); });
  const auto d = static_cast<py::ssize_t>(dimension);
  py::array_t<double> rows({static_cast<py::ssize_t>(points.size()) / d, d});
  std::copy(points.begin(), points.end(), rows.mutable_data());
  return rows;
}

py::dict kinds() {
  py::dict all;
  for (const PointSetKind& kind : point_set_kinds())
    all[py::str(std::string(kind.name))] = std::string(kind.description);
  return all;
}

}  // namespace

void bind_files(py::module_& module) {
  module.def("_read", &read_any, "path"_a, "format"_a, "max_stream_bytes"_a);
  module.def("_read_points", &read_table, "path"_a, "format"_a, "columns"_a, "skip_missing"_a, "threads"_a,
             "max_stream_bytes"_a);
  module.def("_write", &write_any, "kind"_a, "members"_a, "path"_a, "format"_a);
  module.def("_write_points", &write_table, "points"_a, "names"_a, "path"_a, "format"_a);
  module.def("_check", &check_any, "kind"_a, "members"_a, "level"_a, "canonical"_a, "oriented"_a,
             "furthest_site"_a, "threads"_a);
  module.def("_generate", &generate, "kind"_a, "n"_a, "dimension"_a, "seed"_a);
  module.def("_point_set_kinds", &kinds);
}

}  // namespace delone::python
