// The plots over time and the controls under them.
import uPlot from "uplot";

const STAGES = [
  ["refresh_ms", "refresh", "#5b8def"],
  ["sweep_ms", "boxes", "#4fb0c6"],
  ["hulls_ms", "hulls", "#62c08b"],
  ["direction_ms", "direction", "#e2c44d"],
  ["cull_ms", "cull", "#f09a3e"],
  ["confirm_ms", "confirm", "#ef5a4b"],
  ["report_ms", "report", "#a77fd6"],
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

export class Timeline {
  /** `seek(frame)` is called when a plot is clicked. */
  constructor(run, element, seek) {
    this.run = run;
    this.element = element;
    this.now = 0;
    const steps = run.head.frames.step;
    const marker = { draw: [(plot) => this.drawMarker(plot)] };
    const counts = options("", [
      { label: "facet pairs", stroke: "#fa5a4a", fill: "#fa5a4a22", width: 1.5, scale: "y" },
      { label: "touching contacts", stroke: "#ffc24d", width: 1.5, scale: "contacts" },
    ], {
      scales: { contacts: { range: (u, min, max) => [0, Math.max(1, max * 1.15)] }, y: { range: (u, min, max) => [0, Math.max(1, max * 1.1)] } },
      axes: [{ ...AXIS, size: 40, side: 1, scale: "contacts", grid: { show: false }, values: (u, v) => v.map(compact) }],
      hooks: marker,
    });
    counts.axes[1].values = (u, v) => v.map(compact);
    const stacked = this.stack(steps.length);
    // A first step that groups facets, or one that the machine was busy in, would flatten all others.
    const sums = [...stacked.at(-1)].sort((x, y) => x - y), usual = 4 * sums[Math.floor(0.9 * (sums.length - 1))];
    const most = Math.min(sums.at(-1) * 1.1, usual > 0 ? usual : Infinity), cut = sums.at(-1) > most;
    const times = options("", STAGES.map(([, label, color]) => ({ label, stroke: color, fill: `${color}66`, width: 1 })).reverse(),
      { scales: { y: { range: () => [0, Math.max(1e-3, most)] } }, hooks: marker });
    this.plots = [
      this.add("facet pairs <i style='--c:#fa5a4a'></i>, touching contacts <i style='--c:#ffc24d'></i>", counts,
        [steps, run.columns.get("facet_pairs").values, run.columns.get("touching_contacts").values], seek),
      this.add(`milliseconds a stage${cut ? ", the highest cut off" : ""}: ${STAGES.map(([, label, color]) => `<i style='--c:${color}'></i> ${label}`).join(" ")}`, times,
        [steps, ...stacked.reverse()], seek),
    ];
    new ResizeObserver(() => this.resize()).observe(element);
    this.resize();
  }

  // Sums up to each stage, so that filled curves lie over each other.
  stack(length) {
    let sum = new Array(length).fill(0);
    return STAGES.map(([name]) => (sum = this.run.columns.get(name).values.map((ms, i) => sum[i] + ms)));
  }

  add(title, opts, data, seek) {
    const box = document.createElement("div"), label = document.createElement("div");
    box.className = "plot";
    label.className = "plot-title";
    label.innerHTML = title; // the page's own words
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
