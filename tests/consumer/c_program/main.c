/* SPDX-License-Identifier: BSD-3-Clause */
#include <delone/delone.h>

int main(void) {
  const double square[8] = {0, 0, 1, 0, 1, 1, 0, 1};
  delone_object* triangulation;
  delone_array cells;
  int is_right = delone_delaunay(square, 4, 2, NULL, &triangulation) == DELONE_OK &&
                 delone_get_array(triangulation, "cells", &cells) == DELONE_OK && cells.shape[0] == 2;
  delone_free(triangulation);
  return is_right ? 0 : 1;
}
