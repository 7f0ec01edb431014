// The package as it is built, whose folder TACT_PACKAGE names, and what its tests share.
import assert from "node:assert/strict";
import { fileURLToPath, pathToFileURL } from "node:url";

export const here = (path) => fileURLToPath(new URL(path, import.meta.url));
export const folder = process.env.TACT_PACKAGE;
export const tact = await import(pathToFileURL(`${folder}/src/index.js`).href);

export const TETRAHEDRON = { positions: [0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1], facets: [0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3] };
export const shifted = (positions, x, y = 0, z = 0) => positions.map((value, i) => value + [x, y, z][i % 3]);
export const movedBy = (x, y, z) => shifted(TETRAHEDRON.positions, x, y, z);
export const SHEET = { positions: [-5, -5, 0, 5, -5, 0, 5, 5, 0, -5, 5, 0], facets: [0, 1, 2, 0, 2, 3], surface: "sheet" };

export const fails = (code, call, words) =>
  assert.throws(call, (error) => error instanceof tact.TactError && error.code === code && words.test(error.message));

/** What a drawer got: lines as their lengths, with the colours, and texts. */
export function drawn() {
  const lengths = [], colors = [], words = [];
  const line = (from, to, color) => {
    lengths.push(Math.hypot(...from.map((value, i) => value - to[i])));
    colors.push(color);
  };
  return { lengths, colors, words, line, text: (_at, text) => words.push(text) };
}
