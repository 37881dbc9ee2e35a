# SPDX-License-Identifier: BSD-3-Clause
"""What pickles refer to."""


def diagram(kind, source_kind, source_state, tolerance=0.0):
    """A diagram, rebuilt from its triangulation, so that its parts have the same numbers."""
    source = source_kind.__new__(source_kind)
    source.__setstate__(source_state)
    return kind(source, tolerance=tolerance)
