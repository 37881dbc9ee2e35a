/* SPDX-License-Identifier: BSD-3-Clause */
/* Runs the tests of one file: delone_c_tests NAME. */
#include "c_test.h"

const double square[10] = {0, 0, 1, 0, 1, 1, 0, 1, 0, 0};
const double square_halfspaces[12] = {-1, 0, 0, 0, -1, 0, 1, 0, -1, 0, 1, -1};

void check_failed(const char* file, int line, const char* condition, const char* message) {
  fprintf(stderr, "%s:%d: %s is false; the last error: %s\n", file, line, condition, message);
  exit(1);
}

int is_small_run(void) {
  const char* const scale = getenv("DELONE_TEST_SCALE");
  return scale != NULL && strcmp(scale, "small") == 0;
}

double* random_points(size_t n, int d) {
  const size_t size = n * (size_t)d;
  double* const points = malloc(size * sizeof(double));
  uint64_t state = 1;
  size_t i;
  CHECK(points != NULL);
  for (i = 0; i < size; ++i) {
    state = state * UINT64_C(6364136223846793005) + UINT64_C(1442695040888963407);
    points[i] = (double)(state >> 11) / 9007199254740992.0;
  }
  return points;
}

delone_array get_array(const delone_object* object, const char* name) {
  delone_array array;
  OK(delone_get_array(object, name, &array));
  return array;
}

int64_t get_integer(const delone_object* object, const char* name) {
  int64_t value;
  OK(delone_get_integer(object, name, &value));
  return value;
}

double get_real(const delone_object* object, const char* name) {
  double value;
  OK(delone_get_real(object, name, &value));
  return value;
}

const char* get_text(const delone_object* object, const char* name) {
  const char* text;
  OK(delone_get_text(object, name, &text));
  return text;
}

double entry(const delone_array* array, size_t i) {
  CHECK(i < array->shape[0] * array->shape[1]);
  switch (array->type) {
    case DELONE_FLOAT64:
      return ((const double*)array->data)[i];
    case DELONE_INT32:
      return ((const int32_t*)array->data)[i];
    case DELONE_INT64:
      return (double)((const int64_t*)array->data)[i];
    case DELONE_UINT8:
      return ((const uint8_t*)array->data)[i];
  }
  CHECK(!"an array of an unknown type");
  return 0;
}

int main(int argc, char** argv) {
  static const struct {
    const char* name;
    void (*run)(void);
  } tests[] = {{"arithmetic", arithmetic_test}, {"errors", errors_test},  {"files", files_test},
               {"hulls", hulls_test},           {"memory", memory_test},  {"objects", objects_test},
               {"periodic", periodic_test},     {"queries", queries_test}};
  size_t i;
  for (i = 0; i < sizeof tests / sizeof *tests; ++i)
    if (argc == 2 && strcmp(argv[1], tests[i].name) == 0) {
      tests[i].run();
      return 0;
    }
  fprintf(stderr, "usage: delone_c_tests NAME\n");
  return 2;
}
