# SPDX-License-Identifier: BSD-3-Clause

#' Voronoi and power diagrams
#'
#' The Voronoi diagram of points or of their triangulation; the power diagram of a regular and the furthest-site diagram of a
#' furthest-site triangulation.
#'
#' Vertices are correctly rounded, and equal ones are one. `x$regions` is a list of the vertices of each region, in which `NA` stands
#' for the direction to infinity; `x$point_region` has the region of each point.
#' @param x a triangulation, or a matrix or data frame with a point in each row
#' @param tolerance smaller ridges are left out; 0: none
#' @param threads as for [delaunay()]
#' @return an object with the members `vertices`, `regions`, `ridges`, `ridge_points`, `region_volumes` and others: see [members].
#' @examples
#' v <- voronoi(cbind(c(0, 4, 5, 1, 2), c(0, 0, 3, 4, 2)))
#' v$vertices
#' region_volumes(v, c(0, 0), c(5, 4))
#' plot(v)
#' @export
voronoi <- function(x, tolerance = 0, threads = NULL) {
  if (!inherits(x, "delone_object")) x <- delaunay(x, threads)
  require_class(x, "delone_triangulation", "triangulation")
  as_object(.Call(C_voronoi, pointer_of(x), options_list(tolerance = tolerance, threads = threads)), columns_of(x))
}

#' Volumes of regions
#'
#' The volume of each region of a diagram within a box. They add up to the volume of the box. Without a box unbounded regions have an
#' infinite volume.
#' @param x a diagram, see [voronoi()]
#' @param low,high the corners of the box, a number for each axis; `NULL`: no box
#' @param threads as for [delaunay()]
#' @return a number for each point; `NA` for points without a region of their own: duplicates and hidden points.
#' @examples
#' sum(region_volumes(voronoi(matrix(runif(20), 10)), c(0, 0), c(1, 1)))
#' @export
region_volumes <- function(x, low = NULL, high = NULL, threads = NULL) {
  require_class(x, "delone_diagram", "diagram")
  volumes <- if (is.null(low) && is.null(high)) {
    x$region_volumes
  } else {
    low <- as_numbers(low, x$dimension, "low")
    high <- as_numbers(high, x$dimension, "high")
    checked(.Call(C_region_volumes, pointer_of(x), low, high, x$num_regions, options_list(threads = threads)))
  }
  of_points <- rep(NA_real_, length(x$point_region))
  of_points[x$region_points] <- volumes
  of_points
}
