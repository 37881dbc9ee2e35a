// SPDX-License-Identifier: BSD-3-Clause
// What cells can be colored and filtered by: numbers of cells or of vertices, their range, and places within it.

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
  }
  get log() {
    return this.scale === "log";
  }
  /** The number below which a part of all numbers is; 0 and 1 are exact. */
  quantile(part) {
    const last = this.sorted.length - 1;
    return last < 0 ? NaN : this.sorted[Math.round(part * last)];
  }
  /** Each number's place in the range, 0 … 1 and beyond it as far as −1 and 2; −3 for none. */
  scalars() {
    if (this.scale === "rank") return this.ranks();
    const place = this.log ? Math.log : (x) => x;
    const low = place(this.from), scale = 1 / (place(this.to) - low || 1), result = new Float32Array(this.values.length);
    for (let i = 0; i < result.length; ++i) {
      const t = (place(this.values[i]) - low) * scale;
      result[i] = Number.isNaN(t) ? -3 : Math.min(Math.max(t, -1), 2);
    }
    return result;
  }
  /** The part of the (sampled) numbers that are not larger, so that each color is used equally often. */
  ranks() {
    const { sorted } = this, last = Math.max(sorted.length - 1, 1);
    return this.values.map((value) => {
      if (Number.isNaN(value)) return -3;
      let low = 0, high = sorted.length - 1;
      while (low < high) {
        const middle = (low + high + 1) >> 1;
        if (sorted[middle] <= value) low = middle;
        else high = middle - 1;
      }
      return low / last;
    });
  }
  /** The numbers at both ends of the colors. */
  get ends() {
    return this.scale === "rank" ? [this.low, this.high] : [this.from, this.to];
  }
  /** The number in the middle of the colors. */
  middle() {
    if (this.scale === "rank") return this.quantile(0.5);
    return this.log ? Math.sqrt(this.from) * Math.sqrt(this.to) : this.from / 2 + this.to / 2;
  }
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
