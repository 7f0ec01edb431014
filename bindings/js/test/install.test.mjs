// As a user has it: packed, installed into a fresh folder, run by node, and bundled into a page.
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import { copyFileSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { createRequire } from "node:module";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { after, before, test } from "node:test";
import { fileURLToPath } from "node:url";

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const EXPECTED = `step 0: 1 contacts
  left and right, 0.14 m deep, 9 facet pairs
step 1: 1 contacts
  left and right, 0.09 m deep, 9 facet pairs
step 2: 1 contacts
  left and right, 0.03 m deep, 9 facet pairs
step 3: 0 contacts
`;
const folder = mkdtempSync(join(tmpdir(), "tact-install-"));
const run = (program, ...words) => execFileSync(program, words, { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "inherit"] });

before(() => {
  const [{ filename, files }] = JSON.parse(run("npm", "pack", process.env.TACT_PACKAGE, "--json", "--silent"));
  assert.ok(files.some(({ path }) => path === "index.d.ts") && files.some(({ path }) => path === "src/wasm.js") && files.some(({ path }) => path === "LICENSE"));
  writeFileSync(join(folder, "package.json"), JSON.stringify({ name: "fresh", private: true }));
  run("npm", "install", "--offline", "--no-audit", "--no-fund", "--loglevel=error", `./${filename}`);
  copyFileSync(here("../../../examples/start/js/first.mjs"), join(folder, "first.mjs"));
});
after(() => rmSync(folder, { recursive: true, force: true }));

test("the first program of the manual runs in node", () => {
  assert.equal(run("node", "first.mjs"), EXPECTED);
});

test("and in a page, from a bundler", async () => {
  const { build } = createRequire(here("../../../viewer/package.json"))("esbuild");
  const [{ text }] = (await build({ entryPoints: [join(folder, "first.mjs")], bundle: true, write: false, format: "esm", minify: true, target: "es2022" })).outputFiles;
  const page = join(folder, "page.html");
  writeFileSync(page, `<!doctype html><link rel="icon" href="data:,"><script type="module">${text.replaceAll("</script", "<\\/script")}\n;window.done = true</script>`);
  const { close, open, openPage } = await import("../../../docs/try/test/browser.mjs");
  await open();
  const told = [], opened = await openPage(page, "", (line) => told.push(line));
  await opened.waitForFunction(() => window.done === true);
  assert.equal(`${told.join("\n")}\n`, EXPECTED);
  assert.deepEqual(opened.complaints, []);
  await close();
});

test("the types are those of a module", () => {
  const { exports } = JSON.parse(readFileSync(join(folder, "node_modules/tact/package.json")));
  assert.deepEqual(Object.keys(exports["."]), ["types", "default"]);  // in this order: what stands after the default is not seen
});
