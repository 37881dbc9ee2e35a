// SPDX-License-Identifier: BSD-3-Clause
// Triangulations, hulls, diagrams and other objects of the C interface as classes. docs/js.md describes them, index.d.ts has their types.
import {
  bytesAt, call, doublesAt, exactly, fileContent, integersAt, matrix, module, nameInJs, numbers, text, withFile, withMemory, withOptions,
} from "./calls.js";
import { InputError } from "./errors.js";

export { version } from "./calls.js";
export * from "./errors.js";

/** Where a query lies, as `kinds` of locate() says. */
export const Location = Object.freeze({ inside: 0, onFace: 1, onVertex: 2, outsideHull: 3, outsideAffineHull: 4 });

const states = new WeakMap(); // of each object that is not freed: its pointer, and the copies of arrays that were read
const abandoned = new FinalizationRegistry((pointer) => module._delone_free(pointer));

function stateOf(object) {
  const state = states.get(object);
  if (state === undefined) throw new InputError("the object has been freed, or is none of delone");
  return state;
}
const pointerOf = (object) => stateOf(object).pointer;

/** The pointer of an object of a class. */
function pointerIn(Class, object) {
  if (!(object instanceof Class)) throw new InputError(`an object of the class ${Class.name} is wanted`);
  return pointerOf(object);
}

/** The pointer to the object that make(place) writes, a call of the library. */
function made(make, progress) {
  return withMemory((memory) => {
    const place = memory.allocate(4);
    call(() => make(place), progress);
    return module.HEAPU32[place >>> 2];
  });
}

const arrayTypes = { 1: Float64Array, 2: Int32Array, 3: BigInt64Array, 4: Uint8Array };

/** An array of an object: a view into the memory of the module, with its shape. */
function borrowed(object, nameInC) {
  return withMemory((memory) => {
    const place = memory.allocate(20);
    call(() => module._delone_get_array(pointerOf(object), memory.text(nameInC), place));
    const [data, type, rank, rows, columns] = new Uint32Array(module.HEAPU8.buffer, place, 5);
    return { view: new arrayTypes[type](module.HEAPU8.buffer, data, rows * columns), shape: rank === 1 ? [rows] : [rows, columns] };
  });
}

const members = {
  /** A copy, made once. Numbers of 64 bits become doubles, which are exact up to 2^53. */
  1(object, name) {
    const { copies } = stateOf(object);
    if (!copies.has(name)) {
      const { view } = borrowed(object, name);
      copies.set(name, view instanceof BigInt64Array ? Float64Array.from(view, Number) : view.slice());
    }
    return copies.get(name);
  },
  2: (object, name) => withMemory((memory) => {
    const place = memory.allocate(8);
    call(() => module._delone_get_integer(pointerOf(object), memory.text(name), place));
    return Number(new BigInt64Array(module.HEAPU8.buffer, place, 1)[0]);
  }),
  3: (object, name) => withMemory((memory) => {
    const place = memory.allocate(8);
    call(() => module._delone_get_real(pointerOf(object), memory.text(name), place));
    return module.HEAPF64[place >>> 3];
  }),
  4: (object, name) => withMemory((memory) => {
    const place = memory.allocate(4);
    call(() => module._delone_get_text(pointerOf(object), memory.text(name), place));
    return text(module.HEAPU32[place >>> 2]);
  }),
};

/** The members of an object: [name in JavaScript, name in C, type], those of the list in delone.h. */
function* membersOf(pointer) {
  yield* withMemory((memory) => {
    const type = memory.allocate(4), found = [];
    for (let i = 0; ; ++i) {
      const name = module._delone_member(pointer, i, type);
      if (name === 0) return found;
      const inC = text(name);
      found.push([nameInJs(inC), inC, module.HEAP32[type >>> 2]]);
    }
  });
}

const namesInC = new WeakMap(); // of each class whose members are known: name in JavaScript → name in C, of arrays

/**
 * Makes an object of the class of a pointer, which it owns from then on. Members belong to the class, but those of
 * cells of sites to the object, as the options decide which there are.
 */
function adopt(Class, pointer, object = Object.create(Class.prototype)) {
  states.set(object, { pointer, copies: new Map() });
  abandoned.register(object, pointer, object);
  const owner = Class === SiteCells ? object : Class.prototype;
  if (owner === object || !namesInC.has(Class)) {
    const arrays = new Map(namesInC.get(Class));
    for (const [name, inC, type] of membersOf(pointer)) {
      if (type === 1) arrays.set(name, inC);
      Object.defineProperty(owner, name, { get() { return members[type](this, inC); }, enumerable: true, configurable: true });
    }
    namesInC.set(Class, arrays);
  }
  return object;
}

/** In constructors, as classes may be derived from these. */
function become(object, pointer) {
  let Class = object.constructor;
  while (!ownClasses.has(Class)) Class = Object.getPrototypeOf(Class);
  adopt(Class, pointer, object);
}

function changed(object) {
  stateOf(object).copies.clear();
}

function arrayNameInC(object, name) {
  for (let Class = object.constructor; Class; Class = Object.getPrototypeOf(Class)) {
    const arrays = namesInC.get(Class);
    if (arrays === undefined) continue;
    if (arrays.has(name)) return arrays.get(name);
    throw new InputError(`there is no array ${name} here; there are ${[...arrays.keys()].join(", ")}`);
  }
}

/** What all objects have. */
class DeloneObject {
  /** Without a copy: valid until the next call of the library, and until the object changes or is freed. */
  view(name) {
    return borrowed(this, arrayNameInC(this, name)).view;
  }
  shape(name) {
    return borrowed(this, arrayNameInC(this, name)).shape;
  }
  free() {
    const state = states.get(this);
    if (state === undefined) return;
    states.delete(this);
    abandoned.unregister(this);
    module._delone_free(state.pointer);
  }
}
if (Symbol.dispose !== undefined) DeloneObject.prototype[Symbol.dispose] = DeloneObject.prototype.free;

/** What can be checked, and written as a file. */
class Result extends DeloneObject {
  check(options) {
    return withOptions(options, ["upTo", "canonical", "oriented", "furthestSite"], (pointer, progress) =>
      adopt(CheckReport, made((place) => module._delone_check(pointerOf(this), pointer, place), progress)));
  }
  toBytes(format) {
    return withMemory((memory) => withFile(`result.${format}`, undefined, (path) => {
      call(() => module._delone_write(pointerOf(this), memory.text(path), memory.text(String(format))));
      return fileContent(path);
    }));
  }
  clone() {
    let Class = this.constructor;
    while (!ownClasses.has(Class)) Class = Object.getPrototypeOf(Class);
    return adopt(Class, made((place) => module._delone_clone(pointerOf(this), place)));
  }
}

export class CheckReport extends DeloneObject {}

/** Lists, as arrays of their own: {offsets, …}. */
function lists(pointer, names) {
  const all = adopt(Lists, pointer);
  try {
    return Object.fromEntries(["offsets", ...names].map((name) => {
      const { view } = borrowed(all, name);
      return [name, view instanceof BigInt64Array ? Int32Array.from(view, Number) : view.slice()];
    }));
  } finally {
    all.free();
  }
}
class Lists extends DeloneObject {}

/** The result of ask(queries, their number, options, memory, progress), with queries that are rows of so many numbers. */
function query(object, queries, width, options, allowed, ask) {
  pointerOf(object);
  const rows = matrix(queries, width, "queries");
  return withOptions(options, allowed, (pointer, progress, memory) => ask(memory.doubles(rows.numbers), rows.count, pointer, memory, progress));
}

export class Triangulation extends Result {
  locate(queries, options) {
    return query(this, queries, this.dimension, options, ["tolerance", "outside"], (place, count, pointer, memory, progress) => {
      const corners = this.affineDimension + 1;
      const cells = memory.allocate(8 * count), kinds = memory.allocate(count), distances = memory.allocate(8 * count);
      const barycentric = memory.allocate(8 * count * Math.max(corners, 1));
      call(() => module._delone_locate(pointerOf(this), place, count, pointer, cells, kinds, barycentric, distances), progress);
      return {
        cells: integersAt(cells, count), kinds: bytesAt(kinds, count), barycentric: doublesAt(barycentric, count * Math.max(corners, 0)),
        distances: doublesAt(distances, count),
      };
    });
  }
  cellsWithin(queries, radius, options) {
    return query(this, queries, this.dimension, options, [], (place, count, pointer, memory, progress) =>
      lists(made((result) => module._delone_cells_within(pointerOf(this), place, count, radius, pointer, result), progress), ["cells"]));
  }
  static ofCells(points, dimension, cells, affineDimension = dimension, weights) {
    const rows = matrix(points, dimension, "points");
    return withMemory((memory) => {
      const place = memory.doubles(rows.numbers), of = weights === undefined ? 0 : memory.doubles(exactly(rows.count, weights, "weights"));
      const corners = matrix(cells, affineDimension + 1, "cells"), ids = memory.integers(corners.numbers, "cells");
      return adopt(Triangulation, made((result) =>
        module._delone_triangulation_of_cells(place, of, rows.count, rows.width, ids, corners.count, affineDimension, result)));
    });
  }
}
export class AlphaComplex extends Triangulation {}
export class TrimmedTriangulation extends Triangulation {}

const constructionOptions = ["seed", "order", "timeLimit"];

/** Makes `object` of points by make(points, their number, dimension, options, place, memory, number of points). */
function construct(object, points, dimension, options, allowed, make) {
  const rows = matrix(points, dimension, "points");
  withOptions(options, allowed, (pointer, progress, memory) => {
    const place = memory.doubles(rows.numbers);
    become(object, made((result) => make(place, rows.count, rows.width, pointer, result, memory), progress));
  });
}

/** Adds rows of numbers to an object that was made. */
function insert(object, rows, width, weights) {
  withMemory((memory) => {
    const all = matrix(rows, width, "rows"), place = memory.doubles(all.numbers);
    const of = weights === undefined ? 0 : memory.doubles(exactly(all.count, weights, "weights"));
    changed(object);
    call(() => module._delone_insert(pointerOf(object), place, all.count, of));
  });
}

/** What was constructed here: it can be changed, and answers more. */
class PointTriangulation extends Triangulation {
  insert(points, weights) {
    insert(this, points, this.dimension, weights);
  }
  remove(rows) {
    withMemory((memory) => {
      const place = memory.integers(numbers(rows, "rows"), "rows");
      changed(this);
      call(() => module._delone_remove(pointerOf(this), place, rows.length));
    });
  }
  move(rows, points, weights) {
    withMemory((memory) => {
      const place = memory.integers(numbers(rows, "rows"), "rows");
      const to = points === undefined ? 0 : memory.doubles(exactly(rows.length * this.dimension, matrix(points, this.dimension, "points").numbers, "points"));
      const of = weights === undefined ? 0 : memory.doubles(exactly(rows.length, weights, "weights"));
      changed(this);
      call(() => module._delone_move(pointerOf(this), place, rows.length, to, of));
    });
  }
  nearest(queries, count = 1, options = undefined) {
    if (!Number.isSafeInteger(count) || count < 0) throw new InputError("the number of nearest vertices is an integer of at least 0");
    return query(this, queries, this.dimension, options, [], (place, size, pointer, memory, progress) => {
      const rows = memory.allocate(8 * size * count);
      call(() => module._delone_nearest(pointerOf(this), place, size, count, pointer, rows), progress);
      return integersAt(rows, size * count);
    });
  }
  linearInterpolator(values) {
    return interpolator(this, values, (place, columns, _, result) => module._delone_linear_interpolator(pointerOf(this), place, columns, result));
  }
  trim(tolerance) {
    return adopt(TrimmedTriangulation, made((place) => module._delone_trim(pointerOf(this), tolerance, place)));
  }
  siteCells({ low, high, halfspaces = [], ...options } = {}) {
    const rows = matrix(halfspaces, this.dimension + 1, "halfspaces");
    return withOptions(options, ["properFaces", "vertices"], (pointer, progress, memory) => {
      const place = memory.doubles(rows.numbers);
      const box = [low, high].map((corner) => (corner === undefined ? 0 : memory.doubles(exactly(this.dimension, corner, "a corner of the box"))));
      return adopt(SiteCells, made((result) => module._delone_site_cells(pointerOf(this), ...box, place, rows.count, pointer, result), progress));
    });
  }
}

function alphaComplex(triangulation, radius, options) {
  return withOptions(options, [], (pointer, progress) =>
    adopt(AlphaComplex, made((place) => module._delone_alpha_complex(pointerOf(triangulation), radius, pointer, place), progress)));
}

export class Delaunay extends PointTriangulation {
  constructor(points, dimension, options) {
    super();
    construct(this, points, dimension, options, constructionOptions, (place, count, d, pointer, result) =>
      module._delone_delaunay(place, count, d, pointer, result));
  }
  alphaComplex(radius, options) {
    return alphaComplex(this, radius, options);
  }
  naturalNeighbors(queries, options) {
    return query(this, queries, this.dimension, options, ["tolerance", "outside"], (place, count, pointer, memory, progress) =>
      lists(made((result) => module._delone_natural_neighbors(pointerOf(this), place, count, pointer, result), progress), ["rows", "weights"]));
  }
  naturalNeighborInterpolator(values, { smooth = false, gradients } = {}) {
    const slopes = gradients === undefined ? [] : exactly(values.length * this.dimension, gradients, "gradients");
    return interpolator(this, values, (place, columns, memory, result) => {
      const of = gradients === undefined ? 0 : memory.doubles(slopes);
      return module._delone_natural_neighbor_interpolator(pointerOf(this), place, columns, smooth ? 1 : 0, of, result);
    });
  }
}

export class FurthestSite extends PointTriangulation {
  constructor(points, dimension, options) {
    super();
    construct(this, points, dimension, options, constructionOptions, (place, count, d, pointer, result) =>
      module._delone_furthest_site(place, count, d, pointer, result));
  }
}

export class Regular extends PointTriangulation {
  constructor(points, weights, dimension, options) {
    super();
    construct(this, points, dimension, options, constructionOptions, (place, count, d, pointer, result, memory) =>
      module._delone_regular(place, memory.doubles(exactly(count, weights, "weights")), count, d, pointer, result));
  }
  alphaComplex(radius, options) {
    return alphaComplex(this, radius, options);
  }
}

export class SiteCells extends DeloneObject {}

function interpolator(triangulation, values, make) {
  const rows = triangulation.numRows, all = numbers(values, "values"), columns = all.length / rows;
  if (!(Number.isInteger(columns) && columns > 0)) throw new InputError(`values: ${all.length} numbers are no columns of ${rows}`);
  return withMemory((memory) => {
    const place = memory.doubles(all);
    return adopt(Interpolator, made((result) => make(place, columns, memory, result)));
  });
}

/** Values, or gradients: `width` numbers for each query and column. */
function interpolated(from, queries, options, width, areGradients) {
  return query(from, queries, from.dimension, options, ["outside", "fill", "tolerance"], (place, count, pointer, memory, progress) => {
    const size = count * from.columns * width, answer = memory.allocate(8 * size), both = areGradients ? [0, answer] : [answer, 0];
    call(() => module._delone_interpolate(pointerOf(from), place, count, pointer, ...both), progress);
    return doublesAt(answer, size);
  });
}
export class Interpolator extends DeloneObject {
  interpolate(queries, options) {
    return interpolated(this, queries, options, 1, false);
  }
  gradients(queries, options) {
    return interpolated(this, queries, options, this.dimension, true);
  }
}

/** A hull that was read. */
export class Hull extends Result {}

export class ConvexHull extends Hull {
  constructor(points, dimension, options) {
    super();
    construct(this, points, dimension, options, [...constructionOptions, "tolerance", "axisTolerances"], (place, count, d, pointer, result) =>
      module._delone_convex_hull(place, count, d, pointer, result));
  }
  insert(points) {
    insert(this, points, this.dimension);
  }
  locate(queries, options) {
    return query(this, queries, this.dimension, options, [], (place, count, pointer, memory, progress) => {
      const cells = memory.allocate(8 * count), kinds = memory.allocate(count);
      call(() => module._delone_locate(pointerOf(this), place, count, pointer, cells, kinds, 0, 0), progress);
      return { cells: integersAt(cells, count), kinds: bytesAt(kinds, count) };
    });
  }
  visibleFacets(queries) {
    return query(this, queries, this.dimension, undefined, [], (place, count) =>
      lists(made((result) => module._delone_visible_facets(pointerOf(this), place, count, result)), ["facets"]));
  }
}

/** Lower and upper hulls. */
class Envelope extends Result {
  locate(compositions, options) {
    return query(this, compositions, this.compositionDimension, options, [], (place, count, pointer, memory, progress) => {
      const cells = memory.allocate(8 * count);
      call(() => module._delone_locate(pointerOf(this), place, count, pointer, cells, 0, 0, 0), progress);
      return { cells: integersAt(cells, count) };
    });
  }
  heights(compositions) {
    return query(this, compositions, this.dimension - 1, undefined, [], (place, count, _, memory) => {
      const heights = memory.allocate(8 * count);
      call(() => module._delone_heights(pointerOf(this), place, count, heights));
      return doublesAt(heights, count);
    });
  }
  heightAbove(points, options) {
    return query(this, points, this.dimension, options, ["tolerance"], (place, count, pointer, memory, progress) => {
      const heights = memory.allocate(8 * count);
      call(() => module._delone_height_above(pointerOf(this), place, count, pointer, heights), progress);
      return doublesAt(heights, count);
    });
  }
}
export class LowerHull extends Envelope {
  constructor(points, dimension, options) {
    super();
    construct(this, points, dimension, options, [...constructionOptions, "tolerance", "axisTolerances"], (place, count, d, pointer, result) =>
      module._delone_lower_hull(place, count, d, pointer, result));
  }
}
export class UpperHull extends Envelope {
  constructor(points, dimension, options) {
    super();
    construct(this, points, dimension, options, [...constructionOptions, "tolerance", "axisTolerances"], (place, count, d, pointer, result) =>
      module._delone_upper_hull(place, count, d, pointer, result));
  }
}

export class ConvexHulls extends DeloneObject {
  constructor(points, offsets, dimension, options) {
    super();
    const rows = matrix(points, dimension, "points"), at = Uint32Array.from(numbers(offsets, "offsets"));
    if (at.length === 0 || at[0] !== 0 || at.at(-1) !== rows.count || at.some((offset, i) => offset !== offsets[i]))
      throw new InputError(`offsets are integers from 0 to ${rows.count}, the number of points`);
    withOptions(options, constructionOptions, (pointer, progress, memory) => {
      const place = memory.doubles(rows.numbers), sets = memory.allocate(4 * at.length);
      module.HEAPU32.set(at, sets >>> 2);
      become(this, made((result) => module._delone_convex_hulls(place, rows.count, rows.width, sets, at.length - 1, pointer, result), progress));
    });
  }
  intersectionVolumes(pairs, options) {
    const rows = matrix(pairs, 2, "pairs");
    return withOptions(options, [], (pointer, progress, memory) => {
      const place = memory.integers(rows.numbers, "pairs"), volumes = memory.allocate(8 * rows.count);
      call(() => module._delone_intersection_volumes(pointerOf(this), place, rows.count, pointer, volumes), progress);
      return doublesAt(volumes, rows.count);
    });
  }
}

/** An intersection of halfspaces that was read. */
export class Intersection extends Result {}

export class HalfspaceIntersection extends Intersection {
  constructor(halfspaces, dimension, { interiorPoint, ...options } = {}) {
    super();
    const rows = matrix(halfspaces, dimension === undefined ? undefined : dimension + 1, "halfspaces");
    withOptions(options, constructionOptions, (pointer, progress, memory) => {
      const place = memory.doubles(rows.numbers), d = rows.width - 1;
      const inside = interiorPoint === undefined ? 0 : memory.doubles(exactly(d, interiorPoint, "interiorPoint"));
      become(this, made((result) => module._delone_halfspace_intersection(place, rows.count, d, inside, pointer, result), progress));
    });
  }
  insert(halfspaces) {
    insert(this, halfspaces, this.dimension + 1);
  }
}

/** A diagram that was read. */
export class Diagram extends Result {}

class MadeDiagram extends Diagram {
  constructor(Class, triangulation, options) {
    super();
    const of = pointerIn(Class, triangulation);
    withOptions(options, ["tolerance", "axisTolerances"], (pointer, progress) => {
      become(this, made((place) => module._delone_voronoi(of, pointer, place), progress));
    });
  }
  regionVolumesIn(low, high, options) {
    return withOptions(options, [], (pointer, progress, memory) => {
      const corners = [memory.doubles(exactly(this.dimension, low, "low")), memory.doubles(exactly(this.dimension, high, "high"))];
      const count = this.numRegions, volumes = memory.allocate(8 * count);
      call(() => module._delone_region_volumes(pointerOf(this), ...corners, pointer, volumes), progress);
      return doublesAt(volumes, count);
    });
  }
}
export class Voronoi extends MadeDiagram {
  constructor(triangulation, options) {
    super(Delaunay, triangulation, options);
  }
}
export class PowerDiagram extends MadeDiagram {
  constructor(triangulation, options) {
    super(Regular, triangulation, options);
  }
}
export class FurthestVoronoi extends MadeDiagram {
  constructor(triangulation, options) {
    super(FurthestSite, triangulation, options);
  }
}

const ownClasses = new Set([
  CheckReport, Lists, Triangulation, AlphaComplex, TrimmedTriangulation, Delaunay, FurthestSite, Regular, SiteCells, Interpolator, Hull, ConvexHull,
  LowerHull, UpperHull, ConvexHulls, Intersection, HalfspaceIntersection, Diagram, Voronoi, PowerDiagram, FurthestVoronoi,
]);

function sign(ask, points, d) {
  return withMemory((memory) => {
    const place = memory.doubles(points), answer = memory.allocate(4);
    call(() => ask(memory, place, d, answer));
    return module.HEAP32[answer >>> 2];
  });
}
export function orientation(points, dimension) {
  const rows = matrix(points, dimension, "points");
  exactly((rows.width + 1) * rows.width, rows.numbers, "points");
  return sign((_, place, d, answer) => module._delone_orientation(place, d, answer), rows.numbers, rows.width);
}
export function inSphere(points, point, dimension) {
  const rows = matrix(points, dimension, "points");
  exactly((rows.width + 1) * rows.width, rows.numbers, "points");
  exactly(rows.width, point, "the query");
  return sign((memory, place, d, answer) => module._delone_in_sphere(place, memory.doubles(point), d, answer), rows.numbers, rows.width);
}

/** What a file holds. `name`: of the file, for its extension and for messages. */
export function read(bytes, name, options) {
  return withOptions(options, ["format"], (pointer, progress, memory) => withFile(name, bytes, (path) => {
    const read = made((place) => module._delone_read(memory.text(path), pointer, place), progress);
    const Class = { triangulation: Triangulation, hull: Hull, intersection: Intersection, diagram: Diagram }[text(module._delone_kind(read))];
    return adopt(Class, read);
  }));
}

class Points extends DeloneObject {}
ownClasses.add(Points);

/** The points of a file: {points, dimension, skippedRows}. */
export function readPoints(bytes, name, options) {
  return withOptions(options, ["format", "columns", "skipMissing"], (pointer, progress, memory) => withFile(name, bytes, (path) => {
    const read = adopt(Points, made((place) => module._delone_read_points(memory.text(path), pointer, place), progress));
    try {
      return { points: read.points, dimension: read.dimension, skippedRows: read.skippedRows };
    } finally {
      read.free();
    }
  }));
}
export function writePoints(points, dimension, format) {
  const rows = matrix(points, dimension, "points");
  return withMemory((memory) => withFile(`points.${format}`, undefined, (path) => {
    const place = memory.doubles(rows.numbers);
    call(() => module._delone_write_points(place, rows.count, rows.width, memory.text(path), memory.text(String(format))));
    return fileContent(path);
  }));
}
