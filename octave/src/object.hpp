// SPDX-License-Identifier: BSD-3-Clause
// An object of the C interface as a value of Octave: freed with its last copy.
#pragma once

#include <delone/delone.h>
#include <octave/oct.h>
#include <octave/ov-base.h>

#include <memory>
#include <string>
#include <utility>

namespace delone_octave {

class Object final : public octave_base_value {
 public:
  Object() = default;
  explicit Object(delone_object* owned) : object_(owned, delone_free) {}

  delone_object* get() const { return object_.get(); }

  bool is_defined() const override { return true; }
  bool is_constant() const override { return true; }
  dim_vector dims() const override { return dim_vector(1, 1); }
  void print(std::ostream& out, bool as_read_syntax = false) override;
  void print_raw(std::ostream& out, bool as_read_syntax = false) const override;

 private:
  std::shared_ptr<delone_object> object_;

  DECLARE_OV_TYPEID_FUNCTIONS_AND_DATA
};

/// The object that a value holds. Raises an error of Octave if it holds none.
const Object& object_of(const octave_value& value);

}  // namespace delone_octave
