/* SPDX-License-Identifier: BSD-3-Clause */
/* Questions to objects: answers are vectors, and matrices with an answer in each column. */
#include "entries.h"
#include "glue.h"

#include <math.h>
#include <string.h>

static SEXP answer(int status, SEXP values) { return status == DELONE_OK ? values : failure(status); }

/* The work of a query with options: `call` sets a status. */
#define ASK(call)                                              \
  do {                                                         \
    delone_options* const options = options_of(list, &status); \
    if (status == DELONE_OK) status = CALL(call);              \
    delone_options_free(options);                              \
  } while (0)

SEXP delone_r_locate(SEXP located, SEXP queries, SEXP width, SEXP list) {
  const char* names[] = {"cell", "kind", "barycentric", "distance", ""};
  const delone_object* const object = object_of(located);
  const size_t n = points_of(queries);
  const int w = Rf_asInteger(width); /* of barycentric coordinates; 0: none, nor distances */
  int64_t* const cells = (int64_t*)R_alloc(n, sizeof(int64_t));
  uint8_t* const kinds = (uint8_t*)R_alloc(n, 1);
  SEXP result = PROTECT(Rf_mkNamed(VECSXP, names));
  size_t i;
  int status;
  SET_VECTOR_ELT(result, 1, Rf_allocVector(INTSXP, (R_xlen_t)n));
  if (w > 0) SET_VECTOR_ELT(result, 2, Rf_allocMatrix(REALSXP, w, (int)n));
  if (w > 0) SET_VECTOR_ELT(result, 3, Rf_allocVector(REALSXP, (R_xlen_t)n));
  ASK(delone_locate(object, REAL(queries), n, options, cells, kinds,
                    w > 0 ? REAL(VECTOR_ELT(result, 2)) : NULL, w > 0 ? REAL(VECTOR_ELT(result, 3)) : NULL));
  if (status == DELONE_OK) {
    SET_VECTOR_ELT(result, 0, numbers_of(cells, (R_xlen_t)n));
    for (i = 0; i < n; ++i) INTEGER(VECTOR_ELT(result, 1))[i] = kinds[i] + 1;
  }
  result = answer(status, result);
  UNPROTECT(1);
  return result;
}

SEXP delone_r_nearest(SEXP triangulation, SEXP queries, SEXP count, SEXP list) {
  const delone_object* const object = object_of(triangulation);
  const size_t n = points_of(queries), k = (size_t)Rf_asReal(count);
  int64_t* const rows = (int64_t*)R_alloc(n * k, sizeof(int64_t));
  int status;
  ASK(delone_nearest(object, REAL(queries), n, k, options, rows));
  return status == DELONE_OK ? numbers_of(rows, (R_xlen_t)(n * k)) : failure(status);
}

SEXP delone_r_natural_neighbors(SEXP triangulation, SEXP queries, SEXP list) {
  const delone_object* const of = object_of(triangulation);
  SEXP pointer = PROTECT(new_pointer()), result;
  delone_object* object = NULL;
  int status;
  ASK(delone_natural_neighbors(of, REAL(queries), points_of(queries), options, &object));
  result = finished(pointer, status, object);
  UNPROTECT(1);
  return result;
}

SEXP delone_r_cells_within(SEXP triangulation, SEXP queries, SEXP radius, SEXP list) {
  const delone_object* const of = object_of(triangulation);
  const double r = Rf_asReal(radius);
  SEXP pointer = PROTECT(new_pointer()), result;
  delone_object* object = NULL;
  int status;
  ASK(delone_cells_within(of, REAL(queries), points_of(queries), r, options, &object));
  result = finished(pointer, status, object);
  UNPROTECT(1);
  return result;
}

SEXP delone_r_interpolate(SEXP interpolator, SEXP queries, SEXP columns, SEXP list) {
  const delone_object* const object = object_of(interpolator);
  const size_t n = points_of(queries);
  SEXP values = PROTECT(Rf_allocMatrix(REALSXP, Rf_asInteger(columns), (int)n));
  int status;
  ASK(delone_interpolate(object, REAL(queries), n, options, REAL(values), NULL));
  values = answer(status, values);
  UNPROTECT(1);
  return values;
}

SEXP delone_r_region_volumes(SEXP diagram, SEXP low, SEXP high, SEXP regions, SEXP list) {
  const delone_object* const object = object_of(diagram);
  SEXP volumes = PROTECT(Rf_allocVector(REALSXP, Rf_asInteger(regions)));
  int status;
  ASK(delone_region_volumes(object, REAL(low), REAL(high), options, REAL(volumes)));
  volumes = answer(status, volumes);
  UNPROTECT(1);
  return volumes;
}

SEXP delone_r_intersection_volumes(SEXP hulls, SEXP pairs, SEXP list) {
  const delone_object* const object = object_of(hulls);
  const size_t n = points_of(pairs);
  const int64_t* const ids = ids_of(pairs);
  SEXP volumes = PROTECT(Rf_allocVector(REALSXP, (R_xlen_t)n));
  int status;
  ASK(delone_intersection_volumes(object, ids, n, options, REAL(volumes)));
  volumes = answer(status, volumes);
  UNPROTECT(1);
  return volumes;
}

SEXP delone_r_orientation(SEXP points) {
  int sign = 0;
  const int status = delone_orientation(REAL(points), dimension_of(points), &sign);
  return status == DELONE_OK ? Rf_ScalarInteger(sign) : failure(status);
}
SEXP delone_r_in_sphere(SEXP points, SEXP query) {
  int side = 0;
  const int status = delone_in_sphere(REAL(points), REAL(query), dimension_of(points), &side);
  return status == DELONE_OK ? Rf_ScalarInteger(side) : failure(status);
}

SEXP delone_r_version(void) { return Rf_mkString(delone_version()); }

/* |det| / k! of the edges of each cell: `edges` has k x k numbers for each. Rounded. */
SEXP delone_r_simplex_volumes(SEXP edges, SEXP dimension) {
  const size_t k = (size_t)Rf_asInteger(dimension), cells = (size_t)XLENGTH(edges) / (k * k);
  double* const matrix = (double*)R_alloc(k * k, sizeof(double));
  SEXP volumes = PROTECT(Rf_allocVector(REALSXP, (R_xlen_t)cells));
  size_t cell, i, r, c;
  for (cell = 0; cell < cells; ++cell) {
    double volume = 1;
    memcpy(matrix, REAL(edges) + cell * k * k, k * k * sizeof(double));
    for (i = 0; i < k; ++i) {
      size_t pivot = i;
      for (r = i + 1; r < k; ++r)
        if (fabs(matrix[r * k + i]) > fabs(matrix[pivot * k + i])) pivot = r;
      volume *= fabs(matrix[pivot * k + i]) / (double)(i + 1);
      if (volume == 0) break;
      for (c = i; c < k; ++c) {
        const double swapped = matrix[i * k + c];
        matrix[i * k + c] = matrix[pivot * k + c];
        matrix[pivot * k + c] = swapped;
      }
      for (r = i + 1; r < k; ++r) {
        const double factor = matrix[r * k + i] / matrix[i * k + i];
        for (c = i; c < k; ++c) matrix[r * k + c] -= factor * matrix[i * k + c];
      }
    }
    REAL(volumes)[cell] = volume;
  }
  UNPROTECT(1);
  return volumes;
}
