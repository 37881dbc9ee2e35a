// SPDX-License-Identifier: BSD-3-Clause
// write_voronoi: chooses the writer; the arrays of a diagram as .npz and .json.
#include "io/complexes/write_voronoi.hpp"

#include "io/atomic_file.hpp"
#include "io/complexes/voronoi_arrays.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/write_npy.hpp"
#include "io/zip.hpp"

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>
#include <type_traits>
#include <vector>

namespace delone {

namespace io {

namespace {

/// JSON has no infinities; numbers this large exist only as vertices beyond the range of doubles. NaN: rows
/// not inserted.
void put_json(AtomicFile& file, double x) {
  if (std::isfinite(x))
    file.put(x);
  else
    file.write(x > 0 ? "1e999" : x < 0 ? "-1e999" : "null");
}

}  // namespace

void write_voronoi_npz(AtomicFile& file, const VoronoiData& data) {
  ZipWriter zip(file);
  std::string storage;
  for_each_array(data, [&](const char* member, const auto& items, std::initializer_list<std::size_t> shape) {
    using Item = typename std::decay_t<decltype(items)>::value_type;
    const std::string_view type = std::is_same_v<Item, double>         ? "f8"
                                  : std::is_same_v<Item, std::int64_t> ? "i8"
                                                                       : npy_index_type;
    zip.add(std::string(member) + ".npy", npy_header(type, shape),
            little_endian_bytes(std::span<const Item>(items), storage));
  });
  const std::int64_t dimension = data.affine_dimension;
  zip.add("affine_dimension.npy", npy_header("i8", {}),
          little_endian_bytes(std::span(&dimension, 1), storage));
  zip.finish();
}

void write_voronoi_json(AtomicFile& file, const VoronoiData& data) {
  file.print("{{\n\"dimension\": {},\n\"affine_dimension\": {}", data.dimension, data.affine_dimension);
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
  const auto member = [&](const char* name) { file.print(",\n\"{}\": ", name); };
  const auto rows = [&](std::size_t count, auto&& row_at) {
    file.put('[');
    for (std::size_t i = 0; i < count; ++i) {
      file.write(i == 0 ? "\n" : ",\n");
      row(row_at(i));
    }
    file.write(count == 0 ? "]" : "\n]");
  };
  const auto lists = [&](const std::vector<SignedIndex>& items, const std::vector<std::int64_t>& offsets) {
    rows(offsets.size() - 1, [&](std::size_t i) {
      return std::span(items).subspan(static_cast<std::size_t>(offsets[i]),
                                      static_cast<std::size_t>(offsets[i + 1] - offsets[i]));
    });
  };
  for_each_array(
      data, [&](const std::string_view name, const auto& items, std::initializer_list<std::size_t> shape) {
        if (name == "ridge_offsets" || name == "region_offsets") return;
        member(name == "region_vertices" ? "regions" : name.data());
        if (name == "ridge_vertices") return lists(data.ridge_vertices, data.ridge_offsets);
        if (name == "region_vertices") return lists(data.region_vertices, data.region_offsets);
        const auto all = std::span<const typename std::decay_t<decltype(items)>::value_type>(items);
        if (shape.size() == 1) return row(all);
        const std::size_t width = shape.begin()[1];
        rows(shape.begin()[0], [&](std::size_t i) { return all.subspan(i * width, width); });
      });
  file.write("\n}\n");
}

}  // namespace io

void write_voronoi(const std::string& path, const Diagram& diagram, const Box* box,
                   const std::string& format) {
  const std::string chosen =
      io::choose_format(path, format, "json", {"npz", "json", "svg", "vtu"}, "writing a Voronoi diagram");
  io::guarded(path, [&] {
    if (!diagram.has_ridges())
      io::fail(Errc::invalid_argument, "the Voronoi diagram was made without ridges");
    if (path == "-" && (chosen == "npz" || chosen == "vtu"))
      io::fail(Errc::unsupported, "format '{}' is binary and is not written to standard output", chosen);
    io::AtomicFile file(path);
    const Box shown = box != nullptr ? *box : diagram.bounding_box();
    if (chosen == "npz") io::write_voronoi_npz(file, diagram.to_data());
    if (chosen == "json") io::write_voronoi_json(file, diagram.to_data());
    if (chosen == "svg") io::write_voronoi_svg(file, diagram, shown);
    if (chosen == "vtu") io::write_voronoi_vtu(file, diagram, shown);
    file.commit();
  });
}

}  // namespace delone
