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
## the centers and radii of circumscribed spheres,
## @item @var{u} = insert (@var{t}, @var{pts}), @var{u} = remove (@var{t}, @var{rows}), @var{u} = move (@var{t}, @var{rows}, @var{pts})
## another triangulation, with more points, with fewer, or with other points in some rows.  It is exactly that of its points.
## Rows keep their numbers; the points of removed rows are NaN,
## @item write (@var{t}, @var{file}), write (@var{t}, @var{file}, @var{format})
## writes it as @code{delone.write} does.
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
      t = with_members (t);
    endfunction

    function t = insert (t, pts)
      t.object = __delone__ ("insert", t.object, pts);
      t = with_members (t);
    endfunction

    function t = remove (t, rows)
      t.object = __delone__ ("remove", t.object, rows(:));
      t = with_members (t);
    endfunction

    function t = move (t, rows, pts)
      t.object = __delone__ ("move", t.object, rows(:), pts);
      t = with_members (t);
    endfunction

    function write (t, file, format = "")
      __delone__ ("write", t.object, file, format);
    endfunction

    function n = neighbors (t, id = (1:rows (t.ConnectivityList))')
      n = __delone__ ("get", t.object, "neighbors");
      n = n(id,:);
    endfunction

    function e = edges (t)
      e = sortrows (sort (__delone__ ("get", t.object, "edges"), 2));
    endfunction

    function [H, v] = convexHull (t)
      present = find (! isnan (t.Points(:,1)));
      if (columns (t.Points) == 2)
        [H, v] = delone.convhull (t.Points(present,:));
      else
        [H, v] = delone.convhulln (t.Points(present,:));
      endif
      H = present(H);
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

  methods (Access = private)
    function t = with_members (t)
      [t.Points, t.ConnectivityList, d] = __delone__ ("get", t.object, "points", "cells", "dimension");
      if (columns (t.ConnectivityList) != d + 1)
        t.ConnectivityList = zeros (0, d + 1);
      endif
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
%!test
%! ## changes, of copies
%! more = insert (t, [2 2 2; 3 0 0]);
%! assert (more.Points, [x; 2 2 2; 3 0 0]);
%! assert (sortrows (sort (more.ConnectivityList, 2)), sortrows (sort (delone.delaunayn (more.Points), 2)));
%! fewer = remove (more, [3; 51]);
%! assert (find (isnan (fewer.Points(:,1))), [3; 51]);
%! rest = setdiff (1:52, [3, 51])';
%! assert (sortrows (sort (fewer.ConnectivityList, 2)), sortrows (sort (rest(delone.delaunayn (more.Points(rest,:))), 2)));
%! [H, v] = convexHull (fewer);
%! assert (! any (ismember ([3; 51], H)));
%! assert (v, nthargout (2, @delone.convhulln, more.Points(rest,:)), 1e-14);
%! moved = move (t, [1; 2], [0.1 0.2 0.3; 5 5 5]);
%! y = [0.1 0.2 0.3; 5 5 5; x(3:end,:)];
%! assert (moved.Points, y);
%! assert (sortrows (sort (moved.ConnectivityList, 2)), sortrows (sort (delone.delaunayn (y), 2)));
%! assert (t.Points, x);
%!test
%! file = [tempname() ".npz"];
%! unwind_protect
%!   write (t, file);
%!   s = delone.read (file);
%!   assert (s.kind, "delaunay");
%!   assert (s.points, x);
%! unwind_protect_cleanup
%!   delete (file);
%! end_unwind_protect
%!error <row 1 of the list of rows has the number 51, and there are rows 1 to 50> remove (t, 51)
%!error <the matrix of points has 2 columns, and must have 3> insert (t, [1 2])
%!error <the matrix of points has 1 rows, and must have 2> move (t, [1; 2], [1 2 3])
%!error <Invalid call> delone.delaunayTriangulation ()
%!error <a coordinate of point 2> delone.delaunayTriangulation ([0 0; NaN 1])
%!demo
%! t = delone.delaunayTriangulation (rand (30, 2))
%! H = convexHull (t);
%! clf;
%! triplot (t.ConnectivityList, t.Points(:,1), t.Points(:,2));
%! hold on;
%! plot (t.Points(H,1), t.Points(H,2), "r-", "linewidth", 2);
