# SPDX-License-Identifier: BSD-3-Clause
# Calls of the library: options, errors as conditions, interrupts.

#' Errors of delone
#'
#' All errors that the functions of this package raise about their arguments and about limits are conditions of the class
#' `delone_error`. Each also has the class `delone_error_CODE`.
#'
#' Conditions have the fields
#' \describe{
#'   \item{`code`}{a word: `"not_finite"`, `"bad_dimension"`, `"too_many"`, `"out_of_memory"`, `"cancelled"`, `"invalid_argument"`,
#'     `"cannot_open"`, `"bad_format"`, `"cannot_write"`, `"unsupported"`, `"internal_error"` or `"time_limit"`.}
#'   \item{`rows`}{the rows of the input that it is about, counted from 1; maybe none.}
#' }
#' @name delone_error
#' @examples
#' tryCatch(delaunay(cbind(c(0, 1, NA), 0)), delone_error = function(e) c(e$code, e$rows))
NULL

raise <- function(code, message, rows = integer(), call = sys.call(-1)) {
  stop(structure(class = c(paste0("delone_error_", code), "delone_error", "error", "condition"),
                 list(message = message, call = call, code = code, rows = rows)))
}

# What an entry point has returned, or its failure as a condition.
checked <- function(result, call = sys.call(-1)) {
  if (!inherits(result, "delone_failure")) return(result)
  if (result$interrupted) interrupt()
  rows <- result$rows
  # The library counts rows from 0.
  where <- if (length(rows)) paste0(" (row ", format(rows[1], scientific = FALSE), " if rows count from 1)") else ""
  raise(result$code, paste0(result$message, where), rows, call)
}

# What R does at Ctrl-C.
interrupt <- function() {
  signalCondition(structure(class = c("interrupt", "condition"), list(message = "", call = NULL)))
  invokeRestart("abort")
}

# The options of a call by their names in the library; those that are NULL are left out.
options_list <- function(..., threads = NULL) {
  given <- list(..., threads = if (is.null(threads)) getOption("delone.threads", 1) else threads)
  given <- given[!vapply(given, is.null, TRUE)]
  for (name in names(given)) {
    value <- given[[name]]
    is_text <- is.character(value) && length(value) == 1 && !is.na(value)
    is_number <- (is.numeric(value) || is.logical(value)) && length(value) >= 1 && (name == "fill" || !anyNA(value)) &&
      (length(value) == 1 || name == "axis_tolerances")
    if (!is_text && !is_number) raise("invalid_argument", paste0(name, ": a number is needed"), call = sys.call(-2))
    given[[name]] <- if (is_text) value else as.double(value)
  }
  given
}
