// The page to try tact, as people use it. TACT_TRY_PAGE names it; TACT_KEEP_SHOTS a folder for pictures of it.
import assert from "node:assert/strict";
import { statSync } from "node:fs";
import { after, before, test } from "node:test";
import { close, open, openPage } from "./browser.mjs";

const file = process.env.TACT_TRY_PAGE, shots = process.env.TACT_KEEP_SHOTS;
before(open);
after(close);

async function tryPage(hash = "", ...more) {
  const page = await openPage(file, hash, () => {}, ...more);
  await page.waitForFunction(() => document.documentElement.dataset.ready === "true" || !document.getElementById("message").hidden, null, { timeout: 90000 });
  assert.equal(await page.isVisible("#message"), false, await page.textContent("#message"));
  return page;
}
const steps = (page) => page.evaluate(() => window.tactTry.scene().steps);
const shot = async (page, name) => { if (shots) await page.screenshot({ path: `${shots}/${name}.png` }); };
const forSteps = (page, count) => page.evaluate((n) => { for (let i = 0; i < n; ++i) window.tactTry.scene().step(); }, count);
/** Where all vertices are: the lowest, the highest, the fastest. */
const extent = (page) => page.evaluate(() => {
  const scene = window.tactTry.scene(), { x, end, solver } = scene;
  const z = Array.from({ length: end }, (_, i) => x[3 * i + 2]).filter((_, i) => scene.bodies.some(({ first, count }) => i >= first && i < first + count));
  return { least: Math.min(...z), most: Math.max(...z), finite: z.every(Number.isFinite), speed: Math.max(...solver.velocities.subarray(0, 3 * end)) };
});

test("it is one file below 3 MB and explains itself in five sentences", async () => {
  assert.ok(statSync(file).size < 3e6);
  const page = await tryPage("#running=0"), about = (await page.textContent("#about")).trim();
  assert.equal(about.split(/[.!?](?:\s|$)/).filter(Boolean).length, 5);
  await page.close();
});

test("2,000 facets and 20 bodies, live: pictures a second", async () => {
  const page = await tryPage(), now = () => page.evaluate(() => ({ frames: window.tactTry.frames(), ms: performance.now() })), begin = await now();
  await page.waitForFunction(() => window.tactTry.scene().steps >= 120, null, { timeout: 120000 });  // two seconds, or more beside busy neighbours
  const end = await now(), rate = (1000 * (end.frames - begin.frames)) / (end.ms - begin.ms);
  const seen = await page.evaluate(() => ({ ...window.tactTry.means, facets: window.tactTry.scene().facetCount, bodies: window.tactTry.scene().bodies.length }));
  console.log(`${seen.bodies} bodies, ${seen.facets} facets: ${rate.toFixed(1)} pictures a second, tact ${seen.tact.toFixed(2)} ms, solver ${seen.solver.toFixed(2)} ms a step`);
  assert.ok(seen.facets >= 2000 && seen.bodies >= 20);
  await shot(page, "live");
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test("bodies come to rest on the cloth and the floor, and are not in each other", async () => {
  const page = await tryPage("#running=0&show=points,facets,patches,directions");
  await forSteps(page, 400);
  const { least, most, finite, speed } = await extent(page);
  assert.ok(finite);
  assert.ok(least > -0.01 && most < 3, `${least} to ${most}`);
  assert.ok(speed < 1.5, `${speed} m/s`);
  const deepest = await page.evaluate(() => Math.min(0, ...window.tactTry.scene().points.gaps));
  assert.ok(deepest > -0.03, `${deepest} m`);
  await page.waitForTimeout(400);
  await shot(page, "rest");
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test("what is set, dropped and shown; pause and step", async () => {
  const page = await tryPage("#running=0&bodies=3");
  assert.equal(await steps(page), 0);
  await page.click("#step");
  assert.equal(await steps(page), 1);
  await page.click("#drop-ring");
  await page.keyboard.press("b");
  assert.equal(await page.inputValue("#bodies"), "5");
  await page.fill("#margin", "30");
  assert.equal(await page.evaluate(() => { const scene = window.tactTry.scene(); return scene.world.marginOf(scene.bodies[1].id); }), 0.03);
  await page.fill("#bodies", "2");
  assert.equal(await page.evaluate(() => window.tactTry.scene().world.bodyCount), 4);  // with cloth and floor
  for (const name of ["points", "facets", "patches", "directions"]) await page.click(`#show-${name}`);
  await page.click("#self");
  await page.waitForTimeout(300);
  await page.click("#run");
  await page.waitForFunction(() => window.tactTry.scene().steps > 5);
  await page.click("#run");
  await page.click("#kick");
  await page.click("#restart");
  assert.equal(await steps(page), 0);
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test("the keyboard does all of it", async () => {
  const page = await tryPage("#running=0&bodies=1");
  for (const key of ["n", "n", "b", "p", "o", "k", "1", "3", "4", "ArrowLeft", "ArrowUp", "+", "-"]) await page.keyboard.press(key);
  assert.equal(await steps(page), 2);
  assert.equal(await page.inputValue("#bodies"), "4");
  assert.deepEqual(await page.evaluate(() => [...window.tactTry.state.show].sort()), ["directions", "facets", "patches"]);
  await page.keyboard.press("Space");
  assert.equal(await page.textContent("#run"), "Pause");
  await page.keyboard.press("r");
  for (let i = 0; i < 6; ++i) await page.keyboard.press("Tab");
  assert.ok(["BUTTON", "INPUT"].includes(await page.evaluate(() => document.activeElement.tagName)));
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test("a body is dragged by the mouse, the view turned beside it", async () => {
  const page = await tryPage("#running=0&bodies=0"), middle = { x: 430, y: 330 };
  const yaw = await page.evaluate(() => window.tactTry.camera.yaw);
  await page.mouse.move(middle.x, middle.y);
  await page.mouse.down();
  assert.ok(await page.evaluate(() => window.tactTry.scene().solver.pull !== null));
  const before = (await extent(page)).most;
  await page.mouse.move(middle.x, middle.y - 220, { steps: 5 });
  await forSteps(page, 60);
  assert.ok((await extent(page)).most > before + 0.1);
  await page.waitForTimeout(100);
  await shot(page, "drag");
  await page.mouse.up();
  assert.ok(await page.evaluate(() => window.tactTry.scene().solver.pull === null));
  assert.equal(await page.evaluate(() => window.tactTry.camera.yaw), yaw);
  await page.mouse.move(20, 20);
  await page.mouse.down();
  await page.mouse.move(120, 20, { steps: 3 });
  await page.mouse.up();
  assert.notEqual(await page.evaluate(() => window.tactTry.camera.yaw), yaw);
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test("a telephone: fingers, and no wider than its screen", async () => {
  const page = await tryPage("#running=0&bodies=6", { width: 390, height: 780 }, { hasTouch: true, isMobile: true, deviceScaleFactor: 2 });
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth <= window.innerWidth));
  await page.touchscreen.tap(195, 260);
  await page.waitForTimeout(200);
  await shot(page, "telephone");
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test("a link brings back what was set; one that is nonsense is no harm", async () => {
  const page = await tryPage("#running=0&bodies=7&margin=22&friction=90&self=0&show=patches&view=1,0.3,2.5");
  const link = await page.evaluate(() => window.tactTry.link());
  assert.equal(link, "#bodies=7&margin=22&friction=90&self=0&running=0&show=patches&view=1,0.3,2.5");
  const again = await tryPage(link);
  assert.equal(await again.evaluate(() => window.tactTry.link()), link);
  const nonsense = await tryPage("#bodies=1e99&margin=x&friction=-5&running=2&show=<b>,points&view=NaN,1");
  assert.equal((await nonsense.evaluate(() => window.tactTry.link())).replace(/&view.*/, ""), "#bodies=40&margin=15&friction=0&self=1&running=1&show=points");
  for (const one of [page, again, nonsense]) {
    assert.deepEqual(one.complaints, []);
    await one.close();
  }
});

test("the same steps give the same bits", async () => {
  const hashes = [];
  for (let round = 0; round < 2; ++round) {
    const page = await tryPage("#running=0&bodies=12");
    await forSteps(page, 120);
    hashes.push(await page.evaluate(() => String(window.tactTry.scene().report.hash)));
    await page.close();
  }
  assert.equal(hashes[0], hashes[1]);
});
