// SPDX-License-Identifier: BSD-3-Clause
#include "check/levels.hpp"

namespace delone {

template <PlainData Data>
std::span<const CheckLevel> check_levels() {
  return internal::levels_of<Data>;
}
template std::span<const CheckLevel> check_levels<ComplexData>();
template std::span<const CheckLevel> check_levels<HullData>();
template std::span<const CheckLevel> check_levels<IntersectionData>();
template std::span<const CheckLevel> check_levels<VoronoiData>();

}  // namespace delone
