# SPDX-License-Identifier: BSD-3-Clause
# Functions by the names and with the arguments of package geometry.

#' In the place of package geometry
#'
#' Functions with the names, arguments and values of those of package \pkg{geometry}, on exact results: attach \pkg{delone} after
#' \pkg{geometry}, or instead of it.
#'
#' What is different:
#' \itemize{
#'   \item Simplices, facets and vertices come in another order, and facets of more than d points are divided in another way.
#'   \item Duplicates, cospherical points and other degenerate input are results, where Qhull may give up. Flat points are an error of
#'     `convhulln()` and an empty triangulation, as there.
#'   \item Of the options of Qhull, `Qu` makes `delaunayn()` a furthest-site triangulation. Those that say how Qhull deals with rounding,
#'     how it works and what it prints on the way (`Qt`, `QJ`, `Qbb`, `Qz`, `Qx`, `Tv`, `Pp` and others) have no effect. Others are
#'     refused by name, among them `TO`, which writes a file.
#'   \item `halfspacen()` and `intersectn()` do not need a feasible point. `tol` of `intersectn()` has no effect.
#'   \item `tsearchn()` is exact, in any dimension and for any simplices: of several that contain a query it tells the first. It warns of
#'     flat simplices, which contain nothing. `tsearch()` tells the last, and counts as inside what is farther by no more than 1e-12 of
#'     the extent of the points, which is what \pkg{geometry} does.
#'   \item The values of `convhulln()` can be given to `inhulln()` in the same R session only.
#' }
#' @param p a matrix or data frame with a point in each row; of `halfspacen()` a normal and an offset in each row; of `inhulln()` queries
#' @param options options of Qhull, in one text
#' @param output.options of `delaunayn()`: `"Fn"` for neighbours, `"Fa"` for volumes; of `convhulln()`: `"n"` for normals, `"FA"` for
#'   volume and area; `TRUE` for all
#' @param full `TRUE` for all output options
#' @param return.non.triangulated.facets whether rows are facets, with `NA` at their ends, or simplices
#' @param fp a point strictly inside all halfspaces; may be missing
#' @param ps1,ps2 points of two hulls
#' @param tol of `feasible.point()` how far inside all facets a point has to be
#' @param return.chs whether the result has the hulls `ch1` and `ch2`
#' @param autoscale without effect
#' @param ch,ch1,ch2 values of `convhulln()`
#' @param x,y,xi,yi of `tsearch()`: coordinates of points, and of queries. Of `tsearchn()`: `x` a matrix of points, or `NA` if `t` is a
#'   list that `delaunayn()` has returned; `xi` a matrix of queries
#' @param t a matrix with the rows of a simplex in each row
#' @param bary whether to return barycentric coordinates
#' @param method without effect
#' @param ... without effect
#' @return as in \pkg{geometry}.
#' @name geometry
#' @examples
#' p <- as.matrix(expand.grid(c(-1, 1), c(-1, 1), c(-1, 1)))
#' ch <- convhulln(p, output.options = TRUE)
#' c(ch$vol, ch$area)
#' inhulln(ch, rbind(c(0, 0, 0), c(1, 0, 0), c(2, 0, 0)))
#' intersectn(p, p + 1)$ch$vol
#' t <- delaunayn(p)
#' tsearchn(p, t, cbind(0.5, 0.2, 0.1))$idx
NULL

# The words of options of Qhull. The library knows what they mean for a program, "delaunay", "hull" or "halfspaces"; those that would
# change what is returned, and have no place here, are refused. `furthest_site` is an attribute of the words.
words_of <- function(program, ..., call = sys.call(-1)) {
  texts <- Filter(is.character, list(...))
  words <- as.character(unlist(lapply(texts, function(text) strsplit(paste(text, collapse = " "), "[ ,]+"))))
  words <- words[nzchar(words)]
  asked <- as_object(.Call(C_qhull_options, paste(words, collapse = " "), program), call = call)
  if (member(asked, "good_row") >= 0) raise("unsupported", "the option QG of Qhull is not available: all facets are returned", call = call)
  structure(words, furthest_site = member(asked, "furthest_site") == 1)
}

# Whether output is wanted: by its option, or by TRUE.
wants <- function(words, option, output.options) option %in% words || isTRUE(output.options)

#' @rdname geometry
#' @export
delaunayn <- function(p, options = NULL, output.options = NULL, full = FALSE) {
  words <- words_of("delaunay", options, output.options)
  p <- as_points(p, "p")
  made <- if (attr(words, "furthest_site")) furthest_site(p) else delaunay(p)
  d <- ncol(p)
  is_flat <- made$affine_dimension < d
  tri <- if (is_flat) matrix(0L, 0, d + 1) else made$cells
  storage.mode(tri) <- "integer"
  if (isTRUE(full)) output.options <- TRUE
  areas <- wants(words, "Fa", output.options)
  neighbours <- wants(words, "Fn", output.options)
  if (!areas && !neighbours) return(tri)
  result <- list(tri = tri)
  if (areas) result$areas <- simplex_volumes(p, tri)
  if (neighbours) {
    of <- if (is_flat) tri else made$neighbors
    of[is.na(of)] <- -1L
    result$neighbours <- lapply(seq_len(nrow(of)), function(i) of[i, ])
  }
  structure(result, class = "delaunayn", delaunayn = made)
}

simplex_volumes <- function(p, cells) {
  d <- ncol(p)
  edges <- vapply(seq_len(d), function(j) as.vector(p[cells[, -1], j] - p[cells[, 1], j]), numeric(d * nrow(cells)))
  # The edges of a cell are a matrix each: by cell, then by corner.
  edges <- aperm(array(edges, c(nrow(cells), d, d)), c(3, 2, 1))
  .Call(C_simplex_volumes, as.double(edges), d)
}

#' @rdname geometry
#' @export
convhulln <- function(p, options = "Tv", output.options = NULL, return.non.triangulated.facets = FALSE) {
  words <- words_of("hull", options, output.options)
  p <- as_points(p, "p")
  made <- convex_hull(p)
  if (made$affine_dimension < ncol(p))
    raise("invalid_argument", paste0("p: the points have no hull of dimension ", ncol(p), ", they are in a flat of dimension ", made$affine_dimension))
  hull <- if (return.non.triangulated.facets) padded(facets_in_order(made)) else made$cells
  storage.mode(hull) <- "integer"
  measures <- wants(words, "FA", output.options)
  normals <- wants(words, "n", output.options)
  if (!measures && !normals) return(structure(hull, convhulln = made))
  result <- list(p = p, hull = hull)
  if (measures) {
    result$area <- made$area
    result$vol <- made$volume
  }
  if (normals) result$normals <- if (return.non.triangulated.facets) made$equations else made$equations[made$facet_of_cell, , drop = FALSE]
  structure(result, class = "convhulln", convhulln = made)
}

# Rows of one length, NA at their ends.
padded <- function(lists) {
  width <- max(lengths(lists))
  do.call(rbind, lapply(lists, function(one) c(one, rep(NA_integer_, width - length(one)))))
}

# The facets of a hull; in space their vertices along the border, as the edges are the ridges.
facets_in_order <- function(made) {
  facets <- made$facets
  if (made$dimension != 3) return(facets)
  ridges <- do.call(rbind, made$ridges)
  sides <- made$ridge_facets
  lapply(seq_along(facets), function(f) {
    edges <- ridges[sides[, 1] == f | sides[, 2] == f, , drop = FALSE]
    path <- edges[1, ]
    edges <- edges[-1, , drop = FALSE]
    while (nrow(edges) > 1) {
      last <- path[length(path)]
      at <- which(edges[, 1] == last | edges[, 2] == last)[1]
      path <- c(path, sum(edges[at, ]) - last)
      edges <- edges[-at, , drop = FALSE]
    }
    path
  })
}

# What convhulln() was made of.
hull_of <- function(ch, call = sys.call(-1)) {
  made <- attr(ch, "convhulln")
  if (is.null(made)) raise("invalid_argument", "Convex hull has no convhulln attribute", call = call)
  made
}

#' @rdname geometry
#' @export
inhulln <- function(ch, p) {
  made <- hull_of(ch)
  p <- as_points(p, "p")
  if (ncol(p) != made$dimension)
    raise("bad_dimension", paste0("Number of columns in test points p (", ncol(p), ") not equal to dimension of hull (", made$dimension, ")."))
  in_hull(made, p, boundary = FALSE)
}

#' @rdname geometry
#' @export
halfspacen <- function(p, fp, options = "Tv") {
  words_of("halfspaces", options)
  made <- halfspaces(p, if (missing(fp)) NULL else fp)
  if (made$state != "full") raise("invalid_argument", "p: no point is strictly inside all halfspaces")
  made$vertices
}

#' @rdname geometry
#' @export
feasible.point <- function(ch1, ch2, tol = 0) {
  rows <- rbind(unique(hull_of(ch1)$equations), unique(hull_of(ch2)$equations))
  d <- ncol(rows) - 1
  # The points (x, t) with n x + t <= -c for all facets, and t >= tol. The farthest inside has the largest t.
  made <- halfspaces(rbind(cbind(rows[, seq_len(d), drop = FALSE], 1, rows[, d + 1]), c(rep(0, d), -1, tol)))
  if (made$state != "full") return(NA)
  made$vertices[which.max(made$vertices[, d + 1]), seq_len(d)]
}

#' @rdname geometry
#' @export
intersectn <- function(ps1, ps2, tol = 0, return.chs = TRUE, options = "Tv", fp = NULL, autoscale = FALSE) {
  words_of("hull", options)
  ch1 <- convhulln(ps1, output.options = TRUE)
  ch2 <- convhulln(ps2, output.options = TRUE)
  if (ncol(ch1$p) != ncol(ch2$p))
    raise("bad_dimension", paste0("ps2: there are ", ncol(ch2$p), " columns, and ", ncol(ch1$p), " in ps1"))
  made <- halfspaces(rbind(hull_of(ch1)$equations, hull_of(ch2)$equations), fp)
  result <- if (return.chs) list(ch1 = ch1, ch2 = ch2) else list()
  # So thin an intersection that its rounded vertices are flat has no hull.
  if (made$state == "full" && convex_hull(made$vertices)$affine_dimension == ncol(ch1$p)) {
    result$ps <- made$vertices
    result$ch <- convhulln(made$vertices, output.options = TRUE)
  } else {
    result$ps <- NA
    result$ch <- list(vol = 0)
  }
  structure(result, class = "intersectn")
}

# Simplices as a matrix of numbers of rows of n points.
as_simplices <- function(t, d, n, call = sys.call(-1)) {
  if (!is.matrix(t) || !is.numeric(t) || anyNA(t)) raise("invalid_argument", "t: a matrix of rows of points is needed", call = call)
  if (any(t != round(t))) raise("invalid_argument", "t: the triangulation does not have integer elements", call = call)
  if (ncol(t) != d + 1)
    raise("bad_dimension", paste0("t: there are ", ncol(t), " columns, and ", d + 1, " are needed"), call = call)
  bad <- t[t < 1 | t > n]
  if (length(bad)) raise("invalid_argument", paste0("t: there is no point ", bad[1], " of ", n), call = call)
  t
}

#' @rdname geometry
#' @export
tsearch <- function(x, y, t, xi, yi, bary = FALSE, method = "quadtree") {
  coordinates <- function(first, second, names) {
    if (!is.numeric(first) || !is.numeric(second) || !is.null(dim(first)) || !is.null(dim(second)))
      raise("invalid_argument", paste0(names, ": vectors of numbers are needed"), call = sys.call(-1))
    if (length(first) != length(second)) raise("bad_dimension", paste0(names, ": the lengths differ"), call = sys.call(-1))
    as_points(cbind(as.vector(first), as.vector(second)), names, 2, call = sys.call(-1))
  }
  p <- coordinates(x, y, "x, y")
  queries <- coordinates(xi, yi, "xi, yi")
  t <- as_simplices(t, 2, nrow(p))
  extent <- if (nrow(p)) max(apply(p, 2, function(column) diff(range(column)))) else 0
  found <- as_object(.Call(C_cells_within, pointer_of(given_cells(p, t)), t(queries), 1e-12 * extent, options_list()))
  offsets <- found$offsets
  idx <- as.integer(found$cells[ifelse(diff(offsets) > 0, offsets[-1], NA)])
  if (!bary) return(idx)
  list(idx = idx, p = barycentric_in_plane(p, t, queries, idx))
}

barycentric_in_plane <- function(p, t, queries, idx) {
  corner <- function(i) p[t[idx, i], , drop = FALSE] - queries
  cross <- function(a, b) a[, 1] * b[, 2] - a[, 2] * b[, 1]
  a <- corner(1)
  b <- corner(2)
  c <- corner(3)
  parts <- cbind(cross(b, c), cross(c, a), cross(a, b))
  unname(parts / rowSums(parts))
}

#' @rdname geometry
#' @export
tsearchn <- function(x, t, xi, ...) {
  if (is.list(t) || (length(x) == 1 && is.na(x))) {
    made <- attr(t, "delaunayn")
    if (is.null(made)) raise("invalid_argument", "Delaunay triangulation has no delaunayn attribute")
  } else {
    x <- as_points(x, "x")
    t <- as_simplices(t, ncol(x), nrow(x))
    flat <- sum(simplex_volumes(x, t) == 0)
    if (flat) warning(flat, " of the simplices ", if (flat == 1) "is" else "are", " flat and contain nothing")
    made <- given_cells(x, t)
  }
  found <- locate(made, xi)
  list(idx = found$cell, p = found$barycentric)
}
