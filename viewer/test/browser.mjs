// Debian's Chromium without a window, and the program whose pages it opens.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { pathToFileURL } from "node:url";
import { chromium } from "playwright-core";

const FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic",
  "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--font-render-hinting=none"];

export const program = process.env.TACT_PROGRAM;
export const folder = mkdtempSync(join(tmpdir(), "tact-viewer-"));
export const inFolder = (name) => join(folder, name);
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));

export function tact(...words) {
  return execFileSync(program, words, { encoding: "utf8", cwd: folder, stdio: ["ignore", "pipe", "pipe"] });
}

let browser;
export async function open() {
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: FLAGS });
}
export const close = () => browser.close();

/** A page of a file, ready or with a message; `page.complaints`: what the console was told. */
export async function openPage(file, hash = "") {
  const page = await browser.newPage({ viewport: { width: 900, height: 620 } });
  page.complaints = [];
  page.on("console", (message) => {
    // Reading a picked pixel waits for the software renderer, which says so.
    if (message.type() === "error" || (message.type() === "warning" && !message.text().includes("ReadPixels"))) page.complaints.push(message.text());
  });
  page.on("pageerror", (error) => page.complaints.push(error.message));
  page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || page.complaints.push(`asked for ${request.url()}`));
  await page.goto(pathToFileURL(file).href + hash);
  await page.waitForFunction(() => document.documentElement.dataset.ready === "true" || !document.getElementById("message").hidden, null, { timeout: 90000 });
  return page;
}

/** How much two pictures (PNG) differ: the mean over pixels and colours, and the share of pixels that differ clearly. */
export async function difference(first, second) {
  const page = await browser.newPage();
  const result = await page.evaluate(async (sources) => {
    const [a, b] = await Promise.all(sources.map(async (source) => {
      const image = new Image();
      image.src = `data:image/png;base64,${source}`;
      await image.decode();
      const canvas = Object.assign(document.createElement("canvas"), { width: image.width, height: image.height });
      const context = canvas.getContext("2d");
      context.drawImage(image, 0, 0);
      return context.getImageData(0, 0, image.width, image.height);
    }));
    if (a.width !== b.width || a.height !== b.height) return { mean: 255, clearly: 1 };
    let sum = 0, clearly = 0;
    for (let i = 0; i < a.data.length; i += 4) {
      const d = [0, 1, 2].map((k) => Math.abs(a.data[i + k] - b.data[i + k]));
      sum += d[0] + d[1] + d[2];
      if (Math.max(...d) > 48) ++clearly;
    }
    return { mean: sum / (a.data.length * 0.75), clearly: (4 * clearly) / a.data.length };
  }, [first, second].map((bytes) => bytes.toString("base64")));
  await page.close();
  return result;
}
