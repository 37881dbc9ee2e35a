/* SPDX-License-Identifier: BSD-3-Clause */
/* Results: triangulations, hulls, intersections, diagrams, and changes of triangulations. */
#include "entries.h"
#include "glue.h"

/* Makes an object: `call` sets `object` and may use `options`. */
#define MAKE(call)                                           \
  SEXP pointer = PROTECT(new_pointer()), result;             \
  delone_object* object = NULL;                              \
  int status;                                                \
  delone_options* const options = options_of(list, &status); \
  if (status == DELONE_OK) status = CALL(call);              \
  delone_options_free(options);                              \
  result = finished(pointer, status, object);                \
  UNPROTECT(1);                                              \
  return result

SEXP delone_r_delaunay(SEXP points, SEXP list) {
  MAKE(delone_delaunay(REAL(points), points_of(points), dimension_of(points), options, &object));
}
SEXP delone_r_furthest_site(SEXP points, SEXP list) {
  MAKE(delone_furthest_site(REAL(points), points_of(points), dimension_of(points), options, &object));
}
SEXP delone_r_regular(SEXP points, SEXP weights, SEXP list) {
  MAKE(
      delone_regular(REAL(points), REAL(weights), points_of(points), dimension_of(points), options, &object));
}
SEXP delone_r_convex_hull(SEXP points, SEXP list) {
  MAKE(delone_convex_hull(REAL(points), points_of(points), dimension_of(points), options, &object));
}
SEXP delone_r_halfspaces(SEXP rows, SEXP inside, SEXP list) {
  MAKE(delone_halfspace_intersection(REAL(rows), points_of(rows), dimension_of(rows) - 1,
                                     numbers_or_null(inside), options, &object));
}
SEXP delone_r_voronoi(SEXP triangulation, SEXP list) {
  const delone_object* const of = object_of(triangulation);
  MAKE(delone_voronoi(of, options, &object));
}
SEXP delone_r_alpha_complex(SEXP triangulation, SEXP radius, SEXP list) {
  const delone_object* const of = object_of(triangulation);
  const double r = Rf_asReal(radius);
  MAKE(delone_alpha_complex(of, r, options, &object));
}
SEXP delone_r_check(SEXP checked, SEXP list) {
  const delone_object* const of = object_of(checked);
  MAKE(delone_check(of, options, &object));
}
SEXP delone_r_read(SEXP path, SEXP list) {
  const char* const from = Rf_translateCharUTF8(STRING_ELT(path, 0));
  MAKE(delone_read(from, options, &object));
}
SEXP delone_r_convex_hulls(SEXP points, SEXP offsets, SEXP list) {
  const size_t sets = (size_t)XLENGTH(offsets) - 1;
  size_t* const bounds = (size_t*)R_alloc(sets + 1, sizeof(size_t));
  size_t i;
  for (i = 0; i <= sets; ++i) bounds[i] = (size_t)REAL(offsets)[i];
  MAKE(delone_convex_hulls(REAL(points), points_of(points), dimension_of(points), bounds, sets, options,
                           &object));
}
SEXP delone_r_cells(SEXP points, SEXP cells) {
  const int64_t* const ids = ids_of(cells);
  SEXP pointer = PROTECT(new_pointer()), result;
  delone_object* object = NULL;
  const int status =
      CALL(delone_triangulation_of_cells(REAL(points), NULL, points_of(points), dimension_of(points), ids,
                                         points_of(cells), dimension_of(cells) - 1, &object));
  result = finished(pointer, status, object);
  UNPROTECT(1);
  return result;
}
SEXP delone_r_qhull_options(SEXP text, SEXP program) {
  SEXP pointer = PROTECT(new_pointer()), result;
  delone_object* object = NULL;
  const int status = CALL(
      delone_qhull_options(Rf_translateCharUTF8(STRING_ELT(text, 0)), CHAR(STRING_ELT(program, 0)), &object));
  result = finished(pointer, status, object);
  UNPROTECT(1);
  return result;
}
SEXP delone_r_interpolator(SEXP triangulation, SEXP values, SEXP natural, SEXP smooth) {
  const delone_object* const of = object_of(triangulation);
  SEXP pointer = PROTECT(new_pointer()), result;
  delone_object* object = NULL;
  const size_t columns = (size_t)Rf_nrows(values); /* a point in each column */
  const int status = Rf_asLogical(natural)
                         ? CALL(delone_natural_neighbor_interpolator(of, REAL(values), columns,
                                                                     Rf_asLogical(smooth), NULL, &object))
                         : CALL(delone_linear_interpolator(of, REAL(values), columns, &object));
  result = finished(pointer, status, object);
  UNPROTECT(1);
  return result;
}

/* ---- Changes, of a copy ---- */

#define CHANGE(call)                                            \
  SEXP pointer = PROTECT(new_pointer()), result;                \
  delone_object* object = NULL;                                 \
  int status = CALL(delone_clone(object_of(changed), &object)); \
  R_SetExternalPtrAddr(pointer, object); /* which frees it */   \
  if (status == DELONE_OK) status = CALL(call);                 \
  result = finished(pointer, status, object);                   \
  UNPROTECT(1);                                                 \
  return result

SEXP delone_r_insert(SEXP changed, SEXP rows, SEXP weights) {
  CHANGE(delone_insert(object, REAL(rows), points_of(rows), numbers_or_null(weights)));
}
SEXP delone_r_remove(SEXP changed, SEXP numbers) {
  const int64_t* const rows = ids_of(numbers);
  CHANGE(delone_remove(object, rows, (size_t)XLENGTH(numbers)));
}
SEXP delone_r_move(SEXP changed, SEXP numbers, SEXP to, SEXP weights) {
  const int64_t* const rows = ids_of(numbers);
  CHANGE(delone_move(object, rows, (size_t)XLENGTH(numbers), numbers_or_null(to), numbers_or_null(weights)));
}

SEXP delone_r_write(SEXP written, SEXP path, SEXP format) {
  const int status = CALL(delone_write(object_of(written), Rf_translateCharUTF8(STRING_ELT(path, 0)),
                                       CHAR(STRING_ELT(format, 0))));
  return status == DELONE_OK ? R_NilValue : failure(status);
}
