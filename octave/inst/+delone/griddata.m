## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{zi} =} delone.griddata (@var{x}, @var{y}, @var{z}, @var{xi}, @var{yi})
## @deftypefnx {} {@var{zi} =} delone.griddata (@var{x}, @var{y}, @var{z}, @var{xi}, @var{yi}, @var{method})
## @deftypefnx {} {[@var{xi}, @var{yi}, @var{zi}] =} delone.griddata (@dots{})
## @deftypefnx {} {@var{vi} =} delone.griddata (@var{x}, @var{y}, @var{z}, @var{v}, @var{xi}, @var{yi}, @var{zi})
## @deftypefnx {} {@var{vi} =} delone.griddata (@dots{}, @var{method})
## @deftypefnx {} {@var{vi} =} delone.griddata (@dots{}, @var{method}, @var{options})
## Interpolate values between points in the plane or in space.
##
## In the plane z = f (x, y) is interpolated at (xi, yi), in space v = f (x, y, z) at (xi, yi, zi).  The points are given by vectors of one
## length or arrays of one size.  Vectors @var{x} and @var{y} of the lengths of the rows and columns of @var{z} are the lines of a grid,
## and so are a row @var{xi} and a column @var{yi}; in space, vectors of different lengths are.
##
## @var{method} is "linear" (the default), "nearest", "natural" or "smooth" (@pxref{XREFdelone.interpolate,,@code{delone.interpolate}}),
## or, in the plane, "v4", the biharmonic spline, which also extrapolates.  Outside the convex hull of the points linear and natural
## results are NaN; rounding is taken into account as in @code{delone.griddatan}.
## @seealso{griddata, delone.griddatan, delone.interpolate}
## @end deftypefn

function [rx, ry, rz] = griddata (x, y, z, varargin)
  if (nargin < 5 || nargin > 9)
    delone.internal.usage ("griddata");
  endif
  if (nargin < 7)
    [rx, ry, rz] = in_plane (x, y, z, varargin{:});
    if (nargout < 2)
      rx = rz;
    endif
  else
    if (nargout > 1)
      error ("delone:invalid-argument", "griddata: only one output argument is possible for 3-D inputs");
    endif
    rx = in_space (x, y, z, varargin{:});
  endif
endfunction

function [xi, yi, zi] = in_plane (x, y, z, xi, yi, method = "linear")
  method = delone.internal.method ("griddata", method, {"linear", "nearest", "natural", "smooth", "v4"});
  if (isvector (x) && isvector (y) && ! isvector (z))
    if (numel (x) != columns (z) || numel (y) != rows (z))
      error ("delone:invalid-argument", "griddata: the lengths of X and Y must match the columns and rows of Z");
    endif
    [x, y] = meshgrid (x, y);
  elseif (isvector (x) && isvector (y) && isvector (z))
    if (numel (x) != numel (y) || numel (x) != numel (z))
      error ("delone:invalid-argument", "griddata: X, Y, and Z must be vectors of the same length");
    endif
  elseif (! size_equal (x, y, z))
    error ("delone:invalid-argument", "griddata: X, Y, and Z must be matrices of the same size");
  endif
  if (isrow (xi) && iscolumn (yi) && ! isscalar (xi) && ! isscalar (yi))
    [xi, yi] = meshgrid (xi, yi);
  elseif (isvector (xi) && isvector (yi) && numel (xi) == numel (yi))
    xi = xi(:);
    yi = yi(:);
  elseif (! size_equal (xi, yi))
    error ("delone:invalid-argument", "griddata: XI and YI must be vectors of the same length or matrices of same size");
  endif
  pts = [double(x(:)), double(y(:))];
  queries = [double(xi(:)), double(yi(:))];
  if (strcmp (method, "v4"))
    zi = biharmonic (pts, double (z(:)), queries);
  else
    zi = delone.interpolate (pts, double (z(:)), queries, method, delone.internal.rounding (pts));
  endif
  zi = reshape (zi, size (xi));
endfunction

function vi = in_space (x, y, z, v, xi, yi, zi, method = "linear", options = [])
  method = delone.internal.method ("griddata", method, {"linear", "nearest", "natural", "smooth"});
  delone.internal.qhull_options ("griddata", options, "delaunay");
  [x, y, z] = lines_or_points (x, y, z);
  if (numel (v) != numel (x) || ! size_equal (x, y, z))
    error ("delone:invalid-argument", "griddata: X, Y, Z, and V must have equal sizes");
  endif
  [xi, yi, zi] = lines_or_points (xi, yi, zi);
  if (! size_equal (xi, yi, zi))
    error ("delone:invalid-argument", "griddata: XI, YI, and ZI must have equal sizes");
  endif
  vi = delone.griddatan (double ([x(:), y(:), z(:)]), double (v(:)), double ([xi(:), yi(:), zi(:)]), method);
  vi = reshape (vi, size (xi));
endfunction

## The grid of three vectors of different lengths; other arrays as they are, vectors as columns.
function [x, y, z] = lines_or_points (x, y, z)
  if (isvector (x) && isvector (y) && isvector (z))
    if (numel (x) == numel (y) && numel (y) == numel (z))
      [x, y, z] = deal (x(:), y(:), z(:));
    else
      [x, y, z] = meshgrid (x, y, z);
    endif
  endif
endfunction

## Sandwell, "Biharmonic spline interpolation of GEOS-3 and SEASAT altimeter data", doi:10.1029/GL014i002p00139: a sum of Green's
## functions r^2 (log r - 1) of the points, with the weights that give their values.
function zi = biharmonic (pts, z, queries)
  at = @(p) complex (p(:,1), p(:,2));
  weights = green (abs (at (pts) - at (pts).')) \ z;
  zi = green (abs (at (queries) - at (pts).')) * weights;
endfunction

function g = green (r)
  g = r.^2 .* (log (r) - 1);
  g(r == 0) = 0;
endfunction

%!shared x, y, z
%! x = [rand(60, 1); 0; 1; 0; 1];
%! y = [rand(60, 1); 0; 0; 1; 1];
%! z = 2 * x - y;
%!test
%! ## a row and a column are a grid
%! [xi, yi, zi] = delone.griddata (x, y, z, 0:0.25:1, (0:0.5:1)');
%! assert (size (zi), [3 5]);
%! assert (zi, 2 * xi - yi, 1e-9);
%!test
%! for method = {"linear", "natural", "smooth", "LINEAR"}
%!   assert (delone.griddata (x, y, z, [0.2 0.3], [0.4 0.5], method{1}), [0; 0.1], 1e-9);
%! endfor
%! assert (delone.griddata (x, y, z, x, y, "nearest"), z);
%! assert (delone.griddata (x, y, z, x, y, "v4"), z, 1e-6);
%!test
%! ## the points of a grid
%! assert (delone.griddata ([0 1], [0 1 2], [1 2; 3 4; 5 6], 0.1, 0.2), 1.5, 1e-9);
%!test
%! ## space
%! [u, v, w] = meshgrid (0:2, 0:3, 0:1);
%! f = u + 2 * v + 3 * w;
%! assert (delone.griddata (u, v, w, f, 0.5, 0.25, 0.125), 1.375, 1e-9);
%! assert (delone.griddata (0:2, 0:3, 0:1, f, u, v, w), f, 1e-9);
%! assert (size (delone.griddata (u, v, w, f, [0 1], 0:2, 0)), [3 2]);
%!test
%! ## complex values
%! assert (delone.griddata (x, y, z * i, 0.2, 0.4), 0, 1e-9);
%! assert (delone.griddata (x, y, z + i, 0.2, 0.4), i, 1e-9);
%!error <Invalid call> delone.griddata (1, 2, 3, 4)
%!error <not yet implemented> delone.griddata (1, 2, 3, 4, 5, "cubic")
%!error <the "v4" METHOD> delone.griddata (1, 2, 3, 4, 5, 6, 7, "v4")
%!error <a coordinate of query 1> delone.griddata (x, y, z, NaN, 1)
%!demo
%! x = 2 * rand (100, 1) - 1;
%! y = 2 * rand (100, 1) - 1;
%! [xx, yy] = meshgrid (linspace (-1, 1, 32));
%! clf;
%! mesh (xx, yy, delone.griddata (x, y, sin (2 * (x.^2 + y.^2)), xx, yy, "natural"));
