// The page: what is set and shown, mouse, fingers and keys, the link.
import { ready, version } from "tact";
import { Camera, Drawing } from "./draw.js";
import { MOST_BODIES, SHAPES, Scene } from "./scene.js";

const $ = (id) => document.getElementById(id);
const SHOWN = ["points", "facets", "patches", "directions"];
const SLIDERS = { bodies: [0, MOST_BODIES, 20], margin: [5, 40, 15], friction: [0, 120, 40] };  // margin in mm, friction in hundredths
const state = { bodies: 20, margin: 15, friction: 40, self: 1, running: 1, show: new Set(["points", "facets"]) };

function fail(error) {
  $("message").hidden = false;
  $("message").textContent = `${error.message ?? error}`;
  throw error;
}

function readLink() {
  const given = new URLSearchParams(location.hash.slice(1));
  for (const [key, [least, most]] of Object.entries(SLIDERS)) {
    const value = Math.round(Number(given.get(key) ?? NaN));
    if (Number.isFinite(value)) state[key] = Math.max(least, Math.min(most, value));
  }
  for (const key of ["self", "running"]) if (["0", "1"].includes(given.get(key))) state[key] = Number(given.get(key));
  if (given.has("show")) state.show = new Set(given.get("show").split(",").filter((one) => SHOWN.includes(one)));
  const view = (given.get("view") ?? "").split(",").map(Number);
  if (view.length === 3 && view.every(Number.isFinite)) {
    [camera.yaw, camera.pitch, camera.distance] = [view[0], clampPitch(view[1]), clampDistance(view[2])];
  }
}
function link() {
  const { bodies, margin, friction, self, running, show } = state;
  const view = [camera.yaw, camera.pitch, camera.distance].map((x) => Number(x.toFixed(3)));
  return `#bodies=${bodies}&margin=${margin}&friction=${friction}&self=${self}&running=${running}&show=${[...show].join(",")}&view=${view}`;
}
let written = 0;
function writeLink() {
  clearTimeout(written);
  written = setTimeout(() => history.replaceState(null, "", link()), 150);
}

const camera = new Camera();
const clampPitch = (x) => Math.max(-0.05, Math.min(1.5, x)), clampDistance = (x) => Math.max(1.2, Math.min(7, x));
let drawing, scene;

function restart() {
  scene?.destroy();
  scene = new Scene({ margin: state.margin / 1000, friction: state.friction / 100, patches: state.show.has("patches"), selfContact: state.self === 1 });
  scene.setBodies(state.bodies);
  scene.detect();
}

/** Applies what is set, shows it and keeps it in the link. */
function set(changes) {
  Object.assign(state, changes);
  if ("bodies" in changes) scene.setBodies(state.bodies);
  if ("margin" in changes) scene.setMargin(state.margin / 1000);
  if ("friction" in changes) scene.options.friction = state.friction / 100;
  if ("self" in changes) scene.setSelfContact(state.self === 1);
  if ("show" in changes && scene.options.patches !== state.show.has("patches")) scene.setPatches(state.show.has("patches"));
  if (!state.running && Object.keys(changes).some((key) => key !== "running")) scene.detect();
  showState();
  writeLink();
}
function showState() {
  for (const key of Object.keys(SLIDERS)) $(key).value = state[key];
  $("bodies-value").textContent = state.bodies;
  $("margin-value").textContent = `${state.margin} mm`;
  $("friction-value").textContent = (state.friction / 100).toFixed(2);
  for (const name of SHOWN) $(`show-${name}`).checked = state.show.has(name);
  $("self").checked = state.self === 1;
  $("run").textContent = state.running ? "Pause" : "Run";
  $("run").setAttribute("aria-pressed", String(!state.running));
}
function toggle(name) {
  const show = new Set(state.show);
  show.has(name) ? show.delete(name) : show.add(name);
  set({ show });
}
function drop(shape) {
  scene.drop(shape);
  set({ bodies: scene.bodies.length - 1 });
}
function step() {
  set({ running: 0 });
  scene.step();
}

const RED = [1, 0.25, 0.22, 0.95], GREEN = [0.35, 1, 0.62, 0.95], YELLOW = [1, 0.83, 0.3, 1], BLUE = [0.45, 0.7, 1, 1];
const along = (p, n, length) => [p[0] + n[0] * length, p[1] + n[1] * length, p[2] + n[2] * length];
function vertexOf(body, v) {
  const at = 3 * (body.first + v), { x } = scene;
  return [x[at], x[at + 1], x[at + 2]];
}
function placeOf(body, vertices, weights, at) {
  const p = [0, 0, 0];
  for (let k = 0; k < 3; ++k) if (vertices[at + k] >= 0) vertexOf(body, vertices[at + k]).forEach((c, axis) => { p[axis] += weights[at + k] * c; });
  return p;
}
function drawPoints() {
  const { count, bodies, aVertices, bVertices, aWeights, bWeights, normals, gaps } = scene.points, scale = drawing.canvas.width / drawing.canvas.clientWidth;
  for (let i = 0; i < count; ++i) {
    const a = scene.byIndex[bodies[2 * i]], b = scene.byIndex[bodies[2 * i + 1]];
    const p = a ? placeOf(a, aVertices, aWeights, 3 * i) : placeOf(b, bVertices, bWeights, 3 * i);
    const color = gaps[i] < 0 ? RED : GREEN, n = normals.subarray(3 * i, 3 * i + 3);
    drawing.dot(p, color, 3 * scale);
    drawing.segment(p, along(p, n, 0.035), color, 1 * scale);
  }
}
function drawFacets() {
  const { count, bodies, facets } = scene.report.facetPairs(), scale = drawing.canvas.width / drawing.canvas.clientWidth, drawn = new Set();
  for (let i = 0; i < 2 * count; ++i) {
    const body = scene.byIndex[bodies[i]], name = bodies[i] * 65536 + facets[i];
    if (!body || drawn.has(name)) continue;
    drawn.add(name);
    const corners = [0, 1, 2].map((k) => vertexOf(body, body.facets[3 * facets[i] + k]));
    for (let k = 0; k < 3; ++k) drawing.segment(corners[k], corners[(k + 1) % 3], RED, 1.4 * scale);
  }
}
function arrow(p, n, length, color, width) {
  const q = along(p, n, length), side = Math.abs(n[2]) < 0.9 ? [-n[1], n[0], 0] : [1, 0, 0];
  drawing.segment(p, q, color, width);
  for (const s of [0.4, -0.4]) drawing.segment(q, along(along(q, n, -0.035), side, 0.035 * s), color, width);
}
function drawContacts() {
  const scale = drawing.canvas.width / drawing.canvas.clientWidth, patches = state.show.has("patches"), directions = state.show.has("directions");
  for (const contact of scene.report.contacts) {
    if (patches) for (const { point, direction, area } of contact.patches) {
      drawing.dot(point, YELLOW, (4 + 60 * Math.sqrt(Math.max(area, 0))) * scale);
      arrow(point, direction, 0.09, YELLOW, 1.6 * scale);
    }
    const body = scene.byIndex[contact.b.index] ?? scene.byIndex[contact.a.index];
    if (!directions || contact.depth <= 0 || contact.a === contact.b || body === undefined) continue;
    const middle = [0, 0, 0];
    for (let v = 0; v < body.count; ++v) vertexOf(body, v).forEach((c, axis) => { middle[axis] += c / body.count; });
    const sign = scene.byIndex[contact.b.index] ? 1 : -1;
    arrow(middle, contact.direction.map((c) => sign * c), contact.depth, BLUE, 2.2 * scale);
  }
}

const means = { frame: 16, tact: 0, solver: 0 };
let lastFrame = 0, told = 0, frames = 0;
function frame(now) {
  const since = now - lastFrame;
  lastFrame = now;
  // A screen of 60 pictures a second shows a step each; one of 144 shows some steps twice.
  due = Math.min(due + since, 40);
  if (state.running && due >= 1000 / 60 - 2) {
    due = Math.max(0, due - 1000 / 60);
    scene.step();
    means.tact += 0.05 * (scene.times.tact - means.tact);
    means.solver += 0.05 * (scene.times.solver - means.solver);
  }
  if (since < 1000) means.frame += 0.05 * (since - means.frame);
  render();
  frames += 1;
  if (now - told > 250) told = now, tell();
  requestAnimationFrame(frame);
}
let due = 0;
function render() {
  if (scene.report === null) scene.detect();
  if (scene.changed) {
    const { indices, colors } = scene.mesh();
    drawing.setMesh(indices, colors);
  }
  scene.drawn.set(scene.x);
  drawing.clear();
  if (state.show.has("facets")) drawFacets();
  if (state.show.has("patches") || state.show.has("directions")) drawContacts();
  if (state.show.has("points")) drawPoints();
  if (held) drawing.dot(held.target, YELLOW, 6), drawing.segment(placeOfHeld(), held.target, YELLOW, 2);
  drawing.draw(camera, scene.drawn);
}
function tell() {
  const { contacts } = scene.report, pairs = contacts.reduce((sum, contact) => sum + contact.facetPairs.length / 2, 0);
  $("frames").textContent = (1000 / means.frame).toFixed(0);
  $("tact").textContent = means.tact.toFixed(2);
  $("solver").textContent = means.solver.toFixed(2);
  $("counts").textContent = `${scene.bodies.length - 1} bodies and a cloth, ${scene.facetCount} facets; ${contacts.length} contacts, ` +
    `${scene.points.count} points, ${pairs} facet pairs; step ${scene.steps}`;
}

let held = null;
function placeOfHeld() {
  const { x } = scene, p = [0, 0, 0];
  scene.solver.pull?.vertices.forEach((v, k) => { for (let axis = 0; axis < 3; ++axis) p[axis] += scene.solver.pull.weights[k] * x[3 * v + axis]; });
  return p;
}
const fingers = new Map();
function place(event) {
  const box = drawing.canvas.getBoundingClientRect();
  return [(2 * (event.clientX - box.left)) / box.width - 1, 1 - (2 * (event.clientY - box.top)) / box.height, box.width / box.height];
}
/** Takes what is under the mouse: the first facet on the ray of sight, asked of tact. */
function take(event) {
  const [x, y, aspect] = place(event), way = camera.ray(x, y, aspect), from = camera.eye();
  scene.detect();
  const hit = scene.world.castRay({ from, to: along(from, way, 12) }), body = hit && scene.byIndex[hit.body.index];
  if (!body) return;
  const vertices = [0, 1, 2].map((k) => body.first + body.facets[3 * hit.facet + k]);
  held = { pointer: event.pointerId, depth: 12 * hit.fraction, target: along(from, way, 12 * hit.fraction) };
  scene.solver.pull = { vertices, weights: hit.barycentric, target: held.target };
}
function letGo() {
  held = null;
  scene.solver.pull = null;
}
function listen(canvas) {
  canvas.addEventListener("contextmenu", (event) => event.preventDefault());
  canvas.addEventListener("pointerdown", (event) => {
    canvas.setPointerCapture(event.pointerId);
    fingers.set(event.pointerId, event);
    if (event.button === 0 && fingers.size === 1) take(event);
    else if (fingers.size === 2) letGo();
  });
  canvas.addEventListener("pointermove", (event) => {
    const before = fingers.get(event.pointerId);
    if (!before) return;
    fingers.set(event.pointerId, event);
    if (held?.pointer === event.pointerId) {
      const [x, y, aspect] = place(event);
      held.target = along(camera.eye(), camera.ray(x, y, aspect), held.depth);
      held.target[2] = Math.max(held.target[2], 0.05);
      scene.solver.pull.target = held.target;
      return;
    }
    if (fingers.size === 2) {  // two fingers: nearer and farther
      const [p, q] = [...fingers.values()], other = p.pointerId === event.pointerId ? q : p;
      const distance = (one) => Math.hypot(one.clientX - other.clientX, one.clientY - other.clientY);
      camera.distance = clampDistance((camera.distance * distance(before)) / Math.max(distance(event), 1));
    }
    turn(-0.006 * (event.clientX - before.clientX), 0.006 * (event.clientY - before.clientY));
  });
  for (const end of ["pointerup", "pointercancel"]) canvas.addEventListener(end, (event) => {
    fingers.delete(event.pointerId);
    if (held?.pointer === event.pointerId) letGo();
  });
  canvas.addEventListener("wheel", (event) => {
    event.preventDefault();
    camera.distance = clampDistance(camera.distance * Math.exp(0.001 * event.deltaY));
    writeLink();
  }, { passive: false });
}
function turn(yaw, pitch) {
  camera.yaw += yaw;
  camera.pitch = clampPitch(camera.pitch + pitch);
  writeLink();
}

const KEYS = {
  " ": () => set({ running: 1 - state.running }), n: step, b: () => drop("ball"), p: () => drop("pillow"), o: () => drop("ring"),
  k: () => scene.kick(), r: () => restart(), 1: () => toggle("points"), 2: () => toggle("facets"), 3: () => toggle("patches"),
  4: () => toggle("directions"), ArrowLeft: () => turn(-0.1, 0), ArrowRight: () => turn(0.1, 0), ArrowUp: () => turn(0, 0.1),
  ArrowDown: () => turn(0, -0.1), "+": () => { camera.distance = clampDistance(camera.distance / 1.1); writeLink(); },
  "-": () => { camera.distance = clampDistance(camera.distance * 1.1); writeLink(); },
};
function listenToControls() {
  for (const key of Object.keys(SLIDERS)) $(key).addEventListener("input", () => set({ [key]: Number($(key).value) }));
  for (const name of SHOWN) $(`show-${name}`).addEventListener("change", () => toggle(name));
  $("self").addEventListener("change", () => set({ self: $("self").checked ? 1 : 0 }));
  $("run").addEventListener("click", KEYS[" "]);
  $("step").addEventListener("click", step);
  $("kick").addEventListener("click", KEYS.k);
  $("restart").addEventListener("click", KEYS.r);
  for (const shape of Object.keys(SHAPES)) $(`drop-${shape}`).addEventListener("click", () => drop(shape));
  $("link").addEventListener("click", async () => {
    history.replaceState(null, "", link());
    try {
      await navigator.clipboard.writeText(location.href);
      $("link").textContent = "Link copied";
    } catch {
      $("link").textContent = "Copy it from the address";  // where the browser keeps the clipboard shut
    }
    setTimeout(() => { $("link").textContent = "Copy link"; }, 2000);
  });
  document.addEventListener("keydown", (event) => {
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key, control = event.target.closest?.("input, button, a, summary");
    if (event.ctrlKey || event.metaKey || event.altKey || !(key in KEYS)) return;
    if (control && (key.startsWith("Arrow") || key === " ")) return;
    event.preventDefault();
    KEYS[key]();
  });
  window.addEventListener("hashchange", () => {
    readLink();
    set({ bodies: state.bodies, margin: state.margin, friction: state.friction, self: state.self, show: state.show });
  });
}

async function begin() {
  await ready();
  drawing = new Drawing($("view"));
  readLink();
  restart();
  listen($("view"));
  listenToControls();
  showState();
  $("version").textContent = version();
  globalThis.tactTry = { state, camera, means, link, step, drop, frames: () => frames, scene: () => scene, set };
  document.documentElement.dataset.ready = "true";
  requestAnimationFrame((now) => { lastFrame = now; requestAnimationFrame(frame); });
}
begin().catch(fail);
