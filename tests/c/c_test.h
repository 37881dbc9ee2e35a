/* SPDX-License-Identifier: BSD-3-Clause */
/* What the tests of the C interface have in common. A check that fails ends the program. */
#ifndef DELONE_C_TEST_H
#define DELONE_C_TEST_H

#include <delone/delone.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define CHECK(condition) \
  ((condition) ? (void)0 : check_failed(__FILE__, __LINE__, #condition, delone_error_message()))
/* The call succeeds; fails with that status. */
#define OK(call) CHECK((call) == DELONE_OK)
#define FAILS(status, call) CHECK((call) == (status))

void check_failed(const char* file, int line, const char* condition, const char* message);

/* Whether DELONE_TEST_SCALE asks for a small run, as sanitizers do. */
int is_small_run(void);

/* n x d numbers in 0 ... 1, the same in every run; to be freed. */
double* random_points(size_t n, int d);

delone_array get_array(const delone_object* object, const char* name);
int64_t get_integer(const delone_object* object, const char* name);
double get_real(const delone_object* object, const char* name);
const char* get_text(const delone_object* object, const char* name);
/* Entry i of an array of any type. */
double entry(const delone_array* array, size_t i);

/* The four corners of the unit square, and a duplicate of the first. */
extern const double square[10];
/* The halfspaces of the unit square, 2 <= x + y among them or not. */
extern const double square_halfspaces[12];

void arithmetic_test(void);
void errors_test(void);
void files_test(void);
void hulls_test(void);
void memory_test(void);
void objects_test(void);
void periodic_test(void);
void queries_test(void);

#endif
