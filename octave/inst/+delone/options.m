## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {@var{old} =} delone.options ()
## @deftypefnx {} {@var{old} =} delone.options (@var{name}, @var{value}, @dots{})
## What holds for all later calls of the package.  No result depends on it, but for the order of simplices.
##
## @table @code
## @item threads
## the most threads to use; 0: one per core.  The default is 1,
## @item memory_limit
## the most bytes that the process may use; beyond, the error @code{delone:out-of-memory} ends a construction.  0: no limit,
## @item time_limit
## the most seconds of a construction; beyond, the error @code{delone:time-limit} ends it.  0: no limit,
## @item seed, order
## of the insertion: "automatic", "as_given" or "shuffled".
## @end table
##
## @var{old} is a struct of what was set before, which can be given in place of names and values.
## @end deftypefn

function old = options (varargin)
  old = __delone__ ("options");
  if (nargin == 1 && isstruct (varargin{1}))
    set = varargin{1};
  else
    if (mod (nargin, 2) != 0)
      delone.internal.usage ("options");
    endif
    set = old;
    for i = 1:2:nargin
      if (! ischar (varargin{i}) || ! any (strcmp (varargin{i}, {"threads", "memory_limit", "time_limit", "seed", "order"})))
        error ("delone:invalid-argument", "options: the options are threads, memory_limit, time_limit, seed and order");
      endif
      set.(varargin{i}) = varargin{i + 1};
    endfor
  endif
  __delone__ ("options", set);
endfunction

%!test
%! old = delone.options ("threads", 2, "order", "shuffled");
%! unwind_protect
%!   set = delone.options ();
%!   assert (set.threads, 2);
%!   x = rand (1000, 3);
%!   T = delone.delaunayn (x);
%!   delone.options ("threads", 1, "order", "as_given");
%!   assert (sortrows (sort (delone.delaunayn (x), 2)), sortrows (sort (T, 2)));
%! unwind_protect_cleanup
%!   delone.options (old);
%! end_unwind_protect
%!error <Invalid call> delone.options ("threads")
%!error <the options are> delone.options ("tolerance", 1)
%!error <is less than 0> delone.options ("threads", -1)
%!error <is none of automatic, as_given, shuffled> delone.options ("order", "none")
%!test
%! old = delone.options ("time_limit", 1e-6);
%! unwind_protect
%!   fail ("delone.delaunayn (rand (20000, 3))", "limit");
%! unwind_protect_cleanup
%!   delone.options (old);
%! end_unwind_protect
%!demo
%! old = delone.options ("threads", 0);
%! T = delone.delaunayn (rand (100000, 3));
%! delone.options (old);
