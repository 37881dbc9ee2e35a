// SPDX-License-Identifier: BSD-3-Clause
#include "base/arithmetic.hpp"

#include "base/compiler.hpp"

#include <utility>

#if defined(__SSE2__) || defined(_M_X64)
#include <xmmintrin.h>
#elif !(DELONE_GNU_COMPILER && defined(__aarch64__))
#include <cfenv>
#endif

namespace delone {
namespace {

/// The state of the caller, in the innermost scope of this thread that changed it.
constinit thread_local std::uint64_t* callers_state = nullptr;

// Compilers do not know that arithmetic depends on the state. They move none across these functions, as they
// do not see into them from other files, and nothing is computed here.

#if defined(__SSE2__) || defined(_M_X64)

/// Of the register MXCSR: denormals are zero, masks of exceptions, rounding, flush to zero. The others are
/// flags.
constexpr std::uint32_t control_bits = 0xffc0, all_masked = 0x1f80;

std::uint32_t control() { return _mm_getcsr() & control_bits; }
bool is_exact() { return control() == all_masked; }

/// The x87 unit, which no code of delone uses, rounds too: functions of C that read and write decimal numbers
/// ask it for the direction. fesetround() changes both, so it needs no look if MXCSR is as it should be.
std::uint16_t x87_control() {
  std::uint16_t word = 0;
#if DELONE_GNU_COMPILER
  __asm__ __volatile__("fnstcw %0" : "=m"(word));
#endif
  return word;
}
void set_x87_control([[maybe_unused]] std::uint16_t word) {
#if DELONE_GNU_COMPILER
  __asm__ __volatile__("fldcw %0" : : "m"(word));
#endif
}

std::uint64_t state() { return std::uint64_t{x87_control()} << 32 | _mm_getcsr(); }
void set_state(std::uint64_t state) {
  set_x87_control(static_cast<std::uint16_t>(state >> 32));
  _mm_setcsr(static_cast<std::uint32_t>(state));
}
/// Masked, 64 bits of precision, to nearest.
constexpr std::uint64_t exact_state = std::uint64_t{0x037f} << 32 | all_masked;

#elif DELONE_GNU_COMPILER && defined(__aarch64__)

/// Of the register FPCR: alternative half precision, default NaN, flush to zero, rounding, flush half
/// precision to zero, traps, and what else changes the treatment of subnormal numbers. All are 0.
constexpr std::uint64_t control_bits = 0x07c89f07;

std::uint64_t state() {
  std::uint64_t word;
  __asm__ __volatile__("mrs %0, fpcr" : "=r"(word));
  return word;
}
void set_state(std::uint64_t state) { __asm__ __volatile__("msr fpcr, %0" : : "r"(state)); }
bool is_exact() { return (state() & control_bits) == 0; }
constexpr std::uint64_t exact_state = 0;

#else

/// Standard C++ knows the direction of rounding only.
std::uint64_t state() { return static_cast<std::uint64_t>(std::fegetround()); }
void set_state(std::uint64_t state) { std::fesetround(static_cast<int>(state)); }
bool is_exact() { return std::fegetround() == FE_TONEAREST; }
constexpr std::uint64_t exact_state = FE_TONEAREST;

#endif

}  // namespace

ArithmeticScope::ArithmeticScope() noexcept : is_changed_(!is_exact()) {
  if (!is_changed_) [[likely]]
    return;
  state_ = state();
  of_outer_ = std::exchange(callers_state, &state_);
  set_state(exact_state);
}
ArithmeticScope::~ArithmeticScope() {
  if (!is_changed_) [[likely]]
    return;
  set_state(state_);
  callers_state = of_outer_;
}

namespace internal {

CallersArithmetic::CallersArithmetic() noexcept
    : state_(state()), of_caller_(std::exchange(callers_state, nullptr)) {
  if (of_caller_ != nullptr) set_state(*of_caller_);
}
CallersArithmetic::~CallersArithmetic() {
  callers_state = of_caller_;
  set_state(state_);
}

}  // namespace internal
}  // namespace delone
