## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{t} =} delone.delaunayTriangulation (@var{pts})
## @deftypefnx {} {@var{t} =} delone.delaunayTriangulation (@var{x}, @var{y})
## @deftypefnx {} {@var{t} =} delone.delaunayTriangulation (@var{x}, @var{y}, @var{z})
## A Delaunay triangulation that answers many questions, as MATLAB's class of this name, in any dimension.
##
## @table @code
## @item @var{t}.Points, @var{t}.ConnectivityList
## the points and, in each row, the points of a simplex,
## @item neighbors (@var{t}), neighbors (@var{t}, @var{id})
## the simplices across the facets opposite each vertex; NaN outside,
## @item edges (@var{t})
## pairs of points,
## @item [@var{H}, @var{v}] = convexHull (@var{t})
## the hull as of delone.convhull, and its volume,
## @item [@var{id}, @var{B}] = pointLocation (@var{t}, @var{Q})
## the simplices that contain queries, NaN outside, and barycentric coordinates,
## @item [@var{id}, @var{d}] = nearestNeighbor (@var{t}, @var{Q})
## the nearest points and their distances,
## @item [@var{V}, @var{R}] = voronoiDiagram (@var{t})
## as of delone.voronoin,
## @item [@var{C}, @var{r}] = circumcenter (@var{t}), circumcenter (@var{t}, @var{id})
## the centers and radii of circumscribed spheres.
## @end table
## @seealso{delone.delaunayn}
## @end deftypefn

classdef delaunayTriangulation
  properties (SetAccess = private)
    Points
    ConnectivityList
  endproperties

  properties (Access = private)
    object
  endproperties

  methods
    function t = delaunayTriangulation (varargin)
      if (nargin < 1 || nargin > 3)
        delone.internal.usage ("delaunayTriangulation");
      endif
      pts = varargin{1};
      if (nargin > 1)
        pts = delone.internal.coordinates ("delaunayTriangulation", varargin);
      endif
      t.object = __delone__ ("delaunay", pts);
      t.Points = full (double (pts));
      t.ConnectivityList = __delone__ ("get", t.object, "cells");
      if (columns (t.ConnectivityList) != columns (pts) + 1)
        t.ConnectivityList = zeros (0, columns (pts) + 1);
      endif
    endfunction

    function n = neighbors (t, id = (1:rows (t.ConnectivityList))')
      n = __delone__ ("get", t.object, "neighbors");
      n = n(id,:);
    endfunction

    function e = edges (t)
      e = sortrows (sort (__delone__ ("get", t.object, "edges"), 2));
    endfunction

    function [H, v] = convexHull (t)
      if (columns (t.Points) == 2)
        [H, v] = delone.convhull (t.Points);
      else
        [H, v] = delone.convhulln (t.Points);
      endif
    endfunction

    function [id, B] = pointLocation (t, varargin)
      Q = queries_of (varargin);
      if (nargout > 1)
        [id, ~, B] = __delone__ ("locate", t.object, Q);
      else
        id = __delone__ ("locate", t.object, Q);
      endif
    endfunction

    function [id, d] = nearestNeighbor (t, varargin)
      Q = queries_of (varargin);
      id = __delone__ ("nearest", t.object, Q, 1);
      if (nargout > 1)
        d = NaN (size (id));
        found = ! isnan (id);
        d(found) = sqrt (sum ((t.Points(id(found),:) - Q(found,:)).^2, 2));
      endif
    endfunction

    function [V, R] = voronoiDiagram (t)
      [V, R] = delone.internal.regions (t.object);
    endfunction

    function [C, r] = circumcenter (t, id = (1:rows (t.ConnectivityList))')
      [C, r] = __delone__ ("get", t.object, "circumcenters", "circumradii");
      C = C(id,:);
      r = r(id);
    endfunction

    function disp (t)
      printf ("  delaunayTriangulation of %d points in %d dimensions: %d simplices\n", rows (t.Points), columns (t.Points),
              rows (t.ConnectivityList));
    endfunction
  endmethods
endclassdef

## Queries as a matrix or as coordinates.
function Q = queries_of (args)
  if (numel (args) == 1)
    Q = double (args{1});
  else
    Q = delone.internal.coordinates ("delaunayTriangulation", args);
  endif
endfunction

%!shared x, t
%! x = rand (50, 3);
%! t = delone.delaunayTriangulation (x);
%!test
%! assert (t.Points, x);
%! assert (t.ConnectivityList, delone.delaunayn (x));
%!test
%! n = neighbors (t);
%! T = t.ConnectivityList;
%! for i = 1:rows (T)
%!   for j = 1:4
%!     if (! isnan (n(i,j)))
%!       assert (numel (intersect (T(i,:), T(n(i,j),:))), 3);
%!       assert (! any (T(n(i,j),:) == T(i,j)));
%!     endif
%!   endfor
%! endfor
%! assert (sum (isnan (n(:))), rows (convexHull (t)));
%! assert (t.neighbors (3), n(3,:));
%!test
%! T = sort (t.ConnectivityList, 2);
%! pairs = unique ([T(:,[1 2]); T(:,[1 3]); T(:,[1 4]); T(:,[2 3]); T(:,[2 4]); T(:,[3 4])], "rows");
%! assert (edges (t), pairs);
%!test
%! [H, v] = convexHull (t);
%! [h, w] = delone.convhulln (x);
%! assert (H, h);
%! assert (v, w);
%!test
%! Q = [0.5 0.5 0.5; 2 2 2];
%! [id, B] = pointLocation (t, Q);
%! assert (isnan (id), [false; true]);
%! assert (B(1,:) * x(t.ConnectivityList(id(1),:),:), Q(1,:), 1e-12);
%! assert (pointLocation (t, 0.5, 0.5, 0.5), id(1));
%!test
%! [id, d] = nearestNeighbor (t, x);
%! assert (id, (1:50)');
%! assert (d, zeros (50, 1));
%!test
%! [V, R] = voronoiDiagram (t);
%! [C, F] = delone.voronoin (x);
%! assert (V, C);
%! assert (R, F);
%!test
%! [C, r] = circumcenter (t);
%! for j = 1:4
%!   assert (sqrt (sum ((x(t.ConnectivityList(:,j),:) - C).^2, 2)), r, 1e-9 * max (1, max (r)));
%! endfor
%! assert (circumcenter (t, 2), C(2,:));
%!test
%! u = delone.delaunayTriangulation ([0 1 0 1], [0 0 1 1]);
%! assert (convexHull (u), [1; 2; 4; 3; 1]);
%! assert (size (u.ConnectivityList), [2 3]);
%!error <Invalid call> delone.delaunayTriangulation ()
%!error <a coordinate of point 2> delone.delaunayTriangulation ([0 0; NaN 1])
%!demo
%! t = delone.delaunayTriangulation (rand (30, 2))
%! H = convexHull (t);
%! clf;
%! triplot (t.ConnectivityList, t.Points(:,1), t.Points(:,2));
%! hold on;
%! plot (t.Points(H,1), t.Points(H,2), "r-", "linewidth", 2);
