// SPDX-License-Identifier: BSD-3-Clause
#include "allocations.hpp"

#include <cstdlib>
#include <new>

namespace delone::test {

std::atomic<long> left_for_all_threads = -1;
thread_local Allocations allocations;
thread_local std::int64_t num_live_allocations = 0;

namespace {

void* allocate(std::size_t size, std::size_t alignment) {
  if (allocations.fails()) throw std::bad_alloc();
  void* const memory = alignment <= alignof(std::max_align_t)
                           ? std::malloc(size)
                           : std::aligned_alloc(alignment, (size + alignment - 1) / alignment * alignment);
  if (memory == nullptr) throw std::bad_alloc();
  ++num_live_allocations;
  return memory;
}
void release(void* memory) {
  if (memory != nullptr) --num_live_allocations;
  std::free(memory);
}

}  // namespace
}  // namespace delone::test

[[gnu::noinline]] void* operator new(std::size_t size) { return delone::test::allocate(size, 1); }
[[gnu::noinline]] void* operator new(std::size_t size, std::align_val_t alignment) {
  return delone::test::allocate(size, static_cast<std::size_t>(alignment));
}
// Sanitizers would serve these two themselves, with memory that is not from malloc().
[[gnu::noinline]] void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  if (delone::test::allocations.fails()) return nullptr;
  void* const memory = std::malloc(size);
  if (memory != nullptr) ++delone::test::num_live_allocations;
  return memory;
}
[[gnu::noinline]] void operator delete(void* memory, const std::nothrow_t&) noexcept {
  delone::test::release(memory);
}
[[gnu::noinline]] void operator delete(void* memory) noexcept { delone::test::release(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept { delone::test::release(memory); }
[[gnu::noinline]] void operator delete(void* memory, std::align_val_t) noexcept {
  delone::test::release(memory);
}
[[gnu::noinline]] void operator delete(void* memory, std::size_t, std::align_val_t) noexcept {
  delone::test::release(memory);
}
