// The parts of a beat against their budgets: how often each took how long, with its quantiles, on a logarithmic axis; and the numbers.

import { make, say } from "./dom";
import { counted, microseconds } from "./format";
import type { Phase, Service, Timing } from "./frame";

const kParts = [
  ["wake-up lateness", "wake_up_lateness"],
  ["commands", "command_phase"],
  ["step", "step_phase"],
  ["hand-over", "hand_over_phase"],
] as const;
const kQuantiles = [
  ["p50", "p50_ns", "circle"],
  ["p99", "p99_ns", "square"],
  ["p99.9", "p99_9_ns", "diamond"],
  ["max", "max_ns", "triangle"],
] as const;

const kLeft = 108, kRight = 14, kRow = 30, kTop = 8; // prettier-ignore
const kHeight = kTop + 4 * kRow + 22;
const kLeast_ns = 100, kMost_ns = 1e9; // prettier-ignore

const kSvg = "http://www.w3.org/2000/svg";
function svg(tag: string, attributes: Record<string, string | number>, text?: string): SVGElement {
  const element = document.createElementNS(kSvg, tag);
  for (const [name, value] of Object.entries(attributes)) {
    element.setAttribute(name, String(value));
  }
  if (text !== undefined) {
    element.textContent = text;
  }
  return element;
}

/// Where a duration stands in a picture of that width.
function place_of(ns: number, width: number): number {
  const part = Math.log10(Math.min(Math.max(ns, kLeast_ns), kMost_ns) / kLeast_ns) / Math.log10(kMost_ns / kLeast_ns);
  return kLeft + part * (width - kLeft - kRight);
}

const kShapes = {
  circle: "M-4,0a4,4 0 1,0 8,0a4,4 0 1,0 -8,0Z",
  square: "M-4,-4h8v8h-8Z",
  diamond: "M0,-5.5L5.5,0L0,5.5L-5.5,0Z",
  triangle: "M0,-5L5,4H-5Z",
};

export class TimingChart {
  private shownStep = -1;
  private shown: Timing | undefined;
  private width = 560;
  private readonly picture: SVGElement;
  private readonly body: HTMLElement;
  private readonly note = make("p", { class: "quiet" });

  constructor(place: HTMLElement) {
    this.picture = svg("svg", { height: kHeight, role: "img", "aria-label": "How often each part of the beat took how long, and its quantiles, against its budget; the table has the numbers" });
    this.body = make("tbody");
    const heads = ["part of a beat [µs]", ...kQuantiles.map(([name]) => name), "budget", "over"];
    const table = make("table", { class: "numbers" },
      make("thead", {}, make("tr", {}, ...heads.map((text) => make("th", { scope: "col", text })))), this.body); // prettier-ignore
    const legend = make("ul", { class: "legend" });
    for (const [name, , shape] of kQuantiles) {
      const icon = svg("svg", { viewBox: "-6 -6 12 12", width: 12, height: 12, "aria-hidden": "true" });
      icon.append(svg("path", { d: kShapes[shape], class: `quantile ${shape}` }));
      legend.append(make("li", {}, icon, document.createTextNode(` ${name}`)));
    }
    const icon = svg("svg", { viewBox: "-6 -6 12 12", width: 12, height: 12, "aria-hidden": "true" });
    icon.append(svg("path", { d: "M0,-6V6", class: "budget" }));
    legend.append(make("li", {}, icon, document.createTextNode(" budget")));
    const bar = svg("svg", { viewBox: "-6 -6 12 12", width: 12, height: 12, "aria-hidden": "true" });
    bar.append(svg("path", { d: "M-5,6V-2H0V-6H5V6Z", class: "often" }));
    legend.append(make("li", {}, bar, document.createTextNode(" beats, logarithmic")));
    place.append(this.picture, legend, make("div", { class: "scroll", tabindex: "0", role: "region", "aria-label": "Timing in numbers" }, table), this.note); // prettier-ignore
    new ResizeObserver(() => {
      this.width = Math.max(260, Math.min(640, place.clientWidth));
      if (this.shown !== undefined) {
        this.draw(this.shown);
      }
    }).observe(place);
  }

  show(service: Service | undefined): void {
    const timing = service?.timing;
    if (timing === undefined || timing.step === this.shownStep) {
      return;
    }
    this.shownStep = timing.step;
    this.shown = timing;
    this.draw(timing);
    this.body.replaceChildren(...kParts.map(([name, key]) => row(name, timing[key])));
    const yes = (fact: boolean, what: string) => `${what} ${fact ? "yes" : "NO"}`;
    say(this.note,
      `Beats late: ${counted(timing.late_beats)} (${counted(timing.late_after_work)} after our own work, ` +
      `${counted(timing.late_after_loss)} after the processor was taken away, ` +
      `${counted(timing.late_after_sleep)} after the sleep); missed: ${counted(timing.missed_beats)}; ` +
      `caught up: ${counted(timing.caught_up_beats)}; longer than the period: ${counted(timing.overruns)}; ` +
      `${(timing.behind_wall_ns / 1e6).toFixed(1)} ms behind the wall clock. In force: ` +
      [yes(timing.fifo_scheduling, "FIFO"), yes(timing.memory_locked, "memory lock"), yes(timing.cpu_pinned, "one processor")].join(", ") + "."); // prettier-ignore
  }

  private draw(timing: Timing): void {
    const bottom = kTop + kParts.length * kRow;
    const x = (ns: number) => place_of(ns, this.width);
    const narrow = this.width < 420;
    this.picture.setAttribute("width", String(this.width));
    const parts: SVGElement[] = [];
    for (let ns = kLeast_ns; ns <= kMost_ns; ns *= 10) {
      parts.push(svg("path", { d: `M${x(ns)},${kTop}V${bottom}`, class: "grid" }));
      if (narrow && Math.round(Math.log10(ns)) % 2 === 0) {
        continue;
      }
      const text = ns < 1e6 ? `${ns / 1e3}µs` : ns < 1e9 ? `${ns / 1e6}ms` : "1s";
      parts.push(svg("text", { x: x(ns), y: bottom + 16, "text-anchor": ns === kMost_ns ? "end" : "middle" }, text));
    }
    kParts.forEach(([name, key], i) => {
      const phase = timing[key];
      const y = kTop + (i + 0.5) * kRow;
      parts.push(svg("text", { x: 0, y: y + 4 }, name));
      if (phase.count === 0) {
        return;
      }
      parts.push(svg("path", { d: columns(phase.quarter_octaves, x, y + kRow / 2 - 2), class: "often" }));
      parts.push(svg("path", { d: `M${x(phase.p50_ns)},${y}H${x(phase.max_ns)}`, class: "range" }));
      if (phase.budget_ns > 0) {
        const over = phase.p99_9_ns > phase.budget_ns ? " exceeded" : "";
        parts.push(svg("path", { d: `M${x(phase.budget_ns)},${y - 11}v22`, class: `budget${over}` }));
      }
      for (const [, quantile, shape] of kQuantiles) {
        parts.push(svg("path", { d: kShapes[shape], class: `quantile ${shape}`, transform: `translate(${x(phase[quantile])},${y})` }));
      }
    });
    this.picture.replaceChildren(...parts);
  }
}

/// What the times of a count are below: four an octave from 2^8 ns on, as the daemon counts them.
function edge_ns(i: number): number {
  return [32, 38, 45, 54][i % 4]! * 2 ** (3 + Math.floor(i / 4));
}

/// A column a quarter of an octave, standing on `foot`: as high as the logarithm of how many beats it has, so that a single late one is seen.
function columns(counts: number[], x: (ns: number) => number, foot: number): string {
  const height = (count: number) => ((kRow - 4) * Math.log10(1 + count)) / Math.log10(1 + Math.max(...counts));
  return counts
    .map((count, i) => {
      const [from, to] = [x(i === 0 ? kLeast_ns : edge_ns(i - 1)), x(edge_ns(i))];
      return count === 0 ? "" : `M${from},${foot}v${-height(count)}H${Math.max(to, from + 2)}V${foot}Z`;
    })
    .join("");
}

function row(name: string, phase: Phase): HTMLElement {
  const cells = kQuantiles.map(([, key]) => make("td", { text: microseconds(phase[key]) }));
  const over = make("td", { text: counted(phase.over_budget) });
  if (phase.over_budget > 0) {
    over.className = "warn";
  }
  return make("tr", {}, make("th", { scope: "row", text: name }), ...cells,
    make("td", { text: phase.budget_ns === 0 ? "–" : microseconds(phase.budget_ns) }), over); // prettier-ignore
}
