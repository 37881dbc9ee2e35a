# SPDX-License-Identifier: BSD-3-Clause

#' Pictures of results
#'
#' Draws results in the plane with base graphics, and in space with package rgl if it is installed. Other dimensions are an error.
#' @param x a triangulation, hull, intersection or diagram
#' @param axes the columns of points to draw, of a set of more dimensions its projection
#' @param col,border colors: of what is filled, or of lines; of lines around it
#' @param pch the symbol of points; `NA`: none
#' @param add whether to draw into the picture that there is
#' @param ... further arguments of [plot.default()], such as `xlim` and `main`
#' @return `x`, invisibly.
#' @name plot
#' @examples
#' p <- matrix(runif(60), 30)
#' plot(delaunay(p), col = "grey90")
#' plot(convex_hull(p), add = TRUE, border = "red")
#' plot(voronoi(p), xlim = c(0, 1), ylim = c(0, 1))
NULL

# Opens a picture of points of the plane.
open_picture <- function(p, add, ..., xlab = NULL, ylab = NULL, asp = 1) {
  if (add) return(invisible())
  names <- colnames(p)
  finite <- p[is.finite(p[, 1]), , drop = FALSE]
  plot(finite, type = "n", asp = asp, xlab = if (is.null(xlab)) (if (is.null(names)) "" else names[1]) else xlab,
       ylab = if (is.null(ylab)) (if (is.null(names)) "" else names[2]) else ylab, ...)
}

require_axes <- function(x, axes, call = sys.call(-1)) {
  if (is.null(axes)) axes <- seq_len(x$dimension)
  if (length(axes) != 2 && length(axes) != 3)
    raise("bad_dimension", paste0("a set of dimension ", x$dimension, " cannot be drawn: choose two or three axes"), call = call)
  if (!is.numeric(axes) || any(!axes %in% seq_len(x$dimension)))
    raise("invalid_argument", paste0("axes: numbers from 1 to ", x$dimension, " are needed"), call = call)
  if (length(axes) == 3 && !requireNamespace("rgl", quietly = TRUE))
    raise("unsupported", "package rgl is needed to draw in space; two axes are drawn without it", call = call)
  axes
}

# Cells as polygons, each of three corners, or as lines of two.
draw_cells <- function(p, cells, col, border) {
  if (!nrow(cells)) return(invisible())
  corners <- rbind(t(cells), NA)
  if (ncol(cells) == 2) lines(p[as.vector(corners), , drop = FALSE], col = border)
  else polygon(p[as.vector(corners), , drop = FALSE], col = col, border = border)
}

# All pairs of corners of cells, once each.
edges_of <- function(cells) {
  if (ncol(cells) < 2) return(matrix(0L, 0, 2))
  pairs <- combn(ncol(cells), 2)
  edges <- do.call(rbind, lapply(seq_len(ncol(pairs)), function(i) cells[, pairs[, i], drop = FALSE]))
  unique(cbind(pmin(edges[, 1], edges[, 2]), pmax(edges[, 1], edges[, 2])))
}

draw <- function(p, cells, col, border, pch, add, ...) {
  if (ncol(p) == 3) {
    if (!add) rgl::open3d()
    if (ncol(cells) == 3) rgl::triangles3d(p[as.vector(t(cells)), , drop = FALSE], col = if (is.na(col)) "grey" else col)
    if (!is.na(border)) rgl::segments3d(p[as.vector(t(edges_of(cells))), , drop = FALSE], col = border)
    if (!is.na(pch)) rgl::points3d(p[is.finite(p[, 1]), , drop = FALSE])
    return(invisible())
  }
  open_picture(p, add, ...)
  if (ncol(cells) <= 3) draw_cells(p, cells, col, border)
  else draw_cells(p, edges_of(cells), col, border)
  if (!is.na(pch)) points(p, pch = pch)
}

#' @rdname plot
#' @export
plot.delone_triangulation <- function(x, axes = NULL, col = NA, border = "black", pch = 20, add = FALSE, ...) {
  axes <- require_axes(x, axes)
  cells <- x$cells
  if (length(axes) == 3 && ncol(cells) == 4 && !is.na(col)) cells <- if (is.null(x$hull_facets)) x$boundary else x$hull_facets
  draw(x$points[, axes, drop = FALSE], cells, col, border, pch, add, ...)
  invisible(x)
}

#' @rdname plot
#' @export
plot.delone_hull <- function(x, axes = NULL, col = NA, border = "black", pch = 20, add = FALSE, ...) {
  axes <- require_axes(x, axes)
  p <- x$points[, axes, drop = FALSE]
  if (x$dimension == 2 && !is.na(col) && x$affine_dimension == 2) {
    open_picture(p, add, ...)
    around <- x$vertices[chull(p[x$vertices, , drop = FALSE])]
    polygon(p[around, , drop = FALSE], col = col, border = border)
    if (!is.na(pch)) points(p, pch = pch)
  } else {
    draw(p, x$cells, col, border, pch, add, ...)
  }
  invisible(x)
}

#' @rdname plot
#' @export
plot.delone_halfspaces <- function(x, axes = NULL, col = NA, border = "black", pch = NA, add = FALSE, ...) {
  axes <- require_axes(x, axes)
  p <- x$vertices[, axes, drop = FALSE]
  draw(p, x$edges, col, border, pch, add, ...)
  if (length(axes) == 2 && nrow(x$rays)) {
    far <- 1e3 * max(1, abs(p))
    to <- p[x$rays[, 1], , drop = FALSE] + far * x$directions[x$rays[, 2], axes, drop = FALSE]
    segments(p[x$rays[, 1], 1], p[x$rays[, 1], 2], to[, 1], to[, 2], col = border)
  }
  invisible(x)
}

#' @rdname plot
#' @export
plot.delone_diagram <- function(x, axes = NULL, col = NA, border = "black", pch = 20, add = FALSE, ...) {
  axes <- require_axes(x, axes)
  if (x$dimension != 2 && x$dimension != 3) raise("bad_dimension", "only diagrams in the plane and in space are drawn")
  p <- x$points[, axes, drop = FALSE]
  v <- x$vertices[, axes, drop = FALSE]
  # A ridge is an edge in the plane, and a polygon in space, of which the edges between finite vertices are drawn.
  ridges <- lapply(x$ridges, function(ridge) if (x$dimension == 2 || length(ridge) < 3) ridge else c(ridge, ridge[1]))
  ends <- do.call(rbind, lapply(ridges, function(r) cbind(r[-length(r)], r[-1])))
  ends <- ends[complete.cases(ends), , drop = FALSE]
  if (length(axes) == 3) {
    draw(v, ends, col, border, NA, add)
    if (!is.na(pch)) rgl::points3d(p)
    return(invisible(x))
  }
  open_picture(p, add, ...)
  segments(v[ends[, 1], 1], v[ends[, 1], 2], v[ends[, 2], 1], v[ends[, 2], 2], col = border)
  if (length(x$ray_vertices)) {
    far <- 1e3 * max(1, abs(p[is.finite(p[, 1]), ]))
    from <- v[x$ray_vertices, , drop = FALSE]
    to <- from + far * x$ray_directions[, axes, drop = FALSE]
    segments(from[, 1], from[, 2], to[, 1], to[, 2], col = border)
  }
  if (!is.na(pch)) points(p, pch = pch)
  invisible(x)
}
