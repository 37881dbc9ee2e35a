## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{idx} =} delone.tsearchn (@var{x}, @var{t}, @var{xi})
## @deftypefnx {} {[@var{idx}, @var{p}] =} delone.tsearchn (@var{x}, @var{t}, @var{xi})
## Find which simplices contain points.
##
## @var{t} has the numbers of points of @var{x}, d+1 in each row.  The simplices may come from anywhere: they may overlap and leave gaps.
## @var{idx} has for each row of @var{xi} the number of the first simplex that contains it, its border included, and NaN if none does.
## @var{p} has its barycentric coordinates there.  Whether a simplex contains a point is decided exactly.
## @seealso{tsearchn, delone.delaunayn}
## @end deftypefn

function [idx, p] = tsearchn (x, t, xi)
  if (nargin != 3)
    delone.internal.usage ("tsearchn");
  endif
  if (columns (t) != columns (x) + 1)
    error ("delone:bad-dimension", "tsearchn: T has %d columns, and must have %d", columns (t), columns (x) + 1);
  endif
  cells = __delone__ ("cells", x, t);
  if (nargout > 1)
    [idx, ~, p] = __delone__ ("locate", cells, xi);
  else
    idx = __delone__ ("locate", cells, xi);
  endif
endfunction

%!test
%! x = [-1, -1; -1, 1; 1, -1];
%! [idx, p] = delone.tsearchn (x, [1 2 3], [-1/3, -1/3; 1, 1; -1, 1]);
%! assert (idx, [1; NaN; 1]);
%! assert (p, [1/3 1/3 1/3; NaN NaN NaN; 0 1 0], 1e-12);
%!test
%! ## against a search of all simplices
%! x = rand (60, 3);
%! T = delone.delaunayn (x);
%! T = T(1:2:end,:);
%! xi = [rand(200, 3); x];
%! [idx, p] = delone.tsearchn (x, T, xi);
%! for i = 1:rows (xi)
%!   inside = arrayfun (@(c) all ([x(T(c,:),:)'; 1 1 1 1] \ [xi(i,:)'; 1] > -1e-12), 1:rows (T));
%!   assert (isnan (idx(i)) == ! any (inside));
%!   if (! isnan (idx(i)))
%!     assert (inside(idx(i)));
%!     assert (p(i,:) * x(T(idx(i),:),:), xi(i,:), 1e-12);
%!   endif
%! endfor
%!test
%! ## flat cells contain nothing
%! assert (delone.tsearchn ([0 0; 1 1; 2 2; 1 0], [1 2 3; 1 2 4], [1 1]), 2);
%!error <Invalid call> delone.tsearchn ()
%!error <T has 2 columns> delone.tsearchn (rand (3, 2), [1 2], [0 0])
%!error <row 2 of the matrix of cells has the number 4, and there are points 1 to 3> delone.tsearchn (eye (3)(:,1:2), [1 2 3; 1 2 4], [0 0])
%!error <number 0> delone.tsearchn (eye (3)(:,1:2), [0 2 3], [0 0])
%!error <number nan> delone.tsearchn (eye (3)(:,1:2), [NaN 2 3], [0 0])
%!error <a coordinate of query 1> delone.tsearchn (eye (3)(:,1:2), [1 2 3], [0 NaN])
%!demo
%! x = rand (20, 2);
%! T = delone.delaunayn (x);
%! xi = rand (200, 2);
%! inside = ! isnan (delone.tsearchn (x, T, xi));
%! clf;
%! triplot (T, x(:,1), x(:,2));
%! hold on;
%! plot (xi(inside,1), xi(inside,2), "g.", xi(! inside,1), xi(! inside,2), "r.");
