// SPDX-License-Identifier: BSD-3-Clause
#include "sample.hpp"

#include "arrays.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace delone::python {

py::tuple sample(const HeldTriangulation& held, std::size_t limit) {
  using Simplices = std::vector<std::vector<std::size_t>>;  // rows, increasing
  Simplices cells, facets;
  std::size_t cell_size = 0, facet_size = 0;
  std::vector<double> corners, ends, box(2 * static_cast<std::size_t>(held.dimension()));
  const auto collect = [&](const Triangulation& t) {
    const Complex complex = t.complex();
    if (t.affine_dimension() < 0) return;
    const auto k = static_cast<std::size_t>(t.affine_dimension());
    cell_size = k + 1, facet_size = k;
    const auto rows_of = [&](CellId cell) {
      std::vector<std::size_t> rows;
      for (const VertexId v : complex.vertices(cell))
        if (!complex.is_infinite(v)) rows.push_back(t.row_of(v));
      std::sort(rows.begin(), rows.end());
      return rows;
    };
    if (k > 0 && complex.num_infinite_cells() <= limit)
      for (const CellId cell : complex.star(infinite_vertex)) facets.push_back(rows_of(cell));
    if (complex.num_finite_cells() <= limit) {
      for (const CellId cell : complex.finite_cells()) cells.push_back(rows_of(cell));
    } else {
      if (k > 3) cell_size = 1;
      for (std::size_t i = 0; i < limit; ++i) {
        const std::size_t row = i * t.num_rows() / limit;
        const VertexId v = t.vertex_at(row);
        if (v == invalid_vertex) continue;
        std::vector<std::size_t> smallest;
        if (k > 3)
          smallest = {t.row_of(v)};
        else
          for (const CellId cell : complex.star(v))
            if (!complex.is_infinite(cell))
              if (auto rows = rows_of(cell); smallest.empty() || rows < smallest) smallest = std::move(rows);
        cells.push_back(std::move(smallest));
      }
    }
    const std::size_t d = box.size() / 2;
    bool is_first = true;
    const auto append = [&](Simplices& simplices, std::vector<double>& to) {
      std::sort(simplices.begin(), simplices.end());
      simplices.erase(std::unique(simplices.begin(), simplices.end()), simplices.end());
      for (const auto& rows : simplices)
        for (const std::size_t row : rows) {
          const auto x = t.point(t.vertex_at(row));
          to.insert(to.end(), x.begin(), x.end());
          for (std::size_t j = 0; j < d; ++j) {
            box[j] = is_first ? x[j] : std::min(box[j], x[j]);
            box[d + j] = is_first ? x[j] : std::max(box[d + j], x[j]);
          }
          is_first = false;
        }
    };
    append(cells, corners);
    append(facets, ends);
  };
  Supervisor supervisor;
  supervisor.run([&] { held.with_unsorted(collect); });
  const std::size_t d = box.size() / 2;
  const auto shaped = [d](std::vector<double>&& items, std::size_t first, std::size_t second) {
    return rows_view(std::move(items), first * second, d).attr("reshape")(first, second, d);
  };
  return py::make_tuple(shaped(std::move(corners), cells.size(), cell_size),
                        shaped(std::move(ends), facets.size(), facet_size), rows_view(std::move(box), 2, d));
}

}  // namespace delone::python
