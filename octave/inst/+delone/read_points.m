## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{pts} =} delone.read_points (@var{file})
## @deftypefnx {} {@var{pts} =} delone.read_points (@var{file}, @var{name}, @var{value}, @dots{})
## The points of a file: npy, csv, tsv, txt, xyz, off, ply and others, with a point in each row.
##
## @table @code
## @item format
## of the file; by default that of its extension,
## @item columns
## a name, a number from 0 or a range such as "2-5", of text files; by default all,
## @item skip_missing
## 1 leaves out rows with missing values, which are errors otherwise.
## @end table
## @seealso{delone.write_points, delone.read}
## @end deftypefn

function pts = read_points (file, varargin)
  if (nargin < 1 || ! ischar (file) || mod (nargin, 2) != 1)
    delone.internal.usage ("read_points");
  endif
  pts = __delone__ ("get", __delone__ ("read_points", file, struct (varargin{:})), "points");
endfunction

%!test
%! file = [tempname() ".csv"];
%! unwind_protect
%!   x = rand (10, 3);
%!   delone.write_points (file, x);
%!   assert (delone.read_points (file), x);
%!   assert (delone.read_points (file, "columns", "1-2"), x(:,2:3));
%! unwind_protect_cleanup
%!   delete (file);
%! end_unwind_protect
%!error <Invalid call> delone.read_points ()
%!error id=delone:cannot-open delone.read_points ("/none.csv")
%!demo
%! file = [tempname() ".npy"];
%! delone.write_points (file, rand (5, 2));
%! x = delone.read_points (file)
%! delete (file);
