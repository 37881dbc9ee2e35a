/* SPDX-License-Identifier: BSD-3-Clause */
/* Queries, compared with what their definitions say. */
#include "c_test.h"

#include <math.h>

enum { n = 300, q = 200 };

static void locate_and_barycentric(const delone_object* t, const double* points, const double* queries) {
  static int64_t cells[q];
  static uint8_t kinds[q];
  static double barycentric[q * 4], distances[q];
  const delone_array corners = get_array(t, "cells");
  int inside = 0;
  size_t i, j, axis;
  OK(delone_locate(t, queries, q, NULL, cells, kinds, barycentric, distances));
  for (i = 0; i < q; ++i) {
    CHECK((kinds[i] == DELONE_INSIDE) == (cells[i] >= 0) && distances[i] == 0);
    CHECK((kinds[i] == DELONE_OUTSIDE_HULL) == (isnan(barycentric[4 * i]) != 0));
    if (kinds[i] != DELONE_INSIDE) continue;
    ++inside;
    for (axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (j = 0; j < 4; ++j)
        sum += barycentric[4 * i + j] * points[3 * (size_t)entry(&corners, 4 * (size_t)cells[i] + j) + axis];
      CHECK(fabs(sum - queries[3 * i + axis]) < 1e-12);
    }
  }
  CHECK(inside > q / 2 && inside < q);
  OK(delone_locate(t, points, q, NULL, NULL, kinds, NULL, NULL));
  for (i = 0; i < q; ++i) CHECK(kinds[i] == DELONE_ON_VERTEX);
  OK(delone_locate(t, queries, q, NULL, NULL, NULL, NULL, NULL));
}

static double squared_distance(const double* a, const double* b) {
  double sum = 0;
  int i;
  for (i = 0; i < 3; ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

static void nearest(const delone_object* t, const double* points, const double* queries) {
  static int64_t rows[q * 3], all[2 * (n + 1)];
  size_t i, j;
  OK(delone_nearest(t, queries, q, 3, NULL, rows));
  for (i = 0; i < q; ++i) {
    size_t nearer = 0;
    const double second = squared_distance(queries + 3 * i, points + 3 * rows[3 * i + 1]);
    for (j = 0; j < n; ++j) nearer += squared_distance(queries + 3 * i, points + 3 * j) < second;
    CHECK(nearer == 1);
  }
  OK(delone_nearest(t, queries, 2, n + 1, NULL, all));
  CHECK(all[n - 1] >= 0 && all[n] == -1 && all[2 * n + 1] == -1);
  FAILS(DELONE_INVALID_ARGUMENT, delone_nearest(t, queries, 1, 0, NULL, NULL));
}

static void interpolate(delone_object* t, const double* points, const double* queries,
                        delone_options* options) {
  static double values[2 * n], results[2 * q], gradients[6 * q];
  static int64_t cells[q];
  delone_object *linear, *natural;
  size_t i;
  for (i = 0; i < n; ++i) {
    values[2 * i] = points[3 * i] - 2 * points[3 * i + 1] + 3 * points[3 * i + 2];
    values[2 * i + 1] = 7;
  }
  OK(delone_linear_interpolator(t, values, 2, &linear));
  CHECK(strcmp(delone_kind(linear), "interpolator") == 0 && get_integer(linear, "columns") == 2);
  OK(delone_natural_neighbor_interpolator(t, values, 2, 0, NULL, &natural));
  OK(delone_locate(t, queries, q, NULL, cells, NULL, NULL, NULL));
  OK(delone_set_real(options, "fill", -1));
  OK(delone_interpolate(linear, queries, q, options, results, gradients));
  for (i = 0; i < q; ++i) {
    const double* const x = queries + 3 * i;
    CHECK(fabs(results[2 * i] - (cells[i] < 0 ? -1 : x[0] - 2 * x[1] + 3 * x[2])) < 1e-12);
    if (cells[i] >= 0) CHECK(fabs(results[2 * i + 1] - 7) < 1e-12 && fabs(gradients[6 * i + 2] - 3) < 1e-9);
  }
  OK(delone_interpolate(natural, queries, q, options, results, NULL));
  for (i = 0; i < q; ++i) {
    const double* const x = queries + 3 * i;
    CHECK(fabs(results[2 * i] - (cells[i] < 0 ? -1 : x[0] - 2 * x[1] + 3 * x[2])) < 1e-9);
  }
  OK(delone_set_text(options, "outside", "error"));
  FAILS(DELONE_INVALID_ARGUMENT, delone_interpolate(linear, queries, q, options, results, NULL));
  CHECK(delone_error_rows(NULL) == 1);
  FAILS(DELONE_INVALID_ARGUMENT, delone_locate(t, queries, q, options, cells, NULL, NULL, NULL));
  OK(delone_set_text(options, "outside", "fill"));
  /* It notices that its triangulation has changed, and outlives it. */
  OK(delone_insert(t, queries, 1, NULL));
  FAILS(DELONE_INVALID_ARGUMENT, delone_interpolate(linear, queries, q, NULL, results, NULL));
  delone_free(linear);
  delone_free(natural);
  {
    delone_object* copy;
    OK(delone_clone(t, &copy));
    OK(delone_linear_interpolator(copy, (const double*)get_array(copy, "points").data, 3, &linear));
    delone_free(copy);
    OK(delone_interpolate(linear, points, 3, NULL, results, NULL));
    CHECK(memcmp(results, points, 9 * sizeof(double)) == 0);
    delone_free(linear);
  }
}

static void lists(const delone_object* t, const double* points, const double* queries) {
  static int64_t cells[q];
  delone_object *near, *neighbors;
  delone_array offsets, items, rows, weights;
  size_t i, j, axis;
  OK(delone_locate(t, queries, q, NULL, cells, NULL, NULL, NULL));
  OK(delone_cells_within(t, queries, q, 0.05, NULL, &near));
  CHECK(strcmp(delone_kind(near), "lists") == 0);
  offsets = get_array(near, "offsets");
  items = get_array(near, "cells");
  CHECK(offsets.shape[0] == q + 1 && offsets.type == DELONE_INT64 && items.type == DELONE_INT64);
  for (i = 0; i < q; ++i) {
    int found = cells[i] < 0;
    for (j = (size_t)entry(&offsets, i); j < (size_t)entry(&offsets, i + 1); ++j)
      found |= entry(&items, j) == (double)cells[i];
    CHECK(found);
  }
  delone_free(near);
  OK(delone_natural_neighbors(t, queries, q, NULL, &neighbors));
  offsets = get_array(neighbors, "offsets");
  rows = get_array(neighbors, "rows");
  weights = get_array(neighbors, "weights");
  CHECK(rows.shape[0] == weights.shape[0] && weights.type == DELONE_FLOAT64);
  for (i = 0; i < q; ++i) {
    CHECK((entry(&offsets, i) == entry(&offsets, i + 1)) == (cells[i] < 0));
    if (cells[i] < 0) continue;
    for (axis = 0; axis < 3; ++axis) {
      double sum = 0;
      for (j = (size_t)entry(&offsets, i); j < (size_t)entry(&offsets, i + 1); ++j)
        sum += entry(&weights, j) * points[3 * (size_t)entry(&rows, j) + axis];
      CHECK(fabs(sum - queries[3 * i + axis]) < 1e-9);
    }
  }
  delone_free(neighbors);
}

static void hull_and_predicates(void) {
  const double queries[10] = {0.5, 0.5, 1, 1, 0.5, 0, 2, 2, 1, 0.25}, inner[2] = {0.5, 0.5},
               corner[2] = {0, 1}, outer[2] = {1.5, 1};
  delone_object* hull;
  int64_t cells[5];
  uint8_t kinds[5];
  double unwanted[5];
  int sign;
  OK(delone_convex_hull(square, 5, 2, NULL, &hull));
  OK(delone_locate(hull, queries, 5, NULL, cells, kinds, NULL, NULL));
  CHECK(kinds[0] == DELONE_INSIDE && kinds[1] == DELONE_ON_VERTEX && kinds[2] == DELONE_ON_FACE);
  CHECK(kinds[3] == DELONE_OUTSIDE_HULL && kinds[4] == DELONE_ON_FACE && cells[3] >= 0);
  FAILS(DELONE_INVALID_ARGUMENT, delone_locate(hull, queries, 5, NULL, cells, kinds, unwanted, NULL));
  delone_free(hull);
  OK(delone_orientation(square, 2, &sign));
  CHECK(sign == 1);
  OK(delone_in_sphere(square, inner, 2, &sign));
  CHECK(sign == 1);
  OK(delone_in_sphere(square, corner, 2, &sign));
  CHECK(sign == 0);
  OK(delone_in_sphere(square, outer, 2, &sign));
  CHECK(sign == -1);
  FAILS(DELONE_BAD_DIMENSION, delone_orientation(square, 0, &sign));
  FAILS(DELONE_INVALID_ARGUMENT, delone_orientation(square, 2, NULL));
}

/* Cells that were given overlap, leave gaps, and may be flat. */
static void given_cells(const delone_object* t, const double* points, const double* queries) {
  static int64_t cells[q], found[q];
  static double barycentric[q * 4];
  const double corners[10] = {0, 0, 4, 0, 0, 4, 4, 4, 2, 0}, at[6] = {1, 1, 3, 3.5, 5, 5};
  const int64_t three[9] = {0, 1, 2, 2, 1, 0, 0, 1, 4}, line[2] = {0, 1};
  const delone_array all = get_array(t, "cells");
  int64_t* const ids = malloc(4 * all.shape[0] * sizeof(int64_t));
  delone_options* options;
  delone_object *given, *near;
  delone_array items;
  uint8_t kinds[3];
  size_t i;
  for (i = 0; i < 4 * all.shape[0]; ++i) ids[i] = (int64_t)entry(&all, i);
  OK(delone_triangulation_of_cells(points, NULL, n, 3, ids, all.shape[0], 3, &given));
  OK(delone_locate(t, queries, q, NULL, cells, NULL, NULL, NULL));
  OK(delone_locate(given, queries, q, NULL, found, NULL, barycentric, NULL));
  CHECK(memcmp(cells, found, sizeof cells) == 0);
  for (i = 0; i < q; ++i) CHECK((cells[i] < 0) == (isnan(barycentric[4 * i]) != 0));
  delone_free(given);
  OK(delone_triangulation_of_cells(corners, NULL, 5, 2, three, 3, 2, &given));
  OK(delone_locate(given, at, 3, NULL, found, kinds, NULL, NULL));
  CHECK(found[0] == 0 && found[1] == -1 && kinds[0] == DELONE_INSIDE && kinds[1] == DELONE_OUTSIDE_HULL);
  OK(delone_cells_within(given, at, 3, 0, NULL, &near));
  items = get_array(near, "cells");
  CHECK(items.shape[0] == 2 && entry(&items, 0) == 0 && entry(&items, 1) == 1);
  delone_free(near);
  OK(delone_cells_within(given, at, 3, 2, NULL, &near));
  CHECK(get_array(near, "cells").shape[0] == 4);
  delone_free(near);
  OK(delone_options_new(&options));
  OK(delone_set_real(options, "tolerance", 1));
  FAILS(DELONE_UNSUPPORTED, delone_locate(given, at, 3, options, found, NULL, NULL, NULL));
  delone_free(given);
  OK(delone_triangulation_of_cells(corners, NULL, 5, 2, line, 1, 1, &given));
  FAILS(DELONE_UNSUPPORTED, delone_locate(given, at, 3, NULL, found, NULL, NULL, NULL));
  delone_free(given);
  delone_options_free(options);
  free(ids);
}

void queries_test(void) {
  double* const points = random_points(n + q, 3);
  const double* const queries = points + 3 * n;
  delone_options* options;
  delone_object* t;
  OK(delone_options_new(&options));
  OK(delone_delaunay(points, n, 3, NULL, &t));
  locate_and_barycentric(t, points, queries);
  nearest(t, points, queries);
  lists(t, points, queries);
  given_cells(t, points, queries);
  interpolate(t, points, queries, options);
  hull_and_predicates();
  delone_free(t);
  delone_options_free(options);
  free(points);
}
