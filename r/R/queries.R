# SPDX-License-Identifier: BSD-3-Clause

location_kinds <- c("inside", "on_face", "on_vertex", "outside", "outside_flat")

#' Where points lie
#'
#' Locates queries in a triangulation, an alpha complex or a convex hull, exactly.
#'
#' @param x a triangulation or a convex hull
#' @param queries a matrix or data frame with a point in each row
#' @param tolerance a distance: queries that are no farther from a cell are in it; 0: exact
#' @param threads as for [delaunay()]
#' @return a list with an entry or row for each query:
#' \describe{
#'   \item{`cell`}{of a triangulation the row of `x$cells` of a cell that contains it, or `NA`; of a hull a cell that it is before or
#'     behind.}
#'   \item{`kind`}{`"inside"` of a cell or hull, `"on_face"` or `"on_vertex"` of it, `"outside"`, or `"outside_flat"` of flat points.}
#'   \item{`barycentric`}{of triangulations, the coordinates in that cell.}
#'   \item{`distance`}{of triangulations, how far the point with these coordinates may be: 0 without a tolerance.}
#' }
#' @examples
#' t <- delaunay(cbind(c(0, 4, 5, 1, 2), c(0, 0, 3, 4, 2)))
#' locate(t, rbind(c(2, 1), c(9, 9)))
#' @export
locate <- function(x, queries, tolerance = 0, threads = NULL) {
  require_class(x, c("delone_triangulation", "delone_hull"), "triangulation or convex hull")
  queries <- as_points(queries, "queries", x$dimension)
  width <- if (inherits(x, "delone_triangulation")) x$affine_dimension + 1L else 0L
  found <- checked(.Call(C_locate, pointer_of(x), t(queries), width, options_list(tolerance = tolerance, threads = threads)))
  found$kind <- factor(location_kinds[found$kind], location_kinds)
  if (width == 0L) return(found[c("cell", "kind")])
  found$barycentric <- t(found$barycentric)
  found$barycentric[is.nan(found$barycentric)] <- NA
  found
}

#' Nearest points
#'
#' The nearest vertices of each query, exactly: by distance, of a regular triangulation by power.
#' @param x a Delaunay or regular triangulation
#' @param queries a matrix or data frame with a point in each row
#' @param k how many
#' @param threads as for [delaunay()]
#' @return a matrix with a row for each query and `k` columns: rows of points, nearest first, of equally near ones the smaller row first.
#'   `NA` if there are fewer.
#' @examples
#' t <- delaunay(matrix(runif(40), 20))
#' nearest(t, c(0.5, 0.5), k = 3)
#' @export
nearest <- function(x, queries, k = 1, threads = NULL) {
  require_class(x, "delone_triangulation", "triangulation")
  queries <- as_points(queries, "queries", x$dimension)
  if (!is.numeric(k) || length(k) != 1 || is.na(k) || k < 1) raise("invalid_argument", "k: a number of at least 1 is needed")
  found <- checked(.Call(C_nearest, pointer_of(x), t(queries), as.double(k), options_list(threads = threads)))
  matrix(found, ncol = as.integer(k), byrow = TRUE)
}

#' Natural neighbors
#'
#' The natural neighbors of each query in a Delaunay triangulation, and their Sibson coordinates.
#' @inheritParams nearest
#' @return a list with a data frame for each query, of the columns `row` and `weight`; without rows outside the hull.
#' @examples
#' natural_neighbors(delaunay(cbind(c(0, 1, 1, 0), c(0, 0, 1, 1))), c(0.25, 0.5))
#' @export
natural_neighbors <- function(x, queries, threads = NULL) {
  require_class(x, "delone_delaunay", "Delaunay triangulation")
  queries <- as_points(queries, "queries", x$dimension)
  found <- as_object(.Call(C_natural_neighbors, pointer_of(x), t(queries), options_list(threads = threads)))
  Map(function(row, weight) data.frame(row = row, weight = weight), split_at(found$rows, found$offsets), split_at(found$weights, found$offsets))
}

#' Interpolation
#'
#' Values at queries, from values at the points of a triangulation.
#' @param x a triangulation
#' @param values a number for each point; or a matrix with a row for each
#' @param queries a matrix or data frame with a point in each row
#' @param method `"linear"` in every cell; `"natural"`: by natural neighbors (Sibson); `"smooth"`: the same with gradients, which are
#'   estimated. The last two are for Delaunay triangulations.
#' @param outside what queries outside the hull have: `"fill"`: the value `fill`; `"nearest"`: that of the nearest point; `"project"`:
#'   that at the nearest point of the hull; `"error"`
#' @param fill a number
#' @param tolerance,threads as for [locate()]
#' @return a number for each query, or a matrix with a row for each if `values` is one.
#' @examples
#' p <- matrix(runif(200), 100)
#' t <- delaunay(p)
#' interpolate(t, p[, 1] + 2 * p[, 2], rbind(c(0.5, 0.5), c(2, 2)))
#' @export
interpolate <- function(x, values, queries, method = c("linear", "natural", "smooth"), outside = c("fill", "nearest", "project", "error"),
                        fill = NA_real_, tolerance = 0, threads = NULL) {
  require_class(x, "delone_triangulation", "triangulation")
  method <- match.arg(method)
  outside <- match.arg(outside)
  is_matrix <- !is.null(dim(values))
  values <- as_points(values, "values")
  if (nrow(values) != num_rows(x))
    raise("bad_dimension", paste0("values: there are ", nrow(values), " for ", num_rows(x), " points"))
  queries <- as_points(queries, "queries", x$dimension)
  by <- checked(.Call(C_interpolator, pointer_of(x), t(values), method != "linear", method == "smooth"))
  how <- options_list(outside = outside, fill = fill, tolerance = tolerance, threads = threads)
  found <- checked(.Call(C_interpolate, by, t(queries), ncol(values), how))
  if (is_matrix) `colnames<-`(t(found), colnames(values)) else as.vector(found)
}

#' Predicates
#'
#' @param points a matrix with d+1 points of d coordinates
#' @param query a point
#' @return `orientation()`: the sign of the determinant of the edges from the first point, exactly: 1 positive, 0 if the points are in a
#'   hyperplane, -1 negative. `in_sphere()`: 1 if the query is inside of the sphere through the points, 0 on it, -1 outside.
#' @examples
#' orientation(cbind(c(0, 1, 0), c(0, 0, 1)))
#' in_sphere(cbind(c(0, 1, 0), c(0, 0, 1)), c(1, 1))
#' @export
orientation <- function(points) {
  points <- as_points(points)
  if (nrow(points) != ncol(points) + 1) raise("bad_dimension", "points: one more than there are coordinates is needed")
  checked(.Call(C_orientation, t(points)))
}

#' @rdname orientation
#' @export
in_sphere <- function(points, query) {
  points <- as_points(points)
  if (nrow(points) != ncol(points) + 1) raise("bad_dimension", "points: one more than there are coordinates is needed")
  query <- as_numbers(query, ncol(points), "query")
  checked(.Call(C_in_sphere, t(points), query))
}

#' Proof of a result
#'
#' Examines a triangulation, hull, intersection or diagram exactly, level after level, also one that was read from a file.
#' @param x a result
#' @param threads as for [delaunay()]
#' @return an object with the members `ok`, `level_name`, `level_meaning` and `violation`: see [members].
#' @examples
#' check_result(delaunay(matrix(runif(20), 10)))$ok
#' @export
check_result <- function(x, threads = NULL) {
  require_class(x, "delone_object", "result")
  as_object(.Call(C_check, pointer_of(x), options_list(threads = threads)))
}

#' Files of results
#'
#' Reads and writes triangulations, hulls, intersections and diagrams: `.npz`, `.json` and `.off` both ways, and more formats to write.
#' @param x a result
#' @param file a path
#' @param format the name of the format; `""`: by the extension
#' @return `read_delone()`: an object of the arrays of the file. `write_delone()`: nothing.
#' @examples
#' file <- tempfile(fileext = ".npz")
#' write_delone(delaunay(matrix(runif(20), 10)), file)
#' read_delone(file)
#' @export
read_delone <- function(file, format = "") {
  as_object(.Call(C_read, path.expand(file), options_list(format = format)))
}

#' @rdname read_delone
#' @export
write_delone <- function(x, file, format = "") {
  require_class(x, "delone_object", "result")
  invisible(checked(.Call(C_write, pointer_of(x), path.expand(file), format)))
}

#' The version of the library
#' @return a text such as "0.1.0".
#' @export
delone_version <- function() .Call(C_version)
