## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {[@var{pts}, @var{furthest}] =} delone.internal.coordinates (@var{caller}, @var{args})
## The points of (X), (X, Y) or (X, Y, Z) as a matrix, and whether OPTIONS behind them ask for furthest sites.
## @end deftypefn

function [pts, furthest] = coordinates (caller, args)
  furthest = false;
  is_numeric = cellfun (@(a) isnumeric (a) || islogical (a), args);
  count = numel (args);
  if (count > 1 && (! is_numeric(end) || (isempty (args{end}) && ! isempty (args{1}))))
    if (nargout > 1)
      furthest = delone.internal.qhull_options (caller, args{end}, "delaunay");
    else
      delone.internal.qhull_options (caller, args{end}, "hull");
    endif
    count -= 1;
  endif
  if (count > 3)
    error ("delone:invalid-argument", "%s: OPTIONS must be a string or cell array of strings", caller);
  endif
  if (! all (is_numeric(1:count)))
    error ("delone:invalid-argument", "%s: coordinates must be numbers", caller);
  endif
  switch (count)
    case 1
      pts = args{1};
      if (ndims (pts) != 2 || ! any (columns (pts) == [2, 3]))
        error ("delone:bad-dimension", "%s: X must be a matrix with 2 or 3 columns", caller);
      endif
    case 2
      if (! size_equal (args{1:2}))
        error ("delone:invalid-argument", "%s: X and Y must be the same size", caller);
      endif
      pts = [double(args{1}(:)), double(args{2}(:))];
    case 3
      if (! size_equal (args{1:3}))
        error ("delone:invalid-argument", "%s: X, Y, and Z must be the same size", caller);
      endif
      pts = [double(args{1}(:)), double(args{2}(:)), double(args{3}(:))];
  endswitch
endfunction

%!assert (delone.internal.coordinates ("f", {[1 2; 3 4]}), [1 2; 3 4])
%!assert (delone.internal.coordinates ("f", {[1 2; 3 4], [5 6; 7 8], "Qt"}), [1 5; 3 7; 2 6; 4 8])
%!assert (delone.internal.coordinates ("f", {1, 2, 3, []}), [1 2 3])
%!test
%! [pts, furthest] = delone.internal.coordinates ("f", {1, 2, "Qu"});
%! assert (pts, [1 2]);
%! assert (furthest);
%!error <X must be a matrix with 2 or 3 columns> delone.internal.coordinates ("f", {ones(2, 4)})
%!error <X and Y must be the same size> delone.internal.coordinates ("f", {1, [1 2]})
%!error <OPTIONS must be> delone.internal.coordinates ("f", {1, 2, 3, 4})
