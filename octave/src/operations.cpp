// SPDX-License-Identifier: BSD-3-Clause
#include "operations.hpp"

#include "call.hpp"
#include "convert.hpp"
#include "object.hpp"

#include <octave/oct-map.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <map>
#include <vector>

namespace delone_octave {
namespace {

bool is_given(const octave_value& value) { return value.is_defined() && !value.isempty(); }

/// A count that an object has, such as its dimension.
int64_t integer_of(const Object& object, const char* name) {
  int64_t value = 0;
  call([&] { return delone_get_integer(object.get(), name, &value); });
  return value;
}

int dimension_of(const Object& object) { return static_cast<int>(integer_of(object, "dimension")); }

// ---- Products ------------------------------------------------------------------------------------------

using Maker = int (*)(const double*, std::size_t, int, const delone_options*, delone_object**);

/// make (PTS)
template <Maker Make>
octave_value_list of_points(const Arguments& arguments, int) {
  const Rows points(arguments[0], "the matrix of points");
  const Options options(arguments[1]);
  return ovl(make([&](delone_object** to) {
    return Make(points.data(), points.size(), points.columns(), options.get(), to);
  }));
}

/// convex_hulls (PTS, offsets): of each set of rows
octave_value_list convex_hulls(const Arguments& arguments, int) {
  const Rows points(arguments[0], "the matrix of points");
  const ColumnVector given = arguments[1].column_vector_value();
  const std::vector<std::size_t> offsets(given.data(), given.data() + given.numel());
  const Options options;
  return ovl(make([&](delone_object** to) {
    return delone_convex_hulls(points.data(), points.size(), points.columns(), offsets.data(),
                               offsets.size() - 1, options.get(), to);
  }));
}

/// regular (PTS, weights)
octave_value_list regular(const Arguments& arguments, int) {
  const Rows points(arguments[0], "the matrix of points"), weights(arguments[1], "the matrix of weights");
  weights.with_columns(1).with_rows(points.size());
  const Options options;
  return ovl(make([&](delone_object** to) {
    return delone_regular(points.data(), weights.data(), points.size(), points.columns(), options.get(), to);
  }));
}

/// halfspaces (H, interior point or [])
octave_value_list halfspaces(const Arguments& arguments, int) {
  const Rows rows(arguments[0], "the matrix of halfspaces");
  const Rows interior(is_given(arguments[1]) ? arguments[1] : octave_value(Matrix()), "the interior point");
  if (interior.size() > 0) interior.with_columns(rows.columns() - 1).with_rows(1);
  const Options options;
  return ovl(make([&](delone_object** to) {
    return delone_halfspace_intersection(rows.data(), rows.size(), rows.columns() - 1,
                                         interior.size() > 0 ? interior.data() : nullptr, options.get(), to);
  }));
}

/// voronoi (triangulation, options)
octave_value_list voronoi(const Arguments& arguments, int) {
  const Object& of = object_of(arguments[0]);
  const Options options(arguments[1]);
  return ovl(make([&](delone_object** to) { return delone_voronoi(of.get(), options.get(), to); }));
}

/// alpha_complex (triangulation, radius)
octave_value_list alpha_complex(const Arguments& arguments, int) {
  const Object& of = object_of(arguments[0]);
  const double radius = arguments[1].double_value();
  const Options options;
  return ovl(
      make([&](delone_object** to) { return delone_alpha_complex(of.get(), radius, options.get(), to); }));
}

/// cells (PTS, T): simplices of the caller
octave_value_list cells(const Arguments& arguments, int) {
  const Rows points(arguments[0], "the matrix of points");
  const std::vector<int64_t> rows = row_numbers(arguments[1], "the matrix of cells", points.size());
  const octave_idx_type width = arguments[1].columns();
  return ovl(make([&](delone_object** to) {
    return delone_triangulation_of_cells(points.data(), nullptr, points.size(), points.columns(), rows.data(),
                                         rows.size() / static_cast<std::size_t>(width),
                                         static_cast<int>(width) - 1, to);
  }));
}

// ---- Changes, of a copy: values of Octave do not change ------------------------------------------------

template <class Change>
octave_value_list changed(const octave_value& value, Change change) {
  const Object& of = object_of(value);
  const octave_value copy = make([&](delone_object** to) { return delone_clone(of.get(), to); });
  delone_object* const object = object_of(copy).get();
  call([&] { return change(object); });
  return ovl(copy);
}

/// insert (object, PTS)
octave_value_list insert(const Arguments& arguments, int) {
  const Rows points(arguments[1], "the matrix of points");
  points.with_columns(dimension_of(object_of(arguments[0])));
  return changed(arguments[0], [&](delone_object* object) {
    return delone_insert(object, points.data(), points.size(), nullptr);
  });
}

/// The rows that an edit names.
std::vector<int64_t> edited_rows(const Arguments& arguments) {
  const auto largest = static_cast<std::size_t>(integer_of(object_of(arguments[0]), "num_rows"));
  return row_numbers(arguments[1], "the list of rows", largest, "rows");
}

/// remove (object, rows)
octave_value_list remove(const Arguments& arguments, int) {
  const std::vector<int64_t> rows = edited_rows(arguments);
  return changed(arguments[0],
                 [&](delone_object* object) { return delone_remove(object, rows.data(), rows.size()); });
}

/// move (object, rows, PTS)
octave_value_list move(const Arguments& arguments, int) {
  const std::vector<int64_t> rows = edited_rows(arguments);
  const Rows to(arguments[2], "the matrix of points");
  to.with_columns(dimension_of(object_of(arguments[0]))).with_rows(rows.size());
  return changed(arguments[0], [&](delone_object* object) {
    return delone_move(object, rows.data(), rows.size(), to.data(), nullptr);
  });
}

// ---- Files ---------------------------------------------------------------------------------------------

/// read (path, options)
octave_value_list read(const Arguments& arguments, int) {
  const std::string path = arguments[0].string_value();
  const Options options(arguments[1]);
  return ovl(make([&](delone_object** to) { return delone_read(path.c_str(), options.get(), to); }));
}

/// write (object, path, format)
octave_value_list write(const Arguments& arguments, int) {
  const Object& of = object_of(arguments[0]);
  const std::string path = arguments[1].string_value(), format = arguments[2].string_value();
  call([&] { return delone_write(of.get(), path.c_str(), format.c_str()); });
  return {};
}

/// read_points (path, options)
octave_value_list read_points(const Arguments& arguments, int) {
  const std::string path = arguments[0].string_value();
  const Options options(arguments[1]);
  return ovl(make([&](delone_object** to) { return delone_read_points(path.c_str(), options.get(), to); }));
}

/// write_points (PTS, path, format)
octave_value_list write_points(const Arguments& arguments, int) {
  const Rows points(arguments[0], "the matrix of points");
  const std::string path = arguments[1].string_value(), format = arguments[2].string_value();
  call([&] {
    return delone_write_points(points.data(), points.size(), points.columns(), path.c_str(), format.c_str());
  });
  return {};
}

// ---- Members -------------------------------------------------------------------------------------------

/// get (object, name, ...)
octave_value_list get(const Arguments& arguments, int) {
  const Object& of = object_of(arguments[0]);
  octave_value_list values;
  for (octave_idx_type i = 1; arguments[i].is_defined(); ++i)
    values.append(member_of(of.get(), arguments[i].string_value()));
  return values;
}

/// members (object): the names of all
octave_value_list members(const Arguments& arguments, int) {
  const Object& of = object_of(arguments[0]);
  string_vector names;
  for (std::size_t i = 0; const char* const name = delone_member(of.get(), i, nullptr); ++i)
    names.append(std::string(name));
  return ovl(Cell(names));
}

/// lists (object, offsets, items, number of the first item)
octave_value_list lists(const Arguments& arguments, int) {
  return ovl(lists_of(object_of(arguments[0]).get(), arguments[1].string_value(), arguments[2].string_value(),
                      arguments[3].is_defined() ? arguments[3].double_value() : 1.0));
}

// ---- Queries -------------------------------------------------------------------------------------------

/// [cells, kinds, barycentric] = locate (object, XI)
octave_value_list locate(const Arguments& arguments, int nargout) {
  const Object& in = object_of(arguments[0]);
  const Rows queries(arguments[1], "the matrix of queries");
  queries.with_columns(dimension_of(in));
  const Options options(arguments[2]);
  const std::size_t n = queries.size();
  const std::size_t width =
      nargout > 2 ? static_cast<std::size_t>(integer_of(in, "affine_dimension") + 1) : 0;
  std::vector<int64_t> found(n);
  std::vector<uint8_t> kinds(n);
  std::vector<double> barycentric(n * width);
  call([&] {
    return delone_locate(in.get(), queries.data(), n, options.get(), found.data(), kinds.data(),
                         nargout > 2 ? barycentric.data() : nullptr, nullptr);
  });
  return ovl(numbers_from_1(found.data(), n, 1), matrix_of(kinds.data(), n, 1),
             matrix_of(barycentric.data(), n, width));
}

/// rows = nearest (triangulation, XI, count)
octave_value_list nearest(const Arguments& arguments, int) {
  const Object& in = object_of(arguments[0]);
  const Rows queries(arguments[1], "the matrix of queries");
  queries.with_columns(dimension_of(in));
  const auto count = static_cast<std::size_t>(arguments[2].idx_type_value());
  const Options options;
  std::vector<int64_t> rows(queries.size() * count);
  call([&] {
    return delone_nearest(in.get(), queries.data(), queries.size(), count, options.get(), rows.data());
  });
  return ovl(numbers_from_1(rows.data(), queries.size(), count));
}

/// natural_neighbors (triangulation, XI): lists with "offsets", "rows" and "weights"
octave_value_list natural_neighbors(const Arguments& arguments, int) {
  const Object& in = object_of(arguments[0]);
  const Rows queries(arguments[1], "the matrix of queries");
  queries.with_columns(dimension_of(in));
  const Options options;
  return ovl(make([&](delone_object** to) {
    return delone_natural_neighbors(in.get(), queries.data(), queries.size(), options.get(), to);
  }));
}

/// interpolator (triangulation, values, "linear", "natural" or "smooth")
octave_value_list interpolator(const Arguments& arguments, int) {
  const Object& of = object_of(arguments[0]);
  const Rows values(arguments[1], "the matrix of values");
  values.with_rows(static_cast<std::size_t>(integer_of(of, "num_points")));
  const std::string method = arguments[2].string_value();
  const auto columns = static_cast<std::size_t>(values.columns());
  return ovl(make([&](delone_object** to) {
    if (method == "linear") return delone_linear_interpolator(of.get(), values.data(), columns, to);
    return delone_natural_neighbor_interpolator(of.get(), values.data(), columns, method == "smooth" ? 1 : 0,
                                                nullptr, to);
  }));
}

/// [values, gradients] = interpolate (interpolator, XI)
octave_value_list interpolate(const Arguments& arguments, int nargout) {
  const Object& by = object_of(arguments[0]);
  const Rows queries(arguments[1], "the matrix of queries");
  const int dimension = dimension_of(by);
  queries.with_columns(dimension);
  const Options options(arguments[2]);
  const auto columns = static_cast<std::size_t>(integer_of(by, "columns"));
  const std::size_t n = queries.size(),
                    width = nargout > 1 ? columns * static_cast<std::size_t>(dimension) : 0;
  std::vector<double> values(n * columns), gradients(n * width);
  call([&] {
    return delone_interpolate(by.get(), queries.data(), n, options.get(), values.data(),
                              nargout > 1 ? gradients.data() : nullptr);
  });
  return ovl(matrix_of(values.data(), n, columns), matrix_of(gradients.data(), n, width));
}

/// region_volumes (diagram, low, high): one for each region
octave_value_list region_volumes(const Arguments& arguments, int) {
  const Object& of = object_of(arguments[0]);
  const Rows low(arguments[1], "the lower corner"), high(arguments[2], "the upper corner");
  low.with_columns(dimension_of(of)).with_rows(1);
  high.with_columns(dimension_of(of)).with_rows(1);
  const Options options;
  std::vector<double> volumes(static_cast<std::size_t>(integer_of(of, "num_regions")));
  call([&] {
    return delone_region_volumes(of.get(), low.data(), high.data(), options.get(), volumes.data());
  });
  return ovl(matrix_of(volumes.data(), volumes.size(), 1));
}

/// intersection_volumes (hulls, pairs)
octave_value_list intersection_volumes(const Arguments& arguments, int) {
  const Object& of = object_of(arguments[0]);
  const auto hulls = static_cast<std::size_t>(integer_of(of, "num_hulls"));
  const std::vector<int64_t> pairs = row_numbers(arguments[1], "the matrix of pairs", hulls, "hulls");
  const Options options;
  std::vector<double> volumes(pairs.size() / 2);
  call([&] {
    return delone_intersection_volumes(of.get(), pairs.data(), volumes.size(), options.get(), volumes.data());
  });
  return ovl(matrix_of(volumes.data(), volumes.size(), 1));
}

/// check (object, options): a report
octave_value_list check(const Arguments& arguments, int) {
  const Object& of = object_of(arguments[0]);
  const Options options(arguments[1]);
  return ovl(make([&](delone_object** to) { return delone_check(of.get(), options.get(), to); }));
}

// ---- Settings ------------------------------------------------------------------------------------------

/// options (): what is set. options (struct): sets it, unless an option is wrong
octave_value_list options(const Arguments& arguments, int) {
  if (arguments[0].isstruct()) {
    const Options probe(arguments[0]);
    default_options() = arguments[0].scalar_map_value();
  }
  return ovl(default_options());
}

/// qhull_options (text, program): what they ask for
octave_value_list qhull_options(const Arguments& arguments, int) {
  const std::string text = arguments[0].string_value(), program = arguments[1].string_value();
  return ovl(
      make([&](delone_object** to) { return delone_qhull_options(text.c_str(), program.c_str(), to); }));
}

octave_value_list version(const Arguments&, int) { return ovl(std::string(delone_version())); }

using Operation = octave_value_list (*)(const Arguments&, int);

const std::map<std::string, Operation>& operations() {
  static const std::map<std::string, Operation> all = {
      {"delaunay", of_points<delone_delaunay>},
      {"furthest_site", of_points<delone_furthest_site>},
      {"convex_hull", of_points<delone_convex_hull>},
      {"convex_hulls", convex_hulls},
      {"regular", regular},
      {"halfspaces", halfspaces},
      {"voronoi", voronoi},
      {"alpha_complex", alpha_complex},
      {"cells", cells},
      {"insert", insert},
      {"remove", remove},
      {"move", move},
      {"read", read},
      {"write", write},
      {"read_points", read_points},
      {"write_points", write_points},
      {"members", members},
      {"get", get},
      {"lists", lists},
      {"locate", locate},
      {"nearest", nearest},
      {"natural_neighbors", natural_neighbors},
      {"interpolator", interpolator},
      {"interpolate", interpolate},
      {"region_volumes", region_volumes},
      {"intersection_volumes", intersection_volumes},
      {"check", check},
      {"options", options},
      {"qhull_options", qhull_options},
      {"version", version},
  };
  return all;
}

}  // namespace

octave_value_list operate(const std::string& name, const Arguments& arguments, int nargout) {
  const auto found = operations().find(name);
  if (found == operations().end())
    error_with_id("delone:invalid-argument", "delone: there is no operation %s", name.c_str());
  return found->second(arguments, nargout);
}

}  // namespace delone_octave
