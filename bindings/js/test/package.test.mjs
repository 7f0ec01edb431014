// What the package answers is held against what C and C++ are tested for.
import assert from "node:assert/strict";
import { readFileSync, readdirSync } from "node:fs";
import { test } from "node:test";
import { functionsOf, readHeader } from "../header.mjs";
import { SHEET, TETRAHEDRON, fails, folder, here, movedBy, tact } from "./package.mjs";

const { SharedArray, World } = tact;

test("nothing works before ready()", () => {
  fails("wrong_order", () => new World(), /ready\(\)/);
});
test("it loads, and has a version", async () => {
  await Promise.all([tact.ready(), tact.ready()]);
  assert.equal(tact.version(), JSON.parse(readFileSync(`${folder}/package.json`)).version);
});

test("two bodies: direction, depth, facet pairs", () => {
  const world = new World(), left = world.addBody({ ...TETRAHEDRON, name: "left" });
  const right = world.addBody({ ...TETRAHEDRON, positions: movedBy(0.75), name: "right" });
  const report = world.detect(), [contact] = report.contacts;
  assert.equal(report.contacts.length, 1);
  assert.equal(contact.a, left);
  assert.equal(contact.b, right);
  assert.equal(contact.facetPairs.length, 18);
  assert.ok(Math.abs(contact.depth - 0.25 / Math.sqrt(3)) < 1e-12);
  assert.equal(contact.containment, "none");
  assert.equal(contact.source, "smallest");
  assert.equal(report.findContact(right, left).depth, contact.depth);
  assert.deepEqual(report.candidatePairs, [{ a: left, b: right, hullsOverlap: true }]);
  assert.deepEqual(report.began, [{ a: left, b: right }]);
  const { count, bodies, facets } = report.facetPairs();
  assert.deepEqual([count, Array.from(bodies.slice(0, 2)), Array.from(facets)], [9, [0, 1], Array.from(contact.facetPairs)]);
  world.setPositions(right, movedBy(3));
  const next = world.detect();
  assert.deepEqual([next.contacts.length, next.ended], [0, [{ a: left, b: right }]]);
  world.destroy();
});

test("positions of all kinds are the same positions", () => {
  const hashes = new Set();
  const shared = new SharedArray(Float64Array, 12), floats = new SharedArray(Float32Array, 12);
  shared.array.set(movedBy(0.75));
  floats.array.set(movedBy(0.75));
  const rows = Array.from({ length: 4 }, (_, v) => movedBy(0.75).slice(3 * v, 3 * v + 3));
  for (const positions of [movedBy(0.75), rows, Float32Array.from(movedBy(0.75)), Float64Array.from(movedBy(0.75)), shared, shared.array, floats]) {
    const world = new World();
    world.addBody(TETRAHEDRON);
    const body = world.addBody({ ...TETRAHEDRON, positions: movedBy(2), facets: Uint16Array.from(TETRAHEDRON.facets) });
    world.setPositions(body, positions);
    assert.deepEqual(Array.from(world.positionsOf(body)), movedBy(0.75));
    hashes.add(world.detect().hash);
    world.destroy();
  }
  assert.equal(hashes.size, 1);
});

test("a shared array outlives the growth of memory", () => {
  const shared = new SharedArray(Float64Array, 12), old = shared.array;
  shared.array.set(movedBy(0.5));
  const large = Array.from({ length: 4 }, () => new SharedArray(Float64Array, 4e6));
  assert.notEqual(shared.array, old);
  assert.deepEqual(Array.from(shared.array), movedBy(0.5));
  const world = new World(), body = world.addBody(TETRAHEDRON);
  fails("wrong_order", () => world.setPositions(body, old), /anew/);
  world.setPositions(body, shared);
  large.forEach((one) => one.free());
  shared.free();
  fails("wrong_order", () => shared.array, /freed/);
  world.destroy();
});

test("contact points, patches and a floor", () => {
  const world = new World({ points: true, patches: true, withinReach: true });
  const floor = world.addPlane({ normal: [0, 0, 1], name: "floor", margin: 0.05 });
  const body = world.addBody({ ...TETRAHEDRON, positions: movedBy(0, 0, 0.04), margin: 0.05 });
  const report = world.detect(), points = report.points(), [contact] = report.contacts;
  assert.equal(points.count, 3);
  for (const gap of points.gaps) assert.ok(Math.abs(gap - 0.04) < 1e-15);
  assert.deepEqual(Array.from(points.bodies), [0, 1, 0, 1, 0, 1]);
  assert.deepEqual(Array.from(points.normals.slice(0, 3)), [0, 0, 1]);
  assert.deepEqual(contact.points.map((point) => point.kind), Array(3).fill("plane_vertex"));
  assert.deepEqual(contact.points.map((point) => point.id), Array.from(points.ids));
  assert.equal(contact.patches.length, 1);
  assert.equal(contact.patches[0].points.length, 3);
  assert.deepEqual(Object.keys(report.points(["gaps"])), ["count", "gaps"]);
  fails("invalid_argument", () => report.points(["gap"]), /gaps/);
  const impulses = Array.from(points.ids, (id) => ({ id, impulse: [0, 0, 2] }));
  const [sum] = report.sumContacts(impulses);
  assert.deepEqual([sum.kind, sum.a, sum.b, sum.points, sum.force], ["contact", floor, body, 3, [0, 0, 6]]);
  assert.deepEqual(world.planeOf(floor), { normal: [0, 0, 1], offset: 0 });
  assert.equal(world.planeOf(body), null);
  world.destroy();
});

test("motion: what a body meets on its way", () => {
  const world = new World(), sheet = world.addBody(SHEET), drop = world.addBody({ ...TETRAHEDRON, positions: movedBy(0, 0, 1) });
  world.detect();
  world.setPositions(drop, movedBy(0, 0, -1));
  const motion = world.detectMotion(), arrays = motion.impactArrays();
  const isHalf = (time) => time <= 0.5 && time > 0.5 - 1e-9;  // never later than the true time
  assert.ok(isHalf(motion.firstTime));
  assert.equal(motion.pairs.length, 1);
  assert.deepEqual([motion.pairs[0].a, motion.pairs[0].b], [sheet, drop]);
  assert.equal(arrays.count, motion.impacts.length);
  assert.ok(isHalf(motion.impacts[0].time) && isHalf(arrays.times[0]));
  assert.equal(motion.statistics.movedBodies, 1);
  world.destroy();
});

test("queries", () => {
  const world = new World(), sheet = world.addBody(SHEET), solid = world.addBody({ ...TETRAHEDRON, positions: movedBy(0, 0, 1) });
  const hit = world.castRay({ from: [1, -1, 5], to: [1, -1, -5] });
  assert.deepEqual([hit.body, hit.facet, hit.fraction], [sheet, 0, 0.5]);
  assert.equal(world.castRay({ from: [9, 9, 5], to: [9, 9, -5] }), null);
  assert.equal(world.castRays([{ from: [1, -1, 5], to: [1, -1, -5] }, { from: [9, 9, 5], to: [9, 9, -5] }])[1], null);
  assert.deepEqual(world.castRayAll({ from: [0.3, 0.2, 5], to: [0.3, 0.2, -5] }).map((one) => one.body), [solid, solid, sheet]);
  const nearest = world.closestPoint({ point: [2, 2, 3] });
  assert.equal(nearest.body, solid);
  assert.equal(world.closestPoint({ point: [2, 2, 9], within: 1 }), null);
  assert.deepEqual(world.overlapBox({ lower: [3, -4, -1], upper: [4, -3, 1] }), [{ body: sheet, facet: 0 }]);
  assert.deepEqual(world.overlapBoxes([{ lower: [8, 8, 8], upper: [9, 9, 9] }, { lower: [3, -4, -1], upper: [4, -3, 1] }]).map((list) => list.length), [0, 1]);
  assert.deepEqual(world.bodiesContaining({ point: [0.2, 0.2, 1.2] }), [solid]);
  assert.deepEqual(world.bodiesContainingEach([{ point: [0.2, 0.2, 1.2] }, { point: [3, 3, 3] }]), [[solid], []]);
  world.destroy();
});

test("saved states, rigid bodies, settings, names", () => {
  const world = new World({ accuracy: "hulls" }), body = world.addBody({ ...TETRAHEDRON, motion: "rigid", externalId: 7n, key: 2n ** 63n });
  const other = world.addBody({ ...TETRAHEDRON, positions: movedBy(0.5), selfContact: true, group: 3 });
  assert.deepEqual([world.settings.accuracy, world.settings.threads, world.settings.iterationLimit], ["hulls", 1, 100]);
  world.setSettings({ points: true });
  assert.equal(world.settings.accuracy, "exact");
  world.setPose(body, [[0, -1, 0], [1, 0, 0], [0, 0, 1]], [1, 2, 3]);
  assert.deepEqual(Array.from(world.positionsOf(body).slice(0, 6)), [1, 2, 3, 1, 3, 3]);
  world.setPoses([{ body, rotation: [1, 0, 0, 0, 1, 0, 0, 0, 1], translation: [0.25, 0, 0] }]);
  const saved = world.save(), hash = world.detect().hash;
  world.removeBody(other);
  assert.equal(world.bodyCount, 1);
  world.restore(saved);
  assert.deepEqual(world.bodies(), [body, other]);
  assert.equal(world.detect().hash, hash);
  assert.deepEqual([world.keyOf(body), world.externalIdOf(body), world.motionOf(body), world.surfaceOf(body)], [2n ** 63n, 7n, "rigid", "closed"]);
  assert.deepEqual([world.nameOf(other), world.selfContactOf(other), world.groupOf(other), world.facetCountOf(other)], ["body 1", true, 3, 4]);
  assert.deepEqual(world.boundsOf(other), { lower: [0.5, 0, 0], upper: [1.5, 1, 1] });
  assert.deepEqual(Array.from(world.facetsOf(other)), TETRAHEDRON.facets);
  world.setExcluded(body, other, true);
  assert.ok(world.isExcluded(other, body));
  assert.deepEqual(world.checkSurface(other), { solid: true, faults: [] });
  world.destroy();
});

test("errors name what is wrong, and change nothing", () => {
  const world = new World(), body = world.addBody({ ...TETRAHEDRON, name: "dough" });
  fails("non_finite_position", () => world.setPositions(body, movedBy(NaN)), /dough/);
  fails("wrong_size", () => world.setPositions(body, [1, 2, 3, 4]), /multiple of 3/);
  fails("wrong_size", () => world.setPositions(body, [1, 2, 3]), /dough/);
  fails("facet_out_of_range", () => world.addBody({ positions: movedBy(0), facets: [0, 1, 9] }), /9/);
  fails("invalid_argument", () => world.addBody({ positions: movedBy(0), facets: [0, 1, 1.5] }), /whole/);
  fails("invalid_argument", () => world.addBody({ ...TETRAHEDRON, surface: "solid" }), /closed, sheet/);
  fails("invalid_argument", () => world.addBody({ ...TETRAHEDRON, margn: 1 }), /margin/);
  fails("invalid_argument", () => world.setMargin(body, -1), /margin/);
  fails("bad_settings", () => new World({ iterationLimit: 0 }), /iteration/);
  const report = world.detect();
  world.removeBody(body);
  fails("stale_body", () => world.setPositions(body, movedBy(0)), /./);
  world.detect();
  fails("stale_report", () => report.contacts, /next step/);
  world.destroy();
  fails("invalid_handle", () => world.detect(), /./);
});

test("messages, and exceptions of who takes them", () => {
  const told = [], world = new World({ onMessage: (message) => told.push(message) });
  const body = world.addBody({ ...SHEET, surface: "closed", name: "lid" });
  assert.equal(told.length, 1);
  assert.deepEqual([told[0].kind, told[0].a], ["open_surface", body]);
  assert.match(told[0].text, /lid/);
  world.setSettings({ onMessage: () => { throw new RangeError("mine"); } });
  assert.throws(() => world.addBody({ ...SHEET, surface: "closed" }), RangeError);
  assert.deepEqual(world.bodies(), [body], "nothing was added");
  const next = world.addBody({ ...TETRAHEDRON, positions: movedBy(50) });
  assert.deepEqual(world.bodies(), [body, next]);
  assert.equal(world.detect().contacts.length, 0);
  world.destroy();
});

test("debug drawing", () => {
  const world = new World();
  world.addBody({ ...TETRAHEDRON, name: "left" });
  world.addBody({ ...TETRAHEDRON, positions: movedBy(0.75) });
  world.detect();
  const lines = [], words = [];
  world.debugDraw({ line: (from, to, color) => lines.push([...from, ...to, ...color]), text: (at, text) => words.push(text) },
    { surfaces: true, names: true, surface: [1, 0, 0.5, 1] });
  assert.ok(lines.some((line) => line.slice(6).join() === "1,0,0.5,1"));
  assert.ok(words.includes("left"));
  world.destroy();
});

test("for solvers: stencils and their energies", () => {
  const world = new World({ points: true });
  world.addBody({ ...SHEET, margin: 0.1 });
  world.addBody({ ...TETRAHEDRON, positions: movedBy(0, 0, 0.05), margin: 0.1 });
  const stencils = world.detect().stencils([0, 4]), x = Float64Array.from([...SHEET.positions, ...movedBy(0, 0, 0.05)]);
  const { values, gradients } = stencils.gaps(x);
  assert.ok(stencils.count >= 3);
  assert.equal(gradients.length, 12 * stencils.count);
  stencils.all.forEach((stencil, i) => assert.ok(Math.abs(stencil.gap - values[i]) < 1e-15));
  for (const terms of [stencils.barriers(x, 0.2, { rest: x, hessians: true }), stencils.penalties(x, 0.2, { hessians: true })]) {
    assert.ok(terms.values.every((value) => value > 0));
    assert.equal(terms.hessians.length, 144 * stencils.count);
  }
  const moved = new Float64Array(x.length).fill(0.001);
  assert.equal(stencils.friction(moved, new Float64Array(stencils.count).fill(1), 0.01).values.length, stencils.count);
  assert.equal(stencils.colors(8).length, stencils.count);
  assert.deepEqual(Array.from(tact.rotationOfQuaternion([0, 0, 0, 1])), [1, 0, 0, 0, 1, 0, 0, 0, 1]);
  assert.deepEqual(Array.from(tact.nearestRotation([1, 0, 0, 0, 1, 0, 0, 0, 1])), [1, 0, 0, 0, 1, 0, 0, 0, 1]);
  assert.deepEqual(Array.from(tact.weld([0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 1, 0], [0, 1, 3, 2, 1, 3]).facets), [0, 1, 2, 0, 1, 2]);
  world.destroy();
});

test("every function of tact_c.h is here", () => {
  const sources = readdirSync(`${folder}/src`).filter((name) => !["abi.js", "wasm.js"].includes(name))
    .map((name) => readFileSync(`${folder}/src/${name}`, "utf8")).join("\n");
  const missing = functionsOf(readHeader(here("../../c/include/tact/tact_c.h"))).filter((name) => !new RegExp(`\\b${name}\\b`).test(sources));
  // Recordings are files, which a browser has not; one query is a case of many, and where there is a function by options, the
  // one without is a case of it.
  assert.deepEqual(missing.sort(), ["tact_player_close", "tact_player_cut_at", "tact_player_next", "tact_player_open", "tact_player_recorded_by",
    "tact_player_world", "tact_world_closest_point", "tact_world_detect_motion", "tact_world_distance", "tact_world_record",
    "tact_world_set_facets", "tact_world_signed_distance", "tact_world_sweep"]);
});

test("the types name what there is", () => {
  const types = readFileSync(`${folder}/index.d.ts`, "utf8");
  const named = (object) => (object === Object.prototype ? []
    : [...Object.getOwnPropertyNames(object).filter((name) => name !== "constructor"), ...named(Object.getPrototypeOf(object))]);
  const of = (object) => named(Object.getPrototypeOf(object)).filter((name) => name !== "valid" && name !== "placed");
  const world = new World({ points: true }), report = world.detect();
  const all = [...Object.keys(tact), ...named(World.prototype), ...of(report), ...of(report.keep()), ...of(report.stencils([])),
    ...of(report.stencilsWithinReach([])), ...of(world.detectMotion()), ...named(SharedArray.prototype)];
  assert.deepEqual(all.filter((name) => !new RegExp(`\\b${name}\\b`).test(types)), []);
  world.destroy();
});
