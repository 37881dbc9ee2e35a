// SPDX-License-Identifier: BSD-3-Clause
// Triangulations and intersections of halfspaces as OFF, the format of Geomview.
#include "io/atomic_file.hpp"
#include "io/complexes/pictures.hpp"
#include "io/file.hpp"
#include "io/points/off.hpp"

namespace delone::io {

void write_off(AtomicFile& file, const ComplexData& data) {
  if (data.dimension == 3)
    file.write("OFF\n");
  else
    file.print("nOFF\n{}\n", data.dimension);
  file.print("{} {} 0\n", data.num_points(), data.num_cells());
  const auto dimension = static_cast<std::size_t>(data.dimension),
             corners = static_cast<std::size_t>(data.affine_dimension + 1);
  for (std::size_t i = 0; i < data.points.size(); ++i) {
    file.put(data.points[i]);
    file.put((i + 1) % dimension == 0 ? '\n' : ' ');
  }
  for (std::size_t i = 0; i < data.cells.size(); ++i) {
    if (i % corners == 0) file.put(corners);
    file.put(' ');
    file.put(data.cells[i]);
    if ((i + 1) % corners == 0) file.put('\n');
  }
  // At the end, where no reader stumbles over it. With a tolerance, which the file does not hold, they would
  // be no such hull.
  if (data.kind != DataKind::unknown && data.tolerance == 0)
    file.print("{}{}\n", off_kind_comment, name_of(data.kind));
}

void write_off(AtomicFile& file, const IntersectionData& data) {
  if (data.dimension != 3 || !data.bounded)
    fail(Errc::unsupported, "format 'off' needs a bounded intersection in dimension 3");
  const bool no_lists = data.facet_offsets.empty() && data.num_facets() == 0;
  if (!no_lists && data.facet_offsets.size() != data.num_facets() + 1)
    fail(Errc::invalid_argument, "cannot write: facet_offsets has {} numbers for {} facets",
         data.facet_offsets.size(), data.num_facets());
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

}  // namespace delone::io
