## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{inside} =} delone.in_hull (@var{pts}, @var{xi})
## @deftypefnx {} {[@var{inside}, @var{on_boundary}] =} delone.in_hull (@var{pts}, @var{xi})
## Whether points are in the convex hull of others, exactly.
##
## @var{inside} is true for the rows of @var{xi} in the hull of @var{pts}, its boundary included; @var{on_boundary} for those on it.  Of
## points in a hyperplane, inside is meant within their flat.
## @seealso{inpolygon, delone.convhulln, delone.tsearchn}
## @end deftypefn

function [inside, on_boundary] = in_hull (pts, xi)
  if (nargin != 2)
    delone.internal.usage ("in_hull");
  endif
  [~, kinds] = __delone__ ("locate", __delone__ ("convex_hull", pts), xi);
  inside = kinds < 3;
  on_boundary = kinds == 1 | kinds == 2;
endfunction

%!test
%! [in, on] = delone.in_hull ([0 0; 2 0; 0 2; 2 2], [1 1; 1 0; 2 2; 3 1; 1 -5e-324]);
%! assert (in', logical ([1 1 1 0 0]));
%! assert (on', logical ([0 1 1 0 0]));
%!test
%! ## flat points
%! [in, on] = delone.in_hull ([0 0; 1 1; 2 2], [1 1; 2 2; 3 3; 1 0]);
%! assert (in', logical ([1 1 0 0]));
%! assert (on', logical ([0 1 0 0]));
%!error <Invalid call> delone.in_hull (1)
%!error id=delone:bad-dimension delone.in_hull ([0 0; 1 1], 1)
%!demo
%! x = randn (50, 2);
%! [u, v] = meshgrid (linspace (-3, 3, 60));
%! inside = delone.in_hull (x, [u(:), v(:)]);
%! clf;
%! plot (u(inside), v(inside), "g.", x(:,1), x(:,2), "r+");
