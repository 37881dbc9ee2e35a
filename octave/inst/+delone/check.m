## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{ok} =} delone.check (@var{pts}, @var{T})
## @deftypefnx {} {[@var{ok}, @var{violation}] =} delone.check (@var{pts}, @var{T})
## Prove that simplices are a Delaunay triangulation of points, exactly.
##
## @var{T} may come from any program, and the vertices of a simplex in any order.  @var{violation} says what is wrong, with points and cells
## counted from 0.
## @seealso{delone.delaunayn}
## @end deftypefn

function [ok, violation] = check (pts, T)
  if (nargin != 2)
    delone.internal.usage ("check");
  endif
  report = __delone__ ("check", __delone__ ("cells", pts, T), struct ("oriented", 0));
  [ok, violation] = __delone__ ("get", report, "ok", "violation");
  ok = logical (ok);
endfunction

%!test
%! x = rand (60, 3);
%! T = delone.delaunayn (x);
%! assert (delone.check (x, T));
%! [ok, violation] = delone.check (x, T(2:end,:));
%! assert (ok, false);
%! assert (! isempty (violation));
%!assert (delone.check ([0 0; 3 0; 0 1; 3 1; 1.4 0.4], [1 2 5; 2 4 5; 4 3 5; 3 1 5]))
%!assert (delone.check ([0 0; 3 0; 0 3; 2 2], [1 2 3; 2 4 3]), false)
%!error <Invalid call> delone.check (1)
%!demo
%! x = rand (100, 2);
%! T = delone.delaunayn (x);
%! ok = delone.check (x, T)
%! [ok, violation] = delone.check (x, T(2:end,:))
