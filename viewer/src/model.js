// SPDX-License-Identifier: BSD-3-Clause
// What is drawn of a scene: triangles, each with the cells on its sides.
//
// mode "surface": a triangle is shown with its cell. "solid": where one of its two cells is shown and the other is not, which is
// the surface of what is shown. "all": with any of its cells (more than three dimensions, seen through).
import { facetTuples, linkEqual, putSmallest, putSorted } from "./facets.js";
import { between } from "./loading.js";

export const NONE = 0xffffffff;
const LARGEST = 24e6;  // triangles

/** All triples of a simplex of so many corners. */
function triples(corners) {
  const result = [];
  for (let a = 0; a < corners; ++a)
    for (let b = a + 1; b < corners; ++b)
      for (let c = b + 1; c < corners; ++c) result.push([a, b, c]);
  return result;
}

export class Model {
  /** Builds it step by step: a generator that yields the part of the work that is done, and returns the model. */
  static* of(scene) {
    const model = new Model();
    model.scene = scene;
    model.numCells = scene.numCells;
    model.mode = "surface";
    model.triangles = new Uint32Array(0);
    model.edges = null;  // of each triangle bit i: whether the side opposite corner i is an edge; null: all are
    model.cells = [null, null];  // of each triangle; null: its own number
    if (scene.corners === 0) yield* model.fromPolytopes();
    else if (scene.corners === 3) model.triangles = scene.cells;
    else if (scene.corners === 4) yield* model.fromTetrahedra();
    else if (scene.corners > 4) yield* model.fromSimplices();
    model.numTriangles = model.triangles.length / 3;
    if (scene.groups) yield* model.joinGroups();
    return model;
  }

  cellOf(triangle, side) {
    return this.cells[side] ? this.cells[side][triangle] : triangle;
  }

  /** The cell across facet i of each cell of triangles or tetrahedra: a link from facet to facet. */
  *facetLinks() {
    const { cells, corners, numVertices } = this.scene;
    this.links ??= yield* between(0.2, 1, linkEqual(yield* between(0, 0.2, facetTuples(cells, corners)), corners - 1, numVertices));
    return this.links;
  }

  *fromTetrahedra() {
    const { cells, dimension } = this.scene;
    const links = yield* between(0, 0.8, this.facetLinks());
    let count = 0;
    for (let f = 0; f < links.length; ++f) if (links[f] >= f) ++count;
    this.mode = dimension === 3 ? "solid" : "all";
    this.triangles = new Uint32Array(3 * count);
    this.cells = [new Uint32Array(count), new Uint32Array(count)];
    let at = 0;
    for (let f = 0; f < links.length; ++f) {
      if (links[f] < f) continue;
      const first = f & ~3, opposite = f & 3;
      for (let i = 1; i < 4; ++i) this.triangles[3 * at + i - 1] = cells[first + (opposite + i) % 4];
      this.cells[0][at] = f >> 2;
      this.cells[1][at] = links[f] === f ? NONE : links[f] >> 2;
      ++at;
      if (f % 65536 === 0) yield 0.8 + 0.2 * f / links.length;
    }
  }

  /** The 2-faces of simplices of five corners and more. */
  *fromSimplices() {
    const { cells, corners, numCells, numVertices } = this.scene;
    const chosen = triples(corners), per = chosen.length;
    if (numCells * per > LARGEST) throw new Error(`These are ${numCells * per} triangles: too many to show.`);
    const tuples = new Uint32Array(3 * numCells * per);
    for (let cell = 0, at = 0; cell < numCells; ++cell)
      for (const [a, b, c] of chosen) {
        putSorted(tuples, at, cells[cell * corners + a], cells[cell * corners + b], cells[cell * corners + c]);
        at += 3;
      }
    const links = yield* linkEqual(tuples, 3, numVertices);
    this.mode = "all";
    // One triangle for each cycle; its cells are those of the cycle.
    const seen = new Uint8Array(links.length), triangles = [], offsets = [0], members = [];
    for (let t = 0; t < links.length; ++t) {
      if (seen[t]) continue;
      for (let u = t; !seen[u]; u = links[u]) {
        seen[u] = 1;
        members.push(Math.floor(u / per));
      }
      triangles.push(tuples[3 * t], tuples[3 * t + 1], tuples[3 * t + 2]);
      offsets.push(members.length);
    }
    this.triangles = Uint32Array.from(triangles);
    this.cells = [new Uint32Array(offsets.length - 1), null];
    this.cells[1] = this.cells[0];
    for (let t = 0; t < offsets.length - 1; ++t) this.cells[0][t] = members[offsets[t]];
    this.members = { offsets: Uint32Array.from(offsets), cells: Uint32Array.from(members) };
  }

  /** Faces as fans of triangles; those that two cells share once. */
  *fromPolytopes() {
    const { cells: { cellOffsets, faceOffsets, vertices }, numCells, numVertices, solid } = this.scene;
    const numFaces = faceOffsets.length - 1;
    let links = null;
    if (solid) {
      const tuples = new Uint32Array(3 * numFaces);
      for (let f = 0; f < numFaces; ++f) putSmallest(tuples, 3 * f, vertices, faceOffsets[f], faceOffsets[f + 1]);
      links = yield* between(0, 0.6, linkEqual(tuples, 3, numVertices));
      this.mode = "solid";
    }
    const cellOfFace = new Uint32Array(numFaces);
    for (let cell = 0; cell < numCells; ++cell) cellOfFace.fill(cell, cellOffsets[cell], cellOffsets[cell + 1]);
    const triangles = [], edges = [], first = [], other = [];
    for (let f = 0; f < numFaces; ++f) {
      if (links && links[f] < f) continue;
      const begin = faceOffsets[f], size = faceOffsets[f + 1] - begin;
      for (let i = 1; i + 1 < size; ++i) {
        triangles.push(vertices[begin], vertices[begin + i], vertices[begin + i + 1]);
        edges.push(1 | (i + 2 === size ? 2 : 0) | (i === 1 ? 4 : 0));
        first.push(cellOfFace[f]);
        other.push(links && links[f] !== f ? cellOfFace[links[f]] : NONE);
      }
      if (f % 8192 === 0) yield 0.6 + 0.4 * f / numFaces;
    }
    this.triangles = Uint32Array.from(triangles);
    this.edges = Uint8Array.from(edges);
    this.cells = [Uint32Array.from(first), solid ? Uint32Array.from(other) : null];
  }

  /** Sides between triangles of one group (a facet of a hull) are no edges. */
  *joinGroups() {
    const { groups, corners } = this.scene;
    if (corners === 4) return void (yield* this.joinTetrahedra());
    if (corners !== 3) return;
    const links = yield* this.facetLinks();
    this.edges = new Uint8Array(this.numTriangles);
    for (let s = 0; s < links.length; ++s) {
      const triangle = Math.floor(s / 3), other = Math.floor(links[s] / 3);
      if (links[s] === s || groups[triangle] !== groups[other]) this.edges[triangle] |= 1 << (s % 3);
    }
  }

  /** The same for a hull in four dimensions: faces within a facet are not drawn, and of three facets or more is what is an edge. */
  *joinTetrahedra() {
    const { groups, cells, numVertices } = this.scene, [first, second] = this.cells;
    const kept = [];
    for (let t = 0; t < this.numTriangles; ++t) if (groups[first[t]] !== groups[second[t]]) kept.push(t);
    this.triangles = Uint32Array.from({ length: 3 * kept.length }, (_, i) => this.triangles[3 * kept[Math.floor(i / 3)] + i % 3]);
    this.cells = this.cells.map((items) => Uint32Array.from(kept, (t) => items[t]));
    this.numTriangles = kept.length;
    const around = new Map(), key = (a, b) => Math.min(a, b) * numVertices + Math.max(a, b);  // the facets at each edge, three at most
    for (let i = 0; i < cells.length; i += 4) {
      for (let a = 1; a < 4; ++a)
        for (let b = 0; b < a; ++b) {
          const name = key(cells[i + a], cells[i + b]), group = groups[i / 4], known = around.get(name);
          if (!known) around.set(name, [group]);
          else if (known.length < 3 && !known.includes(group)) known.push(group);
        }
      if (i % 65536 === 0) yield;
    }
    this.edges = new Uint8Array(this.numTriangles);
    for (let s = 0; s < 3 * this.numTriangles; ++s) {
      const t = s - s % 3, a = this.triangles[t + (s + 1) % 3], b = this.triangles[t + (s + 2) % 3];
      if (around.get(key(a, b)).length > 2) this.edges[t / 3] |= 1 << (s % 3);
    }
  }

  /** The vertices of a cell, each once. */
  verticesOf(cell) {
    const { cells, corners } = this.scene;
    if (corners > 0) return Array.from(cells.subarray(cell * corners, (cell + 1) * corners));
    const result = new Set();
    for (let f = cells.cellOffsets[cell]; f < cells.cellOffsets[cell + 1]; ++f)
      for (let i = cells.faceOffsets[f]; i < cells.faceOffsets[f + 1]; ++i) result.add(cells.vertices[i]);
    return [...result];
  }

  /** The edges of a cell as pairs of vertices. */
  edgesOf(cell) {
    const { cells, corners } = this.scene, result = [];
    if (corners > 0) {
      const vertices = this.verticesOf(cell);
      for (let i = 0; i < corners; ++i) for (let j = 0; j < i; ++j) result.push([vertices[j], vertices[i]]);
      return result;
    }
    for (let f = cells.cellOffsets[cell]; f < cells.cellOffsets[cell + 1]; ++f) {
      const begin = cells.faceOffsets[f], end = cells.faceOffsets[f + 1];
      for (let i = begin; i < end; ++i) result.push([cells.vertices[i], cells.vertices[i + 1 < end ? i + 1 : begin]]);
    }
    return result;
  }
}
