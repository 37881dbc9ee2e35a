// SPDX-License-Identifier: BSD-3-Clause
// The tests of the npm package, for Node (package_test.mjs) and for browsers (page.html): casesOf(delone, reference) are [name, test].

class Failure extends Error {}

function fail(message) {
  throw new Failure(message);
}
function equal(a, b, what = "value") {
  const [x, y] = [a, b].map((value) => (ArrayBuffer.isView(value) ? Array.from(value) : value)).map((value) => JSON.stringify(value));
  if (x !== y) fail(`${what} is ${x}, and not ${y}`);
}
function throws(run, Class, message, more = {}) {
  try {
    run();
  } catch (error) {
    if (!(error instanceof Class)) throw error;
    if (!message.test(error.message)) fail(`the message is: ${error.message}`);
    for (const [name, value] of Object.entries(more)) equal(error[name], value, name);
    return;
  }
  fail(`no ${Class.name} was thrown`);
}

async function digest(values) {
  const numbers = Float64Array.from(values, (x) => Number(x)), words = new BigUint64Array(numbers.buffer);
  for (let i = 0; i < numbers.length; ++i) if (Number.isNaN(numbers[i])) words[i] = 0x7ff8000000000000n;
  const hash = await crypto.subtle.digest("SHA-256", numbers);
  return Array.from(new Uint8Array(hash), (byte) => byte.toString(16).padStart(2, "0")).join("");
}
const decoded = (base64) => new Float64Array(Uint8Array.from(atob(base64), (c) => c.charCodeAt(0)).buffer);
const camelCase = (name) => name.replace(/_([a-z0-9])/g, (_, letter) => letter.toUpperCase());

function constructed(delone, of) {
  const rows = decoded(of.rows), d = of.dimension, weights = of.weights === undefined ? undefined : decoded(of.weights);
  switch (of.product) {
    case "Regular": return new delone.Regular(rows, weights, d);
    case "Voronoi": return new delone.Voronoi(new delone.Delaunay(rows, d));
    case "PowerDiagram": return new delone.PowerDiagram(new delone.Regular(rows, weights, d));
    case "AlphaComplex": return new delone.Delaunay(rows, d).alphaComplex(of.radius);
    default: return new delone[of.product](rows, d);
  }
}

/** All members equal those of the native library, bit by bit. */
async function sameAsNative(delone, of) {
  const object = constructed(delone, of);
  for (const [name, expected] of Object.entries(of.members)) {
    const value = object[camelCase(name)];
    if (value === undefined) fail(`there is no member ${camelCase(name)}`);
    const found = ArrayBuffer.isView(value) ? await digest(value)
      : /^[0-9a-f]{64}$/.test(expected) ? await digest([value]) : String(value);
    if (found !== expected) fail(`${name} is ${found} (${ArrayBuffer.isView(value) ? `${value.length} numbers: ${value.slice(0, 8)}` : value}), and not ${expected}`);
  }
  object.free();
}

const square = Float64Array.of(0, 0, 1, 0, 0, 1, 1, 1);

/** Ways to use the package, and to use it wrongly. */
function usage(delone) {
  const { Delaunay, Regular, ConvexHull, HalfspaceIntersection, Voronoi, InputError, CancelledError, TimeLimitError, OutOfMemoryError, Location } = delone;
  const random = (n) => {
    let state = 1;
    return Float64Array.from({ length: n }, () => (state = (state * 48271) % 2147483647) / 2147483647);
  };
  return {
    "points as rows, and as numbers of any type"() {
      const { hash } = new Delaunay(square, 2);
      for (const points of [[[0, 0], [1, 0], [0, 1], [1, 1]], Array.from(square, (_, i) => [square.slice(2 * i, 2 * i + 2)][0]).slice(0, 4)])
        equal(new Delaunay(points).hash, hash);
      for (const points of [Array.from(square), Float32Array.from(square), Int8Array.from(square)]) equal(new Delaunay(points, 2).hash, hash);
    },
    "arrays are copies that stay"() {
      const t = new Delaunay(square, 2), { cells } = t;
      equal(t.cells === cells, true);
      equal(t.shape("cells"), [2, 3]);
      equal(cells instanceof Int32Array, true);
      const before = Array.from(cells);
      t.free();
      equal(cells, before);
    },
    "views are of the memory, and end when it grows"() {
      const t = new Delaunay(square, 2), view = t.view("points");
      equal(view, square);
      equal(t.view("vertexOfPoint"), [0, 1, 2, 3]);
      const big = new Delaunay(random(400000), 2); // makes the memory grow
      equal(view.length, 0);
      equal(t.points, square);
      equal(new Delaunay(t.view("points"), 2).hash, t.hash); // an argument that is a view
      equal(new Delaunay(big.view("points"), 2).hash, big.hash);
      big.free();
    },
    "freed objects are told"() {
      const t = new Delaunay(square, 2);
      t.free();
      t.free();
      throws(() => t.cells, InputError, /freed/);
      throws(() => t.locate(square), InputError, /freed/);
      throws(() => new Voronoi(t), InputError, /freed/);
    },
    "objects may be freed in any order"() {
      const t = new Delaunay(random(300), 3), v = new Voronoi(t), f = t.linearInterpolator(random(100));
      t.free();
      equal(v.numRegions, 100);
      equal(f.interpolate([[0.5, 0.5, 0.5]]).length, 1);
    },
    "memory is given back"() {
      const points = random(60000);
      const grown = () => {
        for (let i = 0; i < 20; ++i) new Delaunay(points, 3).free();
        return new Delaunay(square, 2).view("points").buffer.byteLength;
      };
      equal(grown(), grown());
    },
    "what is wrong with points is said"() {
      throws(() => new Delaunay([[0, 0], [1, NaN]]), InputError, /point 1 is not finite/, { status: "not_finite", rows: [1] });
      throws(() => new Delaunay(Float64Array.of(0, 0, Infinity, 1), 2), InputError, /point 1 is not finite/, { status: "not_finite", name: "InputError" });
      throws(() => new Delaunay(Float64Array.of(0, 0, 1), 2), InputError, /3 numbers are no rows of 2/, { status: "bad_dimension" });
      throws(() => new Delaunay(square), InputError, /dimension is missing/);
      throws(() => new Delaunay(square, 0), InputError, /dimension is 0/);
      throws(() => new Delaunay(square, 2.5), InputError, /dimension is 2.5/);
      throws(() => new Delaunay([[0, 0], [1]]), InputError, /row 1 has 1 numbers, and not 2/, { rows: [1] });
      throws(() => new Delaunay([[0, 0], [1, null]]), InputError, /row 1: entry 1 is null/);
      throws(() => new Delaunay([[0, 0], ["1", 1]]), InputError, /row 1: entry 0 is 1, which is no number/);
      throws(() => new Delaunay("0 0 1 1", 2), InputError, /array of numbers/);
      throws(() => new Delaunay(new BigInt64Array(4), 2), InputError, /array of numbers/);
      throws(() => new Regular(square, [1, 2], 2), InputError, /weights: 2 numbers, and not 4/);
    },
    "wrong options and arguments are told"() {
      throws(() => new Delaunay(square, 2, { sead: 1 }), InputError, /no option sead here; there are seed/);
      throws(() => new Delaunay(square, 2, { seed: 1.5 }), InputError, /seed is an integer/);
      throws(() => new Delaunay(square, 2, { order: "sorted" }), InputError, /sorted/);
      throws(() => new ConvexHull(square, 2, { tolerance: -1 }), InputError, /tolerance/);
      throws(() => new Delaunay(square, 2, { progress: 1 }), InputError, /function/);
      throws(() => new Delaunay(square, 2).alphaComplex(-1), InputError, /radius/);
      throws(() => new Delaunay(square, 2).view("cellz"), InputError, /no array cellz here; there are .*cells/);
      throws(() => new Voronoi(square), InputError, /class Delaunay/);
      throws(() => new Delaunay(square, 2).remove([9]), InputError, /9/);
      throws(() => new Delaunay(square, 2).nearest(square, -1), InputError, /at least 0/);
      throws(() => new Delaunay(square, 2).locate([[1]]), InputError, /row 0 has 1 numbers/);
      throws(() => new Delaunay(square, 2).locate([[1, NaN]]), InputError, /query 0 is not finite/, { status: "not_finite" });
      throws(() => new HalfspaceIntersection([[1, 0, -1], [-1, 0, -1]], 2, { interiorPoint: [5, 5] }), InputError, /interior/);
    },
    "limits of time and memory are errors of their own"() {
      throws(() => new Delaunay(random(150000), 3, { timeLimit: 1e-3 }), TimeLimitError, /./, { status: "time_limit" });
      const t = new Delaunay(square, 2);
      for (const count of [5e8, 1e10]) // arrays that are larger than the memory, and than the addresses, of the module
        throws(() => t.nearest(square, count), OutOfMemoryError, /no memory/, { status: "out_of_memory" });
      equal(new Delaunay(square, 2).numCells, 2); // it works on
    },
    "progress is told, and can stop"() {
      const points = random(150000), told = [];
      const t = new Delaunay(points, 3, { progress: (fraction) => void told.push(fraction) });
      equal(told.length > 1, true, "told");
      equal(told.every((x, i) => x >= (told[i - 1] ?? 0) && x <= 1), true, "told");
      t.free();
      throws(() => new Delaunay(points, 3, { progress: () => true }), CancelledError, /./, { status: "cancelled" });
      throws(() => new Delaunay(points, 3, { progress() { throw new RangeError("mine"); } }), RangeError, /mine/);
      throws(() => new Delaunay(points, 3, { progress: () => new Delaunay(square, 2).hash === "" || new Delaunay([[NaN, 0]]) }), InputError, /point 0 is not finite/);
      equal(new Delaunay(square, 2, {}).numCells, 2);
    },
    "locates, and finds what is nearest"() {
      const t = new Delaunay(square, 2);
      const { cells, kinds, barycentric, distances } = t.locate([[0.25, 0.5], [0.5, 0.5], [1, 0], [2, 2]]);
      equal(kinds, [Location.inside, Location.onFace, Location.onVertex, Location.outsideHull]);
      equal(cells[3], -1);
      equal(barycentric.slice(0, 3).reduce((a, b) => a + b), 1);
      equal(distances.length, 4);
      equal(t.nearest([[0.1, 0.1], [0.9, 0.8]], 2), [0, 1, 3, 1]);
      equal(t.cellsWithin([[5, 5]], 1), { offsets: { 0: 0, 1: 0 }, cells: {} });
      const { offsets, rows, weights } = t.naturalNeighbors([[0.5, 0.5]]);
      equal(offsets, [0, rows.length]);
      equal(weights.reduce((a, b) => a + b), 1);
    },
    "changes as often as one likes"() {
      const t = new Delaunay(square, 2), { hash } = t;
      t.insert([[0.5, 0.5]]);
      equal(t.numCells, 4);
      equal(t.points.length, 10);
      t.move([4], [[0.25, 0.5]]);
      equal(t.numCells, 4);
      t.remove([4]);
      equal([t.numCells, t.hash], [2, hash]);
      const copy = t.clone();
      t.insert([[3, 3]]);
      equal([copy.numCells, copy instanceof Delaunay], [2, true]);
    },
    "hulls, halfspaces and diagrams"() {
      const cube = Float64Array.from({ length: 24 }, (_, i) => (Math.floor(i / 3) >> (i % 3)) & 1);
      const hull = new ConvexHull(cube, 3);
      equal([hull.numFacets, hull.volume, hull.area], [6, 1, 6]);
      equal(hull.locate([[0.5, 0.5, 0.5], [2, 0, 0]]).kinds, [Location.inside, Location.outsideHull]);
      equal(hull.visibleFacets([[5, 0.5, 0.5]]).facets.length, 1);
      const faces = [[1, 0, 0, -1], [-1, 0, 0, -1], [0, 1, 0, -1], [0, -1, 0, -1], [0, 0, 1, -1], [0, 0, -1, -1]];
      const box = new HalfspaceIntersection(faces);
      equal([box.state, box.numVertices, box.volume], ["full", 8, 8]);
      const v = new Voronoi(new Delaunay(square, 2));
      equal(v.regionVolumesIn([0, 0], [1, 1]), [0.25, 0.25, 0.25, 0.25]);
      const cells = new Delaunay(square, 2).siteCells({ low: [0, 0], high: [1, 1] });
      equal(cells.volumes, [0.25, 0.25, 0.25, 0.25]);
      equal(cells.vertices, undefined);
      const polygons = new Delaunay(square, 2).siteCells({ low: [0, 0], high: [1, 1], properFaces: true, vertices: true });
      equal(polygons.vertexOffsets, [0, 4, 8, 12, 16]);
      equal([polygons.vertices.length, polygons.faceVertices.length], [32, 32]);
      const hulls = new delone.ConvexHulls([[0, 0], [1, 0], [0, 1], [0, 0], [1, 0], [1, 1]], [0, 3, 6]);
      equal(hulls.volumes, [0.5, 0.5]);
      equal(Math.abs(hulls.intersectionVolumes([[0, 1]])[0] - 0.25) < 1e-15, true);
      const lower = new delone.LowerHull([[0, 0], [1, 0.25], [2, 0]]);
      equal([lower.heights([[1]])[0], lower.heightAbove([[1, 0.25]])[0]], [0, 0.25]);
    },
    "classes may be derived"() {
      class Mesh extends Delaunay {
        get mean() { return this.numCells / this.numVertices; }
      }
      const mesh = new Mesh(square, 2);
      equal([mesh.mean, mesh.shape("cells")[0]], [0.5, 2]);
    },
    "predicates are exact"() {
      const a = [[0, 0], [1, 1], [2, 2]], b = [[0, 0], [1, 1], [2, 2 + 2 ** -51]];
      equal([delone.orientation(a), delone.orientation(b)], [0, 1]);
      equal(delone.inSphere([[0, 0], [1, 0], [0, 1]], [1, 1]), 0);
      equal(delone.inSphere([[0, 0], [1, 0], [0, 1]], [1, 1 - 2 ** -53]), 1);
    },
    "checks prove, and find what is wrong"() {
      const report = new Delaunay(random(300), 3).check();
      equal([report.ok, report.violation], [1, ""]);
      const bad = delone.Triangulation.ofCells([[0, 0], [4, 0], [2, 1], [2, -1]], 2, [[0, 1, 2], [1, 0, 3]]);
      const found = bad.check();
      equal(found.ok, 0);
      if (found.violation === "") fail("no violation is told");
      throws(() => delone.Triangulation.ofCells(square, 2, [[0, 1, 7]]), InputError, /7/);
    },
    "files"() {
      const t = new Delaunay(random(90), 3);
      for (const format of ["npz", "json", "off"]) {
        const again = delone.read(t.toBytes(format), `t.${format}`);
        equal([again.hash, again instanceof delone.Triangulation], [t.hash, true]);
      }
      if (!/<canvas|<html/i.test(new TextDecoder().decode(t.toBytes("html")))) fail("no page");
      equal(delone.read(new ConvexHull(square, 2).toBytes("npz"), "h.npz").numFacets, 4);
      throws(() => t.toBytes("doc"), InputError, /doc/, { status: "unsupported" });
      const bytes = (text) => new TextEncoder().encode(text);
      const { points, dimension } = delone.readPoints(bytes("x,y\n0,0\n1,0.5\n"), "points.csv");
      equal([Array.from(points), dimension], [[0, 0, 1, 0.5], 2]);
      throws(() => delone.readPoints(bytes("0 0\n1 x\n"), "/some/folder/points.txt"), InputError, /^points\.txt:2: .*'x' is not a number/, { status: "bad_format" });
      throws(() => delone.readPoints(bytes(""), "points.doc"), InputError, /points\.doc/);
      equal(delone.readPoints(bytes("1 2\n\nnan 3\n"), "p.txt", { skipMissing: true }).dimension, 2);
      equal(delone.readPoints(bytes("a,b,c\n1,2,3\n"), "p.csv", { columns: ["c", 0] }).points, [3, 1]);
      for (const format of ["npy", "csv", "xyz"])
        equal(delone.readPoints(delone.writePoints(random(6), 3, format), `p.${format}`).points, random(6));
    },
    "interpolates"() {
      const t = new Delaunay(square, 2), values = [0, 1, 2, 3, 0, 10, 20, 30]; // x + 2 y, and a second column
      const linear = t.linearInterpolator(values.slice(0, 4)), smooth = t.naturalNeighborInterpolator(values.slice(0, 4), { smooth: true });
      equal(linear.interpolate([[0.25, 0.5], [9, 9]]), [1.25, NaN]);
      equal(linear.interpolate([[9, 9]], { fill: -1 }), [-1]);
      equal(linear.gradients([[0.25, 0.5]]), [1, 2]);
      equal(Math.abs(smooth.interpolate([[0.25, 0.5]])[0] - 1.25) < 1e-12, true);
      equal(t.linearInterpolator(values).interpolate([[0.5, 0.5]]).length, 2);
      throws(() => t.linearInterpolator([1, 2, 3]), InputError, /3 numbers are no columns of 4/);
      throws(() => linear.interpolate([[9, 9]], { outside: "error" }), InputError, /./);
      t.insert([[0.5, 0.5]]);
      throws(() => linear.interpolate([[0.5, 0.5]]), InputError, /changed/);
    },
    "arithmetic is that of IEEE 754"() {
      // Denormals are numbers, products are not fused with sums: the hull of points that only such arithmetic tells apart.
      const points = [[0, 0], [5e-324, 0], [0, 5e-324], [5e-324, 5e-324], [1, 1]];
      equal(new ConvexHull(points).numVertices, 4);
      equal(new Delaunay(points).numVertices, 5);
    },
  };
}

export function casesOf(delone, reference) {
  return [
    ...Object.entries(usage(delone)),
    ...reference.map((of) => [`${of.product} of ${of.name}`, () => sameAsNative(delone, of)]),
  ];
}
