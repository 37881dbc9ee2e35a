// SPDX-License-Identifier: BSD-3-Clause
// What options of Qhull ask for, as an object.
#include "messages/in_quotes.hpp"
#include "object.hpp"

#include <delone/qhull_options.hpp>

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <string>
#include <string_view>

namespace delone::c {
namespace {

class QhullOptionsObject final : public delone_object {
 public:
  explicit QhullOptionsObject(const QhullOptions& options) : options_(options) {}
  const char* kind() const override { return "qhull_options"; }
  const Members& members() const override;

 private:
  QhullOptions options_;
};

const Members& QhullOptionsObject::members() const {
  using Object = QhullOptionsObject;
  static const Members all = {
      member<Object>("scaled", [](const Object& o) { return o.options_.scaled; }),
      member<Object>("last_in_box", [](const Object& o) { return o.options_.last_in_box; }),
      member<Object>("in_cube", [](const Object& o) { return o.options_.in_cube; }),
      member<Object>("at_infinity", [](const Object& o) { return o.options_.at_infinity; }),
      member<Object>("keep_coplanar", [](const Object& o) { return o.options_.keep_coplanar; }),
      member<Object>("furthest_site", [](const Object& o) { return o.options_.furthest_site; }),
      member<Object>("joggled", [](const Object& o) { return o.options_.joggled; }),
      member<Object>("unmerged", [](const Object& o) { return o.options_.unmerged; }),
      member<Object>("good_visible", [](const Object& o) { return o.options_.good_visible; }),
      member<Object>("good_row",
                     [](const Object& o) {
                       return o.options_.good_row ? static_cast<std::int64_t>(*o.options_.good_row)
                                                  : std::int64_t{-1};
                     }),
      member<Object>("centrum", [](const Object& o) { return o.options_.centrum; }),
      member<Object>("roundoff",
                     [](const Object& o) {
                       return o.options_.roundoff.value_or(std::numeric_limits<double>::quiet_NaN());
                     }),
      member<Object>("width", [](const Object& o) { return o.options_.width; }),
  };
  return all;
}

QhullProgram program_of(std::string_view name) {
  constexpr std::array<std::string_view, 4> names{"delaunay", "voronoi", "hull", "halfspaces"};
  static_assert(static_cast<int>(QhullProgram::halfspaces) == 3);
  for (std::size_t i = 0; i < names.size(); ++i)
    if (names[i] == name) return static_cast<QhullProgram>(i);
  throw Error(Errc::invalid_argument,
              "program: " + messages::in_quotes(name) + " is none of delaunay, voronoi, hull, halfspaces");
}

}  // namespace
}  // namespace delone::c

using namespace delone;
using namespace delone::c;

int delone_qhull_options(const char* text, const char* program, delone_object** object) {
  return make(object, [&] {
    return std::make_unique<QhullOptionsObject>(
        parse_qhull_options(&required(text, "the text"), program_of(&required(program, "the program"))));
  });
}
