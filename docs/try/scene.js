// The cloth and the soft bodies: in tact's world, in the solver, and as one mesh that is drawn.
import { SharedArray, World } from "tact";
import { ball, edgesOf, pillow, ring, sheet } from "./shapes.js";
import { Solver } from "./solver.js";

const CELLS = 20, CLOTH_SIZE = 1.7, CLOTH_HEIGHT = 0.62, ROOM = 64;  // vertices of a soft body at most
export const MOST_BODIES = 40;
const CLOTH_VERTICES = (CELLS + 1) ** 2, CAPACITY = CLOTH_VERTICES + ROOM * MOST_BODIES;
const COLORS = [[0.96, 0.55, 0.36], [0.38, 0.72, 0.94], [0.98, 0.8, 0.36], [0.5, 0.83, 0.55], [0.8, 0.58, 0.93], [0.95, 0.5, 0.62]];
const CLOTH_COLORS = [[0.55, 0.62, 0.8], [0.48, 0.55, 0.73]];
export const SHAPES = { ball: () => ball(0.15), pillow: () => pillow(0.16), ring: () => ring(0.14, 0.055) };
const DT = 1 / 60, CLOTH_MASS = 1.2, BODY_MASS = 0.12;  // kg

/** Of the wanted arrays of points those that the solver and the drawing need. */
const WANTED = ["bodies", "aVertices", "bVertices", "aWeights", "bWeights", "normals", "gaps"];

export class Scene {
  constructor(options) {
    this.options = { margin: 0.02, friction: 0.4, patches: false, selfContact: true, ...options };
    this.world = new World({ points: true, patches: this.options.patches });
    this.shared = new SharedArray(Float64Array, 3 * CAPACITY);
    this.solver = new Solver(CAPACITY);
    this.drawn = new Float32Array(3 * CAPACITY);
    this.bodies = [];
    this.byIndex = [];
    this.steps = 0;
    this.times = { tact: 0, solver: 0 };
    this.random = 1;
    this.floor = this.world.addPlane({ normal: [0, 0, 1], name: "floor", margin: this.options.margin });
    this.#addCloth();
  }
  get x() { return this.shared.array; }
  get end() { return Math.max(...this.bodies.map((body) => body.first + body.count)); }
  #next() {  // the same numbers in every browser: a generator of Lehmer's kind
    this.random = (this.random * 48271) % 2147483647;
    return this.random / 2147483647;
  }

  #add(body, mesh, { surface, selfContact = false, name }) {
    const { first, count } = body;
    this.x.set(mesh.positions, 3 * first);
    this.solver.velocities.fill(0, 3 * first, 3 * (first + count));
    body.facets = Int32Array.from(mesh.facets);
    body.name = name;
    body.id = this.world.addBody({ positions: this.positionsOf(body), facets: body.facets, surface, name, margin: this.options.margin, selfContact });
    this.bodies.push(body);
    this.byIndex[body.id.index] = body;
    this.changed = true;
    return body;
  }
  positionsOf({ first, count }) { return this.x.subarray(3 * first, 3 * (first + count)); }

  #addCloth() {
    const mesh = sheet(CELLS, CLOTH_SIZE), n = CELLS + 1, count = n * n, { lightness } = this.solver;
    for (let i = 0; i < count; ++i) {
      const [x, y] = mesh.positions.slice(3 * i, 3 * i + 2);
      mesh.positions[3 * i + 2] = CLOTH_HEIGHT + 0.25 * ((2 * x / CLOTH_SIZE) ** 2 * (2 * y / CLOTH_SIZE) ** 2);
    }
    lightness.fill(count / CLOTH_MASS, 0, count);
    // Four vertices at each corner are held: one alone has all of the weight at three thin facets, and trembles.
    for (let i = 0; i < count; ++i) {
      const [row, column] = [Math.floor(i / n), i % n];
      if (Math.min(row, CELLS - row) < 2 && Math.min(column, CELLS - column) < 2) lightness[i] = 0;
    }
    const edges = edgesOf(mesh.facets), soft = edges.length / 2;  // those of facets keep their length, the others resist folds
    for (let row = 0; row < n; ++row) for (let column = 0; column < n; ++column) {
      if (column + 2 < n) edges.push(row * n + column, row * n + column + 2);
      if (row + 2 < n) edges.push(row * n + column, (row + 2) * n + column);
    }
    const flat = (v, k) => (k === 0 ? v % n : Math.floor(v / n)) * (CLOTH_SIZE / CELLS);
    const lengths = Float64Array.from({ length: edges.length / 2 }, (_, e) =>
      Math.hypot(flat(edges[2 * e], 0) - flat(edges[2 * e + 1], 0), flat(edges[2 * e], 1) - flat(edges[2 * e + 1], 1)));
    const color = (i) => CLOTH_COLORS[(Math.floor((i % n) / 2) + Math.floor(i / n / 2)) % 2];
    this.#add({ first: 0, count, edges: Int32Array.from(edges), lengths, soft, damping: 0.9, color }, mesh,
      { surface: "sheet", selfContact: this.options.selfContact, name: "cloth" });
  }

  /** Drops a body from above; the oldest one goes where there is no room left. */
  drop(shape = Object.keys(SHAPES)[Math.floor(this.#next() * 3)], at) {
    if (this.bodies.length > MOST_BODIES) this.remove(this.bodies[1]);
    const mesh = SHAPES[shape](), count = mesh.positions.length / 3;
    const taken = new Set(this.bodies.map((body) => body.first));
    let first = CLOTH_VERTICES;
    while (taken.has(first)) first += ROOM;
    const place = at ?? this.#freePlace(), turn = this.#rotation();
    const middle = [0, 1, 2].map((k) => mesh.positions.reduce((sum, x, i) => sum + (i % 3 === k ? x : 0), 0) / count);
    const about = mesh.positions.map((x, i) => x - middle[i % 3]);
    const rest = Float64Array.from(about, (_, i) => {
      const row = i % 3, v = i - row;
      return turn[3 * row] * about[v] + turn[3 * row + 1] * about[v + 1] + turn[3 * row + 2] * about[v + 2];
    });
    mesh.positions = Array.from(rest, (x, i) => place[i % 3] + x);
    this.solver.lightness.fill(count / BODY_MASS, first, first + count);
    const color = COLORS[Math.floor(this.#next() * COLORS.length)];
    return this.#add({ first, count, rest, turn: [0, 0, 0, 1], damping: 0.999, color: () => color }, mesh, { surface: "closed", name: shape });
  }
  /** A place over the cloth where no body is. */
  #freePlace() {
    for (let round = 0; ; ++round) {
      const p = [(this.#next() - 0.5) * 0.9, (this.#next() - 0.5) * 0.9, 1.15 + 0.05 * round + 0.3 * this.#next()];
      const found = this.world.closestPoint({ point: p, within: 0.24 });
      if (found === null || round > 60) return p;
    }
  }
  #rotation() {
    const a = this.#next() * 6.28, b = this.#next() * 1.5, [c, s, d, t] = [Math.cos(a), Math.sin(a), Math.cos(b), Math.sin(b)];
    return [c, -s * d, s * t, s, c * d, -c * t, 0, t, d];
  }
  remove(body) {
    this.world.removeBody(body.id);
    this.solver.lightness.fill(0, body.first, body.first + body.count);
    this.bodies.splice(this.bodies.indexOf(body), 1);
    this.changed = true;
  }
  setBodies(count) {
    while (this.bodies.length - 1 > count) this.remove(this.bodies.at(-1));
    while (this.bodies.length - 1 < count) this.drop();
  }
  setMargin(margin) {
    this.options.margin = margin;
    for (const { id } of [{ id: this.floor }, ...this.bodies]) this.world.setMargin(id, margin);
  }
  setPatches(patches) {
    this.options.patches = patches;
    this.world.setSettings({ ...this.world.settings, patches });
    this.report = null;
  }
  setSelfContact(wanted) {
    this.options.selfContact = wanted;
    this.world.setSelfContact(this.bodies[0].id, wanted);
  }
  /** A push upwards for all soft bodies. */
  kick() {
    for (const { first, count } of this.bodies.slice(1)) {
      for (let i = first; i < first + count; ++i) this.solver.velocities[3 * i + 2] += 3.5;
    }
  }

  /** What tact finds where the bodies are now. */
  detect() {
    const began = performance.now();
    this.world.setPositionsOfMany(this.bodies.map((body) => ({ body: body.id, positions: this.positionsOf(body) })));
    this.report = this.world.detect();
    this.points = this.report.points(WANTED);
    this.times.tact = performance.now() - began;
  }
  step() {
    this.detect();
    const began = performance.now(), firstOf = [], { x, end } = this;
    for (const { id, first } of this.bodies) firstOf[id.index] = first;
    firstOf[this.floor.index] = -1;
    this.solver.take(this.points, firstOf, x, end);
    this.solver.step(x, end, this.bodies, DT, { friction: this.options.friction, thickness: this.options.margin });
    this.times.solver = performance.now() - began;
    this.steps += 1;
  }

  get facetCount() { return this.bodies.reduce((sum, { facets }) => sum + facets.length / 3, 0); }
  /** Facets and colours of all bodies, for the drawing. */
  mesh() {
    const indices = new Uint16Array(3 * this.facetCount), colors = new Float32Array(3 * CAPACITY);
    let at = 0;
    for (const { first, count, facets, color } of this.bodies) {
      for (const v of facets) indices[at++] = first + v;
      for (let i = 0; i < count; ++i) colors.set(color(i), 3 * (first + i));
    }
    this.changed = false;
    return { indices, colors };
  }
  destroy() {
    this.world.destroy();
    this.shared.free();
  }
}
