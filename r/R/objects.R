# SPDX-License-Identifier: BSD-3-Clause
# Objects: a pointer to what the library holds. Members are read by name when they are asked for.

#' Members of results
#'
#' Triangulations, hulls, diagrams and other results hold many arrays. `x$name` reads one of them, and `names(x)` tells which there are.
#'
#' Names are those of the C interface and of the Python module. Points, cells and other items are numbered from 1, and `NA` stands
#' for none. A matrix has an item in each row. In place of the arrays with offsets that the library has, `x$facets`, `x$ridges` and
#' `x$regions` are lists of vectors.
#'
#' An object lives as long as its R session. It cannot be saved by `saveRDS()` or sent to another process: use [write_delone()].
#' @param x an object
#' @param name the name of a member
#' @return a vector, matrix, number, text or list.
#' @name members
#' @examples
#' t <- delaunay(cbind(c(0, 1, 1, 0), c(0, 0, 1, 1)))
#' names(t)
#' t$cells
#' t$hash
NULL

# Members that are numbers of something.
id_members <- c(
  "axes", "boundary", "boundary_cells", "cell_numbers", "cells", "direction_halfspaces", "edges", "facet_directions", "facet_halfspaces",
  "facet_of_cell", "facet_vertices", "first_of_halfspace", "hull_facets", "neighbors", "orphans", "point_region", "points", "rays",
  "ray_points", "ray_vertices", "region_points", "region_vertices", "ridge_facets", "ridge_points", "ridge_vertices", "rows",
  "singular_facets", "skipped_rows", "vertex_halfspaces", "vertex_of_point", "vertices", "halfspaces", "witness")

# Members that are read as lists of lists: their name, and that of the numbers.
list_members <- list(
  facets = c("facet_offsets", "facet_vertices"), ridges = c("ridge_offsets", "ridge_vertices"),
  regions = c("region_offsets", "region_vertices"))

point_kinds <- c("extreme", "boundary", "interior", "duplicate")
halfspace_kinds <- c("facet", "touching", "redundant", "duplicate", "trivial")

class_of_kind <- function(kind) {
  switch(kind,
    delaunay = , regular = , furthest_site = c(paste0("delone_", kind), "delone_triangulation"),
    triangulation = "delone_triangulation",
    convex_hull = , hull = "delone_hull",
    halfspace_intersection = , intersection = "delone_halfspaces",
    voronoi = , power_diagram = , furthest_voronoi = , diagram = "delone_diagram",
    convex_hulls = "delone_hulls",
    paste0("delone_", kind))
}

as_object <- function(pointer, columns = NULL, call = sys.call(-1)) {
  pointer <- checked(pointer, call)
  class <- class_of_kind(.Call(C_kind, pointer))
  structure(list(pointer = pointer, columns = columns), class = c(class, "delone_object"))
}

pointer_of <- function(x) .subset2(x, "pointer")
columns_of <- function(x) .subset2(x, "columns")
kind_of <- function(x) .Call(C_kind, pointer_of(x))

# Whether x is of a class; otherwise a condition.
require_class <- function(x, class, what, call = sys.call(-1)) {
  if (!inherits(x, class)) raise("invalid_argument", paste0("x is no ", what), call = call)
}

member <- function(x, name, call = sys.call(-1)) {
  value <- checked(.Call(C_member, pointer_of(x), name, name %in% id_members), call)
  if (is.null(value)) return(NULL)
  switch(name,
    point_kinds = factor(point_kinds[value + 1L], point_kinds),
    kinds = factor(halfspace_kinds[value + 1L], halfspace_kinds),
    kept = value != 0,
    bounded = , interior_point_is_exact = , ok = value != 0,
    points = if (is.null(columns_of(x))) value else `colnames<-`(value, columns_of(x)),
    value)
}

# The lists of an array and its offsets.
split_at <- function(items, offsets) {
  sizes <- diff(offsets)
  unname(split(items, factor(rep.int(seq_along(sizes), sizes), seq_along(sizes))))
}

#' @rdname members
#' @export
`$.delone_object` <- function(x, name) {
  if (inherits(x, "delone_hulls")) return(member_of_hulls(x, name))
  if (name %in% names(list_members)) {
    of <- list_members[[name]]
    items <- member(x, of[2])
    return(if (is.null(items)) NULL else split_at(items, member(x, of[1])))
  }
  member(x, name)
}

#' @rdname members
#' @export
`[[.delone_object` <- function(x, name) `$.delone_object`(x, name)

#' @rdname members
#' @export
names.delone_object <- function(x) {
  all <- .Call(C_members, pointer_of(x))
  c(all, names(list_members)[vapply(list_members, function(of) all(of %in% all), TRUE)])
}
