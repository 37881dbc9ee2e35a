/* SPDX-License-Identifier: BSD-3-Clause */
/* The floating-point state of the caller neither changes a result nor is changed. */
#include "c_test.h"

#include <fenv.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

static void flush_to_zero(void) {
#if defined(__SSE2__)
  _mm_setcsr(_mm_getcsr() | 0x8040);
#endif
}

/* 0 ... 9 times the least number, of bits. */
static void subnormal_points(double* points, size_t size) {
  size_t i;
  for (i = 0; i < size; ++i) {
    const uint64_t bits = i * i % 10;
    memcpy(points + i, &bits, sizeof bits);
  }
}

static void triangulate(char* hash, delone_object** object) {
  double points[24];
  subnormal_points(points, 24);
  OK(delone_delaunay(points, 12, 2, NULL, object));
  CHECK(get_integer(*object, "affine_dimension") == 2);
  strncpy(hash, get_text(*object, "hash"), 63);
}

void arithmetic_test(void) {
  const int modes[4] = {FE_TONEAREST, FE_UPWARD, FE_DOWNWARD, FE_TOWARDZERO};
  char expected[64] = "", found[64] = "";
  delone_object *object, *diagram, *again;
  delone_array vertices, same;
  fenv_t usual;
  int i;
  CHECK(fegetenv(&usual) == 0);
  triangulate(expected, &object);
  OK(delone_voronoi(object, NULL, &diagram));
  vertices = get_array(diagram, "vertices");
  delone_free(object);
  for (i = 0; i < 4; ++i) {
    CHECK(fesetround(modes[i]) == 0);
    flush_to_zero();
    triangulate(found, &object);
    OK(delone_voronoi(object, NULL, &again));
    same = get_array(again, "vertices");
    CHECK(fegetround() == modes[i]);
    CHECK(fesetenv(&usual) == 0);
    CHECK(strcmp(expected, found) == 0);
    CHECK(same.shape[0] == vertices.shape[0]);
    CHECK(memcmp(same.data, vertices.data, vertices.shape[0] * vertices.shape[1] * sizeof(double)) == 0);
    delone_free(again);
    delone_free(object);
  }
  delone_free(diagram);
}
