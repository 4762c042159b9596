// The scrolling plots.

import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";

import { make, say } from "./dom";
import { fixed, small } from "./format";
import type { ColumnName, History } from "./history";
import { colour, kDash, onThemeChange } from "./theme";

interface Plot {
  title: string;
  series: { column: ColumnName; label: string; colour: string; dash: number[] }[];
  exponent?: boolean;
}

const axes = (stem: "H_I" | "Pi_B" | "omega"): Plot["series"] =>
  (["x", "y", "z"] as const).map((axis) => ({
    column: `${stem}_${axis}`,
    label: axis,
    colour: axis,
    dash: kDash[axis],
  }));

const one = (column: ColumnName, label: string): Plot["series"] => [
  { column, label, colour: "momentum", dash: [] },
];

const kPlots: Plot[] = [
  { title: "H_I, inertial [N m s]", series: axes("H_I") },
  { title: "Pi_B, body [N m s]", series: axes("Pi_B") },
  { title: "omega_B [rad/s]", series: axes("omega") },
  {
    title: "energy residual E − E_0 − W [J]",
    series: one("energy_residual", "residual"),
    exponent: true,
  },
  {
    title: "momentum residual |H_I − H_0 − impulse| [N m s]",
    series: one("momentum_residual", "residual"),
    exponent: true,
  },
];

const kHeight_px = 146;
const kBuckets = 300;

export class Plots {
  private charts: uPlot[] = [];
  private window_s = 60;
  private drawn_ms = -Infinity;

  constructor(
    private readonly place: HTMLElement,
    private readonly history: History,
  ) {
    this.build();
    onThemeChange(() => this.build());
    new ResizeObserver(() => {
      for (const chart of this.charts) {
        chart.setSize({ width: this.width(), height: kHeight_px });
      }
    }).observe(place);
  }

  show(window_s: number): void {
    this.window_s = window_s;
    this.draw();
  }

  /// No oftener than the picture moves by about a pixel.
  drawIfDue(): void {
    if (performance.now() - this.drawn_ms >= Math.min(2000, this.window_s)) {
      this.draw();
    }
  }

  private draw(): void {
    this.drawn_ms = performance.now();
    const latest = this.history.latest();
    kPlots.forEach((plot, i) => {
      const names = plot.series.map((series) => series.column);
      const data = this.history.decimated(names, this.window_s, kBuckets);
      const chart = this.charts[i]!;
      chart.batch(() => {
        chart.setData(data as uPlot.AlignedData, false);
        if (Number.isFinite(latest)) {
          const min = Math.max(latest - this.window_s, Math.min(this.history.earliest(), latest - 5));
          chart.setScale("x", { min, max: latest });
        }
      });
    });
  }

  private width(): number {
    return Math.max(200, this.place.clientWidth);
  }

  private build(): void {
    for (const chart of this.charts) {
      chart.destroy();
    }
    this.place.replaceChildren();
    this.charts = kPlots.map((plot) => {
      const holder = make("div", { class: "plot", role: "img", "aria-label": plot.title });
      const under = make("span", { class: "quiet mono" });
      this.place.append(make("div", { class: "row" }, make("h3", { text: plot.title }), under), holder);
      return new uPlot(this.options(plot, under), [[]], holder);
    });
    this.draw();
  }

  /// What is under the pointer is said in `under`.
  private options(plot: Plot, under: HTMLElement): uPlot.Options {
    const line = { stroke: colour("quiet"), grid: { stroke: colour("grid"), width: 1 }, ticks: { show: false } }; // prettier-ignore
    const show = plot.exponent ? small : (value: number) => fixed(value, 4);
    return {
      width: this.width(),
      height: kHeight_px,
      pxAlign: false,
      cursor: { y: false, drag: { x: false, y: false }, points: { show: false } },
      legend: { show: false },
      hooks: {
        setCursor: [
          (chart: uPlot) => {
            const i = chart.cursor.idx;
            const at = (s: number) => (i == null ? null : (chart.data[s]?.[i] ?? null));
            const values = plot.series.map((series, s) => `${series.label} ${show(at(s + 1) ?? NaN)}`);
            say(under, i == null || at(0) === null ? "" : `t ${at(0)!.toFixed(1)} s: ${values.join(", ")}`);
          },
        ],
      },
      scales: { x: { time: false }, y: { range: plot.exponent ? around : roomy } },
      axes: [
        { ...line, size: 22, font: "11px system-ui, sans-serif", gap: 2 },
        {
          ...line,
          size: 62,
          font: "11px system-ui, sans-serif",
          gap: 4,
          splits: (_chart: uPlot, _axis: number, least: number, greatest: number) => ticks(least, greatest),
          values: (_chart: uPlot, at: number[]) => labels(at, plot.exponent === true),
        },
      ],
      series: [
        {},
        ...plot.series.map((series) => ({
          label: series.label,
          stroke: colour(series.colour),
          dash: series.dash,
          width: 1.5,
          points: { show: false },
        })),
      ],
    } as uPlot.Options;
  }
}

/// What is constant stays in the middle instead of filling the height with rounding.
function roomy(_: uPlot, least: number | null, greatest: number | null): [number, number] {
  if (least === null || greatest === null) {
    return [-1, 1];
  }
  const middle = (least + greatest) / 2;
  const half = Math.max((greatest - least) * 0.6, Math.abs(middle) * 1e-3, 1e-12);
  return [middle - half, middle + half];
}

/// Residuals: as they are, around a constant one.
function around(_: uPlot, least: number | null, greatest: number | null): [number, number] {
  if (least === null || greatest === null) {
    return [-1e-16, 1e-16];
  }
  const half = Math.max((greatest - least) * 0.6, Math.abs(greatest) * 0.2, 1e-18);
  return [(least + greatest) / 2 - half, (least + greatest) / 2 + half];
}

/// Three or so round numbers, however small: uPlot's own stop at 1e-16.
function ticks(least: number, greatest: number): number[] {
  const rough = (greatest - least) / 3;
  const power = 10 ** Math.floor(Math.log10(rough));
  const step = [1, 2, 5, 10].map((digit) => digit * power).find((candidate) => candidate >= rough)!;
  const result = [];
  for (let k = Math.ceil(least / step); k * step <= greatest; ++k) {
    result.push(k * step);
  }
  return result;
}

function labels(at: number[], exponent: boolean): string[] {
  const step = at.length > 1 ? at[1]! - at[0]! : 1;
  const digits = Math.max(0, Math.min(9, -Math.floor(Math.log10(step) + 1e-9)));
  return at.map((tick) => (exponent ? small(Math.abs(tick) < step / 2 ? 0 : tick) : fixed(Math.abs(tick) < step / 2 ? 0 : tick, digits)));
}
