# SPDX-License-Identifier: BSD-3-Clause
# Times of many hulls and of intersections of all pairs, next to package geometry:  Rscript benchmarks/hulls.R [REPETITIONS]
# Needs packages delone and geometry. Prints medians in milliseconds, of processor time and of a clock, and geometry's time over delone's.
library(delone)

repetitions <- as.integer(c(commandArgs(TRUE), 5)[1])
set.seed(1)
hulls_of <- lapply(1:1000, function(i) matrix(rnorm(80), 20))
pairs_of <- lapply(1:50, function(i) matrix(rnorm(80), 20))

# Of all pairs, geometry takes every 25th: the mean of these stands for all.
sample_of_pairs <- t(utils::combn(50, 2))[seq(1, 1225, by = 25), ]
intersect_by_geometry <- function() {
  apply(sample_of_pairs, 1, function(pair) geometry::intersectn(pairs_of[[pair[1]]], pairs_of[[pair[2]]], return.chs = FALSE)$ch$vol)
}

works <- list(
  "1000 hulls of 20 points in 4D, with volumes" = list(
    geometry = function() vapply(hulls_of, function(p) geometry::convhulln(p, output.options = "FA")$vol, 1), scale = 1,
    delone = function(threads) convex_hulls(hulls_of, threads = threads)$volumes),
  "intersections of all pairs of 50 hulls in 4D" = list(
    geometry = intersect_by_geometry, scale = 1225 / nrow(sample_of_pairs),
    delone = function(threads) intersection_volumes(convex_hulls(pairs_of, threads = threads), threads = threads)))

median_times <- function(work) {
  times <- replicate(repetitions, { gc(FALSE); t <- system.time(work()); c(sum(t[c("user.self", "sys.self")]), t[["elapsed"]]) })
  1000 * apply(times, 1, stats::median)
}

ours <- works[[2]]$delone(1)[sample_of_pairs]
stopifnot(all.equal(works[[1]]$geometry(), works[[1]]$delone(1)), all.equal(intersect_by_geometry(), ours, tolerance = 1e-6))
cat(sprintf("%-48s %10s %10s %10s %8s\n", "", "processor", "clock", "ratio", "by clock"))
for (name in names(works)) {
  work <- works[[name]]
  theirs <- work$scale * median_times(work$geometry)
  cat(sprintf("%s\n%-48s %10.1f %10.1f\n", name, "  geometry", theirs[1], theirs[2]))
  for (threads in c(1, 2)) {
    own <- median_times(function() work$delone(threads))
    cat(sprintf("%-48s %10.1f %10.1f %10.1f %8.1f\n", paste0("  delone, threads = ", threads), own[1], own[2], theirs[1] / own[1], theirs[2] / own[2]))
  }
}
