/* SPDX-License-Identifier: BSD-3-Clause */
/* The C interface: all of delone for C99, and for every language that can call C.
 *
 * Objects. A product (a triangulation, a hull, a diagram), the contents of a file, a report, a list of
 * answers: each is a delone_object, made by a function that takes a `delone_object**` last, and released by
 * delone_free(). Objects keep what they need: they may be freed in any order. Arguments may be freed after
 * the call.
 *
 * Members. The members of an object are read by name, with the names that docs/formats.md and the Python
 * module use: delone_get_array(t, "cells", &a). The list is below, at delone_object; delone_member()
 * enumerates it.
 *
 * Rows. Points are named by input rows, cells by rows of the array "cells", both from 0; -1 is none. Numbers
 * in arguments and the caller's arrays of rows and cells are always int64_t. Ids in borrowed arrays are 4 or
 * 8 bytes wide, as delone_array::type tells: 4, unless the library was built for more than 2^31 ids; see
 * delone_index_bytes().
 *
 * Matrices, q x d for instance, are row-major and contiguous: one row after the other. All input is copied
 * or read before the call returns, never kept. A pointer to no elements may be NULL; others may not.
 *
 * Errors. Functions that can fail return a delone_status, DELONE_OK = 0 on success. After a failure
 * delone_error_message() says what was wrong and where, `*object` is NULL, other output is unspecified, and
 * objects are unchanged. Degenerate input (flat, duplicate, empty) is a result, not an error. No exception
 * leaves the library, and it prints nothing. A NULL argument, or an object of another kind, is
 * DELONE_INVALID_ARGUMENT (DELONE_UNSUPPORTED from delone_insert(), delone_clone(), delone_check() and
 * delone_write()). A freed object, a pointer to too few elements, and rows out of range are not detected: the
 * behavior is undefined.
 *
 * Threads. Different objects may be used in different threads. Several threads may use one object at once as
 * long as none changes it; only one may insert into it or free it, while no other uses it. The error and the
 * progress function belong to the calling thread.
 *
 * ABI. Within one major version (before 1.0: one minor) functions and constants are only added, and the one
 * struct, delone_array, stays as it is. */
#ifndef DELONE_DELONE_H
#define DELONE_DELONE_H

#include <stddef.h>
#include <stdint.h>

#if defined(_WIN32) && defined(DELONE_C_BUILD)
#define DELONE_C_API __declspec(dllexport)
#elif defined(_WIN32)
#define DELONE_C_API __declspec(dllimport)
#elif defined(__GNUC__)
#define DELONE_C_API __attribute__((visibility("default")))
#else
#define DELONE_C_API
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ---- Status, errors, progress -------------------------------------------------------------------------- */

/* The results of functions. 1 to 10 and 12 are delone::Errc of the C++ interface. */
typedef enum delone_status {
  DELONE_OK = 0,
  DELONE_NOT_FINITE = 1,       /* a number is NaN or infinite; delone_error_rows() names the rows */
  DELONE_BAD_DIMENSION = 2,    /* a dimension below 1, or different from the one expected */
  DELONE_TOO_MANY = 3,         /* the ids of this build are exhausted, or there is no memory of that size */
  DELONE_OUT_OF_MEMORY = 4,    /* an allocation failed, or a memory budget was reached */
  DELONE_CANCELLED = 5,        /* the progress function asked to stop */
  DELONE_INVALID_ARGUMENT = 6, /* NULL, an object of another kind, an unknown name, a value out of range */
  DELONE_CANNOT_OPEN = 7,      /* a file could not be opened or created */
  DELONE_BAD_FORMAT = 8,       /* a file violates its format; the message names the line or row */
  DELONE_CANNOT_WRITE = 9,     /* a file could not be written completely */
  DELONE_UNSUPPORTED = 10,     /* a format, or an operation on this kind of object, that is not available */
  DELONE_INTERNAL_ERROR = 11,  /* a fault of the library; please report it */
  DELONE_TIME_LIMIT = 12       /* a construction took longer than the option "time_limit" allows */
} delone_status;

/* The version of the library, "0.1.0". */
DELONE_C_API const char* delone_version(void);
/* The width of ids in borrowed arrays: 4 (DELONE_INT32) or 8 (DELONE_INT64). */
DELONE_C_API int delone_index_bytes(void);
/* The name of a status: "ok", "not_finite", ...; "unknown" for another number. */
DELONE_C_API const char* delone_status_name(int status);

/* The message of the last call that failed in this thread, in UTF-8; "" if none has. Valid until the next
 * failure in this thread. Languages whose tasks move between threads must read it before they yield. */
DELONE_C_API const char* delone_error_message(void);
/* The input rows that this error concerns: returns their number and, if rows is not NULL, sets *rows to them;
 * valid as long as the message. */
DELONE_C_API size_t delone_error_rows(const size_t** rows);

/* Called about every 20 ms by the thread that called the library, and by no other, with the fraction done of
 * a construction, 0 to 1 and never decreasing, or 0 if it is not known. A nonzero result stops the call,
 * which then returns DELONE_CANCELLED; short calls call it at least once. It must return: no exception, no
 * longjmp. It may call the library, but not with the object at work; such calls do not call it.
 */
typedef int (*delone_progress)(double fraction, void* user_data);

/* From now on all long calls of this thread call `progress`; NULL (the default): nothing is called. */
DELONE_C_API void delone_set_progress(delone_progress progress, void* user_data);

/* ---- Options ------------------------------------------------------------------------------------------- */

/* clang-format off */
/* Options by name. NULL always stands for the defaults. A call reads the options named in its description and
 * ignores others, so that one set may serve a whole program. Results do not depend on the first three.
 *
 *   integer  threads 1          the most threads to use; 0: one per core
 *   integer  seed 0             of the insertion order
 *   text     order "automatic"  of insertion: also "as_given", "shuffled"
 *   integer  memory_limit 0     of triangulations, hulls and intersections: the most bytes that the process may
 *                               use, OUT_OF_MEMORY beyond; 0: no limit
 *   real     time_limit 0       of the same: the most seconds to build one, TIME_LIMIT beyond; 0: none
 *   real     tolerance 0        of hulls, diagrams and queries: a distance >= 0; 0 is exact
 *   reals    axis_tolerances    of hulls and diagrams: one for each axis, in place of tolerance; count 0
 *                               (the default) removes them
 *   text     outside "fill"     of queries outside the convex hull: also "nearest", "error", "project"
 *   real     fill NaN           the value of interpolations there, for "fill"
 *   integer  up_to 0            of checks: the highest level to examine; 0: all
 *   integer  canonical 0        of checks: 1 also asks for the triangulation that ties are broken to
 *   integer  oriented 1         of checks: 0 takes cells as sets, as Qhull and SciPy have them
 *   integer  furthest_site 0    of checks of a "triangulation" whose kind is "": 1 asks for furthest sites
 *   integer  proper_faces 0     of cells of sites: 1 counts only faces with an area
 *   integer  vertices 0         of cells of sites: 1 lists their vertices and those of each face
 *   real     unit 0             of periodic sets: coordinates are multiples of it; 0: none
 *   integer  exact 0            of periodic sets: 1 refuses coordinates that are not on the grid
 *   integer  wrap 1             of periodic sets: 0 refuses points outside of the box
 *   text     format ""          of files that are read; "": by the extension
 *   text     columns            of files of points: a name, a number from 0, or a range such as 2-5. Each
 *                               call adds one; NULL removes all; none: all columns
 *   integer  skip_missing 0     of files of points: 1 leaves out rows with missing values, which are errors
 *                               otherwise
 *   integer  max_stream_bytes   the most that is read from a pipe; 4 GiB by default
 *
 * Of tiles alone:
 *
 *   integer  memory 0           bytes; 0: three quarters of what is free
 *   integer  tiles 0            their number; 0: as few as the memory allows
 *   integer  weighted 0         1: a column holds weights
 *   text     weights ""         the column of a file with the weights; "": the last
 *   integer  raw 0              N > 0: the file consists of little-endian doubles, N in a row
 *   integer  resume 1           0: start again from the beginning
 *   integer  vtu 0              1: also write tiles.pvtu and its parts */
/* clang-format on */
typedef struct delone_options delone_options;

DELONE_C_API int delone_options_new(delone_options** options);
DELONE_C_API void delone_options_free(delone_options* options); /* NULL: no effect */
/* DELONE_INVALID_ARGUMENT for an unknown name, an option of another type, and a value out of range. Texts are
 * copied. delone_set_integer() may set a real option. */
DELONE_C_API int delone_set_integer(delone_options* options, const char* name, int64_t value);
DELONE_C_API int delone_set_real(delone_options* options, const char* name, double value);
DELONE_C_API int delone_set_reals(delone_options* options, const char* name, const double* values,
                                  size_t count);
DELONE_C_API int delone_set_text(delone_options* options, const char* name, const char* value);

/* ---- Objects and their members ------------------------------------------------------------------------- */

/* clang-format off */
/* The kinds of objects and their members. A + marks members that the second kind also has: objects that were
 * read or given as arrays. There are n rows of d coordinates, k is the affine dimension, m the number of
 * cells. A list of lists is an array and its offsets: list i is entries offsets[i] ... offsets[i+1]-1. Arrays
 * are of doubles or of ids (see delone_index_bytes()), others as marked.
 *
 * "delaunay", "regular", "furthest_site"; "triangulation" (read, given or trimmed)
 *   integer  dimension+ affine_dimension+ num_points+ num_cells+ num_rows num_vertices num_duplicates
 *            num_hidden num_infinite_cells; num_points does not count removed rows, num_rows does
 *   text     hash+: 32 hexadecimal digits that depend on vertices and cells only
 *            kind+: "delaunay", "regular", "furthest_site", "alpha_complex", "alpha_boundary", "trimmed",
 *            "lower_hull", "upper_hull", "hull_boundary"; "" if that is unknown
 *   array    points+ n x d; weights+ n (regular); cells+ m x (k+1) rows, positively oriented when k = d;
 *            neighbors+ m x (k+1) cells: number i is opposite vertex i, -1 outside the hull;
 *            vertex_of_point+ n rows, -1: hidden; edges e x 2 rows; hull_facets h x k rows; axes k (int32);
 *            circumcenters m x d and circumradii m: of the spheres through the vertices of cells
 *            Removed rows have points that are NaN, and no vertex.
 *   trimmed: array kept (uint8), of each cell of the whole; orphans; real depth, lost_volume
 *   alpha_complex: array cell_numbers: the cells in the whole; boundary b x k rows, boundary_cells b;
 *            singular_facets s x k rows
 *
 * "periodic_delaunay", "periodic_regular" with r lattice vectors
 *   integer  dimension affine_dimension rank num_points num_vertices num_duplicates num_hidden num_cells
 *            num_ghosts is_simplicial
 *   real     displacement: the most that a coordinate has moved onto the grid
 *   text     hash; kind: "periodic_delaunay", "periodic_regular"
 *   array    points n x d; weights n (regular); lattice r x d; cells m x (k+1) rows; neighbors m x (k+1);
 *            vertex_of_point n; and int32: cell_offsets, a row of r for each entry of cells: the point is
 *            translated by that many lattice vectors; neighbor_offsets, likewise for neighbors;
 *            point_offsets n x r: how a point is translated from its vertex
 *
 * "convex_hull"; "hull" (read)
 *   integer  dimension+ affine_dimension+ num_points+ num_cells+ num_facets+ num_ridges+ num_vertices+
 *            num_duplicates
 *   real     tolerance+ max_distance+ volume volume_error area area_error
 *   text     hash; kind+: "convex_hull"
 *   array    points+ n x d; cells+ m x k rows; neighbors+ m x k; facet_of_cell+ m; facet_offsets+,
 *            facet_vertices+; ridge_facets+ r x 2; ridge_offsets+, ridge_vertices+; equations+ f x (d+1);
 *            equation_errors+ f; vertices+: the extreme rows; vertex_of_point+ n; point_kinds+ n (uint8):
 *            0 extreme, 1 boundary, 2 interior, 3 duplicate; axes+ k (int32); f_vector k (int64);
 *            axis_tolerances+ d, if they differ
 *
 * "convex_hulls"
 *   integer  dimension num_hulls
 *   array    points n x d; affine_dimensions h (int32); vertex_offsets h+1, cell_offsets h+1 (int64); vertices;
 *            cells m x d; neighbors m x d; equations m x (d+1); volumes h; areas h
 *
 * "lower_hull", "upper_hull"; c is the affine dimension of the compositions
 *   integer  dimension composition_dimension num_points num_cells num_facets
 *   real     tolerance max_distance
 *   array    cells m x (c+1) rows; neighbors m x (c+1); facet_of_cell m; vertices; composition_axes c (int32)
 *
 * "halfspace_intersection"; "intersection" (read)
 *   integer  dimension+ rank+ num_halfspaces+ num_vertices+ num_directions+ num_edges+ num_rays+ num_facets+
 *            bounded+ interior_point_is_exact+
 *   real     volume dual_volume dual_area
 *   text     state+: "full", "flat" (some points, but none strictly inside) or "empty"
 *            kind+: "halfspace_intersection"
 *   array    halfspaces+ m x (d+1); first_of_halfspace+ m; kinds+ m (uint8): 0 facet, 1 touching,
 *            2 redundant, 3 duplicate, 4 trivial; witness+; interior_point+ d; axes+ (int32);
 *            vertices+ v x d; vertex_offsets+, vertex_halfspaces+; directions+ r x d; direction_offsets+,
 *            direction_halfspaces+; edges+ e x 2; rays+ u x 2; facet_halfspaces+ f; facet_offsets+,
 *            facet_vertices+; facet_direction_offsets+, facet_directions+; lineality+ (d-k) x d;
 *            dual_points+ m x d; dual_equations+ v x (d+1)
 *
 * "voronoi", "power_diagram", "furthest_voronoi"; "diagram" (read)
 *   integer  dimension+ affine_dimension+ num_points+ num_vertices+ num_regions+ num_ridges+ num_rays+
 *            num_unbounded_regions
 *   real     tolerance+ max_displacement
 *   text     kind+: "voronoi", "power_diagram" or "furthest_voronoi"
 *   array    points+ n x d; weights+ n (power); vertices+ v x d; ridge_points+ r x 2 rows;
 *            ridge_offsets+ (int64), ridge_vertices+; region_offsets+ (int64), region_vertices+;
 *            point_region+ n; ray_vertices+ u; ray_directions+ u x d; ray_points+ u x k; region_points:
 *            the row of each region; region_volumes; ridge_volumes; axis_tolerances+ d, if they differ
 *
 * "points" (read)       integer dimension num_points; array points n x d, skipped_rows
 * "interpolator"        integer dimension columns
 * "lists" (of queries)  array offsets q+1 (int64), and the arrays that the query names
 * "site_cells"          integer dimension; array volumes, centroids, areas, num_faces, an entry for each row
 *                       (infinity and NaN for unbounded cells), neighbor_offsets (int64), neighbors (-1: a wall),
 *                       face_areas, distances, num_edges (in 3 dimensions), neighbor_lattice (int32, of
 *                       periodic sets: r numbers for each neighbor); if wanted vertex_offsets (int64), vertices
 *                       v x d, face_vertex_offsets (int64), face_vertices (numbers in the cell; -1: infinity)
 * "neighbor_changes"    integer rank (0: not periodic); array began b x 2, ended e x 2; of periodic sets
 *                       began_offsets b x r, ended_offsets e x r (int32)
 * "report" (of checks)  integer ok level ties; text level_name level_meaning violation (empty if ok is 1)
 *                       not_examined (what the data say without holding a proof; mostly empty);
 *                       array cells, points, vertices, halfspaces (int64): what the violation concerns
 *
 * "qhull_options"       integer scaled last_in_box in_cube at_infinity keep_coplanar furthest_site joggled unmerged
 *                       good_visible (0 or 1), good_row (-1: none); real centrum, roundoff (NaN: none), width
 *
 * "tiles", of t parts
 *   integer  dimension affine_dimension weighted num_points num_vertices num_duplicates num_hidden num_cells
 *            num_hull_facets num_parts
 *   text     hash
 *   array    first_cell, part_cells, part_points, part_vertices, part_foreign, part_bytes, part_crc32,
 *            part_seam_bytes, part_seam_crc32, each t (int64); of a periodic set lattice r x d
 *
 * "tile", a part
 *   integer  dimension affine_dimension num_points num_cells
 *   array    points v x d; weights; cells m x (k+1), neighbors m x (k+1) (int32); rows, seams, own_rows,
 *            vertex_of_row (int64); of a periodic set cell_offsets m x (k+1)r, seam_offsets, r of each seam
 *            (int32)
 *
 * The C++ headers data.hpp, convex_hull.hpp, voronoi.hpp, check.hpp, qhull_options.hpp and tiles.hpp describe
 * the members in full. */
/* clang-format on */
typedef struct delone_object delone_object;

/* Releases an object, which invalidates everything borrowed from it. NULL: no effect. */
DELONE_C_API void delone_free(delone_object* object);
/* A deep copy of a triangulation, hull, intersection or diagram that was made, not read. DELONE_UNSUPPORTED
 * for others. */
DELONE_C_API int delone_clone(const delone_object* object, delone_object** copy);
/* The kind of an object, as in the list above; "" for NULL. */
DELONE_C_API const char* delone_kind(const delone_object* object);

enum { DELONE_FLOAT64 = 1, DELONE_INT32 = 2, DELONE_INT64 = 3, DELONE_UINT8 = 4 }; /* of delone_array::type */

/* A borrowed array of numbers, contiguous and row-major. Valid until its object is changed or freed. */
typedef struct delone_array {
  const void* data; /* NULL if there is no element */
  int32_t type;     /* DELONE_FLOAT64, ... */
  int32_t rank;     /* 1: shape[0] numbers; 2: a matrix of shape[0] rows */
  size_t shape[2];  /* shape[1] is 1 if the rank is 1 */
} delone_array;

enum { DELONE_ARRAY = 1, DELONE_INTEGER = 2, DELONE_REAL = 3, DELONE_TEXT = 4 }; /* of members */

/* The name of member number i, and in *type (if type is not NULL) its type; NULL if there is no member i. */
DELONE_C_API const char* delone_member(const delone_object* object, size_t i, int* type);

/* Members by name. DELONE_INVALID_ARGUMENT if the object has none of that name and type. Arrays and texts are
 * borrowed: they are made by the first call, at the cost of the C++ member of that name, and valid until the
 * object is changed or freed. Making them may return DELONE_OUT_OF_MEMORY and DELONE_CANCELLED. */
DELONE_C_API int delone_get_array(const delone_object* object, const char* name, delone_array* array);
DELONE_C_API int delone_get_integer(const delone_object* object, const char* name, int64_t* value);
DELONE_C_API int delone_get_real(const delone_object* object, const char* name, double* value);
DELONE_C_API int delone_get_text(const delone_object* object, const char* name, const char** text);

/* ---- Products ------------------------------------------------------------------------------------------ */

/* The Delaunay, furthest-site Delaunay and regular (weighted Delaunay) triangulation of n points of R^d:
 * exact for all finite doubles, a function of the set of points. `weights`: n numbers. Options: threads,
 * seed, order, memory_limit, time_limit. Errors: NOT_FINITE, BAD_DIMENSION, TOO_MANY, OUT_OF_MEMORY,
 * TIME_LIMIT, CANCELLED. Cost: O(n) expected for uniform points of a fixed dimension, O(n^ceil(d/2)) at
 * worst. */
DELONE_C_API int delone_delaunay(const double* points, size_t num_points, int dimension,
                                 const delone_options* options, delone_object** object);
DELONE_C_API int delone_furthest_site(const double* points, size_t num_points, int dimension,
                                      const delone_options* options, delone_object** object);
DELONE_C_API int delone_regular(const double* points, const double* weights, size_t num_points, int dimension,
                                const delone_options* options, delone_object** object);

/* The same of a periodic set: n points and all their translates by `num_vectors` lattice vectors, which are
 * linearly independent rows of d numbers. Points and lattice are put on a grid of about 50 bits. One cell of
 * each class of translates is kept. Options: also unit, exact, wrap. Errors: also INVALID_ARGUMENT for a
 * singular lattice and for what the options refuse. periodic.hpp describes the results in full. */
DELONE_C_API int delone_periodic_delaunay(const double* points, size_t num_points, int dimension,
                                          const double* lattice, size_t num_vectors,
                                          const delone_options* options, delone_object** object);
DELONE_C_API int delone_periodic_regular(const double* points, const double* weights, size_t num_points,
                                         int dimension, const double* lattice, size_t num_vectors,
                                         const delone_options* options, delone_object** object);

/* The convex hull of n points of R^d. Options: those above, and tolerance: no point is farther than that from
 * the hull. Errors as above, INVALID_ARGUMENT for a tolerance that is negative, not finite, or larger than
 * the set. Or axis_tolerances: no point is farther outside along an axis than the number of that axis. */
DELONE_C_API int delone_convex_hull(const double* points, size_t num_points, int dimension,
                                    const delone_options* options, delone_object** object);

/* The convex hulls of many sets at once: set i is rows offsets[i] ... offsets[i+1]-1, and offsets has
 * num_sets + 1 entries from 0 to num_points. Options: threads. Errors as above, INVALID_ARGUMENT for the
 * offsets. */
DELONE_C_API int delone_convex_hulls(const double* points, size_t num_points, int dimension,
                                     const size_t* offsets, size_t num_sets, const delone_options* options,
                                     delone_object** object);

/* The volumes of the intersections of hulls, two each, of "convex_hulls": num_pairs x 2 numbers of hulls,
 * from 0. A volume is off by some roundings of the sizes of the hulls; 0 with a flat hull. Option: threads.
 * Errors: INVALID_ARGUMENT for a hull that there is not, OUT_OF_MEMORY, CANCELLED. */
DELONE_C_API int delone_intersection_volumes(const delone_object* hulls, const int64_t* pairs,
                                             size_t num_pairs, const delone_options* options,
                                             double* volumes);

/* The lower (upper) part of the convex hull with respect to the last coordinate, the height; the others are
 * the composition. d >= 2. Options and errors as for the convex hull. */
DELONE_C_API int delone_lower_hull(const double* points, size_t num_points, int dimension,
                                   const delone_options* options, delone_object** object);
DELONE_C_API int delone_upper_hull(const double* points, size_t num_points, int dimension,
                                   const delone_options* options, delone_object** object);

/* The intersection of halfspaces n.x + c <= 0: rows (n, c) of d+1 numbers. `interior_point`: d numbers,
 * strictly inside all of them (otherwise INVALID_ARGUMENT), or NULL: the library finds one. An intersection
 * without interior points is a result. Options and errors as for triangulations. */
DELONE_C_API int delone_halfspace_intersection(const double* halfspaces, size_t num_halfspaces, int dimension,
                                               const double* interior_point, const delone_options* options,
                                               delone_object** object);

/* The diagram of a triangulation: "voronoi" of a "delaunay", "power_diagram" of a "regular",
 * "furthest_voronoi" of a "furthest_site" one, whose ray_directions point inward. It owns its data.
 * Options: threads, tolerance or axis_tolerances: smaller vertices and ridges are left out. Errors:
 * INVALID_ARGUMENT, OUT_OF_MEMORY, CANCELLED. */
DELONE_C_API int delone_voronoi(const delone_object* triangulation, const delone_options* options,
                                delone_object** object);

/* Removes thin cells at the border of a triangulation that was made, such that every removed point is within
 * `tolerance` of a remaining cell: a "triangulation". Errors: INVALID_ARGUMENT, OUT_OF_MEMORY, CANCELLED. */
DELONE_C_API int delone_trim(const delone_object* triangulation, double tolerance, delone_object** object);

/* The alpha complex of a "delaunay" or "regular" triangulation below a radius: its cells whose spheres
 * (orthogonal spheres, if there are weights) have at most that radius, as a "triangulation". Exact. Option:
 * threads. Errors: INVALID_ARGUMENT for a radius below 0 or NaN, UNSUPPORTED, OUT_OF_MEMORY, CANCELLED. */
DELONE_C_API int delone_alpha_complex(const delone_object* triangulation, double radius,
                                      const delone_options* options, delone_object** object);

/* Adds rows to a triangulation, a convex hull or an intersection of halfspaces that was made: all or, after
 * an error, none. `rows`: num_rows x d numbers, x (d+1) for halfspaces. `weights`: num_rows numbers for
 * "regular", otherwise NULL. Both may be arrays of the object. Invalidates what was borrowed from the object,
 * and its interpolators. The next query renumbers all cells: insert in batches. Errors as for the product. */
DELONE_C_API int delone_insert(delone_object* object, const double* rows, size_t num_rows,
                               const double* weights);

/* Removes rows from a triangulation that was made, or gives them other points (`to`: num_rows x d numbers, or
 * NULL) and, in a "regular" one, other weights (num_rows numbers, or NULL): all or, after an error, none.
 * Rows keep their numbers, which are not used again. Invalidates as an insertion does. Errors:
 * INVALID_ARGUMENT for a row that does not exist or comes twice, otherwise as for the product. */
DELONE_C_API int delone_remove(delone_object* triangulation, const int64_t* rows, size_t num_rows);
DELONE_C_API int delone_move(delone_object* triangulation, const int64_t* rows, size_t num_rows,
                             const double* to, const double* weights);

/* A time step of a periodic triangulation: a new one of as many points, where those of each row have moved
 * to, with the options of the first. `weights`: of "periodic_regular", or NULL for the same. `lattice`: as
 * many vectors as before, or NULL for the same. If most points have moved little it takes about half the time
 * of a construction. `before` stays as it is. Errors: as for the construction. */
DELONE_C_API int delone_periodic_moved(const delone_object* before, const double* points, size_t num_points,
                                       const double* weights, const double* lattice, delone_object** object);

/* ---- Queries: in batches, answered exactly ------------------------------------------------------------- */

/* For triangulations, hulls and diagrams that were made; delone_locate() and delone_cells_within() also for
 * given and read cells of dimension d, which may overlap, leave gaps and be flat. `queries`: num_queries x d
 * finite numbers. Output goes to arrays of the caller. All have the option threads and the errors NOT_FINITE,
 * with the rows of the queries, INVALID_ARGUMENT, OUT_OF_MEMORY and CANCELLED. Batches are faster than single
 * queries. */

/* Where a query lies. */
enum {
  DELONE_INSIDE = 0,             /* in the interior of a cell; of a convex hull, in its interior */
  DELONE_ON_FACE = 1,            /* in the relative interior of a face of dimension 1 ... k-1 */
  DELONE_ON_VERTEX = 2,          /* equal to a vertex */
  DELONE_OUTSIDE_HULL = 3,       /* outside the convex hull, in its flat */
  DELONE_OUTSIDE_AFFINE_HULL = 4 /* not in the flat of the points (k < d) */
};

/* Locates queries; each output has an entry for each query, and may be NULL if it is not needed.
 *   cells        of a triangulation a cell that contains the query; of a convex hull one that is visible from
 *                it (outside), has it in its hyperplane (on the boundary) or lies behind it, seen from the
 *                middle (inside); of a lower or upper hull, where queries are compositions of d-1 numbers,
 *                one whose domain contains it; otherwise -1
 *   kinds        DELONE_INSIDE ...; not of lower and upper hulls
 *   barycentric  k+1 numbers each, of triangulations only: coordinates in the cell, NaN outside
 *   distances    of triangulations only: a bound on the distance of the point that answers from the query
 * Of given cells that contain a query the first is told; kinds are DELONE_OUTSIDE_HULL in no cell, and a flat
 * cell contains nothing. Options of triangulations that were made: tolerance, outside = "fill" or "project"
 * (the nearest point of the hull answers). */
DELONE_C_API int delone_locate(const delone_object* object, const double* queries, size_t num_queries,
                               const delone_options* options, int64_t* cells, uint8_t* kinds,
                               double* barycentric, double* distances);

/* The `count` nearest vertices of each query, nearest first, as rows: num_queries x count, -1 if there are
 * fewer. Of equally near ones the smaller row comes first. By power for a "regular" triangulation.
 * UNSUPPORTED for "furthest_site". */
DELONE_C_API int delone_nearest(const delone_object* triangulation, const double* queries, size_t num_queries,
                                size_t count, const delone_options* options, int64_t* rows);

/* The same for periodic triangulations; queries may be anywhere. Outputs may be NULL.
 *   cells        a cell that contains the query when it is translated by `offsets` (r numbers for each query)
 *                times the lattice vectors; -1 outside
 *   kinds, barycentric  as above
 *   rows         the nearest of all points and their translates is the point of this row, translated by
 *                `offsets`. Of equally near ones the smallest row counts, then the lexicographically smallest
 *                offset; -1 without points
 *   distances    the distance from the query, or with weights the power; NaN without points */
DELONE_C_API int delone_periodic_locate(const delone_object* triangulation, const double* queries,
                                        size_t num_queries, const delone_options* options, int64_t* cells,
                                        int32_t* offsets, uint8_t* kinds, double* barycentric);
DELONE_C_API int delone_periodic_nearest(const delone_object* triangulation, const double* queries,
                                         size_t num_queries, const delone_options* options, int64_t* rows,
                                         int32_t* offsets, double* distances);

/* Lists with the array "cells" (int64): the cells within a finite radius >= 0 of each query, increasing. All
 * such cells, and maybe some that are farther by a rounding error. */
DELONE_C_API int delone_cells_within(const delone_object* triangulation, const double* queries,
                                     size_t num_queries, double radius, const delone_options* options,
                                     delone_object** lists);

/* Lists with the arrays "rows" (int64) and "weights": the natural neighbors of each query in a "delaunay"
 * triangulation and their Sibson coordinates; none outside the hull. Options: tolerance, outside as for
 * delone_locate(). */
DELONE_C_API int delone_natural_neighbors(const delone_object* triangulation, const double* queries,
                                          size_t num_queries, const delone_options* options,
                                          delone_object** lists);

/* Interpolation of values at the points of a triangulation: num_points x columns numbers. Linear in every
 * cell; or by natural neighbors ("delaunay" only); if `smooth` is not 0, with the gradients of Sibson's
 * interpolant: num_points x columns x d numbers, or NULL: estimated. */
DELONE_C_API int delone_linear_interpolator(const delone_object* triangulation, const double* values,
                                            size_t columns, delone_object** interpolator);
DELONE_C_API int delone_natural_neighbor_interpolator(const delone_object* triangulation,
                                                      const double* values, size_t columns, int smooth,
                                                      const double* gradients, delone_object** interpolator);
/* `values`: num_queries x columns; `gradients`: num_queries x columns x d. Either may be NULL. Options:
 * outside, fill, tolerance. INVALID_ARGUMENT with the row for outside = "error", and if the triangulation has
 * changed. */
DELONE_C_API int delone_interpolate(const delone_object* interpolator, const double* queries,
                                    size_t num_queries, const delone_options* options, double* values,
                                    double* gradients);

/* Lists with the array "facets" (int64): the facets of a "convex_hull" that are strictly visible from each
 * query, increasing; none inside and outside of the flat. */
DELONE_C_API int delone_visible_facets(const delone_object* hull, const double* queries, size_t num_queries,
                                       delone_object** lists);

/* Of a lower or upper hull: its height over compositions, num_queries x (d-1); infinite outside of them. */
DELONE_C_API int delone_heights(const delone_object* hull, const double* compositions, size_t num_queries,
                                double* heights);
/* How far points (num_queries x d) are above it along the last axis, the sign exact. Option: tolerance, up to
 * which heights are 0. */
DELONE_C_API int delone_height_above(const delone_object* hull, const double* points, size_t num_queries,
                                     const delone_options* options, double* heights);

/* What options of Qhull mean, for functions that replace those that run Qhull: "qhull_options". Blanks
 * separate the options. `program`: "delaunay", "voronoi", "hull" or "halfspaces". UNSUPPORTED, with the name
 * of the option and the reason, if an option asks for a result that delone does not have. */
DELONE_C_API int delone_qhull_options(const char* text, const char* program, delone_object** object);

/* The volume of each region of a diagram that was made within the box low[j] <= x[j] <= high[j]: an
 * entry for each region. They add up to the volume of the box. Without a box: the member region_volumes.
 * Option: threads. UNSUPPORTED for d > 12. */
DELONE_C_API int delone_region_volumes(const delone_object* diagram, const double* low, const double* high,
                                       const delone_options* options, double* volumes);

/* Volumes, centroids, surfaces and neighbors of the cells of the sites of a Delaunay or regular triangulation
 * that was made, without a diagram: "site_cells". low, high: NULL, or the box that cells are clipped to; with
 * it halfspaces, num_halfspaces rows of d + 1 numbers a, c of a x + c <= 0, NULL for none. Options: threads,
 * proper_faces, vertices. Errors: INVALID_ARGUMENT, UNSUPPORTED for d > 12, OUT_OF_MEMORY, CANCELLED. */
DELONE_C_API int delone_site_cells(const delone_object* triangulation, const double* low, const double* high,
                                   const double* halfspaces, size_t num_halfspaces,
                                   const delone_options* options, delone_object** object);

/* Pairs of rows that an edge joins in one of two triangulations that were made only, both periodic or none:
 * "neighbor_changes". Each pair once, the smaller row first, sorted; of points in one place the first row
 * stands for all. Of periodic sets, the offsets say by how many of each lattice vector the second point is
 * translated. Fast where `after` is an edited clone of `before`. Errors: INVALID_ARGUMENT, BAD_DIMENSION,
 * UNSUPPORTED if offsets do not fit into 32 bits, OUT_OF_MEMORY. */
DELONE_C_API int delone_changed_neighbors(const delone_object* before, const delone_object* after,
                                          const delone_options* options, delone_object** object);

/* The sign of the orientation of d+1 points of R^d, exactly: 1 positive, -1 negative, 0 if they are in a
 * hyperplane. */
DELONE_C_API int delone_orientation(const double* points, int dimension, int* sign);
/* The side of the sphere through d+1 points that a query lies on, exactly: 1 inside, 0 on it, -1 outside.
 * INVALID_ARGUMENT if the points are in a hyperplane. */
DELONE_C_API int delone_in_sphere(const double* points, const double* query, int dimension, int* side);

/* ---- Checks and files ---------------------------------------------------------------------------------- */

/* Proves a result exactly, level after level: "report". A violation is an answer (ok is 0), not an error. The
 * levels depend on the kind of the object, see check.hpp. Options: up_to, threads; of triangulations
 * canonical, oriented, furthest_site. */
DELONE_C_API int delone_check(const delone_object* object, const delone_options* options,
                              delone_object** report);

/* A "triangulation" of the caller's cells, to be checked, hashed or written: num_cells x (k+1) rows.
 * `weights`: n numbers, or NULL. Examines only whether rows are in range (otherwise INVALID_ARGUMENT). */
DELONE_C_API int delone_triangulation_of_cells(const double* points, const double* weights, size_t num_points,
                                               int dimension, const int64_t* cells, size_t num_cells,
                                               int affine_dimension, delone_object** object);

/* The contents of a file: "triangulation", "hull", "intersection" or "diagram"; .npz, .json and .off. Paths
 * are UTF-8; "-" is standard input or output. Options: format, max_stream_bytes. Errors: CANNOT_OPEN,
 * BAD_FORMAT, BAD_DIMENSION, NOT_FINITE, UNSUPPORTED, OUT_OF_MEMORY. */
DELONE_C_API int delone_read(const char* path, const delone_options* options, delone_object** object);
/* Writes a triangulation, hull, intersection or diagram: whole, or not at all. `format`: NULL or "" for that
 * of the extension; docs/formats.md lists them. Errors: CANNOT_WRITE, UNSUPPORTED, BAD_DIMENSION,
 * INVALID_ARGUMENT. */
DELONE_C_API int delone_write(const delone_object* object, const char* path, const char* format);

/* Points of a file: .npy, .csv, .tsv, .txt, .off, .ply and others; and the rows of the file that skip_missing
 * has left out. Options: format, columns, skip_missing, threads, max_stream_bytes. Errors as for
 * delone_read(). */
DELONE_C_API int delone_read_points(const char* path, const delone_options* options, delone_object** object);
DELONE_C_API int delone_write_points(const double* points, size_t num_points, int dimension, const char* path,
                                     const char* format);

/* ---- Tiles: more points than memory -------------------------------------------------------------------- */

/* The Delaunay or regular triangulation of the points of a file, or of num_rows rows of `columns` numbers, as
 * a folder of parts: "tiles". Options: threads, format, columns, and those for tiles. Errors as for
 * triangulations and files. */
DELONE_C_API int delone_make_tiles(const char* input, const char* folder, const delone_options* options,
                                   delone_object** tiles);
DELONE_C_API int delone_make_tiles_of_points(const double* rows, size_t num_rows, int columns,
                                             const char* folder, const delone_options* options,
                                             delone_object** tiles);
/* The same of a periodic set. The lattice has `num_vectors` rows, of `dimension` numbers, or of `columns`
 * without that of the weight. Options: also unit. Errors: also as for periodic sets; UNSUPPORTED for vtu. */
DELONE_C_API int delone_make_periodic_tiles(const char* input, const double* lattice, size_t num_vectors,
                                            int dimension, const char* folder, const delone_options* options,
                                            delone_object** tiles);
DELONE_C_API int delone_make_periodic_tiles_of_points(const double* rows, size_t num_rows, int columns,
                                                      const double* lattice, size_t num_vectors,
                                                      const char* folder, const delone_options* options,
                                                      delone_object** tiles);
/* The index of a finished folder, and its part number i. Errors: CANNOT_OPEN, BAD_FORMAT. */
DELONE_C_API int delone_read_tiles(const char* folder, delone_object** tiles);
DELONE_C_API int delone_read_tile(const char* folder, size_t i, delone_object** tile);
/* Examines a folder, and if `rows` is not NULL compares it with the rows of its input. Options as for
 * delone_check(). */
DELONE_C_API int delone_check_tiles(const char* folder, const double* rows, size_t num_rows, int columns,
                                    const delone_options* options, delone_object** report);

#ifdef __cplusplus
}
#endif

#endif
