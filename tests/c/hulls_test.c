/* SPDX-License-Identifier: BSD-3-Clause */
/* Convex hulls, lower hulls, intersections of halfspaces, diagrams. */
#include "c_test.h"

#include <math.h>

static void cube(void) {
  const double inside[3] = {0.5, 0.5, 0.5}, beyond[6] = {2, 0.5, 0.5, 0.5, 0.5, 0.5};
  double corners[24];
  delone_object *hull, *copy, *lists;
  delone_array array;
  int i;
  for (i = 0; i < 24; ++i) corners[i] = i / 3 >> i % 3 & 1;
  OK(delone_convex_hull(corners, 8, 3, NULL, &hull));
  CHECK(strcmp(delone_kind(hull), "convex_hull") == 0);
  CHECK(get_integer(hull, "num_cells") == 12 && get_integer(hull, "num_facets") == 6);
  CHECK(get_integer(hull, "num_ridges") == 12 && get_integer(hull, "num_vertices") == 8);
  CHECK(fabs(get_real(hull, "volume") - 1) <= get_real(hull, "volume_error") + 1e-15);
  CHECK(fabs(get_real(hull, "area") - 6) <= get_real(hull, "area_error") + 1e-14);
  array = get_array(hull, "f_vector");
  CHECK(array.shape[0] == 3 && entry(&array, 0) == 8 && entry(&array, 1) == 12 && entry(&array, 2) == 6);
  array = get_array(hull, "equations");
  CHECK(array.shape[0] == 6 && array.shape[1] == 4);
  OK(delone_visible_facets(hull, beyond, 2, &lists));
  array = get_array(lists, "offsets");
  CHECK(array.shape[0] == 3 && entry(&array, 1) == 1 && entry(&array, 2) == 1);
  delone_free(lists);
  OK(delone_clone(hull, &copy));
  OK(delone_insert(hull, inside, 1, NULL));
  array = get_array(hull, "point_kinds");
  CHECK(array.type == DELONE_UINT8 && array.shape[0] == 9 && entry(&array, 8) == 2);
  array = get_array(hull, "points");
  CHECK(array.shape[0] == 9 && memcmp(array.data, corners, sizeof corners) == 0);
  CHECK(get_integer(copy, "num_points") == 8);
  CHECK(strcmp(get_text(hull, "hash"), get_text(copy, "hash")) == 0);
  delone_free(hull);
  delone_free(copy);
}

static void hull_with_a_tolerance(void) {
  double* const points = random_points(500, 2);
  delone_options* options;
  delone_object *exact, *hull;
  OK(delone_options_new(&options));
  OK(delone_set_real(options, "tolerance", 0.1));
  OK(delone_convex_hull(points, 500, 2, NULL, &exact));
  OK(delone_convex_hull(points, 500, 2, options, &hull));
  CHECK(get_integer(hull, "num_vertices") < get_integer(exact, "num_vertices"));
  CHECK(get_real(hull, "max_distance") <= 0.1 && get_real(hull, "tolerance") == 0.1);
  delone_free(exact);
  delone_free(hull);
  delone_options_free(options);
  free(points);
}

static void tolerances_of_axes(void) {
  const double notched[10] = {0, 0, 1024, -0.0625, 2048, 0, 2048, 1, 0, 1}, wide[2] = {64, 0.0625},
               narrow[2] = {64, 0.05};
  delone_options* options;
  delone_object* object;
  delone_array used;
  OK(delone_options_new(&options));
  OK(delone_set_reals(options, "axis_tolerances", wide, 2));
  OK(delone_convex_hull(notched, 5, 2, options, &object));
  used = get_array(object, "axis_tolerances");
  CHECK(used.shape[0] == 2 && entry(&used, 0) == 64 && entry(&used, 1) == 0.0625);
  CHECK(get_integer(object, "num_vertices") == 4 && get_real(object, "tolerance") == 64);
  delone_free(object);
  OK(delone_lower_hull(notched, 5, 2, options, &object)); /* which has one tolerance only */
  delone_free(object);
  OK(delone_set_reals(options, "axis_tolerances", narrow, 2));
  OK(delone_convex_hull(notched, 5, 2, options, &object));
  CHECK(get_integer(object, "num_vertices") == 5);
  delone_free(object);
  FAILS(DELONE_INVALID_ARGUMENT, delone_convex_hull(notched, 3, 3, options, &object));
  OK(delone_set_reals(options, "axis_tolerances", NULL, 0));
  OK(delone_convex_hull(notched, 5, 2, options, &object));
  CHECK(get_real(object, "tolerance") == 0 && get_array(object, "axis_tolerances").shape[0] == 0);
  delone_free(object);
  delone_options_free(options);
}

static void many_hulls(void) {
  const size_t offsets[4] = {0, 4, 4, 5}, wrong[2] = {0, 6};
  delone_object* hulls;
  delone_array array;
  OK(delone_convex_hulls(square, 5, 2, offsets, 3, NULL, &hulls));
  CHECK(get_integer(hulls, "num_hulls") == 3);
  array = get_array(hulls, "volumes");
  CHECK(entry(&array, 0) == 1 && entry(&array, 1) == 0);
  array = get_array(hulls, "affine_dimensions");
  CHECK(entry(&array, 0) == 2 && entry(&array, 1) == -1 && entry(&array, 2) == 0);
  array = get_array(hulls, "cell_offsets");
  CHECK(array.type == DELONE_INT64 && entry(&array, 3) == 4);
  delone_free(hulls);
  FAILS(DELONE_INVALID_ARGUMENT, delone_convex_hulls(square, 5, 2, wrong, 1, NULL, &hulls));
  CHECK(hulls == NULL);
}

static void volumes_of_intersections(void) {
  const double squares[24] = {0, 0, 2, 0, 2, 2, 0, 2, 1, 1, 3, 1, 3, 3, 1, 3, 2, 0, 3, 0, 3, 1, 2, 1};
  const size_t offsets[4] = {0, 4, 8, 12};
  const int64_t pairs[8] = {0, 1, 1, 0, 0, 2, 1, 1}, wrong[2] = {0, 3}, negative[2] = {-1, 0};
  double volumes[4];
  delone_options* options;
  delone_object* hulls;
  delone_array array;
  OK(delone_options_new(&options));
  OK(delone_set_integer(options, "threads", 2));
  OK(delone_convex_hulls(squares, 12, 2, offsets, 3, options, &hulls));
  array = get_array(hulls, "points");
  CHECK(array.shape[0] == 12 && entry(&array, 8) == 1);
  OK(delone_intersection_volumes(hulls, pairs, 4, options, volumes));
  CHECK(fabs(volumes[0] - 1) < 1e-15 && volumes[1] == volumes[0] && volumes[2] == 0 && volumes[3] == 4);
  OK(delone_intersection_volumes(hulls, NULL, 0, NULL, NULL));
  FAILS(DELONE_INVALID_ARGUMENT, delone_intersection_volumes(hulls, wrong, 1, NULL, volumes));
  FAILS(DELONE_INVALID_ARGUMENT, delone_intersection_volumes(hulls, negative, 1, NULL, volumes));
  FAILS(DELONE_INVALID_ARGUMENT, delone_intersection_volumes(hulls, pairs, 1, NULL, NULL));
  FAILS(DELONE_INVALID_ARGUMENT, delone_intersection_volumes(NULL, pairs, 1, NULL, volumes));
  delone_free(hulls);
  delone_options_free(options);
}

static void envelopes(void) {
  const double phases[8] = {0, 0, 0.5, -1, 0.5, 1, 1, 0}, at[3] = {0.25, 0.5, 2};
  delone_object *lower, *upper, *report;
  delone_array array;
  double heights[3], above[4];
  int64_t cells[3];
  OK(delone_lower_hull(phases, 4, 2, NULL, &lower));
  OK(delone_upper_hull(phases, 4, 2, NULL, &upper));
  CHECK(strcmp(delone_kind(lower), "lower_hull") == 0 && strcmp(delone_kind(upper), "upper_hull") == 0);
  array = get_array(lower, "vertices");
  CHECK(array.shape[0] == 3 && entry(&array, 1) == 1);
  array = get_array(upper, "vertices");
  CHECK(array.shape[0] == 3 && entry(&array, 1) == 2);
  OK(delone_heights(lower, at, 3, heights));
  CHECK(heights[0] == -0.5 && heights[1] == -1 && heights[2] == INFINITY);
  OK(delone_height_above(lower, phases, 4, NULL, above));
  CHECK(above[0] == 0 && above[1] == 0 && above[2] == 2 && above[3] == 0);
  OK(delone_locate(lower, at, 3, NULL, cells, NULL, NULL, NULL));
  CHECK(cells[0] >= 0 && cells[0] < 2 && cells[2] == -1);
  FAILS(DELONE_INVALID_ARGUMENT, delone_heights(NULL, at, 3, heights));
  OK(delone_check(lower, NULL, &report));
  CHECK(get_integer(report, "ok") == 1);
  delone_free(report);
  delone_free(lower);
  delone_free(upper);
}

static void halfspaces(void) {
  const double far[2] = {-5, -5}, inside[2] = {0.5, 0.25}, more[3] = {1, 1, -1.5};
  const double empty[4] = {1, 1, -1, 1};
  delone_object *p, *copy;
  delone_array array;
  OK(delone_halfspace_intersection(square_halfspaces, 4, 2, NULL, NULL, &p));
  CHECK(strcmp(delone_kind(p), "halfspace_intersection") == 0 && strcmp(get_text(p, "state"), "full") == 0);
  CHECK(get_integer(p, "bounded") == 1 && get_integer(p, "num_vertices") == 4 && get_real(p, "volume") == 1);
  array = get_array(p, "vertices");
  CHECK(array.shape[0] == 4 && array.shape[1] == 2);
  OK(delone_clone(p, &copy));
  OK(delone_insert(p, more, 1, NULL));
  CHECK(get_integer(p, "num_vertices") == 5 && get_integer(copy, "num_vertices") == 4);
  array = get_array(p, "halfspaces");
  CHECK(array.shape[0] == 5 && array.shape[1] == 3 && entry(&array, 14) == -1.5);
  delone_free(p);
  delone_free(copy);
  OK(delone_halfspace_intersection(square_halfspaces, 4, 2, inside, NULL, &p));
  array = get_array(p, "interior_point");
  CHECK(entry(&array, 0) == 0.5 && entry(&array, 1) == 0.25);
  delone_free(p);
  FAILS(DELONE_INVALID_ARGUMENT, delone_halfspace_intersection(square_halfspaces, 4, 2, far, NULL, &p));
  OK(delone_halfspace_intersection(empty, 2, 1, NULL, NULL, &p));
  CHECK(strcmp(get_text(p, "state"), "empty") == 0);
  array = get_array(p, "witness");
  CHECK(array.shape[0] == 2);
  delone_free(p);
}

static void diagrams(void) {
  const double points[10] = {0, 0, 2, 0, 2, 2, 0, 2, 1, 1}, weights[5] = {0, 0, 0, 0, -9};
  const double low[2] = {0, 0}, high[2] = {2, 2};
  delone_object *t, *v, *report;
  delone_array array;
  double volumes[5];
  OK(delone_delaunay(points, 5, 2, NULL, &t));
  OK(delone_voronoi(t, NULL, &v));
  delone_free(t);
  CHECK(strcmp(delone_kind(v), "voronoi") == 0);
  CHECK(get_integer(v, "num_vertices") == 4 && get_integer(v, "num_regions") == 5);
  CHECK(get_integer(v, "num_unbounded_regions") == 4 && get_integer(v, "num_rays") == 4);
  array = get_array(v, "region_volumes");
  CHECK(array.shape[0] == 5 && fabs(entry(&array, 4) - 2) < 1e-14 && isinf(entry(&array, 0)));
  array = get_array(v, "ridge_points");
  CHECK(array.shape[1] == 2 && array.shape[0] == 8);
  array = get_array(v, "ridge_offsets");
  CHECK(array.type == DELONE_INT64);
  OK(delone_region_volumes(v, low, high, NULL, volumes));
  CHECK(fabs(volumes[0] - 0.5) < 1e-14 && fabs(volumes[4] - 2) < 1e-14);
  FAILS(DELONE_INVALID_ARGUMENT, delone_region_volumes(v, high, low, NULL, volumes));
  delone_free(v);
  OK(delone_regular(points, weights, 5, 2, NULL, &t));
  OK(delone_voronoi(t, NULL, &v));
  CHECK(strcmp(delone_kind(v), "power_diagram") == 0 && get_integer(v, "num_regions") == 4);
  array = get_array(v, "point_region");
  CHECK(entry(&array, 4) == -1);
  delone_free(t);
  delone_free(v);
  OK(delone_furthest_site(points, 5, 2, NULL, &t));
  OK(delone_voronoi(t, NULL, &v));
  delone_free(t);
  CHECK(strcmp(delone_kind(v), "furthest_voronoi") == 0 && get_integer(v, "num_regions") == 4);
  CHECK(strcmp(get_text(v, "kind"), "furthest_voronoi") == 0);
  CHECK(get_integer(v, "num_unbounded_regions") == 4);
  OK(delone_check(v, NULL, &report));
  CHECK(get_integer(report, "ok") == 1 && *get_text(report, "not_examined") == '\0');
  delone_free(report);
  OK(delone_region_volumes(v, low, high, NULL, volumes));
  CHECK(fabs(volumes[0] + volumes[1] + volumes[2] + volumes[3] - (high[0] - low[0]) * (high[1] - low[1])) <
        1e-12);
  OK(delone_write(v, "c_furthest.npz", NULL));
  delone_free(v);
  OK(delone_read("c_furthest.npz", NULL, &v));
  CHECK(strcmp(delone_kind(v), "diagram") == 0 && strcmp(get_text(v, "kind"), "furthest_voronoi") == 0);
  OK(delone_check(v, NULL, &report));
  CHECK(get_integer(report, "ok") == 1);
  delone_free(report);
  delone_free(v);
  remove("c_furthest.npz");
}

static void cells_of_sites(void) {
  static const double points[12] = {0, 0, 2, 0, 0, 2, 2, 2, 1, 1, 1, 1}, low[2] = {0, 0}, high[2] = {2, 2};
  static const double weights[6] = {0, 0, 0, 0, -9, 0}, half[3] = {1, 0, -1};
  delone_object *t, *cells;
  delone_options* options;
  delone_array array;
  OK(delone_options_new(&options));
  OK(delone_delaunay(points, 6, 2, NULL, &t));
  OK(delone_site_cells(t, NULL, NULL, NULL, 0, NULL, &cells));
  CHECK(strcmp(delone_kind(cells), "site_cells") == 0 && get_integer(cells, "dimension") == 2);
  array = get_array(cells, "volumes");
  CHECK(array.shape[0] == 6 && isinf(entry(&array, 0)) && entry(&array, 4) == 2 && entry(&array, 5) == 0);
  array = get_array(cells, "centroids");
  CHECK(array.shape[1] == 2 && entry(&array, 8) == 1 && isnan(entry(&array, 0)));
  array = get_array(cells, "neighbor_offsets");
  CHECK(array.type == DELONE_INT64 && entry(&array, 5) - entry(&array, 4) == 4);
  delone_free(cells);
  OK(delone_site_cells(t, low, high, half, 1, NULL, &cells));
  array = get_array(cells, "volumes");
  CHECK(fabs(entry(&array, 0) - 0.5) < 1e-14 && fabs(entry(&array, 4) - 1) < 1e-14 && entry(&array, 1) == 0);
  delone_free(cells);
  FAILS(DELONE_INVALID_ARGUMENT, delone_site_cells(t, high, low, NULL, 0, NULL, &cells));
  FAILS(DELONE_INVALID_ARGUMENT, delone_site_cells(t, low, NULL, NULL, 0, NULL, &cells));
  FAILS(DELONE_INVALID_ARGUMENT, delone_site_cells(t, NULL, NULL, half, 1, NULL, &cells));
  delone_free(t);
  OK(delone_regular(points, weights, 6, 2, NULL, &t));
  OK(delone_set_integer(options, "proper_faces", 1));
  OK(delone_site_cells(t, low, high, NULL, 0, options, &cells));
  array = get_array(cells, "volumes");
  CHECK(entry(&array, 4) == 0 && fabs(entry(&array, 5) - 2) < 1e-14);
  delone_free(cells);
  OK(delone_set_integer(options, "vertices", 1));
  OK(delone_site_cells(t, low, high, NULL, 0, options, &cells));
  array = get_array(cells, "vertex_offsets");
  CHECK(array.type == DELONE_INT64 && entry(&array, 0) == 0 && entry(&array, 1) == 3 &&
        entry(&array, 6) == 16);
  array = get_array(cells, "vertices");
  CHECK(array.shape[0] == 16 && array.shape[1] == 2 && entry(&array, 3) == 1 && entry(&array, 4) == 1);
  array = get_array(cells, "face_vertex_offsets");
  CHECK(array.type == DELONE_INT64 && array.shape[0] == 17 && entry(&array, 16) == 32);
  array = get_array(cells, "face_vertices");
  CHECK(array.shape[0] == 32);
  delone_free(cells);
  delone_free(t);
  delone_options_free(options);
}

static void options_of_qhull(void) {
  delone_object* found;
  OK(delone_qhull_options("Qt QG-3 C-0.5", "hull", &found));
  CHECK(strcmp(delone_kind(found), "qhull_options") == 0);
  CHECK(get_integer(found, "good_row") == 3 && get_integer(found, "good_visible") == 0);
  CHECK(get_integer(found, "furthest_site") == 0 && get_real(found, "centrum") == 0.5);
  CHECK(isnan(get_real(found, "roundoff")) && get_real(found, "width") == 0);
  delone_free(found);
  OK(delone_qhull_options("Qu Qbb", "delaunay", &found));
  CHECK(get_integer(found, "furthest_site") == 1 && get_integer(found, "scaled") == 1);
  CHECK(get_integer(found, "good_row") == -1);
  delone_free(found);
  FAILS(DELONE_UNSUPPORTED, delone_qhull_options("Qt Qu", "hull", &found));
  CHECK(strstr(delone_error_message(), "'Qu'") != NULL);
  FAILS(DELONE_INVALID_ARGUMENT, delone_qhull_options("Qt", "rbox", &found));
  FAILS(DELONE_INVALID_ARGUMENT, delone_qhull_options(NULL, "hull", &found));
}

void hulls_test(void) {
  options_of_qhull();
  cube();
  hull_with_a_tolerance();
  tolerances_of_axes();
  many_hulls();
  volumes_of_intersections();
  envelopes();
  halfspaces();
  diagrams();
  cells_of_sites();
}
