// What the pages of all scenes show equals what the program's JSON says.
import assert from "node:assert/strict";
import { existsSync, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";
import { close, difference, inFolder, open, openPage, tact } from "./browser.mjs";

// Each with so many steps that bodies meet; small, as the machine of the tests draws without a graphics card.
const SCENES = {
  "cloth-over-sphere": ["--size", "24", "--frames", "32"],
  "sphere-into-cloth": ["--size", "24", "--frames", "40"],
  pile: ["--size", "6", "--frames", "40"],
  bullets: ["--frames", "40"],
  clamp: ["--frames", "16", "--accuracy", "paper"],
  "liver-and-tool": ["--frames", "24"],
  "sphere-in-cloth": ["--frames", "40"],
  "wheel-on-ground": ["--frames", "60"],
  net: ["--size", "5", "--frames", "40"],
  surgery: ["--size", "11", "--frames", "60"],
};
const OUTCOMES = ["outside_box", "outside_slab", "far", "facing_away", "outside_zone", "kept", "meets"];

before(open);
after(close);

const value = async (page, selector) => JSON.parse(await page.locator(selector).first().getAttribute("data-value"));
const numberIn = (text) => Number(text.replaceAll("\u2009", ""));

async function expectStatistics(page, frame) {
  if (!(await page.evaluate(() => document.getElementById("statistics").open))) await page.click("#statistics > summary");
  await page.waitForSelector("#statistics td[data-count]");
  const shown = await page.$$eval("#statistics td[data-count]", (cells) => cells.map((cell) => [cell.dataset.count, cell.textContent]));
  assert.deepEqual(Object.fromEntries(shown.map(([name, text]) => [name, numberIn(text)])), frame.stats);
  assert.equal(await page.textContent('#statistics [data-fact="hash"]'), frame.hash);
}

// The page has a body of its own for each time that a body's facets change: the numbers of those of this step.
const numbersIn = (page, bodies) =>
  page.evaluate((names) => {
    const step = Number(document.getElementById("clock").dataset.step);
    return names.map((name) => window.tactView.run.bodies.findIndex((body) => body.name === name && body.first <= step && step < body.end));
  }, bodies.map((body) => body.name));

async function expectPair(page, contact, bodies) {
  const numbers = await numbersIn(page, bodies);
  const row = page.locator(`#pairs tr[data-pair="${numbers[contact.a]},${numbers[contact.b]}"]`);
  if ((await row.getAttribute("aria-selected")) !== "true") await row.click();
  assert.deepEqual(await value(page, '#pair [data-fact="direction"]'), contact.direction.map((x) => x + 0)); // -0 is 0
  assert.equal(await value(page, '#pair [data-fact="depth"]'), contact.depth);
  assert.equal(await value(page, '#pair [data-fact="source"]'), contact.source);
  assert.equal(numberIn(await page.textContent('#pair [data-fact="iterations"]')), contact.iterations);
  assert.equal(numberIn(await page.textContent('#pair [data-fact="facet pairs"]')), contact.facet_pairs.length);
  const kept = (await page.textContent('#pair [data-fact="kept facets"]')).split(" and ").map(numberIn);
  assert.deepEqual(kept, contact.kept_facets);
  if (contact.outcomes === undefined) return assert.equal(await page.locator("#outcomes").count(), 0); // nearer than the margins, no more
  for (const side of [0, 1]) {
    const cells = await page.$$eval(`#outcomes td[data-side="${side}"]`, (found) => found.map((cell) => [cell.dataset.outcome, cell.textContent]));
    assert.deepEqual(Object.fromEntries(cells.map(([outcome, text]) => [outcome, numberIn(text)])), contact.outcomes[side]);
    assert.deepEqual(cells.map(([outcome]) => outcome), OUTCOMES);
    assert.equal(contact.outcomes[side].kept + contact.outcomes[side].meets, kept[side]);
  }
}

const plural = (n, one, many = `${one}s`) => `${n} ${n === 1 ? one : many}`;
const total = (list, of) => list.reduce((sum, one) => sum + of(one), 0);
const pointsOf = (frame) => frame.pairs.flatMap((pair) => pair.points ?? []);

// What the head and the method say of a step, in whole sentences, counted anew from the program's pairs.
async function expectWords(page, frame, bodies) {
  await page.keyboard.press("Escape");
  const candidates = frame.pairs.filter((pair) => pair.a !== pair.b);
  const overlap = candidates.filter((pair) => pair.hulls_overlap), near = candidates.filter((pair) => !pair.hulls_overlap && pair.direction !== undefined);
  const facets = total(frame.pairs, (pair) => pair.facet_pairs?.length ?? 0), points = pointsOf(frame).length;
  const carried = overlap.filter((pair) => pair.source === "carried").length, touching = plural(frame.stats.touching_contacts, "pair touches", "pairs touch");
  const sentence = (await page.textContent("#sentence")).replaceAll("\u2009", "");
  assert.ok(sentence.startsWith(`${plural(bodies.length, "body", "bodies")}: the boxes of ${plural(candidates.length, "pair")} overlap, and the hulls of ${overlap.length}. `), sentence);
  assert.ok(sentence.endsWith(frame.stats.touching_contacts === 0 ? "Nothing touches." : facets === 0 ? `${touching}; no facets meet, ${plural(points, "contact point")}.`
    : `${touching}: ${plural(facets, "pair of facets meets", "pairs of facets meet")}.`), sentence);
  const told = async (stage) => {
    const text = (await page.textContent(`[data-stage="${stage}"] .quiet`)).replaceAll("\u2009", "");
    return ["not in this run", "select a pair to see it"].includes(text) ? null : text;
  };
  assert.equal(await told("boxes"), `${plural(candidates.length, "pair")} of boxes overlap`);
  const hulls = await told("hulls");
  if (hulls !== null) assert.equal(hulls, `${plural(overlap.length, "pair")} of convex hulls overlap${near.length > 0 ? `, ${near.length} more are within the margins` : ""}`);
  assert.equal(await told("direction"), `${carried} carried on, ${overlap.length - carried} new`);
  assert.equal(await told("outcomes"), `${frame.stats.kept_facets} kept in this step, ${plural(facets, "pair")} meet`);
  for (const [stage, expected] of [["patches", plural(total(frame.pairs, (pair) => pair.patches?.length ?? 0), "patch", "patches")], ["points", plural(points, "point")]]) {
    const text = await told(stage);
    if (text !== null) assert.equal(text, expected);
  }
  const rows = await page.$$eval("#pairs tr[data-pair]", (found) => found.map((row) => [row.dataset.pair, row.querySelector("[data-pairs]").textContent, row.querySelector("[data-points]")?.textContent]));
  const numbers = await numbersIn(page, bodies);
  const expected = frame.pairs.filter((pair) => pair.a === pair.b || pair.direction !== undefined).map((pair) => [`${numbers[pair.a]},${numbers[pair.b]}`, pair.facet_pairs.length, pair.points?.length]);
  assert.deepEqual(rows.map(([pair, facetPairs, found]) => [pair, numberIn(facetPairs), found && numberIn(found)]).sort(), expected.sort());
}

// The plots: every step's counts, least gap and times, and no time of the program's is left out.
const PARTS_OF_OTHERS = ["regroup", "kdop", "gjk", "narrow_phase", "total"];
async function expectPlots(page, frames) {
  const [counts, times] = await page.evaluate(() => window.tactView.timeline.plots.map(({ plot }) => plot.series.slice(1).map(({ label }, i) => [label, [...plot.data[i + 1]]])));
  const found = Object.fromEntries(counts);
  assert.deepEqual(found["facet pairs"], frames.map((frame) => total(frame.pairs, (pair) => pair.facet_pairs.length)));
  if (frames.some((frame) => frame.pairs.some((pair) => pair.points !== undefined))) {
    assert.deepEqual(found["contact points"], frames.map((frame) => pointsOf(frame).length));
    assert.deepEqual(found["least gap"], frames.map((frame) => (pointsOf(frame).length > 0 ? Math.min(...pointsOf(frame).map((point) => point.gap)) : null)));
  }
  const sums = times[0][1]; // the highest of the curves that lie over each other
  frames.forEach((frame, i) => {
    const expected = total(Object.entries(frame.times_ms), ([name, ms]) => (PARTS_OF_OTHERS.includes(name) ? 0 : ms));
    assert.ok(Math.abs(sums[i] - expected) <= 1e-9 * expected, `step ${i}: ${sums[i]} ms of ${expected}`);
  });
}

// A click on a facet that meets another selects it and its pair, and tells which facets it meets.
async function expectPick(page, pairs, bodies) {
  const numbers = await numbersIn(page, bodies);
  const contacts = pairs.map((pair) => ({ ...pair, a: numbers[pair.a], b: numbers[pair.b] }));
  const target = await page.evaluate((pairs) => {
    const { tactView } = window, { stage, run } = tactView;
    const look = (body, facet) => {
      const at = stage.project(stage.surface.centroid(body, facet));
      return at !== null && stage.facetAt(at.x, at.y) === run.bodies[body].firstFacet + facet ? { ...at, body, facet } : null;
    };
    const met = pairs.flatMap(({ a, b, facet_pairs: both }) => both.slice(0, 40).flatMap(([fa, fb]) => [[a, fa], [b, fb]]));
    for (const [body, facet] of met) {
      const seen = look(body, facet);
      if (seen !== null) return seen;
    }
    // They are inside a body: seen from its inside, all others hidden.
    const [body, facet] = met[0];
    tactView.state.opacity.fill(0);
    tactView.state.opacity[body] = 1;
    tactView.showAll();
    const [p, q, r] = stage.surface.triangle(body, facet), normal = q.clone().sub(p).cross(r.clone().sub(p)).normalize();
    for (const side of [1, -1]) {
      const center = stage.surface.centroid(body, facet);
      stage.controls.target.copy(center);
      stage.camera.position.copy(center).addScaledVector(normal, side * 0.02 * stage.size);
      stage.controls.update();
      stage.drawNow();
      const seen = look(body, facet);
      if (seen !== null) return seen;
    }
    return null;
  }, contacts);
  assert.notEqual(target, null, "no facet that meets another can be seen");
  await page.mouse.click(target.x, target.y);
  const name = await page.evaluate((body) => window.tactView.run.bodies[body].name, target.body);
  assert.equal(await page.locator("section:has(#facet) h2").textContent(), `Facet ${target.facet} of ${name}`);
  const told = await page.$$eval('#facet [data-facet-outcome="meets"]', (cells) => cells.map((cell) => cell.textContent));
  const expected = contacts.map(({ a, b, facet_pairs: met }) => (a === target.body ? met.filter(([fa]) => fa === target.facet).map(([, fb]) => fb)
    : b === target.body ? met.filter(([, fb]) => fb === target.facet).map(([fa]) => fa) : [])).filter((met) => met.length > 0);
  assert.deepEqual(told, expected.map((met) => `meets: ${met.slice(0, 8).join(", ")}${met.length > 8 ? " …" : ""}`));
}

async function expectPicture(page, name) {
  const file = fileURLToPath(new URL(`shots/${name}.png`, import.meta.url));
  const shot = await page.locator("#stage").screenshot();
  if (process.env.TACT_KEEP_SHOTS) {
    mkdirSync(new URL("shots/", import.meta.url), { recursive: true });
    writeFileSync(file, shot);
  }
  assert.ok(existsSync(file), `${file} is missing: scripts/viewer.sh shots keeps it`);
  const { mean, clearly } = await difference(shot, readFileSync(file));
  if (mean > 2 || clearly > 0.02) writeFileSync(`/tmp/tact-viewer-${name}.png`, shot);
  assert.ok(mean <= 2 && clearly <= 0.02, `${name}: mean ${mean.toFixed(2)}, ${(100 * clearly).toFixed(2)} % differ: see /tmp/tact-viewer-${name}.png`);
}

for (const [scene, options] of Object.entries(SCENES)) {
  test(scene, async () => {
    const file = inFolder(`${scene}.html`), json = inFolder(`${scene}.json`);
    tact("view", scene, ...options, "--out", file, "--json", json);
    const { frames, bodies } = JSON.parse(readFileSync(json));
    const page = await openPage(file);
    const shown = async () => frames[Number(await page.getAttribute("#clock", "data-step"))];
    const busiest = await shown();
    assert.equal(busiest.stats.facet_pairs, Math.max(...frames.map((frame) => frame.stats.facet_pairs)));
    await expectPicture(page, scene);
    const contacts = busiest.pairs.filter((pair) => pair.direction !== undefined);
    const ofItself = busiest.pairs.filter((pair) => pair.a === pair.b);
    assert.equal(await page.locator("#pairs tr[data-pair]").count(), contacts.length + ofItself.length);
    await expectStatistics(page, busiest);
    await expectWords(page, busiest, bodies);
    await expectPlots(page, frames);
    for (const contact of contacts.slice(0, 3)) await expectPair(page, contact, bodies);
    if (busiest.stats.facet_pairs > 0) await expectPick(page, contacts, bodies);
    await page.keyboard.press("ArrowLeft");
    const before = await shown();
    assert.equal(before.frame, Math.max(0, busiest.frame - 1));
    await expectStatistics(page, before);
    await page.keyboard.press("Home");
    await expectStatistics(page, frames[0]);
    await expectWords(page, frames[0], bodies);
    assert.deepEqual(page.complaints, []);
    await page.close();
  });
}
