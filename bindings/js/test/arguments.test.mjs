// Arguments that are of no use are refused, and never wrapped, cut or read where they are no more.
import assert from "node:assert/strict";
import { test } from "node:test";
import { TETRAHEDRON, fails, movedBy, tact } from "./package.mjs";

const { SharedArray, World } = tact;
await tact.ready();

const refused = (call, name, value) =>
  fails("invalid_argument", call, new RegExp(`${name} is ${value}${typeof value === "bigint" ? "n" : ""}, no whole number`));

test("whole numbers of 32 bits", () => {
  const world = new World({ points: true }), body = world.addBody(TETRAHEDRON), other = world.addBody({ ...TETRAHEDRON, positions: movedBy(0.5) });
  world.setLayers(body, 4, -1);
  for (const layer of [2 ** 32, -(2 ** 31) - 1, 1.7, NaN, Infinity, null, true, undefined]) {
    refused(() => world.setLayers(body, layer, 1), "layer", layer);
    refused(() => world.setLayers(body, 1, layer), "mask", layer);
    refused(() => world.setGroup(body, layer), "group", layer);
    if (layer !== undefined) refused(() => world.addBody({ ...TETRAHEDRON, layer }), "layer", layer);
  }
  refused(() => world.setLayers(body, "x", 1), "layer", '"x"');
  refused(() => world.setGroup(body, 3n), "group", "3n");
  refused(() => world.setGroup(body, {}), "group", "an object");
  assert.deepEqual([world.layerOf(body), world.maskOf(body), world.groupOf(body), world.bodyCount], [4, 2 ** 32 - 1, 0, 2]);
  for (const value of [2 ** 32 + 1, 2 ** 31, 1.9]) {
    refused(() => new World({ iterationLimit: value }), "iterationLimit", value);
    refused(() => new World({ threads: value }), "threads", value);
    refused(() => world.setSelfContactFilter(body, { rings: value }), "rings", value);
  }
  refused(() => world.addBody({ ...TETRAHEDRON, surface: 2 ** 32 }), "surface", 2 ** 32);
  refused(() => world.setExcludedLabels({ a: body, labelA: 2 ** 32 + 1, b: other, labelB: 1 }, true), "labelA", 2 ** 32 + 1);
  refused(() => world.castRay({ from: [0, 0, 0], to: [1, 1, 1], mask: 2 ** 32 }), "mask", 2 ** 32);
  refused(() => world.nameOf({ ...body, index: 2 ** 32 }), "index", 2 ** 32);
  const report = world.detect();
  refused(() => report.joinedMinima({ layers: 2 ** 32 }), "layers", 2 ** 32);
  for (const count of [2 ** 32, -1, 1.5]) {
    refused(() => world.nearestBodies({ body, count }), "count", count);
    refused(() => report.stencils([0, 4]).colors(count), "moving", count);
  }
  world.destroy();
});

test("whole numbers of 64 bits", () => {
  const world = new World({ points: true });
  for (const [given, is] of [[5, 5n], [2n ** 64n - 1n, 2n ** 64n - 1n], [Number.MAX_SAFE_INTEGER, 2n ** 53n - 1n]]) {
    const body = world.addBody({ ...TETRAHEDRON, key: given, externalId: given });
    assert.deepEqual([world.keyOf(body), world.externalIdOf(body)], [is, is]);
    world.removeBody(body);
  }
  for (const value of [2n ** 64n, -1n, -1, 2 ** 53, 1.5, NaN, null]) {
    refused(() => world.addBody({ ...TETRAHEDRON, key: value }), "key", value);
    refused(() => world.addBody({ ...TETRAHEDRON, externalId: value }), "externalId", value);
    refused(() => world.addPlane({ key: value }), "key", value);
    refused(() => world.detect().sumContacts([{ id: value, impulse: [0, 0, 1] }]), "id", value);
  }
  refused(() => world.addBody({ ...TETRAHEDRON, externalId: "x" }), "externalId", '"x"');
  assert.equal(world.bodyCount, 0);
  world.destroy();
});

test("arrays that are larger than any memory", () => {
  for (const length of [2 ** 29, 2 ** 29 + 1, 2 ** 31, 2 ** 40]) fails("out_of_memory", () => new SharedArray(Float64Array, length), /numbers/);
  for (const length of [-1, 1.5, NaN, "3", undefined]) fails("invalid_argument", () => new SharedArray(Float64Array, length), /length/);
});

test("an array of tact's memory is read though that grows in the same call", () => {
  const shared = new SharedArray(Int32Array, 12), place = new SharedArray(Float64Array, 12);
  shared.array.set(TETRAHEDRON.facets);
  place.array.set(movedBy(1));
  /** Positions for which there is no room yet: more than all of the memory. */
  const more = () => {
    const positions = new Float64Array(3 * Math.ceil(shared.array.buffer.byteLength / 24));
    positions.set(movedBy(0));
    return positions;
  };
  const grows = (call) => {
    const before = shared.array.buffer, result = call();
    assert.notEqual(shared.array.buffer, before);
    return result;
  };
  const world = new World();
  const plane = grows(() => world.addPlane({ normal: place.array.subarray(9, 12).fill(0).fill(1, 2), name: "x".repeat(shared.array.buffer.byteLength) }));
  assert.deepEqual(world.planeOf(plane).normal, [0, 0, 1]);
  place.array.set(movedBy(1));
  const body = grows(() => world.addBody({ positions: more(), facets: shared.array }));
  assert.deepEqual(Array.from(world.facetsOf(body)), TETRAHEDRON.facets);
  world.removeBody(body);
  const [large, small] = [{ ...TETRAHEDRON, positions: movedBy(3) }, TETRAHEDRON].map((one) => world.addBody(one));
  fails("wrong_size", () => grows(() => world.setPositionsOfMany([{ body: large, positions: more() }, { body: small, positions: place.array }])), /vertices/);
  const positions = more();
  grows(() => world.setFacets(small, positions, shared.array, new Int32Array(positions.length / 3).fill(-1)));
  world.destroy();
  for (const one of [shared, place]) one.free();
});

test("rows of other lengths", () => {
  const world = new World(), ragged = [[0, 0], [1, 0, 0, 1], [0, 1, 0]], pairs = [[0, 0], [1, 0], [0, 1]], body = world.addBody({ ...TETRAHEDRON, motion: "rigid" });
  const isRagged = (what, call) => fails("wrong_size", call, new RegExp(`${what}: row \\d has (\\d|no) numbers, not \\d`));
  for (const positions of [ragged, pairs, [[0, 0, 0], [1, 0, 0], 5], [[0, 0, 0], null, [1, 0, 0]], Object.assign(Array(2), [[0, 0, 0]])]) {
    isRagged("positions", () => world.addBody({ positions, facets: [0, 1, 2] }));
    isRagged("positions", () => tact.weld(positions, [0, 1, 2]));
    isRagged("positions", () => world.detect().stencils([0]).gaps(positions));
  }
  isRagged("facets", () => world.addBody({ ...TETRAHEDRON, facets: [[0, 1], [2, 0, 2, 1]] }));
  isRagged("edges", () => world.addBody({ ...TETRAHEDRON, edges: [[0, 1, 2], [3]] }));
  const rotation = [[1, 0], [0, 0, 1, 0], [0, 0, 1]];
  isRagged("rotation", () => world.setPose(body, rotation, [0, 0, 0]));
  isRagged("rotation", () => world.setPoses([{ body, rotation, translation: [0, 0, 0] }]));
  fails("invalid_argument", () => world.setPoses([{ body, translation: [0, 0, 0] }]), /rotation/);
  assert.equal(world.bodyCount, 1);
  world.destroy();
});

test("a name that C would cut", () => {
  const world = new World();
  fails("invalid_argument", () => world.addBody({ ...TETRAHEDRON, name: "a\0b" }), /name has a zero/);
  fails("invalid_argument", () => world.addPlane({ name: "\0" }), /name has a zero/);
  assert.equal(world.bodyCount, 0);
  world.destroy();
});

test("what is no object, and what every object has", () => {
  const world = new World({ points: true }), body = world.addBody(TETRAHEDRON), report = world.detect();
  for (const name of ["toString", "constructor"]) {
    fails("invalid_argument", () => report.points([name]), /gaps/);
    fails("invalid_argument", () => world.setFeatureSettings(body, { [name]: [1] }), /margins/);
  }
  fails("invalid_argument", () => report.points("gaps"), /names/);
  fails("invalid_argument", () => report.points([null]), /null/);
  for (const bytes of [null, undefined, 5, world.save().buffer]) fails("invalid_argument", () => world.restore(bytes), /bytes/);
  fails("invalid_argument", () => report.findContact(body, null), /null/);
  fails("invalid_argument", () => world.distance({ a: body, b: null }), /b is null/);
  fails("wrong_size", () => world.castRay({ from: null, to: [1, 1, 1] }), /from has no numbers/);
  fails("invalid_argument", () => world.setMotion(body, 1n), /1n is none of/);
  world.destroy();
});
