// SPDX-License-Identifier: BSD-3-Clause
// From the text blocks of the page to typed arrays. src/view/encode.hpp writes them and describes the codes. Generators yield the
// part of their work that is done.
import { counted } from "./panel.js";

const STEP = 65536;  // items between two yields

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
export function* itemsOfPlanes(bytes, { items, bytes: width, stride }) {
  if (bytes.length !== items * width) throw new Error("The page is damaged: a block has a wrong length.");
  const result = new Uint32Array(items);
  for (let plane = 0; plane < width; ++plane) {
    const start = plane * items, shift = 8 * plane;
    for (let begin = 0; begin < items; begin += STEP) {
      const end = Math.min(begin + STEP, items);
      for (let i = begin; i < end; ++i) result[i] |= bytes[start + i] << shift;
      yield (start + end) / (items * (width + 1));
    }
  }
  const mask = width === 4 ? 0xffffffff : 2 ** (8 * width) - 1;
  for (let begin = stride; begin < items; begin += STEP) {
    const end = Math.min(begin + STEP, items);
    for (let i = begin; i < end; ++i) result[i] = (result[i] + result[i - stride]) & mask;
    yield (width + end / items) / (width + 1);
  }
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
export function* simplicesOfVarints(bytes, { items }, corners) {
  const reader = new VarintReader(bytes);
  const result = new Uint32Array(items);
  let first = 0;
  for (let i = 0; i < items; i += corners) {
    let vertex = first += reader.difference();
    result[i] = vertex;
    for (let j = 1; j < corners; ++j) result[i + j] = vertex += reader.difference();
    if (i / corners % STEP === 0) yield i / items;
  }
  if (reader.at !== bytes.length) throw new Error("The page is damaged: a block has a wrong length.");
  return result;
}

/** Polytopes: for each the number of faces, for each face its number of vertices, then these as differences. */
export function* polytopesOfVarints(bytes, { items }) {
  const reader = new VarintReader(bytes);
  const faceOffsets = [0], vertices = [], cellOffsets = new Uint32Array(items + 1);
  let vertex = 0;
  for (let cell = 0; cell < items; ++cell) {
    for (let faces = reader.number(); faces > 0; --faces) {
      for (let size = reader.number(); size > 0; --size) vertices.push(vertex += reader.difference());
      faceOffsets.push(vertices.length);
    }
    cellOffsets[cell + 1] = faceOffsets.length - 1;
    if (cell % 8192 === 0) yield cell / items;
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
export async function readScene(document, loading) {
  const scene = JSON.parse(document.getElementById("delone-scene").textContent);
  const blocks = Object.entries(scene.blocks).map(([name, block]) => [name, block, document.getElementById("delone-" + name)]);
  const size = blocks.reduce((sum, [, , element]) => sum + element.textContent.length, 0);
  loading.begin(2 * size, `Reading ${counted(scene.numCells, scene.cellWord)}, ${(size / 1e6).toFixed(1)} MB`);  // the model takes as long
  for (const [name, block, element] of blocks) {
    const length = element.textContent.length;
    let bytes = bytesOfBase64(element.textContent);
    element.textContent = "";
    if (block.deflated) bytes = await inflate(bytes);
    scene[name] = await loading.run(length, block.coding === "planes" ? itemsOfPlanes(bytes, block)
      : block.coding === "simplices" ? simplicesOfVarints(bytes, block, scene.corners)
      : polytopesOfVarints(bytes, block));
    if (block.numbers) scene[name] = numbersOfCodes(scene[name], block);
  }
  return scene;
}
