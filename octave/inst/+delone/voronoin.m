## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {[@var{C}, @var{F}] =} delone.voronoin (@var{pts})
## @deftypefnx {} {[@var{C}, @var{F}] =} delone.voronoin (@var{pts}, @var{options})
## The Voronoi diagram of points in any dimension.
##
## @var{pts} has a point in each row.  @var{C} has the vertices of the diagram, the first of which is infinity.  The cell @var{F}@{i@} has
## the numbers of the vertices of the region of point i; a region that is not bounded has vertex 1.  In the plane they go around the region.
## Equal points share a region.  Vertices are rounded once, and more than d+1 points on a sphere have one vertex.
##
## @var{options} of Qhull are accepted, as in @code{delone.delaunayn}: with "Qu" a region contains what is farther from its point than
## from all others, and points that are not extreme have no region, an empty @var{F}@{i@}.
## @seealso{voronoin, delone.region_volumes}
## @end deftypefn

function [C, F] = voronoin (pts, options = [])
  if (nargin < 1)
    delone.internal.usage ("voronoin");
  endif
  kind = "delaunay";
  if (delone.internal.qhull_options ("voronoin", options, "voronoi"))
    kind = "furthest_site";
  endif
  if (rows (pts) <= columns (pts))
    error ("delone:invalid-argument", "voronoin: number of points must be greater than their dimension");
  endif
  [C, F] = delone.internal.regions (__delone__ (kind, pts));
endfunction

%!test
%! [C, F] = delone.voronoin ([0 0; 4 0; 5 3; 1 4; 2 2]);
%! assert (C(1,:), [Inf Inf]);
%! assert (size (F), [5 1]);
%! assert (cellfun (@(f) any (f == 1), F), logical ([1; 1; 1; 1; 0]));
%!test
%! ## four points on a circle have one vertex
%! [C, F] = delone.voronoin ([0 0; 1 0; 0 1; 1 1; 1 1]);
%! assert (C, [Inf Inf; 0.5 0.5]);
%! assert (F{4}, F{5});
%!test
%! ## as far from the region's point as from others
%! x = rand (200, 3);
%! [C, F] = delone.voronoin (x);
%! for i = find (cellfun (@(f) all (f > 1), F))'
%!   for v = F{i}
%!     r = norm (C(v,:) - x(i,:));
%!     assert (min (sqrt (sum ((x - C(v,:)).^2, 2))), r, 1e-9 * max (1, r));
%!   endfor
%! endfor
%!test
%! ## the farthest of all points
%! x = [0 0; 4 0; 5 3; 1 4; 2 2];
%! [C, F] = delone.voronoin (x, "Qu");
%! assert (F{5}, zeros (1, 0));
%! for i = 1:4
%!   for v = F{i}(F{i} > 1)
%!     assert (norm (C(v,:) - x(i,:)), max (sqrt (sum ((x - C(v,:)).^2, 2))), 1e-12);
%!   endfor
%! endfor
%!error <Invalid call> delone.voronoin ()
%!error <number of points must be greater than their dimension> delone.voronoin ([1 2])
%!demo
%! x = rand (20, 2);
%! [C, F] = delone.voronoin (x);
%! clf;
%! plot (x(:,1), x(:,2), "r+");
%! hold on;
%! for i = 1:rows (x)
%!   if (all (F{i} > 1))
%!     patch (C(F{i},1), C(F{i},2), rand (1, 3), "facealpha", 0.4);
%!   endif
%! endfor
%! axis ([0 1 0 1]);
