# SPDX-License-Identifier: BSD-3-Clause
# The functions in the place of package geometry: what tests/geometry leaves out of its own tests, without order and options of Qhull.

cube <- as.matrix(expand.grid(c(-0.5, 0.5), c(-0.5, 0.5), c(-0.5, 0.5)))

test_that("normals of a cube are those of its facets", {
  ch <- convhulln(cube, output.options = "n")
  expect_named(ch, c("p", "hull", "normals"))
  expect_equal(nrow(ch$hull), 12)
  expect_equal(nrow(unique(ch$normals)), 6)
  expect_setequal(apply(unique(ch$normals), 1, paste, collapse = " "),
                  c("1 0 0 -0.5", "-1 0 0 -0.5", "0 1 0 -0.5", "0 -1 0 -0.5", "0 0 1 -0.5", "0 0 -1 -0.5"))
  for (i in 1:12) expect_equal(as.vector(ch$p[ch$hull[i, ], ] %*% ch$normals[i, 1:3]), rep(0.5, 3))
})

test_that("facets are polygons, in order around them", {
  hull <- convhulln(cube, return.non.triangulated.facets = TRUE)
  expect_equal(dim(hull), c(6L, 4L))
  for (i in 1:6) {
    steps <- cube[hull[i, c(2, 3, 4, 1)], ] - cube[hull[i, ], ]
    expect_equal(sqrt(rowSums(steps^2)), rep(1, 4))
  }
})

test_that("a square has two triangles, and repeated points are no error", {
  square <- rbind(c(0, 0), c(0, 1), c(1, 0), c(1, 1))
  t <- delaunayn(rbind(square, square), output.options = TRUE)
  expect_equal(t$areas, c(0.5, 0.5))
  expect_equal(length(unique(as.vector(t$tri))), 4)
  expect_setequal(unlist(t$neighbours), c(1, 2, -1))
  expect_equal(convhulln(rbind(square, square, c(0.5, 0.5)), "FA")$vol, 1)
  expect_equal(nrow(delaunayn(square, "Qu")), 2)
})

test_that("options of Qhull without a purpose have no effect, others are refused", {
  expect_equal(delaunayn(cube, "QJ Pp"), delaunayn(cube))
  expect_error(delaunayn(cube, "TO 'file'"), "TO", class = "delone_error_unsupported")
  expect_error(convhulln(cube, "QG0"), "QG", class = "delone_error_unsupported")
  expect_error(convhulln(cube, "QR3"), "QR3", class = "delone_error_unsupported")
})

test_that("a point that is not inside is an error", {
  normals <- convhulln(cube, "n")$normals
  expect_equal(nrow(halfspacen(normals, c(0, 0, 0))), 8)
  expect_equal(nrow(halfspacen(normals)), 8)
  expect_error(halfspacen(normals, c(0.5, 0, 0)), class = "delone_error_invalid_argument")
})

test_that("a point in two hulls is as far inside as it can be", {
  one <- convhulln(cube, "n")
  other <- convhulln(cube + 0.5, "n")
  expect_equal(feasible.point(one, other), rep(0.25, 3))
  expect_equal(feasible.point(one, other, tol = 0.2), rep(0.25, 3))
  expect_equal(feasible.point(one, other, tol = 0.3), NA)
  expect_equal(intersectn(cube, cube + 0.5)$ch$vol, 0.125)
  expect_error(intersectn(cube, cube[, 1:2]), class = "delone_error_bad_dimension")
})

test_that("simplices are searched exactly, in four dimensions too", {
  set.seed(1)
  p <- matrix(runif(160), 40)
  q <- matrix(runif(80), 20)
  t <- delaunayn(p, output.options = TRUE)
  by_rows <- tsearchn(p, t$tri, q)
  expect_equal(by_rows$idx, tsearchn(NA, t, q)$idx)
  is_in <- !is.na(by_rows$idx)
  for (i in which(is_in)) expect_equal(as.vector(by_rows$p[i, ] %*% p[t$tri[by_rows$idx[i], ], ]), q[i, ])
  expect_error(tsearchn(p, t$tri + 40L, q), class = "delone_error_invalid_argument")
  expect_error(inhulln(structure(1, convhulln = NULL), q), "no convhulln attribute")
})
