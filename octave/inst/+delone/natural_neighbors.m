## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {[@var{neighbors}, @var{weights}] =} delone.natural_neighbors (@var{pts}, @var{xi})
## The natural neighbors of queries and their Sibson coordinates.
##
## The cells @var{neighbors}@{i@} and @var{weights}@{i@} have the numbers of the points whose Voronoi regions a new point in row i of
## @var{xi} would take a part of, and which fraction of its own region each part is.  They are empty outside the convex hull.
## @seealso{delone.interpolate, delone.nearest}
## @end deftypefn

function [neighbors, weights] = natural_neighbors (pts, xi)
  if (nargin != 2)
    delone.internal.usage ("natural_neighbors");
  endif
  lists = __delone__ ("natural_neighbors", __delone__ ("delaunay", pts), xi);
  neighbors = __delone__ ("lists", lists, "offsets", "rows");
  if (nargout > 1)
    weights = __delone__ ("lists", lists, "offsets", "weights");
  endif
endfunction

%!test
%! x = [rand(50, 2); 0 0; 1 0; 0 1; 1 1];
%! xi = rand (20, 2);
%! [n, w] = delone.natural_neighbors (x, xi);
%! for i = 1:20
%!   assert (w{i} * x(n{i},:), xi(i,:), 1e-9);
%!   assert (sum (w{i}), 1, 1e-12);
%! endfor
%!test
%! [n, w] = delone.natural_neighbors ([0 0; 1 0; 0 1; 1 1], [0.5 0.5; 3 3]);
%! assert (sort (n{1}), 1:4);
%! assert (w{1}, [0.25 0.25 0.25 0.25], 1e-12);
%! assert (isempty (n{2}) && isempty (w{2}));
%!error <Invalid call> delone.natural_neighbors (1)
%!demo
%! [neighbors, weights] = delone.natural_neighbors ([0 0; 1 0; 0 1; 1 1], [0.25 0.5])
