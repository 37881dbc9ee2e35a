// SPDX-License-Identifier: BSD-3-Clause
#include "object.hpp"

#include <ostream>

namespace delone_octave {

DEFINE_OV_TYPEID_FUNCTIONS_AND_DATA(Object, "delone object", "delone object")

void Object::print(std::ostream& out, bool as_read_syntax) {
  print_raw(out, as_read_syntax);
  newline(out);
}

void Object::print_raw(std::ostream& out, bool) const { out << "<delone " << delone_kind(get()) << ">"; }

const Object& object_of(const octave_value& value) {
  if (value.type_id() != Object::static_type_id())
    error_with_id("delone:invalid-argument", "delone: a %s is no object of delone",
                  value.class_name().c_str());
  return dynamic_cast<const Object&>(value.get_rep());
}

}  // namespace delone_octave
