// SPDX-License-Identifier: BSD-3-Clause
// What the functions of the package ask for, by name: each is one call of the C interface.
#pragma once

#include <octave/oct.h>

#include <string>

namespace delone_octave {

/// The arguments of an operation; those that are missing are undefined.
class Arguments {
 public:
  explicit Arguments(const octave_value_list& all) : all_(all) {}
  /// Number i after the name of the operation.
  octave_value operator[](octave_idx_type i) const {
    return i + 1 < all_.length() ? all_(i + 1) : octave_value();
  }

 private:
  const octave_value_list& all_;
};

/// Raises an error for an unknown name.
octave_value_list operate(const std::string& name, const Arguments& arguments, int nargout);

}  // namespace delone_octave
