// SPDX-License-Identifier: BSD-3-Clause
// Where vertices are in the picture: their coordinates in one unit, of which three are chosen, or projected to.

/** The eigenvectors of a symmetric matrix of rows, the largest eigenvalue first (Jacobi's method). */
function eigenvectors(matrix) {
  const n = matrix.length, a = matrix.map((row) => row.slice());
  const v = a.map((_, i) => a.map((__, j) => (i === j ? 1 : 0)));
  for (let sweep = 0; sweep < 60; ++sweep)
    for (let p = 0; p < n; ++p)
      for (let q = p + 1; q < n; ++q) {
        if (Math.abs(a[p][q]) < 1e-300) continue;
        const theta = (a[q][q] - a[p][p]) / (2 * a[p][q]);
        const t = Math.sign(theta || 1) / (Math.abs(theta) + Math.hypot(theta, 1)), c = 1 / Math.hypot(t, 1), s = t * c;
        for (let k = 0; k < n; ++k) [a[k][p], a[k][q]] = [c * a[k][p] - s * a[k][q], s * a[k][p] + c * a[k][q]];
        for (let k = 0; k < n; ++k) [a[p][k], a[q][k]] = [c * a[p][k] - s * a[q][k], s * a[p][k] + c * a[q][k]];
        for (let k = 0; k < n; ++k) [v[k][p], v[k][q]] = [c * v[k][p] - s * v[k][q], s * v[k][p] + c * v[k][q]];
      }
  const order = a.map((_, i) => i).sort((i, j) => a[j][j] - a[i][i]);
  return order.map((i) => v.map((row) => row[i]));
}

export class Space {
  /** The longest axis has length 1; the origin is the middle of the box. */
  constructor(scene) {
    const d = scene.dimension;
    this.dimension = d;
    this.low = scene.low;
    this.half = scene.low.map((low, j) => scene.high[j] / 2 - low / 2);
    this.largest = Math.max(...this.half, Number.MIN_VALUE);
    this.extent = this.half.map((half) => half / this.largest);
    this.unit = this.unitOf(scene.positions, 2 ** (8 * scene.blocks.positions.bytes) - 1);
    this.columns = scene.columns;
    this.useAxes([0, 1, 2].map((j) => (j < d ? j : -1)));
  }

  /** Codes of coordinates to coordinates in the unit. */
  unitOf(codes, largest) {
    const d = this.dimension, unit = new Float32Array(codes.length), scale = this.extent.map((e) => e / largest);
    for (let i = 0; i < codes.length; i += d)
      for (let j = 0; j < d; ++j) unit[i + j] = codes[i + j] * scale[j] - this.extent[j] / 2;
    return unit;
  }

  /** The user's coordinate `axis` of a number of the unit. */
  userCoordinate(axis, unit) {
    return this.half[axis] === 0 ? this.low[axis] : this.low[axis] + (unit + this.extent[axis] / 2) * this.largest * 2;
  }

  /** With `slanted` the other coordinates are seen, too: each moves points in a direction of its own. */
  useAxes(axes, slanted = false) {
    const slant = (j, r) => (slanted && !axes.includes(j) ? 0.4 * Math.cos(2.4 * j + 2.1 * r) : 0);
    this.rows = axes.map((axis, r) => Array.from({ length: this.dimension }, (_, j) => (j === axis ? 1 : slant(j, r))));
    this.names = axes.map((axis) => (axis < 0 ? "" : this.columns[axis]));
    this.project();
  }

  /** The three directions in which the vertices vary most. */
  usePrincipalAxes() {
    const d = this.dimension, n = this.unit.length / d, mean = new Array(d).fill(0);
    for (let i = 0; i < this.unit.length; ++i) mean[i % d] += this.unit[i] / n;
    const matrix = mean.map(() => new Array(d).fill(0));
    for (let i = 0; i < this.unit.length; i += d)
      for (let a = 0; a < d; ++a)
        for (let b = 0; b < d; ++b) matrix[a][b] += (this.unit[i + a] - mean[a]) * (this.unit[i + b] - mean[b]);
    this.rows = eigenvectors(matrix).slice(0, 3);
    this.names = ["1st axis", "2nd axis", "3rd axis"];
    this.project();
  }

  /** The chosen coordinates of points in the unit: four numbers each. */
  turned(unit) {
    const d = this.dimension, count = unit.length / d, result = new Float32Array(4 * count);
    for (let i = 0; i < count; ++i)
      for (let r = 0; r < 3; ++r) {
        let sum = 0;
        for (let j = 0; j < d; ++j) sum += this.rows[r][j] * unit[i * d + j];
        result[4 * i + r] = sum;
      }
    return result;
  }

  /** `positions`: four numbers for each vertex, the fourth unused; and the box and middle of them. */
  project() {
    this.positions = this.turned(this.unit);
    const low = [Infinity, Infinity, Infinity], high = [-Infinity, -Infinity, -Infinity];
    for (let i = 0; i < this.positions.length; i += 4)
      for (let r = 0; r < 3; ++r) {
        const x = this.positions[i + r];
        if (x < low[r]) low[r] = x;
        if (x > high[r]) high[r] = x;
      }
    if (this.positions.length === 0) low.fill(0), high.fill(0);
    this.box = { low, high };
  }

  /** The centroid of the vertices of each cell of the model, three numbers each. */
  *centroidsOf(model) {
    const { numCells, corners, cells } = model.scene, result = new Float32Array(3 * numCells), p = this.positions;
    for (let cell = 0; cell < numCells; ++cell) {
      let x = 0, y = 0, z = 0, count = 0;
      if (corners > 0) {
        for (let i = cell * corners; i < (cell + 1) * corners; ++i, ++count) {
          const at = 4 * cells[i];
          x += p[at]; y += p[at + 1]; z += p[at + 2];
        }
      } else {
        for (let f = cells.cellOffsets[cell]; f < cells.cellOffsets[cell + 1]; ++f)
          for (let i = cells.faceOffsets[f]; i < cells.faceOffsets[f + 1]; ++i, ++count) {
            const at = 4 * cells.vertices[i];
            x += p[at]; y += p[at + 1]; z += p[at + 2];
          }
      }
      result[3 * cell] = x / count;
      result[3 * cell + 1] = y / count;
      result[3 * cell + 2] = z / count;
      if (cell % 32768 === 0) yield;
    }
    return result;
  }
}
