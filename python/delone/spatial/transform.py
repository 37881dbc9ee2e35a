# SPDX-License-Identifier: BSD-3-Clause
"""The module scipy.spatial.transform itself, so that `from delone.spatial.transform import …` works where scipy is installed."""
import sys

import scipy.spatial.transform

sys.modules[__name__] = scipy.spatial.transform
