// SPDX-License-Identifier: BSD-3-Clause
#include "io/known_kind.hpp"

#include "io/file.hpp"
#include "messages/in_quotes.hpp"

namespace delone::io {

DataKind known_kind(std::string_view kind, const std::string& name) {
  if (const auto known = find_data_kind(kind)) return *known;
  std::string all;
  for (int i = 1; i <= static_cast<int>(DataKind::furthest_voronoi); ++i)
    all += (all.empty() ? "" : ", ") + std::string(name_of(static_cast<DataKind>(i)));
  fail(Errc::bad_format, "{}: kind: {} is none of {}", name, messages::in_quotes(kind), all);
}

}  // namespace delone::io
