// Drawing: what takes it, and how it looks.
import { call, callees, library, make, read, sizeOf, write } from "./memory.js";

const colorOf = ([red, green, blue, alpha = 1]) => ({ red, green, blue, alpha });

/** Options: the defaults of tact, then those that are given; colours are [red, green, blue, alpha]. */
export function makeOptions(take, options) {
  const at = take(sizeOf("tact_debug_draw_options"));
  call("tact_debug_draw_defaults", at);
  write("tact_debug_draw_options", at, Object.fromEntries(Object.entries(options).map(([key, value]) =>
    [key, Array.isArray(value) ? colorOf(value) : value])));
  return at;
}

/** A colour, by default that of points. */
export const makeColor = (take, color) => make(take, "tact_debug_color",
  color ? colorOf(color) : read("tact_debug_draw_options", makeOptions(take, {})).point);

/** Calls draw() with what passes lines, triangles and texts on to `drawer`, which may draw in its turn. */
export function drawing(drawer, draw) {
  const before = callees.draw;
  callees.draw = drawer;
  try {
    draw(library().tact_js_drawer(0));
  } finally {
    callees.draw = before;
  }
}
