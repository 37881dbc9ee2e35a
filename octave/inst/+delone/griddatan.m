## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{yi} =} delone.griddatan (@var{x}, @var{y}, @var{xi})
## @deftypefnx {} {@var{yi} =} delone.griddatan (@var{x}, @var{y}, @var{xi}, @var{method})
## @deftypefnx {} {@var{yi} =} delone.griddatan (@var{x}, @var{y}, @var{xi}, @var{method}, @var{options})
## Interpolate values between points in any dimension.
##
## The column @var{y} has a value for each row of @var{x}, @var{yi} one for each row of @var{xi}: NaN outside the convex hull.
## @var{method} is "linear" (the default), "nearest", or, which Octave does not have, "natural" or "smooth": see
## @code{delone.interpolate}, which also takes several columns.  As Octave does, this function leaves out thin simplices at the border that
## rounding has made: no query is moved by more than that.  @var{options} of Qhull are accepted, as in @code{delone.delaunayn}.
## @seealso{griddatan, delone.griddata, delone.interpolate}
## @end deftypefn

function yi = griddatan (x, y, xi, method = "linear", options = [])
  if (nargin < 3)
    delone.internal.usage ("griddatan");
  endif
  if (rows (x) <= columns (x))
    error ("delone:invalid-argument", "griddatan: the number of points in X must be greater than their dimension");
  elseif (! iscolumn (y))
    error ("delone:invalid-argument", "griddatan: Y must be a column vector");
  elseif (rows (y) != rows (x))
    error ("delone:invalid-argument", "griddatan: Y must have the same number of points (rows) as X");
  elseif (columns (xi) != columns (x))
    error ("delone:bad-dimension", "griddatan: the dimension of the queries XI (columns) must match X");
  endif
  method = delone.internal.method ("griddatan", method, {"linear", "nearest", "natural", "smooth"});
  delone.internal.qhull_options ("griddatan", options, "delaunay");
  yi = delone.interpolate (x, y, xi, method, delone.internal.rounding (x));
endfunction

%!test
%! x = [rand(50, 3); dec2bin(0:7) - "0"];
%! xi = rand (20, 3);
%! f = @(x) x * [1; 2; 3];
%! assert (delone.griddatan (x, f (x), xi), f (xi), 1e-9);
%! assert (delone.griddatan (x, f (x), xi, "natural"), f (xi), 1e-9);
%! assert (delone.griddatan (x, f (x), [2 2 2]), NaN);
%!test
%! ## the middle of a square
%! yi = delone.griddatan ([0 0; 1 1; 0 1; 1 0], [1; 2; 3; 4], [0.5 0.5]);
%! assert (any (yi == [1.5 3.5]));
%!error <Invalid call> delone.griddatan (1, 2)
%!error <Y must be a column vector> delone.griddatan ([1; 2], [3, 4], 1)
%!demo
%! x = 2 * rand (200, 2) - 1;
%! [u, v] = meshgrid (linspace (-1, 1, 50));
%! w = delone.griddatan (x, exp (-4 * sum (x.^2, 2)), [u(:), v(:)], "natural");
%! clf;
%! surf (u, v, reshape (w, size (u)));
