# SPDX-License-Identifier: BSD-3-Clause
"""Fits and medians."""
import math
import statistics


def power_law(sizes, values):
    """(k, alpha) of the line through the logarithms, values ≈ k · sizes^alpha, by least squares; None for less than two sizes."""
    points = [(math.log(x), math.log(y)) for x, y in zip(sizes, values) if x > 0 and y > 0]
    if len({x for x, _ in points}) < 2:
        return None
    mean_x = statistics.fmean(x for x, _ in points)
    mean_y = statistics.fmean(y for _, y in points)
    alpha = sum((x - mean_x) * (y - mean_y) for x, y in points) / sum((x - mean_x) ** 2 for x, _ in points)
    return math.exp(mean_y - alpha * mean_x), alpha


def median_ratio(numerators, denominators):
    """The median of the ratios of values measured in turn; None if there are none."""
    ratios = [a / b for a, b in zip(numerators, denominators) if b > 0]
    return statistics.median(ratios) if ratios else None


def extrapolate(history, points):
    """The value to expect at a larger size, from (size, value) pairs of growing size: growth as between the last two, at least
    linear, at most cubic; None without any pair."""
    if not history:
        return None
    size, value = history[-1]
    alpha = 1.0
    if len(history) > 1:
        alpha = power_law(*zip(*history[-2:]))[1] if history[-2][0] != size and history[-2][1] > 0 and value > 0 else 1.0
    return value * (points / size) ** min(max(alpha, 1.0), 3.0)
