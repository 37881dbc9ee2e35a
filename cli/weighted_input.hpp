// SPDX-License-Identifier: BSD-3-Clause
// Points with a number each, weights or masses, which are a column of the input or a file of their own.
#pragma once

#include "command.hpp"

#include <string>
#include <vector>

namespace delone::cli {

struct WeightedInput {
  PointInput input;
  std::string weights;               ///< a column's name, a column's number, or a file
  std::string option = "--weights";  ///< what says so
  std::string plural = "weights", singular = "weight";

  void add_to(CLI::App& command, bool required = true);
  /// Where only a column will do: throws UsageError for a file.
  std::string column() const;
  /// Reads the points and one finite weight for each. Errors name the file.
  PointTable read(std::vector<double>& weights_read, unsigned threads = 0) const;
};

}  // namespace delone::cli
