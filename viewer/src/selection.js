// SPDX-License-Identifier: BSD-3-Clause
// Which cells are shown, and the triangles that this takes. In steps, so that no frame waits for it.
import { NONE } from "./model.js";

const STEP = 16384;

/**
 * `plane`: {normal, offset}: cells whose centroid is beyond it are not shown; or null. `range`: {values, low, high}: nor are those
 * with a value outside, or without one; or null. Fills `index` with 6·triangle + 3·side + corner, three entries for each
 * triangle, and returns {count, numShown, shown}: how many entries, how many cells, and which.
 */
export function* select(model, centroids, { plane, range }, index) {
  const shown = new Uint8Array(model.numCells);
  let numShown = 0;
  for (let begin = 0; begin < shown.length; begin += STEP) {
    const end = Math.min(begin + STEP, shown.length);
    for (let cell = begin; cell < end; ++cell) {
      let show = 1;
      if (range !== null) {
        const value = range.values[cell];
        show = value >= range.low && value <= range.high ? 1 : 0;
      }
      if (show && plane !== null) {
        const [x, y, z] = plane.normal;
        if (x * centroids[3 * cell] + y * centroids[3 * cell + 1] + z * centroids[3 * cell + 2] > plane.offset) show = 0;
      }
      shown[cell] = show;
      numShown += show;
    }
    yield;
  }
  const all = numShown === shown.length;
  let at = 0;
  for (let begin = 0; begin < model.numTriangles; begin += STEP) {
    const end = Math.min(begin + STEP, model.numTriangles);
    for (let t = begin; t < end; ++t) {
      const side = shownSide(model, shown, all, t);
      if (side < 0) continue;
      index[at] = 6 * t + 3 * side;
      index[at + 1] = index[at] + 1;
      index[at + 2] = index[at] + 2;
      at += 3;
    }
    yield;
  }
  return { count: at, numShown, shown };
}

/** The side whose cell is seen, or −1 if the triangle is not. */
function shownSide(model, shown, all, t) {
  const [first, second] = model.cells;
  if (model.mode === "surface") return all || shown[first ? first[t] : t] ? 0 : -1;
  const has = first[t], other = second[t];
  if (model.mode === "solid") {
    const a = shown[has], b = other === NONE ? 0 : shown[other];
    return a === b ? -1 : a ? 0 : 1;
  }
  if (!model.members) return shown[has] ? 0 : other !== NONE && shown[other] ? 1 : -1;
  const { offsets, cells } = model.members;
  for (let i = offsets[t]; i < offsets[t + 1]; ++i) if (shown[cells[i]]) return 0;
  return -1;
}
