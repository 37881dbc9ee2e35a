# SPDX-License-Identifier: BSD-3-Clause

#' Convex hulls
#'
#' The convex hull of points in any dimension, exactly.
#'
#' `x$vertices` are the rows of the extreme points, `x$facets` is a list of the extreme points of each facet, `x$equations` has a row
#' (n, c) for each facet: the outward unit normal n, and c with n x + c = 0 on the facet and < 0 inside. `x$cells` are simplices of which
#' the facets consist. `x$volume` and `x$area` have the bounds `x$volume_error` and `x$area_error`. `x$point_kinds` tells for each point
#' whether it is extreme, on the boundary, inside or a duplicate.
#' @param points a matrix or data frame with a point in each row
#' @param tolerance a distance: points that are no farther than this from the hull may be left out; 0: the exact hull. Or one number for
#'   each axis.
#' @param threads,order,seed,memory_limit,time_limit as for [delaunay()]
#' @return an object: see [members].
#' @examples
#' cube <- expand.grid(x = 0:2, y = 0:2, z = 0:2)
#' h <- convex_hull(cube)
#' h
#' c(h$volume, h$area, length(h$vertices))
#' h$facets[[1]]
#' table(h$point_kinds)
#' @export
convex_hull <- function(points, tolerance = 0, threads = NULL, order = NULL, seed = NULL, memory_limit = NULL, time_limit = NULL) {
  points <- as_points(points)
  how <- options_list(tolerance = if (length(tolerance) == 1) tolerance, axis_tolerances = if (length(tolerance) != 1) tolerance,
                      order = order, seed = seed, memory_limit = memory_limit, time_limit = time_limit, threads = threads)
  as_object(.Call(C_convex_hull, t(points), how), colnames(points))
}

#' Points in a convex hull
#'
#' @param x a convex hull made by [convex_hull()], or a matrix or data frame of points
#' @param queries a matrix or data frame with a point in each row
#' @param boundary whether points of the boundary are in the hull
#' @return `TRUE` or `FALSE` for each query, exactly.
#' @examples
#' in_hull(cbind(c(0, 1, 0), c(0, 0, 1)), rbind(c(0.2, 0.2), c(0.5, 0.5), c(1, 1)))
#' @export
in_hull <- function(x, queries, boundary = TRUE) {
  if (!inherits(x, "delone_object")) x <- convex_hull(x)
  require_class(x, "delone_hull", "convex hull")
  kind <- locate(x, queries)$kind
  kind == "inside" | (boundary & kind %in% c("on_face", "on_vertex"))
}

#' Intersections of halfspaces
#'
#' The polyhedron of all x with n x + c <= 0 for each row (n, c): its vertices, rays, edges and facets, exactly; coordinates are rounded
#' at the end.
#'
#' The result may be unbounded, flat or empty: `x$state` is `"full"`, `"flat"` or `"empty"`, and `x$bounded` tells whether there are
#' rays. `x$kinds` tells for each row whether it is a facet, touches, or is redundant.
#' @param rows a matrix or data frame of d+1 columns: a normal and an offset in each row
#' @param interior_point a point strictly inside all halfspaces; `NULL`: one is found
#' @param threads,order,seed,memory_limit,time_limit as for [delaunay()]
#' @return an object with the members `vertices`, `edges`, `rays`, `facets`, `volume` and others: see [members].
#' @examples
#' p <- halfspaces(rbind(c(-1, 0, 0), c(0, -1, 0), c(1, 1, -1)))
#' p$vertices
#' p$volume
#' @export
halfspaces <- function(rows, interior_point = NULL, threads = NULL, order = NULL, seed = NULL, memory_limit = NULL, time_limit = NULL) {
  rows <- as_points(rows, "rows")
  if (ncol(rows) < 2) raise("bad_dimension", "rows: a normal and an offset are needed, so at least two columns")
  if (!is.null(interior_point)) interior_point <- as_numbers(interior_point, ncol(rows) - 1, "interior_point")
  how <- options_list(order = order, seed = seed, memory_limit = memory_limit, time_limit = time_limit, threads = threads)
  as_object(.Call(C_halfspaces, t(rows), interior_point, how))
}

#' Many convex hulls at once
#'
#' The convex hulls of many sets of points, and the volumes of their intersections: what a loop over [convex_hull()] would give, several
#' times as fast, and shared by threads.
#'
#' `x$volumes` and `x$areas` have a number for each set, 0 for flat ones, whose `x$affine_dimensions` are lower. `x$vertices` has the
#' extreme rows of each set, `x$cells` the simplices of each boundary, `x$equations` their normals and offsets: lists with an entry for
#' each set, and rows counted within it.
#' @param sets a list of matrices or data frames with as many columns each, or one of these
#' @param groups of one matrix or data frame, a group for each row, for example a factor: the sets are the rows of each group
#' @param x hulls made by `convex_hulls()`
#' @param pairs a matrix with the numbers of two hulls in each row; `NULL`: all pairs
#' @param threads as for [delaunay()]
#' @return `convex_hulls()`: an object; `length()` is the number of hulls. `intersection_volumes()`: a number for each pair, or without
#'   pairs a symmetric matrix, with the volumes of the hulls on its diagonal. Each is off by some roundings of the sizes of the hulls.
#' @examples
#' hulls <- convex_hulls(iris[1:3], iris$Species)
#' hulls$volumes
#' intersection_volumes(hulls)
#' @export
convex_hulls <- function(sets, groups = NULL, threads = NULL) {
  if (!is.null(groups)) {
    all <- as_points(sets, "sets")
    if (length(groups) != nrow(all) || anyNA(groups)) raise("invalid_argument", "groups: one is needed for each row, and none may be NA")
    sets <- lapply(split(seq_len(nrow(all)), groups), function(rows) all[rows, , drop = FALSE])
  }
  if (!is.list(sets) || is.data.frame(sets) || !length(sets)) raise("invalid_argument", "sets: a list of matrices is needed, or groups")
  for (i in seq_along(sets)) {
    name <- paste0("set ", i)
    sets[[i]] <- as_points(sets[[i]], name)
    if (ncol(sets[[i]]) != ncol(sets[[1]]))
      raise("bad_dimension", paste0(name, " has ", ncol(sets[[i]]), " columns, and the first one ", ncol(sets[[1]])))
  }
  offsets <- as.double(cumsum(c(0, vapply(sets, nrow, 1L))))
  made <- as_object(.Call(C_convex_hulls, do.call(cbind, lapply(unname(sets), t)), offsets, options_list(threads = threads)))
  structure(list(pointer = pointer_of(made), columns = colnames(sets[[1]]), offsets = offsets, labels = names(sets)), class = class(made))
}

#' @rdname convex_hulls
#' @export
intersection_volumes <- function(x, pairs = NULL, threads = NULL) {
  require_class(x, "delone_hulls", "set of hulls: convex_hulls() makes one")
  n <- length(x)
  if (is.null(pairs)) {
    wanted <- which(upper.tri(diag(n)), arr.ind = TRUE)
  } else {
    wanted <- as_points(pairs, "pairs", 2)
    as_rows(wanted, n, "pairs")
  }
  volumes <- checked(.Call(C_intersection_volumes, pointer_of(x), t(unname(wanted)), options_list(threads = threads)))
  if (!is.null(pairs)) return(volumes)
  all <- diag(x$volumes, n)
  all[wanted] <- all[wanted[, 2:1, drop = FALSE]] <- volumes
  labels <- .subset2(x, "labels")
  if (!is.null(labels)) dimnames(all) <- list(labels, labels)
  all
}

#' @export
length.delone_hulls <- function(x) member(x, "num_hulls")

# The members of many hulls, split by hull.
member_of_hulls <- function(x, name) {
  value <- member(x, name)
  if (is.null(value) || !name %in% c("vertices", "cells", "neighbors", "equations", "points")) return(value)
  first <- .subset2(x, "offsets")
  bounds <- if (name == "points") first else member(x, if (name == "vertices") "vertex_offsets" else "cell_offsets")
  before <- switch(name, vertices = , cells = first, neighbors = bounds, rep(0, length(first)))
  lapply(setNames(seq_len(length(x)), .subset2(x, "labels")), function(i) {
    rows <- seq_len(bounds[i + 1] - bounds[i]) + bounds[i]
    part <- if (is.matrix(value)) value[rows, , drop = FALSE] else value[rows]
    if (is.integer(part)) part - as.integer(before[i]) else if (is.double(part) && before[i] > 0) part - before[i] else part
  })
}
