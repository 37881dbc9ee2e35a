// SPDX-License-Identifier: BSD-3-Clause
// The rows of the input that a rank reads.
#pragma once

#include "ranks.hpp"
#include "tiles/point_stream.hpp"

#include <delone/tiles.hpp>

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace delone::mpi {

/// All ranks together read every row once. Each sees them in the order of their numbers.
class Share final : public tiles::PointStream {
 public:
  /// Of files. One is read by all ranks: each has a range of rows where they can be found without reading
  /// what is before them; of others every rank reads all, and keeps each `size`-th chunk. Of several files a
  /// rank has consecutive ones. Not collective: may throw on some ranks only.
  Share(const std::vector<std::string>& files, const Ranks& ranks, const TilesOptions& options);
  /// Of points in memory.
  explicit Share(PointsView rows);

  /// 0: this rank has no file, or rows in memory without a dimension.
  int dimension() const override;
  std::optional<std::uint64_t> size_hint() const override { return {}; }
  bool next(std::vector<double>& rows) override;
  void rewind() override;

  /// The number among all rows of the first one that next() has returned last, if the rows of all ranks
  /// before are `offset`.
  std::int64_t first_row(std::int64_t offset) const { return row_ + (is_dealt_ ? 0 : offset); }
  /// Whether the rows of this rank are spread over all rows, and `offset` does not matter.
  bool is_dealt() const { return is_dealt_; }

 private:
  std::vector<std::unique_ptr<PointStream>> streams_;
  std::size_t stream_ = 0;
  // A file that every rank reads: this one keeps the chunks of these numbers modulo the number of ranks.
  bool is_dealt_ = false;
  std::uint64_t chunk_ = 0, kept_ = 0, modulus_ = 1;
  std::int64_t row_ = 0, next_row_ = 0;
};

/// With %d: the files that there are with 0, 1, 2, … in its place. Throws cannot_open if there is none.
std::vector<std::string> files_of(const std::vector<std::string>& inputs);

}  // namespace delone::mpi
