## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {[@dots{}] =} convhull (@dots{})
## The function @code{delone.convhull} in the place of Octave's @code{convhull}.
## @seealso{delone.convhull, delone.shadow}
## @end deftypefn

function varargout = convhull (varargin)
  [varargout{1:max (nargout, 1)}] = delone.convhull (varargin{:});
endfunction
