// SPDX-License-Identifier: BSD-3-Clause
// The types of the package. docs/js.md of the documentation describes it; delone.h of the C interface says more of each member.

/** A failure. `status` is its name in the C interface, such as "not_finite"; `rows` has the rows concerned. */
export class DeloneError extends Error {
  readonly status: string;
  readonly rows: number[];
}
/** The caller's numbers, arguments, options or files are wrong. */
export class InputError extends DeloneError {}
export class OutOfMemoryError extends DeloneError {}
export class TimeLimitError extends DeloneError {}
export class CancelledError extends DeloneError {}

/** Numbers, which are converted to doubles. */
export type Numbers =
  | Float64Array | Float32Array | Int8Array | Uint8Array | Uint8ClampedArray | Int16Array | Uint16Array | Int32Array | Uint32Array
  | readonly number[];
/** Rows of numbers: flat, one after the other, or an array for each row. */
export type Rows = Numbers | readonly Numbers[];
type Borrowed = Float64Array | Int32Array | BigInt64Array | Uint8Array;

export interface CallOptions {
  /** Called with the fraction done, about every 20 ms. If it returns true, the call ends with a CancelledError; if it throws, with that exception. */
  progress?: (fraction: number) => unknown;
}
export interface ConstructionOptions extends CallOptions {
  /** The seed of the insertion order; 0 by default. The result does not depend on it. */
  seed?: number;
  order?: "automatic" | "as_given" | "shuffled";
  /** The limit in seconds; 0: none. */
  timeLimit?: number;
}
export interface ToleranceOptions extends CallOptions {
  /** A distance >= 0; 0, the default, is exact. */
  tolerance?: number;
  /** One for each axis, in place of `tolerance`. */
  axisTolerances?: Numbers;
}
export interface QueryOptions extends CallOptions {
  tolerance?: number;
  /** What answers queries outside the convex hull. */
  outside?: "fill" | "nearest" | "error" | "project";
}
export interface CheckOptions extends CallOptions {
  /** The highest level to examine; 0: all. */
  upTo?: number;
  canonical?: boolean;
  oriented?: boolean;
  furthestSite?: boolean;
}

/** Where a query lies. */
export const Location: {
  readonly inside: 0;
  readonly onFace: 1;
  readonly onVertex: 2;
  readonly outsideHull: 3;
  readonly outsideAffineHull: 4;
};

/** An object of the library. Arrays among its members are copied when they are first read. */
declare class DeloneObject {
  protected constructor();
  /** An array without a copy: valid until the next call of the package, and until the object changes or is freed. */
  view(name: string): Borrowed;
  /** The shape of an array: [length], or [rows, columns]. */
  shape(name: string): [number] | [number, number];
  /** Releases the object's memory. Otherwise the garbage collector does, some time after the last reference is gone. */
  free(): void;
}

declare class Result extends DeloneObject {
  /** Proves that the object is right, exactly, or says what is wrong. */
  check(options?: CheckOptions): CheckReport;
  /** The content of a file with the object: "npz", "json", "html" and others. */
  toBytes(format: string): Uint8Array;
  clone(): this;
}

export class CheckReport extends DeloneObject {
  readonly ok: number;
  readonly level: number;
  readonly ties: number;
  readonly levelName: string;
  readonly levelMeaning: string;
  readonly violation: string;
  readonly notExamined: string;
  readonly cells: Float64Array;
  readonly points: Float64Array;
  readonly vertices: Float64Array;
  readonly halfspaces: Float64Array;
}

export interface Located {
  /** A cell that contains the query; -1: none. */
  cells: Int32Array;
  /** Of Location. */
  kinds: Uint8Array;
  /** affineDimension + 1 numbers for each query; NaN outside. */
  barycentric: Float64Array;
  /** A bound on the distance of the point that answers from the query. */
  distances: Float64Array;
}

/** Cells that were read or given. Points are named by rows, cells by rows of `cells`, from 0; -1 is none. */
export class Triangulation extends Result {
  /** Cells of the caller, affineDimension + 1 rows each, to be checked, searched or written. */
  static ofCells(points: Rows, dimension: number, cells: Rows, affineDimension?: number, weights?: Numbers): Triangulation;
  readonly kind: string;
  readonly dimension: number;
  readonly affineDimension: number;
  readonly numPoints: number;
  readonly numCells: number;
  readonly hash: string;
  readonly points: Float64Array;
  readonly weights: Float64Array;
  readonly cells: Int32Array;
  /** Number i of a cell is opposite its vertex i; -1: outside the hull. */
  readonly neighbors: Int32Array;
  readonly vertexOfPoint: Int32Array;
  locate(queries: Rows, options?: QueryOptions): Located;
  /** List i is entries offsets[i] to offsets[i + 1] - 1. */
  cellsWithin(queries: Rows, radius: number, options?: CallOptions): { offsets: Int32Array; cells: Int32Array };
}
export class AlphaComplex extends Triangulation {
  readonly cellNumbers: Int32Array;
  readonly boundary: Int32Array;
  readonly boundaryCells: Int32Array;
  readonly singularFacets: Int32Array;
}
export class TrimmedTriangulation extends Triangulation {
  readonly kept: Uint8Array;
  readonly orphans: Int32Array;
  readonly depth: number;
  readonly lostVolume: number;
}

declare class PointTriangulation extends Triangulation {
  readonly numRows: number;
  readonly numVertices: number;
  readonly numDuplicates: number;
  readonly numHidden: number;
  readonly numInfiniteCells: number;
  readonly edges: Int32Array;
  readonly hullFacets: Int32Array;
  readonly axes: Int32Array;
  readonly circumcenters: Float64Array;
  readonly circumradii: Float64Array;
  /** Inserts all points or, after an error, none. Only a Regular triangulation takes weights. */
  insert(points: Rows, weights?: Numbers): void;
  /** The other rows keep their numbers. Those of removed rows are not used again. */
  remove(rows: Numbers): void;
  move(rows: Numbers, points?: Rows, weights?: Numbers): void;
  /** The rows of the `count` nearest vertices of each query, nearest first; -1 if there are fewer. */
  nearest(queries: Rows, count?: number, options?: CallOptions): Int32Array;
  /** `values`: a number, or several, for each row. */
  linearInterpolator(values: Numbers): Interpolator;
  trim(tolerance: number): TrimmedTriangulation;
  /** The regions of the Voronoi or power diagram, measured without a diagram. */
  siteCells(options?: CallOptions & { low?: Numbers; high?: Numbers; halfspaces?: Rows; properFaces?: boolean; vertices?: boolean }): SiteCells;
}
export class Delaunay extends PointTriangulation {
  constructor(points: Rows, dimension?: number, options?: ConstructionOptions);
  alphaComplex(radius: number, options?: CallOptions): AlphaComplex;
  naturalNeighbors(queries: Rows, options?: QueryOptions): { offsets: Int32Array; rows: Int32Array; weights: Float64Array };
  naturalNeighborInterpolator(values: Numbers, how?: { smooth?: boolean; gradients?: Numbers }): Interpolator;
}
export class FurthestSite extends PointTriangulation {
  constructor(points: Rows, dimension?: number, options?: ConstructionOptions);
}
export class Regular extends PointTriangulation {
  constructor(points: Rows, weights: Numbers, dimension?: number, options?: ConstructionOptions);
  alphaComplex(radius: number, options?: CallOptions): AlphaComplex;
}

export class SiteCells extends DeloneObject {
  readonly dimension: number;
  readonly volumes: Float64Array;
  readonly centroids: Float64Array;
  readonly areas: Float64Array;
  readonly numFaces: Int32Array;
  readonly numEdges: Int32Array;
  readonly neighborOffsets: Float64Array;
  readonly neighbors: Int32Array;
  readonly faceAreas: Float64Array;
  readonly distances: Float64Array;
  /** This and the next three: with the option `vertices`. */
  readonly vertexOffsets?: Float64Array;
  readonly vertices?: Float64Array;
  readonly faceVertexOffsets?: Float64Array;
  readonly faceVertices?: Int32Array;
}

export class Interpolator extends DeloneObject {
  readonly dimension: number;
  readonly columns: number;
  interpolate(queries: Rows, options?: QueryOptions & { fill?: number }): Float64Array;
  gradients(queries: Rows, options?: QueryOptions & { fill?: number }): Float64Array;
}

/** A hull that was read. */
export class Hull extends Result {
  readonly kind: string;
  readonly dimension: number;
  readonly affineDimension: number;
  readonly numPoints: number;
  readonly numCells: number;
  readonly numFacets: number;
  readonly numRidges: number;
  readonly numVertices: number;
  readonly tolerance: number;
  readonly maxDistance: number;
  readonly points: Float64Array;
  readonly cells: Int32Array;
  readonly neighbors: Int32Array;
  readonly facetOfCell: Int32Array;
  readonly facetOffsets: Int32Array;
  readonly facetVertices: Int32Array;
  readonly ridgeFacets: Int32Array;
  readonly ridgeOffsets: Int32Array;
  readonly ridgeVertices: Int32Array;
  readonly equations: Float64Array;
  readonly equationErrors: Float64Array;
  readonly vertices: Int32Array;
  readonly vertexOfPoint: Int32Array;
  readonly pointKinds: Uint8Array;
  readonly axes: Int32Array;
  readonly axisTolerances: Float64Array;
}
export class ConvexHull extends Hull {
  constructor(points: Rows, dimension?: number, options?: ConstructionOptions & ToleranceOptions);
  readonly numDuplicates: number;
  readonly volume: number;
  readonly volumeError: number;
  readonly area: number;
  readonly areaError: number;
  readonly hash: string;
  readonly fVector: Float64Array;
  insert(points: Rows): void;
  locate(queries: Rows, options?: CallOptions): { cells: Int32Array; kinds: Uint8Array };
  visibleFacets(queries: Rows): { offsets: Int32Array; facets: Int32Array };
}

declare class Envelope extends Result {
  readonly dimension: number;
  readonly compositionDimension: number;
  readonly numPoints: number;
  readonly numCells: number;
  readonly numFacets: number;
  readonly tolerance: number;
  readonly maxDistance: number;
  readonly cells: Int32Array;
  readonly neighbors: Int32Array;
  readonly facetOfCell: Int32Array;
  readonly vertices: Int32Array;
  readonly compositionAxes: Int32Array;
  locate(compositions: Rows, options?: CallOptions): { cells: Int32Array };
  heights(compositions: Rows): Float64Array;
  heightAbove(points: Rows, options?: CallOptions & { tolerance?: number }): Float64Array;
}
/** The lower part of a hull with respect to the last coordinate. */
export class LowerHull extends Envelope {
  constructor(points: Rows, dimension?: number, options?: ConstructionOptions & ToleranceOptions);
}
export class UpperHull extends Envelope {
  constructor(points: Rows, dimension?: number, options?: ConstructionOptions & ToleranceOptions);
}

/** Hulls of many sets: set i is rows offsets[i] to offsets[i + 1] - 1. */
export class ConvexHulls extends DeloneObject {
  constructor(points: Rows, offsets: Numbers, dimension?: number, options?: ConstructionOptions);
  readonly dimension: number;
  readonly numHulls: number;
  readonly points: Float64Array;
  readonly affineDimensions: Int32Array;
  readonly vertexOffsets: Float64Array;
  readonly cellOffsets: Float64Array;
  readonly vertices: Int32Array;
  readonly cells: Int32Array;
  readonly neighbors: Int32Array;
  readonly equations: Float64Array;
  readonly volumes: Float64Array;
  readonly areas: Float64Array;
  /** Of pairs of hulls. */
  intersectionVolumes(pairs: Rows, options?: CallOptions): Float64Array;
}

/** An intersection of halfspaces that was read. */
export class Intersection extends Result {
  readonly kind: string;
  /** "full", "flat" or "empty". */
  readonly state: string;
  readonly dimension: number;
  readonly rank: number;
  readonly numHalfspaces: number;
  readonly numVertices: number;
  readonly numDirections: number;
  readonly numEdges: number;
  readonly numRays: number;
  readonly numFacets: number;
  readonly bounded: number;
  readonly interiorPointIsExact: number;
  readonly halfspaces: Float64Array;
  readonly firstOfHalfspace: Int32Array;
  readonly kinds: Uint8Array;
  readonly witness: Int32Array;
  readonly interiorPoint: Float64Array;
  readonly axes: Int32Array;
  readonly vertices: Float64Array;
  readonly vertexOffsets: Int32Array;
  readonly vertexHalfspaces: Int32Array;
  readonly directions: Float64Array;
  readonly directionOffsets: Int32Array;
  readonly directionHalfspaces: Int32Array;
  readonly edges: Int32Array;
  readonly rays: Int32Array;
  readonly facetHalfspaces: Int32Array;
  readonly facetOffsets: Int32Array;
  readonly facetVertices: Int32Array;
  readonly facetDirectionOffsets: Int32Array;
  readonly facetDirections: Int32Array;
  readonly lineality: Float64Array;
  readonly dualPoints: Float64Array;
  readonly dualEquations: Float64Array;
}
/** The points x with n.x + c <= 0 for all rows (n, c) of dimension + 1 numbers. */
export class HalfspaceIntersection extends Intersection {
  constructor(halfspaces: Rows, dimension?: number, options?: ConstructionOptions & { interiorPoint?: Numbers });
  readonly volume: number;
  readonly dualVolume: number;
  readonly dualArea: number;
  insert(halfspaces: Rows): void;
}

/** A diagram that was read. */
export class Diagram extends Result {
  readonly kind: string;
  readonly dimension: number;
  readonly affineDimension: number;
  readonly numPoints: number;
  readonly numVertices: number;
  readonly numRegions: number;
  readonly numRidges: number;
  readonly numRays: number;
  readonly tolerance: number;
  readonly points: Float64Array;
  readonly weights: Float64Array;
  readonly vertices: Float64Array;
  readonly ridgePoints: Int32Array;
  readonly ridgeOffsets: Float64Array;
  readonly ridgeVertices: Int32Array;
  readonly regionOffsets: Float64Array;
  readonly regionVertices: Int32Array;
  readonly pointRegion: Int32Array;
  readonly rayVertices: Int32Array;
  readonly rayDirections: Float64Array;
  readonly rayPoints: Int32Array;
  readonly axisTolerances: Float64Array;
}
declare class MadeDiagram extends Diagram {
  readonly numUnboundedRegions: number;
  readonly maxDisplacement: number;
  readonly regionPoints: Int32Array;
  readonly regionVolumes: Float64Array;
  readonly ridgeVolumes: Float64Array;
  /** Of the parts of regions in a box. */
  regionVolumesIn(low: Numbers, high: Numbers, options?: CallOptions): Float64Array;
}
export class Voronoi extends MadeDiagram {
  constructor(triangulation: Delaunay, options?: ToleranceOptions);
}
export class PowerDiagram extends MadeDiagram {
  constructor(triangulation: Regular, options?: ToleranceOptions);
}
export class FurthestVoronoi extends MadeDiagram {
  constructor(triangulation: FurthestSite, options?: ToleranceOptions);
}

/** The sign of the orientation of dimension + 1 points, exactly. */
export function orientation(points: Rows, dimension?: number): -1 | 0 | 1;
/** 1: inside the sphere through dimension + 1 points, 0: on it, -1: outside, exactly. */
export function inSphere(points: Rows, query: Numbers, dimension?: number): -1 | 0 | 1;

/** What a file holds. `name` is the name of the file, for its extension and for messages. */
export function read(bytes: Uint8Array, name: string, options?: CallOptions & { format?: string }): Triangulation | Hull | Intersection | Diagram;
/** The points of a file. */
export function readPoints(
  bytes: Uint8Array, name: string, options?: CallOptions & { format?: string; columns?: string | number | readonly (string | number)[]; skipMissing?: boolean },
): { points: Float64Array; dimension: number; skippedRows: Int32Array };
export function writePoints(points: Rows, dimension: number | undefined, format: string): Uint8Array;

/** The version of the library. */
export const version: string;
