## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {[@dots{}] =} tsearchn (@dots{})
## The function @code{delone.tsearchn} in the place of Octave's @code{tsearchn}.
## @seealso{delone.tsearchn, delone.shadow}
## @end deftypefn

function varargout = tsearchn (varargin)
  [varargout{1:max (nargout, 1)}] = delone.tsearchn (varargin{:});
endfunction
