## Copyright The delone authors
## SPDX-License-Identifier: BSD-3-Clause

## -*- texinfo -*-
## @deftypefn  {} {} delone.help ()
## @deftypefnx {} {} delone.help (@var{name})
## @deftypefnx {} {@var{text} =} delone.help (@dots{})
## The help of a function of the namespace, which Octave's help command does not find; without a name, the list of all.
## @end deftypefn

function text = help (name = "")
  folder = fileparts (mfilename ("fullpath"));
  if (isempty (name))
    files = dir (fullfile (folder, "*.m"));
    text = sprintf ("delone.%s\n", strrep ({files.name}, ".m", ""){:});
  else
    [text, format] = get_help_text_from_file (fullfile (folder, [name, ".m"]));
    if (strcmp (format, "Not found"))
      error ("delone:invalid-argument", "help: there is no function delone.%s", name);
    endif
    [text, status] = __makeinfo__ (text, "plain text");
    if (status != 0)
      text = strjoin (regexprep (strsplit (text, "\n"), "^@.*$", ""), "\n");
    endif
  endif
  if (nargout == 0)
    disp (text);
    clear text;
  endif
endfunction

%!assert (! isempty (strfind (delone.help (), "delone.delaunayn\n")))
%!assert (! isempty (strfind (delone.help ("delaunayn"), "delone.delaunayn (PTS)")))
%!error <there is no function delone.none> delone.help ("none")
%!demo
%! delone.help ("nearest")
