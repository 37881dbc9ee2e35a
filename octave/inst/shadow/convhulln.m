## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {[@dots{}] =} convhulln (@dots{})
## The function @code{delone.convhulln} in the place of Octave's @code{convhulln}.
## @seealso{delone.convhulln, delone.shadow}
## @end deftypefn

function varargout = convhulln (varargin)
  [varargout{1:max (nargout, 1)}] = delone.convhulln (varargin{:});
endfunction
