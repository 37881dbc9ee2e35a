## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{T} =} delone.delaunay (@var{x}, @var{y})
## @deftypefnx {} {@var{T} =} delone.delaunay (@var{x}, @var{y}, @var{z})
## @deftypefnx {} {@var{T} =} delone.delaunay (@var{x})
## @deftypefnx {} {@var{T} =} delone.delaunay (@dots{}, @var{options})
## The Delaunay triangulation of points in the plane or in space.
##
## The points are given by their coordinates, arrays of the same size, or as the rows of a matrix.  A row of @var{T} has the numbers of
## the points of a triangle or tetrahedron.  The rest is as for @code{delone.delaunayn}.
## @seealso{delaunay, delone.delaunayn}
## @end deftypefn

function T = delaunay (varargin)
  if (nargin < 1 || nargin > 4)
    delone.internal.usage ("delaunay");
  endif
  [pts, furthest] = delone.internal.coordinates ("delaunay", varargin);
  if (furthest)
    T = delone.furthest_site (pts);
  else
    T = delone.delaunayn (pts);
  endif
endfunction

%!test
%! x = [-1, 0, 1, 0, 0];
%! y = [0, 1, 0, -1, 0];
%! assert (sortrows (sort (delone.delaunay (x, y), 2)), [1,2,5; 1,4,5; 2,3,5; 3,4,5]);
%! assert (delone.delaunay ([x(:), y(:)], "Qt"), delone.delaunay (x, y));
%!shared x
%! x = rand (50, 3);
%!test
%! assert (delone.delaunay (x(:,1), x(:,2), x(:,3)), delone.delaunayn (x));
%!test
%! ## the flat of three integer coordinates
%! assert (delone.delaunay (int8 ([0 1 0]), int8 ([0 0 1])), [1 2 3]);
%!assert (delone.delaunay (x(:,1), x(:,2), "Qu"), delone.furthest_site (x(:,1:2)))
%!error <Invalid call> delone.delaunay ()
%!error <X must be a matrix with 2 or 3 columns> delone.delaunay (ones (2, 4))
%!error <a coordinate of point 3> delone.delaunay ([1 2 3], [1 2 Inf])
%!demo
%! [x, y] = meshgrid (1:5);
%! clf;
%! triplot (delone.delaunay (x, y), x(:), y(:));
