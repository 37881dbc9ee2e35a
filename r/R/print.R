# SPDX-License-Identifier: BSD-3-Clause

number <- function(n, one, many = paste0(one, "s")) paste(format(n, big.mark = " ", scientific = FALSE), if (n == 1) one else many)

titles <- c(
  delaunay = "Delaunay triangulation", regular = "regular triangulation", furthest_site = "furthest-site Delaunay triangulation",
  triangulation = "triangulation", convex_hull = "convex hull", hull = "convex hull", halfspace_intersection = "intersection",
  intersection = "intersection", voronoi = "Voronoi diagram", power_diagram = "power diagram",
  furthest_voronoi = "furthest-site Voronoi diagram", diagram = "diagram", convex_hulls = "convex hulls", report = "check")

# What print() and summary() say.
facts <- function(x) {
  counts <- function(...) paste(c(...), collapse = ", ")
  if (inherits(x, "delone_triangulation")) {
    flat <- if (x$affine_dimension < x$dimension) paste0(" in a flat of dimension ", x$affine_dimension)
    return(c(counts(number(x$num_cells, "cell"), if (!is.null(x$num_vertices)) number(x$num_vertices, "vertex", "vertices")), flat))
  }
  if (inherits(x, "delone_hull"))
    return(c(counts(number(x$num_vertices, "vertex", "vertices"), number(x$num_facets, "facet")),
             if (!is.null(x$volume)) paste0("volume ", format(x$volume), ", area ", format(x$area))))
  if (inherits(x, "delone_halfspaces")) {
    shape <- if (x$state == "full") (if (x$bounded) "bounded" else "unbounded") else x$state
    return(counts(shape, number(x$num_vertices, "vertex", "vertices"), number(x$num_facets, "facet")))
  }
  if (inherits(x, "delone_diagram"))
    return(counts(number(x$num_regions, "region"), number(x$num_vertices, "vertex", "vertices"), number(x$num_ridges, "ridge")))
  if (inherits(x, "delone_hulls")) return(paste0("volumes from ", format(min(x$volumes)), " to ", format(max(x$volumes))))
  if (inherits(x, "delone_report"))
    return(if (x$ok) x$level_meaning else paste0(x$level_name, " is violated: ", x$violation))
  counts(names(x))
}

#' @export
format.delone_object <- function(x, ...) {
  if (!.Call(C_is_alive, pointer_of(x))) return("an object of delone that has lost its contents: it was saved or sent to another process")
  what <- if (inherits(x, "delone_alpha_complex")) "alpha complex" else titles[kind_of(x)]
  if (is.na(what)) what <- kind_of(x)
  of <- if (inherits(x, "delone_halfspaces")) number(x$num_halfspaces, "halfspace")
        else if (inherits(x, "delone_hulls")) number(length(x), "set")
        else if (!is.null(x$num_points)) number(x$num_points, "point")
  head <- paste0(what, if (!is.null(of)) paste0(" of ", of), if (!is.null(x$dimension)) paste0(" in dimension ", x$dimension))
  c(head, paste0("  ", facts(x)))
}

#' @export
print.delone_object <- function(x, ...) {
  cat(format(x), sep = "\n")
  invisible(x)
}

#' @export
summary.delone_object <- function(object, ...) {
  one <- c(
    "dimension", "affine_dimension", "num_points", "num_vertices", "num_duplicates", "num_hidden", "num_cells", "num_facets", "num_ridges",
    "num_halfspaces", "num_edges", "num_rays", "num_regions", "num_unbounded_regions", "num_hulls", "volume", "area", "hash")
  found <- intersect(one, names(object))
  structure(list(title = format(object)[1], facts = lapply(setNames(found, found), function(name) member(object, name))),
            class = "delone_summary")
}

#' @export
print.delone_summary <- function(x, ...) {
  cat(x$title, "\n", sep = "")
  names <- format(gsub("_", " ", sub("^num_", "", names(x$facts))))
  cat(paste0("  ", names, "  ", vapply(x$facts, format, "", digits = 10)), sep = "\n")
  invisible(x)
}
