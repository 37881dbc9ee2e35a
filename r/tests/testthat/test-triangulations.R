# SPDX-License-Identifier: BSD-3-Clause
# Triangulations, what is asked of them, and their changes, against definitions.

corners <- cbind(x = c(0, 4, 5, 1, 2), y = c(0, 0, 3, 4, 2))

test_that("a triangulation has its cells, from 1, and the names of its columns", {
  t <- delaunay(corners)
  expect_s3_class(t, c("delone_delaunay", "delone_triangulation", "delone_object"), exact = TRUE)
  expect_equal(dim(t$cells), c(4L, 3L))
  expect_equal(range(t$cells), c(1, 5))
  expect_equal(t$points, corners)
  expect_true(anyNA(t$neighbors))
  expect_equal(range(t$neighbors, na.rm = TRUE), c(1, 4))
  expect_equal(nrow(t$edges), 8)
  expect_true(all(c("cells", "hash") %in% names(t)))
  expect_null(t$nothing)
  expect_equal(delaunay(as.data.frame(corners))$hash, t$hash)
  expect_equal(delaunay(corners[5:1, ], threads = 2, order = "shuffled", seed = 7)$hash, t$hash)
})

test_that("degenerate points have results", {
  expect_equal(delaunay(cbind(1:4, 1:4))$affine_dimension, 1)
  expect_equal(delaunay(cbind(c(1, 1), c(2, 2)))$num_duplicates, 1)
  expect_equal(delaunay(matrix(0, 0, 2))$num_cells, 0)
  expect_equal(delaunay(c(3, 1, 2))$num_cells, 2)
  expect_true(check_result(delaunay(as.matrix(expand.grid(0:3, 0:3, 0:3))))$ok)
})

test_that("weights and furthest sites", {
  set.seed(1)
  p <- matrix(runif(40), 20)
  expect_equal(regular(p, rep(0, 20))$hash, delaunay(p)$hash)
  expect_gt(regular(p, runif(20))$num_hidden, 0)
  expect_length(regular(p, runif(20))$weights, 20)
  expect_gt(furthest_site(p)$num_hidden, 0)
})

test_that("bad points are refused by row and column", {
  error_of <- function(call) tryCatch(call, delone_error = function(e) e)
  e <- error_of(delaunay(data.frame(a = c(0, 1, NA), b = 1:3)))
  expect_equal(e$code, "not_finite")
  expect_equal(e$rows, 3)
  expect_match(conditionMessage(e), "row 3, column 'a' is NA")
  expect_s3_class(e, "delone_error_not_finite")
  expect_equal(conditionCall(e)[[1]], quote(delaunay))
  expect_equal(error_of(delaunay(rbind(c(0, 0), c(Inf, 1), c(NaN, 2))))$rows, c(2, 3))
  e <- error_of(delaunay(iris))
  expect_match(conditionMessage(e), "'Species'.*factor")
  expect_equal(e$code, "invalid_argument")
  expect_error(delaunay(letters), class = "delone_error_invalid_argument")
  expect_error(delaunay(factor(1:3)), class = "delone_error_invalid_argument")
  expect_error(delaunay(array(0, c(2, 2, 2))), class = "delone_error_bad_dimension")
  expect_error(regular(corners, 1:4), class = "delone_error_bad_dimension")
  expect_equal(error_of(regular(corners, c(1, 2, NA, 4, 5)))$rows, 3)
  expect_error(delaunay(corners, threads = "many"), class = "delone_error")
  expect_error(delaunay(corners, threads = NA), class = "delone_error_invalid_argument")
  expect_error(delaunay(corners, order = "backwards"), class = "delone_error_invalid_argument")
  expect_error(locate(delaunay(corners), c(1, 2, 3)), class = "delone_error_bad_dimension")
})

test_that("limits end constructions", {
  set.seed(1)
  expect_error(delaunay(matrix(runif(8e5), ncol = 4), time_limit = 1e-3), class = "delone_error_time_limit")
})

test_that("queries are where they are", {
  set.seed(2)
  p <- matrix(runif(300), 100)
  q <- matrix(runif(150, -0.1, 1.1), 50)
  t <- delaunay(p)
  found <- locate(t, q)
  is_in <- !is.na(found$cell)
  expect_true(any(is_in) && !all(is_in))
  expect_equal(found$kind, factor(ifelse(is_in, "inside", "outside"), levels(found$kind)))
  for (i in which(is_in)) expect_equal(as.vector(found$barycentric[i, ] %*% p[t$cells[found$cell[i], ], ]), q[i, ])
  expect_true(all(is.na(found$barycentric[!is_in, ])))
  expect_equal(as.character(locate(t, p)$kind), rep("on_vertex", 100))
  distances <- as.matrix(dist(rbind(q, p)))[1:50, 51:150]
  expect_equal(nearest(t, q, 3), unname(t(apply(distances, 1, order)[1:3, ])))
  expect_true(is.na(nearest(delaunay(corners), c(0, 0), 6)[1, 6]))
  linear <- p %*% c(1, -2, 3) + 4
  for (method in c("linear", "natural", "smooth")) {
    values <- interpolate(t, as.vector(linear), q, method)
    expect_equal(values, ifelse(is_in, q %*% c(1, -2, 3) + 4, NA), ignore_attr = TRUE)
  }
  expect_equal(dim(interpolate(t, cbind(a = linear, b = 1), q)), c(50L, 2L))
  expect_false(anyNA(interpolate(t, linear[, 1], q, outside = "nearest")))
  expect_equal(interpolate(t, linear[, 1], q, fill = -7)[!is_in], rep(-7, sum(!is_in)))
  e <- tryCatch(interpolate(t, linear[, 1], q, outside = "error"), delone_error = function(e) e)
  expect_true(all(e$rows %in% which(!is_in)))
  neighbors <- natural_neighbors(t, q)
  expect_equal(vapply(neighbors, nrow, 1L) > 0, is_in)
  i <- which(is_in)[1]
  expect_equal(as.vector(neighbors[[i]]$weight %*% p[neighbors[[i]]$row, ]), q[i, ])
})

test_that("changes make copies", {
  set.seed(3)
  p <- matrix(runif(60), 30)
  t <- delaunay(p)
  before <- t$hash
  removed <- remove_points(t, c(2, 9))
  expect_equal(removed$hash, delaunay(p[-c(2, 9), ])$hash)
  expect_true(all(is.nan(removed$points[c(2, 9), ])))
  expect_equal(c(removed$num_points, removed$num_rows), c(28, 30))
  expect_equal(remove_points(t, seq_len(30) %in% c(2, 9))$hash, removed$hash)
  moved <- p
  moved[5, ] <- c(0.5, 0.5)
  expect_equal(move_points(t, 5, c(0.5, 0.5))$hash, delaunay(moved)$hash)
  expect_equal(insert_points(t, rbind(c(2, 2), c(3, 0)))$hash, delaunay(rbind(p, c(2, 2), c(3, 0)))$hash)
  expect_equal(t$hash, before)
  w <- runif(30)
  r <- regular(p, w)
  w[1:3] <- 0.9
  expect_equal(move_points(r, 1:3, weights = rep(0.9, 3))$hash, regular(p, w)$hash)
  expect_equal(insert_points(r, c(2, 2), weights = 0)$num_points, 31)
  expect_error(remove_points(removed, 2), class = "delone_error_invalid_argument")
  expect_error(remove_points(t, 31), class = "delone_error_invalid_argument")
  expect_error(remove_points(t, 1.5), class = "delone_error_invalid_argument")
  expect_error(move_points(t, 1:2, c(0, 0)), class = "delone_error_bad_dimension")
  expect_error(insert_points(r, c(2, 2)), class = "delone_error")
  expect_error(interpolate(removed, 1:28, c(0, 0)), class = "delone_error_bad_dimension")
})

test_that("alpha complexes have the cells with small spheres", {
  set.seed(4)
  p <- matrix(runif(200), 100)
  t <- delaunay(p)
  radius <- apply(t$cells, 1, function(cell) {
    sides <- dist(p[cell, ])
    s <- sum(sides) / 2
    prod(sides) / (4 * sqrt(s * prod(s - sides)))
  })
  a <- alpha_complex(t, 0.07)
  expect_equal(a$cell_numbers, which(radius <= 0.07))
  expect_equal(a$cells, t$cells[a$cell_numbers, ])
  expect_equal(alpha_complex(p, 0.07)$boundary, a$boundary)
  expect_equal(length(a$boundary_cells), nrow(a$boundary))
  expect_true(all(locate(a, p[a$cells[, 1], ])$kind == "on_vertex"))
  expect_error(alpha_complex(t, -1), class = "delone_error_invalid_argument")
})

test_that("predicates are exact", {
  expect_equal(orientation(rbind(c(0, 0), c(1, 0), c(0, 1))), 1)
  expect_equal(orientation(rbind(c(0.1, 0.1), c(0.2, 0.2), c(0.4, 0.4))), 0)
  expect_equal(in_sphere(rbind(c(0, 0), c(1, 0), c(0, 1)), c(1, 1)), 0)
  expect_equal(in_sphere(rbind(c(0, 0), c(1, 0), c(0, 1)), c(1, 1 - 2^-53)), 1)
  expect_error(orientation(diag(2)), class = "delone_error_bad_dimension")
})
