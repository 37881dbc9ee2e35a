// SPDX-License-Identifier: BSD-3-Clause
// POSIX systems. See system.hpp.
#include <delone/config.hpp>

#if !DELONE_PORTABLE && !defined(_WIN32) && __has_include(<unistd.h>)

#include "system.hpp"

#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <csignal>

#ifdef __GLIBC__
#include <malloc.h>
#endif

namespace delone::cli::system {
namespace {

/// The time that `caught` has to end the work.
constexpr int grace_microseconds = 800000;

rlimit data_before{};
bool has_limit = false;
void (*on_signal)(int) = nullptr;
void (*on_grace_over)() = nullptr;

extern "C" void handle_signal(int signal) {
  const int saved_errno = errno;
  on_signal(signal);
  itimerval timer{};
  timer.it_value.tv_usec = grace_microseconds;
  setitimer(ITIMER_REAL, &timer, nullptr);
  errno = saved_errno;
}

extern "C" void handle_alarm(int) { on_grace_over(); }

void handle(int signal, void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  action.sa_flags = SA_RESTART;
  sigemptyset(&action.sa_mask);
  sigaction(signal, &action, nullptr);
}

FoundFile found(const struct stat& status) {
  if (!S_ISREG(status.st_mode)) return {true, std::nullopt};
  return {true,
          FileNumber{static_cast<std::uint64_t>(status.st_dev), static_cast<std::uint64_t>(status.st_ino)}};
}

}  // namespace

void prepare_process() {
#ifdef __GLIBC__
  // By default glibc raises the threshold for this with the first large blocks and keeps later ones.
  mallopt(M_MMAP_THRESHOLD, 1 << 20);
#endif
}

bool is_terminal() { return isatty(STDERR_FILENO) == 1; }

int why_not_writable(const std::string& path) { return access(path.c_str(), W_OK) == 0 ? 0 : errno; }
int why_not_writable_folder(const std::string& path) {
  return access(path.c_str(), W_OK | X_OK) == 0 ? 0 : errno;
}

std::string null_device() { return "/dev/null"; }
void remove_null(const std::string&) {}

FoundFile find_file(const std::string& path) {
  struct stat status {};
  return stat(path.c_str(), &status) == 0 ? found(status) : FoundFile{};
}
FoundFile find_file(StandardStream stream) {
  struct stat status {};
  return fstat(stream == StandardStream::input ? STDIN_FILENO : STDOUT_FILENO, &status) == 0 ? found(status)
                                                                                             : FoundFile{};
}

std::size_t peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
#ifdef __APPLE__
  return static_cast<std::size_t>(usage.ru_maxrss);
#else
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
#endif
}

std::optional<Memory> memory_now() {
  std::optional<Memory> memory;
#ifdef __linux__
  if (std::FILE* const file = std::fopen("/proc/self/statm", "r")) {
    unsigned long long resident = 0, data = 0;
    if (std::fscanf(file, "%*u %llu %*u %*u %*u %llu", &resident, &data) == 2) {
      const auto page = static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE));
      memory = Memory{resident * page, data * page};
    }
    std::fclose(file);
  }
#endif
  return memory;
}

void limit_data(std::uint64_t bytes) {
  if (!has_limit) getrlimit(RLIMIT_DATA, &data_before);
  has_limit = true;
  rlimit data = data_before;
  data.rlim_cur = std::min<rlim_t>(bytes, data.rlim_max);
  setrlimit(RLIMIT_DATA, &data);
}
void restore_limit_of_data() {
  if (has_limit) setrlimit(RLIMIT_DATA, &data_before);
}

void watch_signals(void (*caught)(int), void (*grace_over)()) {
  on_signal = caught;
  on_grace_over = grace_over;
  for (const int signal : {SIGINT, SIGTERM}) {
    struct sigaction present {};
    sigaction(signal, nullptr, &present);
    if (present.sa_handler != SIG_IGN) handle(signal, handle_signal);
  }
  handle(SIGALRM, handle_alarm);
  std::signal(SIGXFSZ, SIG_IGN);
}

/// They fail with EFBIG, as SIGXFSZ is ignored. The writer then handles it like a full disk and removes the
/// temporary file.
void refuse_writes() {
  rlimit limit{};
  if (getrlimit(RLIMIT_FSIZE, &limit) != 0) return;
  limit.rlim_cur = 0;
  setrlimit(RLIMIT_FSIZE, &limit);
}

void write_error(std::string_view text) {
  [[maybe_unused]] const auto written = ::write(STDERR_FILENO, text.data(), text.size());
}

}  // namespace delone::cli::system

#endif
