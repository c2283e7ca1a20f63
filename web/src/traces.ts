/** The paper's five traces, in its three panels, with theory's steady values. */
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import { colour } from "./element.js";
import type { Traces } from "./engine.js";
import type { Steady } from "./steady.js";

/** What a panel shows: name and unit, the factor from SI units, traces by what the legend calls them. */
export const PANELS = [
  { name: "Acceleration (m/s²)", factor: 1, of: { car: "a_car", trailer: "a_trailer" }, steady: "A" },
  { name: "Compression (mm)", factor: 1000, of: { drawbar: "compression" }, steady: "D" },
  { name: "Slip (%)", factor: 100, of: { car: "slip_car", trailer: "slip_trailer" }, steady: null },
] as const;

/** Dark and solid against mid-tone and dashed: told apart in greyscale. By the legend's names. */
export const DASHES: Record<string, number[]> = { car: [], drawbar: [], trailer: [7, 3], steady: [2, 4] };

/** Columns of a panel: the traces, then the steady value, in the panel's unit. */
export function columns(panel: (typeof PANELS)[number], traces: Traces, steady: Steady): Float64Array[] {
  const found = Object.values(panel.of).map((name) => traces[name].map((value) => value * panel.factor));
  const level = panel.steady && steady[panel.steady] * panel.factor;
  return level === null ? found : [...found, traces.time.map(() => level)];
}

/** Draws the panels in `parent`; what comes back draws others, and the time (s) at which the drawing is. */
export function makeTraces(parent: HTMLElement) {
  const panels = PANELS.map((panel) => {
    const names = [...Object.keys(panel.of), ...(panel.steady ? ["steady"] : [])];
    const place = parent.appendChild(document.createElement("div"));
    const plot = new uPlot(options(panel.name, names, parent.clientWidth), [[], ...names.map(() => [])], place);
    const line = plot.over.appendChild(document.createElement("div"));
    line.className = "now";
    return { panel, plot, line };
  });
  new ResizeObserver(() => {
    panels.forEach(({ plot }) => plot.setSize({ width: parent.clientWidth, height: plot.height }));
  }).observe(parent);
  const dark = matchMedia("(prefers-color-scheme: dark)");
  dark.addEventListener("change", () => panels.forEach(({ plot }) => plot.redraw()));
  return {
    show(traces: Traces, steady: Steady) {
      panels.forEach(({ panel, plot }) => plot.setData([traces.time, ...columns(panel, traces, steady)]));
    },
    at(time: number) {
      panels.forEach(({ plot, line }) => (line.style.translate = `${plot.valToPos(time, "x")}px`));
    },
  };
}

function options(name: string, names: string[], width: number): uPlot.Options {
  const grid = { stroke: () => colour("--line"), width: 1 };
  const axis = { stroke: () => colour("--soft"), grid, ticks: { show: false } };
  const series = names.map((label) => ({
    label,
    stroke: () => colour(`--${label}`),
    width: label === "steady" ? 1.5 : 2,
    dash: DASHES[label]!,
    points: { show: false },
    value: (_: uPlot, value: number | null) => (Number.isFinite(value) ? value!.toPrecision(4) : "–"),
  }));
  return {
    width,
    height: 190,
    legend: {
      markers: {
        width: 3,
        stroke: (_, i) => `var(--${names[i - 1]})`,
        dash: (_, i) => (series[i - 1]?.dash.length ? "dashed" : "solid"),
      },
    },
    cursor: { sync: { key: "time" }, drag: { x: false, y: false } },
    scales: { x: { time: false } },
    series: [{ label: "time (s)", value: (_, value) => (value === null ? "–" : value.toFixed(2)) }, ...series],
    axes: [{ ...axis, size: 30 }, { ...axis, label: name, size: 52, labelSize: 24 }],
  };
}
