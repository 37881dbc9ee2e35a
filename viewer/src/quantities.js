// SPDX-License-Identifier: BSD-3-Clause
// What cells can be colored and filtered by: numbers of cells or of vertices, their range, and places within it.

const NEAR = 1 / 16;  // of all colors: these are hard to tell from each other
const CROWDED = 0.6;  // more of the numbers than this near each other

export class Quantity {
  /** `values`: one for each cell, or each vertex (`ofVertices`); NaN for none. `robust`: outliers do not make the range, which `limits` gives otherwise. */
  constructor(name, values, { ofVertices = false, log = false, robust = false, limits = null } = {}) {
    Object.assign(this, { name, values, ofVertices, scale: log ? "log" : "linear" });
    this.sorted = sampleOf(values);
    this.low = this.quantile(0);
    this.high = this.quantile(1);
    [this.from, this.to] = limits ?? (robust ? [this.quantile(0.01), this.quantile(0.99)] : [this.low, this.high]);
    this.canBeLog = this.from > 0;
    if (log && !this.canBeLog) this.scale = "linear";
    // With limits of its own a quantity has colors that are known.
    this.isCrowded = limits === null && this.crowd(this.scale) > CROWDED && this.crowd("rank") < CROWDED / 2;
    if (this.isCrowded) this.scale = "rank";
  }
  /** The number below which a part of all numbers is; 0 and 1 are exact. */
  quantile(part) {
    const last = this.sorted.length - 1;
    return last < 0 ? NaN : this.sorted[Math.round(part * last)];
  }
  /** The function from a number to its place among the colors, 0 … 1. */
  placeBy(scale) {
    if (scale === "rank") return (value) => this.rankOf(value);
    const along = scale === "log" ? Math.log : (x) => x, low = along(this.from), factor = 1 / (along(this.to) - low || 1);
    return (value) => (along(value) - low) * factor;
  }
  /** The part of the (sampled) numbers that are smaller, and half of those that are equal: each color is used equally often. */
  rankOf(value) {
    const { sorted } = this, last = Math.max(sorted.length - 1, 1);
    return (lowerBound(sorted, (x) => x >= value) + lowerBound(sorted, (x) => x > value) - 1) / 2 / last;
  }
  /** The largest part of the numbers that a scale gives nearly one color. */
  crowd(scale) {
    const places = this.sorted.map(this.placeBy(scale));
    let most = 0;
    for (let first = 0, last = 0; last < places.length; ++last) {
      while (places[last] - places[first] > NEAR) ++first;
      most = Math.max(most, last - first + 1);
    }
    return most / places.length;
  }
  /** Each number's place among the colors, as far as −1 and 2 beyond them; −3 for none. */
  scalars() {
    const place = this.placeBy(this.scale);
    return this.values.map((value) => {
      const t = place(value);
      return Number.isNaN(value) || Number.isNaN(t) ? -3 : Math.min(Math.max(t, -1), 2);
    });
  }
  /** The number at a place among the colors. */
  numberAt(part) {
    if (this.scale === "rank") return this.quantile(part);
    return this.scale === "log" ? this.from ** (1 - part) * this.to ** part : this.from * (1 - part) + this.to * part;
  }
}

/** The first index from which on a condition holds. */
function lowerBound(sorted, holds) {
  let low = 0, high = sorted.length;
  while (low < high) {
    const middle = (low + high) >> 1;
    if (holds(sorted[middle])) high = middle;
    else low = middle + 1;
  }
  return low;
}

/** Up to 65536 numbers in order, the smallest and the largest among them. */
function sampleOf(values) {
  const step = Math.max(1, Math.floor(values.length / 65536)), chosen = [];
  let low = Infinity, high = -Infinity;
  for (let i = 0; i < values.length; ++i) {
    const value = values[i];
    if (Number.isNaN(value)) continue;
    if (value < low) low = value;
    if (value > high) high = value;
    if (i % step === 0) chosen.push(value);
  }
  if (low <= high) chosen.push(low, high);
  return Float32Array.from(chosen).sort();
}
