## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{V} =} delone.convex_hulls (@var{sets})
## @deftypefnx {} {[@var{V}, @var{A}, @var{H}] =} delone.convex_hulls (@var{sets})
## The convex hulls of many sets of points at once: their volumes, areas and simplices.
##
## @var{sets} is a cell array of matrices with a point in each row.  @var{V}(i) and @var{A}(i) are the volume and the area of the boundary of
## the hull of @var{sets}@{i@}, and @var{H}@{i@} has its simplices as @code{delone.convhulln} has.  Much faster than a loop for small sets.
## @seealso{delone.convhulln}
## @end deftypefn

function [V, A, H] = convex_hulls (sets)
  if (nargin != 1 || ! iscell (sets))
    delone.internal.usage ("convex_hulls");
  endif
  counts = cellfun (@rows, sets(:));
  hulls = __delone__ ("convex_hulls", vertcat (sets{:}), [0; cumsum(counts)]);
  [V, A] = __delone__ ("get", hulls, "volumes", "areas");
  if (nargout > 2)
    [cells, starts] = __delone__ ("get", hulls, "cells", "cell_offsets");
    H = mat2cell (cells, diff (starts), columns (cells));
    first = [0; cumsum(counts)(1:end-1)];
    H = cellfun (@(h, f) h - f, H, num2cell (first), "uniformoutput", false);
  endif
endfunction

%!test
%! sets = arrayfun (@(n) rand (n, 3), 3:12, "uniformoutput", false);
%! [V, A, H] = delone.convex_hulls (sets);
%! for i = 1:numel (sets)
%!   [h, v] = delone.convhulln (sets{i});
%!   assert (V(i), v, 1e-15);
%!   assert (H{i}, h);
%! endfor
%! assert (A(1), norm (cross (sets{1}(2,:) - sets{1}(1,:), sets{1}(3,:) - sets{1}(1,:))), 1e-14);
%!assert (delone.convex_hulls ({[0 0; 1 0; 0 1], zeros(0, 2)}), [0.5; 0])
%!error <Invalid call> delone.convex_hulls (rand (3))
%!error <a coordinate of point 4 is not finite> delone.convex_hulls ({[0 0; 1 0; 0 1], [NaN 1]})
%!demo
%! sets = arrayfun (@(n) rand (n, 3), 10 * ones (1, 5), "uniformoutput", false);
%! V = delone.convex_hulls (sets)
