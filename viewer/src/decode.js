// SPDX-License-Identifier: BSD-3-Clause
// From the text blocks of the page to typed arrays. src/view/encode.hpp writes them and describes the codes.

/** The bytes of the text of a block. */
export function bytesOfBase64(text) {
  if (Uint8Array.fromBase64) return Uint8Array.fromBase64(text);
  const binary = atob(text);
  const bytes = new Uint8Array(binary.length);
  for (let i = 0; i < bytes.length; ++i) bytes[i] = binary.charCodeAt(i);
  return bytes;
}

async function inflate(bytes) {
  if (typeof DecompressionStream === "undefined") throw new Error("This browser is too old: it has no DecompressionStream.");
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/** Items of so many bytes: first all lowest bytes, then the next ones; each the difference from the item `stride` before. */
export function itemsOfPlanes(bytes, { items, bytes: width, stride }) {
  if (bytes.length !== items * width) throw new Error("The page is damaged: a block has a wrong length.");
  const result = new Uint32Array(items);
  for (let plane = 0; plane < width; ++plane) {
    const start = plane * items, shift = 8 * plane;
    for (let i = 0; i < items; ++i) result[i] |= bytes[start + i] << shift;
  }
  const mask = width === 4 ? 0xffffffff : 2 ** (8 * width) - 1;
  for (let i = stride; i < items; ++i) result[i] = (result[i] + result[i - stride]) & mask;
  return result;
}

/** Reads numbers of seven bits a byte, lowest first. */
class VarintReader {
  constructor(bytes) {
    this.bytes = bytes;
    this.at = 0;
  }
  number() {
    let result = 0, shift = 0, byte;
    do {
      byte = this.bytes[this.at++];
      result |= (byte & 127) << shift;
      shift += 7;
    } while (byte > 127);
    return result >>> 0;
  }
  difference() {
    const code = this.number();
    return (code >>> 1) ^ -(code & 1);
  }
}

/** Simplices: corner 0 is the difference from corner 0 of the simplex before, the others from the corner before. */
export function simplicesOfVarints(bytes, { items }, corners) {
  const reader = new VarintReader(bytes);
  const result = new Uint32Array(items);
  let first = 0;
  for (let i = 0; i < items; i += corners) {
    let vertex = first += reader.difference();
    result[i] = vertex;
    for (let j = 1; j < corners; ++j) result[i + j] = vertex += reader.difference();
  }
  if (reader.at !== bytes.length) throw new Error("The page is damaged: a block has a wrong length.");
  return result;
}

/** Polytopes: for each the number of faces, for each face its number of vertices, then these as differences. */
export function polytopesOfVarints(bytes, { items }) {
  const reader = new VarintReader(bytes);
  const faceOffsets = [0], vertices = [], cellOffsets = new Uint32Array(items + 1);
  let vertex = 0;
  for (let cell = 0; cell < items; ++cell) {
    for (let faces = reader.number(); faces > 0; --faces) {
      for (let size = reader.number(); size > 0; --size) vertices.push(vertex += reader.difference());
      faceOffsets.push(vertices.length);
    }
    cellOffsets[cell + 1] = faceOffsets.length - 1;
  }
  return { cellOffsets, faceOffsets, vertices };
}

/** Numbers in steps between `low` and `high` (of logarithms if `log`); the largest code is "no number". */
export function numbersOfCodes(codes, { bytes, low, high, log }) {
  const largest = 2 ** (8 * bytes) - 1;
  const result = new Float32Array(codes.length);
  const step = (high / (largest - 1)) - (low / (largest - 1));
  for (let i = 0; i < codes.length; ++i) {
    const value = low + codes[i] * step;
    result[i] = codes[i] === largest ? NaN : log ? Math.exp(value) : value;
  }
  return result;
}

/** The scene of this page: its description, and the arrays of its blocks. */
export async function readScene(document) {
  const scene = JSON.parse(document.getElementById("delone-scene").textContent);
  for (const [name, block] of Object.entries(scene.blocks)) {
    const element = document.getElementById("delone-" + name);
    let bytes = bytesOfBase64(element.textContent);
    element.textContent = "";
    if (block.deflated) bytes = await inflate(bytes);
    scene[name] = block.coding === "planes" ? itemsOfPlanes(bytes, block)
      : block.coding === "simplices" ? simplicesOfVarints(bytes, block, scene.corners)
      : polytopesOfVarints(bytes, block);
    if (block.numbers) scene[name] = numbersOfCodes(scene[name], block);
  }
  return scene;
}
