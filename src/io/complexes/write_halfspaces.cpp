// SPDX-License-Identifier: BSD-3-Clause
// write_halfspaces: the arrays of an intersection for NumPy and as JSON; a bounded one in space as a mesh of
// polygons.
#include "io/atomic_file.hpp"
#include "io/collect.hpp"
#include "io/complexes/intersection_arrays.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/write_npy.hpp"
#include "io/zip.hpp"

#include <delone/halfspaces.hpp>

#include <cmath>
#include <cstdint>
#include <span>
#include <type_traits>

namespace delone {
namespace io {
namespace {

/// What IntersectionData holds as other types than arrays in files do.
struct Converted {
  std::vector<SignedIndex> axes, kinds;
  explicit Converted(const IntersectionData& data) : axes(data.axes.begin(), data.axes.end()) {
    for (const HalfspaceKind kind : data.kinds) kinds.push_back(static_cast<SignedIndex>(kind));
  }
};

void write_npz(AtomicFile& file, const IntersectionData& data) {
  ZipWriter zip(file);
  std::string storage;
  const Converted converted(data);
  for_each_array(
      data, converted.axes, converted.kinds,
      [&]<class T>(const char* name, const std::vector<T>& items, std::initializer_list<std::size_t> shape) {
        constexpr std::string_view type = std::is_same_v<T, double> ? std::string_view("f8") : npy_index_type;
        zip.add(std::string(name) + ".npy", npy_header(type, shape),
                little_endian_bytes(std::span<const T>(items), storage));
      });
  const auto add_scalar = [&](const char* name, std::int64_t value) {
    zip.add(std::string(name) + ".npy", npy_header("i8", {}),
            little_endian_bytes(std::span<const std::int64_t>(&value, 1), storage));
  };
  add_scalar("dimension", data.dimension);
  add_scalar("rank", data.rank);
  add_scalar("state", static_cast<std::int64_t>(data.state));
  add_scalar("bounded", data.bounded);
  add_scalar("interior_point_is_exact", data.interior_point_is_exact);
  zip.finish();
}

/// Coordinates beyond the range of doubles become null.
void put_number(AtomicFile& file, double x) {
  if (!std::isfinite(x))
    file.write("null");
  else if (x == 0)
    file.write(std::signbit(x) ? "-0.0" : "0");  // "-0" would be read as an integer
  else
    file.put(x);
}
void put_number(AtomicFile& file, SignedIndex x) { file.put(x); }

void write_json(AtomicFile& file, const IntersectionData& data) {
  file.print(
      "{{\n\"dimension\": {},\n\"rank\": {},\n\"state\": \"{}\",\n\"bounded\": "
      "{},\n\"interior_point_is_exact\": {}",
      data.dimension, data.rank, state_names[static_cast<std::size_t>(data.state)], data.bounded,
      data.interior_point_is_exact);
  const Converted converted(data);
  for_each_array(
      data, converted.axes, converted.kinds,
      [&]<class T>(const char* name, const std::vector<T>& items, std::initializer_list<std::size_t> shape) {
        file.print(",\n\"{}\": [", name);
        const std::size_t columns = shape.size() == 2 ? *(shape.begin() + 1) : 0;
        for (std::size_t i = 0; i < items.size(); ++i) {
          if (columns > 0)
            file.write(i == 0 ? "\n[" : i % columns == 0 ? "],\n[" : ", ");
          else if (i > 0)
            file.write(", ");
          put_number(file, items[i]);
        }
        file.write(columns > 0 && !items.empty() ? "]\n]" : "]");
      });
  file.write("\n}\n");
}

void write_off(AtomicFile& file, const IntersectionData& data) {
  file.print("OFF\n{} {} {}\n", data.num_vertices(), data.num_facets(), data.num_edges());
  for (std::size_t v = 0; v < data.num_vertices(); ++v)
    for (std::size_t j = 0; j < 3; ++j) {
      file.put(data.vertex(v)[j]);
      file.put(j < 2 ? ' ' : '\n');
    }
  for (std::size_t f = 0; f < data.num_facets(); ++f) {
    file.put(data.facet(f).size());
    for (const SignedIndex v : data.facet(f)) {
      file.put(' ');
      file.put(v);
    }
    file.put('\n');
  }
}

}  // namespace
}  // namespace io

void write_halfspaces(const std::string& path, const IntersectionData& data, const std::string& format) {
  const std::string chosen =
      io::choose_format(path, format, "json", {"npz", "json", "off"}, "writing an intersection");
  io::guarded(path, [&] {
    if (data.dimension < 1)
      io::fail(Errc::bad_dimension, "{}: cannot write: the dimension is {}", path, data.dimension);
    if (data.halfspaces.size() != data.num_halfspaces() * (static_cast<std::size_t>(data.dimension) + 1))
      io::fail(Errc::invalid_argument, "{}: cannot write: the halfspaces are missing", path);
    if (path == "-" && chosen == "npz")
      io::fail(Errc::unsupported, "format '{}' is binary and is not written to standard output", chosen);
    if (chosen == "off" && (data.dimension != 3 || !data.bounded))
      io::fail(Errc::unsupported, "format 'off' needs a bounded intersection in dimension 3");
    io::AtomicFile file(path);
    if (chosen == "npz") io::write_npz(file, data);
    if (chosen == "json") io::write_json(file, data);
    if (chosen == "off") io::write_off(file, data);
    file.commit();
  });
}

}  // namespace delone
