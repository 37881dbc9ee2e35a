## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {[@dots{}] =} delaunayn (@dots{})
## The function @code{delone.delaunayn} in the place of Octave's @code{delaunayn}.
## @seealso{delone.delaunayn, delone.shadow}
## @end deftypefn

function varargout = delaunayn (varargin)
  [varargout{1:max (nargout, 1)}] = delone.delaunayn (varargin{:});
endfunction
