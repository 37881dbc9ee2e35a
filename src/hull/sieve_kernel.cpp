// SPDX-License-Identifier: BSD-3-Clause
// Points are taken in blocks, their coordinates relative to the origin gathered axis by axis. Functions pass
// over a block that is in the cache.
#include "hull/sieve_kernel.hpp"

#include "base/compiled_dimension.hpp"
#include "base/parallel_parts.hpp"

#include <algorithm>
#include <cstdint>

#ifndef HWY_TARGET_INCLUDE  // else several kernels are compiled together
#define HWY_TARGET_INCLUDE "hull/sieve_kernel.cpp"
#endif
#include <hwy/foreach_target.h>
// After foreach_target.h
#include <hwy/highway.h>

#ifndef DELONE_SIEVE_KERNEL
#define DELONE_SIEVE_KERNEL
namespace delone::hull {

/// Points per block.
inline constexpr std::size_t sieve_block = 64;

struct SieveTask {
  std::span<const double> points;
  const LinearFunctions& functions;
  std::span<const double> thresholds;
  std::span<Extreme> extremes;
  std::span<char> is_below;
};

}  // namespace delone::hull
#endif

HWY_BEFORE_NAMESPACE();
namespace delone::hull {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, 8>;
using Vector = hn::Vec<Tag>;

/// Coordinates of `count` ≤ sieve_block points relative to the origin, axis by axis; the last point fills the
/// block.
template <std::size_t D>
void gather(const double* points, std::size_t count, std::size_t dimension, const double* origin,
            double* HWY_RESTRICT block) {
  const std::size_t d = D > 0 ? D : dimension;
  const Tag tag;
  if constexpr (D >= 2 && D <= 4) {
    if (count == sieve_block) {
      for (std::size_t i = 0; i < sieve_block; i += hn::Lanes(tag)) {
        Vector x[4] = {hn::Zero(tag), hn::Zero(tag), hn::Zero(tag), hn::Zero(tag)};
        if constexpr (D == 2) hn::LoadInterleaved2(tag, points + D * i, x[0], x[1]);
        if constexpr (D == 3) hn::LoadInterleaved3(tag, points + D * i, x[0], x[1], x[2]);
        if constexpr (D == 4) hn::LoadInterleaved4(tag, points + D * i, x[0], x[1], x[2], x[3]);
        for (std::size_t j = 0; j < D; ++j)
          hn::Store(hn::Sub(x[j], hn::Set(tag, origin[j])), tag, block + j * sieve_block + i);
      }
      return;
    }
  }
  for (std::size_t i = 0; i < sieve_block; ++i) {
    const double* point = points + std::min(i, count - 1) * d;
    for (std::size_t j = 0; j < d; ++j) block[j * sieve_block + i] = point[j] - origin[j];
  }
}

/// The values of one function at the points of a part of a block, `Parts` vectors.
template <std::size_t D, std::size_t Parts>
HWY_INLINE void evaluate(const double* HWY_RESTRICT block, const double* normal, std::size_t dimension,
                         Vector* values) {
  const std::size_t d = D > 0 ? D : dimension;
  const Tag tag;
  const Vector first = hn::Set(tag, normal[0]);
  for (std::size_t p = 0; p < Parts; ++p)
    values[p] = hn::Mul(first, hn::Load(tag, block + p * hn::Lanes(tag)));
  for (std::size_t j = 1; j < d; ++j) {
    const Vector factor = hn::Set(tag, normal[j]);
    for (std::size_t p = 0; p < Parts; ++p)
      values[p] = hn::MulAdd(factor, hn::Load(tag, block + j * sieve_block + p * hn::Lanes(tag)), values[p]);
  }
}

inline constexpr std::size_t parts = 4;

template <std::size_t D, class Visit>
void for_each_block(const SieveTask& task, Visit visit) {
  const std::size_t d = task.functions.origin.size(), n = task.points.size() / d;
  std::vector<double> memory(d * sieve_block + 8);
  double* const block = memory.data() + (64 - reinterpret_cast<std::uintptr_t>(memory.data()) % 64) % 64 / 8;
  for (std::size_t first = 0; first < n; first += sieve_block) {
    const std::size_t count = std::min(sieve_block, n - first);
    gather<D>(task.points.data() + first * d, count, d, task.functions.origin.data(), block);
    visit(block, first, count);
  }
}

template <std::size_t D>
void extremes(const SieveTask& task) {
  const Tag tag;
  const std::size_t d = task.functions.origin.size(), stride = parts * hn::Lanes(tag);
  alignas(64) double values[sieve_block];
  for_each_block<D>(task, [&](const double* block, std::size_t first, std::size_t) {
    for (std::size_t f = 0; f < task.extremes.size(); ++f) {
      const double* normal = task.functions.normals.data() + f * d;
      Vector largest = hn::Set(tag, task.extremes[f].value);
      for (std::size_t i = 0; i < sieve_block; i += stride) {
        Vector found[parts];
        evaluate<D, parts>(block + i, normal, d, found);
        for (std::size_t p = 0; p < parts; ++p) {
          hn::Store(found[p], tag, values + i + p * hn::Lanes(tag));
          largest = hn::Max(largest, found[p]);
        }
      }
      if (hn::AllFalse(tag, hn::Gt(largest, hn::Set(tag, task.extremes[f].value)))) continue;
      for (std::size_t i = 0; i < sieve_block; ++i)
        if (values[i] > task.extremes[f].value) task.extremes[f] = {values[i], first + i};
    }
  });
  // The last point fills the last block.
  const std::size_t n = task.points.size() / d;
  for (Extreme& extreme : task.extremes)
    if (extreme.at != Extreme::nowhere) extreme.at = std::min(extreme.at, n - 1);
}

template <std::size_t D>
void below(const SieveTask& task) {
  const Tag tag;
  const std::size_t d = task.functions.origin.size(), m = task.thresholds.size(),
                    stride = parts * hn::Lanes(tag);
  for_each_block<D>(task, [&](const double* block, std::size_t first, std::size_t count) {
    for (std::size_t i = 0; i < sieve_block; i += stride) {
      hn::Mask<Tag> all[parts];
      for (auto& mask : all) mask = hn::Eq(hn::Zero(tag), hn::Zero(tag));
      for (std::size_t f = 0; f < m; ++f) {
        Vector found[parts];
        evaluate<D, parts>(block + i, task.functions.normals.data() + f * d, d, found);
        const Vector threshold = hn::Set(tag, task.thresholds[f]);
        for (std::size_t p = 0; p < parts; ++p) all[p] = hn::And(all[p], hn::Lt(found[p], threshold));
        constexpr std::size_t patience = 16;  // functions between looks at whether any point is left
        if (f % patience == patience - 1 &&
            hn::AllFalse(tag, hn::Or(hn::Or(all[0], all[1]), hn::Or(all[2], all[3]))))
          break;
      }
      for (std::size_t p = 0; p < parts; ++p) {
        std::uint8_t bits[8] = {};
        hn::StoreMaskBits(tag, all[p], bits);
        for (std::size_t lane = 0; lane < hn::Lanes(tag); ++lane) {
          const std::size_t at = i + p * hn::Lanes(tag) + lane;
          if (at < count) task.is_below[first + at] = static_cast<char>(bits[lane / 8] >> (lane % 8) & 1);
        }
      }
    }
  });
}

void Extremes(const SieveTask& task) {
  internal::with_compiled_dimension<2, 5>(task.functions.origin.size(), [&](auto d) { extremes<d()>(task); });
}
void Below(const SieveTask& task) {
  internal::with_compiled_dimension<2, 5>(task.functions.origin.size(), [&](auto d) { below<d()>(task); });
}

}  // namespace HWY_NAMESPACE
}  // namespace delone::hull
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace delone::hull {

HWY_EXPORT(Extremes);
HWY_EXPORT(Below);

namespace {
/// What one thread does at a time, some tens of milliseconds at most: it can be stopped before a part.
std::size_t points_per_part(const LinearFunctions& functions) {
  constexpr std::size_t most_points = 16384, most_work = std::size_t{1} << 27;
  const std::size_t blocks =
      most_work / sieve_block / std::max<std::size_t>(functions.size() * functions.origin.size(), 1);
  return std::clamp(blocks * sieve_block, sieve_block, most_points);
}
}  // namespace

void find_extremes(std::span<const double> points, const LinearFunctions& functions,
                   std::span<Extreme> extremes, unsigned threads) {
  const std::size_t d = functions.origin.size(), n = points.size() / std::max<std::size_t>(d, 1);
  if (n == 0) return;
  const std::size_t per_part = points_per_part(functions);
  std::vector<Extreme> found((n + per_part - 1) / per_part * extremes.size());
  internal::for_parts(
      threads, n, per_part, [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
        stop();
        const std::span<Extreme> of_part(found.data() + first / per_part * extremes.size(), extremes.size());
        std::copy(extremes.begin(), extremes.end(), of_part.begin());
        for (Extreme& extreme : of_part) extreme.at = Extreme::nowhere;
        HWY_DYNAMIC_DISPATCH(Extremes)
        ({points.subspan(first * d, (last - first) * d), functions, {}, of_part, {}});
      });
  for (std::size_t i = 0; i < found.size(); ++i) {
    const Extreme& candidate = found[i];
    Extreme& extreme = extremes[i % extremes.size()];
    if (candidate.at != Extreme::nowhere && candidate.value > extreme.value)
      extreme = {candidate.value, candidate.at + i / extremes.size() * per_part};
  }
}

void find_below(std::span<const double> points, const LinearFunctions& functions,
                std::span<const double> thresholds, std::span<char> is_below, unsigned threads) {
  const std::size_t d = functions.origin.size(), n = points.size() / std::max<std::size_t>(d, 1);
  internal::for_parts(threads, n, points_per_part(functions),
                      [&](std::size_t first, std::size_t last, const internal::StopPoint& stop) {
                        stop();
                        HWY_DYNAMIC_DISPATCH(Below)
                        ({points.subspan(first * d, (last - first) * d),
                          functions,
                          thresholds,
                          {},
                          is_below.subspan(first, last - first)});
                      });
}

}  // namespace delone::hull
#endif
