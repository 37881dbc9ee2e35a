# SPDX-License-Identifier: BSD-3-Clause
# The expectations of geometry's tests that are not met, by the beginning of their text: they are about Qhull's order, options and
# messages. tests/testthat/test-geometry.R has what of them holds without these.
exceptions <- list(
  list(file = "test-convhulln.R", line = "expect_equal(ts$normals,",
       reason = "compares the rows of normals in the order in which Qhull lists facets"),
  list(file = "test-convhulln.R", line = "expect_error(out <- convhulln(ordination), \"QH6114",
       reason = "expects that Qhull gives up; the hull of these points is a result here"),
  list(file = "test-convhulln.R", line = "convhulln(tr, paste0(\"Fx TO '\"",
       reason = "Qhull's option TO, which prints to a file, is refused"),
  list(file = "test-delaunayn.R", line = "pst <- delaunayn(ps, paste0(\"QJ TO '\"",
       reason = "Qhull's option TO, which prints to a file, is refused"),
  list(file = "test-delaunayn.R", line = "expect_warning(tsearchn(ps, ts, cbind(1, 2, 4)))",
       reason = "expects the flat simplex that Qhull's option QJ makes; there is none here"),
  list(file = "test-delaunayn.R", line = "expect_equal(delaunayn(square), rbind(c(4, 2, 1),",
       reason = "compares the order in which Qhull lists simplices and their corners, of one of the two triangulations of a square"),
  list(file = "test-halfspacen.R", line = "expect_error(halfspacen(normals, fp), \"QH6023",
       reason = "expects the text of Qhull's error; there is one, with another text"),
  list(file = "test-tsearchn.R", line = "expect_warning(ts <- tsearchn(NA, dt, ",
       reason = "expects the warning that a search by Qhull is experimental; the search here is exact, and the values are as expected"))
