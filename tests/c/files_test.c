/* SPDX-License-Identifier: BSD-3-Clause */
/* Checks, files and tiles. Files are made in the working directory. */
#include "c_test.h"

static int is_right(const delone_object* object, const delone_options* options) {
  delone_object* report;
  int ok;
  OK(delone_check(object, options, &report));
  ok = (int)get_integer(report, "ok");
  CHECK(strcmp(delone_kind(report), "report") == 0 && ok == (*get_text(report, "violation") == '\0'));
  delone_free(report);
  return ok;
}

/* Writes an object and reads it as one of that kind, which is right, too. */
static void written_and_read(delone_object* object, const char* path, const char* kind) {
  delone_options* options;
  delone_object* read;
  OK(delone_options_new(&options));
  OK(delone_set_integer(options, "canonical", 1)); /* no option of other objects: ignored */
  CHECK(is_right(object, options));
  delone_options_free(options);
  OK(delone_write(object, path, NULL));
  delone_free(object);
  OK(delone_read(path, NULL, &read));
  CHECK(strcmp(delone_kind(read), kind) == 0);
  CHECK(get_array(read, "vertices").data != NULL);
  CHECK(is_right(read, NULL));
  OK(delone_write(read, path, "json"));
  FAILS(DELONE_UNSUPPORTED, delone_insert(read, square, 1, NULL));
  FAILS(DELONE_UNSUPPORTED, delone_clone(read, &object));
  delone_free(read);
  remove(path);
}

static void products(void) {
  delone_object *object, *t;
  OK(delone_convex_hull(square, 5, 2, NULL, &object));
  written_and_read(object, "c_hull.npz", "hull");
  OK(delone_halfspace_intersection(square_halfspaces, 4, 2, NULL, NULL, &object));
  written_and_read(object, "c_intersection.npz", "intersection");
  OK(delone_delaunay(square, 5, 2, NULL, &t));
  OK(delone_voronoi(t, NULL, &object));
  delone_free(t);
  written_and_read(object, "c_diagram.npz", "diagram");
}

static void protein(void) {
  const char* const path = DELONE_DATA_DIR "/protein.csv";
  const char* const hash = "82ae14d34ec54cdd891d69164468fb29";
  delone_options* options;
  delone_object *points, *t, *read;
  delone_array array;
  OK(delone_options_new(&options));
  OK(delone_read_points(path, NULL, &points));
  array = get_array(points, "points");
  CHECK(array.shape[0] == 1516 && array.shape[1] == 3 && get_integer(points, "num_points") == 1516);
  OK(delone_delaunay(array.data, array.shape[0], 3, NULL, &t));
  CHECK(strcmp(get_text(t, "hash"), hash) == 0);
  OK(delone_write(t, "c_protein.npz", NULL));
  OK(delone_read("c_protein.npz", NULL, &read));
  CHECK(strcmp(delone_kind(read), "triangulation") == 0 && strcmp(get_text(read, "hash"), hash) == 0);
  CHECK(get_integer(read, "num_cells") == 9751 && is_right(read, NULL));
  OK(delone_write_points(array.data, array.shape[0], 3, "c_points.npy", NULL));
  delone_free(points);
  delone_free(read);
  delone_free(t);
  OK(delone_read_points("c_points.npy", NULL, &points));
  CHECK(get_integer(points, "num_points") == 1516);
  delone_free(points);
  OK(delone_set_text(options, "columns", "0"));
  OK(delone_set_text(options, "columns", NULL));
  OK(delone_set_text(options, "columns", "z"));
  OK(delone_set_text(options, "columns", "x"));
  OK(delone_read_points(path, options, &points));
  CHECK(get_integer(points, "dimension") == 2);
  delone_free(points);
  delone_options_free(options);
  remove("c_protein.npz");
  remove("c_points.npy");
}

static void missing_values(void) {
  delone_options* options;
  delone_object* points;
  delone_array array;
  FILE* const file = fopen("c_gaps.csv", "w");
  CHECK(file != NULL && fputs("x,y\n0,1\n2,NA\n4,5\n", file) >= 0 && fclose(file) == 0);
  FAILS(DELONE_BAD_FORMAT, delone_read_points("c_gaps.csv", NULL, &points));
  OK(delone_options_new(&options));
  OK(delone_set_integer(options, "skip_missing", 1));
  OK(delone_read_points("c_gaps.csv", options, &points));
  array = get_array(points, "points");
  CHECK(array.shape[0] == 2 && ((const double*)array.data)[3] == 5);
  array = get_array(points, "skipped_rows");
  CHECK(array.shape[0] == 1 && ((const int64_t*)array.data)[0] == 1);
  delone_free(points);
  delone_options_free(options);
  remove("c_gaps.csv");
}

static void cells_from_elsewhere(void) {
  const int64_t right[6] = {0, 1, 2, 0, 2, 3}, wrong[6] = {0, 1, 2, 0, 1, 3}, out_of_range[3] = {0, 1, 7};
  delone_options* options;
  delone_object *t, *report;
  delone_array array;
  OK(delone_options_new(&options));
  OK(delone_triangulation_of_cells(square, NULL, 4, 2, right, 2, 2, &t));
  CHECK(is_right(t, NULL) && strlen(get_text(t, "hash")) == 32);
  delone_free(t);
  OK(delone_triangulation_of_cells(square, NULL, 4, 2, wrong, 2, 2, &t));
  OK(delone_check(t, NULL, &report));
  CHECK(get_integer(report, "ok") == 0 && *get_text(report, "violation") != '\0');
  array = get_array(report, "cells");
  CHECK(array.type == DELONE_INT64);
  delone_free(report);
  OK(delone_set_integer(options, "up_to", 1));
  CHECK(is_right(t, options));
  delone_free(t);
  FAILS(DELONE_INVALID_ARGUMENT, delone_triangulation_of_cells(square, NULL, 4, 2, out_of_range, 1, 2, &t));
  FAILS(DELONE_BAD_DIMENSION, delone_triangulation_of_cells(square, NULL, 4, 2, right, 1, 3, &t));
  OK(delone_furthest_site(square, 4, 2, NULL, &t));
  CHECK(is_right(t, NULL));
  delone_free(t);
  delone_options_free(options);
}

static void files_that_are_not_there(void) {
  delone_object* object = NULL;
  FAILS(DELONE_CANNOT_OPEN, delone_read("c_missing.npz", NULL, &object));
  CHECK(strstr(delone_error_message(), "c_missing.npz") != NULL);
  FAILS(DELONE_CANNOT_OPEN, delone_read_points("c_missing.csv", NULL, &object));
  FAILS(DELONE_UNSUPPORTED, delone_read(DELONE_DATA_DIR "/protein.csv", NULL, &object));
  OK(delone_delaunay(square, 4, 2, NULL, &object));
  FAILS(DELONE_CANNOT_WRITE, delone_write(object, "c_missing/t.npz", NULL));
  FAILS(DELONE_UNSUPPORTED, delone_write(object, "c_t.unknown", NULL));
  delone_free(object);
}

static void tiles(const char* folder) {
  double* const points = random_points(2000, 3);
  delone_options* options;
  delone_object *t, *made, *part, *report;
  delone_array array;
  int64_t i, cells = 0;
  OK(delone_options_new(&options));
  OK(delone_set_integer(options, "tiles", 3));
  OK(delone_set_integer(options, "resume", 0));
  OK(delone_delaunay(points, 2000, 3, NULL, &t));
  OK(delone_make_tiles_of_points(points, 2000, 3, folder, options, &made));
  CHECK(strcmp(get_text(made, "hash"), get_text(t, "hash")) == 0 && get_integer(made, "num_parts") == 3);
  delone_free(made);
  OK(delone_read_tiles(folder, &made));
  for (i = 0; i < 3; ++i) {
    OK(delone_read_tile(folder, (size_t)i, &part));
    cells += get_integer(part, "num_cells");
    array = get_array(part, "cells");
    CHECK(array.type == DELONE_INT32 && array.shape[1] == 4);
    delone_free(part);
  }
  CHECK(cells == get_integer(t, "num_cells") && cells == get_integer(made, "num_cells"));
  array = get_array(made, "first_cell");
  CHECK(array.shape[0] == 3 && entry(&array, 0) == 0);
  OK(delone_check_tiles(folder, points, 2000, 3, NULL, &report));
  CHECK(get_integer(report, "ok") == 1);
  delone_free(report);
  FAILS(DELONE_CANNOT_OPEN, delone_read_tiles("c_missing", &report));
  delone_free(made);
  delone_free(t);
  delone_options_free(options);
  free(points);
}

/* A set that is periodic along two of three axes, of points in memory and of a file; with weights. */
static void periodic_tiles(const char* folder) {
  double* const points = random_points(600, 3);
  double* const rows = malloc(600 * 4 * sizeof(double));
  double weights[600];
  const double lattice[6] = {1, 0, 0, 0, 1, 0};
  delone_options* options;
  delone_object *t, *made, *report;
  delone_array array;
  size_t i;
  for (i = 0; i < 600; ++i) {
    memcpy(rows + 4 * i, points + 3 * i, 3 * sizeof(double));
    rows[4 * i + 3] = weights[i] = (double)(i % 7) / 1000;
  }
  OK(delone_options_new(&options));
  OK(delone_set_integer(options, "tiles", 3));
  OK(delone_set_integer(options, "resume", 0));
  OK(delone_periodic_delaunay(points, 600, 3, lattice, 2, NULL, &t));
  OK(delone_make_periodic_tiles_of_points(points, 600, 3, lattice, 2, folder, options, &made));
  CHECK(strcmp(get_text(made, "hash"), get_text(t, "hash")) == 0 && get_integer(made, "num_parts") == 3);
  array = get_array(made, "lattice");
  CHECK(array.shape[0] == 2 && array.shape[1] == 3 && entry(&array, 4) == 1);
  delone_free(made);
  OK(delone_write_points(points, 600, 3, "c_tiles.npy", NULL));
  OK(delone_make_periodic_tiles("c_tiles.npy", lattice, 2, 3, folder, options, &made));
  CHECK(strcmp(get_text(made, "hash"), get_text(t, "hash")) == 0);
  delone_free(made);
  delone_free(t);
  OK(delone_check_tiles(folder, NULL, 0, 0, NULL, &report));
  CHECK(get_integer(report, "ok") == 1);
  delone_free(report);
  OK(delone_set_integer(options, "weighted", 1));
  OK(delone_periodic_regular(points, weights, 600, 3, lattice, 2, NULL, &t));
  OK(delone_make_periodic_tiles_of_points(rows, 600, 4, lattice, 2, folder, options, &made));
  CHECK(strcmp(get_text(made, "hash"), get_text(t, "hash")) == 0);
  delone_free(made);
  delone_free(t);
  FAILS(DELONE_BAD_DIMENSION,
        delone_make_periodic_tiles("c_tiles.npy", lattice, 2, 3, folder, options, &made));
  FAILS(DELONE_INVALID_ARGUMENT,
        delone_make_periodic_tiles_of_points(rows, 600, 4, NULL, 2, folder, options, &made));
  OK(delone_set_integer(options, "vtu", 1));
  FAILS(DELONE_UNSUPPORTED,
        delone_make_periodic_tiles_of_points(rows, 600, 4, lattice, 2, folder, options, &made));
  delone_options_free(options);
  free(rows);
  free(points);
}

void files_test(void) {
  products();
  protein();
  missing_values();
  cells_from_elsewhere();
  files_that_are_not_there();
  tiles("c_tiles");
  periodic_tiles("c_periodic_tiles");
}
