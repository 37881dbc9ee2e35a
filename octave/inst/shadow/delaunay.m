## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {[@dots{}] =} delaunay (@dots{})
## The function @code{delone.delaunay} in the place of Octave's @code{delaunay}.
## @seealso{delone.delaunay, delone.shadow}
## @end deftypefn

function varargout = delaunay (varargin)
  [varargout{1:max (nargout, 1)}] = delone.delaunay (varargin{:});
endfunction
