## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {@var{method} =} delone.internal.method (@var{caller}, @var{method}, @var{methods})
## The method of interpolation, in lower case, if it is one of those that the function has.
## @end deftypefn

function method = method (caller, method, methods)
  if (isempty (method))
    method = "linear";
    return;
  endif
  if (! ischar (method))
    error ("delone:invalid-argument", "%s: METHOD must be a string", caller);
  endif
  method = lower (method);
  if (strcmp (method, "cubic"))
    error ("delone:unsupported", '%s: the METHOD "cubic" is not yet implemented', caller);
  elseif (strcmp (method, "v4") && ! any (strcmp (method, methods)))
    error ("delone:unsupported", '%s: the "v4" METHOD is available for 2-D inputs, see griddata', caller);
  elseif (! any (strcmp (method, methods)))
    error ("delone:invalid-argument", '%s: unknown interpolation METHOD: "%s"', caller, method);
  endif
endfunction

%!assert (delone.internal.method ("f", [], {"linear"}), "linear")
%!assert (delone.internal.method ("f", "Natural", {"linear", "natural"}), "natural")
%!error <METHOD must be a string> delone.internal.method ("f", 5, {"linear"})
%!error <unknown interpolation METHOD: "foobar"> delone.internal.method ("f", "foobar", {"linear"})
