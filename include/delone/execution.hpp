// SPDX-License-Identifier: BSD-3-Clause
// How a call runs: by how many threads, and who hears of its progress.
#pragma once

#include <delone/config.hpp>

#include <functional>

namespace delone {

/// How a call runs; never what it returns. The last argument of calls that may take long:
///
///   t.hash({.threads = 4})
///
/// Constructions have the same two members among their Options, because an object keeps them for later
/// insertions and edits.
struct Execution {
  /// The most threads to use; 0: one per core of this process (affinity mask, quota of the container) if the
  /// work is large enough to gain by it. Work that cannot be divided is done by one.
  unsigned threads = 1;
  /// Called about every 20 ms by the thread that called the library, and by no other, with the fraction done,
  /// 0…1, which never decreases and is 0 if it is not known; return false to cancel (Errc::cancelled).
  /// ProgressScope does the same for all calls of a thread. The function must not use an object that the call
  /// changes.
  std::function<bool(double)> progress = {};
};

}  // namespace delone
