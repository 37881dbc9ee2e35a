# SPDX-License-Identifier: BSD-3-Clause
# Objects: what they print, draw and write, and that they end.

set.seed(1)
plane <- matrix(runif(40), 20)
space <- matrix(runif(60), 20)

test_that("objects print and summarize themselves", {
  expect_output(print(delaunay(plane)), "Delaunay triangulation of 20 points in dimension 2")
  expect_output(print(convex_hull(space)), "volume")
  expect_output(print(voronoi(plane)), "20 regions")
  expect_output(print(halfspaces(rbind(c(-1, 0)))), "unbounded")
  expect_output(print(convex_hulls(list(plane))), "1 set ")
  expect_output(print(alpha_complex(plane, 0.1)), "alpha complex")
  expect_output(print(check_result(delaunay(plane))), ".")
  expect_output(print(summary(convex_hull(space))), "facets")
  expect_output(print(delaunay(cbind(1:3, 1:3))), "flat of dimension 1")
})

test_that("pictures are drawn", {
  grDevices::pdf(NULL)
  on.exit(grDevices::dev.off())
  for (x in list(delaunay(plane), delaunay(cbind(1:4, 1:4)), regular(plane, runif(20)), alpha_complex(plane, 0.2), convex_hull(plane),
                 voronoi(plane), halfspaces(rbind(c(-1, 0, 0), c(0, -1, 0), c(1, 1, -1))), halfspaces(rbind(c(-1, 0, 0), c(0, -1, 0))),
                 remove_points(delaunay(plane), 1)))
    expect_identical(plot(x, col = "grey"), x)
  expect_silent(plot(delaunay(space), axes = c(1, 3)))
  expect_silent(plot(convex_hull(space), axes = 1:2))
  expect_error(plot(delaunay(matrix(runif(40), 10))), class = "delone_error_bad_dimension")
  expect_error(plot(delaunay(plane), axes = c(1, 3)), class = "delone_error_invalid_argument")
  skip_if_not_installed("rgl")
  options(rgl.useNULL = TRUE)
  for (x in list(delaunay(space), convex_hull(space), voronoi(space))) expect_identical(plot(x, col = "grey"), x)
})

test_that("files hold results", {
  file <- tempfile(fileext = ".npz")
  t <- delaunay(plane)
  write_delone(t, file)
  again <- read_delone(file)
  expect_equal(again$hash, t$hash)
  expect_true(check_result(again)$ok)
  expect_equal(locate(again, plane)$cell, locate(again, plane)$cell)
  expect_error(read_delone("/no/such/file.npz"), class = "delone_error_cannot_open")
  expect_error(write_delone(t, file, "nonsense"), class = "delone_error_unsupported")
})

test_that("saved objects say that they are lost", {
  file <- tempfile()
  saveRDS(delaunay(plane), file)
  lost <- readRDS(file)
  expect_output(print(lost), "lost its contents")
  expect_error(lost$cells, "lost its contents")
  expect_error(locate(1, plane), class = "delone_error_invalid_argument")
})

test_that("memory is released", {
  pointers <- lapply(1:50, function(i) delaunay(plane))
  rm(pointers)
  expect_silent(gc())
})

test_that("an interrupt ends a call, and leaves nothing behind", {
  skip_on_os("windows")
  points <- matrix(runif(4e6), ncol = 4)
  system(paste0("(sleep 1; kill -INT ", Sys.getpid(), ") >/dev/null 2>&1"), wait = FALSE)
  time <- system.time(result <- tryCatch(delaunay(points), interrupt = function(e) "interrupted"))
  expect_equal(result, "interrupted")
  expect_lt(time[["elapsed"]], 60)
  expect_equal(delaunay(plane)$num_points, 20)
})
