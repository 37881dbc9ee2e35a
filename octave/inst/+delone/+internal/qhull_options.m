## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {@var{furthest} =} delone.internal.qhull_options (@var{caller}, @var{options}, @var{program})
## Examine Qhull's options, given to a function with a name of Octave's: whether they ask for furthest sites.
##
## The library knows what an option means for a @var{program}: "delaunay", "voronoi" or "hull".  Most have no effect, as all
## results are exact.  Those that ask for a result that the function does not have are errors; so are furthest sites if nothing is returned.
## @end deftypefn

function furthest = qhull_options (caller, options, program)
  furthest = false;
  if (isempty (options))
    return;
  endif
  if (ischar (options))
    options = cellstr (options);
  elseif (! iscellstr (options))
    error ("delone:invalid-argument", "%s: OPTIONS must be a string or cell array of strings", caller);
  endif
  try
    found = __delone__ ("qhull_options", strjoin (options(:)', " "), program);
  catch problem
    error (problem.identifier, "%s: %s", caller, regexprep (problem.message, "^delone: ", ""));
  end_try_catch
  [furthest, good] = __delone__ ("get", found, "furthest_site", "good_row");
  furthest = logical (furthest);
  if (good >= 0)
    error ("delone:unsupported", "%s: Qhull's option QG selects facets, and all are returned", caller);
  elseif (furthest && nargout == 0)
    error ("delone:unsupported", "%s: Qhull's option Qu asks for furthest sites", caller);
  endif
endfunction

%!assert (delone.internal.qhull_options ("f", {"Qt", "Qbb Qc"}, "delaunay"), false)
%!assert (delone.internal.qhull_options ("f", "Qt Qu", "voronoi"), true)
%!assert (delone.internal.qhull_options ("f", [], "hull"), false)
%!error <OPTIONS must be a string or cell array> delone.internal.qhull_options ("f", struct (), "hull")
%!error <f: Qhull option 'Qu': only triangulations> delone.internal.qhull_options ("f", "Qt Qu", "hull")
%!error id=delone:unsupported delone.internal.qhull_options ("f", "TOfile", "hull")
%!error <Qu asks for furthest sites> delone.internal.qhull_options ("f", "Qu", "delaunay")
%!error <QG selects facets> delone.internal.qhull_options ("f", "QG0", "hull")
