// SPDX-License-Identifier: BSD-3-Clause
// What `import "delone"` loads in browsers and workers.
import { start } from "./calls.js";

const address = new URL("./module.wasm", import.meta.url);
// A server that does not know the type of such files prevents reading and compiling at once.
const compiled = WebAssembly.compileStreaming(fetch(address)).catch(async () => {
  const response = await fetch(address);
  if (!response.ok) throw new Error(`delone: ${address} cannot be loaded (${response.status})`);
  return WebAssembly.compile(await response.arrayBuffer());
});
await start(await compiled);

export * from "./objects.js";
