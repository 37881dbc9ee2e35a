// SPDX-License-Identifier: BSD-3-Clause
// What TypeScript takes, and what it refuses: each @ts-expect-error is an error if the line below it is none.
import { CheckReport, ConvexHull, Delaunay, HalfspaceIntersection, InputError, Location, PowerDiagram, Regular, Triangulation, Voronoi, inSphere, read } from "delone";

const t = new Delaunay(Float64Array.of(0, 0, 1, 0, 0, 1), 2, { seed: 1, progress: (fraction) => fraction > 0.5 });
const cells: Int32Array = t.cells, hash: string = t.hash, shape: [number] | [number, number] = t.shape("cells");
const where = t.locate([[0.5, 0.5]], { outside: "project" });
const inside: boolean = where.kinds[0] === Location.inside;
const report: CheckReport = t.clone().check({ canonical: true });
const volumes: Float64Array = new Voronoi(t).regionVolumesIn([0, 0], [1, 1]);
const weighted = new PowerDiagram(new Regular([[0, 0], [1, 1]], [0, 1]));
const hull = new ConvexHull([[0, 0, 0]], 3, { tolerance: 0.1 }), box = new HalfspaceIntersection([[1, -1]], 1, { interiorPoint: [0] });
const side: -1 | 0 | 1 = inSphere([[0, 0], [1, 0], [0, 1]], [1, 1]);
const file = read(t.toBytes("npz"), "t.npz");
if (file instanceof Triangulation) console.log(file.numCells);
try {
  t.remove([7]);
} catch (error) {
  if (error instanceof InputError) console.log(error.rows.length, error.status);
}

// @ts-expect-error: points are numbers
new Delaunay(["0", "1"], 1);
// @ts-expect-error: there is no such option
new Delaunay([0, 1], 1, { sead: 1 });
// @ts-expect-error: members cannot be set
t.cells = cells;
// @ts-expect-error: the diagram of weighted points is a power diagram
new Voronoi(new Regular([[0, 0]], [0]));
// @ts-expect-error: hulls have no neighbors of queries
hull.nearest([[0, 0, 0]]);

export { box, hash, inside, report, shape, side, volumes, weighted };
