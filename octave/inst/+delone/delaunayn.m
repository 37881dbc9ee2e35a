## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{T} =} delone.delaunayn (@var{pts})
## @deftypefnx {} {@var{T} =} delone.delaunayn (@var{pts}, @var{options})
## The Delaunay triangulation of points in any dimension.
##
## @var{pts} has a point in each row.  A row of @var{T} has the numbers of the points of a simplex.  All decisions are exact: no simplex
## is flat, and none is missing.  The simplices depend on the set of points only, also where more points than needed lie on one sphere.
## They are positively oriented.  If the points lie in a hyperplane there are none.
##
## @var{options} of Qhull, a string or a cell array of strings, are accepted: "Qu" asks for @code{delone.furthest_site}, and most others
## change nothing.  Those that ask for another result are errors.  NaN and Inf are errors.
##
## @example
## @group
## T = delone.delaunayn (rand (100, 4));
## @end group
## @end example
## @seealso{delaunayn, delone.delaunay, delone.regular, delone.delaunayTriangulation}
## @end deftypefn

function T = delaunayn (pts, options = [])
  if (nargin < 1)
    delone.internal.usage ("delaunayn");
  endif
  if (delone.internal.qhull_options ("delaunayn", options, "delaunay"))
    T = delone.furthest_site (pts);
    return;
  endif
  t = __delone__ ("delaunay", pts);
  T = __delone__ ("get", t, "cells");
  if (columns (T) != columns (pts) + 1)
    T = zeros (0, columns (pts) + 1);
  endif
endfunction

%!test
%! x = [-1, 0; 0, 1; 1, 0; 0, -1; 0, 0];
%! assert (sortrows (sort (delone.delaunayn (x), 2)), [1,2,5; 1,4,5; 2,3,5; 3,4,5]);
%!test
%! ## the classes that Octave takes
%! x = [0 0; 4 0; 5 3; 1 4; 2 2];
%! T = delone.delaunayn (x);
%! for f = {@single, @int32, @uint8, @sparse}
%!   assert (delone.delaunayn (f{1} (x)), T);
%! endfor
%! assert (class (T), "double");
%! assert (rows (delone.delaunayn (x > 1)), 2);
%!test
%! ## every lattice has a triangulation without flat simplices
%! [x, y, z] = meshgrid (0:4);
%! x = [x(:), y(:), z(:)];
%! T = delone.delaunayn (x);
%! volumes = arrayfun (@(i) det (x(T(i,2:4),:) - x(T(i,1),:)), 1:rows (T));
%! assert (all (volumes > 0));
%! assert (sum (volumes) / 6, 64);
%!test
%! ## coordinates of any size
%! x = [0 0; 4 0; 5 3; 1 4; 2 2];
%! assert (delone.delaunayn (x * 1e300), delone.delaunayn (x));
%! assert (delone.delaunayn (x * 5e-324), delone.delaunayn (x));
%!test
%! ## flat, few and no points
%! assert (delone.delaunayn ([0 0; 1 1; 2 2]), zeros (0, 3));
%! assert (delone.delaunayn ([1 2]), zeros (0, 3));
%! assert (delone.delaunayn (zeros (0, 3)), zeros (0, 4));
%! assert (delone.delaunayn ([1; 3; 2; 2]), [1 3; 3 2]);
%!assert (delone.delaunayn ([0 0; 1 0; 0 1; 5 5], "Qu"), delone.furthest_site ([0 0; 1 0; 0 1; 5 5]))
%!error <Invalid call> delone.delaunayn ()
%!error <OPTIONS must be a string> delone.delaunayn (ones (2), struct ())
%!error <delaunayn: Qhull option 'QR1': it rotates> delone.delaunayn (ones (2), "QR1")
%!error id=delone:not-finite delone.delaunayn ([0 0; 1 NaN; 2 2])
%!error <a coordinate of point 2 is not finite \(and of 1 more\)> delone.delaunayn ([0 0; 1 NaN; -Inf 2])
%!error id=delone:invalid-argument delone.delaunayn ([1 2] * i)
%!error id=delone:invalid-argument delone.delaunayn ("abc")
%!error id=delone:invalid-argument delone.delaunayn (zeros (2, 2, 2))
%!error id=delone:bad-dimension delone.delaunayn (zeros (2, 0))
%!demo
%! x = rand (30, 2);
%! clf;
%! triplot (delone.delaunayn (x), x(:,1), x(:,2));
