// SPDX-License-Identifier: BSD-3-Clause
// Readers and writers of polyhedra, in the form of cddlib and lrs: .ine files hold inequalities, .ext files
// generators. Paths, compressed files, limits and errors are as in io.hpp.
#pragma once

#include <delone/export.hpp>
#include <delone/io.hpp>
#include <delone/options.hpp>
#include <delone/polyhedron.hpp>
#include <delone/rational.hpp>

#include <cstdint>
#include <string>

namespace delone {

/// What such a file holds: one description of a polyhedron, with rows as they are given to
/// Polyhedron::from_inequalities() or from_generators(), in the order of the file.
struct DELONE_EXPORT_TYPE PolyhedronRows {
  int dimension = 0;
  bool has_generators = false;           ///< otherwise it has inequalities
  RationalRows inequalities, equations;  ///< a·x ≤ b and a·x = b, as (a, b)
  RationalRows vertices, rays, lines;
};

/// Reads a file:
///   H-representation or V-representation   the first of them, if there is neither
///   linearity k i_1 … i_k                  rows that are equations, or lines; counted from 1
///   nonnegative                            all coordinates are ≥ 0, besides
///   begin, m n type, rows, end             type: integer, rational or real; m may be stars
/// A row of inequalities is (b, −a), one of generators (1, x) for a vertex and (0, x) for a ray or line. Real
/// numbers mean what their digits say. Lines that begin with * or # are comments; other lines outside of the
/// rows say what a program is to do, and mean nothing here. Throws Errc::bad_format with "FILE:LINE: …", and
/// as all readers.
DELONE_EXPORT PolyhedronRows read_polyhedron(const std::string& path,
                                             std::uint64_t max_stream_bytes = default_max_stream_bytes);

/// The polyhedron of these rows. Throws as its constructors.
DELONE_EXPORT Polyhedron to_polyhedron(const PolyhedronRows& rows, const Options& options = {});

/// Writes one of the two descriptions: `ine`, inequalities and equations, or `ext`, vertices, rays and lines.
/// Standard output takes both, `ine` by default. Throws Errc::unsupported for other formats, and as all
/// writers.
DELONE_EXPORT void write_polyhedron(const std::string& path, const Polyhedron& polyhedron,
                                    const std::string& format = {});

}  // namespace delone
