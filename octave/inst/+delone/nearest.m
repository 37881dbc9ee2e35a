## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{idx} =} delone.nearest (@var{pts}, @var{xi})
## @deftypefnx {} {@var{idx} =} delone.nearest (@var{pts}, @var{xi}, @var{count})
## @deftypefnx {} {[@var{idx}, @var{distances}] =} delone.nearest (@dots{})
## The nearest points of queries, in exact order.
##
## Row i of @var{idx} has the numbers of the @var{count} points nearest to row i of @var{xi} (one by default), nearest first, and NaN if
## there are fewer.  Of equally near points the one with the smaller number comes first, and equal points count as one.
## @seealso{dsearchn, delone.natural_neighbors}
## @end deftypefn

function [idx, distances] = nearest (pts, xi, count = 1)
  if (nargin < 2)
    delone.internal.usage ("nearest");
  endif
  if (! isscalar (count) || ! (count >= 1) || count != fix (count))
    error ("delone:invalid-argument", "nearest: COUNT must be a positive integer");
  endif
  idx = __delone__ ("nearest", __delone__ ("delaunay", pts), xi, count);
  if (nargout > 1)
    distances = NaN (size (idx));
    for j = 1:count
      found = ! isnan (idx(:,j));
      distances(found,j) = sqrt (sum ((double (pts(idx(found,j),:)) - double (xi(found,:))).^2, 2));
    endfor
  endif
endfunction

%!test
%! x = rand (100, 3);
%! xi = rand (30, 3);
%! [idx, distances] = delone.nearest (x, xi, 4);
%! for i = 1:30
%!   [d, order] = sort (sqrt (sum ((x - xi(i,:)).^2, 2)));
%!   assert (idx(i,:), order(1:4)');
%!   assert (distances(i,:), d(1:4)', 1e-15);
%! endfor
%!assert (delone.nearest ([0 0; 2 0; 0 2; 2 2; 2 2], [1 1], 5), [1 2 3 4 NaN])
%!error <Invalid call> delone.nearest (1)
%!error <COUNT must be a positive integer> delone.nearest ([0 0], [0 0], 0)
%!error <the matrix of queries has 3 columns, and must have 2> delone.nearest ([0 0], [0 0 0])
%!demo
%! x = rand (1000, 2);
%! [idx, distances] = delone.nearest (x, [0.5 0.5], 5)
