// The plots over time and the controls under them.
import uPlot from "uplot";
import { length } from "./dom.js";

/** The parts of a step's time: which columns of the statistics each is, its name and its colour. */
export const TIMES = [
  [["refresh_ms"], "refresh", "#5b8def"],
  [["sweep_ms"], "boxes", "#4fb0c6"],
  [["hulls_ms"], "hulls", "#62c08b"],
  [["direction_ms"], "direction", "#e2c44d"],
  [["cull_ms"], "cull", "#f09a3e"],
  [["confirm_ms"], "confirm", "#ef5a4b"],
  [["containment_ms"], "inside", "#8d6e63"],
  [["points_ms"], "points", "#ff7ac8"],
  [["self_facets_ms", "self_points_ms"], "self-contact", "#b04fd0"],
  [["patches_ms"], "patches", "#9ccc65"],
  [["report_ms"], "report", "#a77fd6"],
];
const AXIS = { stroke: "#93a0b8", grid: { stroke: "#262e40", width: 1 }, ticks: { stroke: "#262e40", width: 1, size: 4 }, font: "11px system-ui" };

function options(title, series, extra = {}) {
  return {
    width: 300,
    height: 112,
    title,
    legend: { show: false },
    cursor: { drag: { x: false, y: false }, points: { show: false } },
    scales: { x: { time: false }, ...extra.scales },
    axes: [{ ...AXIS, size: 26 }, { ...AXIS, size: 46 }, ...(extra.axes ?? [])],
    series: [{}, ...series.map((one) => ({ ...one, points: { show: false } }))],
    padding: [2, 10, 0, 0],
    hooks: extra.hooks,
  };
}

function compact(n) {
  return n >= 1e6 ? `${n / 1e6}M` : n >= 1e4 ? `${n / 1e3}k` : `${n}`;
}

// Zero is always in it; null: no step has a point.
function gapRange(min, max) {
  if (min === null) return [0, 1];
  const low = Math.min(0, min), high = Math.max(0, max), room = 0.08 * (high - low) || 1e-3;
  return [low - room, high + room];
}

export class Timeline {
  /** `seek(frame)` is called when a plot is clicked. */
  constructor(run, element, seek) {
    this.run = run;
    this.element = element;
    this.now = 0;
    const steps = run.head.frames.step;
    const marker = { draw: [(plot) => this.drawMarker(plot)] };
    // What a run has of: its name, its colour, which scale it is drawn on, and its values.
    const found = [
      ["facet pairs", "#fa5a4a", "y", run.columns.get("facet_pairs").values],
      ...(run.head.settings.points ? [["contact points", "#ffc24d", "y", run.head.frames.points], ["least gap", "#7fd3ff", "gap", run.head.frames.least_gap]] : []),
    ];
    const counts = options("", found.map(([label, stroke, scale]) => ({ label, stroke, scale, fill: scale === "y" ? `${stroke}22` : undefined, width: 1.5 })), {
      scales: { y: { range: (u, min, max) => [0, Math.max(1, max * 1.1)] }, gap: { range: (u, min, max) => gapRange(min, max) } },
      axes: [{ ...AXIS, size: 56, side: 1, scale: "gap", grid: { show: false }, values: (u, v) => v.map(length) }],
      hooks: marker,
    });
    counts.axes[1].values = (u, v) => v.map(compact);
    const stacked = this.stack(steps.length);
    // A first step that groups facets, or one that the machine was busy in, would flatten all others.
    const sums = [...stacked.at(-1)].sort((x, y) => x - y), usual = 4 * sums[Math.floor(0.9 * (sums.length - 1))];
    const most = Math.min(sums.at(-1) * 1.1, usual > 0 ? usual : Infinity), cut = sums.at(-1) > most;
    const times = options("", TIMES.map(([, label, color]) => ({ label, stroke: color, fill: `${color}66`, width: 1 })).reverse(),
      { scales: { y: { range: () => [0, Math.max(1e-3, most)] } }, hooks: marker });
    this.plots = [
      this.add(found.map(([label, color]) => `${label} <i style='--c:${color}'></i>`).join(", "), counts, [steps, ...found.map((one) => one[3])], seek),
      this.add(`ms${cut ? ", the highest cut off" : ""}: ${TIMES.map(([, label, color]) => `<i style='--c:${color}'></i> ${label}`).join(" ")}`, times,
        [steps, ...stacked.reverse()], seek, "Milliseconds of a step. Hulls, direction, cull and confirm are summed over threads."),
    ];
    new ResizeObserver(() => this.resize()).observe(element);
    this.resize();
  }

  // Sums up to each stage, so that filled curves lie over each other.
  stack(length) {
    let sum = new Array(length).fill(0);
    return TIMES.map(([names]) => (sum = sum.map((ms, i) => names.reduce((all, name) => all + this.run.columns.get(name).values[i], ms))));
  }

  add(title, opts, data, seek, more = "") {
    const box = document.createElement("div"), label = document.createElement("div");
    box.className = "plot";
    label.className = "plot-title";
    label.innerHTML = title; // the page's own words
    label.title = `${label.textContent.replace(/\s+/g, " ")}. ${more}`.trim();
    box.append(label);
    this.element.append(box);
    const plot = new uPlot(opts, data, box);
    const go = (event) => {
      const { left, width } = plot.over.getBoundingClientRect();
      const step = plot.posToVal(Math.min(Math.max(event.clientX - left, 0), width), "x");
      seek(this.nearest(step));
    };
    plot.over.addEventListener("pointerdown", (event) => {
      plot.over.setPointerCapture(event.pointerId);
      go(event);
    });
    plot.over.addEventListener("pointermove", (event) => event.buttons === 1 && go(event));
    return { box, plot };
  }

  nearest(step) {
    const steps = this.run.head.frames.step;
    let best = 0;
    steps.forEach((s, i) => Math.abs(s - step) < Math.abs(steps[best] - step) && (best = i));
    return best;
  }

  drawMarker(plot) {
    const x = Math.round(plot.valToPos(this.run.head.frames.step[this.now], "x", true)), { ctx, bbox } = plot;
    ctx.save();
    ctx.strokeStyle = "#ffffff";
    ctx.lineWidth = Math.max(1, window.devicePixelRatio);
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    ctx.restore();
  }

  show(frame) {
    this.now = frame;
    for (const { plot } of this.plots) plot.redraw(false, false);
  }

  resize() {
    for (const { box, plot } of this.plots) {
      const width = box.clientWidth;
      if (width > 0) plot.setSize({ width, height: 112 });
    }
  }
}
