## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{H} =} delone.convhulln (@var{pts})
## @deftypefnx {} {@var{H} =} delone.convhulln (@var{pts}, @var{options})
## @deftypefnx {} {[@var{H}, @var{V}] =} delone.convhulln (@dots{})
## The convex hull of points in any dimension, and its volume.
##
## @var{pts} has a point in each row.  A row of @var{H} has the numbers of the points of a simplex of the boundary, with the outside of the
## hull in front: edges of a polygon go around it counterclockwise.  Facets with more vertices consist of several simplices.  All
## decisions are exact, and points that are not extreme are in no simplex.  If the points lie in a hyperplane, @var{H} is empty and
## @var{V} is 0.
##
## @var{options} of Qhull are accepted, as in @code{delone.delaunayn}.
## @seealso{convhulln, delone.convhull, delone.halfspaces, delone.in_hull}
## @end deftypefn

function [H, V] = convhulln (pts, options = [])
  if (nargin < 1)
    delone.internal.usage ("convhulln");
  endif
  delone.internal.qhull_options ("convhulln", options, "hull");
  hull = __delone__ ("convex_hulls", pts, [0; rows(pts)]);
  [H, V] = __delone__ ("get", hull, "cells", "volumes");
endfunction

%!test
%! cube = [0 0 0; 1 0 0; 1 1 0; 0 1 0; 0 0 1; 1 0 1; 1 1 1; 0 1 1];
%! [H, V] = delone.convhulln ([cube; 0.5 0.5 0.5; 0.5 0.5 0]);
%! assert (size (H), [12 3]);
%! assert (max (H(:)), 8);
%! assert (V, 1);
%!test
%! ## outside in front
%! x = rand (100, 3);
%! H = delone.convhulln (x);
%! inside = mean (x);
%! assert (all (arrayfun (@(i) det (x(H(i,:),:) - inside), 1:rows (H)) > 0));
%!test
%! H = delone.convhulln ([0 0; 1 1; 1 0; 1 2]);
%! assert (sortrows (H), [1 3; 3 4; 4 1]);
%!test
%! ## flat and no points
%! [H, V] = delone.convhulln ([0 0 0; 1 0 0; 0 1 0; 1 1 0]);
%! assert (H, zeros (0, 3));
%! assert (V, 0);
%! assert (delone.convhulln (zeros (0, 2)), zeros (0, 2));
%!test
%! ## lines have two ends
%! [H, V] = delone.convhulln ([3; 1; 2]);
%! assert (sort (H), [1; 2]);
%! assert (V, 2);
%!error <Invalid call> delone.convhulln ()
%!error <a coordinate of point 1> delone.convhulln ([NaN 1; 2 3])
%!demo
%! x = randn (200, 3);
%! H = delone.convhulln (x);
%! clf;
%! trisurf (H, x(:,1), x(:,2), x(:,3));
