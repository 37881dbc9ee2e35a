// SPDX-License-Identifier: BSD-3-Clause
// Which facets of cells are the same: by their smallest vertices, in buckets, in linear time. Generators yield the part of their work
// that is done.

const STEP = 65536;  // so many items between two yields

/**
 * For each tuple of `size` increasing vertices (2 or 3) the number of the first equal one after it, or of the first of all
 * if there is none: equal tuples are linked in cycles. A tuple without an equal one links to itself.
 */
export function* linkEqual(tuples, size, numVertices) {
  const count = tuples.length / size;
  const start = new Uint32Array(numVertices + 1);
  for (let t = 0; t < count; ++t) {
    ++start[tuples[t * size] + 1];
    if (t % STEP === 0) yield 0.1 * t / count;
  }
  for (let v = 0; v < numVertices; ++v) start[v + 1] += start[v];
  const order = new Uint32Array(count), next = start.slice(0, numVertices);
  for (let t = 0; t < count; ++t) {
    order[next[tuples[t * size]]++] = t;
    if (t % STEP === 0) yield 0.1 + 0.2 * t / count;
  }

  const link = new Uint32Array(count);
  const done = new Uint8Array(count);
  const second = 1, third = size - 1;
  for (let v = 0; v < numVertices; ++v) {
    for (let i = start[v]; i < start[v + 1]; ++i) {
      const first = order[i];
      if (done[first]) continue;
      let last = first;
      for (let j = i + 1; j < start[v + 1]; ++j) {
        const other = order[j];
        if (tuples[other * size + second] !== tuples[first * size + second] ||
            tuples[other * size + third] !== tuples[first * size + third]) continue;
        link[last] = other;
        done[other] = 1;
        last = other;
      }
      link[last] = first;
    }
    if (v % 2048 === 0) yield 0.3 + 0.7 * v / numVertices;
  }
  return link;
}

/** Sorts three numbers into tuples[at], [at + 1], [at + 2]. */
export function putSorted(tuples, at, a, b, c) {
  if (a > b) [a, b] = [b, a];
  if (b > c) [b, c] = [c, b];
  if (a > b) [a, b] = [b, a];
  tuples[at] = a;
  tuples[at + 1] = b;
  tuples[at + 2] = c;
}

/** The three smallest vertices of a face, which no other face of a complex of convex cells has. */
export function putSmallest(tuples, at, vertices, begin, end) {
  let a = Infinity, b = Infinity, c = Infinity;
  for (let i = begin; i < end; ++i) {
    const v = vertices[i];
    if (v < a) [a, b, c] = [v, a, b];
    else if (v < b) [b, c] = [v, b];
    else if (v < c) c = v;
  }
  tuples[at] = a;
  tuples[at + 1] = b;
  tuples[at + 2] = c;
}

/** The facets of simplices of 3 or 4 corners as increasing tuples; facet i of a cell is opposite corner i. */
export function* facetTuples(cells, corners) {
  const size = corners - 1;
  const tuples = new Uint32Array(cells.length * size);
  let at = 0;
  for (let first = 0, cell = 0; first < cells.length; first += corners, ++cell) {
    if (cell % STEP === 0) yield first / cells.length;
    if (corners === 3) {
      for (let i = 0; i < 3; ++i, at += 2) {
        const a = cells[first + (i + 1) % 3], b = cells[first + (i + 2) % 3];
        tuples[at] = Math.min(a, b);
        tuples[at + 1] = Math.max(a, b);
      }
    } else {
      for (let i = 0; i < 4; ++i, at += 3)
        putSorted(tuples, at, cells[first + (i + 1) % 4], cells[first + (i + 2) % 4], cells[first + (i + 3) % 4]);
    }
  }
  return tuples;
}
