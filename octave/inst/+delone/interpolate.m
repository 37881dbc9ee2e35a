## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{vi} =} delone.interpolate (@var{pts}, @var{values}, @var{xi})
## @deftypefnx {} {@var{vi} =} delone.interpolate (@var{pts}, @var{values}, @var{xi}, @var{method})
## @deftypefnx {} {@var{vi} =} delone.interpolate (@var{pts}, @var{values}, @var{xi}, @var{method}, @var{tolerance})
## @deftypefnx {} {[@var{vi}, @var{gradients}] =} delone.interpolate (@dots{})
## Interpolate values between points in any dimension.
##
## Row i of @var{values} belongs to the point in row i of @var{pts}; each column is interpolated.  @var{vi} has a row for each row of
## @var{xi}, NaN outside the convex hull of the points.  Complex values are interpolated by parts.  @var{method} is
##
## @table @asis
## @item "linear"
## linear in each simplex of the Delaunay triangulation (the default),
## @item "natural"
## by natural neighbors: Sibson's interpolant, smooth but at the points,
## @item "smooth"
## the same with estimated gradients at the points, smooth there, too,
## @item "nearest"
## the value of the nearest point, outside the hull as well.
## @end table
##
## With a @var{tolerance}, a distance, a query may be moved by so much: out of thin simplices that rounding has made, and from outside to the
## border.  The default is 0.
##
## @var{gradients} has d columns for each column of @var{values}.
## @seealso{griddatan, delone.griddatan, delone.natural_neighbors, delone.nearest}
## @end deftypefn

function [vi, gradients] = interpolate (pts, values, xi, method = "linear", tolerance = 0)
  if (nargin < 3)
    delone.internal.usage ("interpolate");
  endif
  if (! ischar (method) || ! any (strcmp (method, {"linear", "natural", "smooth", "nearest"})))
    error ("delone:invalid-argument", 'interpolate: METHOD must be "linear", "natural", "smooth" or "nearest"');
  endif
  if (rows (values) != rows (pts))
    error ("delone:invalid-argument", "interpolate: there are %d rows of values for %d points", rows (values), rows (pts));
  endif
  t = __delone__ ("delaunay", pts);
  if (strcmp (method, "nearest"))
    if (nargout > 1)
      error ("delone:unsupported", "interpolate: the nearest value has no gradients");
    endif
    nearest = __delone__ ("nearest", t, xi, 1);
    vi = NaN (rows (xi), columns (values));
    vi(! isnan (nearest),:) = double (values(nearest(! isnan (nearest)),:));
    return;
  endif
  parts = double (values);
  if (iscomplex (values))
    parts = [real(parts), imag(parts)];
  endif
  by = __delone__ ("interpolator", t, parts, method);
  options = struct ("tolerance", tolerance);
  if (nargout > 1)
    [vi, gradients] = __delone__ ("interpolate", by, xi, options);
    gradients = joined (gradients, iscomplex (values));
  else
    vi = __delone__ ("interpolate", by, xi, options);
  endif
  vi = joined (vi, iscomplex (values));
endfunction

## The real parts, and the imaginary parts in as many columns behind them.
function parts = joined (parts, is_complex)
  if (is_complex)
    half = columns (parts) / 2;
    parts = complex (parts(:,1:half), parts(:,half+1:end));
  endif
endfunction

%!shared x, xi, f
%! x = [rand(80, 2); 0 0; 1 0; 0 1; 1 1];
%! xi = rand (50, 2);
%! f = @(x) 3 * x(:,1) - 2 * x(:,2) + 1;
%!test
%! ## affine functions are reproduced
%! for method = {"linear", "natural", "smooth"}
%!   [v, g] = delone.interpolate (x, f (x), xi, method{1});
%!   assert (v, f (xi), 1e-9);
%!   assert (g, repmat ([3 -2], 50, 1), 1e-6);
%! endfor
%!test
%! ## columns and complex values
%! v = delone.interpolate (x, [f(x), i * f(x)], xi);
%! assert (v, [f(xi), i * f(xi)], 1e-9);
%!test
%! [~, nearest] = min (abs (complex (xi(:,1), xi(:,2)) - complex (x(:,1), x(:,2)).'), [], 2);
%! assert (delone.interpolate (x, (1:84)', xi, "nearest"), nearest);
%!test
%! assert (delone.interpolate (x, f (x), [2 2]), NaN);
%! assert (delone.interpolate (zeros (0, 2), zeros (0, 1), [2 2], "nearest"), NaN);
%!test
%! ## the middle of an edge of the hull, and a thin triangle that rounding has put there
%! p = [0 0; 1 0; 0 1; 0.5 -1e-17];
%! assert (delone.interpolate (p, [0; 0; 0; 1], [0.25 -4e-18]), 0.4, 0.2);
%! assert (delone.interpolate (p, [0; 0; 0; 1], [0.25 -4e-18], "linear", 1e-15), 0.5, 0.2);
%! assert (delone.interpolate (p, [0; 0; 0; 1], [0.25 -1e-3]), NaN);
%! assert (delone.interpolate (p, [0; 0; 0; 1], [0.25 -1e-3], "linear", 0.01), 0.5, 1e-9);
%!error <Invalid call> delone.interpolate (x, f (x))
%!error <METHOD must be> delone.interpolate (x, f (x), xi, "cubic")
%!error <3 rows of values for 84 points> delone.interpolate (x, [1; 2; 3], xi)
%!error <a coordinate of query 2> delone.interpolate (x, f (x), [0 0; NaN 0])
%!demo
%! x = rand (60, 2);
%! [u, v] = meshgrid (linspace (0, 1, 60));
%! w = delone.interpolate (x, sin (5 * x(:,1)) .* x(:,2), [u(:), v(:)], "smooth");
%! clf;
%! surf (u, v, reshape (w, size (u)));
