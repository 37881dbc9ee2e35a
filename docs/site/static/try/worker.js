// SPDX-License-Identifier: BSD-3-Clause
// What try.js has computed: points of a file, a product of them, a page that shows it, files of it.
let delone; // the package
const number = new Intl.NumberFormat("en");
const largestPage = 2000000; // cells: pages of more are slow

const products = {
  delaunay: (points, dimension, _, options) => new delone.Delaunay(points, dimension, options),
  hull: (points, dimension, _, options) => new delone.ConvexHull(points, dimension, options),
  voronoi(points, dimension, _, options) {
    const t = new delone.Delaunay(points, dimension, options);
    try {
      return new delone.Voronoi(t);
    } finally {
      t.free();
    }
  },
  alpha(points, dimension, radius, options) {
    const t = new delone.Delaunay(points, dimension, options);
    try {
      return t.alphaComplex(radius ?? t.circumradii.sort()[Math.floor(t.numCells / 2)] ?? 0);
    } finally {
      t.free();
    }
  },
};

function summaryOf(product, one) {
  const counts = {
    delaunay: [["cells", one.numCells], ["vertices", one.numVertices], ["duplicates", one.numDuplicates]],
    hull: [["facets", one.numFacets], ["extreme points", one.numVertices], ["volume", one.volume]],
    voronoi: [["regions", one.numRegions], ["vertices", one.numVertices], ["ridges", one.numRidges]],
    alpha: [["cells", one.numCells], ["facets of the boundary", one.boundary?.length / Math.max(one.affineDimension, 1)]],
  }[product];
  return counts.map(([name, value]) => `${name}: ${number.format(value)}`).join(", ");
}

function compute({ name, content, product, radius }) {
  const { points, dimension } = delone.readPoints(content, name);
  let told = 0;
  const progress = (fraction) => {
    if (performance.now() - told < 100) return;
    told = performance.now();
    self.postMessage({ event: "progress", fraction });
  };
  const start = performance.now(), one = products[product](points, dimension, radius, { progress });
  const seconds = (performance.now() - start) / 1000;
  try {
    const summary = `${number.format(points.length / dimension)} points in dimension ${dimension}. ${summaryOf(product, one)}. ${seconds.toFixed(seconds < 1 ? 3 : 1)} s.`;
    let page = null, why = "";
    try {
      if ((one.numCells ?? one.numRidges) <= largestPage) page = one.toBytes("html");
    } catch (error) {
      why = ` No picture: ${error.message}.`;
    }
    const files = ["npz", "json"].map((format) => [`${product}.${format}`, one.toBytes(format)]);
    self.postMessage({ event: "result", summary: summary + why, page, files });
  } finally {
    one.free();
  }
}

self.onmessage = ({ data }) => {
  try {
    compute(data);
  } catch (error) {
    self.postMessage({ event: "failure", message: error.message });
  }
};
try {
  delone = await import("../delone/index.js");
  self.postMessage({ event: "ready" });
} catch (error) {
  self.postMessage({ event: "unable", message: error.message });
}
