## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {@var{T} =} delone.furthest_site (@var{pts})
## The furthest-site Delaunay triangulation: simplices whose circumscribed spheres have no point outside.
##
## @var{T} is as for @code{delone.delaunayn}.  Its vertices are extreme points of the convex hull.
## @seealso{delone.delaunayn, delone.voronoin}
## @end deftypefn

function T = furthest_site (pts)
  if (nargin != 1)
    delone.internal.usage ("furthest_site");
  endif
  T = __delone__ ("get", __delone__ ("furthest_site", pts), "cells");
  if (columns (T) != columns (pts) + 1)
    T = zeros (0, columns (pts) + 1);
  endif
endfunction

%!test
%! x = rand (40, 2);
%! T = delone.furthest_site (x);
%! H = delone.convhull (x);
%! assert (unique (T(:)), unique (H));
%! for t = T'
%!   A = 2 * (x(t(2:3),:) - x(t(1),:));
%!   c = (A \ (sum (x(t(2:3),:).^2, 2) - sum (x(t(1),:).^2)))';
%!   assert (max (sqrt (sum ((x - c).^2, 2))), norm (x(t(1),:) - c), 1e-9 * norm (c));
%! endfor
%!assert (delone.furthest_site ([0 0; 1 1; 2 2]), zeros (0, 3))
%!error <Invalid call> delone.furthest_site ()
%!demo
%! t = 2 * pi * rand (12, 1);
%! x = [cos(t), 0.5 * sin(t)];
%! clf;
%! triplot (delone.furthest_site (x), x(:,1), x(:,2));
