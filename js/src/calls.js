// SPDX-License-Identifier: BSD-3-Clause
// Calls of the C interface in the module of WebAssembly: arguments in its memory, options, progress, errors.
import createModule from "./module.js";
import { InputError, OutOfMemoryError, errorOf } from "./errors.js";

/** The module: its functions as `_delone_…`, its memory as HEAPU8 and others. */
export let module;
/** The version of the library. */
export let version;
const folder = "/files"; // where files are while the library reads or writes them

export async function start(compiled) {
  module = await new Promise((resolve, reject) => {
    createModule({
      instantiateWasm(imports, receive) {
        WebAssembly.instantiate(compiled, imports).then(receive, reject);
        return {};
      },
    }).then(resolve, reject);
  });
  module.FS.mkdir(folder);
  module.FS.chdir(folder);
  version = text(module._delone_version());
}

export const text = (pointer) => module.UTF8ToString(pointer >>> 0);

function throwError(status) {
  const place = module._malloc(4) >>> 0;
  let rows = [];
  if (place !== 0) {
    const count = module._delone_error_rows(place);
    rows = Array.from(new Uint32Array(module.HEAPU8.buffer, count > 0 ? module.HEAPU32[place >>> 2] : 0, count));
    module._free(place);
  }
  throw errorOf(text(module._delone_status_name(status)), text(module._delone_error_message()), rows);
}

/** Runs a call that returns a status. `progress` gets the fraction done; if it returns true or throws, the call ends. */
export function call(run, progress) {
  if (progress === undefined || progress === null) {
    const status = run();
    if (status !== 0) throwError(status);
    return;
  }
  if (typeof progress !== "function") throw new InputError("progress is a function");
  const outer = module.progress, thrown = [];
  module.progress = (fraction) => {
    try {
      return progress(fraction) === true ? 1 : 0;
    } catch (error) {
      thrown.push(error);
      return 1;
    }
  };
  let status;
  try {
    module._delone_js_ask_for_progress(1);
    status = run();
  } finally {
    module.progress = outer;
    module._delone_js_ask_for_progress(outer === undefined ? 0 : 1);
  }
  if (thrown.length > 0) throw thrown[0];
  if (status !== 0) throwError(status);
}

/** Memory of the module for the arguments of one call, of bytes. */
class Arguments {
  #blocks = [];

  allocate(bytes) {
    const block = bytes < 2 ** 32 ? module._malloc(Math.max(bytes, 8)) >>> 0 : 0; // sizes have 32 bits there
    if (block === 0) throw new OutOfMemoryError(`there is no memory for ${bytes} bytes`, "out_of_memory");
    this.#blocks.push(block);
    return block;
  }
  text(string) {
    const size = 4 * string.length + 1, block = this.allocate(size);
    module.stringToUTF8(string, block, size);
    return block;
  }
  doubles(numbers) {
    const block = this.allocate(8 * numbers.length);
    module.HEAPF64.set(numbers, block / 8);
    return block;
  }
  /** Rows or cells. */
  integers(numbers, what) {
    const block = this.allocate(8 * numbers.length);
    const place = new BigInt64Array(module.HEAPU8.buffer, block, numbers.length);
    for (let i = 0; i < numbers.length; ++i) {
      if (!Number.isSafeInteger(numbers[i])) throw new InputError(`${what}: entry ${i} is ${numbers[i]}, which is no integer`);
      place[i] = BigInt(numbers[i]);
    }
    return block;
  }
  release() {
    for (const block of this.#blocks) module._free(block);
  }
}

/** The result of use(memory), whose memory is released afterwards. */
export function withMemory(use) {
  const memory = new Arguments();
  try {
    return use(memory);
  } finally {
    memory.release();
  }
}

export const doublesAt = (place, count) => new Float64Array(module.HEAPU8.buffer, place, count).slice();
export const bytesAt = (place, count) => new Uint8Array(module.HEAPU8.buffer, place, count).slice();
/** Rows or cells, which fit 32 bits in this memory. */
export const integersAt = (place, count) => Int32Array.from(new BigInt64Array(module.HEAPU8.buffer, place, count), Number);

const isNumbers = (value) => ArrayBuffer.isView(value) && !(value instanceof DataView) && !(value instanceof BigInt64Array) && !(value instanceof BigUint64Array);

/** A list of numbers, checked: what is no number would become one. A view of the memory, which may move, is copied. */
export function numbers(value, what) {
  if (isNumbers(value)) return value.buffer === module.HEAPU8.buffer ? value.slice() : value;
  if (!Array.isArray(value)) throw new InputError(`${what}: an array of numbers is wanted`);
  const wrong = value.findIndex((x) => typeof x !== "number");
  if (wrong >= 0) throw new InputError(`${what}: entry ${wrong} is ${String(value[wrong])}, which is no number`, "invalid_argument");
  return value;
}

/** Rows of numbers, one after the other in an array, or each an array: {numbers, count, width}. */
export function matrix(value, width, what) {
  if (width !== undefined && !(Number.isSafeInteger(width) && width > 0))
    throw new InputError(`${what}: the dimension is ${String(width)}, and not a positive integer`, "bad_dimension");
  if (Array.isArray(value) && (Array.isArray(value[0]) || isNumbers(value[0]))) {
    const size = width ?? value[0].length, flat = new Float64Array(value.length * size);
    value.forEach((row, i) => {
      if (row?.length !== size) throw new InputError(`${what}: row ${i} has ${row?.length} numbers, and not ${size}`, "bad_dimension", [i]);
      flat.set(numbers(row, `${what}: row ${i}`), i * size);
    });
    return { numbers: flat, count: value.length, width: size };
  }
  if (width === undefined) throw new InputError(`${what}: the dimension is missing`, "bad_dimension");
  const flat = numbers(value, what);
  if (flat.length % width !== 0)
    throw new InputError(`${what}: ${flat.length} numbers are no rows of ${width}`, "bad_dimension");
  return { numbers: flat, count: flat.length / width, width };
}

export function exactly(count, value, what) {
  const checked = numbers(value, what);
  if (checked.length !== count) throw new InputError(`${what}: ${checked.length} numbers, and not ${count}`);
  return checked;
}

const setters = {
  integer(options, name, value) {
    if (typeof value !== "boolean" && !Number.isSafeInteger(value)) throw new InputError(`the option ${name} is an integer`);
    return (place) => module._delone_set_integer(options, place, BigInt(value));
  },
  real(options, name, value) {
    if (typeof value !== "number") throw new InputError(`the option ${name} is a number`);
    return (place) => module._delone_set_real(options, place, value);
  },
  reals(options, name, value, memory) {
    const block = memory.doubles(numbers(value, `the option ${name}`));
    return (place) => module._delone_set_reals(options, place, block, value.length);
  },
  text(options, name, value, memory) {
    if (typeof value !== "string") throw new InputError(`the option ${name} is a string`);
    const block = memory.text(value);
    return (place) => module._delone_set_text(options, place, block);
  },
};
const types = {
  seed: "integer", order: "text", timeLimit: "real", tolerance: "real", axisTolerances: "reals", outside: "text",
  fill: "real", upTo: "integer", canonical: "integer", oriented: "integer", furthestSite: "integer", properFaces: "integer", vertices: "integer",
  format: "text", columns: "text", skipMissing: "integer",
};

/** snake_case of camelCase, and the reverse. */
export const nameInC = (name) => name.replace(/[A-Z]/g, (letter) => "_" + letter.toLowerCase());
export const nameInJs = (name) => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());

/** The result of use(pointer to options, progress, memory). `allowed`: their names. */
export function withOptions(given, allowed, use) {
  if (given !== undefined && (given === null || typeof given !== "object")) throw new InputError("options are an object with named members");
  return withMemory((memory) => {
    const place = memory.allocate(4);
    call(() => module._delone_options_new(place));
    const options = module.HEAPU32[place >>> 2];
    try {
      for (const [name, value] of Object.entries(given ?? {})) {
        if (name === "progress" || value === undefined) continue;
        if (!allowed.includes(name)) throw new InputError(`there is no option ${name} here; there are ${[...allowed, "progress"].join(", ")}`);
        for (const one of name === "columns" ? [].concat(value) : [value]) {
          const set = setters[types[name]](options, name, name === "columns" ? String(one) : one, memory), inC = memory.text(nameInC(name));
          call(() => set(inC));
        }
      }
      return use(options, given?.progress, memory);
    } finally {
      module._delone_options_free(options);
    }
  });
}

/** The result of use(path), with a file of that name and content, which is removed afterwards; without content, none. */
export function withFile(name, content, use) {
  const path = name.replace(/^.*\//s, "").replace(/^\.*$/, "file");
  if (content !== undefined) module.FS.writeFile(path, content);
  try {
    return use(path);
  } finally {
    if (module.FS.analyzePath(path).exists) module.FS.unlink(path);
  }
}
export const fileContent = (path) => module.FS.readFile(path);
