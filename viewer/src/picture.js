// SPDX-License-Identifier: BSD-3-Clause
// The picture: two draw calls by three.js, drawn when something has changed.
import {
  BufferAttribute, BufferGeometry, Color, DataTexture, DoubleSide, FloatType, GLSL3, Mesh, NearestFilter, LinearFilter,
  NormalBlending, OrthographicCamera, PerspectiveCamera, RawShaderMaterial, RedFormat, RedIntegerFormat, RGBAFormat,
  RGBAIntegerFormat, Scene, UnsignedByteType, UnsignedIntType, Vector2, Vector3, WebGLRenderer, WebGLRenderTarget,
} from "three";
import { OrbitControls } from "three/addons/controls/OrbitControls.js";
import { colorsOf } from "./colors.js";
import { lineFragment, lineVertex, pickFragment, triangleFragment, triangleVertex } from "./shaders.js";

const WIDTH = 2048;  // of textures that hold items; shaders.js has it, too
const BUDGET = 3;  // milliseconds of a frame for work in steps

/** A texture of `count` items, `channels` numbers each, whose rows are full; the last row is padded. */
function itemTexture(items, channels, isFloat) {
  const Type = isFloat ? Float32Array : Uint32Array;
  const rows = Math.max(1, Math.ceil(items.length / channels / WIDTH));
  const size = rows * WIDTH * channels;
  const data = items.length === size ? items : new Type(size);
  if (data !== items) data.set(items);
  const format = isFloat ? (channels === 4 ? RGBAFormat : RedFormat) : channels === 4 ? RGBAIntegerFormat : RedIntegerFormat;
  const texture = new DataTexture(data, WIDTH, rows, format, isFloat ? FloatType : UnsignedIntType);
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.unpackAlignment = 4;
  texture.needsUpdate = true;
  return texture;
}

export class Picture {
  /** `flat`: of the plane, seen from above. Throws if there is no WebGL 2. */
  constructor(canvas, { flat, antialias }) {
    this.canvas = canvas;
    this.flat = flat;
    this.renderer = new WebGLRenderer({ canvas, antialias, powerPreference: "high-performance" });
    this.renderer.info.autoReset = false;
    this.camera = flat ? new OrthographicCamera(-1, 1, 1, -1, -100, 100) : new PerspectiveCamera(32, 1, 0.01, 100);
    this.scene = new Scene();
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = true;
    this.controls.dampingFactor = 0.12;
    this.controls.zoomToCursor = true;
    this.controls.screenSpacePanning = true;
    if (flat) {
      this.controls.enableRotate = false;
      this.controls.mouseButtons = { LEFT: 2, MIDDLE: 1, RIGHT: 2 };  // pan, dolly, pan
      this.controls.touches = { ONE: 1, TWO: 2 };  // pan, dolly and pan
    }
    this.controls.addEventListener("change", () => this.draw());
    this.makeTriangles();
    this.makeLines();
    this.target = new WebGLRenderTarget(1, 1, { type: UnsignedByteType });
    this.hasEdges = true;
    this.jobs = [];
    this.scheduled = this.changed = false;
    this.beforeFrame = () => {};
    this.stats = { frames: 0, scriptMs: [], frameMs: [], drawCalls: 0, triangles: 0, firstFrameMs: null };
    new ResizeObserver(() => this.resize()).observe(canvas);
  }

  makeTriangles() {
    const empty = itemTexture(new Uint32Array(4), 4, false);
    this.uniforms = {
      positions: { value: itemTexture(new Float32Array(4), 4, true) }, triangles: { value: empty },
      others: { value: itemTexture(new Uint32Array(1), 1, false) }, scalars: { value: itemTexture(new Float32Array(1), 1, true) },
      ofVertices: { value: false }, colors: { value: null }, colored: { value: false }, plain: { value: new Color() },
      missing: { value: new Color(0.55, 0.55, 0.55) }, edgeColor: { value: new Color(0, 0, 0) }, opacity: { value: 1 },
      edgeWidth: { value: 0.6 }, light: { value: this.flat ? 0 : 1 }, hovered: { value: 0xffffffff },
    };
    this.setMap("viridis");
    const options = { glslVersion: GLSL3, uniforms: this.uniforms, vertexShader: triangleVertex, side: DoubleSide };
    this.material = new RawShaderMaterial({ ...options, fragmentShader: triangleFragment, blending: NormalBlending });
    this.pickMaterial = new RawShaderMaterial({ ...options, fragmentShader: pickFragment });
    this.mesh = new Mesh(new BufferGeometry(), this.material);
    this.mesh.frustumCulled = false;
    this.mesh.geometry.setIndex(new BufferAttribute(new Uint32Array(0), 1));
    this.scene.add(this.mesh);
  }

  makeLines() {
    this.lineUniforms = {
      ends: { value: itemTexture(new Float32Array(8), 4, true) }, size: { value: new Vector2(1, 1) }, pixelRatio: { value: 1 },
      widths: { value: [0.9, 1.1, 2.6, 1.6, 1.4, 2.2] }, paints: { value: new Float32Array(24).fill(1) },
      colors: this.uniforms.colors, colored: this.uniforms.colored,
    };
    const material = new RawShaderMaterial({
      glslVersion: GLSL3, uniforms: this.lineUniforms, vertexShader: lineVertex, fragmentShader: lineFragment,
      transparent: true, depthWrite: true, side: DoubleSide,
    });
    this.lines = new Mesh(new BufferGeometry(), material);
    this.lines.frustumCulled = false;
    this.lines.renderOrder = 1;
    this.lines.geometry.setDrawRange(0, 0);
    this.lines.visible = false;
    this.scene.add(this.lines);
  }

  setMap(name) {
    this.uniforms.colors.value?.dispose();
    const texture = new DataTexture(colorsOf(name), 256, 1, RGBAFormat, UnsignedByteType);
    texture.magFilter = texture.minFilter = LinearFilter;
    texture.needsUpdate = true;
    this.uniforms.colors.value = texture;
    this.draw();
  }

  /** Replaces a texture of items. */
  setItems(name, items, channels, isFloat = true) {
    const uniform = this.uniforms[name];
    uniform.value.dispose();
    uniform.value = itemTexture(items, channels, isFloat);
    this.draw();
  }

  /** The triangles of a model, their sides that are edges marked. */
  setModel(model) {
    const { numTriangles, triangles, edges } = model;
    const rows = Math.max(1, Math.ceil(numTriangles / WIDTH)), packed = new Uint32Array(4 * rows * WIDTH);
    for (let t = 0; t < numTriangles; ++t) {
      const mask = edges ? edges[t] : 7;
      for (let i = 0; i < 3; ++i) packed[4 * t + i] = triangles[3 * t + i] | (mask >> i & 1 ? 0x80000000 : 0);
      packed[4 * t + 3] = model.cellOf(t, 0);
    }
    this.setItems("triangles", packed, 4, false);
    if (model.cells[1]) this.setItems("others", model.cells[1], 1, false);
    this.chosen = new Uint32Array(3 * numTriangles);  // room for the next choice of triangles
    this.indices = [null, null];
  }

  /** Shows the first entries of `chosen`. Of two buffers in turn, which grow as they need to. */
  show(count) {
    const spare = this.mesh.geometry.index === this.indices[0] ? 1 : 0;
    if (!this.indices[spare] || this.indices[spare].count < count) {
      const size = Math.min(this.chosen.length, Math.max(2 * count, 4096));
      this.indices[spare] = new BufferAttribute(new Uint32Array(size), 1);
    }
    const index = this.indices[spare];
    index.array.set(this.chosen.subarray(0, count));
    index.needsUpdate = true;
    index.clearUpdateRanges();
    index.addUpdateRange(0, count);
    this.mesh.geometry.setIndex(index);
    this.mesh.geometry.setDrawRange(0, count);
    this.draw();
  }

  /** Capsules, from lines.js. */
  setLines(lines) {
    this.lineUniforms.ends.value.dispose();
    this.lineUniforms.ends.value = itemTexture(lines.items.subarray(0, 8 * Math.max(lines.count, 1)), 4, true);
    this.lines.geometry.setDrawRange(0, 6 * lines.count);
    this.lines.visible = lines.count > 0;
    this.draw();
  }

  setOpacity(opacity) {
    this.uniforms.opacity.value = opacity;
    this.mesh.visible = opacity > 0;
    this.material.transparent = opacity < 1;
    this.material.depthWrite = opacity >= 1;
    this.material.needsUpdate = true;
    this.draw();
  }

  setEdges(on) {
    this.hasEdges = on;
    this.resize();
  }

  setStretch(stretch) {
    this.mesh.scale.set(...stretch);
    this.lines.scale.set(...stretch);
    this.draw();
  }

  /** Looks at all positions, whose box is {low, high}, after they were stretched. */
  fit({ low, high }, positions) {
    const scale = this.mesh.scale.toArray();
    const middle = low.map((x, j) => scale[j] * (x + high[j]) / 2);
    this.size = low.map((x, j) => scale[j] * (high[j] - x));
    let square = 0;
    for (let i = 0; i < positions.length; i += 4) {
      const x = scale[0] * positions[i] - middle[0], y = scale[1] * positions[i + 1] - middle[1], z = scale[2] * positions[i + 2] - middle[2];
      square = Math.max(square, x * x + y * y + z * z);
    }
    this.radius = Math.sqrt(square) || 0.5;
    this.controls.target.set(...middle);
    if (this.flat) {
      this.camera.position.set(middle[0], middle[1], 10);
      this.camera.zoom = 1;
    } else {
      this.camera.up.set(0, 0, 1);
      const away = new Vector3(0.62, -1.15, 0.62).normalize().multiplyScalar(this.distance());
      this.camera.position.set(...middle).add(away);
      this.camera.near = this.radius / 200;
      this.camera.far = this.radius * 40;
    }
    this.resize();
    this.controls.update();
    this.draw();
  }
  distance() {
    const half = (this.camera.fov / 2) * Math.PI / 180;
    const aspect = this.canvas.clientWidth / Math.max(this.canvas.clientHeight, 1);
    return this.radius * 1.02 / Math.sin(Math.atan(Math.tan(half) * Math.min(1, aspect)));
  }

  resize() {
    const width = Math.max(1, this.canvas.clientWidth), height = Math.max(1, this.canvas.clientHeight), aspect = width / height;
    const ratio = Math.min(window.devicePixelRatio || 1, 2) * (this.coarse ?? 1);
    this.renderer.setPixelRatio(ratio);
    this.renderer.setSize(width, height, false);
    this.renderer.getDrawingBufferSize(this.lineUniforms.size.value);
    this.lineUniforms.pixelRatio.value = ratio;
    this.uniforms.edgeWidth.value = this.hasEdges ? 0.55 * Math.max(ratio, 1) : 0;
    if (this.flat && this.size) {
      // Below there is room for the legend.
      const half = 0.5 * Math.max(this.size[1] / (1 - 112 / Math.max(height, 300)), this.size[0] / aspect * 1.06, 1e-9);
      const lower = half * 68 / height;
      Object.assign(this.camera, { left: -half * aspect, right: half * aspect, top: half - lower, bottom: -half - lower });
    }
    this.camera.aspect = aspect;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Runs a generator a few milliseconds a frame; its result goes to `done`. A job of the same name is given up for it. */
  start(name, generator, done) {
    this.jobs = this.jobs.filter((job) => job.name !== name);
    this.jobs.push({ name, generator, done });
    this.schedule();
  }
  work(until) {
    while (this.jobs.length > 0 && performance.now() < until) {
      const job = this.jobs[0], { done, value } = job.generator.next();
      if (!done) continue;
      this.jobs.shift();
      job.done?.(value);
    }
  }
  /** Does a job to its end now. */
  finish(name) {
    const job = this.jobs.find((other) => other.name === name);
    this.jobs = this.jobs.filter((other) => other !== job);
    let step;
    do step = job.generator.next(); while (!step.done);
    job.done?.(step.value);
  }
  get busy() {
    return this.jobs.length > 0 || this.scheduled;
  }

  /** Asks for a frame. */
  draw() {
    this.changed = true;
    this.schedule();
  }
  schedule() {
    if (this.scheduled) return;
    this.scheduled = true;
    requestAnimationFrame((time) => this.frame(time));
  }
  frame(time) {
    const start = performance.now();
    this.scheduled = false;
    this.work(start + BUDGET);
    if (this.jobs.length > 0) this.schedule();
    if (!this.changed) return;
    this.changed = false;
    this.controls.update();  // asks for the next frame while the camera is slowing down
    this.beforeFrame();
    this.renderer.info.reset();
    this.renderer.render(this.scene, this.camera);
    const { stats } = this;
    stats.drawCalls = this.renderer.info.render.calls;
    stats.triangles = this.renderer.info.render.triangles;
    stats.scriptMs.push(performance.now() - start);
    // Frames that follow each other: the camera moves.
    if (time - this.lastTime < 500) stats.frameMs.push(time - this.lastTime);
    this.lastTime = time;
    if (stats.scriptMs.length > 600) stats.scriptMs.shift();
    if (stats.frameMs.length > 600) stats.frameMs.shift();
    ++stats.frames;
    this.adaptTo(stats);
  }
  /** Where frames take long while the camera moves, they have fewer pixels; the last one has all of them. */
  adaptTo(stats) {
    clearTimeout(this.refining);
    if (this.coarse && this.coarse < 1) {
      this.refining = setTimeout(() => {
        this.coarse = 1;
        this.resize();
      }, 250);
    }
    const last = stats.frameMs.slice(-3);
    if (last.length === 3 && Math.min(...last) > 60 && (this.coarse ?? 1) > 0.5) {
      this.coarse = 0.5;
      this.resize();
    }
  }

  /** {triangle, side} of what is under a place of the canvas, in CSS pixels; null for nothing. */
  async pick(x, y) {
    if (!this.mesh.visible || this.mesh.geometry.drawRange.count === 0) return null;
    const { renderer, camera, mesh } = this, width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    const before = renderer.getClearColor(new Color()).clone(), visible = this.lines.visible;
    camera.setViewOffset(width, height, x, y, 1, 1);
    mesh.material = this.pickMaterial;
    this.lines.visible = false;
    renderer.setRenderTarget(this.target);
    renderer.setClearColor(0, 0);
    renderer.clear();
    renderer.render(this.scene, camera);
    renderer.setRenderTarget(null);
    renderer.setClearColor(before, 1);
    camera.clearViewOffset();
    mesh.material = this.material;
    this.lines.visible = visible;
    const bytes = new Uint8Array(4);
    await renderer.readRenderTargetPixelsAsync(this.target, 0, 0, 1, 1, bytes);
    const name = (bytes[0] | bytes[1] << 8 | bytes[2] << 16 | bytes[3] << 24) >>> 0;
    return name === 0 ? null : { triangle: (name - 1) >>> 1, side: (name - 1) & 1 };
  }

  /** The picture as a PNG. */
  image() {
    this.renderer.render(this.scene, this.camera);
    return new Promise((resolve) => this.canvas.toBlob(resolve, "image/png"));
  }

  /** Turns, pans and zooms by keys: angles in radians, parts of the picture, a factor. */
  turn(horizontal, vertical) {
    const offset = this.camera.position.clone().sub(this.controls.target);
    const up = this.camera.up, side = new Vector3().crossVectors(up, offset).normalize();
    const polar = offset.angleTo(up);
    const allowed = Math.min(Math.max(vertical, 0.02 - polar), Math.PI - 0.02 - polar);
    offset.applyAxisAngle(side, allowed).applyAxisAngle(up, horizontal);
    this.camera.position.copy(this.controls.target).add(offset);
    this.controls.update();
    this.draw();
  }
  pan(right, up) {
    const { camera, controls } = this;
    const span = this.flat ? (camera.top - camera.bottom) / camera.zoom
      : 2 * camera.position.distanceTo(controls.target) * Math.tan(camera.fov * Math.PI / 360);
    const move = new Vector3().setFromMatrixColumn(camera.matrix, 0).multiplyScalar(right * span)
      .add(new Vector3().setFromMatrixColumn(camera.matrix, 1).multiplyScalar(up * span));
    camera.position.add(move);
    controls.target.add(move);
    controls.update();
    this.draw();
  }
  zoom(factor) {
    const { camera, controls } = this;
    if (this.flat) {
      camera.zoom *= factor;
      camera.updateProjectionMatrix();
    } else {
      camera.position.sub(controls.target).divideScalar(factor).add(controls.target);
    }
    controls.update();
    this.draw();
  }

  /** The direction towards the camera, as a plane of the unstretched picture has it. */
  towardsCamera() {
    const v = this.camera.position.clone().sub(this.controls.target).multiply(this.mesh.scale).normalize();
    return v.toArray();
  }
}
