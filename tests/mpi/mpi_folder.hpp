// SPDX-License-Identifier: BSD-3-Clause
// What tests by several ranks share: a folder, and rows for each rank.
#pragma once

#include "degenerate.hpp"

#include <delone/points.hpp>

#include <gtest/gtest.h>
#include <mpi.h>
#include <stdlib.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace delone::test {

inline int rank_of() {
  int rank = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  return rank;
}
inline int num_ranks() {
  int size = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  return size;
}

/// A folder that all ranks see, removed at the end.
class MpiTiles : public testing::Test {
 protected:
  MpiTiles() {
    std::array<char, 64> name{};
    if (rank_of() == 0) {
      std::string text = (std::filesystem::temp_directory_path() / "delone-mpi-XXXXXX").string();
      if (mkdtemp(text.data()) != nullptr) std::copy(text.begin(), text.end(), name.begin());
    }
    MPI_Bcast(name.data(), static_cast<int>(name.size()), MPI_CHAR, 0, MPI_COMM_WORLD);
    top_ = name.data();
  }
  ~MpiTiles() override {
    MPI_Barrier(MPI_COMM_WORLD);
    if (rank_of() == 0) std::filesystem::remove_all(top_);
  }
  std::string path(const std::string& name) const { return top_ + "/" + name; }

 private:
  std::string top_;
};

/// The rows of this rank: shares are of unequal sizes, and some may be empty.
inline PointsView rows_of_rank(const std::vector<double>& rows, int columns, std::uint64_t seed) {
  Random random(seed);
  const auto p = static_cast<std::size_t>(num_ranks()), width = static_cast<std::size_t>(columns);
  const std::size_t n = rows.size() / width;
  std::vector<std::size_t> cuts{0, n};
  for (std::size_t i = 1; i < p; ++i) cuts.push_back(random.bits() % (n + 1));
  std::sort(cuts.begin(), cuts.end());
  const auto r = static_cast<std::size_t>(rank_of());
  return {std::span(rows).subspan(cuts[r] * width, (cuts[r + 1] - cuts[r]) * width), columns};
}

}  // namespace delone::test
