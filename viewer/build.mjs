// Builds the page from src/ into one file: node build.mjs FILE. The same sources give the same bytes.
import { build } from "esbuild";
import { readFileSync, writeFileSync } from "node:fs";
import { fileURLToPath } from "node:url";

const here = (path) => fileURLToPath(new URL(path, import.meta.url));
const options = { bundle: true, minify: true, write: false, legalComments: "none", charset: "utf8", target: ["chrome113", "firefox113", "safari16.4"] };

async function bundled(path, more) {
  const result = await build({ ...options, entryPoints: [here(path)], ...more });
  return result.outputFiles[0].text;
}

const NOTICE = ["three", "uplot"].map((name) => {
  const { version } = JSON.parse(readFileSync(here(`node_modules/${name}/package.json`)));
  return `${name} ${version}:\n${readFileSync(here(`node_modules/${name}/LICENSE`), "utf8").trim()}`;
}).join("\n\n");

const script = await bundled("src/main.js", { format: "esm" });
const style = await bundled("src/style.css", {});
const parts = {
  "/*tact:style*/": style,
  "/*tact:script*/": `/*!\nThis page holds:\n\n${NOTICE}\n*/\n${script.replaceAll("</script", "<\\/script")}`,
};
let page = readFileSync(here("src/page.html"), "utf8");
for (const [mark, part] of Object.entries(parts)) page = page.replace(mark, () => part);
if (page.split("<!--tact:data-->").length !== 2) throw new Error("the page must have one place for data");
writeFileSync(process.argv[2], page);
