// SPDX-License-Identifier: BSD-3-Clause
// Values on a grid as arrays, or as a table with the centers of its parts.
#include <delone/density.hpp>
#include <delone/error.hpp>
#include <delone/io.hpp>

#include "io/atomic_file.hpp"
#include "io/file.hpp"
#include "io/npy.hpp"
#include "io/write_npy.hpp"
#include "io/zip.hpp"

#include <algorithm>
#include <cstddef>
#include <functional>
#include <numeric>
#include <span>
#include <string>
#include <vector>

namespace delone {
namespace io {
namespace {

PointTable table_of_parts(const DensityGrid& grid, std::span<const double> densities) {
  const std::size_t d = grid.shape.size();
  PointTable table;
  table.dimension = static_cast<int>(d) + 1;
  for (std::size_t j = 0; j < d; ++j) table.column_names.push_back("x" + std::to_string(j));
  table.column_names.push_back("density");
  std::vector<std::size_t> part(d, 0);
  for (const double density : densities) {
    for (std::size_t j = 0; j < d; ++j) {
      double x = grid.origin[j];
      for (std::size_t a = 0; a < d; ++a)
        x +=
            (static_cast<double>(part[a]) + 0.5) / static_cast<double>(grid.shape[a]) * grid.sides[a * d + j];
      table.coordinates.push_back(x);
    }
    table.coordinates.push_back(density);
    for (std::size_t a = d; a-- > 0 && ++part[a] == grid.shape[a];) part[a] = 0;
  }
  return table;
}

void write_grid_npz(AtomicFile& file, const DensityGrid& grid, std::span<const double> densities) {
  ZipWriter zip(file);
  std::string storage;
  const std::size_t d = grid.shape.size();
  const auto add = [&](const std::string& name, std::span<const double> numbers,
                       const std::vector<std::size_t>& shape) {
    zip.add(name + ".npy", npy_header("f8", shape), little_endian_bytes(numbers, storage));
  };
  add("density", densities, grid.shape);
  add("origin", grid.origin, {d});
  add("sides", grid.sides, {d, d});
  zip.finish();
}

}  // namespace
}  // namespace io

void write(const std::string& path, const DensityGrid& grid, std::span<const double> densities,
           const std::string& format) {
  const std::size_t d = grid.shape.size(), parts = std::accumulate(grid.shape.begin(), grid.shape.end(),
                                                                   std::size_t{1}, std::multiplies<>());
  if (densities.size() != parts || grid.origin.size() != d || grid.sides.size() != d * d)
    throw Error(Errc::bad_dimension, "a grid of " + std::to_string(parts) + " parts, and " +
                                         std::to_string(densities.size()) + " values");
  const std::string chosen =
      io::choose_format(path, format, "csv", {"npy", "npz", "csv"}, io::Use::writing, "values on a grid");
  if (chosen == "csv") return write_table(path, io::table_of_parts(grid, densities), "csv");
  const std::string name = io::output_name(path);
  io::guarded(name, [&] {
    if (path == "-")
      io::fail(Errc::unsupported, "format '{}' is binary and is not written to standard output", chosen);
    io::AtomicFile file(path);
    if (chosen == "npz") {
      io::write_grid_npz(file, grid, densities);
    } else {
      std::string storage;
      file.write(io::npy_header("f8", grid.shape));
      file.write(io::little_endian_bytes(densities, storage));
    }
    file.commit();
  });
}

}  // namespace delone
