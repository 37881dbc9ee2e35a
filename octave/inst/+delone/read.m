## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {@var{s} =} delone.read (@var{file})
## A result in a file that delone has written, from any language: a triangulation, hull, intersection or diagram, as npz, json or off.
##
## @var{s} is a struct with all members of the result, among them @code{points} and @code{cells}, and its @code{kind}.  Their names are
## those of the file.  Points, cells and vertices count from 1, and NaN stands for none.
## @seealso{delone.write, delone.read_points}
## @end deftypefn

function s = read (file)
  if (nargin != 1 || ! ischar (file))
    delone.internal.usage ("read");
  endif
  object = __delone__ ("read", file, struct ());
  for name = __delone__ ("members", object)(:)'
    s.(name{1}) = __delone__ ("get", object, name{1});
  endfor
endfunction

%!test
%! file = [tempname() ".npz"];
%! unwind_protect
%!   x = rand (20, 3);
%!   T = delone.delaunayn (x);
%!   delone.write (file, x, T);
%!   s = delone.read (file);
%!   assert (s.points, x);
%!   assert (sortrows (sort (s.cells, 2)), sortrows (sort (T, 2)));
%!   assert (s.num_cells, rows (T));
%! unwind_protect_cleanup
%!   delete (file);
%! end_unwind_protect
%!error <Invalid call> delone.read ()
%!error id=delone:cannot-open delone.read ("/none.npz")
%!demo
%! file = [tempname() ".npz"];
%! x = rand (5, 2);
%! delone.write (file, x, delone.delaunayn (x));
%! s = delone.read (file)
%! delete (file);
