// SPDX-License-Identifier: BSD-3-Clause
// Which pairs of neighbors differ between two triangulations, as an object of arrays.
#include "object.hpp"
#include "options.hpp"
#include "periodic.hpp"
#include "triangulation.hpp"

#include <delone/neighbor_changes.hpp>

#include <cstdint>
#include <memory>
#include <utility>

using namespace delone;
using namespace delone::c;

int delone_changed_neighbors(const delone_object* before, const delone_object* after,
                             const delone_options* options, delone_object** object) {
  return make(object, [&] {
    const auto *const a = dynamic_cast<const PeriodicObject*>(before),
                      *const b = dynamic_cast<const PeriodicObject*>(after);
    if ((a == nullptr) != (b == nullptr))
      throw Error(Errc::invalid_argument, "two triangulations, both periodic or none");
    NeighborChanges changes =
        a != nullptr ? changed_neighbors(a->triangulation(), b->triangulation(), execution(options))
                     : changed_neighbors(as_made(before).product()->common(),
                                         as_made(after).product()->common(), execution(options));
    auto result = std::make_unique<Results>("neighbor_changes");
    result->add("rank", static_cast<std::int64_t>(changes.rank));
    result->add("began", std::move(changes.began), 2);
    result->add("ended", std::move(changes.ended), 2);
    if (a != nullptr) {
      result->add("began_offsets", std::move(changes.began_offsets), changes.rank);
      result->add("ended_offsets", std::move(changes.ended_offsets), changes.rank);
    }
    return result;
  });
}
