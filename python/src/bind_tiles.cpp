// SPDX-License-Identifier: BSD-3-Clause
// The compiled part of delone.tiles: folders of tiles are made, read and checked.
#include "arrays.hpp"
#include "module.hpp"
#include "running.hpp"

#include <delone/tiles.hpp>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace delone::python {
namespace {

using namespace py::literals;

/// The members of index.json with their names; `hash` in hexadecimal, `parts` one after the other.
py::dict index_as_dict(const TilesIndex& index) {
  py::list parts;
  for (const TilePart& part : index.parts)
    parts.append(py::dict(
        "file"_a = part.file, "first_cell"_a = part.first_cell, "num_cells"_a = part.num_cells,
        "num_points"_a = part.num_points, "num_vertices"_a = part.num_vertices,
        "num_foreign"_a = part.num_foreign, "num_rounds"_a = part.num_rounds, "num_bytes"_a = part.num_bytes,
        "crc32"_a = part.crc32, "num_seam_bytes"_a = part.num_seam_bytes, "seam_crc32"_a = part.seam_crc32));
  return py::dict("dimension"_a = index.dimension, "affine_dimension"_a = index.affine_dimension,
                  "weighted"_a = index.weighted, "num_points"_a = index.num_points,
                  "num_vertices"_a = index.num_vertices, "num_duplicates"_a = index.num_duplicates,
                  "num_hidden"_a = index.num_hidden, "num_cells"_a = index.num_cells,
                  "num_hull_facets"_a = index.num_hull_facets, "hash"_a = index.hash.hex(),
                  "lattice"_a = index.lattice.vectors, "unit"_a = index.unit, "parts"_a = parts);
}

/// A path, or rows of numbers: of shape (n, d), or (n, d + 1) with weights.
py::dict make_folder(const py::object& input, const std::string& folder, std::uint64_t memory,
                     std::size_t tiles, int threads, bool weighted, const std::string& format, int columns,
                     int dimension, std::vector<std::string> coordinates, std::string weights,
                     std::vector<double> lattice, double unit, bool resume, bool vtu,
                     const py::object& forecast, const py::object& damage, const py::object& progress) {
  TilesOptions options;
  options.memory = memory;
  options.tiles = tiles;
  options.threads = BuildArguments{.threads = threads}.to_options().threads;
  options.weighted = weighted;
  options.format = format;
  options.columns = columns;
  options.coordinates = std::move(coordinates);
  options.weights = std::move(weights);
  if (!lattice.empty()) options.lattice = {dimension, std::move(lattice)};
  options.unit = unit;
  options.resume = resume;
  options.vtu = vtu;
  Supervisor supervisor(progress);
  options.progress = supervisor.callback();
  if (!forecast.is_none())
    options.forecast = [&](const TilesForecast& f) {
      return supervisor.agrees(forecast, [&] {
        return py::make_tuple(f.num_points, f.num_tiles, f.cells_per_point, f.foreign_share,
                              f.bytes_per_tile);
      });
    };
  options.damage = [&](const std::vector<std::string>& files) {
    return supervisor.agrees(damage, [&] { return py::tuple(py::cast(files)); });
  };
  if (py::isinstance<py::bytes>(input)) {
    const auto path = input.cast<std::string>();
    return index_as_dict(supervisor.run([&] { return make_tiles(path, folder, options); }));
  }
  const auto rows = as_points(input, "points");
  const PointsView view(numbers(rows), static_cast<int>(rows.shape(1)));
  return index_as_dict(supervisor.run([&] { return make_tiles(view, folder, options); }));
}

py::dict read_index(const std::string& folder) {
  Supervisor supervisor;
  return index_as_dict(supervisor.run([&] { return read_tiles_index(folder); }));
}

/// The arrays of a part; neighbors are global, `first_cell` that of the part.
py::dict read_part(const std::string& folder, std::size_t number, std::int64_t first_cell) {
  Supervisor supervisor;
  std::vector<std::int64_t> neighbors;
  std::vector<std::int32_t> neighbor_offsets;
  const auto data = std::make_shared<TileData>(supervisor.run([&] {
    TileData part = read_tile(folder, number);
    neighbors.reserve(part.neighbors.size());
    for (const std::int32_t one : part.neighbors)
      neighbors.push_back(one >= 0    ? first_cell + one
                          : one == -1 ? -1
                                      : part.seams[static_cast<std::size_t>(-2 - std::int64_t{one})]);
    const auto r = static_cast<std::size_t>(part.rank);
    neighbor_offsets.resize(part.neighbors.size() * r);
    for (std::size_t at = 0; at < part.neighbors.size() && r > 0; ++at)
      if (part.neighbors[at] < -1)
        std::copy_n(part.seam_offsets.begin() + (-2 - std::ptrdiff_t{part.neighbors[at]}) * part.rank, r,
                    neighbor_offsets.begin() + static_cast<std::ptrdiff_t>(at * r));
    part.neighbors = {};
    return part;
  }));
  const auto d = static_cast<std::size_t>(data->dimension),
             width = static_cast<std::size_t>(data->affine_dimension + 1),
             r = static_cast<std::size_t>(data->rank);
  const py::object none = py::none();
  return py::dict(
      "points"_a = rows_view(data->points, data->num_points(), d, data),
      "weights"_a = data->weights.empty() ? none : py::object(list_view(data->weights, data)),
      "rows"_a = list_view(data->rows, data),
      "cells"_a = rows_view(data->cells, data->num_cells(), width, data),
      "neighbors"_a = rows_view(std::move(neighbors), data->num_cells(), width),
      "cell_offsets"_a =
          r == 0 ? none : py::object(rows_view(data->cell_offsets, data->num_cells(), width * r, data)),
      "neighbor_offsets"_a =
          r == 0 ? none : py::object(rows_view(std::move(neighbor_offsets), data->num_cells(), width * r)),
      "own_rows"_a = list_view(data->own_rows, data),
      "vertex_of_row"_a = list_view(data->vertex_of_row, data));
}

/// The highest level reached, its name, and the violation, if there is one, with its cells and rows.
/// `input`: None, or rows of numbers as make_folder() takes them.
py::dict check(const std::string& folder, const py::object& input, int level, bool canonical, int threads,
               const py::object& progress) {
  CheckOptions options;
  options.up_to = level;
  options.canonical = canonical;
  const Execution how{.threads = as_threads(threads)};
  const py::array_t<double> rows = input.is_none() ? py::array_t<double>() : as_points(input, "points");
  const int width = input.is_none() ? 0 : static_cast<int>(rows.shape(1));
  Supervisor supervisor(progress);
  const CheckReport report = supervisor.run([&] {
    return input.is_none() ? check_tiles(folder, options, how)
                           : check_tiles(folder, PointsView(numbers(rows), width), options, how);
  });
  return py::dict("ok"_a = report.ok, "level"_a = report.reached.number,
                  "name"_a = std::string(report.reached.name), "violation"_a = report.violation,
                  "cells"_a = report.cells, "points"_a = report.points, "ties"_a = report.ties);
}

}  // namespace

void bind_tiles(py::module_& module) {
  module.def("_make_tiles", &make_folder, "input"_a, "folder"_a, py::kw_only(), "memory"_a, "tiles"_a,
             "threads"_a, "weighted"_a, "format"_a, "columns"_a, "dimension"_a, "coordinates"_a, "weights"_a,
             "lattice"_a, "unit"_a, "resume"_a, "vtu"_a, "forecast"_a, "damage"_a, "progress"_a,
             "Makes a folder of tiles from a path or an array, the last column of which may be weights, and "
             "returns its index.");
  module.def("_read_tiles_index", &read_index, "folder"_a, "The index of a folder of tiles.");
  module.def("_read_tile", &read_part, "folder"_a, "number"_a, "first_cell"_a,
             "The arrays of delone.tiles.Part.");
  module.def("_check_tiles", &check, "folder"_a, "input"_a, py::kw_only(), "level"_a, "canonical"_a,
             "threads"_a, "progress"_a, "The members of delone.tiles.Report.");
}

}  // namespace delone::python
