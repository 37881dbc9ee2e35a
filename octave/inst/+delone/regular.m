## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{T} =} delone.regular (@var{pts}, @var{weights})
## @deftypefnx {} {[@var{T}, @var{hidden}] =} delone.regular (@dots{})
## The regular triangulation (weighted Delaunay triangulation) of points with weights.
##
## A weight has the unit of squared lengths: the squared radius of a ball, for instance.  @var{T} is as for @code{delone.delaunayn}.
## @var{hidden} has the numbers of the points that are no vertices because of their weights.
## @seealso{delone.delaunayn, delone.region_volumes, delone.alpha_complex}
## @end deftypefn

function [T, hidden] = regular (pts, weights)
  if (nargin != 2)
    delone.internal.usage ("regular");
  endif
  t = __delone__ ("regular", pts, weights(:));
  [T, vertex] = __delone__ ("get", t, "cells", "vertex_of_point");
  if (columns (T) != columns (pts) + 1)
    T = zeros (0, columns (pts) + 1);
  endif
  hidden = find (isnan (vertex));
endfunction

%!test
%! ## equal weights change nothing
%! x = rand (50, 3);
%! assert (sortrows (sort (delone.regular (x, ones (50, 1)), 2)), sortrows (sort (delone.delaunayn (x), 2)));
%!test
%! ## the lower hull of the lifted points
%! x = rand (60, 2);
%! w = 0.05 * rand (60, 1);
%! [T, hidden] = delone.regular (x, w);
%! [H, V] = delone.convhulln ([x, sum(x.^2, 2) - w]);
%! lifted = [x, sum(x.^2, 2) - w];
%! down = arrayfun (@(i) det ([lifted(H(i,2),1:2) - lifted(H(i,1),1:2); lifted(H(i,3),1:2) - lifted(H(i,1),1:2)]) < 0, 1:rows (H));
%! assert (sortrows (sort (T, 2)), sortrows (sort (H(down,:), 2)));
%! assert (hidden, setdiff ((1:60)', T(:)));
%!error <Invalid call> delone.regular (1)
%!error <the matrix of weights has 1 rows, and must have 2> delone.regular ([0 0; 1 1], 1)
%!error id=delone:not-finite delone.regular ([0 0; 1 1], [1 NaN])
%!demo
%! x = rand (40, 2);
%! w = 0.02 * rand (40, 1);
%! clf;
%! triplot (delone.regular (x, w), x(:,1), x(:,2));
