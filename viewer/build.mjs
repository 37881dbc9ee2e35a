// SPDX-License-Identifier: BSD-3-Clause
// Makes dist/viewer.html: the page without its data. Usage: npm ci && node build.mjs
import { createHash } from "node:crypto";
import { mkdirSync, readFileSync, readdirSync, writeFileSync } from "node:fs";
import { dirname, join } from "node:path";
import { fileURLToPath } from "node:url";
import { build, transform } from "esbuild";

const here = dirname(fileURLToPath(import.meta.url));
const read = (name) => readFileSync(join(here, name), "utf8");

// tests/tools/test_viewer.py computes the same: names and texts of all sources, in order.
const sources = ["build.mjs", "package-lock.json", "package.json", ...readdirSync(join(here, "src")).map((name) => "src/" + name)].sort();
const hash = createHash("sha256");
for (const name of sources) hash.update(name + "\n" + read(name));

const bundle = await build({
  entryPoints: [join(here, "src/main.js")], bundle: true, minify: true, write: false, format: "iife", target: "es2022", charset: "ascii",
  legalComments: "none",
});
const style = await transform(read("src/page.css"), { loader: "css", minify: true });
const license = read("node_modules/three/LICENSE").replace("\u00a9", "(c)").trim();
const page = read("src/page.html")
  .replace("LICENSE", () => license + "\n")
  .replace("SOURCES_HASH", () => hash.digest("hex"))
  .replace("STYLE", () => style.code)
  .replace("SCRIPT", () => bundle.outputFiles[0].text.trim());
mkdirSync(join(here, "dist"), { recursive: true });
writeFileSync(join(here, "dist/viewer.html"), page);
console.log(`viewer/dist/viewer.html: ${page.length} bytes`);
