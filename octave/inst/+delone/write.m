## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {} delone.write (@var{file}, @var{pts}, @var{T})
## @deftypefnx {} {} delone.write (@var{file}, @var{pts}, @var{T}, @var{format})
## Write simplices and their points to a file: npz, json, off, ply, svg, vtu and others, by the extension or as @var{format} says.
##
## @var{T} has the points of a simplex in each row.  A @code{delone.delaunayTriangulation} has a method @code{write}, whose file also says
## what kind of triangulation it is.  The file is written whole, or not at all.
## @seealso{delone.read, delone.write_points}
## @end deftypefn

function write (file, pts, T, format = "")
  if (nargin < 3 || ! ischar (file))
    delone.internal.usage ("write");
  endif
  __delone__ ("write", __delone__ ("cells", pts, T), file, format);
endfunction

%!test
%! file = tempname ();
%! unwind_protect
%!   delone.write (file, [0 0; 1 0; 0 1], [1 2 3], "off");
%!   assert (! isempty (regexp (fileread (file), "^n?OFF")));
%! unwind_protect_cleanup
%!   delete (file);
%! end_unwind_protect
%!error <Invalid call> delone.write ("x.npz", 1)
%!error id=delone:unsupported delone.write ("x.none", [0 0; 1 0; 0 1], [1 2 3])
%!error <has the number 4, and there are points 1 to 3> delone.write ("x.npz", [0 0; 1 0; 0 1], [1 2 4])
%!demo
%! file = [tempname() ".json"];
%! delone.write (file, [0 0; 1 0; 0 1], [1 2 3]);
%! disp (fileread (file));
%! delete (file);
