// SPDX-License-Identifier: BSD-3-Clause
// A full disk, played by a limit of the size of files.
#pragma once

#ifndef _WIN32
#include <sys/resource.h>

#include <csignal>
#endif

namespace delone::test {

/// While it lives, files of this process that are longer cannot be written.
class FileSizeLimit {
 public:
#ifdef _WIN32
  static constexpr bool exists = false;
  explicit FileSizeLimit(unsigned long long) {}
#else
  static constexpr bool exists = true;
  explicit FileSizeLimit(rlim_t bytes) : handler_(std::signal(SIGXFSZ, SIG_IGN)) {
    getrlimit(RLIMIT_FSIZE, &before_);
    const rlimit small{bytes, before_.rlim_max};
    setrlimit(RLIMIT_FSIZE, &small);
  }
  FileSizeLimit(const FileSizeLimit&) = delete;
  FileSizeLimit& operator=(const FileSizeLimit&) = delete;
  ~FileSizeLimit() {
    setrlimit(RLIMIT_FSIZE, &before_);
    std::signal(SIGXFSZ, handler_);
  }

 private:
  rlimit before_{};
  void (*handler_)(int);
#endif
};

}  // namespace delone::test
