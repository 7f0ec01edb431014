// Elements made from what they hold. Text is always text: nothing that a run says becomes markup.
export function element(tag, attributes = {}, ...content) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith("on")) made.addEventListener(name.slice(2), value);
    else if (value === true) made.setAttribute(name, "");
    else if (value !== false && value !== null && value !== undefined) made.setAttribute(name, value);
  }
  made.append(...content.filter((c) => c !== null && c !== undefined).map((c) => (typeof c === "number" ? String(c) : c)));
  return made;
}

export const byId = (id) => document.getElementById(id);

export function count(n) {
  return n.toLocaleString("en").replaceAll(",", "\u2009");
}

export function plural(n, one, many = `${one}s`) {
  return `${count(n)} ${n === 1 ? one : many}`;
}

export function css([r, g, b]) {
  return `rgb(${[r, g, b].map((x) => Math.round(255 * x)).join(" ")})`;
}

/** A length with a unit that suits it. */
export function length(metres) {
  const size = Math.abs(metres);
  if (size === 0) return "0 m";
  for (const [unit, scale] of [["km", 1e3], ["m", 1], ["mm", 1e-3], ["\u00b5m", 1e-6], ["nm", 1e-9]]) {
    if (size >= (unit === "m" ? 0.1 : scale)) return `${Number((metres / scale).toPrecision(4))}\u2009${unit}`;
  }
  return `${metres.toExponential(3)}\u2009m`;
}

export function milliseconds(ms) {
  return ms >= 1 ? `${Number(ms.toPrecision(3))}\u2009ms` : `${Number((1e3 * ms).toPrecision(3))}\u2009\u00b5s`;
}
