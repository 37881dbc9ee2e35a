// SPDX-License-Identifier: BSD-3-Clause
// The page: reads its data, makes the model, and connects picture and settings.
import { readScene } from "./decode.js";
import { dualLines, hullLines, KIND, Lines, pointLines, segmentLines } from "./lines.js";
import { gradientOf, MAP_NAMES } from "./colors.js";
import { finished, Loading } from "./loading.js";
import { Model } from "./model.js";
import { LEAST_PIXELS, pixelsOfCells, pixelsOfCut, sampleOf } from "./outline.js";
import { counted, Panel, shown } from "./panel.js";
import { Picture } from "./picture.js";
import { Quantity } from "./quantities.js";
import { select } from "./selection.js";
import { Space } from "./space.js";

const MANY_LINES = 20000;
const FEW_POINTS = 3000;  // are shown
const SAMPLE = 1500;  // of more
const TICKS = [0, 0.25, 0.5, 0.75, 1];  // of the legend
const $ = (id) => document.getElementById(id);

class Viewer {
  constructor(scene, loading) {
    this.scene = scene;
    this.loading = loading;
    this.space = new Space(scene);
    this.isFlat = scene.dimension <= 2;
    this.isSpatial = !this.isFlat;
    this.manyDimensions = scene.dimension > 3;
    this.overlays = { points: null, hull: null, dual: null, sample: null };
    this.hovered = null;
    this.picture = new Picture($("picture"), { flat: this.isFlat, antialias: scene.numCells < 400000 });
    this.picture.beforeFrame = () => {
      this.showAxes();
      this.showOutline();
    };
    // Of a solid triangulation one wants to see the inside, if its cells can be told apart.
    this.isSolid = scene.kind === "triangulation" && scene.corners === 4 && scene.dimension === 3;
    this.plane = { on: this.isSolid && pixelsOfCut(this.picture, scene.numCells) >= LEAST_PIXELS, axis: 1, part: 0.5, flipped: false };
    this.isOutline = false;
  }

  async make() {
    const { scene, picture, loading } = this, left = loading.total - loading.done;
    this.model = await loading.run(0.8 * left, Model.of(scene));
    this.centroids = await loading.run(0.2 * left, this.space.centroidsOf(this.model));
    this.quantities = this.listQuantities();
    picture.setModel(this.model);
    picture.setItems("positions", this.space.positions, 4);
    this.makePanel();
    this.paint();
    matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => this.paint());
    this.colorBy($("color").value);
    this.setFaces($("faces")?.value ?? "solid");
    this.setStretch(this.isStretched);
    this.choose();
    picture.finish("choose");
    for (const name of ["points", "hull", "dual"]) if ($(name)?.checked) this.toggle(name, true);
    if (scene.segments || scene.corners === 2 || scene.corners === 1) this.combine();
    this.listen();
  }

  listQuantities() {
    const { scene } = this, result = new Map();
    const k = scene.affineDimension;
    if (scene.value) result.set("value", new Quantity(scene.valueName, scene.value, { ofVertices: scene.valueOfVertices }));
    if (scene.radius) result.set("radius", new Quantity("circumradius", scene.radius, { log: true, robust: true }));
    if (scene.quality) result.set("quality", new Quantity("quality", scene.quality, { limits: [0, 1] }));
    if (scene.volume) result.set("volume", new Quantity(["", "length", "area", "volume"][Math.min(k, 3)], scene.volume, { log: true, robust: true }));
    const d = scene.dimension, vertices = this.space.unit.length / d;
    for (let axis = 0; axis < Math.min(d, 12); ++axis) {
      const values = new Float32Array(vertices);
      for (let v = 0; v < vertices; ++v) values[v] = this.space.userCoordinate(axis, this.space.unit[d * v + axis]);
      result.set("axis" + axis, new Quantity(scene.columns[axis], values, { ofVertices: true }));
    }
    return result;
  }

  get cellWord() {
    return this.scene.cellWord;
  }

  makePanel() {
    const { scene, picture, quantities } = this, panel = new Panel($("settings"));
    document.title = scene.title;
    $("title").textContent = scene.title;
    $("summary").textContent = scene.summary;

    panel.group("Color");
    const first = quantities.has("value") ? "value" : quantities.has("volume") ? "volume"
      : this.manyDimensions && scene.kind === "triangulation" ? "axis3"
      : scene.kind !== "triangulation" && scene.kind !== "diagram" || this.isSolid && !this.plane.on ? "axis" + (scene.dimension - 1)
      : quantities.has("quality") ? "quality" : quantities.has("radius") ? "radius" : "axis0";
    panel.select("by", "color", [...[...quantities].map(([id, { name }]) => [id, name]), ["none", "one color"]], first, (id) => {
      this.showCells();
      this.colorBy(id);
    });
    panel.select("map", "map", MAP_NAMES.map((name) => [name, name]), "viridis", (name) => {
      picture.setMap(name);
      this.showLegend();
    });

    panel.select("scale", "scale", [["linear", "linear"], ["log", "logarithmic"], ["rank", "by rank"]], "linear", (scale) => {
      if (this.color) Object.assign(this.color, { scale, isCrowded: false });
      this.showCells();
      this.colorBy($("color").value);
    });

    const filters = [...quantities].filter(([, q]) => !q.ofVertices && scene.numCells > 1);
    if (filters.length > 0) {
      panel.group(`Show ${this.cellWord}s with`);
      this.filter = { id: filters.some(([id]) => id === "radius") ? "radius" : filters[0][0], low: 0, high: 1 };
      panel.select("", "filter", filters.map(([id, { name }]) => [id, name]), this.filter.id, (id) => {
        this.filter.id = id;
        this.choose();
      });
      panel.range("from", "filter-low", 0, (part) => {
        this.filter.low = part;
        this.choose();
      });
      panel.range("to", "filter-high", 1000, (part) => {
        this.filter.high = part;
        this.choose();
      });
      panel.output("filter-range");
    }

    if (this.isSpatial && scene.numCells > 1) {
      panel.group("Slice");
      panel.check(`cut by a plane, ${this.cellWord}s left whole`, "slice", this.plane.on, (on) => {
        this.plane.on = on;
        this.choose();
      });
      panel.select("across", "slice-axis", [0, 1, 2].map((j) => [j, this.space.names[j]]).concat([[3, "this view"]]), 1, (axis) => {
        this.plane.axis = Number(axis);
        this.plane.on = $("slice").checked = true;
        if (this.plane.axis === 3) this.plane.normal = picture.towardsCamera();
        this.choose();
      });
      panel.range("at", "slice-at", 500, (part) => {
        this.plane.part = part;
        this.plane.on = $("slice").checked = true;
        this.choose();
      });
      panel.check("the other side", "slice-flip", false, (on) => {
        this.plane.flipped = on;
        this.choose();
      });
    }

    panel.group("Draw");
    if (scene.numCells > 0 && scene.corners !== 2 && scene.corners !== 1)
      panel.select("faces", "faces", [["solid", "solid"], ["glass", "glass"], ["none", "none"]], this.manyDimensions ? "glass" : "solid",
                   (kind) => this.setFaces(kind));
    panel.check("edges", "edges", true, (on) => picture.setEdges(on && !this.isOutline));
    const few = this.space.unit.length / scene.dimension <= FEW_POINTS;
    panel.check(scene.kind === "diagram" ? "sites" : "points", "points", scene.sites ? few : few && this.isFlat || scene.corners <= 2 && scene.corners > 0,
                (on) => this.toggle("points", on));
    if ((scene.kind === "triangulation" || scene.kind === "alpha") && (scene.corners === 3 || scene.corners === 4) && !this.manyDimensions)
      panel.check(scene.kind === "alpha" ? "boundary" : "hull", "hull", this.isFlat, (on) => this.toggle("hull", on));
    if (this.isFlat && this.model.numTriangles > 0)
      panel.check("outline, if cells are too small", "outline", true, () => picture.draw());
    if (scene.dual) panel.check(scene.weights ? "power diagram" : "Voronoi diagram", "dual", false, (on) => this.toggle("dual", on));
    const [a, b, c] = this.space.extent, least = Math.min(...[a, b, c].filter((x) => x > 0));
    this.isStretched = least < 0.02;
    panel.check("axes of equal length", "stretch", this.isStretched, (on) => this.setStretch(on));

    if (this.manyDimensions) {
      panel.group("Coordinates");
      const axes = scene.columns.map((name, j) => [j, name]);
      panel.select("show", "projection", [["axes", "three coordinates"], ["slanted", "all, slanted"], ["principal", "principal axes"]], "axes", () => this.project());
      for (let r = 0; r < 3; ++r) panel.select(["right", "back", "up"][r], "axis" + r, axes, r, () => this.project());
    }

    panel.group("View");
    panel.buttons(["Show all", "reset", () => picture.fit(this.space.box, this.space.positions)], ["Save as PNG", "save", () => this.save()]);
    panel.note((this.isFlat ? "Drag to move, scroll or pinch to zoom. " : "Drag to turn, right-drag or two fingers to move, scroll or pinch to zoom. ") +
               "Keys: arrows, Shift + arrows, + −, 0, Enter. " +
               (scene.positionError > 0 ? `Positions are rounded: by at most ${shown(scene.positionError)}.` : ""));
    $("fold").addEventListener("click", () => {
      const folded = $("panel").classList.toggle("folded");
      $("fold").setAttribute("aria-expanded", String(!folded));
    });
    if (matchMedia("(max-width: 720px)").matches) $("fold").click();
  }

  // Colors.

  paint() {
    const dark = matchMedia("(prefers-color-scheme: dark)").matches, { uniforms, lineUniforms, renderer } = this.picture;
    renderer.setClearColor(dark ? 0x14171b : 0xffffff, 1);
    uniforms.plain.value.setRGB(...(dark ? [0.42, 0.58, 0.75] : [0.72, 0.82, 0.92]));
    uniforms.edgeColor.value.setRGB(...(dark ? [0.02, 0.03, 0.05] : [0.07, 0.1, 0.15]));
    if (this.manyDimensions) uniforms.edgeColor.value.setRGB(...(dark ? [0.75, 0.8, 0.88] : [0.12, 0.2, 0.3]));
    const paints = dark
      ? [1, 0.62, 0.38, 1, 0.88, 0.9, 0.94, 1, 0.95, 0.96, 0.98, 1, 1, 1, 1, 1, 0.55, 0.72, 0.92, 1, 1, 0.62, 0.38, 1]
      : [0.80, 0.22, 0.13, 1, 0.08, 0.1, 0.14, 1, 0.08, 0.1, 0.14, 1, 0, 0, 0, 1, 0.16, 0.36, 0.62, 1, 0.80, 0.22, 0.13, 1];
    lineUniforms.paints.value.set(paints);
    this.picture.draw();
  }
  colorBy(id) {
    this.color = this.quantities.get(id) ?? null;
    const { picture } = this;
    picture.uniforms.colored.value = this.color !== null && !this.isOutline;
    picture.uniforms.ofVertices.value = this.color?.ofVertices ?? false;
    $("scale").disabled = this.color === null;
    $("scale").options[1].disabled = !this.color?.canBeLog;
    if (this.color) $("scale").value = this.color.scale;
    if (this.color) picture.setItems("scalars", this.color.scalars(), 1);
    if (this.scene.corners === 2 || this.scene.segments) this.combine();
    this.showLegend();
    picture.draw();
  }
  showLegend() {
    const { color } = this;
    const isColored = color !== null && !this.isOutline && color.from <= color.to, part = (name) => $("legend").querySelector("." + name);
    const notes = [this.outlineNote()];
    if (isColored && color.scale === "rank")
      notes.push((color.isCrowded ? "Most values are close together, so each" : "Each") + " color is used equally often.");
    part("why").textContent = notes.join(" ").trim();
    $("legend").hidden = !isColored && part("why").textContent === "";
    for (const name of ["name", "bar", "ticks"]) part(name).hidden = !isColored;
    if (!isColored) return;
    part("name").textContent = color.name + { linear: "", log: " (logarithmic)", rank: " (by rank)" }[color.scale];
    part("bar").style.background = gradientOf($("map").value);
    const numbers = TICKS.map((place) => color.numberAt(place)), [low, high] = [numbers[0], numbers.at(-1)];
    const texts = numbers.map((number, i) => (i === 0 && color.low < number ? "≤ " : i === 4 && color.high > number ? "≥ " : "") + shown(number));
    const isNarrow = texts.join("   ").length > 38;
    part("ticks").replaceChildren(...texts.map((textContent, i) => {
      const isLeftOut = i > 0 && i < 4 && !(low < high) || i % 2 === 1 && isNarrow;
      return Object.assign(document.createElement("span"), { textContent: isLeftOut ? "" : textContent, style: `left: ${100 * TICKS[i]}%` });
    }));
  }

  /** Of the plane: colors of cells that are too small to be told apart would be dust. Then their outline is shown, and some points. */
  showOutline() {
    const { picture, space } = this;
    if (!$("outline")) return;
    const isOutline = $("outline").checked && this.color !== null && !this.color.ofVertices &&
      pixelsOfCells(picture, this.centroids, space.box) < LEAST_PIXELS;
    if (isOutline === this.isOutline) return;
    this.isOutline = isOutline;
    picture.uniforms.colored.value = this.color !== null && !isOutline;
    picture.setEdges($("edges").checked && !isOutline);
    this.overlays.sample = isOutline ? pointLines(sampleOf(this.placesOfPoints(), SAMPLE), KIND.point) : null;
    this.combine();
    this.showLegend();
  }
  /** What is shown in place of the cells, if anything. */
  outlineNote() {
    const { scene, plane, picture } = this, outline = `The outline of ${counted(scene.numCells, this.cellWord)}`;
    if (this.isOutline)
      return `${outline}, too small to be seen here, and a sample of ${scene.sites ? "sites" : "points"}. Zoom in, or choose a color.`;
    if (this.isSolid && !plane.on && this.numShown === scene.numCells && pixelsOfCut(picture, scene.numCells) < LEAST_PIXELS)
      return `${outline}. Slice to see inside.`;
    return "";
  }
  /** The cells themselves, however small. */
  showCells() {
    if ($("outline")) $("outline").checked = false;
  }
  /** Where the points are, or the sites. */
  placesOfPoints() {
    const { scene, space } = this;
    return scene.sites ? space.turned(space.unitOf(scene.sites, 2 ** (8 * scene.blocks.sites.bytes) - 1)) : space.positions;
  }

  // Which cells.

  choose() {
    const { picture, model, filter } = this;
    let range = null;
    if (filter && (filter.low > 0 || filter.high < 1)) {
      const quantity = this.quantities.get(filter.id);
      range = { values: quantity.values, low: quantity.quantile(filter.low), high: quantity.quantile(filter.high) };
    }
    const steps = select(model, this.centroids, { plane: this.slicePlane(), range }, picture.chosen);
    picture.start("choose", steps, ({ count, numShown, shown: cells }) => {
      picture.show(count);
      this.numShown = numShown;
      this.shownCells = cells;
      const output = $("filter-range");
      if (output) output.textContent = (range ? `${shown(range.low)} … ${shown(range.high)}: ` : "") + `${counted(numShown, this.cellWord)}`;
      if (this.scene.corners === 2) this.combine();
      this.showLegend();
    });
  }
  slicePlane() {
    const { plane, centroids } = this;
    if (!plane.on) return null;
    // Normals point to where the camera is in the beginning.
    let normal = plane.axis === 3 ? plane.normal : [[1, 0, 0], [0, -1, 0], [0, 0, 1]][plane.axis];
    if (plane.flipped) normal = normal.map((x) => -x);
    if (this.extent?.of !== centroids || this.extent.along !== String(normal)) {
      let low = Infinity, high = -Infinity;
      for (let i = 0; i < centroids.length; i += 3) {
        const t = normal[0] * centroids[i] + normal[1] * centroids[i + 1] + normal[2] * centroids[i + 2];
        if (t < low) low = t;
        if (t > high) high = t;
      }
      this.extent = { of: centroids, along: String(normal), low, high };
    }
    const { low, high } = this.extent;
    const upward = (plane.axis === 1) === plane.flipped;  // whether the slider goes along the normal
    return { normal, offset: low + (high - low) * (upward ? plane.part : 1 - plane.part) };
  }

  // What is drawn besides cells.

  setFaces(kind) {
    this.picture.setOpacity({ solid: 1, glass: this.manyDimensions ? 0.1 : 0.28, none: 0 }[kind]);
  }
  setStretch(on) {
    this.isStretched = on;
    const { low, high } = this.space.box;
    this.picture.setStretch(low.map((x, j) => (on && high[j] > x ? 1 / (high[j] - x) : 1)));
    this.picture.fit(this.space.box, this.space.positions);
  }
  toggle(name, on) {
    const { picture, space, model, scene } = this;
    if (!on) {
      this.overlays[name] = null;
      picture.jobs = picture.jobs.filter((job) => job.name !== name);
      return this.combine();
    }
    if (name === "points") {
      this.overlays.points = pointLines(this.placesOfPoints(), scene.kind === "diagram" ? KIND.site : KIND.point);
      return this.combine();
    }
    const generator = name === "hull" ? hullLines(model, space.positions) : dualLines(model, space);
    picture.start(name, generator, (lines) => {
      this.overlays[name] = lines;
      this.combine();
    });
  }
  /** All lines and points as one draw call. */
  combine() {
    const { scene, space } = this, lines = new Lines();
    const scalars = this.color && !this.color.ofVertices ? this.color.scalars() : null;
    if (scene.segments) lines.append(segmentLines(space.positions, scene.segments, null));
    if (scene.corners === 2) {
      let cells = scene.cells, ofCells = scalars;
      if (this.shownCells && this.numShown < scene.numCells) {
        cells = scene.cells.filter((_, i) => this.shownCells[i >> 1]);
        ofCells = scalars?.filter((_, i) => this.shownCells[i]);
      }
      lines.append(segmentLines(space.positions, cells, ofCells));
    }
    for (const overlay of Object.values(this.overlays)) if (overlay) lines.append(overlay);
    if (this.hovered !== null && lines.count < MANY_LINES)  // among many its color tells the cell
      for (const [a, b] of this.model.edgesOf(this.hovered)) lines.between(space.positions, a, b, KIND.hovered);
    this.picture.setLines(lines);
  }

  async project() {
    const { space, picture } = this;
    const kind = $("projection").value;
    if (kind === "principal") space.usePrincipalAxes();
    else space.useAxes([0, 1, 2].map((r) => Number($("axis" + r).value)), kind === "slanted");
    for (let r = 0; r < 3; ++r) $("axis" + r).disabled = kind === "principal";
    picture.setItems("positions", space.positions, 4);
    this.centroids = await finished(space.centroidsOf(this.model));
    if ($("slice-axis")) for (const [j, option] of Array.from($("slice-axis").options).slice(0, 3).entries()) option.textContent = space.names[j];
    this.choose();
    if (this.overlays.points) this.toggle("points", true);
    else this.combine();
    this.setStretch(this.isStretched);
  }

  /** The directions of the axes, in a corner. */
  showAxes() {
    if (this.isFlat || !this.space.names.some((name) => name !== "")) return;
    const e = this.picture.camera.matrixWorldInverse.elements;
    $("axes").innerHTML = [0, 1, 2].map((j) => {
      const x = 34 * e[4 * j], y = -34 * e[4 * j + 1], away = 1 + 11 / Math.max(Math.hypot(x, y), 8);
      const full = this.space.names[j].replace(/[<&]/g, ""), name = full.length > 9 ? full.slice(0, 8) + "…" : full;
      return `<line x2="${x.toFixed(1)}" y2="${y.toFixed(1)}"/><text x="${(x * away).toFixed(1)}" y="${(y * away).toFixed(1)}">${name}</text>`;
    }).join("");
  }

  // The cell under the pointer.

  listen() {
    const canvas = $("picture");
    let waiting = 0, dragging = false;
    canvas.addEventListener("pointerdown", () => {
      dragging = true;
      $("tip").hidden = true;
    });
    addEventListener("pointerup", (event) => {
      dragging = false;
      if (event.pointerType === "touch" && event.target === canvas) this.nameAt(event.offsetX, event.offsetY);
    });
    canvas.addEventListener("pointermove", (event) => {
      clearTimeout(waiting);
      if (dragging || event.pointerType === "touch") return;
      waiting = setTimeout(() => this.nameAt(event.offsetX, event.offsetY), 40);
    });
    canvas.addEventListener("pointerleave", () => {
      clearTimeout(waiting);
      this.setHovered(null);
    });
    canvas.addEventListener("keydown", (event) => this.onKey(event));
  }
  onKey(event) {
    const { picture } = this, arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
    if (arrows[event.key] && !event.ctrlKey && !event.metaKey && !event.altKey) {
      const [x, y] = arrows[event.key];
      if (event.shiftKey || this.isFlat) picture.pan(0.06 * x, 0.06 * y);
      else picture.turn(0.09 * x, -0.09 * y);
    } else if (event.key === "+" || event.key === "=") picture.zoom(1.15);
    else if (event.key === "-") picture.zoom(1 / 1.15);
    else if (event.key === "0" || event.key === "Home") picture.fit(this.space.box, this.space.positions);
    else if (event.key === "Enter") this.nameAt(picture.canvas.clientWidth / 2, picture.canvas.clientHeight / 2);
    else if (event.key === "Escape") this.setHovered(null);
    else return;
    event.preventDefault();
  }
  /** Names the cell there, beside it and for screen readers; returns its number, or null. */
  async nameAt(x, y) {
    const found = await this.picture.pick(x, y);
    const cell = found === null ? null : this.model.cellOf(found.triangle, found.side);
    this.setHovered(cell);
    if (cell === null) return null;
    const { name, lines } = this.describe(cell), tip = $("tip");
    tip.replaceChildren(Object.assign(document.createElement("b"), { textContent: name }),
                        ...lines.map((text) => Object.assign(document.createElement("div"), { textContent: text })));
    tip.hidden = false;
    const { clientWidth: width, clientHeight: height } = this.picture.canvas;
    const left = x + 16 + tip.offsetWidth > width ? x - 16 - tip.offsetWidth : x + 16;
    tip.style.transform = `translate(${Math.max(4, left)}px, ${Math.min(Math.max(4, y + 16), Math.max(4, height - tip.offsetHeight - 4))}px)`;
    $("named").textContent = [name, ...lines].join(", ");
    return cell;
  }
  setHovered(cell) {
    if (cell === null) $("tip").hidden = true;
    if (cell === this.hovered) return;
    this.hovered = cell;
    this.picture.uniforms.hovered.value = cell ?? 0xffffffff;
    if (this.picture.lines.geometry.drawRange.count < 6 * MANY_LINES) this.combine();
    this.picture.draw();
  }
  /** What is known of a cell. */
  describe(cell) {
    const { scene } = this, lines = [];
    const name = scene.names ? scene.names[cell] : cell;
    const title = scene.kind === "intersection" ? `facet of halfspace ${name}` : scene.groups ? `facet ${scene.groups[cell]}, cell ${cell}` : `${this.cellWord} ${name}`;
    if (scene.siteRows) {
      lines.push(`of row ${scene.siteRows[cell]}`);
    } else if (scene.rows && scene.corners > 0) {
      lines.push("rows " + this.model.verticesOf(cell).map((v) => scene.rows[v]).join(", "));
    }
    for (const [id, quantity] of this.quantities) {
      if (id.startsWith("axis")) continue;
      const values = quantity.ofVertices ? this.model.verticesOf(cell).map((v) => quantity.values[v]) : [quantity.values[cell]];
      lines.push(`${quantity.name} ${values.map(shown).join(", ")}`);
    }
    return { name: title, lines };
  }

  async save() {
    const link = document.createElement("a");
    link.href = URL.createObjectURL(await this.picture.image());
    link.download = (this.scene.title.replace(/[^\w.-]+/g, "-") || "picture") + ".png";
    link.click();
    setTimeout(() => URL.revokeObjectURL(link.href), 1000);
  }
}

function fail(message) {
  $("notice").hidden = false;
  $("notice").className = "failed";
  $("notice").textContent = message;
  $("panel").hidden = true;
}

async function start() {
  if (!document.createElement("canvas").getContext("webgl2"))
    return fail("This page needs WebGL 2, which this browser does not offer.\n" +
                "It may be switched off in its settings, or the graphics driver may be missing.");
  const loading = new Loading($("notice")), scene = await readScene(document, loading);
  const viewer = new Viewer(scene, loading);
  await viewer.make();
  window.delone = viewer;  // for scripts, and for the tests
  viewer.picture.draw();
  await new Promise((resolve) => requestAnimationFrame(() => requestAnimationFrame(resolve)));
  viewer.picture.stats.firstFrameMs = performance.now();
  $("notice").hidden = true;
}

start().catch((error) => {
  fail(`This page could not be shown: ${error.message}`);
  console.error(error);
});
