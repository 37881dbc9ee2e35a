## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {} delone.internal.usage (@var{name})
## The error of a function of the namespace that was called in a wrong way; Octave's print_usage does not find these functions.
## @end deftypefn

function usage (name)
  error ("Octave:invalid-fun-call", 'Invalid call to delone.%s; see delone.help ("%s")', name, name);
endfunction

%!error <Invalid call to delone.nearest> delone.internal.usage ("nearest")
