## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {[@dots{}] =} griddatan (@dots{})
## The function @code{delone.griddatan} in the place of Octave's @code{griddatan}.
## @seealso{delone.griddatan, delone.shadow}
## @end deftypefn

function varargout = griddatan (varargin)
  [varargout{1:max (nargout, 1)}] = delone.griddatan (varargin{:});
endfunction
