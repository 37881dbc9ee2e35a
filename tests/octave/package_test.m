## SPDX-License-Identifier: BSD-3-Clause
## Runs the tests and the demonstrations of all functions of the package, which is on the path. The last line says how many passed, as other
## test programs do.

begin = tic ();
set (0, "defaultfigurevisible", "off");
folder = fileparts (which ("delone.version"));
files = [glob(fullfile (folder, "*.m")); glob(fullfile (folder, "+internal", "*.m"))];
passed = total = 0;
for i = 1:numel (files)
  [n, of] = test (files{i}, "quiet", stdout);
  passed += n;
  total += of;
  if (of == 0)
    printf ("%s has no tests\n", files{i});
    total += 1;
  endif
  [code, index] = test (files{i}, "grabdemo");
  for j = 1:numel (index) - 1
    total += 1;
    try
      evalc (code(index(j):index(j + 1) - 1));
      passed += 1;
    catch problem
      printf ("%s, demo %d: %s\n", files{i}, j, problem.message);
    end_try_catch
    close ("all");
  endfor
endfor

names = strrep (strrep (strsplit (strtrim (delone.help ()), "\n"), "delone.", ""), ".m", "");
listed = regexp (fileread (fullfile (fileparts (folder), "packinfo", "INDEX")), '^ delone\.(\w+)$', "tokens", "lineanchors");
total += 1;
if (isequal (sort (names), sort ([listed{:}])))
  passed += 1;
else
  printf ("INDEX does not list the functions that there are\n");
endif
printf ("%d passed, %d failed in %.1fs\n", passed, total - passed, toc (begin));
exit (passed != total);
