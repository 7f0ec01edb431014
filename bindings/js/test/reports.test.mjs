// How long reports are valid: after destroy(), and after calls that fail.
import assert from "node:assert/strict";
import { test } from "node:test";
import { TETRAHEDRON, fails, movedBy, tact } from "./package.mjs";

const { World } = tact;
await tact.ready();

/** Two bodies that cross. */
function crossing(settings) {
  const world = new World(settings), a = world.addBody(TETRAHEDRON);
  return { world, a, b: world.addBody({ ...TETRAHEDRON, positions: movedBy(0.75) }) };
}

test("a kept report outlives a call of keep() that fails", () => {
  const { world } = crossing(), report = world.detect(), kept = report.keep(), { hash } = kept;
  world.destroy();
  fails("invalid_handle", () => report.keep(kept), /destroyed/);
  assert.equal(kept.hash, hash);
  kept.free();
  fails("stale_report", () => kept.hash, /freed/);
});

test("a report outlives a step that is refused", () => {
  const { world } = crossing(), report = world.detect(), { hash } = report;
  fails("busy", () => world.debugDraw({ line: () => world.detect() }, { facetPairs: true }), /./);
  assert.equal(report.hash, hash);
  assert.equal(report.contacts[0].facetPairs.length, 18);
  world.detect();
  fails("stale_report", () => report.hash, /next step/);
  world.destroy();
});

test("what a motion found outlives a call that is refused", () => {
  const { world, b } = crossing();
  world.detect();
  world.setPositions(b, movedBy(0.5));
  const motion = world.detectMotion(), { firstTime } = motion;
  for (const distance of [-1, NaN, Infinity]) fails("invalid_argument", () => world.detectMotion({ distance }), /distance of motion/);
  fails("invalid_argument", () => world.detectMotion({ wanted: "some" }), /first_of_pair/);
  fails("busy", () => world.debugDraw({ line: () => world.detectMotion() }, { facetPairs: true }), /./);
  assert.equal(motion.firstTime, firstTime);
  world.detectMotion({ distance: 0 });
  fails("stale_report", () => motion.firstTime, /./);
  world.destroy();
});

test("a step is made though who takes its messages throws, and ends the report before it", () => {
  let told = 0, seed = 7;
  const world = new World({ iterationLimit: 1, onMessage: () => { told += 1; world.detect(); } });
  const random = () => (seed = (seed * 16807) % 2147483647) / 2147483647 - 0.5;
  // A tetrahedron that turns and stretches wildly: one iteration finds few directions.
  const wild = () => TETRAHEDRON.positions.map((value) => 3 * value - 1 + random());
  const bodies = Array.from({ length: 8 }, () => world.addBody({ ...TETRAHEDRON, positions: wild(), surface: "sheet" }));
  for (let step = 0; step < 50 && told === 0; ++step) {
    const report = world.detect();
    for (const body of bodies) world.setPositions(body, wild().map((value, i, all) => all[(i + step) % 12] + 0.1 * value));
    try {
      world.detect();
    } catch (error) {
      assert.equal(error.code, "busy", "what the call of the world in the message threw");
    }
    fails("stale_report", () => report.hash, /next step/);
  }
  assert.ok(told > 0);
  world.destroy();
});

test("reports of a world that is destroyed", () => {
  const { world } = crossing({ points: true, patches: true, curves: true, withinReach: true });
  const report = world.detect(), [contact] = report.contacts, kept = report.keep(), pairs = Array.from(contact.facetPairs);
  const motion = world.detectMotion();
  world.destroy();
  for (const name of ["facetPairs", "points", "withinReach", "patches", "curves", "hash"]) {
    fails("invalid_handle", () => contact[name], /destroyed/);
  }
  for (const name of ["contacts", "pointCount", "candidatePairs", "began", "ended", "patchEvents", "statistics", "trace", "hash"]) {
    fails("invalid_handle", () => report[name], /destroyed/);
  }
  for (const name of ["firstTime", "impacts", "pairs", "statistics"]) fails("invalid_handle", () => motion[name], /destroyed/);
  fails("invalid_handle", () => report.stencils([0, 4]), /destroyed/);
  assert.deepEqual(Array.from(kept.contacts[0].facetPairs), pairs);
  kept.free();
});
