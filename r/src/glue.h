/* SPDX-License-Identifier: BSD-3-Clause */
/* What all entry points have in common: objects of the library as external pointers, errors as values,
 * interrupts.
 *
 * No entry point calls Rf_error() while it holds something of the library that R does not know: errors of the
 * library are returned (failure()) and raised by R code, and objects belong to an external pointer before
 * they are made. */
#ifndef DELONE_R_GLUE_H
#define DELONE_R_GLUE_H

#define R_NO_REMAP
#include <R.h>
#include <Rinternals.h>
#include <delone/delone.h>

/* A call of the library that may take long: the user may interrupt it. */
#define CALL(call) (begin_call(), end_call(call))
void begin_call(void);
int end_call(int status);

/* The last failure in this thread as a list of the class "delone_failure". */
SEXP failure(int status);

/* An external pointer without an object, which it will free; the place for the object; the finished pointer,
 * or a failure. */
SEXP new_pointer(void);
delone_object* object_of(SEXP pointer);
SEXP finished(SEXP pointer, int status, delone_object* object);

/* Options of a named list. To be freed; NULL after a failure, with its status. */
delone_options* options_of(SEXP list, int* status);

/* Numbers of R as ids from 0, and back: NA for -1. R memory that lasts until the entry point returns. */
int64_t* ids_of(SEXP numbers);
SEXP numbers_of(const int64_t* ids, R_xlen_t n);

/* The rows and columns of a matrix that has a point in each column. */
static inline size_t points_of(SEXP columns) { return (size_t)Rf_ncols(columns); }
static inline int dimension_of(SEXP columns) { return Rf_nrows(columns); }
static inline const double* numbers_or_null(SEXP x) { return Rf_isNull(x) ? NULL : REAL(x); }

#endif
