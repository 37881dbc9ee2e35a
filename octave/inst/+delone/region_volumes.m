## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{v} =} delone.region_volumes (@var{pts})
## @deftypefnx {} {@var{v} =} delone.region_volumes (@var{pts}, @var{low}, @var{high})
## @deftypefnx {} {@var{v} =} delone.region_volumes (@var{pts}, @var{low}, @var{high}, @var{weights})
## The volumes of Voronoi regions, whole or in a box.
##
## @var{v} has the volume of the region of each point, or of its part with @var{low} <= x <= @var{high}: these add up to the volume of the
## box, if no points are equal.  Without a box, regions that are not bounded have the volume Inf.  With @var{weights} the regions are those
## of the power diagram; hidden points have none, and NaN.  Equal points share a region.
## @seealso{delone.voronoin, delone.regular}
## @end deftypefn

function v = region_volumes (pts, low = [], high = [], weights = [])
  if (nargin < 1 || nargin == 2)
    delone.internal.usage ("region_volumes");
  endif
  if (isempty (weights))
    t = __delone__ ("delaunay", pts);
  else
    t = __delone__ ("regular", pts, weights(:));
  endif
  diagram = __delone__ ("voronoi", t);
  region = __delone__ ("get", diagram, "point_region");
  if (isempty (low) && isempty (high))
    volumes = __delone__ ("get", diagram, "region_volumes");
  else
    volumes = __delone__ ("region_volumes", diagram, low(:)', high(:)');
  endif
  v = NaN (rows (pts), 1);
  v(! isnan (region)) = volumes(region(! isnan (region)));
endfunction

%!test
%! x = rand (100, 3);
%! assert (sum (delone.region_volumes (x, [0 0 0], [1 1 2])), 2, 1e-12);
%! v = delone.region_volumes (x, [0 0 0], [1 1 2], 0.01 * rand (100, 1));
%! assert (sum (v(! isnan (v))), 2, 1e-12);
%!test
%! x = [0 0; 1 0; 0 1; -1 0; 0 -1; 0 0];
%! assert (delone.region_volumes (x), [1; Inf; Inf; Inf; Inf; 1]);
%!error <Invalid call> delone.region_volumes ([0 0], [0 0])
%!error <the lower corner has 1 columns, and must have 2> delone.region_volumes ([0 0; 1 1], 0, 1)
%!demo
%! x = rand (20, 2);
%! v = delone.region_volumes (x, [0 0], [1 1])
