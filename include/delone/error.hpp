// SPDX-License-Identifier: BSD-3-Clause
// The one exception type of the library. Degenerate input (flat, duplicate, empty) is a result and never an
// error.
#pragma once

#include <delone/export.hpp>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace delone {

enum class Errc {
  not_finite,        ///< a coordinate is NaN or infinite; rows() names the points
  bad_dimension,     ///< dimension below 1, or different from the one expected
  too_many,          ///< the id space of this build is exhausted
  out_of_memory,     ///< an allocation failed, or a memory budget was reached
  cancelled,         ///< the progress callback asked to stop
  invalid_argument,  ///< an option or id outside its documented range
  cannot_open,       ///< a file could not be opened or created
  bad_format,        ///< a file is not what its format promises; the message names the line or row
  cannot_write,      ///< a file could not be written completely
  unsupported,       ///< a format, or a combination of format and content, that is not available
  time_limit,        ///< a construction took longer than Options::time_limit
};

/// What went wrong (what()), its kind (code()) and the input rows concerned, if any (rows()): rows of the
/// arguments of the call that throws, counted from 0.
class DELONE_EXPORT_TYPE Error : public std::runtime_error {
 public:
  Error(Errc code, const std::string& message, std::vector<std::size_t> rows = {})
      : std::runtime_error(message), code_(code), rows_(std::move(rows)) {}

  Errc code() const { return code_; }
  const std::vector<std::size_t>& rows() const { return rows_; }

 private:
  Errc code_;
  std::vector<std::size_t> rows_;
};

}  // namespace delone
