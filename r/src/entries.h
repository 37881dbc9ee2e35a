/* SPDX-License-Identifier: BSD-3-Clause */
/* The entry points, which R code calls by .Call(). Points and queries are matrices of doubles with a point in
 * each column. */
#ifndef DELONE_R_ENTRIES_H
#define DELONE_R_ENTRIES_H

#define R_NO_REMAP
#include <Rinternals.h>

SEXP delone_r_kind(SEXP pointer);
SEXP delone_r_is_alive(SEXP pointer);
SEXP delone_r_members(SEXP pointer);
SEXP delone_r_member(SEXP pointer, SEXP name, SEXP base);
SEXP delone_r_delaunay(SEXP points, SEXP list);
SEXP delone_r_furthest_site(SEXP points, SEXP list);
SEXP delone_r_regular(SEXP points, SEXP weights, SEXP list);
SEXP delone_r_convex_hull(SEXP points, SEXP list);
SEXP delone_r_halfspaces(SEXP rows, SEXP inside, SEXP list);
SEXP delone_r_voronoi(SEXP triangulation, SEXP list);
SEXP delone_r_alpha_complex(SEXP triangulation, SEXP radius, SEXP list);
SEXP delone_r_check(SEXP checked, SEXP list);
SEXP delone_r_read(SEXP path, SEXP list);
SEXP delone_r_convex_hulls(SEXP points, SEXP offsets, SEXP list);
SEXP delone_r_cells(SEXP points, SEXP cells);
SEXP delone_r_interpolator(SEXP triangulation, SEXP values, SEXP natural, SEXP smooth);
SEXP delone_r_insert(SEXP changed, SEXP rows, SEXP weights);
SEXP delone_r_remove(SEXP changed, SEXP numbers);
SEXP delone_r_move(SEXP changed, SEXP numbers, SEXP to, SEXP weights);
SEXP delone_r_write(SEXP written, SEXP path, SEXP format);
SEXP delone_r_locate(SEXP located, SEXP queries, SEXP width, SEXP list);
SEXP delone_r_nearest(SEXP triangulation, SEXP queries, SEXP count, SEXP list);
SEXP delone_r_natural_neighbors(SEXP triangulation, SEXP queries, SEXP list);
SEXP delone_r_cells_within(SEXP triangulation, SEXP queries, SEXP radius, SEXP list);
SEXP delone_r_interpolate(SEXP interpolator, SEXP queries, SEXP columns, SEXP list);
SEXP delone_r_region_volumes(SEXP diagram, SEXP low, SEXP high, SEXP regions, SEXP list);
SEXP delone_r_intersection_volumes(SEXP hulls, SEXP pairs, SEXP list);
SEXP delone_r_orientation(SEXP points);
SEXP delone_r_in_sphere(SEXP points, SEXP query);
SEXP delone_r_qhull_options(SEXP text, SEXP program);
SEXP delone_r_version(void);
SEXP delone_r_simplex_volumes(SEXP edges, SEXP dimension);

#endif
