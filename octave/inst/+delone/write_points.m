## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {} delone.write_points (@var{file}, @var{pts})
## @deftypefnx {} {} delone.write_points (@var{file}, @var{pts}, @var{format})
## Write points to a file: npy, csv, tsv, txt, xyz, off and others, by the extension or as @var{format} says.
##
## The file is written whole, or not at all.
## @seealso{delone.read_points, delone.write}
## @end deftypefn

function write_points (file, pts, format = "")
  if (nargin < 2 || ! ischar (file))
    delone.internal.usage ("write_points");
  endif
  __delone__ ("write_points", pts, file, format);
endfunction

%!test
%! file = tempname ();
%! unwind_protect
%!   delone.write_points (file, [1 2; 3 4], "csv");
%!   assert (delone.read_points (file, "format", "csv"), [1 2; 3 4]);
%! unwind_protect_cleanup
%!   delete (file);
%! end_unwind_protect
%!error <Invalid call> delone.write_points ("x.npy")
%!error id=delone:unsupported delone.write_points ("x.none", 1)
%!demo
%! file = [tempname() ".csv"];
%! delone.write_points (file, rand (3, 2));
%! disp (fileread (file));
%! delete (file);
