// The scrolling plots.

import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";

import { make } from "./dom";
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

const kHeight_px = 132;
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
          chart.setScale("x", { min: latest - this.window_s, max: latest });
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
      this.place.append(make("h3", { text: plot.title }), holder);
      return new uPlot(this.options(plot), [[]], holder);
    });
    this.draw();
  }

  private options(plot: Plot): uPlot.Options {
    const line = { stroke: colour("quiet"), grid: { stroke: colour("grid"), width: 1 }, ticks: { show: false } }; // prettier-ignore
    const show = plot.exponent ? small : (value: number) => fixed(value, 4);
    return {
      width: this.width(),
      height: kHeight_px,
      pxAlign: false,
      cursor: { y: false, drag: { x: false, y: false }, points: { show: false } },
      legend: { live: true },
      scales: { x: { time: false }, y: { range: plot.exponent ? undefined : roomy } },
      axes: [
        { ...line, size: 22, font: "11px system-ui, sans-serif", gap: 2 },
        {
          ...line,
          size: 62,
          font: "11px system-ui, sans-serif",
          gap: 4,
          values: plot.exponent ? (_, ticks) => ticks.map((tick) => small(tick)) : undefined,
        },
      ],
      series: [
        { label: "t [s]", value: (_, value) => (value === null ? "–" : value.toFixed(1)) },
        ...plot.series.map((series) => ({
          label: series.label,
          stroke: colour(series.colour),
          dash: series.dash,
          width: 1.5,
          points: { show: false },
          value: (_: uPlot, value: number | null) => (value === null ? "–" : show(value)),
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
