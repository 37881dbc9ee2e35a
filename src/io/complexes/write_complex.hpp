// SPDX-License-Identifier: BSD-3-Clause
// The writers of triangulations, one per format. The data have been validated; the caller commits the file.
#pragma once

#include <delone/complex.hpp>

namespace delone::io {

class AtomicFile;

void write_npz(AtomicFile& file, const ComplexData& data);
void write_json(AtomicFile& file, const ComplexData& data);
void write_off(AtomicFile& file, const ComplexData& data);
/// VTK's XML format for unstructured grids, arrays appended as raw bytes. Throws unsupported for d > 3.
void write_vtu(AtomicFile& file, const ComplexData& data);
/// Throws unsupported unless d = 2.
void write_svg(AtomicFile& file, const ComplexData& data);

}  // namespace delone::io
