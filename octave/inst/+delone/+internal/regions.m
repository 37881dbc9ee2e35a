## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {[@var{C}, @var{F}] =} delone.internal.regions (@var{triangulation})
## The vertices of the Voronoi diagram, the first of them infinite, and the vertices of the region of each point.
## @end deftypefn

function [C, F] = regions (triangulation)
  diagram = __delone__ ("voronoi", triangulation);
  [vertices, region] = __delone__ ("get", diagram, "vertices", "point_region");
  C = [Inf(1, columns (vertices)); vertices];
  F = repmat ({zeros(1, 0)}, numel (region), 1);
  has = ! isnan (region);
  F(has) = __delone__ ("lists", diagram, "region_offsets", "region_vertices", 2)(region(has));
endfunction

%!test
%! [C, F] = delone.internal.regions (__delone__ ("delaunay", [0 0; 2 0; 0 2; 2 2]));
%! assert (C, [Inf Inf; 1 1]);
%! assert (sort (F{1}), [1 2]);
