// SPDX-License-Identifier: BSD-3-Clause
// write_voronoi: chooses the writer; the arrays of a diagram as .npz and .json.
#include "io/write_voronoi.hpp"

#include "io/atomic_file.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/write_npy.hpp"
#include "io/zip.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

namespace delone {

namespace io {

namespace {

std::size_t sites_per_ray(const VoronoiDiagram& diagram) {
  return static_cast<std::size_t>(std::max(diagram.affine_dimension(), 0));
}

/// The sites, and for duplicates that of their region: n×d. NaN for hidden points.
std::vector<double> points_of(const VoronoiDiagram& diagram) {
  std::vector<double> points;
  for (const SignedIndex region : diagram.point_region()) {
    if (region < 0) {
      points.insert(points.end(), static_cast<std::size_t>(diagram.dimension()), std::nan(""));
      continue;
    }
    const auto site = diagram.site(static_cast<std::size_t>(region));
    points.insert(points.end(), site.begin(), site.end());
  }
  return points;
}

/// JSON has no infinities; numbers this large exist only as vertices beyond the range of doubles.
void put_json(AtomicFile& file, double x) {
  if (std::isfinite(x))
    file.put(x);
  else
    file.write(x > 0 ? "1e999" : x < 0 ? "-1e999" : "null");
}

}  // namespace

void write_voronoi_npz(AtomicFile& file, const VoronoiDiagram& diagram) {
  ZipWriter zip(file);
  std::string storage;
  const auto d = static_cast<std::size_t>(diagram.dimension());
  const auto add = [&](const char* member, const std::string& header, auto items) {
    zip.add(std::string(member) + ".npy", header, little_endian_bytes(items, storage));
  };
  const auto add_indices = [&](const char* member, std::span<const SignedIndex> items) {
    add(member, npy_header(npy_index_type, {items.size()}), items);
  };
  const std::vector<double> points = points_of(diagram);
  add("points", npy_header("f8", {diagram.num_points(), d}), std::span<const double>(points));
  add("vertices", npy_header("f8", {diagram.num_vertices(), d}), diagram.vertices());
  add("ridge_points", npy_header(npy_index_type, {diagram.num_ridges(), 2}), diagram.ridge_points());
  add_indices("ridge_vertices", diagram.ridge_vertices());
  add("ridge_offsets", npy_header("i8", {diagram.ridge_offsets().size()}), diagram.ridge_offsets());
  add_indices("region_vertices", diagram.region_vertices());
  add("region_offsets", npy_header("i8", {diagram.region_offsets().size()}), diagram.region_offsets());
  add_indices("point_region", diagram.point_region());
  add_indices("ray_vertices", diagram.ray_vertices());
  add("ray_directions", npy_header("f8", {diagram.num_rays(), d}), diagram.ray_directions());
  add("ray_points", npy_header(npy_index_type, {diagram.num_rays(), sites_per_ray(diagram)}), diagram.ray_points());
  const std::int64_t dimension = diagram.affine_dimension();
  add("affine_dimension", npy_header("i8", {}), std::span(&dimension, 1));
  zip.finish();
}

void write_voronoi_json(AtomicFile& file, const VoronoiDiagram& diagram) {
  file.print("{{\n\"dimension\": {},\n\"affine_dimension\": {}", diagram.dimension(), diagram.affine_dimension());
  const auto row = [&](auto items) {
    file.put('[');
    for (std::size_t i = 0; i < items.size(); ++i) {
      if (i > 0) file.write(", ");
      if constexpr (std::is_same_v<typename decltype(items)::value_type, double>)
        put_json(file, items[i]);
      else
        file.put(items[i]);
    }
    file.put(']');
  };
  const auto lists = [&](const char* member, std::size_t count, auto&& list) {
    file.print(",\n\"{}\": [", member);
    for (std::size_t i = 0; i < count; ++i) {
      file.write(i == 0 ? "\n" : ",\n");
      row(list(i));
    }
    file.write(count == 0 ? "]" : "\n]");
  };
  const auto d = static_cast<std::size_t>(diagram.dimension()), k = sites_per_ray(diagram);
  const std::vector<double> points = points_of(diagram);
  lists("points", diagram.num_points(), [&](std::size_t i) { return std::span<const double>(points).subspan(i * d, d); });
  lists("vertices", diagram.num_vertices(), [&](std::size_t i) { return diagram.vertex(i); });
  lists("ridge_points", diagram.num_ridges(), [&](std::size_t i) { return diagram.ridge_points().subspan(2 * i, 2); });
  lists("ridge_vertices", diagram.num_ridges(), [&](std::size_t i) { return diagram.ridge(i); });
  lists("regions", diagram.num_regions(), [&](std::size_t i) { return diagram.region(i); });
  file.write(",\n\"point_region\": ");
  row(diagram.point_region());
  file.write(",\n\"ray_vertices\": ");
  row(diagram.ray_vertices());
  lists("ray_directions", diagram.num_rays(), [&](std::size_t i) { return diagram.ray_directions().subspan(i * d, d); });
  lists("ray_points", diagram.num_rays(), [&](std::size_t i) { return diagram.ray_points().subspan(i * k, k); });
  file.write("\n}\n");
}

}  // namespace io

void write_voronoi(const std::string& path, const VoronoiDiagram& diagram, const Box* box, const std::string& format) {
  const std::string chosen =
      io::choose_format(path, format, "json", {"npz", "json", "svg", "vtu"}, "writing a Voronoi diagram");
  io::guarded(path, [&] {
    if (path == "-" && (chosen == "npz" || chosen == "vtu"))
      io::fail(Errc::unsupported, "format '{}' is binary and is not written to standard output", chosen);
    io::AtomicFile file(path);
    const Box shown = box != nullptr ? *box : diagram.bounding_box();
    if (chosen == "npz") io::write_voronoi_npz(file, diagram);
    if (chosen == "json") io::write_voronoi_json(file, diagram);
    if (chosen == "svg") io::write_voronoi_svg(file, diagram, shown);
    if (chosen == "vtu") io::write_voronoi_vtu(file, diagram, shown);
    file.commit();
  });
}

}  // namespace delone
