# SPDX-License-Identifier: BSD-3-Clause
# Installs the module, and beside it the library that configure has built of src/delone, if it has.
to <- file.path(R_PACKAGE_DIR, paste0("libs", R_ARCH))
dir.create(to, recursive = TRUE, showWarnings = FALSE)
file.copy(c(Sys.glob(paste0("*", SHLIB_EXT)), Sys.glob("library/libdelone_c.*")), to, overwrite = TRUE)
if (file.exists("symbols.rds")) file.copy("symbols.rds", to, overwrite = TRUE)
