// SPDX-License-Identifier: BSD-3-Clause
// How often each stage of each kind of predicate was called, how often it answered, and whether it was right.
#pragma once

#include <delone/types.hpp>

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <iterator>
#include <optional>

namespace delone::campaign {

enum class Kind { orientation, sphere, weighted, furthest, hull, rays, hyperplane, dimension };
inline constexpr const char* kind_names[] = {"orientation", "sphere", "power sphere", "furthest sphere",
                                             "hull side",   "rays",   "hyperplane",   "dimension"};

/// A stage alone, a chain of stages by the one that answered, or a public function.
enum class Stage {
  filter,
  binary64,
  double_double,
  exact,
  perturbed,
  chain_to_direct,
  chain_to_exact,
  public_function
};
inline constexpr const char* stage_names[] = {"filter",    "binary64",        "double-double",  "exact",
                                              "perturbed", "chain to direct", "chain to exact", "public"};

class Tally {
 public:
  /// Nothing, if the stage passes the question on.
  void check(Kind kind, Stage stage, std::optional<Sign> answer, Sign truth) {
    Count& count = counts_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(stage)];
    ++count.calls;
    ++calls_;
    if (!answer) return;
    ++count.answers;
    zeros_ += truth == Sign::zero ? 1 : 0;
    if (*answer == truth) return;
    ++wrong_;
    std::printf("wrong: %s, %s: %d instead of %d, call %llu\n", kind_names[static_cast<std::size_t>(kind)],
                stage_names[static_cast<std::size_t>(stage)], static_cast<int>(*answer),
                static_cast<int>(truth), static_cast<unsigned long long>(calls_));
  }
  std::uint64_t calls() const { return calls_; }
  std::uint64_t wrong() const { return wrong_; }
  double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  void print(std::uint64_t seed) const {
    std::printf("%-16s %-16s %14s %14s\n", "predicate", "stage", "calls", "answers");
    for (std::size_t kind = 0; kind < std::size(kind_names); ++kind)
      for (std::size_t stage = 0; stage < std::size(stage_names); ++stage)
        if (const Count& count = counts_[kind][stage]; count.calls > 0)
          std::printf("%-16s %-16s %14llu %14llu\n", kind_names[kind], stage_names[stage],
                      static_cast<unsigned long long>(count.calls),
                      static_cast<unsigned long long>(count.answers));
    std::printf("seed %llu: %llu calls, %llu answers of them exact zeros, %llu wrong, %.0f s\n",
                static_cast<unsigned long long>(seed), static_cast<unsigned long long>(calls_),
                static_cast<unsigned long long>(zeros_), static_cast<unsigned long long>(wrong_), seconds());
  }

 private:
  struct Count {
    std::uint64_t calls = 0, answers = 0;
  };
  Count counts_[std::size(kind_names)][std::size(stage_names)] = {};
  std::uint64_t calls_ = 0, wrong_ = 0, zeros_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace delone::campaign
