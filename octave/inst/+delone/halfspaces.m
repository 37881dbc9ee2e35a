## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{V} =} delone.halfspaces (@var{H})
## @deftypefnx {} {@var{V} =} delone.halfspaces (@var{H}, @var{interior})
## @deftypefnx {} {[@var{V}, @var{info}] =} delone.halfspaces (@dots{})
## The intersection of halfspaces: its vertices, and what else there is of it.
##
## A row of @var{H} has a normal n and an offset c: n*x + c <= 0.  A point strictly inside of all of them may be given as @var{interior};
## otherwise one is found.  @var{V} has a vertex in each row.  The struct @var{info} has
##
## @table @code
## @item state
## "full", "flat" (some points, but none strictly inside) or "empty"; only the first has vertices,
## @item witness
## for the others: at most d+1 rows that have no interior point in common,
## @item bounded, volume
## whether it is bounded, and its volume,
## @item interior_point
## a point strictly inside,
## @item kinds
## of each row: 0 facet, 1 touching, 2 redundant, 3 duplicate, 4 trivial,
## @item facets
## a cell for each row, with the numbers of the vertices of its facet,
## @item directions
## of the rays, if it is not bounded.
## @end table
## @seealso{delone.convhulln}
## @end deftypefn

function [V, info] = halfspaces (H, interior = [])
  if (nargin < 1)
    delone.internal.usage ("halfspaces");
  endif
  p = __delone__ ("halfspaces", H, interior(:)');
  names = {"state", "witness", "kinds", "bounded", "interior_point", "directions"};
  values = cell (size (names));
  [values{:}] = __delone__ ("get", p, names{:});
  info = cell2struct (values, names, 2);
  info.bounded = logical (info.bounded);
  info.interior_point = info.interior_point(:)';
  info.volume = 0;
  info.facets = cell (rows (H), 1);
  V = zeros (0, columns (H) - 1);
  if (strcmp (info.state, "full"))
    [V, info.volume] = __delone__ ("get", p, "vertices", "volume");
    row = __delone__ ("get", p, "facet_halfspaces");
    info.facets(row) = __delone__ ("lists", p, "facet_offsets", "facet_vertices");
  endif
endfunction

%!test
%! cube = [eye(3), -ones(3, 1); -eye(3), zeros(3, 1); 1 1 1 -5];
%! [V, info] = delone.halfspaces (cube);
%! assert (sortrows (V), dec2bin (0:7) - "0");
%! assert (info.volume, 1);
%! assert (info.kinds, [0; 0; 0; 0; 0; 0; 2]);
%! assert (cellfun (@numel, info.facets), [4; 4; 4; 4; 4; 4; 0]);
%! assert (all (cube(:,1:3) * info.interior_point' + cube(:,4) < 0));
%!test
%! [V, info] = delone.halfspaces ([1 0; -1 1]);
%! assert (V, zeros (0, 1));
%! assert (info.state, "empty");
%! assert (sort (info.witness), [1; 2]);
%!test
%! [V, info] = delone.halfspaces ([-1 0 0; 0 -1 0], [1 1]);
%! assert (V, [0 0]);
%! assert (info.bounded, false);
%! assert (info.volume, Inf);
%! assert (sortrows (info.directions), [0 1; 1 0]);
%!error <Invalid call> delone.halfspaces ()
%!error <the interior point is not strictly inside halfspace 2> delone.halfspaces ([1 0 -1; 0 1 -1], [0 1])
%!error id=delone:not-finite delone.halfspaces ([1 0 NaN])
%!demo
%! ## the cube, with a corner cut off
%! H = [eye(3), -ones(3, 1); -eye(3), zeros(3, 1); 1 1 1 -2.5];
%! [V, info] = delone.halfspaces (H)
