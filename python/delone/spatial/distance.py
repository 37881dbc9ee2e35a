# SPDX-License-Identifier: BSD-3-Clause
"""The module scipy.spatial.distance itself, so that `from delone.spatial.distance import …` works where scipy is installed."""
import sys

import scipy.spatial.distance

sys.modules[__name__] = scipy.spatial.distance
