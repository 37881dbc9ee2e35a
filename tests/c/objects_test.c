/* SPDX-License-Identifier: BSD-3-Clause */
/* Triangulations and their members. */
#include "c_test.h"

#include <math.h>

static void the_square(void) {
  delone_object* t;
  delone_array cells, neighbors, edges, facets, vertices, centers, radii;
  size_t i;
  int outer = 0;
  OK(delone_delaunay(square, 5, 2, NULL, &t));
  CHECK(strcmp(delone_kind(t), "delaunay") == 0);
  CHECK(get_integer(t, "dimension") == 2 && get_integer(t, "affine_dimension") == 2);
  CHECK(get_integer(t, "num_points") == 5 && get_integer(t, "num_vertices") == 4);
  CHECK(get_integer(t, "num_duplicates") == 1 && get_integer(t, "num_hidden") == 0);
  CHECK(get_integer(t, "num_cells") == 2 && get_integer(t, "num_infinite_cells") == 4);
  cells = get_array(t, "cells");
  CHECK(cells.rank == 2 && cells.shape[0] == 2 && cells.shape[1] == 3);
  CHECK(cells.type == (delone_index_bytes() == 4 ? DELONE_INT32 : DELONE_INT64));
  neighbors = get_array(t, "neighbors");
  for (i = 0; i < 6; ++i) outer += entry(&neighbors, i) == -1;
  CHECK(outer == 4);
  edges = get_array(t, "edges");
  CHECK(edges.shape[0] == 5 && edges.shape[1] == 2);
  facets = get_array(t, "hull_facets");
  CHECK(facets.shape[0] == 4 && facets.shape[1] == 2);
  centers = get_array(t, "circumcenters");
  CHECK(centers.shape[0] == 2 && centers.shape[1] == 2 && ((const double*)centers.data)[0] == 0.5);
  radii = get_array(t, "circumradii");
  CHECK(radii.rank == 1 && radii.shape[0] == 2 && fabs(((const double*)radii.data)[1] - sqrt(0.5)) < 1e-15);
  vertices = get_array(t, "vertex_of_point");
  CHECK(vertices.rank == 1 && vertices.shape[0] == 5 && vertices.shape[1] == 1);
  CHECK(entry(&vertices, 3) == 3 && entry(&vertices, 4) == 0);
  delone_free(t);
}

static void no_points_and_flat_points(void) {
  const double line[6] = {0, 0, 1, 1, 2, 2};
  delone_object* t;
  delone_array cells, axes;
  OK(delone_delaunay(NULL, 0, 3, NULL, &t));
  CHECK(get_integer(t, "affine_dimension") == -1);
  cells = get_array(t, "cells");
  CHECK(cells.data == NULL && cells.shape[0] == 0);
  delone_free(t);
  OK(delone_delaunay(line, 3, 2, NULL, &t));
  CHECK(get_integer(t, "affine_dimension") == 1 && get_integer(t, "num_cells") == 2);
  axes = get_array(t, "axes");
  CHECK(axes.type == DELONE_INT32 && axes.shape[0] == 1 && entry(&axes, 0) == 0);
  delone_free(t);
}

/* The result depends neither on the path nor on the number of threads, and the order of cells does not on the
 * latter. */
static void the_same_by_every_path(void) {
  const size_t n = 3000;
  double* const points = random_points(n, 3);
  delone_object *once, *twice, *threads, *copy;
  delone_options* options;
  delone_array a, b;
  OK(delone_delaunay(points, n, 3, NULL, &once));
  OK(delone_delaunay(points, n / 2, 3, NULL, &twice));
  CHECK(strcmp(get_text(once, "hash"), get_text(twice, "hash")) != 0);
  OK(delone_clone(twice, &copy));
  OK(delone_insert(twice, points + n / 2 * 3, n / 2 - 1, NULL));
  OK(delone_insert(twice, points + (n - 1) * 3, 1, NULL));
  CHECK(get_integer(twice, "num_points") == (int64_t)n);
  CHECK(get_integer(copy, "num_points") == (int64_t)n / 2);
  CHECK(strcmp(get_text(once, "hash"), get_text(twice, "hash")) == 0);
  OK(delone_options_new(&options));
  OK(delone_set_integer(options, "threads", 3));
  OK(delone_set_text(options, "order", "shuffled"));
  OK(delone_set_integer(options, "seed", -1));
  delone_free(copy);
  OK(delone_delaunay(points, n, 3, options, &copy));
  OK(delone_set_integer(options, "threads", 2));
  OK(delone_delaunay(points, n, 3, options, &threads));
  CHECK(strcmp(get_text(once, "hash"), get_text(threads, "hash")) == 0);
  a = get_array(copy, "cells");
  b = get_array(threads, "cells");
  CHECK(a.shape[0] == b.shape[0]);
  CHECK(memcmp(a.data, b.data, a.shape[0] * 4 * (size_t)delone_index_bytes()) == 0);
  a = get_array(threads, "points");
  CHECK(a.shape[0] == n && a.shape[1] == 3 && memcmp(a.data, points, n * 3 * sizeof(double)) == 0);
  delone_options_free(options);
  delone_free(once);
  delone_free(twice);
  delone_free(threads);
  delone_free(copy);
  free(points);
}

static void regular_and_furthest_site(void) {
  const double points[10] = {0, 0, 4, 0, 4, 4, 0, 4, 2, 2}, weights[5] = {0, 0, 0, 0, -100},
               center[2] = {2, 2}, one = 1;
  delone_object* t;
  delone_array array;
  OK(delone_regular(points, weights, 5, 2, NULL, &t));
  CHECK(strcmp(delone_kind(t), "regular") == 0 && get_integer(t, "num_hidden") == 1);
  array = get_array(t, "weights");
  CHECK(array.shape[0] == 5 && entry(&array, 4) == -100);
  array = get_array(t, "vertex_of_point");
  CHECK(entry(&array, 4) == -1);
  OK(delone_insert(t, center, 1, &one));
  CHECK(get_integer(t, "num_vertices") == 5);
  delone_free(t);
  OK(delone_furthest_site(points, 5, 2, NULL, &t));
  CHECK(strcmp(delone_kind(t), "furthest_site") == 0);
  CHECK(get_integer(t, "num_vertices") == 4 && get_integer(t, "num_hidden") == 1);
  delone_free(t);
}

/* delone_member() lists all members, with types under which they can be got. */
static void members_are_listed(void) {
  delone_object* t;
  const char* name;
  size_t i;
  int type, arrays = 0;
  OK(delone_delaunay(square, 4, 2, NULL, &t));
  for (i = 0; (name = delone_member(t, i, &type)) != NULL; ++i) {
    int64_t integer;
    delone_array array;
    const char* text;
    if (type == DELONE_ARRAY) {
      ++arrays;
      OK(delone_get_array(t, name, &array));
      FAILS(DELONE_INVALID_ARGUMENT, delone_get_integer(t, name, &integer));
    } else if (type == DELONE_INTEGER) {
      OK(delone_get_integer(t, name, &integer));
      FAILS(DELONE_INVALID_ARGUMENT, delone_get_text(t, name, &text));
    } else {
      OK(delone_get_text(t, name, &text));
    }
  }
  CHECK(arrays == 10 && i == 21);
  CHECK(delone_member(t, i, NULL) == NULL && delone_member(NULL, 0, NULL) == NULL);
  delone_free(t);
}

/* The rows of an insertion may be an array of the object itself. */
static void rows_of_the_same_object(void) {
  const size_t n = 1000;
  double* const points = random_points(n, 3);
  const double* const weights = points; /* any numbers */
  delone_object* made[4];
  delone_array rows, own_weights;
  int i;
  OK(delone_delaunay(points, n, 3, NULL, &made[0]));
  OK(delone_regular(points, weights, n, 3, NULL, &made[1]));
  OK(delone_convex_hull(points, n, 3, NULL, &made[2]));
  OK(delone_halfspace_intersection(square_halfspaces, 4, 2, NULL, NULL, &made[3]));
  for (i = 0; i < 4; ++i) {
    const char* const name = i == 3 ? "halfspaces" : "points";
    const char* const number = i == 3 ? "num_halfspaces" : "num_points";
    const int64_t before = get_integer(made[i], number);
    char hash[64] = "";
    if (i < 3) strcpy(hash, get_text(made[i], "hash"));
    rows = get_array(made[i], name);
    if (i == 1) own_weights = get_array(made[i], "weights");
    OK(delone_insert(made[i], rows.data, rows.shape[0], i == 1 ? own_weights.data : NULL));
    CHECK(get_integer(made[i], number) == 2 * before);
    if (i < 3) CHECK(strcmp(get_text(made[i], "hash"), hash) == 0);
    if (i == 0 || i == 2) CHECK(get_integer(made[i], "num_duplicates") == before);
    delone_free(made[i]);
  }
  free(points);
}

static void slivers_are_trimmed(void) {
  const double points[10] = {0, 0, 1, 1e-9, 2, 0, 2, 1, 0, 1};
  delone_object *t, *rest, *again;
  delone_array kept;
  OK(delone_delaunay(points, 5, 2, NULL, &t));
  OK(delone_trim(t, 1e-6, &rest));
  CHECK(strcmp(delone_kind(rest), "triangulation") == 0);
  kept = get_array(rest, "kept");
  CHECK(kept.type == DELONE_UINT8 && (int64_t)kept.shape[0] == get_integer(t, "num_cells"));
  CHECK(get_integer(rest, "num_cells") == get_integer(t, "num_cells") - 1);
  CHECK(get_real(rest, "depth") <= 1e-6);
  FAILS(DELONE_INVALID_ARGUMENT, delone_trim(rest, 1e-6, &again));
  CHECK(again == NULL);
  delone_free(t);
  delone_free(rest);
}

static void rows_are_removed_and_moved(void) {
  const double to[2] = {0.5, 0.25}, weight = 0.25, weights[5] = {0, 0, 0, 0, 0};
  const int64_t rows[1] = {1}, twice[2] = {2, 2}, beyond[1] = {5}, negative[1] = {-1};
  delone_object *t, *r, *hull;
  delone_array points;
  char hash[33];
  OK(delone_delaunay(square, 5, 2, NULL, &t));
  strcpy(hash, get_text(t, "hash"));
  FAILS(DELONE_INVALID_ARGUMENT, delone_remove(t, twice, 2));
  FAILS(DELONE_INVALID_ARGUMENT, delone_remove(t, beyond, 1));
  FAILS(DELONE_INVALID_ARGUMENT, delone_remove(t, negative, 1));
  FAILS(DELONE_INVALID_ARGUMENT, delone_move(t, rows, 1, to, &weight));
  FAILS(DELONE_INVALID_ARGUMENT, delone_move(t, rows, 1, NULL, &weight));
  CHECK(strcmp(hash, get_text(t, "hash")) == 0);
  OK(delone_move(t, rows, 1, to, NULL));
  points = get_array(t, "points");
  CHECK(entry(&points, 2) == 0.5 && entry(&points, 3) == 0.25);
  CHECK(strcmp(hash, get_text(t, "hash")) != 0);
  OK(delone_move(t, rows, 1, square + 2, NULL));
  CHECK(strcmp(hash, get_text(t, "hash")) == 0);
  OK(delone_remove(t, rows, 1));
  CHECK(get_integer(t, "num_points") == 4 && get_integer(t, "num_rows") == 5 &&
        get_integer(t, "num_cells") == 1);
  points = get_array(t, "points");
  CHECK(points.shape[0] == 5 && entry(&points, 2) != entry(&points, 2));
  FAILS(DELONE_INVALID_ARGUMENT, delone_remove(t, rows, 1));
  OK(delone_regular(square, weights, 5, 2, NULL, &r));
  OK(delone_move(r, rows, 1, to, &weight));
  OK(delone_move(r, rows, 1, NULL, &weight));
  points = get_array(r, "weights");
  CHECK(entry(&points, 1) == 0.25);
  OK(delone_convex_hull(square, 5, 2, NULL, &hull));
  FAILS(DELONE_INVALID_ARGUMENT, delone_remove(hull, rows, 1));
  FAILS(DELONE_INVALID_ARGUMENT, delone_remove(NULL, rows, 1));
  OK(delone_remove(t, NULL, 0));
  delone_free(t);
  delone_free(r);
  delone_free(hull);
}

static void alpha_complexes(void) {
  /* A long triangle beside a square. */
  const double points[10] = {0, 0, 1, 0, 1, 1, 0, 1, 9, 0.5};
  delone_object *t, *alpha, *none;
  delone_array array;
  OK(delone_delaunay(points, 5, 2, NULL, &t));
  CHECK(get_integer(t, "num_cells") == 3);
  OK(delone_alpha_complex(t, 1, NULL, &alpha));
  CHECK(strcmp(delone_kind(alpha), "triangulation") == 0 &&
        strcmp(get_text(alpha, "kind"), "alpha_complex") == 0);
  CHECK(get_integer(alpha, "num_cells") == 2 && get_array(alpha, "cell_numbers").shape[0] == 2);
  array = get_array(alpha, "boundary");
  CHECK(array.shape[0] == 4 && array.shape[1] == 2 && get_array(alpha, "boundary_cells").shape[0] == 4);
  CHECK(get_array(alpha, "singular_facets").shape[0] == 0);
  OK(delone_alpha_complex(t, 0.5, NULL, &none));
  array = get_array(none, "singular_facets");
  CHECK(get_integer(none, "num_cells") == 0 && array.shape[0] == 4);
  delone_free(none);
  FAILS(DELONE_INVALID_ARGUMENT, delone_alpha_complex(t, -1, NULL, &none));
  FAILS(DELONE_INVALID_ARGUMENT, delone_alpha_complex(alpha, 1, NULL, &none));
  delone_free(t);
  delone_free(alpha);
}

void objects_test(void) {
  the_square();
  no_points_and_flat_points();
  the_same_by_every_path();
  regular_and_furthest_site();
  members_are_listed();
  rows_of_the_same_object();
  slivers_are_trimmed();
  rows_are_removed_and_moved();
  alpha_complexes();
}
