// SPDX-License-Identifier: BSD-3-Clause
// Whether cells are large enough on the screen to be seen one by one. Where they are not, their colors would be dust.

export const LEAST_PIXELS = 6;  // of a cell that is seen
const SAMPLE = 2000;

/** The mean number of pixels of a cell of the plane, among those in sight: of a sample of all. */
export function pixelsOfCells({ camera, canvas, mesh }, centroids, { low, high }) {
  const count = centroids.length / 3, step = Math.max(1, Math.floor(count / SAMPLE));
  const place = [camera.position.x, camera.position.y], scale = mesh.scale.toArray();
  const first = [camera.left, camera.bottom].map((x, j) => place[j] + x / camera.zoom), last = [camera.right, camera.top].map((x, j) => place[j] + x / camera.zoom);
  let inSight = 0, sampled = 0;
  for (let i = 0; i < count; i += step, ++sampled)
    if ([0, 1].every((j) => centroids[3 * i + j] * scale[j] >= first[j] && centroids[3 * i + j] * scale[j] <= last[j])) ++inSight;
  const parts = [0, 1].map((j) => Math.max(Math.min(last[j], high[j] * scale[j]) - Math.max(first[j], low[j] * scale[j]), 0) / (last[j] - first[j]));
  return parts[0] * parts[1] * canvas.clientWidth * canvas.clientHeight / Math.max(inSight / Math.max(sampled, 1) * count, 1);
}

/** About the number of pixels of a cell in a cut through so many cells of space. */
export function pixelsOfCut({ canvas }, numCells) {
  return 0.25 * canvas.clientWidth * canvas.clientHeight / Math.max(numCells, 1) ** (2 / 3);
}

/** The positions of at most so many of the points, spread over all of them. */
export function sampleOf(positions, most) {
  const count = positions.length / 4, step = Math.max(1, Math.ceil(count / most)), result = new Float32Array(4 * Math.ceil(count / step));
  for (let i = 0, at = 0; i < count; i += step, at += 4) result.set(positions.subarray(4 * i, 4 * i + 4), at);
  return result;
}
