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

const axes = (stem: "H_I" | "H_B" | "omega"): Plot["series"] =>
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
  { title: "H_B, body [N m s]", series: axes("H_B") },
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

const kHeight_px = 128;
const kBuckets = 300;

export class Plots {
  private charts: uPlot[] = [];
  private window_s = 60;

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

  draw(): void {
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
          space: 26,
          values: plot.exponent ? (_, ticks) => ticks.map((tick) => small(tick)) : undefined,
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
