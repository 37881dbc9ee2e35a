# SPDX-License-Identifier: BSD-3-Clause
# Arguments that are points: matrices and data frames with a point in each row.

# A matrix of finite doubles, or a condition that names the row. `what` is the argument, `d` the number of columns if that is known.
as_points <- function(x, what = "points", d = NULL, finite = TRUE, call = sys.call(-1)) {
  if (is.data.frame(x)) {
    bad <- which(!vapply(x, function(column) is.numeric(column) && !is.factor(column) && is.null(dim(column)), TRUE))
    if (length(bad)) {
      kind <- class(x[[bad[1]]])[1]
      raise("invalid_argument", paste0(what, ": column '", names(x)[bad[1]], "' is no numbers but of the class ", kind), call = call)
    }
    columns <- names(x)
    x <- matrix(as.double(unlist(x, use.names = FALSE)), nrow(x), ncol(x))
    colnames(x) <- columns
  }
  if (is.factor(x) || !(is.numeric(x) || (is.logical(x) && all(is.na(x)))))
    raise("invalid_argument", paste0(what, ": a matrix of numbers is needed, not an object of the class ", class(x)[1]), call = call)
  if (is.null(dim(x))) x <- if (!is.null(d) && length(x) == d) matrix(x, 1) else matrix(x, ncol = 1)
  if (length(dim(x)) != 2) raise("bad_dimension", paste0(what, ": a matrix is needed, with a point in each row"), call = call)
  if (!is.null(d) && ncol(x) != d)
    raise("bad_dimension", paste0(what, ": there are ", ncol(x), " columns, and ", d, " are needed"), call = call)
  if (ncol(x) < 1) raise("bad_dimension", paste0(what, ": there is no column"), call = call)
  storage.mode(x) <- "double"
  if (finite) require_finite(x, what, call)
  x
}

require_finite <- function(x, what, call) {
  if (all(is.finite(x))) return(invisible())
  rows <- which(rowSums(!is.finite(x)) > 0)
  column <- which(!is.finite(x[rows[1], ]))[1]
  name <- if (is.null(colnames(x))) column else paste0("'", colnames(x)[column], "'")
  more <- if (length(rows) > 1) paste0(" (and ", length(rows) - 1, " more rows have such)") else ""
  raise("not_finite", paste0(what, ": row ", rows[1], ", column ", name, " is ", format(x[rows[1], column]), more), rows, call)
}

# One finite number for each of n rows.
as_numbers <- function(x, n, what, call = sys.call(-1)) {
  if (is.factor(x) || !is.numeric(x)) raise("invalid_argument", paste0(what, ": numbers are needed"), call = call)
  if (length(x) != n)
    raise("bad_dimension", paste0(what, ": there are ", length(x), " numbers, and ", n, " are needed"), call = call)
  require_finite(matrix(as.double(x), ncol = 1), what, call)
  as.double(x)
}

# Numbers of rows, from 1; or TRUE and FALSE for each row.
as_rows <- function(rows, n, what = "rows", call = sys.call(-1)) {
  if (is.logical(rows) && length(rows) == n && !anyNA(rows)) rows <- which(rows)
  if (!is.numeric(rows) || is.factor(rows) || anyNA(rows) || any(rows != round(rows)))
    raise("invalid_argument", paste0(what, ": numbers of rows are needed"), call = call)
  bad <- rows[rows < 1 | rows > n]
  if (length(bad)) raise("invalid_argument", paste0(what, ": there is no row ", bad[1], " of ", n), bad, call)
  as.double(rows)
}
