## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {@var{v} =} delone.version ()
## The version of the library.
## @end deftypefn

function v = version ()
  v = __delone__ ("version");
endfunction

%!assert (ischar (delone.version ()) && any (delone.version () == "."))
%!demo
%! delone.version ()
