// SPDX-License-Identifier: BSD-3-Clause
// The one random generator of the library: xoshiro256++ seeded by splitmix64 (Blackman and Vigna, "Scrambled
// linear pseudorandom number generators", doi:10.1145/3460772). The same seed gives the same numbers on every
// platform, which the distributions of <random> do not promise. Only integer arithmetic and exact operations
// on doubles are used.
#pragma once

#include <array>
#include <bit>
#include <cstdint>

namespace delone::random {

/// A bijection of 64-bit words that spreads every input bit (the output function of splitmix64).
constexpr std::uint64_t mix(std::uint64_t z) {
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
  return z ^ (z >> 31);
}

class Generator {
 public:
  explicit constexpr Generator(std::uint64_t seed) {
    for (auto& word : state_) word = mix(seed += 0x9e3779b97f4a7c15u);
  }

  /// 64 random bits.
  constexpr std::uint64_t bits() {
    const std::uint64_t result = std::rotl(state_[0] + state_[3], 23) + state_[0];
    const std::uint64_t t = state_[1] << 17;
    state_[2] ^= state_[0];
    state_[3] ^= state_[1];
    state_[1] ^= state_[2];
    state_[0] ^= state_[3];
    state_[2] ^= t;
    state_[3] = std::rotl(state_[3], 45);
    return result;
  }

  /// A uniform integer in 0 … bound−1, without bias. REQUIRES bound ≥ 1.
  constexpr std::uint64_t below(std::uint64_t bound) {
    if (bound <= 0xffffffffu) {  // Lemire, doi:10.1145/3230636: multiply, and reject the few low products
                                 // that would be too likely
      std::uint64_t product = (bits() >> 32) * bound;
      if (static_cast<std::uint32_t>(product) < bound) {
        const auto threshold = static_cast<std::uint32_t>((std::uint64_t{1} << 32) % bound);
        while (static_cast<std::uint32_t>(product) < threshold) product = (bits() >> 32) * bound;
      }
      return product >> 32;
    }
    const int spare = std::countl_zero(bound - 1);
    std::uint64_t value = bits() >> spare;
    while (value >= bound) value = bits() >> spare;
    return value;
  }

  /// A uniform multiple of 2^−53 in [0, 1).
  constexpr double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }

  constexpr bool coin() { return (bits() >> 63) != 0; }

 private:
  std::array<std::uint64_t, 4> state_{};
};

}  // namespace delone::random
