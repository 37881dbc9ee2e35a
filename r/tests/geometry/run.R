# SPDX-License-Identifier: BSD-3-Clause
# Runs the tests of package geometry with the functions of delone in the place of its own:  Rscript run.R FOLDER
# FOLDER/testthat has the tests (fetch.sh). Those expectations fail that exceptions.R names, and no others.
suppressMessages({
  library(testthat)
  library(geometry)
  library(delone, warn.conflicts = FALSE)
})
here <- dirname(sub("^--file=", "", grep("^--file=", commandArgs(), value = TRUE)))
source(file.path(here, "exceptions.R"))
folder <- commandArgs(TRUE)[1]

# Also where geometry calls these functions itself.
names <- c("delaunayn", "convhulln", "halfspacen", "intersectn", "tsearch", "tsearchn", "inhulln", "feasible.point")
replace <- function(name) {
  space <- asNamespace("geometry")
  unlockBinding(name, space)
  assign(name, getExportedValue("delone", name), space)
}
invisible(lapply(names, replace))

local_edition(2)
results <- test_dir(file.path(folder, "testthat"), reporter = "silent", stop_on_failure = FALSE, package = NULL, load_package = "none",
                    env = new.env(parent = globalenv()))
failures <- list()
passed <- 0
for (result in results)
  for (one in result$results) {
    if (inherits(one, "expectation_success")) passed <- passed + 1
    if (inherits(one, c("expectation_failure", "expectation_error"))) {
      line <- if (is.null(one$srcref)) "" else trimws(paste(as.character(one$srcref), collapse = " "))
      failures[[length(failures) + 1]] <- list(file = result$file, test = result$test, line = line, message = conditionMessage(one))
    }
  }
is_of <- function(failure, exception)
  failure$file == exception$file && startsWith(failure$line, exception$line)
found <- rep(FALSE, length(exceptions))
bad <- 0
for (failure in failures) {
  which <- which(vapply(exceptions, function(exception) is_of(failure, exception), TRUE))
  found[which] <- TRUE
  if (length(which)) {
    cat("exception ", failure$file, ": ", failure$line, "\n  ", exceptions[[which[1]]]$reason, "\n", sep = "")
  } else {
    bad <- bad + 1
    cat("FAILED ", failure$file, ", ", failure$test, ": ", failure$line, "\n", failure$message, "\n", sep = "")
  }
}
for (exception in exceptions[!found]) {
  bad <- bad + 1
  cat("FAILED: ", exception$file, ": ", exception$line, " is an exception, and did not fail\n", sep = "")
}
cat(passed, " passed, ", bad, " failed\n", sep = "")
quit(status = if (bad > 0 || passed < 100) 1 else 0)
