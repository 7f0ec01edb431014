// The page as people use it: playing, links, keys; and what it says of data that are broken or hostile.
import assert from "node:assert/strict";
import { readFileSync, writeFileSync } from "node:fs";
import { after, before, test } from "node:test";
import { close, inFolder, open, openPage, tact } from "./browser.mjs";

const CUBE = [[0, 0, 0], [1, 0, 0], [0, 1, 0], [1, 1, 0], [0, 0, 1], [1, 0, 1], [0, 1, 1], [1, 1, 1]];
const FACES = [[1, 3, 4], [1, 4, 2], [5, 6, 8], [5, 8, 7], [1, 2, 6], [1, 6, 5], [3, 7, 8], [3, 8, 4], [1, 5, 7], [1, 7, 3], [2, 4, 8], [2, 8, 6]];

function writeCube(name, [x, y, z]) {
  const lines = [...CUBE.map((v) => `v ${v[0] + x} ${v[1] + y} ${v[2] + z}`), ...FACES.map((f) => `f ${f.join(" ")}`)];
  writeFileSync(inFolder(name), `${lines.join("\n")}\n`);
  return name;
}

before(async () => {
  await open();
  tact("view", "wheel-on-ground", "--frames", "20", "--out", inFolder("wheel.html"));
});
after(close);

const step = async (page) => Number(await page.getAttribute("#clock", "data-step"));
const message = (page) => page.textContent("#message");

test("plays, loops and pauses", async () => {
  const page = await openPage(inFolder("wheel.html"));
  await page.keyboard.press("End");
  assert.equal(await step(page), 19);
  await page.keyboard.press("Space");
  await page.waitForFunction(() => { const at = Number(document.getElementById("clock").dataset.step); return at > 1 && at < 15; });
  await page.keyboard.press("Space");
  const paused = await step(page);
  await page.waitForTimeout(150);
  assert.equal(await step(page), paused);
  await page.close();
});

test("a link brings back step, pair, facet and what is shown", async () => {
  const page = await openPage(inFolder("wheel.html"));
  await page.keyboard.press("End");
  await page.locator("#pairs tr[data-pair]").first().click();
  await page.keyboard.press("4");
  await page.evaluate(() => window.tactView.selectFacet(0, 1));
  const told = await page.evaluate(() => window.tactView.link());
  const again = await openPage(inFolder("wheel.html"), told);
  assert.equal(await step(again), 19);
  assert.equal(await again.evaluate(() => window.tactView.link()), told);
  assert.equal(await again.getAttribute('[data-stage="planes"]', "aria-pressed"), "true");
  assert.ok((await again.locator("#facet").count()) === 1);
  assert.deepEqual(again.complaints, []);
  await page.close();
  await again.close();
});

test("a link that is nonsense is no harm", async () => {
  const page = await openPage(inFolder("wheel.html"), "#step=1e99&pair=7,-3,x&facet=1e12&point=-1&show=<b>&view=NaN,2");
  assert.ok((await page.locator("#stage canvas").count()) === 1);
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test("every part of the method can be shown", async () => {
  const page = await openPage(inFolder("wheel.html"), "#step=19&show=");
  const drawn = () => page.evaluate(() => { let n = 0; window.tactView.marks.group.traverse(() => ++n); return n; });
  for (const [key, stage] of [["1", "boxes"], ["2", "hulls"], ["3", "direction"], ["4", "planes"], ["5", "zones"], ["7", "patches"]]) {
    await page.evaluate(() => { const { tactView } = window; tactView.state.show.clear(); tactView.selectPair(tactView.frame.contacts[0]); });
    const before = await drawn();
    await page.keyboard.press(key);
    assert.ok((await drawn()) > before, stage);
  }
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test("of each patch the points that span it are enough", async () => {
  writeCube("below.obj", [0, 0, 0]), writeCube("above.obj", [0.3, 0.2, 1.05]);
  tact("view", "below.obj", "above.obj", "--margin", "0.04", "--few-points", "--out", inFolder("few.html"), "--json", inFolder("few.json"));
  const { points, patches } = JSON.parse(readFileSync(inFolder("few.json"))).frames[0].pairs[0];
  const page = await openPage(inFolder("few.html"));
  const shown = await page.evaluate(() => window.tactView.frame.contacts[0].points.map((point) => [...point.a.vertices, -1, ...point.b.vertices]));
  const spanning = patches.flatMap((patch) => patch.spanning).sort((x, y) => x - y);
  assert.ok(spanning.length > 0 && spanning.length < points.length);
  assert.deepEqual(shown, spanning.map((i) => [...points[i].a, -1, ...points[i].b]));
  assert.match(await page.textContent("#notes"), /at most four contact points/);
  assert.match(await page.textContent("#sentence"), new RegExp(`${points.length} contact points`)); // counted are all
  assert.equal(await page.getAttribute('#pair [data-fact="contact points"]', "data-value"), String(points.length));
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test("contact points are shown and picked", async () => {
  writeCube("lower.obj", [0, 0, 0]), writeCube("upper.obj", [0.3, 0.2, 1.05]);
  tact("view", "lower.obj", "upper.obj", "--margin", "0.04", "--out", inFolder("points.html"), "--json", inFolder("points.json"));
  const { points } = JSON.parse(readFileSync(inFolder("points.json"))).frames[0].pairs[0];
  const page = await openPage(inFolder("points.html"));
  const at = await page.evaluate(() => { const { marks, stage } = window.tactView; return stage.project(marks.points[1].place); });
  await page.mouse.click(at.x, at.y);
  const gaps = await page.$$eval("#points td[data-gap]", (cells) => cells.map((cell) => Number(cell.dataset.gap)));
  assert.deepEqual(gaps, points.map((point) => Math.fround(point.gap)));
  const chosen = await page.evaluate(() => window.tactView.state.point);
  assert.equal(await page.locator('#points tr[aria-selected="true"]').count(), 1);
  assert.match(await page.textContent("#labels"), /gap 50\u2009mm/);
  assert.ok(chosen >= 0 && chosen < points.length);
  assert.deepEqual(page.complaints, []);
  await page.close();
});

test("names are text", async () => {
  const hostile = [`<img src=x onerror="document.title='bad'">.obj`.replaceAll("/", ""), `a\u0007"'&lt;b\u202e<script>.obj`, "</script><h1>x.obj".replaceAll("/", "\u2044")];
  hostile.forEach((name, i) => writeCube(name, [0.5 * i, 0.3 * i, 0.2 * i]));
  tact("view", ...hostile, "--out", inFolder("names.html"));
  const page = await openPage(inFolder("names.html"));
  const shown = await page.textContent("#panel");
  assert.ok(shown.includes(hostile[0]) && shown.includes(`a\u2407"'&lt;b\ufffd<script>.obj`));
  assert.equal(await page.locator("#panel img, #panel script").count(), 0);
  assert.notEqual(await page.title(), "bad");
  assert.deepEqual(page.complaints, []);
  await page.close();
});

const whole = () => readFileSync(inFolder("wheel.html"), "utf8");
const BROKEN = {
  "a page that was cut": [(page) => page.slice(0, page.indexOf('id="tact-meshes"')), /cut/],
  "a page that was cut in a number": [(page) => page.slice(0, page.lastIndexOf('"statistics"') + 400), /damaged|cut/],
  "a chunk that is missing": [(page) => page.replace('id="tact-chunk-0"', 'id="x"'), /lacks a part/],
  "a chunk that is not base64": [(page) => page.replace('id="tact-chunk-0">', 'id="tact-chunk-0">?'), /base64/],
  "a chunk that does not unpack": [(page) => page.replace(/(id="tact-chunk-0">.{60}).{8}/, "$1AAAAAAAA"), /damaged/],
  "meshes in place of a chunk": [(page) => page.replace(/(id="tact-chunk-0">)[^<]*/, (_, begin) => begin + page.match(/id="tact-meshes">([^<]*)/)[1]), /damaged/],
  "a format of later": [(page) => page.replace(/{"format":\d+/, '{"format":99'), /format 99/],
};
for (const [what, [damage, expected]] of Object.entries(BROKEN)) {
  test(`${what} ends in a message`, async () => {
    writeFileSync(inFolder("broken.html"), damage(whole()));
    const page = await openPage(inFolder("broken.html"));
    assert.match(await message(page), expected);
    assert.equal(await page.isVisible("#app"), false);
    await page.close();
  });
}
