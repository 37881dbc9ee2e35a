/* SPDX-License-Identifier: BSD-3-Clause */
/* Periodic triangulations: members, cells of sites, queries, files and errors. */
#include "c_test.h"

static void test_one_point(void) {
  const double point[3] = {0.25, 0.25, 0.25}, lattice[9] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  const double queries[6] = {1.25, -2.75, 0.25, 0.5, 0.25, 0.25};
  delone_object *t, *cells;
  delone_array array;
  int64_t rows[2], in_cells[2];
  int32_t offsets[6];
  uint8_t kinds[2];
  double distances[2], barycentric[8], sum = 0;
  size_t i;
  OK(delone_periodic_delaunay(point, 1, 3, lattice, 3, NULL, &t));
  CHECK(strcmp(delone_kind(t), "periodic_delaunay") == 0 && strlen(get_text(t, "hash")) == 32);
  CHECK(get_integer(t, "rank") == 3 && get_integer(t, "num_cells") == 6 &&
        get_integer(t, "is_simplicial") == 0);
  CHECK(get_real(t, "displacement") == 0);
  array = get_array(t, "cell_offsets");
  CHECK(array.type == DELONE_INT32 && array.shape[0] == 24 && array.shape[1] == 3);
  array = get_array(t, "neighbor_offsets");
  CHECK(array.shape[0] == 24 && array.shape[1] == 3);
  array = get_array(t, "neighbors");
  CHECK(array.shape[0] == 6 && array.shape[1] == 4);
  array = get_array(t, "lattice");
  CHECK(array.shape[0] == 3 && entry(&array, 4) == 1);
  OK(delone_site_cells(t, NULL, NULL, NULL, 0, NULL, &cells));
  array = get_array(cells, "volumes");
  CHECK(array.shape[0] == 1 && entry(&array, 0) > 0.999999 && entry(&array, 0) < 1.000001);
  array = get_array(cells, "neighbor_lattice");
  CHECK(array.type == DELONE_INT32 && array.shape[1] == 3);
  delone_free(cells);
  OK(delone_periodic_nearest(t, queries, 2, NULL, rows, offsets, distances));
  CHECK(rows[0] == 0 && offsets[0] == 1 && offsets[1] == -3 && offsets[2] == 0 && distances[0] == 0);
  CHECK(rows[1] == 0 && offsets[3] == 0 && distances[1] == 0.25);
  OK(delone_periodic_locate(t, queries, 2, NULL, in_cells, offsets, kinds, barycentric));
  CHECK(kinds[0] == DELONE_ON_VERTEX && kinds[1] == DELONE_ON_FACE && in_cells[0] >= 0 && in_cells[1] >= 0);
  for (i = 0; i < 4; ++i) sum += barycentric[i];
  CHECK(sum == 1);
  OK(delone_periodic_locate(t, queries, 2, NULL, NULL, NULL, kinds, NULL));
  FAILS(DELONE_INVALID_ARGUMENT, delone_locate(t, queries, 2, NULL, in_cells, NULL, NULL, NULL));
  FAILS(DELONE_UNSUPPORTED, delone_insert(t, queries, 2, NULL));
  delone_free(t);
}

static void test_changed_neighbors(void) {
  static const double before[2] = {0, 0.5}, after[2] = {0, 0.25}, lattice[1] = {1};
  static const double corners[8] = {0, 0, 4, 0, 4, 4, 0, 5}, to[2] = {0, 2}, in_row[3] = {0, 1, 2};
  const int64_t last = 3;
  delone_object *t, *u, *changes;
  delone_array array;
  OK(delone_periodic_delaunay(before, 2, 1, lattice, 1, NULL, &t));
  OK(delone_periodic_delaunay(after, 2, 1, lattice, 1, NULL, &u));
  OK(delone_changed_neighbors(t, u, NULL, &changes));
  CHECK(strcmp(delone_kind(changes), "neighbor_changes") == 0 && get_integer(changes, "rank") == 1);
  array = get_array(changes, "began_offsets");
  CHECK(array.shape[0] == 0 && array.shape[1] == 1);
  delone_free(changes);
  delone_free(u);
  OK(delone_periodic_delaunay(before, 1, 1, lattice, 1, NULL, &u));
  FAILS(DELONE_BAD_DIMENSION, delone_changed_neighbors(t, u, NULL, &changes));
  delone_free(u);
  OK(delone_delaunay(corners, 4, 2, NULL, &u));
  FAILS(DELONE_INVALID_ARGUMENT, delone_changed_neighbors(t, u, NULL, &changes));
  delone_free(t);
  OK(delone_clone(u, &t));
  OK(delone_move(t, &last, 1, to, NULL));
  OK(delone_changed_neighbors(u, t, NULL, &changes));
  CHECK(get_integer(changes, "rank") == 0);
  array = get_array(changes, "ended");
  CHECK(array.type == DELONE_INT32 && array.shape[0] == 1 && array.shape[1] == 2);
  CHECK(entry(&array, 0) == 0 && entry(&array, 1) == 2);
  array = get_array(changes, "began");
  CHECK(array.shape[0] == 1 && entry(&array, 0) == 1 && entry(&array, 1) == 3);
  delone_free(changes);
  delone_free(t);
  delone_free(u);
  OK(delone_delaunay(in_row, 3, 1, NULL, &t));
  OK(delone_changed_neighbors(t, t, NULL, &changes));
  array = get_array(changes, "began");
  CHECK(array.shape[0] == 0);
  delone_free(changes);
  delone_free(t);
}

static void test_slab_with_weights(void) {
  const double lattice[6] = {1, 0, 0, 0, 1, 0}, far_away[3] = {0.5, 0.5, 9}, outside[2] = {9, 0.5};
  double weights[50];
  double* const points = random_points(50, 3);
  delone_object *t, *report;
  delone_options* options;
  int64_t cell, row;
  int32_t offset[2];
  double power;
  size_t i;
  for (i = 0; i < 50; ++i) weights[i] = 0.0625 * (double)(i % 2);
  OK(delone_options_new(&options));
  OK(delone_set_integer(options, "threads", 2));
  OK(delone_periodic_regular(points, weights, 50, 3, lattice, 2, options, &t));
  CHECK(strcmp(get_text(t, "kind"), "periodic_regular") == 0 && get_integer(t, "rank") == 2);
  CHECK(get_integer(t, "num_vertices") + get_integer(t, "num_hidden") == 50);
  OK(delone_check(t, NULL, &report));
  CHECK(get_integer(report, "ok") == 1);
  delone_free(report);
  OK(delone_periodic_locate(t, far_away, 1, options, &cell, offset, NULL, NULL));
  CHECK(cell == -1 && offset[0] == 0);
  OK(delone_periodic_nearest(t, far_away, 1, options, &row, offset, &power));
  CHECK(row >= 0 && power > 60);
  FAILS(DELONE_CANNOT_WRITE, delone_write(t, "/no/such/folder/t.npz", ""));
  delone_free(t);
  OK(delone_set_integer(options, "exact", 1));
  FAILS(DELONE_INVALID_ARGUMENT, delone_periodic_delaunay(points, 50, 3, lattice, 2, options, &t));
  OK(delone_set_integer(options, "exact", 0));
  OK(delone_set_integer(options, "wrap", 0));
  FAILS(DELONE_INVALID_ARGUMENT, delone_periodic_delaunay(outside, 1, 2, lattice, 1, options, &t));
  OK(delone_set_integer(options, "wrap", 1));
  OK(delone_set_real(options, "unit", 0.5));
  OK(delone_periodic_delaunay(far_away, 1, 3, lattice, 2, options, &t));
  delone_free(t);
  delone_options_free(options);
  free(points);
}

static void test_steps(void) {
  const double lattice[4] = {1, 0, 0, 1}, wider[4] = {1.0625, 0, 0, 1};
  double weights[200];
  double* const points = random_points(200, 2);
  delone_object *t, *next, *fresh, *power;
  delone_array array;
  size_t i;
  OK(delone_periodic_delaunay(points, 200, 2, lattice, 2, NULL, &t));
  for (i = 0; i < 400; ++i) points[i] += 1e-5 * (double)(i % 3);
  OK(delone_periodic_moved(t, points, 200, NULL, NULL, &next));
  OK(delone_periodic_delaunay(points, 200, 2, lattice, 2, NULL, &fresh));
  CHECK(strcmp(get_text(next, "hash"), get_text(fresh, "hash")) == 0);
  CHECK(strcmp(get_text(next, "hash"), get_text(t, "hash")) != 0);
  delone_free(next);
  delone_free(fresh);
  OK(delone_periodic_moved(t, points, 200, NULL, wider, &next));
  array = get_array(next, "lattice");
  CHECK(entry(&array, 0) == 1.0625);
  delone_free(next);
  for (i = 0; i < 200; ++i) weights[i] = 1e-4 * (double)(i % 5);
  OK(delone_periodic_regular(points, weights, 200, 2, lattice, 2, NULL, &power));
  OK(delone_periodic_moved(power, points, 200, NULL, NULL, &next));
  CHECK(strcmp(get_text(next, "hash"), get_text(power, "hash")) == 0);
  delone_free(next);
  weights[7] = 0.25;
  OK(delone_periodic_moved(power, points, 200, weights, NULL, &next));
  CHECK(get_integer(next, "num_hidden") > get_integer(power, "num_hidden"));
  delone_free(next);
  FAILS(DELONE_BAD_DIMENSION, delone_periodic_moved(t, points, 199, NULL, NULL, &next));
  FAILS(DELONE_INVALID_ARGUMENT, delone_periodic_moved(t, points, 200, weights, NULL, &next));
  delone_free(power);
  delone_free(t);
  free(points);
}

static void test_errors(void) {
  const double singular[4] = {1, 1, 2, 2}, good[4] = {1, 0, 0, 1};
  delone_object *t, *open;
  double distance;
  FAILS(DELONE_INVALID_ARGUMENT, delone_periodic_delaunay(square, 4, 2, singular, 2, NULL, &t));
  CHECK(t == NULL);
  FAILS(DELONE_INVALID_ARGUMENT, delone_periodic_delaunay(square, 4, 2, NULL, 2, NULL, &t));
  FAILS(DELONE_BAD_DIMENSION, delone_periodic_delaunay(square, 4, 0, good, 2, NULL, &t));
  FAILS(DELONE_INVALID_ARGUMENT, delone_periodic_regular(square, NULL, 4, 2, good, 2, NULL, &t));
  OK(delone_delaunay(square, 4, 2, NULL, &open));
  FAILS(DELONE_INVALID_ARGUMENT, delone_periodic_nearest(open, square, 1, NULL, NULL, NULL, &distance));
  delone_free(open);
  /* Translates of one point are one vertex. */
  OK(delone_periodic_delaunay(square, 5, 2, good, 2, NULL, &t));
  CHECK(get_integer(t, "num_vertices") == 1 && get_integer(t, "num_duplicates") == 4);
  delone_free(t);
}

void periodic_test(void) {
  test_one_point();
  test_changed_neighbors();
  test_slab_with_weights();
  test_steps();
  test_errors();
}
