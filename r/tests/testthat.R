# SPDX-License-Identifier: BSD-3-Clause
library(testthat)
library(delone)

test_check("delone")
