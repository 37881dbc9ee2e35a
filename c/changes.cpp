// SPDX-License-Identifier: BSD-3-Clause
// Edits of triangulations, and triangulations of some of the cells of another: trimmed ones, alpha complexes.
#include "options.hpp"
#include "triangulation.hpp"

#include <delone/alpha.hpp>
#include <delone/trim.hpp>

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace delone::c {
namespace {

MadeTriangulation& editable(delone_object* object) {
  return as<MadeTriangulation>(object, "a triangulation that was made");
}

/// Rows of the caller. The product refuses those that it does not have.
std::vector<std::size_t> rows_of(const std::int64_t* rows, std::size_t count) {
  std::vector<std::size_t> result;
  for (const std::int64_t row : matrix(rows, count, 1, "rows")) {
    if (row < 0) throw Error(Errc::invalid_argument, "rows: there is no row " + std::to_string(row));
    result.push_back(static_cast<std::size_t>(row));
  }
  return result;
}

}  // namespace
}  // namespace delone::c

using namespace delone;
using namespace delone::c;

int delone_remove(delone_object* triangulation, const std::int64_t* rows, std::size_t num_rows) {
  return run([&] { editable(triangulation).remove(rows_of(rows, num_rows)); });
}

int delone_move(delone_object* triangulation, const std::int64_t* rows, std::size_t num_rows,
                const double* to, const double* weights) {
  return run([&] { editable(triangulation).change(rows_of(rows, num_rows), to, weights); });
}

int delone_trim(const delone_object* triangulation, double tolerance, delone_object** object) {
  return make(object, [&] {
    const auto result = std::make_shared<TrimResult>(trim(as_made(triangulation).triangulation(), tolerance));
    ComplexData data = std::move(result->data);
    return std::make_unique<GivenTriangulation>(
        std::move(data),
        Members{
            {"kept", DELONE_ARRAY, [result](const delone_object&) -> Value { return list(result->kept); }},
            {"orphans", DELONE_ARRAY,
             [result](const delone_object&) -> Value { return list(result->orphans); }},
            {"depth", DELONE_REAL, [result](const delone_object&) -> Value { return result->depth; }},
            {"lost_volume", DELONE_REAL,
             [result](const delone_object&) -> Value { return result->lost_volume; }}});
  });
}

int delone_alpha_complex(const delone_object* triangulation, double radius, const delone_options* options,
                         delone_object** object) {
  return make(object, [&] {
    const AlphaComplex complex(as_made(triangulation).triangulation(), radius, execution(options));
    struct Parts {
      std::vector<SignedIndex> cell_numbers, boundary, boundary_cells, singular_facets;
      int k;
    };
    const auto copy = [](std::span<const SignedIndex> items) {
      return std::vector<SignedIndex>(items.begin(), items.end());
    };
    const auto parts = std::make_shared<const Parts>(
        Parts{copy(complex.cell_numbers()), copy(complex.boundary()), copy(complex.boundary_cells()),
              copy(complex.singular_facets()), complex.affine_dimension()});
    const auto get = [&](const char* name, auto make) {
      return Member{name, DELONE_ARRAY,
                    [parts, make](const delone_object&) -> Value { return make(*parts); }};
    };
    return std::make_unique<GivenTriangulation>(
        complex.to_data(),
        Members{get("cell_numbers", [](const Parts& p) { return list(p.cell_numbers); }),
                get("boundary", [](const Parts& p) { return table(p.boundary, p.k); }),
                get("boundary_cells", [](const Parts& p) { return list(p.boundary_cells); }),
                get("singular_facets", [](const Parts& p) { return table(p.singular_facets, p.k); })});
  });
}
