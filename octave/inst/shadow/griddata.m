## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn {} {[@dots{}] =} griddata (@dots{})
## The function @code{delone.griddata} in the place of Octave's @code{griddata}.
## @seealso{delone.griddata, delone.shadow}
## @end deftypefn

function varargout = griddata (varargin)
  [varargout{1:max (nargout, 1)}] = delone.griddata (varargin{:});
endfunction
