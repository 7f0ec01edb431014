// Settings below bodies, distances, kept reports and stencils: the scenes and numbers of tests/c and tests/python.
import assert from "node:assert/strict";
import { test } from "node:test";
import { drawn, fails, shifted, tact } from "./package.mjs";

const { SharedArray, World } = tact;
await tact.ready();

const QUADS = [[0, 1, 3, 2], [4, 6, 7, 5], [0, 4, 5, 1], [2, 3, 7, 6], [0, 2, 6, 4], [1, 5, 7, 3]];
const BOX = { positions: [0, 1].flatMap((x) => [0, 1].flatMap((y) => [0, 1].flatMap((z) => [x, y, z]))),
  facets: QUADS.flatMap((q) => [q[0], q[1], q[2], q[0], q[2], q[3]]) };
const boxAt = (...to) => shifted(BOX.positions, ...to);
/** Unit cubes, 2 m apart. */
function twoBoxes(settings) {
  const world = new World(settings);
  return { world, a: world.addBody(BOX), b: world.addBody({ ...BOX, positions: boxAt(3) }) };
}
const SQUARE = [0, 0, 0.03, 1, 0, 0.03, 1, 1, 0.03, 0, 1, 0.03], HALVES = [0, 1, 2, 0, 2, 3];
/** A square above a plane. */
function squareAndFloor() {
  const world = new World({ points: true });
  const sheet = world.addBody({ positions: SQUARE, facets: HALVES, surface: "sheet", margin: 0.1, restOffset: 0.01 });
  return { world, sheet, floor: world.addPlane({ margin: 0.05, restOffset: 0 }) };
}
/** A sheet of n x n squares of 1 m in all. */
function grid(n) {
  const at = (i, j) => i * (n + 1) + j, positions = [], facets = [];
  for (let i = 0; i <= n; ++i) for (let j = 0; j <= n; ++j) positions.push(i / n, j / n, 0);
  for (let i = 0; i < n; ++i) for (let j = 0; j < n; ++j) facets.push(at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j), at(i + 1, j + 1), at(i, j + 1));
  return { positions, facets, surface: "sheet" };
}
const isNear = (value, expected, error) => assert.ok(Math.abs(value - expected) <= error, `${value}, not ${expected}`);

test("distances, nearest bodies, signed distances", () => {
  const { world, a, b } = twoBoxes();
  const apart = world.distance({ a, b });
  assert.deepEqual([apart.a, apart.b, apart.distance, apart.containment], [a, b, 2, "none"]);
  assert.ok(apart.aFacet >= 0 && apart.bFacet >= 0);
  isNear(apart.aBarycentric.reduce((sum, weight) => sum + weight), 1, 1e-15);
  assert.deepEqual(world.distances([{ a, b, within: 1 }, { a: b, b: a }]).map((one) => [one.a, one.distance]), [[a, Infinity], [b, 2]]);
  assert.deepEqual(world.nearestBodies({ body: a, count: 4 }), [apart]);
  assert.deepEqual(world.nearestBodies({ body: a, within: 1 }), []);
  const inner = world.addBody({ ...BOX, positions: boxAt(0).map((value) => 0.25 + value / 2) });
  assert.deepEqual([world.distance({ a, b: inner }).distance, world.distance({ a, b: inner }).containment], [0.25, "b_in_a"]);
  assert.deepEqual(world.nearestBodies({ body: b, count: 2 }).map((one) => one.b), [a, inner]);
  assert.deepEqual(world.signedDistances([{ point: [3.5, 0.5, 0.25] }, { point: [2, 0.5, 0.5] }]).map((one) => one.distance), [-0.25, 1]);
  assert.equal(world.signedDistance({ point: [3.5, 0.5, 0.25] }).body, b);
  assert.equal(world.signedDistance({ point: [9, 9, 9], within: 1 }), null);
  fails("invalid_argument", () => world.distance({ a, b: a }), /./);
  world.destroy();
});

test("sweeps and overlaps", () => {
  const { world, a, b } = twoBoxes();
  const hits = world.sweeps([{ body: a, way: [4, 0, 0] }, { body: a, way: [-4, 0, 0] }, { body: a, angle: Math.PI, center: [2, 0, 0] }]);
  assert.deepEqual([hits[0].body, hits[1]], [b, null]);
  assert.ok(hits[0].fraction <= 0.5 && hits[0].fraction > 0.5 - 1e-12);
  assert.deepEqual(hits[0].normal, [1, 0, 0]);
  assert.ok(hits[2].fraction > 0 && hits[2].fraction < 1);
  assert.deepEqual(world.sweep({ body: a, way: [4, 0, 0] }), hits[0]);
  assert.deepEqual(world.overlap(a, b), { volume: 0, area: 0 });
  world.setPositions(b, boxAt(0.5));
  const { volume, area } = world.overlap(a, b);
  isNear(volume, 0.5, 1e-14);
  isNear(area, 4, 1e-14);
  fails("invalid_argument", () => world.overlap(a, a), /./);
  world.destroy();
});

test("rest offsets decide what touches", () => {
  const { world, sheet, floor } = squareAndFloor(), touching = () => world.detect().contacts[0].touching;
  assert.deepEqual([world.restOffsetOf(sheet), world.restOffsetOf(floor), touching()], [0.01, 0, false]);
  world.setRestOffset(sheet, null);
  assert.deepEqual([world.restOffsetOf(sheet), touching()], [0.1, true]);
  world.setRestOffset(sheet, 0);
  assert.equal(touching(), false);
  world.setFeatureSettings(sheet, { restOffsets: [0, 0.02, 0.04, 0] });
  assert.equal(touching(), true);
  fails("invalid_argument", () => world.setRestOffset(sheet, 0.11), /rest/);
  world.destroy();
});

test("labels, layers and margins of vertices and facets", () => {
  const { world, sheet, floor } = squareAndFloor(), pointCount = () => world.detect().pointCount;
  world.setFeatureSettings(sheet, { vertexLabels: [10, 11, 12, 13], facetLabels: Uint32Array.of(20, 2 ** 32 - 1) });
  assert.deepEqual(world.labelsOf(sheet, [2, 3, -1]), { vertices: [12, 13, 0], facet: 2 ** 32 - 1 });
  fails("invalid_argument", () => world.labelsOf(sheet, [4, -1, -1]), /./);
  const report = world.detect(), labels = report.pointLabels(), points = report.points(["aVertices"]);
  assert.equal(labels.count, 4);
  for (let i = 0; i < 4; ++i) {
    const { vertices, facet } = world.labelsOf(sheet, points.aVertices.subarray(3 * i, 3 * i + 3));
    assert.deepEqual([Array.from(labels.aVertices.slice(3 * i, 3 * i + 3)), labels.aFacets[i], labels.bFacets[i]], [vertices, facet, 0]);
  }
  assert.deepEqual(Object.keys(report.pointLabels(["aFacets"])), ["count", "aFacets"]);
  world.setFeatureSettings(sheet, { vertexMasks: [~0, ~0, 0, ~0] });
  assert.equal(pointCount(), 3);
  const { vertexMasks, vertexLabels } = world.featureSettingsOf(sheet);
  assert.deepEqual([Array.from(vertexMasks), vertexLabels.length], [[2 ** 32 - 1, 2 ** 32 - 1, 0, 2 ** 32 - 1], 0]);
  world.setLayers(floor, 1, 1);
  world.setFeatureSettings(sheet, { facetLayers: [1, 2], facetMasks: [~0, 1] });
  assert.equal(pointCount(), 3, "vertex 3 is of the second facet alone");
  world.setFeatureSettings(sheet, { margins: [0.1, 0.01, 0.1, 0.1], restOffsets: new Float32Array(4), facetLayers: undefined });
  world.setMargin(floor, 0);
  assert.deepEqual(world.detect().contacts[0].points.map((point) => point.aVertices[0]), [0, 2, 3]);
  assert.deepEqual(Array.from(world.featureSettingsOf(sheet).margins), [0.1, 0.01, 0.1, 0.1]);
  fails("wrong_size", () => world.setFeatureSettings(sheet, { facetLabels: [1] }), /./);
  fails("invalid_argument", () => world.setFeatureSettings(sheet, { facetLabels: [1, 1.5] }), /whole/);
  fails("invalid_argument", () => world.setFeatureSettings(sheet, { labels: [1] }), /vertexLabels/);
  world.destroy();
});

test("two labels are excluded", () => {
  const { world, sheet } = squareAndFloor();
  const other = world.addBody({ positions: shifted(SQUARE, 0, 0, 0.05), facets: HALVES, surface: "sheet", margin: 0.1 });
  for (const body of [sheet, other]) world.setFeatureSettings(body, { facetLabels: [7, 7] });
  const pair = { a: sheet, labelA: 7, b: other, labelB: 7 }, touching = () => world.detect().findContact(sheet, other)?.touching ?? false;
  assert.ok(touching());
  world.setExcludedLabels(pair, true);
  assert.ok(world.areExcludedLabels({ a: other, labelA: 7, b: sheet, labelB: 7 }));
  assert.ok(!world.areExcludedLabels({ ...pair, kind: "vertex" }));
  assert.ok(!touching());
  world.setExcludedLabels(pair, false);
  assert.ok(touching());
  fails("invalid_argument", () => world.setExcludedLabels({ ...pair, labelA: 0 }, true), /label 0/);
  fails("invalid_argument", () => world.setExcludedLabels({ ...pair, kind: "edge" }, true), /facet, vertex/);
  world.destroy();
});

test("neighbours of a rope are left out", () => {
  const world = new World({ withinReach: true }), x = Array.from({ length: 12 }, (_, i) => [0.1 * i, 0, 0]);
  const rope = world.addBody({ positions: x, edges: Array.from({ length: 11 }, (_, i) => [i, i + 1]), margin: 0.12, selfContact: true });
  const contacts = () => world.detect().contacts.length;
  assert.equal(contacts(), 1);
  world.setSelfContactFilter(rope, { rings: 3 });
  assert.deepEqual([contacts(), world.selfContactFilterOf(rope).rings], [0, 3]);
  world.setSelfContactFilter(rope, { restDistance: 0.31, restPositions: x });
  assert.equal(contacts(), 0);
  const filter = world.selfContactFilterOf(rope);
  assert.deepEqual([filter.rings, filter.restDistance, Array.from(filter.restPositions)], [0, 0.31, x.flat()]);
  world.setSelfContactFilter(rope);
  assert.equal(contacts(), 1);
  fails("invalid_argument", () => world.setSelfContactFilter(rope, { rings: 17 }), /./);
  world.destroy();
});

test("meshes of edges and points change", () => {
  const { world, sheet } = squareAndFloor();
  world.setFeatureSettings(sheet, { facetLabels: [20, 21] });
  const rest = { edges: [[2, 3]], points: Uint16Array.of(3), facetMap: [1] };
  world.setFacets(sheet, SQUARE, [0, 1, 2], Float64Array.of(0, 1, 2, -1), rest);
  assert.deepEqual([Array.from(world.edgesOf(sheet)), Array.from(world.pointsOf(sheet))], [[2, 3], [3]]);
  assert.deepEqual(Array.from(world.featureSettingsOf(sheet).facetLabels), [21]);
  fails("wrong_size", () => world.setFacets(sheet, SQUARE, [0, 1, 2], [0, 1, 2, -1], { ...rest, facetMap: [0, 0] }), /./);
  world.setFacets(sheet, SQUARE, HALVES, Uint16Array.of(0, 1, 2, 3));
  assert.deepEqual([world.facetCountOf(sheet), world.edgeCountOf(sheet)], [2, 0]);
  world.destroy();
});

test("arrays of numbers of other kinds", () => {
  const world = new World({ points: true }), floats = new SharedArray(Float32Array, 9);
  const a = world.addBody({ ...BOX, motion: "rigid" }), b = world.addBody({ ...BOX, positions: boxAt(3) });
  floats.array.set([0, -1, 0, 1, 0, 0, 0, 0, 1]);
  world.setPose(a, floats, Float32Array.of(1, 2, 3));
  assert.deepEqual(Array.from(world.positionsOf(a).slice(9, 12)), [0, 2, 4]);
  world.setMargin(b, 1);
  world.setPose(a, [1, 0, 0, 0, 1, 0, 0, 0, 1], [1.75, 0, 0]);
  const report = world.detect();
  assert.deepEqual(report.stencils(Uint16Array.of(8, 0)).all, report.stencils([8, 0]).all);
  assert.ok(report.stencils([8, 0]).count > 0);
  floats.free();
  world.destroy();
});

test("a kept report stays", () => {
  const { world, b } = twoBoxes({ points: true });
  world.setPositions(b, boxAt(0.5, 0.25, 0.125));
  const report = world.detect(), { hash } = report, pairs = report.contacts[0].facetPairs;
  const kept = report.keep();
  world.setPositions(b, boxAt(9));
  assert.notEqual(world.detect().hash, hash);
  world.removeBody(b);
  const next = world.addBody({ ...BOX, positions: boxAt(0.5) });
  assert.equal(next.index, b.index);
  assert.equal(kept.contacts[0].b, b, "the same object, though another body has its index");
  assert.equal(world.bodyAt(b.index), next);
  assert.equal(world.detect().contacts[0].b, next);
  world.destroy();
  assert.equal(kept.hash, hash);
  assert.deepEqual(kept.contacts[0].facetPairs, pairs);
  assert.equal(kept.points().count, kept.pointCount);
  assert.equal(kept.stencils([0, 8]).count, kept.pointCount);
  fails("stale_report", () => report.hash, /next step/);
  kept.free();
  fails("stale_report", () => kept.hash, /freed/);
});

test("two kept reports in turns", () => {
  const { world, b } = twoBoxes(), turns = [null, null], hashes = [];
  for (let step = 0; step < 6; ++step) {
    world.setPositions(b, boxAt(0.5 + 0.01 * step, 0.25, 0.125));
    const report = world.detect();
    turns[step % 2] = report.keep(turns[step % 2]);
    hashes.push(report.hash);
    assert.deepEqual(turns.map((kept) => kept?.hash).filter(Boolean).sort(), hashes.slice(-2).sort());
  }
  const [before, last] = turns, [contact] = last.contacts, again = before.keep(last);
  assert.equal(again.hash, before.hash);
  assert.equal(again.keep(again).hash, before.hash);
  fails("stale_report", () => last.hash, /used again/);
  fails("stale_report", () => contact.facetPairs, /used again/);
  world.destroy();
});

test("a restored state has the bodies that it had", () => {
  const { world, b } = twoBoxes(), saved = world.save();
  world.removeBody(b);
  const other = world.addBody({ ...BOX, positions: boxAt(6) });
  world.restore(saved);
  assert.equal(world.bodies()[1], b);
  assert.equal(world.bodyAt(1), b);
  assert.deepEqual([world.contains(b), world.contains(other)], [true, false]);
  world.destroy();
});

test("minima of joined surfaces", () => {
  const world = new World({ points: true }), quad = { positions: [0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0], facets: HALVES, margin: 0.05 };
  for (const x of [-1, 0]) world.addBody({ ...quad, positions: shifted(quad.positions, x), motion: "fixed" });
  world.addBody({ ...quad, positions: shifted(quad.positions.map((value) => 0.2 * value), 0.02, 0.4, 0.01) });
  const report = world.detect(), minima = report.joinedMinima(), points = report.points(["normals", "minima"]);
  const sideways = (found) => Array.from(found).filter((is, i) => is && Math.hypot(...points.normals.subarray(3 * i, 3 * i + 2)) > 1e-6).length;
  assert.deepEqual([minima.length, sideways(minima), minima.includes(1)], [points.count, 0, true]);
  assert.ok(sideways(points.minima) > 0);
  fails("invalid_argument", () => report.joinedMinima({ within: -1 }), /within/);
  world.destroy();
});

test("barriers of pairs within reach are those of their distances", () => {
  const world = new World({ withinReach: true }), sheet = { ...grid(4), margin: 0.05 }, above = shifted(sheet.positions, 0.03, 0.02, 0.06);
  world.addBody(sheet);
  world.addBody({ ...sheet, positions: above });
  const report = world.detect(), pairs = report.stencilsWithinReach([0, 25]), x = new SharedArray(Float64Array, 150);
  assert.equal(pairs.count, report.contacts[0].withinReach.length);
  assert.ok(pairs.count > 10);
  x.array.set([...sheet.positions, ...above]);
  const { values, gradients, hessians } = pairs.barriers(x, 0.1, { hessians: true });
  pairs.closest.all.forEach(({ gap: d }, i) => isNear(values[i], -((d - 0.1) ** 2) * Math.log(d / 0.1), 1e-9));
  for (let axis = 0; axis < 3; ++axis) isNear(gradients.reduce((sum, value, i) => (i % 3 === axis ? sum + value : sum), 0), 0, 1e-9);
  assert.equal(hessians.length, 144 * pairs.count);
  assert.deepEqual(pairs.barriers(x, 0.1, { rest: x }).values.length, pairs.count);
  fails("wrong_size", () => report.stencilsWithinReach([0]), /./);
  x.free();
  world.destroy();
});

test("impacts are constraints", () => {
  const world = new World(), sheet = grid(6), high = shifted(sheet.positions, 0.03, 0.02, 0.2), low = shifted(high, 0, 0, -0.5);
  world.addBody(sheet);
  const body = world.addBody({ ...sheet, positions: high });
  world.detect();
  world.setPositions(body, low);
  const motion = world.detectMotion(), begin = [...sheet.positions, ...high], end = [...sheet.positions, ...low];
  const stencils = motion.stencils([0, 49], begin, end);
  assert.equal(stencils.count, motion.impacts.filter((impact) => impact.stops).length);
  assert.ok(stencils.count > 10);
  for (const { normal } of stencils.all) isNear(Math.abs(normal[2]), 1, 1e-9);
  for (const rate of stencils.gapRates(end.map((value, i) => value - begin[i]))) isNear(rate, -0.5, 1e-9);
  fails("wrong_size", () => motion.stencils([0], begin, end), /./);
  fails("wrong_size", () => motion.stencils([0, 49], begin, end.slice(3)), /end/);
  world.destroy();
});

test("answers are drawn", () => {
  const { world, a, b } = twoBoxes(), lengths = drawn();
  world.debugDrawDistances(world.distances([{ a, b }, { a, b, within: 1 }]), lengths, { distance: [1, 0, 0, 0.5] });
  assert.deepEqual([lengths.lengths, lengths.words, lengths.colors], [[2], ["2 m"], [[1, 0, 0, 0.5]]]);
  fails("wrong_order", () => world.debugDrawSums([], drawn()), /./);
  world.destroy();
  const scene = new World({ points: true, patches: true }), facets = [0, 1, 2];
  const first = [0, 0, 0, 1, 0, 0, 0, 1, 0], second = [0.1, 0.1, 0.05, 0.9, 0.1, 0.3, 0.1, 0.9, 0.3];
  for (const positions of [first, second]) scene.addBody({ positions, facets, margin: 0.1 });
  const stencils = scene.detect().stencils([0, 3]), found = drawn(), arrows = drawn();
  stencils.debugDraw([...first, ...second], found);
  assert.ok(stencils.count > 0 && found.lengths.length >= 2 * stencils.count);
  stencils.all.forEach(({ gap }) => assert.ok(found.lengths.some((length) => Math.abs(length - gap) < 1e-12)));
  const red = drawn();
  stencils.debugDraw([...first, ...second], red, [1, 0, 0]);
  assert.deepEqual([red.colors[0], red.lengths], [[1, 0, 0, 1], found.lengths]);
  scene.debugDrawSums(stencils.all.map(({ id }) => ({ id, impulse: [0, 0, 1] })), arrows);
  assert.ok(arrows.lengths.length > 6);
  scene.destroy();
});

test("a drawer cannot change what it draws, and draws in its turn", () => {
  const { world, a, b } = twoBoxes(), inner = drawn();
  world.detect();
  for (const change of [() => world.detect(), () => world.removeBody(a), () => world.setPositions(b, boxAt(4))]) {
    fails("busy", () => world.debugDraw({ line: change }, { surfaces: true }), /./);
  }
  let lines = 0;
  world.debugDraw({ line: () => { if (++lines === 1) world.debugDrawDistances(world.distances([{ a, b }]), inner); } }, { surfaces: true });
  assert.ok(lines > 20);
  assert.deepEqual(inner.lengths, [2]);
  world.destroy();
});
