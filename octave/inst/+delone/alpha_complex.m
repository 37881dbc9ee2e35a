## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{T} =} delone.alpha_complex (@var{pts}, @var{radius})
## @deftypefnx {} {@var{T} =} delone.alpha_complex (@var{pts}, @var{radius}, @var{weights})
## @deftypefnx {} {[@var{T}, @var{B}] =} delone.alpha_complex (@dots{})
## The alpha complex of points below a radius: an outline of their shape.
##
## @var{T} has the simplices of the Delaunay triangulation (with weights, the regular one) whose circumscribed spheres have at most this
## radius, exactly.  @var{B} has their boundary: the facets of exactly one of them, with the outside in front.
## @seealso{delone.delaunayn, delone.regular}
## @end deftypefn

function [T, B] = alpha_complex (pts, radius, weights = [])
  if (nargin < 2)
    delone.internal.usage ("alpha_complex");
  endif
  if (! isreal (radius) || ! isscalar (radius))
    error ("delone:invalid-argument", "alpha_complex: RADIUS must be a real number");
  endif
  if (isempty (weights))
    t = __delone__ ("delaunay", pts);
  else
    t = __delone__ ("regular", pts, weights(:));
  endif
  [T, B] = __delone__ ("get", __delone__ ("alpha_complex", t, radius), "cells", "boundary");
endfunction

%!test
%! x = rand (100, 2);
%! T = delone.delaunayn (x);
%! [a, b] = deal (x(T(:,2),:) - x(T(:,1),:), x(T(:,3),:) - x(T(:,1),:));
%! twice = a(:,1) .* b(:,2) - a(:,2) .* b(:,1);
%! lengths = @(v) sqrt (sum (v.^2, 2));
%! radii = lengths (a) .* lengths (b) .* lengths (a - b) ./ (2 * twice);
%! A = delone.alpha_complex (x, 0.08);
%! assert (sortrows (A), sortrows (T(radii <= 0.08,:)));
%!test
%! ## four points on a circle, all of them or none
%! x = [0 0; 1 0; 0 1; 1 1];
%! [T, B] = delone.alpha_complex (x, sqrt (0.5) * (1 + eps));
%! assert (rows (T), 2);
%! assert (sortrows (B), [1 2; 2 4; 3 1; 4 3]);
%! assert (isempty (delone.alpha_complex (x, 0.7)));
%!error <Invalid call> delone.alpha_complex (1)
%!error id=delone:invalid-argument delone.alpha_complex ([0 0; 1 0; 0 1], -1)
%!demo
%! t = 2 * pi * rand (500, 1);
%! x = (1 + 0.3 * rand (500, 1)) .* [cos(t), sin(t)];
%! [T, B] = delone.alpha_complex (x, 0.15);
%! clf;
%! triplot (T, x(:,1), x(:,2));
%! hold on;
%! plot ([x(B(:,1),1), x(B(:,2),1)]', [x(B(:,1),2), x(B(:,2),2)]', "r-", "linewidth", 2);
