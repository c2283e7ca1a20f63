/** The live page: knobs, a run of the unit at each of their values, what theory says of them. */
import uPlot from "uplot";
import "uplot/dist/uPlot.min.css";
import json from "unit.json";
import bytes from "unit.wasm";
import { brake } from "./engine.js";
import { makeKnobs, type Values } from "./knobs.js";
import "./live.css";
import { shuntingMode, type LinearParameters } from "./linear.js";
import { Unit, type Description } from "./unit.js";

const description = json as Description;
const MILLIMETRES = 1000; // in a metre
const AT_FIRST: Values = { brake_torque: 1000 }; // N.m, the paper's; all else as the unit starts

function place(id: string): HTMLElement {
  return document.getElementById(id)!;
}

function colour(name: string): string {
  return getComputedStyle(document.documentElement).getPropertyValue(name);
}

/** The values that a link carries after its #, as C=500&k=5480. */
function linked(): Values {
  const pairs = [...new URLSearchParams(location.hash.slice(1))];
  return Object.fromEntries(pairs.map(([name, value]) => [name, Number(value)]));
}

function chart(parent: HTMLElement): uPlot {
  const grid = { stroke: () => colour("--line"), width: 1 };
  const axis = { stroke: () => colour("--soft"), grid, ticks: { show: false } };
  const compression = { label: "compression (mm)", stroke: () => colour("--trace"), width: 2, pxAlign: 0 };
  const options: uPlot.Options = {
    width: parent.clientWidth,
    height: parent.clientHeight,
    legend: { show: false },
    scales: { x: { time: false } },
    series: [{ label: "time (s)" }, compression],
    axes: [
      { ...axis, label: "time (s)" },
      { ...axis, label: "compression (mm)", size: 60 },
    ],
  };
  const plot = new uPlot(options, [[], []], parent);
  new ResizeObserver(() => plot.setSize({ width: parent.clientWidth, height: parent.clientHeight })).observe(parent);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", () => plot.redraw());
  return plot;
}

/** Linear theory at the start's speed: growth rate, frequency, damping ratio; silence where there is clearance. */
function showTheory(values: Values): void {
  const silent = values["eps"]! > 0;
  place("clearance").hidden = !silent;
  place("theory").hidden = silent;
  if (silent) {
    return;
  }
  const starts = Object.entries(description.variables).map(([name, { start }]) => [name, start]);
  const all = { ...Object.fromEntries(starts), ...values } as unknown as LinearParameters & { V_0: number };
  const { re, im } = shuntingMode(all, all.V_0);
  place("growth").textContent = re.toFixed(3);
  place("frequency").textContent = im > 0 ? (im / (2 * Math.PI)).toFixed(3) : "creeps";
  place("damping").textContent = (-re / Math.hypot(re, im)).toFixed(4);
  place("verdict").textContent = `By linear theory shunting ${re > 0 ? "grows" : "dies out"}.`;
}

function main(): void {
  // At once, before the page counts as loaded: browsers allow that up to megabytes, and it takes milliseconds.
  const unit = new Unit(new WebAssembly.Module(bytes), description);
  const plot = chart(place("chart"));
  const show = (values: Values): void => {
    const alert = place("alert");
    try {
      const { time, compression } = brake(unit, values);
      const millimetres = compression!.map((metres) => metres * MILLIMETRES);
      plot.setData([time!, millimetres]);
      place("largest").textContent = Math.max(...millimetres).toFixed(3);
      place("last").textContent = millimetres.at(-1)!.toFixed(3);
      showTheory(values);
      const pairs = Object.entries(values).map(([name, value]) => [name, String(value)]);
      history.replaceState(null, "", `#${new URLSearchParams(pairs)}`);
      alert.textContent = "";
    } catch (error) {
      alert.textContent = (error as Error).message; // what is drawn stays
    }
  };
  show(makeKnobs(place("knobs"), description, { ...AT_FIRST, ...linked() }, show));
}

main();
