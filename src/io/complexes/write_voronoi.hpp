// SPDX-License-Identifier: BSD-3-Clause
// The writers of Voronoi and power diagrams, one per format. The caller commits the file.
#pragma once

#include <delone/voronoi.hpp>

namespace delone::io {

class AtomicFile;

void write_voronoi_npz(AtomicFile& file, const VoronoiData& data);
void write_voronoi_json(AtomicFile& file, const VoronoiData& data);
/// Throws unsupported unless d = 2.
void write_voronoi_svg(AtomicFile& file, const Diagram& diagram, const Box& box);
/// Throws unsupported unless d = 2 or 3.
void write_voronoi_vtu(AtomicFile& file, const Diagram& diagram, const Box& box);

}  // namespace delone::io
