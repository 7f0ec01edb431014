// The column beside the picture: what touches in this step, how it was found, and what is selected.
import { byId, count, css, element, length, milliseconds, plural } from "./dom.js";
import { kMostDetailed } from "./marks.js";
import { OUTCOMES, FEATURES, SOURCES, outcomeCounts, outcomeOf, visible } from "./run.js";

const kMostRows = 200;

const sum = (contacts, of) => contacts.reduce((n, contact) => n + of(contact), 0);
const overlapping = (frame) => frame.candidates.filter((pair) => pair.overlap).length;
const apart = (contact) => !contact.self && contact.depth < 0; // within the margins

/** What a stage of the method is called, which key shows it, and what it did: for a step, and for a pair. */
const METHOD = [
  { key: "boxes", name: "Boxes", digit: "1",
    step: (s, frame) => `${plural(frame.candidates.length, "pair")} of boxes overlap`,
    pair: () => "the boxes of the two bodies overlap" },
  { key: "hulls", name: "Hulls", digit: "2",
    step: (s, frame) => {
      const near = frame.contacts.filter(apart).length;
      return `${plural(overlapping(frame), "pair")} of convex hulls overlap${near > 0 ? `, ${count(near)} more are within the margins` : ""}`;
    },
    pair: (c) => (apart(c) ? "the hulls are apart, within the margins" : "the convex hulls overlap") },
  { key: "direction", name: "Direction and depth", digit: "3",
    step: (s, frame) => {
      const found = frame.contacts.filter((c) => !c.self && !apart(c)), carried = found.filter((c) => SOURCES[c.source] === "carried").length;
      return `${count(carried)} carried on, ${count(found.length - carried)} new`;
    },
    pair: (c) => (apart(c) ? `${length(-c.depth)} apart along the arrow`
      : `${length(c.depth)} along the arrow; ${SOURCES[c.source]}, ${plural(c.iterations, "iteration")}`) },
  { key: "planes", name: "Planes and slab", digit: "4",
    step: () => "facets outside the slab between two planes cannot touch",
    pair: (c) => (apart(c) ? `the planes are ${length(Math.abs(c.planeA - c.planeB))} apart` : `the slab is ${length(Math.abs(c.planeA - c.planeB))} thick`) },
  { key: "zones", name: "Impact zones", digit: "5", needs: "zones",
    step: () => "disks around the parts in the slab",
    pair: (c) => (c.zoneA && c.zoneB ? `radii ${length(c.zoneA.radius)} and ${length(c.zoneB.radius)}` : "not computed") },
  { key: "outcomes", name: "Facets", digit: "6",
    step: (s) => `${count(s("kept_facets"))} kept in this step, ${plural(s("facet_pairs"), "pair")} meet`,
    pair: (c) => `${count(c.keptA)} and ${count(c.keptB)} kept, ${plural(c.pairs.length / 2, "pair")} meet` },
  { key: "patches", name: "Patches", digit: "7", needs: "patches",
    step: (s, frame) => plural(sum(frame.contacts, (c) => c.patches.length), "patch", "patches"),
    pair: (c) => plural(c.patches.length, "patch", "patches") },
  { key: "points", name: "Contact points", digit: "8", needs: "points",
    step: (s, frame) => plural(sum(frame.contacts, (c) => c.pointCount), "point"),
    pair: (c) => plural(c.pointCount, "point") },
  { key: "curves", name: "Intersection curves", digit: "9", needs: "curves",
    step: (s, frame) => plural(sum(frame.contacts, (c) => c.curves.length), "curve"),
    pair: (c) => plural(c.curves.length, "curve") },
];
export const STAGES = METHOD.map(({ key, digit, needs }) => ({ key, digit, needs }));

const vector = (v) => `(${v.map((x) => Number(x.toPrecision(4))).join(", ")})`;

/** A row of a table of facts; the number as the program has it stands in data-value. */
function fact(name, text, value) {
  return element("tr", {}, element("th", {}, name), element("td", { "data-fact": name, "data-value": JSON.stringify(value), title: String(value) }, text));
}

function section(title, ...content) {
  return element("section", {}, element("h2", {}, title), ...content);
}

// Opened and closed by people, and left so from step to step.
function foldable(app, key, title, make) {
  const details = element("details", { id: key, open: app.state.open.has(key) }, element("summary", {}, title));
  if (app.state.open.has(key)) details.append(make());
  details.addEventListener("toggle", () => {
    if (details.open === app.state.open.has(key)) return;
    if (details.open) app.state.open.add(key);
    else app.state.open.delete(key);
    app.showPanel();
  });
  return details;
}

export class Panel {
  constructor(app) {
    this.app = app;
    this.root = byId("panel");
  }

  name(body) {
    return visible(this.app.run.bodies[body].name);
  }

  swatch(body) {
    return element("i", { class: "swatch", style: `background:${css(this.app.colors[body])}` });
  }

  pairName(contact) {
    return contact.self ? `${this.name(contact.a)} with itself` : `${this.name(contact.a)} – ${this.name(contact.b)}`;
  }

  show(frame, chosen) {
    const { scrollTop } = this.root;
    const parts = [this.header(frame), this.facets(frame, chosen), this.method(frame, chosen)];
    if (this.app.state.facet !== null) parts.push(this.facet(frame));
    if (chosen !== null) parts.push(this.pair(chosen));
    parts.push(this.pairs(frame, chosen), this.bodies(frame), this.ledger(), this.statistics(frame), this.notes());
    this.root.replaceChildren(...parts);
    this.root.scrollTop = scrollTop;
  }

  header(frame) {
    const { head } = this.app.run, s = (name) => this.app.run.stat(name, frame.index);
    const alive = frame.positions.filter((p) => p !== null).length;
    const touching = s("touching_contacts"), points = sum(frame.contacts, (c) => c.pointCount);
    const told = head.settings.accuracy === "hulls" ? "Accuracy hulls computes no facet pairs."
      : touching === 0 ? "Nothing touches." : s("facet_pairs") === 0 ? `${plural(touching, "pair touches", "pairs touch")}; no facets meet, ${plural(points, "contact point")}.` : `${plural(touching, "pair touches", "pairs touch")}: ${plural(s("facet_pairs"), "pair of facets meets", "pairs of facets meet")}.`;
    return element("header", {},
      element("h1", {}, visible(head.title)),
      element("p", { class: "quiet" }, `${head.kind} · tact ${head.tact} · accuracy ${head.settings.accuracy}${head.interrupted ? " · interrupted" : ""}`),
      element("p", { id: "sentence" }, `${plural(alive, "body", "bodies")}: the boxes of ${plural(frame.candidates.length, "pair")} overlap, and the hulls of ${count(overlapping(frame))}. `,
        element("strong", {}, told)));
  }

  method(frame, chosen) {
    const { app } = this, s = (name) => app.run.stat(name, frame.index);
    const rows = METHOD.map((stage) => {
      const missing = stage.needs !== undefined && !app.run.head.settings[stage.needs];
      const tooMany = ["hulls", "planes", "zones"].includes(stage.key) && chosen === null && frame.contacts.length > kMostDetailed;
      const text = missing ? "not in this run" : tooMany && app.state.show.has(stage.key) ? "select a pair to see it" : chosen !== null && !chosen.self ? stage.pair(chosen) : stage.step(s, frame);
      return element("button", {
        class: "stage", "data-stage": stage.key, "aria-pressed": String(app.state.show.has(stage.key)), disabled: missing,
        onclick: () => app.toggle(stage.key),
      }, element("kbd", {}, stage.digit), element("span", {}, element("b", {}, stage.name), element("span", { class: "quiet" }, text)));
    });
    return section("The method, step by step", element("p", { class: "quiet" }, "Each line rules out what cannot touch. Click to show it."), element("div", { id: "method" }, ...rows));
  }

  // What became of the facets: of the pair that is selected, or of all pairs in contact.
  facets(frame, chosen) {
    const contacts = (chosen !== null ? [chosen] : frame.contacts).filter((c) => c.outcomesA !== null);
    if (contacts.length === 0) {
      const why = !this.app.run.head.settings.outcomes ? "Accuracy hulls computes no facet pairs." : chosen?.self ? "A body is compared with itself by other means." : "Nothing: no hulls overlap here.";
      return section("What became of the facets", element("p", { class: "quiet" }, why));
    }
    const sums = (side) => OUTCOMES.map((_, k) => contacts.reduce((n, c) => n + c[side][k], 0));
    for (const c of contacts) c.countsA ??= outcomeCounts(c.outcomesA), c.countsB ??= outcomeCounts(c.outcomesB);
    const a = sums("countsA"), b = sums("countsB"), all = a.map((n, k) => n + b[k]), total = all.reduce((x, y) => x + y, 0);
    const bar = element("div", { class: "bar" }, ...OUTCOMES.map((outcome, k) =>
      element("i", { style: `flex-grow:${all[k] / total};background:${css(outcome.color)}`, title: `${outcome.name}: ${all[k]}` })));
    const rows = OUTCOMES.map((outcome, k) => {
      const cells = chosen !== null ? [a[k], b[k]] : [all[k]];
      return element("tr", { title: outcome.why, class: all[k] === 0 ? "none" : null },
        element("th", {}, element("i", { class: "swatch", style: `background:${css(outcome.color)}` }), outcome.name),
        ...cells.map((n, side) => element("td", { "data-outcome": outcome.key, "data-side": side, "data-value": n }, count(n))));
    });
    const heads = chosen !== null ? [this.name(chosen.a), this.name(chosen.b)] : [contacts.length === 1 ? "facets" : `of ${contacts.length} pairs`];
    return section("What became of the facets", bar,
      element("table", { id: "outcomes" }, element("tr", {}, element("th"), ...heads.map((h) => element("td", { class: "quiet name" }, h))), ...rows));
  }

  facet(frame) {
    const { app } = this, body = app.run.bodyOfFacet(app.state.facet), number = app.state.facet - app.run.bodies[body].firstFacet;
    const rows = [];
    for (const contact of frame.contacts.filter((c) => c.a === body || c.b === body)) {
      const isA = contact.a === body, runs = isA ? contact.outcomesA : contact.outcomesB, other = isA ? contact.b : contact.a;
      const met = app.facetsMet(contact, body, number);
      if (runs === null && met.length === 0) continue;
      const outcome = runs === null ? OUTCOMES.length - 1 : outcomeOf(runs, number);
      rows.push(element("tr", {}, element("th", {}, element("i", { class: "swatch", style: `background:${css(OUTCOMES[outcome].color)}` }), `against ${this.name(other)}`),
        element("td", { "data-facet-outcome": OUTCOMES[outcome].key, title: OUTCOMES[outcome].why }, `${OUTCOMES[outcome].name}${met.length > 0 ? `: ${met.slice(0, 8).join(", ")}${met.length > 8 ? " …" : ""}` : ""}`)));
    }
    const cluster = app.run.clustersOf(body, frame.index)?.[number];
    return section(`Facet ${number} of ${this.name(body)}`, element("table", { id: "facet", class: "facts" },
      fact("vertices", [...app.run.bodies[body].corners.subarray(3 * number, 3 * number + 3)].join(", "), number),
      cluster === undefined ? null : fact("cluster", count(cluster), cluster), ...rows));
  }

  pair(contact) {
    const facts = contact.self ? [] : [
      fact("direction", vector(contact.direction), contact.direction),
      fact("depth", length(contact.depth), contact.depth),
      fact("source", SOURCES[contact.source] + (contact.limitReached ? ", a limit was reached" : ""), SOURCES[contact.source]),
      fact("iterations", count(contact.iterations), contact.iterations),
      fact("plane of a", length(contact.planeA), contact.planeA),
      fact("plane of b", length(contact.planeB), contact.planeB),
      contact.zoneA ? fact("zone of a", `radius ${length(contact.zoneA.radius)}`, contact.zoneA.radius) : null,
      contact.zoneB ? fact("zone of b", `radius ${length(contact.zoneB.radius)}`, contact.zoneB.radius) : null,
      fact("kept facets", `${count(contact.keptA)} and ${count(contact.keptB)}`, [contact.keptA, contact.keptB]),
    ];
    facts.push(fact("facet pairs", count(contact.pairs.length / 2), contact.pairs.length / 2));
    if (this.app.run.head.settings.points) facts.push(fact("contact points", count(contact.pointCount), contact.pointCount));
    return section(`The pair ${this.pairName(contact)}`, element("table", { id: "pair", class: "facts" }, ...facts),
      contact.pairs.length > 0 ? foldable(this.app, "pair-facets", "facet pairs", () => this.facetPairs(contact)) : null,
      contact.patches.length > 0 ? foldable(this.app, "pair-patches", "patches", () => this.patches(contact)) : null,
      contact.points.length > 0 ? foldable(this.app, "pair-points", "contact points", () => this.points(contact)) : null);
  }

  facetPairs(contact) {
    const links = [];
    for (let i = 0; i < Math.min(contact.pairs.length, 2 * kMostRows); i += 2) {
      const [fa, fb] = [contact.pairs[i], contact.pairs[i + 1]];
      links.push(element("button", { class: "chip", onclick: () => this.app.selectFacet(contact.a, fa, contact) }, `${fa}–${fb}`), " ");
    }
    return element("p", { class: "chips" }, ...links, this.more(contact.pairs.length / 2));
  }

  patches(contact) {
    return element("table", {}, element("tr", {}, ...["", "facet pairs", "depth", "direction"].map((h) => element("td", { class: "quiet" }, h))),
      ...contact.patches.slice(0, kMostRows).map((patch, i) => element("tr", {}, element("th", {}, i), element("td", {}, count(patch.pairs.length)),
        element("td", {}, length(patch.depth)), element("td", {}, vector(patch.direction)))));
  }

  points(contact) {
    const row = (point, i) => element("tr", { class: "link", "aria-selected": String(i === this.app.state.point), onclick: () => this.app.selectPoint(contact, i) },
      element("th", {}, FEATURES[point.kind]), element("td", { "data-gap": point.gap }, length(point.gap)),
      element("td", { title: vector(point.normal) }, point.patch), element("td", { class: "mono" }, point.id));
    return element("div", {}, element("table", { id: "points" }, element("tr", {}, ...["", "gap", "patch", "id"].map((h) => element("td", { class: "quiet" }, h))),
      ...contact.points.slice(0, kMostRows).map(row)), this.more(contact.points.length, contact.pointCount));
  }

  more(held, all = held) {
    const shown = Math.min(held, kMostRows);
    return all > shown ? element("p", { class: "quiet" }, `and ${count(all - shown)} more`) : null;
  }

  pairs(frame, chosen) {
    const withPoints = this.app.run.head.settings.points;
    const contacts = [...frame.contacts].sort((x, y) => y.pairs.length - x.pairs.length || y.pointCount - x.pointCount || y.depth - x.depth);
    const row = (contact) => element("tr", { class: "link", "aria-selected": String(contact === chosen), "data-pair": `${contact.a},${contact.b}`,
      onclick: () => this.app.selectPair(contact === chosen ? null : contact) },
      element("th", {}, this.swatch(contact.a), this.swatch(contact.b), this.pairName(contact)),
      element("td", {}, contact.self ? "" : length(contact.depth)), element("td", { "data-pairs": contact.pairs.length / 2 }, count(contact.pairs.length / 2)),
      withPoints ? element("td", { "data-points": contact.pointCount }, count(contact.pointCount)) : null);
    return section(`Pairs in contact (${count(contacts.length)})`,
      contacts.length === 0 ? element("p", { class: "quiet" }, "None in this step.")
        : element("table", { id: "pairs" }, element("tr", {}, ...["", "depth", "facets", ...(withPoints ? ["points"] : [])].map((h) => element("td", { class: "quiet" }, h))), ...contacts.slice(0, kMostRows).map(row)),
      this.more(contacts.length));
  }

  bodies(frame) {
    const { app } = this, alive = app.run.bodies.map((_, i) => i).filter((i) => frame.positions[i] !== null);
    const words = { 1: "solid", 0.25: "glass", 0: "hidden" };
    const row = (i) => element("tr", {}, element("th", {}, this.swatch(i), this.name(i)),
      element("td", { class: "quiet" }, `${plural(app.run.bodies[i].facets, "facet")}, ${app.run.bodies[i].surface}`),
      element("td", {}, element("button", { class: "chip", "data-body": i, title: "solid, glass, hidden", onclick: () => app.cycle(i) }, words[app.state.opacity[i]] ?? words[0.25])));
    return foldable(app, "bodies", `Bodies (${count(alive.length)})`, () => element("div", {},
      element("p", { class: "chips" }, ...[1, 0.25, 0].map((o) => element("button", { class: "chip", onclick: () => app.setAll(o) }, `all ${words[o]}`))),
      element("table", {}, ...alive.slice(0, kMostRows).map(row)), this.more(alive.length)));
  }

  ledger() {
    const { head } = this.app.run;
    return foldable(this.app, "ledger", "What was skipped, and why", () => element("div", {},
      element("p", { class: "quiet" }, `Over all ${plural(head.steps, "step")} of the run. The time is an estimate: the number times the mean of what stands under the mouse.`),
      element("table", { id: "skipped" }, ...head.ledger.map((line) => element("tr", { title: `${line.why}${line.measured_on ? ` (mean of: ${line.measured_on})` : ""}` },
        element("th", {}, line.what, element("span", { class: "quiet" }, ` ${line.why}`)), element("td", {}, count(line.count)),
        element("td", {}, line.ms === null ? "–" : milliseconds(line.ms)))))));
  }

  statistics(frame) {
    const { head } = this.app.run;
    return foldable(this.app, "statistics", "All numbers of this step", () => element("table", { class: "facts" },
      fact("hash", head.frames.hash[frame.index], head.frames.hash[frame.index]),
      ...head.statistics.counts.map(({ name, text, values }) => element("tr", { title: text }, element("th", {}, name.replaceAll("_", " ")),
        element("td", { "data-count": name, "data-value": values[frame.index] }, count(values[frame.index])))),
      ...head.statistics.times.map(({ name, text, values }) => element("tr", { title: text }, element("th", {}, name.replaceAll("_", " ")),
        element("td", {}, milliseconds(values[frame.index]))))));
  }

  notes() {
    const { bodies } = this.app.run, coarsest = bodies.reduce((most, body) => Math.max(most, body.step), 0);
    const cut = bodies.filter((body) => body.cut_off).length;
    return element("p", { class: "quiet", id: "notes" },
      `Numbers are the program's. Positions are rounded for the picture alone, to ${length(coarsest)} at most; so are weights, normals and gaps of contact points, to some 2e-3, 1e-5 and 1e-7 of their size. Hulls are those of rounded positions.`,
      this.app.run.head.settings.few_points ? "Of each patch at most four contact points are shown, which span it (--few-points)." : null,
      cut > 0 ? ` ${plural(cut, "body", "bodies")} went too far away to be drawn where they are.` : null);
  }
}
