## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{V} =} delone.intersection_volumes (@var{sets})
## @deftypefnx {} {@var{v} =} delone.intersection_volumes (@var{sets}, @var{pairs})
## The volumes of the intersections of the convex hulls of many sets of points, two hulls each.
##
## @var{sets} is a cell array as for @code{delone.convex_hulls}.  V(i,j) is the volume that the hulls of sets i and j have in common; on the
## diagonal are the volumes of the hulls.  With @var{pairs}, two numbers of sets in each row, @var{v} has a volume for each row.  A volume
## is off by a few rounding errors of the size of the hulls.
## @seealso{delone.convex_hulls}
## @end deftypefn

function V = intersection_volumes (sets, pairs = [])
  if (nargin < 1 || ! iscell (sets))
    delone.internal.usage ("intersection_volumes");
  endif
  n = numel (sets);
  hulls = __delone__ ("convex_hulls", vertcat (sets{:}), [0; cumsum(cellfun (@rows, sets(:)))]);
  if (nargin > 1)
    if (columns (pairs) != 2)
      error ("delone:bad-dimension", "intersection_volumes: PAIRS must have two columns");
    endif
    V = __delone__ ("intersection_volumes", hulls, pairs);
    return;
  endif
  [i, j] = find (triu (ones (n), 1));
  V = full (diag (__delone__ ("get", hulls, "volumes")));
  V(sub2ind ([n, n], [i; j], [j; i])) = repmat (__delone__ ("intersection_volumes", hulls, [i, j]), 2, 1);
endfunction

%!shared sets
%! box = dec2bin (0:7) - "0";
%! sets = {box, box + 0.5, 2 * box - 0.5, box + 3};
%!assert (delone.intersection_volumes (sets), [1, 1/8, 1, 0; 1/8, 1, 1, 0; 1, 1, 8, 0; 0, 0, 0, 1], 1e-14)
%!assert (delone.intersection_volumes (sets, [2 1; 1 1]), [1/8; 1], 1e-14)
%!assert (delone.intersection_volumes ({[0 0; 1 0; 0 1]}), 0.5)
%!error <Invalid call> delone.intersection_volumes (rand (3))
%!error <PAIRS must have two columns> delone.intersection_volumes (sets, 1)
%!error <has the number 5, and there are hulls 1 to 4> delone.intersection_volumes (sets, [1 5])
%!demo
%! sets = arrayfun (@(i) rand (20, 3) + i / 10, 1:4, "uniformoutput", false);
%! V = delone.intersection_volumes (sets)
