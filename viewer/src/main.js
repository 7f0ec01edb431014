// The page: state, what changes it, and the parts that show it.
import * as THREE from "three";
import { byId, css, element, length } from "./dom.js";
import { Marks } from "./marks.js";
import { Panel, STAGES } from "./panel.js";
import { DataError, Run, visible } from "./run.js";
import { Stage } from "./stage.js";
import { Timeline } from "./timeline.js";

const HAS_ADDRESS = location.protocol !== "about:"; // not in a frame of another page, such as a notebook
const SPEEDS = [1, 2, 5, 10, 15, 30, 60]; // frames a second
const OPACITIES = [1, 0.25, 0];
const OTHERS = 0.08; // how opaque bodies are that are not of the selected pair
const KEYS = [
  ["space", "play or pause"], ["← →", "one step back, or on; with shift ten"], ["Home End", "first and last step"],
  ["1 … 8", "show a part of the method"], ["N P", "next and previous pair"], ["F", "bring the pair near"], ["H", "see all"],
  ["I", "fade the other bodies"], ["W", "edges of facets"], ["K", "clusters of facets"], ["L", "loop"], ["+ -", "faster, slower"],
  ["C", "copy a link"], ["Esc", "select nothing"],
];

function fail(message) {
  const box = byId("message");
  box.textContent = message;
  box.hidden = false;
  byId("app").hidden = true;
}

// Hues that are far apart, whatever their number.
function bodyColor(body, i) {
  if (body.fixed) return [0.6, 0.63, 0.68];
  const color = new THREE.Color().setHSL((0.56 + 0.618034 * i) % 1, 0.42, 0.66, THREE.SRGBColorSpace);
  return color.getRGB({}, THREE.SRGBColorSpace) && Object.values(color.getRGB({}, THREE.SRGBColorSpace));
}

class App {
  constructor(run) {
    this.run = run;
    this.colors = run.bodies.map(bodyColor);
    this.state = {
      frame: 0,
      pair: null, // bodies
      facet: null, // over all bodies
      point: null, // of the pair
      show: new Set(["direction", "outcomes", "points", "curves", run.head.settings.zones ? "zones" : "planes"]),
      clusters: false,
      wire: true,
      isolate: true,
      opacity: run.bodies.map((body) => body.opacity),
      playing: false,
      loop: true,
      speed: 30,
      open: new Set(run.bodies.length <= 6 ? ["bodies"] : []),
    };
  }

  async start() {
    const link = this.readLink();
    this.state.frame = link.frame ?? this.busiest();
    const frame = await this.run.frame(this.state.frame);
    byId("app").hidden = false;
    this.stage = new Stage(this.run, frame, byId("stage"));
    this.marks = new Marks(this.stage);
    this.panel = new Panel(this);
    this.timeline = new Timeline(this.run, byId("plots"), (index) => this.seek(index));
    this.stage.onDraw = () => this.placeLabels();
    this.connect();
    if (link.pair !== undefined) this.state.pair = link.pair;
    else if (this.run.bodies.length <= 4) this.state.pair = this.mostMeeting(frame);
    Object.assign(this.state, link.state);
    if (link.view !== undefined) this.stage.setView(link.view);
    await this.goTo(this.state.frame);
    document.documentElement.dataset.ready = "true";
  }

  // Where there is most to see.
  busiest() {
    const scores = (i) => [this.run.stat("facet_pairs", i), this.run.head.frames.points[i], this.run.stat("contacts", i)];
    let best = 0;
    for (let i = 1; i < this.run.count; ++i) {
      const more = scores(i), least = scores(best), k = more.findIndex((n, j) => n !== least[j]);
      if (k >= 0 && more[k] > least[k]) best = i;
    }
    return best;
  }

  mostMeeting(frame) {
    const seen = ({ a, b }) => (this.state.opacity[a] > 0 && this.state.opacity[b] > 0 ? 1 : 0);
    const best = [...frame.contacts].sort((x, y) => seen(y) - seen(x) || y.pairs.length - x.pairs.length || y.points.length - x.points.length)[0];
    return best === undefined ? null : [best.a, best.b];
  }

  chosen() {
    if (this.state.pair === null) return null;
    const [a, b] = this.state.pair;
    return this.frame.contacts.find((contact) => contact.a === a && contact.b === b) ?? null;
  }

  /** Shows a frame once it is unpacked; of several that are wanted, the last. */
  async goTo(index) {
    const wanted = (this.wanted = Math.min(Math.max(index, 0), this.run.count - 1));
    let frame;
    try {
      frame = await this.run.frame(wanted);
    } catch (error) {
      this.pause();
      return fail(error.message);
    }
    if (wanted !== this.wanted) return;
    this.frame = frame;
    this.state.frame = wanted;
    this.stage.surface.place(frame, this.stage.center);
    this.stage.thin.place();
    this.showAll();
  }

  seek(index) {
    this.pause();
    this.state.point = null;
    return this.goTo(index);
  }

  showAll() {
    const { state, frame } = this, chosen = this.chosen();
    const contacts = chosen !== null ? [chosen] : frame.contacts;
    const surface = this.stage.surface;
    surface.showOutcomes(contacts);
    if (state.clusters) surface.showClusters(state.frame);
    surface.shared.colouring.value = state.clusters ? 2 : state.show.has("outcomes") ? 1 : 0;
    surface.behind.visible = state.show.has("outcomes") && !state.clusters;
    surface.shared.wire.value = state.wire ? 1 : 0;
    surface.highlight(state.facet, this.facetsBeside(contacts));
    const fades = chosen !== null && state.isolate;
    const opacities = state.opacity.map((opacity, i) =>
      frame.positions[i] === null ? 0 : fades && i !== chosen.a && i !== chosen.b ? Math.min(opacity, OTHERS) : opacity);
    surface.look(this.colors, opacities);
    this.stage.thin.look(this.colors, opacities);
    this.marks.draw(frame, contacts, Object.fromEntries([...state.show].map((key) => [key, true])), chosen, state.point,
      (body) => state.opacity[body] > 0);
    this.makeLabels(chosen);
    this.showPanel();
    this.showTransport();
    this.stage.drawNow();
    this.writeLink();
  }

  showPanel() {
    this.panel.show(this.frame, this.chosen());
  }

  showTransport() {
    const { state, run } = this, step = run.head.frames.step[state.frame], time = run.head.frames.time[state.frame];
    byId("slider").value = state.frame;
    byId("clock").textContent = `step ${step}${time === null ? "" : ` · ${time.toFixed(3)} s`}`;
    byId("clock").dataset.step = step;
    byId("play").setAttribute("aria-pressed", String(state.playing));
    byId("loop").setAttribute("aria-pressed", String(state.loop));
    byId("speed").value = state.speed;
    this.timeline.show(state.frame);
  }

  // The numbers of the facets that one of a body meets in a contact.
  facetsMet(contact, body, facet) {
    const found = [];
    for (let i = 0; i < contact.pairs.length; i += 2) {
      if (contact.a === body && contact.pairs[i] === facet) found.push(contact.pairs[i + 1]);
      if (contact.b === body && contact.pairs[i + 1] === facet) found.push(contact.pairs[i]);
    }
    return found;
  }

  // Over all bodies, those that the picked facet meets.
  facetsBeside(contacts) {
    if (this.state.facet === null) return [];
    const body = this.run.bodyOfFacet(this.state.facet), facet = this.state.facet - this.run.bodies[body].firstFacet;
    return contacts.flatMap((contact) => this.facetsMet(contact, body, facet).map((met) =>
      met + this.run.bodies[contact.a === body ? contact.b : contact.a].firstFacet));
  }

  toggle(key) {
    if (!this.state.show.delete(key)) this.state.show.add(key);
    if (key === "outcomes") this.state.clusters = false;
    this.showAll();
  }

  selectPair(contact) {
    this.state.pair = contact === null ? null : [contact.a, contact.b];
    this.state.point = this.state.facet = null;
    this.showAll();
  }

  selectFacet(body, facet, contact) {
    this.state.facet = this.run.bodies[body].firstFacet + facet;
    this.state.point = null;
    if (contact !== undefined) this.state.pair = [contact.a, contact.b];
    this.showAll();
  }

  selectPoint(contact, number) {
    this.state.pair = [contact.a, contact.b];
    this.state.point = number;
    this.state.open.add("pair-points");
    this.showAll();
  }

  /** What is under a place of the page: a contact point, or a facet and the pair in which it came farthest. */
  pick(x, y) {
    const point = this.marks.pointAt(x, y);
    if (point !== null) return this.selectPoint(point.contact, point.number);
    const facet = this.stage.facetAt(x, y);
    if (facet === null) return this.selectPair(null);
    const body = this.run.bodyOfFacet(facet), number = facet - this.run.bodies[body].firstFacet;
    const meeting = this.frame.contacts.find((contact) => this.facetsMet(contact, body, number).length > 0);
    const chosen = this.chosen();
    const keeps = chosen !== null && (chosen.a === body || chosen.b === body);
    if (meeting === undefined && !keeps) this.state.pair = null;
    this.selectFacet(body, number, meeting);
  }

  nextPair(by) {
    const contacts = this.frame.contacts, now = contacts.indexOf(this.chosen());
    if (contacts.length > 0) this.selectPair(contacts[(now + by + contacts.length) % contacts.length]);
  }

  nearPair() {
    const chosen = this.chosen();
    if (chosen === null) return;
    this.stage.frame(this.marks.centerOf(chosen), this.marks.sizeOf(chosen) * 0.55);
    this.writeLink();
  }

  cycle(body) {
    const next = (OPACITIES.indexOf(this.state.opacity[body]) + 1) % OPACITIES.length;
    this.state.opacity[body] = OPACITIES[next];
    this.showAll();
  }

  setAll(opacity) {
    this.state.opacity.fill(opacity);
    this.showAll();
  }

  play() {
    if (this.state.playing || this.run.count < 2) return;
    this.state.playing = true;
    this.next = performance.now();
    this.showTransport();
    this.tick(true);
  }

  pause() {
    this.state.playing = false;
    this.showTransport();
  }

  // One frame after the other, none left out: where drawing is slow it plays slowly.
  async tick(fromStart = false) {
    if (!this.state.playing) return;
    const last = this.run.count - 1;
    if (this.state.frame === last && !this.state.loop && !fromStart) return this.pause();
    await this.goTo(this.state.frame === last ? 0 : this.state.frame + 1);
    this.next = Math.max(this.next + 1000 / this.state.speed, performance.now());
    setTimeout(() => requestAnimationFrame(() => this.tick()), this.next - performance.now());
  }

  setSpeed(by) {
    const at = SPEEDS.indexOf(this.state.speed) + by;
    this.state.speed = SPEEDS[Math.min(Math.max(at, 0), SPEEDS.length - 1)];
    this.showTransport();
  }

  // Words in the picture: the depth of the pair that is selected, and the gap of a point.
  makeLabels(chosen) {
    this.labels = [];
    if (chosen !== null && !chosen.self && this.state.show.has("direction")) {
      const tip = this.marks.centerOf(chosen).addScaledVector(new THREE.Vector3(...chosen.direction), 0.58 * this.marks.sizeOf(chosen));
      this.labels.push({ place: tip, text: `n, depth ${length(chosen.depth)}` });
    }
    const point = chosen?.points[this.state.point];
    if (point !== undefined) this.labels.push({ place: this.marks.placeOf(chosen.a, point.a), text: `gap ${length(point.gap)}` });
    byId("labels").replaceChildren(...this.labels.map(({ text }) => element("span", {}, text)));
    byId("caption").replaceChildren(...(chosen === null ? [] : [
      element("i", { class: "swatch", style: `background:${css(this.colors[chosen.a])}` }), this.panel.name(chosen.a), " and ",
      element("i", { class: "swatch", style: `background:${css(this.colors[chosen.b])}` }), this.panel.name(chosen.b)]));
  }

  placeLabels() {
    const { left, top } = byId("stage").getBoundingClientRect();
    (this.labels ?? []).forEach(({ place }, i) => {
      const at = this.stage.project(place), label = byId("labels").children[i];
      label.hidden = at === null;
      if (at !== null) label.style.transform = `translate(${at.x - left}px, ${at.y - top}px)`;
    });
  }

  // The state as a link: step, selection, what is shown, and the camera.
  link() {
    const { state, run } = this, parts = [`step=${run.head.frames.step[state.frame]}`];
    parts.push(`pair=${state.pair === null ? "none" : state.pair.join(",")}`);
    if (state.facet !== null) parts.push(`facet=${state.facet}`);
    if (state.point !== null) parts.push(`point=${state.point}`);
    parts.push(`show=${[...state.show, ...(state.clusters ? ["clusters"] : [])].join(",")}`, `view=${this.stage.view().join(",")}`);
    return `#${parts.join("&")}`;
  }

  writeLink() {
    if (!HAS_ADDRESS) return;
    clearTimeout(this.writing);
    this.writing = setTimeout(() => history.replaceState(null, "", this.link()), 200);
  }

  readLink() {
    const given = new URLSearchParams(location.hash.slice(1)), numbers = (key) => given.get(key).split(",").map(Number);
    const link = { state: {} };
    const inside = (n, end) => Number.isInteger(n) && n >= 0 && n < end;
    if (given.has("step")) {
      const frame = this.run.head.frames.step.indexOf(Number(given.get("step")));
      if (frame >= 0) link.frame = frame;
    }
    if (given.get("pair") === "none") link.pair = null;
    else if (given.has("pair") && numbers("pair").length === 2 && numbers("pair").every((n) => inside(n, this.run.bodies.length))) link.pair = numbers("pair");
    if (given.has("facet") && inside(Number(given.get("facet")), this.run.facets)) link.state.facet = Number(given.get("facet"));
    if (given.has("point") && inside(Number(given.get("point")), Infinity)) link.state.point = Number(given.get("point"));
    if (given.has("show")) {
      const keys = given.get("show").split(",");
      link.state.show = new Set(keys.filter((key) => STAGES.some((stage) => stage.key === key)));
      link.state.clusters = keys.includes("clusters");
    }
    if (given.has("view")) link.view = numbers("view");
    return link;
  }

  async copyLink() {
    if (!HAS_ADDRESS) return;
    const button = byId("link"), url = `${location.href.split("#")[0]}${this.link()}`;
    try {
      await navigator.clipboard.writeText(url);
      button.textContent = "copied";
    } catch {
      window.prompt("The link:", url);
    }
    setTimeout(() => (button.textContent = "link"), 1200);
  }

  showKeys() {
    byId("keys").replaceChildren(element("h2", {}, "Keys"),
      element("table", {}, ...KEYS.map(([key, text]) => element("tr", {}, element("th", {}, element("kbd", {}, key)), element("td", {}, text)))),
      element("p", { class: "quiet" }, "Mouse: turn, with the right button move, wheel nearer. A click picks a facet or a contact point, and its pair."));
    byId("keys").showModal();
  }

  key(event) {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.tagName === "SELECT") return false;
    const jump = event.shiftKey ? 10 : 1, stage = STAGES.find((s) => s.digit === event.key);
    if (stage !== undefined) return stage.needs !== undefined && !this.run.head.settings[stage.needs] ? false : (this.toggle(stage.key), true);
    const set = (name) => {
      this.state[name] = !this.state[name];
      this.showAll();
    };
    const actions = {
      " ": () => (this.state.playing ? this.pause() : this.play()),
      ArrowLeft: () => this.seek(this.state.frame - jump), ArrowRight: () => this.seek(this.state.frame + jump),
      Home: () => this.seek(0), End: () => this.seek(this.run.count - 1),
      n: () => this.nextPair(1), p: () => this.nextPair(-1), f: () => this.nearPair(),
      h: () => { this.stage.home(); this.stage.draw(); },
      i: () => set("isolate"), w: () => set("wire"), k: () => set("clusters"), l: () => set("loop"),
      "+": () => this.setSpeed(1), "=": () => this.setSpeed(1), "-": () => this.setSpeed(-1),
      c: () => this.copyLink(), "?": () => this.showKeys(), Escape: () => this.selectPair(null),
    };
    const action = actions[event.key.length === 1 ? event.key.toLowerCase() : event.key];
    action?.();
    return action !== undefined;
  }

  connect() {
    const on = (id, action) => byId(id).addEventListener("click", action);
    on("first", () => this.seek(0));
    on("back", () => this.seek(this.state.frame - 1));
    on("play", () => (this.state.playing ? this.pause() : this.play()));
    on("forth", () => this.seek(this.state.frame + 1));
    on("last", () => this.seek(this.run.count - 1));
    on("loop", () => { this.state.loop = !this.state.loop; this.showTransport(); });
    byId("link").hidden = !HAS_ADDRESS;
    on("link", () => this.copyLink());
    on("help", () => this.showKeys());
    on("keys", (event) => event.target === byId("keys") && byId("keys").close());
    byId("slider").max = this.run.count - 1;
    byId("slider").addEventListener("input", (event) => this.seek(Number(event.target.value)));
    byId("speed").append(...SPEEDS.map((speed) => element("option", { value: speed }, `${speed} fps`)));
    byId("speed").addEventListener("change", (event) => (this.state.speed = Number(event.target.value)));
    window.addEventListener("keydown", (event) => {
      if (!byId("keys").open && this.key(event)) event.preventDefault();
    });
    window.addEventListener("hashchange", () => this.follow());
    const canvas = this.stage.renderer.domElement;
    let down = null;
    canvas.addEventListener("pointerdown", (event) => (down = { x: event.clientX, y: event.clientY }));
    canvas.addEventListener("pointerup", (event) => {
      const still = down !== null && Math.hypot(event.clientX - down.x, event.clientY - down.y) < 4;
      if (still && event.button === 0) this.pick(event.clientX, event.clientY);
      down = null;
    });
    this.stage.controls.addEventListener("end", () => this.writeLink());
  }

  // The address was changed by hand.
  follow() {
    const link = this.readLink();
    if (link.pair !== undefined) this.state.pair = link.pair;
    Object.assign(this.state, link.state);
    if (link.view !== undefined) this.stage.setView(link.view);
    return this.goTo(link.frame ?? this.state.frame);
  }
}

window.addEventListener("error", (event) => fail(`The page failed: ${event.message}`));
window.addEventListener("unhandledrejection", (event) => fail(`The page failed: ${event.reason?.message ?? event.reason}`));

try {
  const run = await Run.open();
  document.title = `${visible(run.head.title)} – tact`;
  window.tactView = new App(run); // for people at the console, and for the tests
  await window.tactView.start();
} catch (error) {
  fail(error instanceof DataError ? error.message : `The page cannot be shown: ${error.message}`);
}
