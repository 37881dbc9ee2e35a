// SPDX-License-Identifier: BSD-3-Clause
// read_complex: chooses the reader, reads .npz, and checks that the members agree in shape.
#include "io/collect.hpp"
#include "io/complexes/raw_complex.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/points/off.hpp"
#include "io/points/read_points.hpp"
#include "io/zip.hpp"

#include <utility>

namespace delone {

namespace io {

ComplexData assemble(RawComplex raw, const std::string& name) {
  if (!raw.cells) fail(Errc::bad_format, "{}: there is no member 'cells' (or 'simplices')", name);
  ComplexData data;
  data.dimension = raw.points.dimension;
  data.points = std::move(raw.points.coordinates);
  const IndexMatrix& cells = *raw.cells;
  if (cells.rows > 0 && cells.columns == 0)
    fail(Errc::bad_format, "{}: cells: {} rows without vertices", name, cells.rows);
  const std::int64_t dimension = raw.affine_dimension.value_or(static_cast<std::int64_t>(cells.columns) - 1);
  if (dimension < -1 || dimension > data.dimension)
    fail(Errc::bad_format, "{}: affine dimension {} is impossible for points of dimension {}", name,
         dimension, data.dimension);
  if (cells.rows > 0 && static_cast<std::int64_t>(cells.columns) != dimension + 1)
    fail(Errc::bad_format, "{}: cells: expected {} columns for affine dimension {}, found {}", name,
         dimension + 1, dimension, cells.columns);
  data.affine_dimension = static_cast<int>(dimension);
  if (raw.neighbors) {
    if (raw.neighbors->rows != cells.rows || (cells.rows > 0 && raw.neighbors->columns != cells.columns))
      fail(Errc::bad_format, "{}: neighbors: expected shape ({}, {}) as of the cells, found ({}, {})", name,
           cells.rows, cells.columns, raw.neighbors->rows, raw.neighbors->columns);
    data.neighbors = std::move(raw.neighbors->items);
  }
  if (raw.vertex_of_point) {
    if (raw.vertex_of_point->size() != data.num_points())
      fail(Errc::bad_format, "{}: vertex_of_point: expected {} rows, one per point, found {}", name,
           data.num_points(), raw.vertex_of_point->size());
    data.vertex_of_point = std::move(*raw.vertex_of_point);
  }
  if (raw.weights) {
    if (raw.weights->size() != data.num_points())
      fail(Errc::bad_format, "{}: weights: expected {} numbers, one per point, found {}", name,
           data.num_points(), raw.weights->size());
    data.weights = std::move(*raw.weights);
  }
  data.cells = std::move(raw.cells->items);
  return data;
}

namespace {

struct Member {
  NpyArray array;
  std::string name;
};

std::optional<Member> find_member(const ZipReader& zip, const std::string& member, const std::string& file) {
  const auto bytes = zip.find(member + ".npy");
  if (!bytes) return std::nullopt;
  std::string name = file + ": " + member;
  NpyArray array = parse_npy(*bytes, name);
  return Member{std::move(array), std::move(name)};
}

std::optional<IndexMatrix> find_matrix(const ZipReader& zip, const std::string& member,
                                       const std::string& file) {
  const auto found = find_member(zip, member, file);
  if (!found) return std::nullopt;
  const auto& shape = found->array.shape;
  if (shape.size() != 2)
    fail(Errc::bad_format, "{}: expected a 2-D array, found shape {}", found->name, shape_text(shape));
  return IndexMatrix{to_indices(found->array, found->name), shape[0], shape[1]};
}

}  // namespace

ComplexData read_npz_complex(std::string_view bytes, const std::string& name) {
  const ZipReader zip(bytes, name);
  RawComplex raw;
  const auto points = find_member(zip, "points", name);
  if (!points) {
    std::vector<std::string> available;
    for (const ZipMember& m : zip.members())
      available.push_back(m.name.ends_with(".npy") ? m.name.substr(0, m.name.size() - 4) : m.name);
    fail(Errc::bad_format, "{}: there is no member 'points'; the members are {}", name, joined(available));
  }
  if (points->array.shape.size() != 2)
    fail(Errc::bad_format, "{}: expected a 2-D array, found shape {}", points->name,
         shape_text(points->array.shape));
  raw.points = points_of(points->array, points->name);
  raw.cells = find_matrix(zip, "cells", name);
  if (!raw.cells) raw.cells = find_matrix(zip, "simplices", name);
  raw.neighbors = find_matrix(zip, "neighbors", name);
  if (const auto found = find_member(zip, "vertex_of_point", name)) {
    if (found->array.shape.size() != 1)
      fail(Errc::bad_format, "{}: expected a 1-D array, found shape {}", found->name,
           shape_text(found->array.shape));
    raw.vertex_of_point = to_indices(found->array, found->name);
  }
  if (const auto found = find_member(zip, "weights", name)) {
    if (found->array.shape.size() != 1)
      fail(Errc::bad_format, "{}: expected a 1-D array, found shape {}", found->name,
           shape_text(found->array.shape));
    raw.weights = points_of(found->array, found->name).coordinates;
  }
  if (const auto found = find_member(zip, "affine_dimension", name)) {
    const auto value = to_indices(found->array, found->name);
    if (value.size() != 1)
      fail(Errc::bad_format, "{}: expected one number, found shape {}", found->name,
           shape_text(found->array.shape));
    raw.affine_dimension = value[0];
  }
  return assemble(std::move(raw), name);
}

ComplexData read_complex_in(const std::string& format, std::string_view bytes, const std::string& name) {
  if (format == "npz") return read_npz_complex(bytes, name);
  if (format == "json") return read_json_complex(bytes, name);
  return read_off_complex(bytes, name);
}

}  // namespace io

ComplexData read_complex(const std::string& path, const std::string& format) {
  const std::string chosen =
      io::choose_format(path, format, "json", {"npz", "json", "off"}, "reading a triangulation");
  const std::string name = io::input_name(path);
  return io::guarded(name, [&] { return io::read_complex_in(chosen, io::read_all(path).view(), name); });
}

}  // namespace delone
