// SPDX-License-Identifier: BSD-3-Clause
#include "construction/edit_lists.hpp"

#include "base/require_finite.hpp"

#include <delone/error.hpp>

#include <algorithm>
#include <cstddef>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace delone::construction {
namespace {

// Messages begin with the call that a list belongs to, and the place in it if there are several:
// "remove[2]: row 7 was removed".

std::string counted(std::size_t count, const std::string& what) {
  return std::to_string(count) + " " + what + (count == 1 ? "" : "s");
}

std::string place_in(const char* list, std::size_t size, std::size_t place) {
  std::string text = list;
  if (size != 1) text.append("[").append(std::to_string(place)).append("]");
  return text;
}

/// Throws where two lists that belong together are not of one length.
void require_as_many(const char* list, std::size_t found, const char* what, std::size_t expected,
                     const char* of) {
  if (found != expected)
    throw Error(Errc::bad_dimension,
                std::string(list) + ": " + counted(found, what) + " for " + counted(expected, of));
}

void require_whole_points(const char* list, std::size_t num_coordinates, std::size_t dimension) {
  if (num_coordinates % dimension != 0)
    throw Error(Errc::bad_dimension,
                std::string(list) + ": the number of coordinates is not a multiple of the dimension");
}

[[noreturn]] void throw_for_row(const char* list, std::span<const std::size_t> rows, std::size_t place,
                                const std::string& problem) {
  throw Error(Errc::invalid_argument,
              place_in(list, rows.size(), place) + ": row " + std::to_string(rows[place]) + " " + problem,
              {place});
}

[[noreturn]] void throw_for_repeated(const char* list, std::span<const std::size_t> rows, std::size_t first,
                                     std::size_t place) {
  throw_for_row(list, rows, place, "is given twice, see " + place_in(list, rows.size(), first));
}

/// `rows`: those that the numbers are for, or none: for new ones.
void require_finite(const char* list, std::span<const double> numbers, std::size_t width,
                    const std::string& what, std::span<const std::size_t> rows = {}) {
  const std::vector<std::size_t> places = internal::find_not_finite(numbers, width);
  if (places.empty()) return;
  const std::string row = rows.empty() ? "" : " for row " + std::to_string(rows[places.front()]);
  throw Error(Errc::not_finite,
              place_in(list, numbers.size() / width, places.front()) + ": " + what + row + " is not finite" +
                  internal::and_of_more(places),
              places);
}

/// Rows of one list are there, and are different.
void require_rows(const sites::SiteSet& sites, const char* list, std::span<const std::size_t> rows) {
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (rows[i] >= sites.num_rows()) throw_for_row(list, rows, i, "is not a row of the input");
    if (sites.vertex_of(rows[i]) == invalid_vertex) throw_for_row(list, rows, i, "was removed");
  }
  if (rows.size() < 2) return;
  if (rows.size() > sites.num_rows() / 16) {
    std::vector<bool> is_known(sites.num_rows());
    for (std::size_t i = 0; i < rows.size(); ++i) {
      if (is_known[rows[i]]) {
        const auto first = std::find(rows.begin(), rows.end(), rows[i]);
        throw_for_repeated(list, rows, static_cast<std::size_t>(first - rows.begin()), i);
      }
      is_known[rows[i]] = true;
    }
    return;
  }
  std::vector<std::pair<std::size_t, std::size_t>> sorted;
  for (std::size_t i = 0; i < rows.size(); ++i) sorted.emplace_back(rows[i], i);
  std::sort(sorted.begin(), sorted.end());
  for (std::size_t i = 1; i < sorted.size(); ++i)
    if (sorted[i].first == sorted[i - 1].first)
      throw_for_repeated(list, rows, sorted[i - 1].second, sorted[i].second);
}

/// No row of the list is removed.
void require_disjoint(const RowEdits& edits, const char* list, std::span<const std::size_t> rows) {
  if (edits.remove.empty() || rows.empty()) return;
  std::vector<std::size_t> removed(edits.remove.begin(), edits.remove.end());
  std::sort(removed.begin(), removed.end());
  for (std::size_t i = 0; i < rows.size(); ++i)
    if (std::binary_search(removed.begin(), removed.end(), rows[i])) {
      const auto there = std::find(edits.remove.begin(), edits.remove.end(), rows[i]);
      const auto place = static_cast<std::size_t>(there - edits.remove.begin());
      throw_for_row(list, rows, i, "is removed, see " + place_in("remove", removed.size(), place));
    }
}

}  // namespace

void require_valid(const State& state, const RowEdits& edits) {
  const std::size_t d = state.ambient();
  require_whole_points("move", edits.to.size(), d);
  require_whole_points("insert", edits.insert.size(), d);
  const std::size_t num_inserted = edits.insert.size() / d;
  require_as_many("move", edits.to.size() / d, "point", edits.move.size(), "row");
  require_as_many("set_weights", edits.weights.size(), "weight", edits.reweight.size(), "row");
  if (!state.weighted() && !(edits.reweight.empty() && edits.insert_weights.empty()))
    throw Error(Errc::invalid_argument, std::string(edits.reweight.empty() ? "insert" : "set_weights") +
                                            ": points of this triangulation have no weights");
  if (state.weighted())
    require_as_many("insert", edits.insert_weights.size(), "weight", num_inserted, "point");
  require_rows(state.sites, "remove", edits.remove);
  require_rows(state.sites, "move", edits.move);
  require_rows(state.sites, "set_weights", edits.reweight);
  require_disjoint(edits, "move", edits.move);
  require_disjoint(edits, "set_weights", edits.reweight);
  require_finite("move", edits.to, d, "a coordinate", edits.move);
  require_finite("set_weights", edits.weights, 1, "the weight", edits.reweight);
  require_finite("insert", edits.insert, d, "a coordinate");
  require_finite("insert", edits.insert_weights, 1, "the weight");
  if (num_inserted > max_index - state.sites.num_rows())
    throw Error(Errc::too_many, "insert: more points than this build has ids");
}

}  // namespace delone::construction
