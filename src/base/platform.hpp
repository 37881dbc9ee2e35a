// SPDX-License-Identifier: BSD-3-Clause
// All that depends on the operating system; files are in platform_files.hpp. Where a system does not offer
// something, the function does nothing and says so. With DELONE_PORTABLE no system offers anything.
#pragma once

#include <delone/config.hpp>

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <limits>

/// Which calls there are: those of Linux, of POSIX, of Windows.
#if !DELONE_PORTABLE && defined(__linux__)
#define DELONE_LINUX 1
#else
#define DELONE_LINUX 0
#endif
#if !DELONE_PORTABLE && !defined(_WIN32) && __has_include(<unistd.h>)
#define DELONE_POSIX 1
#else
#define DELONE_POSIX 0
#endif
#if !DELONE_PORTABLE && defined(_WIN32)
#define DELONE_WINDOWS 1
#else
#define DELONE_WINDOWS 0
#endif

namespace delone::platform {

/// Whether memory can be mapped and moved to other addresses without being copied.
inline constexpr bool maps_memory = DELONE_LINUX != 0;

/// The size of a large page where there are any.
inline constexpr std::size_t large_page = std::size_t{2} << 20;
/// A multiple of the usual page size of any machine.
inline constexpr std::size_t usual_page = std::size_t{64} << 10;

/// Memory that reads as zeros and takes up no pages until it is written, or nullptr. REQUIRES maps_memory.
void* map(std::size_t bytes);
/// Gives a mapped range another size, at another address if need be, keeping its contents; nullptr on
/// failure, which changes nothing. REQUIRES maps_memory.
void* remap(void* memory, std::size_t bytes, std::size_t new_bytes);
/// Gives a mapped range back. REQUIRES maps_memory.
void unmap(void* memory, std::size_t bytes);

/// Fetches the pages of a mapped range, all in one system call instead of one page fault for each. Returns
/// whether that was done. REQUIRES a range of whole pages.
bool populate(void* memory, std::size_t bytes);
/// Gives the pages of a mapped range back; its contents are unspecified from then on. REQUIRES a range of
/// whole pages.
void discard(void* memory, std::size_t bytes);
/// Advises the system to use large pages for a mapped range, or not to, wherever it has no pages yet.
void use_large_pages(void* memory, std::size_t bytes, bool wanted);

/// Seconds of a clock that never goes back.
double clock_seconds();
/// Seconds of processor time of this thread, those in the system included; those of clock_seconds() where
/// they are not known.
double thread_seconds();

/// The memory that this process has in use, mapped files included, in bytes; 0 if it is not known.
std::size_t resident_memory();
/// The memory that programs can still get without swapping, in bytes; 0 if it is not known.
std::size_t available_memory();

/// The size of the L1 data cache in bytes, or 0 if it is not known.
std::size_t first_level_cache();

}  // namespace delone::platform

namespace delone::internal {

/// The size of pages: large ones as long as they are cheap
/// (docs/decisions/0009-large-pages-while-they-are-cheap.md).
enum class Pages { usual, large };

/// An account of what large pages cost more than as much memory in usual ones. Every array has its own, but
/// what one of them finds out is known to the whole process for a second.
class PriceOfLargePages {
 public:
  /// Whether the price is still low enough to go on, after `large_pages` of them took `seconds` to fetch.
  /// `now`: seconds of any clock.
  bool pay(double seconds, std::size_t large_pages, double now) {
    debt_ = std::max(debt_ + seconds - usual_price * static_cast<double>(large_pages), 0.0);
    if (debt_ <= largest_debt) return true;
    found_dear_at_.store(now, std::memory_order_relaxed);
    return false;
  }
  /// Whether no array has found them dear within the last second.
  static bool are_worth_trying(double now) {
    return now - found_dear_at_.load(std::memory_order_relaxed) > for_a_while;
  }

 private:
  static constexpr double usual_price = 600e-6, largest_debt = 3e-3, for_a_while = 1;  // seconds
  inline static std::atomic<double> found_dear_at_ = -std::numeric_limits<double>::infinity();
  double debt_ = 0;
};

}  // namespace delone::internal
