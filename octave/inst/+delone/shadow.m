## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {} delone.shadow ("on")
## @deftypefnx {} {} delone.shadow ("off")
## @deftypefnx {} {@var{folder} =} delone.shadow ()
## Put the functions of this package in the place of those of Octave with the same names, or take them away again.
##
## These are delaunay, delaunayn, convhull, convhulln, voronoin, tsearchn, griddata and griddatan.  Programs that call them, Octave's own
## functions included, need no change.  The folder may be added to the path by other means, too.
## @end deftypefn

function folder = shadow (wanted)
  folder = fullfile (fileparts (fileparts (mfilename ("fullpath"))), "shadow");
  if (nargin == 0)
    return;
  endif
  is_on = any (strcmp (strsplit (path (), pathsep ()), folder));
  if (strcmp (wanted, "on"))
    ## Octave warns of names that it has itself, which is what is wanted here.
    old = warning ("off", "Octave:shadowed-function", "local");
    addpath (folder);
  elseif (! strcmp (wanted, "off"))
    delone.internal.usage ("shadow");
  elseif (is_on)
    rmpath (folder);
  endif
endfunction

%!test
%! x = [0 0; 1 1; 2 2];
%! delone.shadow ("on");
%! unwind_protect
%!   assert (strncmp (which ("delaunayn"), delone.shadow (), numel (delone.shadow ())));
%!   [H, V] = convhulln (x);
%!   assert (V, 0);
%! unwind_protect_cleanup
%!   delone.shadow ("off");
%! end_unwind_protect
%! assert (! strncmp (which ("delaunayn"), delone.shadow (), numel (delone.shadow ())));
%!error <Invalid call> delone.shadow ("of")
%!demo
%! delone.shadow ("on");
%! [H, V] = convhulln ([0 0 0; 1 0 0; 0 1 0; 1 1 0])
%! delone.shadow ("off");
