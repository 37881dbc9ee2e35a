// SPDX-License-Identifier: BSD-3-Clause
// Points from an .npy array: one row per point, or one number per point.
#include "io/npy.hpp"

#include "io/collect.hpp"
#include "io/file.hpp"
#include "io/points/read_points.hpp"

#include <limits>

namespace delone::io {

PointTable points_of(const NpyArray& array, const std::string& name, Missing missing) {
  if (array.shape.empty())
    fail(Errc::bad_format, "{}: a single number; expected an array of shape (n, d)", name);
  const std::size_t dimension = array.shape.size() == 1 ? 1 : array.shape[1];
  if (dimension == 0)
    fail(Errc::bad_dimension, "{}: shape {}: the dimension is 0", name, shape_text(array.shape));
  if (dimension > static_cast<std::size_t>(std::numeric_limits<int>::max()))
    fail(Errc::bad_dimension, "{}: shape {}: the dimension is too large", name, shape_text(array.shape));
  PointTable table;
  table.dimension = static_cast<int>(dimension);
  table.coordinates = to_doubles(array, name);
  require_finite(table.coordinates, table.dimension, name, {}, 0, missing);
  return table;
}

PointTable read_npy(std::string_view bytes, const std::string& name, Missing missing) {
  return points_of(parse_npy(bytes, name), name, missing);
}

}  // namespace delone::io
