// SPDX-License-Identifier: BSD-3-Clause
// Files, checks, and folders of tiles.
#include "diagram.hpp"
#include "halfspaces.hpp"
#include "hull.hpp"
#include "options.hpp"
#include "triangulation.hpp"

#include <delone/check.hpp>
#include <delone/io.hpp>
#include <delone/tiles.hpp>

#include <memory>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace delone::c {
namespace {

std::unique_ptr<delone_object> object_of(ComplexData data) {
  return std::make_unique<GivenTriangulation>(std::move(data));
}
std::unique_ptr<delone_object> object_of(HullData data) {
  return std::make_unique<GivenHull>(std::move(data));
}
std::unique_ptr<delone_object> object_of(IntersectionData data) {
  return std::make_unique<GivenIntersection>(std::move(data));
}
std::unique_ptr<delone_object> object_of(VoronoiData data) {
  return std::make_unique<GivenDiagram>(std::move(data));
}

std::unique_ptr<delone_object> object_of(const CheckReport& report) {
  auto results = std::make_unique<Results>("report");
  results->add("ok", std::int64_t{report.ok});
  results->add("level", std::int64_t{report.reached.number});
  results->add("ties", static_cast<std::int64_t>(report.ties));
  results->add("level_name", std::string(report.reached.name));
  results->add("level_meaning", std::string(report.reached.meaning));
  results->add("violation", report.violation);
  results->add("not_examined", report.not_examined);
  results->add("cells", report.cells);
  results->add("points", report.points);
  results->add("vertices", report.vertices);
  results->add("halfspaces", report.halfspaces);
  return results;
}

std::unique_ptr<delone_object> object_of(const TilesIndex& index) {
  auto results = std::make_unique<Results>("tiles");
  results->add("dimension", std::int64_t{index.dimension});
  results->add("affine_dimension", std::int64_t{index.affine_dimension});
  results->add("weighted", std::int64_t{index.weighted});
  results->add("num_points", index.num_points);
  results->add("num_vertices", index.num_vertices);
  results->add("num_duplicates", index.num_duplicates);
  results->add("num_hidden", index.num_hidden);
  results->add("num_cells", index.num_cells);
  results->add("num_hull_facets", index.num_hull_facets);
  results->add("num_parts", static_cast<std::int64_t>(index.parts.size()));
  results->add("hash", index.hash.hex());
  if (index.lattice.rank() > 0) results->add("lattice", index.lattice.vectors, index.dimension);
  const auto of_parts = [&](const char* name, std::int64_t TilePart::*number) {
    std::vector<std::int64_t> numbers;
    for (const TilePart& part : index.parts) numbers.push_back(part.*number);
    results->add(name, std::move(numbers));
  };
  of_parts("first_cell", &TilePart::first_cell);
  of_parts("part_cells", &TilePart::num_cells);
  of_parts("part_points", &TilePart::num_points);
  of_parts("part_vertices", &TilePart::num_vertices);
  of_parts("part_foreign", &TilePart::num_foreign);
  of_parts("part_bytes", &TilePart::num_bytes);
  of_parts("part_crc32", &TilePart::crc32);
  of_parts("part_seam_bytes", &TilePart::num_seam_bytes);
  of_parts("part_seam_crc32", &TilePart::seam_crc32);
  return results;
}

std::unique_ptr<delone_object> object_of(TileData tile) {
  auto results = std::make_unique<Results>("tile");
  const int width = tile.affine_dimension + 1;
  results->add("dimension", std::int64_t{tile.dimension});
  results->add("affine_dimension", std::int64_t{tile.affine_dimension});
  results->add("num_points", static_cast<std::int64_t>(tile.num_points()));
  results->add("num_cells", static_cast<std::int64_t>(tile.num_cells()));
  results->add("points", std::move(tile.points), tile.dimension);
  results->add("weights", std::move(tile.weights));
  results->add("cells", std::move(tile.cells), width);
  results->add("neighbors", std::move(tile.neighbors), width);
  results->add("rows", std::move(tile.rows));
  results->add("seams", std::move(tile.seams));
  results->add("own_rows", std::move(tile.own_rows));
  results->add("vertex_of_row", std::move(tile.vertex_of_row));
  if (tile.rank > 0) {
    results->add("cell_offsets", std::move(tile.cell_offsets), width * tile.rank);
    results->add("seam_offsets", std::move(tile.seam_offsets), tile.rank);
  }
  return results;
}

}  // namespace
}  // namespace delone::c

using namespace delone;
using namespace delone::c;

int delone_check(const delone_object* object, const delone_options* options, delone_object** report) {
  return make(report, [&] {
    return object_of(required(object, "the object").check(given(options).check, execution(options)));
  });
}

int delone_read(const char* path, const delone_options* options, delone_object** object) {
  return make(object, [&] {
    const ReadOptions& wanted = given(options).read;
    return std::visit([](auto&& data) { return object_of(std::move(data)); },
                      read(&required(path, "the path"), wanted.format, wanted.max_stream_bytes));
  });
}

int delone_read_points(const char* path, const delone_options* options, delone_object** object) {
  return make(object, [&] {
    PointTable read = read_points(&required(path, "the path"), given(options).read, execution(options));
    auto results = std::make_unique<Results>("points");
    results->add("dimension", std::int64_t{read.dimension});
    results->add("num_points", static_cast<std::int64_t>(read.num_points()));
    results->add("points", std::move(read.coordinates), read.dimension);
    results->add("skipped_rows",
                 std::vector<std::int64_t>(read.skipped_rows.begin(), read.skipped_rows.end()));
    return results;
  });
}

int delone_write_points(const double* points, std::size_t num_points, int dimension, const char* path,
                        const char* format) {
  return run([&] {
    const PointsView given = view_of(points, num_points, dimension, "points");
    write_points(&required(path, "the path"),
                 {dimension, {given.coordinates().begin(), given.coordinates().end()}, {}},
                 format == nullptr ? "" : format);
  });
}

int delone_make_tiles(const char* input, const char* folder, const delone_options* options,
                      delone_object** tiles) {
  return make(tiles, [&] {
    return object_of(make_tiles(std::string(&required(input, "the path of the input")),
                                &required(folder, "the folder"), tiles_options(options)));
  });
}

int delone_make_tiles_of_points(const double* rows, std::size_t num_rows, int columns, const char* folder,
                                const delone_options* options, delone_object** tiles) {
  return make(tiles, [&] {
    return object_of(make_tiles(view_of(rows, num_rows, columns, "rows"), &required(folder, "the folder"),
                                tiles_options(options)));
  });
}

int delone_make_periodic_tiles(const char* input, const double* lattice, std::size_t num_vectors,
                               int dimension, const char* folder, const delone_options* options,
                               delone_object** tiles) {
  return make(tiles, [&] {
    TilesOptions how = tiles_options(options);
    how.lattice = lattice_of(lattice, num_vectors, dimension);
    how.unit = given(options).periodic.unit;
    return object_of(make_tiles(std::string(&required(input, "the path of the input")),
                                &required(folder, "the folder"), how));
  });
}

int delone_make_periodic_tiles_of_points(const double* rows, std::size_t num_rows, int columns,
                                         const double* lattice, std::size_t num_vectors, const char* folder,
                                         const delone_options* options, delone_object** tiles) {
  return make(tiles, [&] {
    TilesOptions how = tiles_options(options);
    const PointsView points = view_of(rows, num_rows, columns, "rows");
    how.lattice = lattice_of(lattice, num_vectors, columns - (how.weighted ? 1 : 0));
    how.unit = given(options).periodic.unit;
    return object_of(make_tiles(points, &required(folder, "the folder"), how));
  });
}

int delone_read_tiles(const char* folder, delone_object** tiles) {
  return make(tiles, [&] { return object_of(read_tiles_index(&required(folder, "the folder"))); });
}

int delone_read_tile(const char* folder, std::size_t i, delone_object** tile) {
  return make(tile, [&] { return object_of(read_tile(&required(folder, "the folder"), i)); });
}

int delone_check_tiles(const char* folder, const double* rows, std::size_t num_rows, int columns,
                       const delone_options* options, delone_object** report) {
  return make(report, [&] {
    const std::string path = &required(folder, "the folder");
    const CheckOptions& wanted = given(options).check;
    const Execution how = execution(options);
    return object_of(rows == nullptr
                         ? check_tiles(path, wanted, how)
                         : check_tiles(path, view_of(rows, num_rows, columns, "rows"), wanted, how));
  });
}
