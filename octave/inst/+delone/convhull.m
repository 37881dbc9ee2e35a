## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{H} =} delone.convhull (@var{x}, @var{y})
## @deftypefnx {} {@var{H} =} delone.convhull (@var{x}, @var{y}, @var{z})
## @deftypefnx {} {@var{H} =} delone.convhull (@var{x})
## @deftypefnx {} {@var{H} =} delone.convhull (@dots{}, @var{options})
## @deftypefnx {} {[@var{H}, @var{V}] =} delone.convhull (@dots{})
## The convex hull of points in the plane or in space.
##
## In the plane @var{H} is the closed polygon: the numbers of its corners, counterclockwise, from the first of them on and back to it.
## Points on its edges are no corners.  In space @var{H} has a triangle in each row, as for @code{delone.convhulln}.  @var{V} is the area
## or volume.
## @seealso{convhull, delone.convhulln}
## @end deftypefn

function [H, V] = convhull (varargin)
  if (nargin < 1 || nargin > 4)
    delone.internal.usage ("convhull");
  endif
  pts = delone.internal.coordinates ("convhull", varargin);
  if (nargout > 1)
    [H, V] = delone.convhulln (pts);
  else
    H = delone.convhulln (pts);
  endif
  if (columns (H) == 2 && ! isempty (H))
    next(H(:,1)) = H(:,2);
    polygon = zeros (rows (H) + 1, 1);
    polygon(1) = min (H(:));
    for i = 2:numel (polygon)
      polygon(i) = next(polygon(i - 1));
    endfor
    H = polygon;
  endif
endfunction

%!test
%! x = -3:0.5:3;
%! y = abs (sin (x));
%! assert (delone.convhull (x, y), [1; 7; 13; 12; 11; 10; 4; 3; 2; 1]);
%!test
%! [H, V] = delone.convhull ([0 0; 1 0; 1 1; 0 1; 0.5 0]);
%! assert (H, [1; 2; 3; 4; 1]);
%! assert (V, 1);
%!test
%! [H, V] = delone.convhull (eye (3)(:,1), eye (3)(:,2), eye (3)(:,3));
%! assert (H, zeros (0, 3));
%! assert (V, 0);
%!test
%! ## a lattice has four corners
%! [x, y] = meshgrid (1:20);
%! assert (numel (delone.convhull (x, y)), 5);
%!error <Invalid call> delone.convhull ()
%!error <X and Y must be the same size> delone.convhull (1, [1 2])
%!demo
%! x = randn (100, 1);
%! y = randn (100, 1);
%! H = delone.convhull (x, y);
%! clf;
%! plot (x, y, "+", x(H), y(H), "r-");
