// SPDX-License-Identifier: BSD-3-Clause
// The npm package beside delaunator and d3-delaunay: times, and whose triangulations are right.
//
//   mkdir -p build/peers && npm install --prefix build/peers delaunator d3-delaunay     (once)
//   node benchmarks/javascript.mjs build/js/delone build/peers/node_modules [numbers of points …]
//
// Times are of processors, the best of several, in milliseconds. A triangulation is right if delone.check() proves it Delaunay; what it
// says otherwise is printed.
import { createRequire } from "node:module";
import { resolve } from "node:path";
import { pathToFileURL } from "node:url";

const [packageFolder, peers, ...sizes] = process.argv.slice(2);
const require = createRequire(pathToFileURL(resolve(peers, "x.js")));
const module = (name) => import(pathToFileURL(resolve(peers, name, require(`${resolve(peers, name)}/package.json`).main)));
const delone = await import(pathToFileURL(resolve(packageFolder, "node.js")));
const { default: Delaunator } = await module("delaunator");
const { Delaunay: D3 } = await module("d3-delaunay");

let state = 1;
const random = () => (state = (state * 48271) % 2147483647) / 2147483647;
const uniform = (n) => Float64Array.from({ length: 2 * n }, random);

function time(run) {
  let best = Infinity, spent = 0;
  for (let i = 0; i < 9 && spent < 4e6; ++i) {
    const start = process.cpuUsage();
    run();
    const { user, system } = process.cpuUsage(start);
    best = Math.min(best, user + system);
    spent += user + system;
  }
  return best / 1000;
}

const jobs = {
  "triangulation: delone": (points) => new delone.Delaunay(points, 2).free(),
  "triangulation and its arrays, copied: delone"(points) {
    const t = new delone.Delaunay(points, 2);
    if (t.cells.length !== t.neighbors.length) throw new Error("cells and neighbors differ");
    t.free();
  },
  "triangulation and its arrays: delaunator": (points) => new Delaunator(points),
  "triangulation and its arrays: d3-delaunay": (points) => new D3(points),
};
const rows = [];
for (const size of (sizes.length > 0 ? sizes : ["100000", "1000000"]).map(Number)) {
  const points = uniform(size), queries = uniform(1000);
  for (const [name, run] of Object.entries(jobs)) rows.push([name, size, time(() => run(points))]);
  const t = new delone.Delaunay(points, 2), d3 = new D3(points);
  const found = { delone: () => t.nearest(queries), "d3-delaunay": () => Array.from({ length: 1000 }, (_, i) => d3.find(queries[2 * i], queries[2 * i + 1])) };
  for (const [name, run] of Object.entries(found)) rows.push([`nearest points of 1000 queries: ${name}`, size, time(run)]);
  t.free();
}
console.log("| what | points | ms |\n|---|---|---|");
for (const [name, size, ms] of rows) console.log(`| ${name} | ${size} | ${ms.toFixed(ms < 10 ? 2 : 0)} |`);

/** What delone.check() says of triangles. Those of the others turn either way. */
function verdict(points, triangles) {
  const t = delone.Triangulation.ofCells(points, 2, triangles), report = t.check({ oriented: false });
  const missing = points.length / 2 - new Set(triangles).size;
  const text = report.ok !== 1 ? `wrong: ${report.violation.split(";")[0]}` : missing > 0 ? `wrong: it lacks ${missing} of the points` : "right";
  report.free();
  t.free();
  return text;
}

const pointsOf = (n, point) => Float64Array.from({ length: 2 * n }, (_, i) => point(i >> 1)[i & 1]);
const sets = {
  "17 on a circle, rounded": pointsOf(17, (i) => [1 + 3 * Math.cos((2 * Math.PI * i) / 17), 1 + 3 * Math.sin((2 * Math.PI * i) / 17)]),
  "1000 on a circle, rounded": pointsOf(1000, (i) => [Math.cos(i), Math.sin(i)]),
  "5, four nearly on a line": pointsOf(5, (i) => (i < 4 ? [-537.7739674441619 + 42.24 * i, -122.26130468750004 - 61.13065234375 * i] : [-164, -122])),
  "1000 nearly on a line": pointsOf(1000, (i) => [i / 7, i / 3]),
  "1000 nearly on a line, far away": pointsOf(1000, (i) => [1e6 + i / 7, 1e6 + i / 3]),
  "a grid of 100 by 100": pointsOf(10000, (i) => [i % 100, Math.floor(i / 100)]),
  "a grid of 100 by 100, turned": pointsOf(10000, (i) => [0.6 * (i % 100) - 0.8 * Math.floor(i / 100), 0.8 * (i % 100) + 0.6 * Math.floor(i / 100)]),
  "10000 at random": uniform(10000),
  "1000 of size 1e-200": uniform(1000).map((x) => x * 1e-200),
  "1000 of size 1e200": uniform(1000).map((x) => x * 1e200),
};
console.log("\n| points | delone | delaunator | d3-delaunay |\n|---|---|---|---|");
for (const [name, points] of Object.entries(sets)) {
  const t = new delone.Delaunay(points, 2);
  const own = t.check().ok === 1 && t.numVertices === points.length / 2 ? `right, ${t.numCells} cells` : "wrong";
  // d3-delaunay moves the points of a set that seems to be on a line, in the array itself.
  const theirs = [() => new Delaunator(points.slice()).triangles, () => new D3(points.slice()).triangles].map((make) => {
    try {
      const triangles = make();
      return `${verdict(points, triangles)}, ${triangles.length / 3} cells`;
    } catch (error) {
      return `fails: ${error.message}`;
    }
  });
  console.log(`| ${[name, own, ...theirs].join(" | ")} |`);
}
