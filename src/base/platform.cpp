// SPDX-License-Identifier: BSD-3-Clause
#include "base/platform.hpp"

#include "base/coarse_clock.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>

#if DELONE_LINUX
#include <sys/mman.h>
#endif
#if DELONE_POSIX
#include <time.h>
#include <unistd.h>
#endif
#if DELONE_WINDOWS
#include <windows.h>  // before psapi.h

#include <psapi.h>
#endif

namespace delone::platform {

#if DELONE_LINUX

void* map(std::size_t bytes) {
  void* const memory = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
  return memory == MAP_FAILED ? nullptr : memory;
}

void* remap(void* memory, std::size_t bytes, std::size_t new_bytes) {
  void* const moved = mremap(memory, bytes, new_bytes, MREMAP_MAYMOVE);
  return moved == MAP_FAILED ? nullptr : moved;
}

void unmap(void* memory, std::size_t bytes) { munmap(memory, bytes); }

bool populate([[maybe_unused]] void* memory, [[maybe_unused]] std::size_t bytes) {
#ifdef MADV_POPULATE_WRITE  // since Linux 5.14
  return madvise(memory, bytes, MADV_POPULATE_WRITE) == 0;
#else
  return false;
#endif
}

void discard(void* memory, std::size_t bytes) { madvise(memory, bytes, MADV_DONTNEED); }

void use_large_pages(void* memory, std::size_t bytes, bool wanted) {
  madvise(memory, bytes, wanted ? MADV_HUGEPAGE : MADV_NOHUGEPAGE);
}

#else

void* map(std::size_t) { return nullptr; }
void* remap(void*, std::size_t, std::size_t) { return nullptr; }
void unmap(void*, std::size_t) {}
bool populate(void*, std::size_t) { return false; }
void discard(void*, std::size_t) {}
void use_large_pages(void*, std::size_t, bool) {}

#endif

double clock_seconds() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

double thread_seconds() {
#if DELONE_POSIX && defined(CLOCK_THREAD_CPUTIME_ID)
  timespec now{};
  if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now) == 0)
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
#endif
  return clock_seconds();
}

std::chrono::steady_clock::time_point coarse_now() {
#if DELONE_LINUX && defined(CLOCK_MONOTONIC_COARSE)
  timespec now{};  // of the same clock as steady_clock
  if (clock_gettime(CLOCK_MONOTONIC_COARSE, &now) == 0)
    return std::chrono::steady_clock::time_point(std::chrono::seconds(now.tv_sec) +
                                                 std::chrono::nanoseconds(now.tv_nsec));
#endif
  return std::chrono::steady_clock::now();
}

std::size_t resident_memory() {
#if DELONE_LINUX
  if (std::FILE* const file = std::fopen("/proc/self/statm", "r")) {
    unsigned long long all = 0, resident = 0;
    const int found = std::fscanf(file, "%llu %llu", &all, &resident);
    std::fclose(file);
    if (found == 2)
      return static_cast<std::size_t>(resident) * static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  }
#elif DELONE_WINDOWS
  PROCESS_MEMORY_COUNTERS counters{};
  if (K32GetProcessMemoryInfo(GetCurrentProcess(), &counters, sizeof counters) != 0)
    return counters.WorkingSetSize;
#endif
  return 0;
}

std::size_t available_memory() {
  std::size_t available = 0;
#if DELONE_LINUX
  if (std::FILE* const file = std::fopen("/proc/meminfo", "r")) {
    char line[128];
    unsigned long long kilobytes = 0;
    while (std::fgets(line, sizeof line, file) != nullptr)
      if (std::sscanf(line, "MemAvailable: %llu", &kilobytes) == 1)
        available = static_cast<std::size_t>(kilobytes) * 1024;
    std::fclose(file);
  }
  // The limit of a container counts what it already uses.
  if (std::FILE* const file = std::fopen("/sys/fs/cgroup/memory.max", "r")) {
    unsigned long long limit = 0;
    if (std::fscanf(file, "%llu", &limit) == 1)
      available = std::min(available, static_cast<std::size_t>(limit));
    std::fclose(file);
  }
#elif DELONE_WINDOWS
  MEMORYSTATUSEX status{};
  status.dwLength = sizeof status;
  if (GlobalMemoryStatusEx(&status) != 0)
    available = static_cast<std::size_t>(std::min(status.ullAvailPhys, status.ullAvailPageFile));
#endif
  return available;
}

std::size_t first_level_cache() {
#if DELONE_POSIX && defined(_SC_LEVEL1_DCACHE_SIZE)
  if (const long bytes = sysconf(_SC_LEVEL1_DCACHE_SIZE); bytes > 0) return static_cast<std::size_t>(bytes);
#endif
  return 0;
}

}  // namespace delone::platform
