// Builds the page into one file: node build.mjs PACKAGE FILE, where PACKAGE is the folder of the npm package. esbuild is
// that of viewer/.
import { createRequire } from "node:module";
import { readFileSync, writeFileSync } from "node:fs";
import { resolve } from "node:path";
import { fileURLToPath } from "node:url";

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const { build } = createRequire(here("../../viewer/package.json"))("esbuild");
const [folder, file] = process.argv.slice(2);
const options = { bundle: true, minify: true, write: false, legalComments: "none", charset: "utf8", target: ["chrome113", "firefox113", "safari16.4"] };

async function bundled(path, more) {
  return (await build({ ...options, entryPoints: [here(path)], ...more })).outputFiles[0].text;
}
const parts = {
  "/*tact:style*/": await bundled("page.css", {}),
  "/*tact:script*/": (await bundled("main.js", { format: "esm", alias: { tact: resolve(folder, "src/index.js") } })).replaceAll("</script", "<\\/script"),
};
let page = readFileSync(here("page.html"), "utf8");
for (const [mark, part] of Object.entries(parts)) page = page.replace(mark, () => part);
const LARGEST = 3e6;  // bytes, so that it opens at once
if (page.length > LARGEST) throw new Error(`the page has ${page.length} bytes, more than ${LARGEST}`);
writeFileSync(file, page);
console.log(`${file}: ${page.length} bytes`);
