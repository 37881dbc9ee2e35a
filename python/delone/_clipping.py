# SPDX-License-Identifier: BSD-3-Clause
"""Diagrams and intersections, cut off at a box, for pictures."""
from __future__ import annotations

import numpy as np

from . import _core


def checked_box(box, dimension):
    """A box, (low, high), as it was given, or None. ValueError for anything else."""
    if box is None:
        return None
    corners = np.array(_core._doubles(box, "box"))
    if corners.shape != (2, dimension) or not np.isfinite(corners).all() or not (corners[0] < corners[1]).all():
        raise ValueError(f"box: (low, high), each of {dimension} finite numbers, low < high")
    return corners[0], corners[1]


def as_box(box, product_box):
    """The same; product_box() for None."""
    low, high = product_box()
    return (low, high) if box is None else checked_box(box, len(low))


def cut(starts, directions, length, low, high):
    """What is inside the box of the segments starts + t · directions, 0 ≤ t ≤ length: (s, 2, d)."""
    if not len(starts):
        return np.empty((0, 2, len(low)))
    with np.errstate(all="ignore"):
        at_low, at_high = (low - starts) / directions, (high - starts) / directions
        enter, leave = np.fmin(at_low, at_high), np.fmax(at_low, at_high)
        parallel = directions == 0
        is_beside = (parallel & ((starts < low) | (starts > high))).any(axis=1)
        enter[parallel], leave[parallel] = 0, length
        first, last = np.maximum(enter.max(axis=1), 0), np.minimum(leave.min(axis=1), length)
        kept = ~is_beside & (first < last) & np.isfinite(starts).all(axis=1) & np.isfinite(directions).all(axis=1)
    starts, directions = starts[kept], directions[kept]
    return np.stack([starts + first[kept, None] * directions, starts + last[kept, None] * directions], axis=1)


def cut_polygon(polygon, points, normals, offsets):
    """The part of a convex polygon in the plane where normal · (x − point) ≤ offset for all halfplanes; no corners, if there is none."""
    for point, normal, offset in zip(points, normals, offsets):
        if not len(polygon):
            break
        depth = offset - (polygon - point) @ normal
        inside, after = depth >= 0, np.roll(depth, -1)
        crosses = inside != (after >= 0)
        if not crosses.any():
            polygon = polygon if inside.all() else polygon[:0]
            continue
        share = np.divide(depth, depth - after, out=np.zeros_like(depth), where=crosses)[:, None]
        crossing = polygon + share * (np.roll(polygon, -1, axis=0) - polygon)
        polygon = np.stack([polygon, crossing], axis=1).reshape(-1, 2)[np.stack([inside, crosses], axis=1).ravel()]
    return polygon


class Bisectors:
    """The halfplanes that regions of a diagram in the plane are the intersections of. They tell what is near the sites also where
    vertices are so far away that their coordinates are rounded to much."""

    def __init__(self, diagram):
        sites = diagram.ridge_points
        self.points = diagram.points
        self.weights = diagram.weights if isinstance(diagram, _core.PowerDiagram) else None
        self.sign = -1.0 if diagram._is_furthest else 1.0
        both = np.concatenate([sites, sites[:, ::-1]])
        regions = diagram.point_region[both[:, 0]]
        self.pairs = both[np.argsort(regions, kind="stable")]
        self.first = np.append(0, np.cumsum(np.bincount(regions, minlength=diagram.num_regions)))

    def of_region(self, region):
        """(points, normals, offsets), see cut_polygon."""
        return self.of_pairs(self.pairs[self.first[region]:self.first[region + 1]])

    def of_pairs(self, pairs):
        """What is on the side of the first of two sites."""
        here, there = self.points[pairs[:, 0]], self.points[pairs[:, 1]]
        offsets = np.zeros(len(pairs)) if self.weights is None else (self.weights[pairs[:, 0]] - self.weights[pairs[:, 1]]) / 2
        return here + (there - here) / 2, self.sign * (there - here), self.sign * offsets

    def segment(self, pair, region, low, high):
        """What is inside the box of the ridge between two sites, the first that of the region: its ends, or None."""
        (point,), (normal,), (offset,) = self.of_pairs(pair[None])
        along = np.array([-normal[1], normal[0]]) / np.linalg.norm(normal)
        start = point + offset / (normal @ normal) * normal
        others = self.pairs[self.first[region]:self.first[region + 1]]
        points, normals, offsets = self.of_pairs(others[others[:, 1] != pair[1]])
        box = np.concatenate([np.eye(2), -np.eye(2)])
        slope = np.concatenate([normals, box]) @ along
        room = np.concatenate([offsets - ((start - points) * normals).sum(axis=1), np.concatenate([high, np.negative(low)]) - box @ start])
        if (room[slope == 0] < 0).any():
            return None
        with np.errstate(over="ignore"):
            first, last = (room[slope < 0] / slope[slope < 0]).max(), (room[slope > 0] / slope[slope > 0]).min()
        return np.stack([start + first * along, start + last * along]) if first < last else None


def _are_far(vertices, low, high):
    """Whether rounding has moved vertices by what one might see inside the box."""
    middle = np.asarray(low) + np.subtract(high, low) / 2
    return ~(np.abs(vertices - middle) < 1e4 * np.subtract(high, low).max()).all(axis=1)


def edges_of_diagram(diagram, low, high):
    """The edges of a diagram in the plane, or of one with k = 2 in space, cut off at the box: segments (s, 2, d)."""
    v, d, k = diagram.vertices, diagram.dimension, diagram.affine_dimension
    if k < 1 or k == 1 and d == 3:
        return np.empty((0, 2, d))
    far = np.append(_are_far(v, low, high) if d == 2 else np.zeros(len(v), dtype=bool), False)
    if k == 1:
        ends, by_bisectors = np.empty((0, 2), dtype=np.intp), np.arange(len(diagram.ridge_points))
    else:
        ends = diagram.ridge_vertices.reshape(-1, 2)
        is_far = far[ends].any(axis=1)
        by_bisectors = np.flatnonzero(is_far)
        ends = ends[(ends[:, 0] >= 0) & ~is_far]
    start = v[ends[:, 0]]
    rays = np.flatnonzero(~far[diagram.ray_vertices]) if k == 2 else np.empty(0, dtype=np.intp)
    found = [cut(start, v[ends[:, 1]] - start, 1, low, high), cut(v[diagram.ray_vertices[rays]], diagram.ray_directions[rays], np.inf, low, high)]
    if len(by_bisectors):
        bisectors = Bisectors(diagram)
        pairs = diagram.ridge_points[by_bisectors]
        segments = [bisectors.segment(pair, region, low, high) for pair, region in zip(pairs, diagram.point_region[pairs[:, 0]])]
        found.append(np.reshape([segment for segment in segments if segment is not None], (-1, 2, 2)))
    return np.concatenate(found)


def corners_of_regions(diagram, chosen, low, high):
    """The vertices of the regions with the numbers `chosen` of a diagram in the plane, a list of arrays; which of them are polygons inside
    the box. Cost: that of these regions only."""
    if not len(chosen):
        return [], np.zeros(0, dtype=bool)
    offsets = diagram.region_offsets
    counts = offsets[chosen + 1] - offsets[chosen]
    ends = np.cumsum(counts)
    ids = diagram.region_vertices[np.arange(ends[-1]) + np.repeat(offsets[chosen] - ends + counts, counts)]
    corners = diagram.vertices[ids] if diagram.num_vertices else np.zeros((len(ids), 2))
    inside = (ids >= 0) & ((corners >= low) & (corners <= high)).all(axis=1)
    outside = np.append(0, np.cumsum(~inside))
    return np.split(corners, ends[:-1]), (counts > 2) & (outside[ends] == outside[ends - counts])


def polygons_of_regions(diagram, chosen, low, high):
    """The regions with the numbers `chosen` of a diagram in the plane, cut off at the box: a list of arrays, empty ones of regions
    outside."""
    polygons, is_inside = corners_of_regions(diagram, chosen, low, high)
    whole = np.array([low, [high[0], low[1]], high, [low[0], high[1]]], dtype=float)
    bisectors = None if is_inside.all() else Bisectors(diagram)
    for i in np.flatnonzero(~is_inside):
        polygons[i] = cut_polygon(whole, *bisectors.of_region(chosen[i]))
    return polygons


def faces_of_regions(diagram, chosen):
    """In space: the polygons between chosen regions and others, and the regions that they belong to; in a plane the regions."""
    v = diagram.vertices
    if diagram.affine_dimension == 2:
        numbers = np.flatnonzero(chosen)
        return [v[diagram.region(i)] for i in numbers], numbers
    if diagram.affine_dimension < 2:
        return [], np.empty(0, dtype=np.intp)
    sides = diagram.point_region[diagram.ridge_points]
    is_chosen = chosen[sides]
    ridges = np.flatnonzero(is_chosen[:, 0] != is_chosen[:, 1])
    owners = np.where(is_chosen[ridges, 0], sides[ridges, 0], sides[ridges, 1])
    return [v[diagram.ridge(i)] for i in ridges.tolist()], owners


def bounded_part(intersection, box):
    """An intersection cut off at a box, (low, high), or at one of its own if it is unbounded: (it, the numbers of the facets that are left,
    their corners, the box)."""
    if intersection.state != "full":
        raise ValueError(f"plot: the intersection is {intersection.state}, there is nothing to draw")
    d, rows = intersection.dimension, intersection.facet_halfspaces

    def own_box():
        corners = intersection.vertices if intersection.num_vertices else intersection.interior_point[None]
        size = np.ptp(corners, axis=0).max() or max(1.0, float(np.abs(corners).max()))
        margin = 0 if intersection.is_bounded else 0.75 * size
        return corners.min(axis=0) - margin, corners.max(axis=0) + margin

    low, high = as_box(box, own_box)
    numbers = np.arange(len(rows))
    if box is not None or not intersection.is_bounded:
        sides = np.concatenate([np.c_[-np.eye(d), low], np.c_[np.eye(d), -high]])
        intersection = _core.HalfspaceIntersection(np.concatenate([intersection.halfspaces[rows], sides]))
        if intersection.state != "full":
            raise ValueError("box: no point of its interior is in the interior of the intersection")
        numbers = intersection.facet_halfspaces
    polygons = np.split(intersection.vertices[intersection.facet_vertices], intersection.facet_offsets[1:-1]) if len(numbers) else []
    return intersection, numbers[numbers < len(rows)], [polygons[i] for i in np.flatnonzero(numbers < len(rows))], (low, high)
