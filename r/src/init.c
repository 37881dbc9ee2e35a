/* SPDX-License-Identifier: BSD-3-Clause */
#include "entries.h"

#include <R_ext/Rdynload.h>

#define ENTRY(name, arguments) \
  { "C_" #name, (DL_FUNC)&delone_r_##name, arguments }

static const R_CallMethodDef entries[] = {
    ENTRY(kind, 1),
    ENTRY(is_alive, 1),
    ENTRY(members, 1),
    ENTRY(member, 3),
    ENTRY(delaunay, 2),
    ENTRY(furthest_site, 2),
    ENTRY(regular, 3),
    ENTRY(convex_hull, 2),
    ENTRY(halfspaces, 3),
    ENTRY(voronoi, 2),
    ENTRY(alpha_complex, 3),
    ENTRY(check, 2),
    ENTRY(read, 2),
    ENTRY(convex_hulls, 3),
    ENTRY(cells, 2),
    ENTRY(interpolator, 4),
    ENTRY(insert, 3),
    ENTRY(remove, 2),
    ENTRY(move, 4),
    ENTRY(write, 3),
    ENTRY(locate, 4),
    ENTRY(nearest, 4),
    ENTRY(natural_neighbors, 3),
    ENTRY(cells_within, 4),
    ENTRY(interpolate, 4),
    ENTRY(region_volumes, 5),
    ENTRY(intersection_volumes, 3),
    ENTRY(orientation, 1),
    ENTRY(in_sphere, 2),
    ENTRY(qhull_options, 2),
    ENTRY(version, 0),
    ENTRY(simplex_volumes, 2),
    {NULL, NULL, 0},
};

void R_init_delone(DllInfo* info) {
  R_registerRoutines(info, NULL, entries, NULL, NULL);
  R_useDynamicSymbols(info, FALSE);
  R_forceSymbols(info, TRUE);
}
