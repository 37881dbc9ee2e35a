// SPDX-License-Identifier: BSD-3-Clause
// What `import "delone"` loads in Node.
import { readFile } from "node:fs/promises";
import { start } from "./calls.js";

await start(await WebAssembly.compile(await readFile(new URL("./module.wasm", import.meta.url))));

export * from "./objects.js";
