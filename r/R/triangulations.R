# SPDX-License-Identifier: BSD-3-Clause

#' Delaunay triangulations
#'
#' The Delaunay, furthest-site Delaunay and regular (weighted Delaunay) triangulation of points in any dimension.
#'
#' Every decision is exact. The result depends on the set of points alone: not on their order, nor on the number of threads. Points on
#' one sphere are triangulated in a way that is determined, too. Flat sets are triangulated in their flat, and equal rows share a
#' vertex.
#'
#' `Ctrl-C` ends a call within a fraction of a second. Objects are then as they were.
#' @param points a matrix or data frame with a point in each row. Factors, texts, `NA` and infinite numbers are refused by row.
#' @param weights a number for each point, with the unit of squared lengths
#' @param threads the most threads to use; 0: one for each core; `NULL`: the option `delone.threads`, or 1
#' @param order,seed the order of insertion: `"automatic"`, `"as_given"` or `"shuffled"`. It has no effect on the result.
#' @param memory_limit,time_limit bytes and seconds after which the construction ends with an error
#' @return an object with the members `cells`, `neighbors`, `edges`, `hull_facets`, `hash` and others: see [members].
#' @seealso [locate()], [nearest()], [interpolate()], [voronoi()], [alpha_complex()], [insert_points()]
#' @examples
#' t <- delaunay(cbind(c(0, 4, 5, 1, 2), c(0, 0, 3, 4, 2)))
#' t
#' t$cells
#' plot(t)
#' regular(matrix(runif(60), 20), weights = runif(20) / 50)$num_hidden
#' @export
delaunay <- function(points, threads = NULL, order = NULL, seed = NULL, memory_limit = NULL, time_limit = NULL) {
  points <- as_points(points)
  how <- options_list(order = order, seed = seed, memory_limit = memory_limit, time_limit = time_limit, threads = threads)
  as_object(.Call(C_delaunay, t(points), how), colnames(points))
}

#' @rdname delaunay
#' @export
furthest_site <- function(points, threads = NULL, order = NULL, seed = NULL, memory_limit = NULL, time_limit = NULL) {
  points <- as_points(points)
  how <- options_list(order = order, seed = seed, memory_limit = memory_limit, time_limit = time_limit, threads = threads)
  as_object(.Call(C_furthest_site, t(points), how), colnames(points))
}

#' @rdname delaunay
#' @export
regular <- function(points, weights, threads = NULL, order = NULL, seed = NULL, memory_limit = NULL, time_limit = NULL) {
  points <- as_points(points)
  weights <- as_numbers(weights, nrow(points), "weights")
  how <- options_list(order = order, seed = seed, memory_limit = memory_limit, time_limit = time_limit, threads = threads)
  as_object(.Call(C_regular, t(points), weights, how), colnames(points))
}

#' Insert, remove and move points
#'
#' A changed copy of a triangulation: exactly the triangulation of the points that it then has. `x` stays as it was.
#'
#' Rows keep their numbers: new points are the next rows, and numbers of removed rows are not used again. Their points are `NaN`.
#' @param x a triangulation made by [delaunay()], [regular()] or [furthest_site()]; for `insert_points()` also a convex hull or an
#'   intersection of halfspaces
#' @param points,to a matrix or data frame with a point in each row
#' @param rows numbers of rows, or `TRUE` for those that are meant
#' @param weights of a regular triangulation, a number for each row. `move_points(x, rows, weights = w)` changes weights only.
#' @return a triangulation, hull or intersection.
#' @examples
#' t <- delaunay(matrix(runif(40), 20))
#' fewer <- remove_points(t, c(3, 7))
#' moved <- move_points(t, 1, c(0.5, 0.5))
#' more <- insert_points(t, rbind(c(2, 2), c(3, 0)))
#' c(t$num_points, fewer$num_points, more$num_points)
#' @export
insert_points <- function(x, points, weights = NULL) {
  require_class(x, c("delone_triangulation", "delone_hull", "delone_halfspaces"), "triangulation, hull or intersection")
  points <- as_points(points, d = x$dimension + inherits(x, "delone_halfspaces"))
  if (inherits(x, "delone_regular")) weights <- as_numbers(weights, nrow(points), "weights")
  as_object(.Call(C_insert, pointer_of(x), t(points), weights), columns_of(x))
}

#' @rdname insert_points
#' @export
remove_points <- function(x, rows) {
  require_class(x, "delone_triangulation", "triangulation")
  rows <- as_rows(rows, num_rows(x))
  as_object(.Call(C_remove, pointer_of(x), rows), columns_of(x))
}

#' @rdname insert_points
#' @export
move_points <- function(x, rows, to = NULL, weights = NULL) {
  require_class(x, "delone_triangulation", "triangulation")
  rows <- as_rows(rows, num_rows(x))
  if (!is.null(to)) {
    to <- as_points(to, "to", x$dimension)
    if (nrow(to) != length(rows)) raise("bad_dimension", paste0("to: there are ", nrow(to), " points for ", length(rows), " rows"))
    to <- t(to)
  }
  if (!is.null(weights)) weights <- as_numbers(weights, length(rows), "weights")
  as_object(.Call(C_move, pointer_of(x), rows, to, weights), columns_of(x))
}

num_rows <- function(x) if (is.null(x$num_rows)) x$num_points else x$num_rows

#' Alpha complexes
#'
#' The cells of a triangulation whose spheres have at most a radius: the shape of the union of balls of that radius about the points.
#'
#' Exact. With weights, spheres are those orthogonal to the weighted points.
#' @param x a Delaunay or regular triangulation, or points
#' @param radius a number of at least 0
#' @param threads as for [delaunay()]
#' @return a triangulation of these cells with the further members `cell_numbers`, the rows of `x$cells`; `boundary`, the facets that
#'   are in one cell only, with a facet in each row, and `boundary_cells`; `singular_facets`, which are in no cell.
#' @examples
#' angle <- seq(0, 2 * pi, length.out = 41)[-1]
#' ring <- rbind(cbind(cos(angle), sin(angle)), 0.7 * cbind(cos(angle), sin(angle)))
#' a <- alpha_complex(ring, 0.25)
#' nrow(a$cells)
#' plot(a)
#' @export
alpha_complex <- function(x, radius, threads = NULL) {
  if (!inherits(x, "delone_object")) x <- delaunay(x, threads)
  require_class(x, c("delone_delaunay", "delone_regular"), "Delaunay or regular triangulation")
  if (!is.numeric(radius) || length(radius) != 1 || is.na(radius)) raise("invalid_argument", "radius: a number is needed")
  made <- as_object(.Call(C_alpha_complex, pointer_of(x), as.double(radius), options_list(threads = threads)), columns_of(x))
  class(made) <- c("delone_alpha_complex", class(made))
  made
}

# Cells that were given, for queries: a matrix with a cell in each row, numbers from 1.
given_cells <- function(points, cells, call = sys.call(-1)) {
  as_object(.Call(C_cells, t(points), t(cells)), call = call)
}
