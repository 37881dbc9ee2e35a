/* SPDX-License-Identifier: BSD-3-Clause */
#include "glue.h"

#include <limits.h>
#include <math.h>
#include <string.h>

/* Whether the user has asked for an end since begin_call(). The library calls ask() in the thread of R only.
 */
static int is_interrupted = 0;

static void check_interrupt(void* unused) {
  (void)unused;
  R_CheckUserInterrupt(); /* jumps, to R_ToplevelExec() */
}

static int ask(double fraction, void* unused) {
  (void)fraction;
  (void)unused;
  if (R_ToplevelExec(check_interrupt, NULL)) return 0;
  is_interrupted = 1;
  return 1;
}

void begin_call(void) {
  is_interrupted = 0;
  delone_set_progress(ask, NULL);
}

int end_call(int status) {
  delone_set_progress(NULL, NULL);
  return status;
}

SEXP failure(int status) {
  const char* names[] = {"status", "code", "message", "rows", "interrupted", ""};
  const size_t* rows = NULL;
  const size_t n = delone_error_rows(&rows);
  SEXP result = PROTECT(Rf_mkNamed(VECSXP, names)), numbers;
  size_t i;
  SET_VECTOR_ELT(result, 0, Rf_ScalarInteger(status));
  SET_VECTOR_ELT(result, 1, Rf_mkString(delone_status_name(status)));
  SET_VECTOR_ELT(result, 2, Rf_ScalarString(Rf_mkCharCE(delone_error_message(), CE_UTF8)));
  numbers = Rf_allocVector(REALSXP, (R_xlen_t)n);
  SET_VECTOR_ELT(result, 3, numbers);
  for (i = 0; i < n; ++i) REAL(numbers)[i] = (double)rows[i] + 1;
  SET_VECTOR_ELT(result, 4, Rf_ScalarLogical(status == DELONE_CANCELLED && is_interrupted));
  Rf_setAttrib(result, R_ClassSymbol, Rf_mkString("delone_failure"));
  UNPROTECT(1);
  return result;
}

static void finalize(SEXP pointer) {
  delone_free(R_ExternalPtrAddr(pointer));
  R_ClearExternalPtr(pointer);
}

SEXP new_pointer(void) {
  SEXP pointer = PROTECT(R_MakeExternalPtr(NULL, Rf_install("delone_object"), R_NilValue));
  R_RegisterCFinalizerEx(pointer, finalize, TRUE);
  UNPROTECT(1);
  return pointer;
}

delone_object* object_of(SEXP pointer) {
  if (TYPEOF(pointer) != EXTPTRSXP || R_ExternalPtrTag(pointer) != Rf_install("delone_object"))
    Rf_error("this is no object of delone");
  if (R_ExternalPtrAddr(pointer) == NULL)
    Rf_error(
        "this object has lost its contents: it was saved or sent to another process; write_delone() makes "
        "files");
  return R_ExternalPtrAddr(pointer);
}

SEXP finished(SEXP pointer, int status, delone_object* object) {
  if (status != DELONE_OK) return failure(status);
  R_SetExternalPtrAddr(pointer, object);
  return pointer;
}

static int set_option(delone_options* options, const char* name, SEXP value) {
  if (TYPEOF(value) == STRSXP) {
    int status = DELONE_OK;
    R_xlen_t i;
    for (i = 0; status == DELONE_OK && i < XLENGTH(value); ++i)
      status = delone_set_text(options, name, CHAR(STRING_ELT(value, i)));
    return status;
  }
  if (strcmp(name, "axis_tolerances") == 0)
    return delone_set_reals(options, name, REAL(value), (size_t)XLENGTH(value));
  if (REAL(value)[0] == trunc(REAL(value)[0]) && fabs(REAL(value)[0]) < 9e18)
    return delone_set_integer(options, name, (int64_t)REAL(value)[0]);
  return delone_set_real(options, name, REAL(value)[0]);
}

delone_options* options_of(SEXP list, int* status) {
  delone_options* options = NULL;
  SEXP names = Rf_getAttrib(list, R_NamesSymbol);
  R_xlen_t i;
  *status = delone_options_new(&options);
  for (i = 0; *status == DELONE_OK && i < XLENGTH(list); ++i)
    *status = set_option(options, CHAR(STRING_ELT(names, i)), VECTOR_ELT(list, i));
  if (*status == DELONE_OK) return options;
  delone_options_free(options);
  return NULL;
}

int64_t* ids_of(SEXP numbers) {
  const R_xlen_t n = XLENGTH(numbers);
  int64_t* const ids = (int64_t*)R_alloc((size_t)n, sizeof(int64_t));
  R_xlen_t i;
  for (i = 0; i < n; ++i)
    ids[i] = TYPEOF(numbers) == INTSXP ? (int64_t)INTEGER(numbers)[i] - 1 : (int64_t)REAL(numbers)[i] - 1;
  return ids;
}

SEXP numbers_of(const int64_t* ids, R_xlen_t n) {
  SEXP result;
  R_xlen_t i;
  int64_t largest = 0;
  for (i = 0; i < n; ++i)
    if (ids[i] > largest) largest = ids[i];
  result = Rf_allocVector(largest < INT_MAX ? INTSXP : REALSXP, n);
  for (i = 0; i < n; ++i) {
    if (TYPEOF(result) == INTSXP)
      INTEGER(result)[i] = ids[i] < 0 ? NA_INTEGER : (int)ids[i] + 1;
    else
      REAL(result)[i] = ids[i] < 0 ? NA_REAL : (double)ids[i] + 1;
  }
  return result;
}
