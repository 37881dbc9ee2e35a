// SPDX-License-Identifier: BSD-3-Clause
// Rows of points in chunks: an input that need not fit into memory, and that is read more than once.
#pragma once

#include "base/progress_meter.hpp"

#include <delone/io.hpp>
#include <delone/types.hpp>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace delone::tiles {

class PointStream {
 public:
  PointStream() = default;
  PointStream(const PointStream&) = delete;
  PointStream& operator=(const PointStream&) = delete;
  virtual ~PointStream() = default;

  /// The numbers of a row: where the last of them is a weight, one more than points have coordinates.
  virtual int dimension() const = 0;
  /// The number of rows, where that is known before they are read.
  virtual std::optional<std::uint64_t> size_hint() const = 0;
  /// Replaces `rows` by the next ones, about a megabyte of them; false, and none, at the end. Throws
  /// not_finite with the rows of the input, and what the format throws.
  virtual bool next(std::vector<double>& rows) = 0;
  /// Goes back to the first row.
  virtual void rewind() = 0;
  /// From now on there are the rows first … last − 1 only, where that saves reading the others; false, and no
  /// change, otherwise. REQUIRES first ≤ last ≤ size_hint(), and no earlier call. Rewinds.
  virtual bool restrict_to(std::uint64_t /*first*/, std::uint64_t /*last*/) { return false; }
};

/// Calls visit(row) for every row, from the first one on. A cancellation point.
template <class Visit>
void each_point(PointStream& points, const Visit& visit) {
  std::vector<double> rows;
  points.rewind();
  while (points.next(rows)) {
    internal::cancellation_point();
    for (std::size_t at = 0; at < rows.size(); at += static_cast<std::size_t>(points.dimension()))
      visit(&rows[at]);
  }
}

struct StreamOptions {
  /// As ReadOptions::format, or raw: little-endian doubles, the numbers of a row one after the other; empty:
  /// by extension, where raw and bin are raw.
  std::string format;
  /// The numbers of a row of a raw file; 0: not known. Other formats tell; then it has to agree, unless 0.
  int dimension = 0;
  /// The columns to read, as ReadOptions::columns, and one that comes after them; empty: all others, and
  /// none.
  std::vector<std::string> columns;
  std::string last_column;
  /// A folder for copies of streams that cannot be read twice.
  std::string scratch_folder;
  std::uint64_t max_stream_bytes = default_max_stream_bytes;
};

/// A file of points. npy, raw, csv, tsv, txt, xyz, pts and qhull are read in chunks, with memory for some
/// megabytes; others at once, as by read_points(). What is not a regular file, as standard input, is copied
/// to the scratch folder first, and a compressed file is decompressed there; a raw one is compressed if its
/// name ends with .gz. Messages are those of read_points().
std::unique_ptr<PointStream> open_point_stream(const std::string& path, const StreamOptions& options = {});
/// Points in memory, which have to outlive the stream.
std::unique_ptr<PointStream> stream_of(PointsView rows);

}  // namespace delone::tiles
