// How long reports are valid: after destroy(), and after calls that fail.
import assert from "node:assert/strict";
import { test } from "node:test";
import { SHEET, TETRAHEDRON, fails, movedBy, tact } from "./package.mjs";

const { World } = tact;
await tact.ready();

/** Two bodies that cross. */
function crossing(settings) {
  const world = new World(settings), a = world.addBody(TETRAHEDRON);
  return { world, a, b: world.addBody({ ...TETRAHEDRON, positions: movedBy(0.75) }) };
}

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
