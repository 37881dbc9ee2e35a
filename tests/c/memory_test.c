/* SPDX-License-Identifier: BSD-3-Clause */
/* Every allocation fails once. The call says so, and what was there before stays as it was. */
#include "c_test.h"

void fail_allocations_after(long n);

static double* points;
static double values[30];
static delone_object* base;

static int make_delaunay(delone_object** object) { return delone_delaunay(points, 30, 2, NULL, object); }
static int make_regular(delone_object** object) {
  return delone_regular(points, values, 30, 2, NULL, object);
}
static int make_hull(delone_object** object) { return delone_convex_hull(points, 30, 3, NULL, object); }
static int make_envelope(delone_object** object) { return delone_lower_hull(points, 30, 3, NULL, object); }
static int make_intersection(delone_object** object) {
  return delone_halfspace_intersection(square_halfspaces, 4, 2, NULL, NULL, object);
}
static int make_diagram(delone_object** object) { return delone_voronoi(base, NULL, object); }
static int make_clone(delone_object** object) { return delone_clone(base, object); }
static int make_report(delone_object** object) { return delone_check(base, NULL, object); }
static int make_linear(delone_object** object) { return delone_linear_interpolator(base, values, 1, object); }
static int make_natural(delone_object** object) {
  return delone_natural_neighbor_interpolator(base, values, 1, 1, NULL, object);
}
static int make_neighbors(delone_object** object) {
  return delone_natural_neighbors(base, points, 30, NULL, object);
}
static int make_hulls(delone_object** object) {
  const size_t offsets[3] = {0, 15, 30};
  return delone_convex_hulls(points, 30, 3, offsets, 2, NULL, object);
}
static int make_alpha(delone_object** object) { return delone_alpha_complex(base, 0.3, NULL, object); }

/* Each member of an object, or the first failure. */
static int read_members(const delone_object* object) {
  const char* name;
  int type, status = DELONE_OK;
  size_t i;
  for (i = 0; status == DELONE_OK && (name = delone_member(object, i, &type)) != NULL; ++i) {
    delone_array array;
    int64_t integer;
    double real;
    const char* text;
    status = type == DELONE_ARRAY     ? delone_get_array(object, name, &array)
             : type == DELONE_INTEGER ? delone_get_integer(object, name, &integer)
             : type == DELONE_REAL    ? delone_get_real(object, name, &real)
                                      : delone_get_text(object, name, &text);
  }
  return status;
}

/* From one place of a failure to the next: in a small run not all are tried. */
static long step(void) { return is_small_run() ? 13 : 1; }

static void sweep(int (*make)(delone_object**)) {
  int status = DELONE_OUT_OF_MEMORY;
  long n;
  for (n = 0; status != DELONE_OK; n += step()) {
    delone_object* object = base;
    int status_of_members;
    fail_allocations_after(n);
    status = make(&object);
    fail_allocations_after(-1);
    if (status != DELONE_OK) {
      CHECK(status == DELONE_OUT_OF_MEMORY && object == NULL);
      CHECK(strstr(delone_error_message(), "memory") != NULL);
      continue;
    }
    fail_allocations_after(0);
    status_of_members = read_members(object);
    fail_allocations_after(-1);
    CHECK(status_of_members == DELONE_OK || status_of_members == DELONE_OUT_OF_MEMORY);
    OK(read_members(object));
    delone_free(object);
  }
  CHECK(n > 2);
}

static void insertions_change_nothing_when_they_fail(void) {
  const double more[6] = {0.25, 0.5, 0.5, 0.25, 2, 2};
  char hash[33];
  int status = DELONE_OUT_OF_MEMORY;
  long n;
  strcpy(hash, get_text(base, "hash"));
  for (n = 0; status != DELONE_OK; n += step()) {
    delone_object* object;
    OK(delone_clone(base, &object));
    fail_allocations_after(n);
    status = delone_insert(object, more, 3, NULL);
    fail_allocations_after(-1);
    CHECK(get_integer(object, "num_points") == (status == DELONE_OK ? 33 : 30));
    CHECK((strcmp(get_text(object, "hash"), hash) == 0) == (status != DELONE_OK));
    delone_free(object);
  }
}

static void removals_change_nothing_when_they_fail(void) {
  const int64_t rows[2] = {3, 7};
  char hash[33];
  int status = DELONE_OUT_OF_MEMORY;
  long n;
  strcpy(hash, get_text(base, "hash"));
  for (n = 0; status != DELONE_OK; n += step()) {
    delone_object* object;
    OK(delone_clone(base, &object));
    fail_allocations_after(n);
    status = delone_remove(object, rows, 2);
    fail_allocations_after(-1);
    CHECK(get_integer(object, "num_points") == (status == DELONE_OK ? 28 : 30));
    CHECK((strcmp(get_text(object, "hash"), hash) == 0) == (status != DELONE_OK));
    delone_free(object);
  }
}

static void volumes_need_memory(void) {
  const int64_t pair[2] = {0, 1};
  int status = DELONE_OUT_OF_MEMORY;
  double volume;
  delone_object* hulls;
  long n;
  OK(make_hulls(&hulls));
  for (n = 0; status != DELONE_OK; n += 5 * step()) {
    fail_allocations_after(n);
    status = delone_intersection_volumes(hulls, pair, 1, NULL, &volume);
    fail_allocations_after(-1);
    CHECK(status == DELONE_OK || status == DELONE_OUT_OF_MEMORY);
  }
  delone_free(hulls);
}

void memory_test(void) {
  int (*const makers[])(delone_object**) = {make_regular, make_hull,      make_envelope, make_intersection,
                                            make_diagram, make_clone,     make_report,   make_linear,
                                            make_natural, make_neighbors, make_hulls,    make_alpha};
  delone_options* options;
  size_t i;
  points = random_points(30, 3);
  sweep(make_delaunay);
  OK(make_delaunay(&base));
  for (i = 0; i < sizeof makers / sizeof *makers; ++i) sweep(makers[i]);
  insertions_change_nothing_when_they_fail();
  removals_change_nothing_when_they_fail();
  volumes_need_memory();
  fail_allocations_after(0);
  CHECK(delone_options_new(&options) == DELONE_OUT_OF_MEMORY);
  fail_allocations_after(-1);
  CHECK(options == NULL);
  delone_free(base);
  free(points);
}
