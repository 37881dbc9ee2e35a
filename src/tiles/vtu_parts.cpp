// SPDX-License-Identifier: BSD-3-Clause
#include "tiles/vtu_parts.hpp"

#include "io/atomic_file.hpp"
#include "io/complexes/pictures.hpp"
#include "io/file.hpp"
#include "tiles/part_file.hpp"

namespace delone::tiles {

namespace {

constexpr const char* grid_name = "tiles.pvtu";

std::string vtu_name(std::size_t number) { return fmt::format("part-{:04}.vtu", number); }

}  // namespace

void require_vtu(const std::string& folder, int dimension) {
  if (dimension > 3)
    io::fail(Errc::unsupported, "{}: a .vtu file holds at most 3 dimensions, these points have {}",
             io::output_name(path_in(folder, grid_name)), dimension);
}

void write_vtu_parts(const std::string& folder, const TilesIndex& index) {
  require_vtu(folder, index.dimension);
  io::guarded(io::output_name(folder), [&] {
    for (std::size_t i = 0; i < index.parts.size(); ++i) {
      const TileData part = read_part(folder, i);
      io::AtomicFile file(path_in(folder, vtu_name(i)));
      io::write_vtu(file, io::VtuSimplices<std::int32_t>{part.dimension, part.affine_dimension, part.points,
                                                         part.cells, part.rows, index.parts[i].first_cell});
      file.commit();
    }
    io::AtomicFile file(path_in(folder, grid_name));
    file.write(
        "<?xml version=\"1.0\"?>\n"
        "<VTKFile type=\"PUnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\" "
        "header_type=\"UInt64\">\n"
        "  <PUnstructuredGrid GhostLevel=\"0\">\n"
        "    <PPointData>\n      <PDataArray type=\"Int64\" Name=\"row\"/>\n    </PPointData>\n"
        "    <PCellData>\n      <PDataArray type=\"Int64\" Name=\"cell\"/>\n    </PCellData>\n"
        "    <PPoints>\n      <PDataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\"/>\n    "
        "</PPoints>\n");
    for (std::size_t i = 0; i < index.parts.size(); ++i)
      if (index.parts[i].num_cells > 0) file.print("    <Piece Source=\"{}\"/>\n", vtu_name(i));
    file.write("  </PUnstructuredGrid>\n</VTKFile>\n");
    file.commit();
  });
}

}  // namespace delone::tiles
