## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {[@dots{}] =} voronoin (@dots{})
## The function @code{delone.voronoin} in the place of Octave's @code{voronoin}.
## @seealso{delone.voronoin, delone.shadow}
## @end deftypefn

function varargout = voronoin (varargin)
  [varargout{1:max (nargout, 1)}] = delone.voronoin (varargin{:});
endfunction
