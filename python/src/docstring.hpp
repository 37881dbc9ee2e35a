// SPDX-License-Identifier: BSD-3-Clause
#pragma once

namespace delone::python {

/// The text of a raw string, without the line break that it begins with.
constexpr const char* text(const char* doc) { return doc + 1; }

}  // namespace delone::python

/// The arguments that all constructions have, as a part of literals.
#define DELONE_DOC_OF_BUILD_ARGUMENTS                                                                     \
  "seed : int, default 0\n"                                                                               \
  "    Seed of the random choices in the insertion order. Does not change the result.\n"                  \
  "order : {'automatic', 'as_given', 'shuffled'}\n"                                                       \
  "    The insertion order. Does not change the result.\n"                                                \
  "threads : int, default 0\n"                                                                            \
  "    The most threads to use; 0: one per core if the work is large enough to gain by it.\n"             \
  "progress : bool or callable, optional\n"                                                               \
  "    True shows a progress bar. A function is called about ten times a second with the fraction done, " \
  "0 to 1;\n"                                                                                             \
  "    returning a false value other than None cancels the call.\n"                                       \
  "memory_limit : float, optional\n"                                                                      \
  "    The most bytes that the process may use during the call.\n"                                        \
  "time_limit : float, optional\n"                                                                        \
  "    The most seconds that the call may take.\n"
