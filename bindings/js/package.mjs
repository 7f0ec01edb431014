// Lays the package together: node package.mjs FOLDER tact.wasm abi.js SOURCE...
import { copyFileSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { basename, join } from "node:path";
import { gzipSync } from "node:zlib";

const [folder, wasm, ...sources] = process.argv.slice(2);
rmSync(folder, { recursive: true, force: true });
mkdirSync(join(folder, "src"), { recursive: true });
for (const source of sources) copyFileSync(source, join(folder, /\.js$/.test(source) ? "src" : "", basename(source)));
const bytes = readFileSync(wasm);
// What it asks for is what src/memory.js has: of the system a clock and no files, of JavaScript its four callbacks.
const known = { tact: /^(message|line|triangle|text)$/, wasi_snapshot_preview1: /^(clock_time_get|environ_(sizes_)?get|fd_\w+|proc_exit)$/, env: /^(__syscall_\w+|emscripten_notify_memory_growth)$/ };
const unknown = WebAssembly.Module.imports(new WebAssembly.Module(bytes)).filter(({ module, name }) => !known[module]?.test(name));
if (unknown.length > 0) throw new Error(`nobody knows what is asked for: ${unknown.map(({ module, name }) => `${module}.${name}`).join(", ")}`);
// In one file with the rest: every bundler, a page on disk and node take it, and nothing is fetched.
writeFileSync(join(folder, "src", "wasm.js"), `export const base64 = "${gzipSync(bytes, { level: 9 }).toString("base64")}";\n`);
