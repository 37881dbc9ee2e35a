/* SPDX-License-Identifier: BSD-3-Clause */
/* The members of objects as vectors and matrices of R. */
#include "entries.h"
#include "glue.h"

#include <limits.h>

#include <string.h>

SEXP delone_r_kind(SEXP pointer) { return Rf_mkString(delone_kind(object_of(pointer))); }

SEXP delone_r_is_alive(SEXP pointer) { return Rf_ScalarLogical(R_ExternalPtrAddr(pointer) != NULL); }

SEXP delone_r_members(SEXP pointer) {
  const delone_object* const object = object_of(pointer);
  R_xlen_t n = 0, i;
  SEXP names;
  while (delone_member(object, (size_t)n, NULL) != NULL) ++n;
  names = PROTECT(Rf_allocVector(STRSXP, n));
  for (i = 0; i < n; ++i) SET_STRING_ELT(names, i, Rf_mkChar(delone_member(object, (size_t)i, NULL)));
  UNPROTECT(1);
  return names;
}

static double entry(const delone_array* array, size_t i) {
  switch (array->type) {
    case DELONE_INT32:
      return ((const int32_t*)array->data)[i];
    case DELONE_INT64:
      return (double)((const int64_t*)array->data)[i];
    case DELONE_UINT8:
      return ((const uint8_t*)array->data)[i];
    default:
      return ((const double*)array->data)[i];
  }
}

/* Whether all entries, and one more, are integers of R. */
static int fits_integers(const delone_array* array) {
  const size_t n = array->shape[0] * array->shape[1];
  size_t i;
  if (array->type == DELONE_FLOAT64) return 0;
  if (array->type == DELONE_UINT8) return 1;
  for (i = 0; i < n; ++i)
    if (entry(array, i) >= INT_MAX) return 0;
  return 1;
}

/* A vector, or a matrix of the same rows. `base` is 1 for ids, of which -1 becomes NA. */
static SEXP array_of(const delone_array* array, int base) {
  const size_t rows = array->shape[0], columns = array->shape[1];
  const int is_integer = fits_integers(array), has_ids = base != 0 && array->type != DELONE_FLOAT64;
  SEXP result =
      PROTECT(array->rank == 2 ? Rf_allocMatrix(is_integer ? INTSXP : REALSXP, (int)rows, (int)columns)
                               : Rf_allocVector(is_integer ? INTSXP : REALSXP, (R_xlen_t)rows));
  size_t i, j;
  for (j = 0; j < columns; ++j)
    for (i = 0; i < rows; ++i) {
      const double x = entry(array, i * columns + j);
      const size_t at = i + j * rows;
      if (is_integer)
        INTEGER(result)[at] = has_ids ? (x < 0 ? NA_INTEGER : (int)x + 1) : (int)x;
      else
        REAL(result)[at] = has_ids ? (x < 0 ? NA_REAL : x + 1) : x;
    }
  UNPROTECT(1);
  return result;
}

static int type_of(const delone_object* object, const char* name) {
  const char* found;
  size_t i;
  int type;
  for (i = 0; (found = delone_member(object, i, &type)) != NULL; ++i)
    if (strcmp(found, name) == 0) return type;
  return 0;
}

SEXP delone_r_member(SEXP pointer, SEXP name, SEXP base) {
  const delone_object* const object = object_of(pointer);
  const char* const wanted = CHAR(STRING_ELT(name, 0));
  delone_array array;
  int64_t integer;
  double real;
  const char* text;
  int status;
  switch (type_of(object, wanted)) {
    case DELONE_ARRAY:
      status = CALL(delone_get_array(object, wanted, &array));
      return status == DELONE_OK ? array_of(&array, Rf_asInteger(base)) : failure(status);
    case DELONE_INTEGER:
      status = CALL(delone_get_integer(object, wanted, &integer));
      if (status != DELONE_OK) return failure(status);
      return integer > -INT_MAX && integer < INT_MAX ? Rf_ScalarInteger((int)integer)
                                                     : Rf_ScalarReal((double)integer);
    case DELONE_REAL:
      status = CALL(delone_get_real(object, wanted, &real));
      return status == DELONE_OK ? Rf_ScalarReal(real) : failure(status);
    case DELONE_TEXT:
      status = CALL(delone_get_text(object, wanted, &text));
      return status == DELONE_OK ? Rf_ScalarString(Rf_mkCharCE(text, CE_UTF8)) : failure(status);
    default:
      return R_NilValue;
  }
}
