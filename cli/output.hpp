// SPDX-License-Identifier: BSD-3-Clause
// What the command writes itself: text on standard output or in a file that appears whole or not at all, and
// early checks of outputs, so that hours of work do not end in a misspelt path.
#pragma once

#include <delone/delone.hpp>

#include <string>
#include <string_view>

namespace delone::cli {

/// Text to standard output. Throws cannot_write.
void print_output(std::string_view text);

/// Text to a file, or to standard output for "-". Throws cannot_write; an existing file stays as it was then.
void write_text(const std::string& path, std::string_view text);

/// Writes a triangulation so that Ctrl-C leaves no partial file.
void write_complex_output(const std::string& path, const ComplexData& data, const std::string& format);
void write_voronoi_output(const std::string& path, const Diagram& diagram, const Box* box,
                          const std::string& format);
void write_points_output(const std::string& path, const PointTable& points, const std::string& format);

/// Throws what write_complex() would throw in the end: an unknown format, one that does not suit the
/// dimension, a folder that is missing or not writable.
void check_complex_output(const std::string& path, const std::string& format, int dimension);

/// Throws cannot_write if no file can be made at that path.
void check_writable(const std::string& path);

}  // namespace delone::cli
