// Debian's Chromium without a window, by the packages of viewer/.
import { createRequire } from "node:module";
import { fileURLToPath, pathToFileURL } from "node:url";

const { chromium } = createRequire(fileURLToPath(new URL("../../../viewer/package.json", import.meta.url)))("playwright-core");
const FLAGS = ["--headless", "--no-sandbox", "--disable-gpu", "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--disable-quic",
  "--no-first-run", "--disable-background-networking", "--disable-component-update", "--disable-sync", "--font-render-hinting=none"];

let browser;
export async function open() {
  browser = await chromium.launch({ executablePath: process.env.CHROMIUM ?? "/usr/bin/chromium", args: FLAGS });
}
export const close = () => browser.close();

/** A page of a file; `page.complaints`: what the console was told that is wrong, and what was asked of the network. */
export async function openPage(file, hash = "", tell = () => {}, viewport = { width: 1180, height: 720 }, more = {}) {
  const page = await browser.newPage({ viewport, ...more });
  page.complaints = [];
  page.on("console", (message) => {
    // A picture of the page waits for the software renderer, which says so.
    if (["error", "warning"].includes(message.type())) message.text().includes("ReadPixels") || page.complaints.push(message.text());
    else tell(message.text());
  });
  page.on("pageerror", (error) => page.complaints.push(error.message));
  page.on("request", (request) => /^(file|data|blob):/.test(request.url()) || page.complaints.push(`asked for ${request.url()}`));
  await page.goto(pathToFileURL(file).href + hash);
  return page;
}
