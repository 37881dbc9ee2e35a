## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {@var{distance} =} delone.internal.rounding (@var{pts})
## A distance for what rounding has made of points: 100 eps times the largest number of the smallest column, and not more than the points
## extend.
## @end deftypefn

function distance = rounding (pts)
  pts = double (pts);
  distance = 0;
  if (rows (pts) > 1)
    distance = 100 * eps * min (max (abs (pts), [], 1));
    distance = min (distance, max (max (pts, [], 1) - min (pts, [], 1)));
  endif
endfunction

%!assert (delone.internal.rounding ([0 1; 1 -1000]), 100 * eps)
%!assert (delone.internal.rounding ([7 7; 7 7]), 0)
%!assert (delone.internal.rounding ([7 7]), 0)
