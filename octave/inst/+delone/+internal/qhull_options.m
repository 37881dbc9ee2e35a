## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {} delone.internal.qhull_options (@var{caller}, @var{options})
## Examine the options of Qhull that a function of Octave's names is given.
##
## All results are exact, so most options have nothing to change.  Those that ask
## for another result are errors.
## @end deftypefn

function qhull_options (caller, options)
  if (isempty (options))
    return;
  endif
  if (ischar (options))
    options = cellstr (options);
  elseif (! iscellstr (options))
    error ("delone:invalid-argument", "%s: OPTIONS must be a string or cell array of strings", caller);
  endif
  words = strsplit (strtrim (strjoin (options(:)', " ")));
  ## Q: scales or drops a coordinate, rotates, selects facets, furthest sites; T: stops early or names a file; P: selects
  ## facets; d, v, H: other programs.
  refused = "^(Q[bB][k\\d].*|QR-?\\d*|QV-?\\d*|QG.*|Qg|Qi|Qu|T[ACV]-?\\d+|T[IO].*|P[dD]\\d.*|P[AFM]\\d+.*|[dv]|H.*)$";
  for i = 1:numel (words)
    if (! isempty (regexp (words{i}, refused, "once")))
      error ("delone:unsupported", "%s: Qhull's option \"%s\" asks for a result that delone does not have", caller, words{i});
    endif
  endfor
endfunction

%!test delone.internal.qhull_options ("f", {"Qt", "Qbb Qc"});
%!error <OPTIONS must be a string or cell array> delone.internal.qhull_options ("f", struct ())
%!error <"Qu"> delone.internal.qhull_options ("f", "Qt Qu")
