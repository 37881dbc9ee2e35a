// SPDX-License-Identifier: BSD-3-Clause
// The one function that Octave loads. The functions of the namespace delone call it; users do not.
#include "object.hpp"
#include "operations.hpp"

#include <octave/interpreter.h>
#include <octave/oct.h>

DEFMETHOD_DLD(__delone__, interp, args, nargout,
              "-*- texinfo -*-\n@deftypefn {} {} __delone__ (@var{operation}, @dots{})\n"
              "Undocumented internal function of the package delone.\n@end deftypefn") {
  if (args.length() < 1) print_usage();
  // Values of the type that this file defines may outlive the last function that uses it.
  if (delone_octave::Object::static_type_id() < 0) {
    delone_octave::Object::register_type();
    interp.mlock();
  }
  return delone_octave::operate(args(0).string_value(), delone_octave::Arguments(args), nargout);
}
