# SPDX-License-Identifier: BSD-3-Clause
"""The bar that `progress=True` shows: that of tqdm where it is installed, otherwise a plain one on stderr."""
from __future__ import annotations

import sys


class Bar:
    """Called with the fraction done, which does not decrease, and closed at the end."""

    def __init__(self):
        try:
            from tqdm.auto import tqdm
        except ImportError:
            self._bar = _PlainBar()
        else:
            self._bar = tqdm(total=1.0, bar_format="{percentage:3.0f}%|{bar}| {elapsed}<{remaining}")

    def __call__(self, fraction: float) -> None:
        self._bar.update(fraction - self._bar.n)

    def close(self, is_done: bool) -> None:
        """Ends the bar: full if the work is done, where it stands if it was stopped."""
        if is_done:
            self(1.0)
        self._bar.close()


class _PlainBar:
    """What Bar needs of tqdm."""

    WIDTH = 40

    def __init__(self):
        self.n = 0.0
        self._write(0)

    def update(self, more: float) -> None:
        percent = int(100 * self.n)
        self.n += more
        if int(100 * self.n) != percent:
            self._write(int(100 * self.n))

    def close(self) -> None:
        if sys.stderr is not None:
            sys.stderr.write("\n")

    def _write(self, percent: int) -> None:
        if sys.stderr is not None:
            full = self.WIDTH * percent // 100
            sys.stderr.write(f"\r{percent:3d}%|{'#' * full}{' ' * (self.WIDTH - full)}|")
            sys.stderr.flush()
