# SPDX-License-Identifier: BSD-3-Clause
# Installs the module, and beside it the library that configure has built of src/delone.tar.gz, if it has.
to <- file.path(R_PACKAGE_DIR, paste0("libs", R_ARCH))
dir.create(to, recursive = TRUE, showWarnings = FALSE)
# The library by the name that the loader asks for.
library <- Sys.glob(c("library/libdelone_c.so.?.?", "library/libdelone_c.?.?.dylib"))
file.copy(c(Sys.glob(paste0("*", SHLIB_EXT)), library), to, overwrite = TRUE)
if (file.exists("symbols.rds")) file.copy("symbols.rds", to, overwrite = TRUE)
