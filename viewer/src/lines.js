// SPDX-License-Identifier: BSD-3-Clause
// Lines and points of the second draw call: eight numbers each.
import { NONE } from "./model.js";

export const KIND = { dual: 0, hull: 1, point: 2, hovered: 3, segment: 4, site: 5 };

export class Lines {
  constructor(capacity = 1024) {
    this.items = new Float32Array(8 * capacity);
    this.count = 0;
  }
  add(ax, ay, az, bx, by, bz, kind, scalar = -2) {
    if (8 * (this.count + 1) > this.items.length) {
      const larger = new Float32Array(2 * this.items.length);
      larger.set(this.items);
      this.items = larger;
    }
    this.items.set([ax, ay, az, kind, bx, by, bz, scalar], 8 * this.count++);
  }
  /** Between vertices a and b of `positions`. */
  between(positions, a, b, kind, scalar) {
    this.add(positions[4 * a], positions[4 * a + 1], positions[4 * a + 2], positions[4 * b], positions[4 * b + 1],
             positions[4 * b + 2], kind, scalar);
  }
  append(other) {
    const needed = 8 * (this.count + other.count);
    if (needed > this.items.length) {
      const larger = new Float32Array(Math.max(needed, 2 * this.items.length));
      larger.set(this.items);
      this.items = larger;
    }
    this.items.set(other.items.subarray(0, 8 * other.count), 8 * this.count);
    this.count += other.count;
  }
}

/** All points of an array of positions. */
export function pointLines(positions, kind) {
  const lines = new Lines(positions.length / 4 + 1);
  for (let v = 0; v < positions.length / 4; ++v) lines.between(positions, v, v, kind);
  return lines;
}

/** Segments: cells of two corners, or edges that the scene has besides its cells. */
export function segmentLines(positions, segments, scalars) {
  const lines = new Lines(segments.length / 2 + 1);
  for (let s = 0; s < segments.length; s += 2)
    lines.between(positions, segments[s], segments[s + 1], KIND.segment, scalars ? scalars[s / 2] : -2);
  return lines;
}

/** The edges of the hull: sides of triangles without a neighbour, or edges of the triangles with one cell only. */
export function* hullLines(model, positions) {
  const lines = new Lines();
  const { triangles } = model;
  if (model.mode === "solid") {
    for (let t = 0; t < model.numTriangles; ++t) {
      if (model.cells[1][t] !== NONE) continue;
      for (let i = 0; i < 3; ++i) {
        const a = triangles[3 * t + (i + 1) % 3], b = triangles[3 * t + (i + 2) % 3];
        if (a < b) lines.between(positions, a, b, KIND.hull);
      }
      if (t % 65536 === 0) yield;
    }
  } else if (model.scene.corners === 3) {
    const links = yield* model.facetLinks();
    for (let s = 0; s < links.length; ++s) {
      if (s % 65536 === 0) yield;
      if (links[s] !== s) continue;
      const first = s - s % 3;
      lines.between(positions, triangles[first + (s + 1) % 3], triangles[first + (s + 2) % 3], KIND.hull);
    }
  }
  return lines;
}

/** The centre of the sphere through k+1 points in R^k (k = 2, 3), or of equal power; null if there is none. */
function centerOf(points, weights, dimension) {
  const [p] = points, rows = [];
  for (let i = 1; i <= dimension; ++i) {
    const e = points[i].map((x, j) => x - p[j]);
    let right = weights[0] - weights[i];
    for (const x of e) right += x * x;
    rows.push([...e, right / 2]);
  }
  for (let c = 0; c < dimension; ++c) {
    let pivot = c;
    for (let r = c + 1; r < dimension; ++r) if (Math.abs(rows[r][c]) > Math.abs(rows[pivot][c])) pivot = r;
    if (rows[pivot][c] === 0) return null;
    [rows[c], rows[pivot]] = [rows[pivot], rows[c]];
    for (let r = 0; r < dimension; ++r) {
      if (r === c) continue;
      const factor = rows[r][c] / rows[c][c];
      for (let j = c; j <= dimension; ++j) rows[r][j] -= factor * rows[c][j];
    }
  }
  return p.map((x, c) => x + rows[c][dimension] / rows[c][c]);
}

/** The part of the line from a in direction b − a, t in [0, last], inside the box; null if there is none. */
function clipped(a, b, last, { low, high }) {
  let from = 0, to = last;
  for (let j = 0; j < a.length; ++j) {
    const step = b[j] - a[j];
    if (step === 0) {
      if (a[j] < low[j] || a[j] > high[j]) return null;
      continue;
    }
    const s = (low[j] - a[j]) / step, t = (high[j] - a[j]) / step;
    from = Math.max(from, Math.min(s, t));
    to = Math.min(to, Math.max(s, t));
  }
  return from < to ? [from, to].map((t) => a.map((x, j) => x + t * (b[j] - x))) : null;
}

/**
 * The edges of the Voronoi (or power) diagram of a triangulation of the plane or of space, inside a box: between the centres of
 * neighbouring cells, and rays across the hull. Of rounded positions: a picture, not the diagram itself.
 */
export function* dualLines(model, space) {
  const { scene } = model, d = scene.dimension, { cells, corners, numCells, weights } = scene;
  const links = yield* model.facetLinks();
  const unit = 2 * space.largest;  // weights are squares of the user's lengths
  const pointOf = (v) => Array.from(space.unit.subarray(d * v, d * v + d));
  const weightOf = (v) => (weights ? weights[v] / unit / unit : 0);
  const centers = new Float64Array(d * numCells);
  for (let cell = 0; cell < numCells; ++cell) {
    const corner = Array.from(cells.subarray(cell * corners, (cell + 1) * corners));
    const center = centerOf(corner.map(pointOf), corner.map(weightOf), d);
    centers.set(center ?? new Array(d).fill(NaN), d * cell);
    if (cell % 1024 === 0) yield;
  }
  const box = { low: space.extent.map((e) => -e / 2 - 0.1), high: space.extent.map((e) => e / 2 + 0.1) };
  const outward = furthest(cells, corners, links, centers, pointOf, d) ? -1 : 1;
  const lines = new Lines(links.length / 2 + 1), flat = d === 2 ? [0] : [];
  for (let f = 0; f < links.length; ++f) {
    const cell = Math.floor(f / corners), from = Array.from(centers.subarray(d * cell, d * cell + d));
    let part = null;
    if (links[f] > f) {
      const other = Math.floor(links[f] / corners);
      part = clipped(from, Array.from(centers.subarray(d * other, d * other + d)), 1, box);
    } else if (links[f] === f) {
      const away = normalOf(cells, corners, f, pointOf, d);
      part = clipped(from, from.map((x, j) => x + outward * away[j]), 1e3, box);
    }
    if (part) lines.add(...part[0], ...flat, ...part[1], ...flat, KIND.dual);
    if (f % 2048 === 0) yield;
  }
  return lines;
}

/** A normal of facet f, away from its cell. */
function normalOf(cells, corners, f, pointOf, d) {
  const first = f - f % corners, own = f % corners;
  const inner = pointOf(cells[first + own]), facet = [];
  for (let i = 1; i < corners; ++i) facet.push(pointOf(cells[first + (own + i) % corners]));
  const e = facet.slice(1).map((p) => p.map((x, j) => x - facet[0][j]));
  const normal = d === 2 ? [e[0][1], -e[0][0]]
    : [0, 1, 2].map((j) => e[0][(j + 1) % 3] * e[1][(j + 2) % 3] - e[0][(j + 2) % 3] * e[1][(j + 1) % 3]);
  const length = Math.hypot(...normal) || 1;
  const side = normal.reduce((sum, x, j) => sum + x * (inner[j] - facet[0][j]), 0) > 0 ? -1 : 1;
  return normal.map((x) => side * x / length);
}

/** Whether spheres contain the vertices beyond their facets: that of furthest sites. By the majority of some facets. */
function furthest(cells, corners, links, centers, pointOf, d) {
  let inside = 0, asked = 0;
  for (let f = 0; f < links.length && asked < 200; ++f) {
    if (links[f] <= f) continue;
    const cell = Math.floor(f / corners), center = centers.subarray(d * cell, d * cell + d);
    const square = (v) => pointOf(v).reduce((sum, x, j) => sum + (x - center[j]) ** 2, 0);
    ++asked;
    if (square(cells[links[f]]) < square(cells[f]) * (1 - 1e-6)) ++inside;
  }
  return 2 * inside > asked;
}
