/* SPDX-License-Identifier: BSD-3-Clause */
/* Bad arguments, options, progress and cancellation. */
#include "c_test.h"

#include <math.h>

static void bad_arguments(void) {
  const double nan_point[4] = {0, 0, NAN, 1};
  const size_t* rows = NULL;
  delone_object *t, *other = NULL;
  delone_array array;
  int64_t integer, rows_found[4];
  CHECK(strcmp(delone_error_message(), "") == 0 && delone_error_rows(&rows) == 0 && rows == NULL);
  FAILS(DELONE_NOT_FINITE, delone_delaunay(nan_point, 2, 2, NULL, &t));
  CHECK(t == NULL && delone_error_rows(&rows) == 1 && rows[0] == 1);
  CHECK(delone_error_rows(NULL) == 1 && *delone_error_message() != '\0');
  FAILS(DELONE_BAD_DIMENSION, delone_delaunay(square, 4, 0, NULL, &t));
  FAILS(DELONE_BAD_DIMENSION, delone_convex_hull(square, 4, -1, NULL, &t));
  FAILS(DELONE_BAD_DIMENSION, delone_lower_hull(square, 4, 1, NULL, &t));
  FAILS(DELONE_BAD_DIMENSION, delone_halfspace_intersection(square, 3, 0, NULL, NULL, &t));
  FAILS(DELONE_BAD_DIMENSION, delone_halfspace_intersection(square, 3, INT32_MAX, NULL, NULL, &t));
  FAILS(DELONE_TOO_MANY, delone_delaunay(square, SIZE_MAX / 2, 3, NULL, &t));
  FAILS(DELONE_INVALID_ARGUMENT, delone_delaunay(NULL, 4, 2, NULL, &t));
  FAILS(DELONE_INVALID_ARGUMENT, delone_delaunay(square, 4, 2, NULL, NULL));
  FAILS(DELONE_INVALID_ARGUMENT, delone_regular(square, NULL, 4, 2, NULL, &t));
  FAILS(DELONE_INVALID_ARGUMENT, delone_convex_hulls(square, 4, 2, NULL, 0, NULL, &t));
  FAILS(DELONE_INVALID_ARGUMENT, delone_voronoi(NULL, NULL, &t));
  FAILS(DELONE_INVALID_ARGUMENT, delone_read(NULL, NULL, &t));
  FAILS(DELONE_INVALID_ARGUMENT, delone_make_tiles(NULL, "c", NULL, &t));
  FAILS(DELONE_INVALID_ARGUMENT, delone_check(NULL, NULL, &t));
  FAILS(DELONE_INVALID_ARGUMENT, delone_insert(NULL, square, 1, NULL));
  CHECK(strcmp(delone_kind(NULL), "") == 0);
  delone_free(NULL);
  delone_options_free(NULL);
  OK(delone_delaunay(square, 4, 2, NULL, &t));
  FAILS(DELONE_INVALID_ARGUMENT, delone_get_array(t, NULL, &array));
  FAILS(DELONE_INVALID_ARGUMENT, delone_get_array(t, "cells", NULL));
  FAILS(DELONE_INVALID_ARGUMENT, delone_get_array(NULL, "cells", &array));
  FAILS(DELONE_INVALID_ARGUMENT, delone_get_array(t, "simplices", &array));
  CHECK(strstr(delone_error_message(), "cells") != NULL);
  FAILS(DELONE_INVALID_ARGUMENT, delone_get_integer(t, "cells", &integer));
  FAILS(DELONE_INVALID_ARGUMENT, delone_locate(t, NULL, 4, NULL, NULL, NULL, NULL, NULL));
  FAILS(DELONE_NOT_FINITE, delone_nearest(t, nan_point, 2, 1, NULL, rows_found));
  CHECK(delone_error_rows(&rows) == 1 && rows[0] == 1);
  FAILS(DELONE_INVALID_ARGUMENT, delone_nearest(t, square, 4, 1, NULL, NULL));
  FAILS(DELONE_INVALID_ARGUMENT, delone_insert(t, square, 1, square));
  FAILS(DELONE_NOT_FINITE, delone_insert(t, nan_point, 2, NULL));
  CHECK(get_integer(t, "num_points") == 4);
  FAILS(DELONE_INVALID_ARGUMENT, delone_heights(t, square, 1, NULL));
  CHECK(strstr(delone_error_message(), "delaunay") != NULL);
  FAILS(DELONE_INVALID_ARGUMENT, delone_visible_facets(t, square, 1, &other));
  FAILS(DELONE_INVALID_ARGUMENT, delone_linear_interpolator(t, NULL, 1, &other));
  FAILS(DELONE_INVALID_ARGUMENT, delone_cells_within(t, square, 1, -1, NULL, &other));
  CHECK(strstr(delone_error_message(), "the radius is -1,") != NULL);
  FAILS(DELONE_INVALID_ARGUMENT, delone_write(t, NULL, NULL));
  CHECK(other == NULL);
  delone_free(t);
}

static void names(void) {
  CHECK(strcmp(delone_status_name(DELONE_OK), "ok") == 0);
  CHECK(strcmp(delone_status_name(DELONE_UNSUPPORTED), "unsupported") == 0);
  CHECK(strcmp(delone_status_name(DELONE_INTERNAL_ERROR), "internal_error") == 0);
  CHECK(strcmp(delone_status_name(DELONE_TIME_LIMIT), "time_limit") == 0);
  CHECK(strcmp(delone_status_name(13), "unknown") == 0 && strcmp(delone_status_name(-1), "unknown") == 0);
  CHECK(strchr(delone_version(), '.') != NULL);
  CHECK(delone_index_bytes() == 4 || delone_index_bytes() == 8);
}

static void options_are_examined(void) {
  const double negative[2] = {1, -1};
  delone_options* options;
  delone_object* hull;
  OK(delone_options_new(&options));
  FAILS(DELONE_INVALID_ARGUMENT, delone_set_integer(options, "thread", 1));
  CHECK(strstr(delone_error_message(), "threads") != NULL);
  FAILS(DELONE_INVALID_ARGUMENT, delone_set_integer(options, "threads", -1));
  FAILS(DELONE_INVALID_ARGUMENT, delone_set_integer(options, "threads", INT64_MAX));
  FAILS(DELONE_INVALID_ARGUMENT, delone_set_integer(options, "oriented", 2));
  FAILS(DELONE_INVALID_ARGUMENT, delone_set_real(options, "threads", 1));
  FAILS(DELONE_INVALID_ARGUMENT, delone_set_real(options, "tolerance", -1e-30));
  CHECK(strstr(delone_error_message(), "option tolerance: -1e-30 is no") != NULL);
  FAILS(DELONE_INVALID_ARGUMENT, delone_set_real(options, "tolerance", NAN));
  FAILS(DELONE_INVALID_ARGUMENT, delone_set_reals(options, "tolerance", square, 2));
  CHECK(strstr(delone_error_message(), "axis_tolerances") != NULL);
  FAILS(DELONE_INVALID_ARGUMENT, delone_set_reals(options, "axis_tolerances", negative, 2));
  FAILS(DELONE_INVALID_ARGUMENT, delone_set_reals(options, "axis_tolerances", NULL, 2));
  FAILS(DELONE_INVALID_ARGUMENT, delone_set_text(options, "order", "given"));
  CHECK(strstr(delone_error_message(), "as_given") != NULL);
  FAILS(DELONE_INVALID_ARGUMENT, delone_set_text(options, "order", NULL));
  FAILS(DELONE_INVALID_ARGUMENT, delone_set_text(options, NULL, "given"));
  FAILS(DELONE_INVALID_ARGUMENT, delone_set_text(NULL, "order", "shuffled"));
  CHECK(strcmp(delone_error_message(), "the options must not be NULL") == 0);
  FAILS(DELONE_INVALID_ARGUMENT, delone_options_new(NULL));
  OK(delone_set_integer(options, "tolerance", 9));
  FAILS(DELONE_INVALID_ARGUMENT, delone_convex_hull(square, 4, 2, options, &hull));
  /* Calls ignore options that they have no use for. */
  OK(delone_delaunay(square, 4, 2, options, &hull));
  delone_free(hull);
  delone_options_free(options);
}

struct progress {
  int calls, stop_at;
  double last;
};

static int count(double fraction, void* user_data) {
  struct progress* const progress = user_data;
  CHECK(fraction >= progress->last && fraction <= 1);
  progress->last = fraction;
  return ++progress->calls == progress->stop_at;
}

static void progress_and_cancellation(void) {
  const size_t n = is_small_run() ? 5000 : 40000;
  double* const points = random_points(n, 3);
  struct progress progress = {0, 0, 0};
  delone_object* t;
  delone_set_progress(count, &progress);
  OK(delone_delaunay(points, n, 3, NULL, &t));
  CHECK(progress.calls > 0);
  delone_free(t);
  progress.calls = 0;
  progress.stop_at = 1;
  progress.last = 0;
  FAILS(DELONE_CANCELLED, delone_delaunay(points, n, 3, NULL, &t));
  CHECK(t == NULL && progress.calls == 1);
  delone_set_progress(NULL, NULL);
  OK(delone_delaunay(points, 1000, 3, NULL, &t));
  CHECK(progress.calls == 1);
  /* An insertion that is cancelled leaves everything as it was. */
  delone_set_progress(count, &progress);
  progress.calls = 0;
  progress.last = 0;
  FAILS(DELONE_CANCELLED, delone_insert(t, points + 3000, n - 1000, NULL));
  delone_set_progress(NULL, NULL);
  CHECK(get_integer(t, "num_points") == 1000);
  delone_free(t);
  free(points);
}

/* A progress function may call the library; such calls do not ask it. */
static int calls_again(double fraction, void* user_data) {
  delone_object* inner;
  (void)fraction;
  ++*(int*)user_data;
  OK(delone_convex_hull(square, 4, 2, NULL, &inner));
  CHECK(get_real(inner, "volume") == 1);
  delone_free(inner);
  return *(int*)user_data == 3;
}

static void progress_functions_are_not_asked_by_their_own_calls(void) {
  double* const points = random_points(5000, 3);
  delone_object* t;
  int calls = 2;
  delone_set_progress(calls_again, &calls);
  FAILS(DELONE_CANCELLED, delone_delaunay(points, 5000, 3, NULL, &t));
  CHECK(calls == 3);
  delone_set_progress(NULL, NULL);
  free(points);
}

void errors_test(void) {
  bad_arguments();
  names();
  options_are_examined();
  progress_and_cancellation();
  progress_functions_are_not_asked_by_their_own_calls();
}
