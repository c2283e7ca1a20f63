/** A map of two knobs, computed by the worker; a click or an arrow key takes its values. */
import * as Plot from "@observablehq/plot";
import worker from "worker.js";
import type { Request, Row } from "./cell.js";
import { place } from "./element.js";
import { SPANS } from "./knobs.js";
import { picked, type Values } from "./paper.js";
import type { Metric, State } from "./state.js";
import type { Description } from "./unit.js";

const [ACROSS, UP] = [30, 20]; // cells
const CORNERS = { x1: "x1", x2: "x2", y1: "y1", y2: "y2" };
const DOT = { r: 1.4, fill: "white", stroke: "black", strokeWidth: 0.4 };
const DRAWN = 5; // rows at a time
const SHADES: Record<Metric, { label: string; domain: [number, number]; type: "symlog" | "log" }> = {
  growth: { label: "growth of the swing (1/s): above 0 it grows", domain: [-1, 1], type: "symlog" },
  jerk: { label: "peak jerk (m/s³)", domain: [1, 1000], type: "log" },
};
const AROUND_0 = 0.05; // 1/s, where small growth and small decay are told apart

interface Loaded {
  module: WebAssembly.Module;
  description: Description;
}

/** Edges (n + 1) and middles (n) of an axis; from 0 on they lie closer where values are small. */
function axis(name: string, n: number): { edges: number[]; middles: number[]; type: "sqrt" | "linear" } {
  const { from, to } = SPANS[name]!;
  const type = from === 0 ? "sqrt" : "linear";
  const at = (share: number): number => from + (to - from) * (type === "sqrt" ? share ** 2 : share);
  const edges = Array.from({ length: n + 1 }, (_, i) => at(i / n));
  return { type, edges, middles: edges.slice(1).map((_, i) => Number(at((i + 0.5) / n).toPrecision(3))) };
}

/** The worker with its unit. What comes back asks it for the rows of a state's map, which come by and by: `heard`. */
function makeCrew(unit: Loaded, heard: () => void): (state: State) => (Row | undefined)[] {
  const crew = new Worker(URL.createObjectURL(new Blob([worker], { type: "text/javascript" })));
  crew.postMessage(unit);
  let [rows, asked, number] = [[] as (Row | undefined)[], "", 0];
  crew.addEventListener("message", ({ data }: MessageEvent<Row>) => {
    if (data.number === number) {
      rows[data.row] = data;
      if (data.row % DRAWN === DRAWN - 1) {
        heard();
      }
    }
  });
  return ({ values, x, y }) => {
    const { [x]: across, [y]: up, ...others } = values;
    const key = JSON.stringify([others, x, y]);
    if (key !== asked) {
      [rows, asked] = [[], key];
      const axes = { x: { name: x, values: axis(x, ACROSS).middles }, y: { name: y, values: axis(y, UP).middles } };
      crew.postMessage({ number: ++number, values, ...axes } satisfies Request);
    }
    return rows;
  };
}

/** Makes the map in `parent`; `taken` is told the values of a place. What comes back draws the map of a state. */
export function makeMap(parent: HTMLElement, unit: Loaded, taken: (values: Values) => void): (state: State) => void {
  let state: State;
  let picture: Plot.Plot & Element;
  const named = (name: string): string => `${name} (${unit.description.variables[name]!.unit})`;
  const show = (): void => {
    const rows = ask(state);
    picture = draw(state, rows, [state.x, state.y].map(named), parent.clientWidth);
    picture.setAttribute("aria-hidden", "true"); // what it tells is the label's to say
    parent.setAttribute("aria-busy", String(rows.filter((row) => row).length < UP));
    parent.setAttribute("aria-label", told(state, rows));
    parent.replaceChildren(picture);
    place("legend").replaceChildren(picture.legend("color")!);
  };
  const ask = makeCrew(unit, show);
  parent.addEventListener("click", (event) => {
    const box = picture.getBoundingClientRect();
    const shrunk = Number(picture.getAttribute("width")) / box.width; // in a window that has become narrower
    const at = (axis: "x" | "y", pixels: number): number => picture.scale(axis)!.invert!(pixels * shrunk);
    const across = cellAt(state.x, ACROSS, at("x", event.clientX - box.left));
    taken({ ...across, ...cellAt(state.y, UP, at("y", event.clientY - box.top)) });
  });
  parent.addEventListener("keydown", (event) => {
    const step = { ArrowLeft: -1, ArrowDown: -1, ArrowRight: 1, ArrowUp: 1 }[event.key];
    if (step) {
      event.preventDefault();
      const [name, n] = /Left|Right/.test(event.key) ? [state.x, ACROSS] : [state.y, UP];
      taken(cellAt(name, n, state.values[name]!, step));
    }
  });
  return (next) => {
    state = next;
    show();
  };
}

/** The knob's value in the cell that is nearest to a value, or `by` cells further. */
function cellAt(name: string, n: number, value: number, by = 0): Values {
  const { middles } = axis(name, n);
  return { [name]: middles[Math.min(Math.max(nearest(middles, value) + by, 0), n - 1)]! };
}

function nearest(values: number[], value: number): number {
  const distances = values.map((other) => Math.abs(other - value));
  return distances.indexOf(Math.min(...distances));
}

/** What somebody hears of the map. */
function told({ values, x, y, show }: State, rows: (Row | undefined)[]): string {
  const [i, j] = [nearest(axis(x, ACROSS).middles, values[x]!), nearest(axis(y, UP).middles, values[y]!)];
  const here = rows[j]?.cells[i];
  const leaves = here?.leaves ? ", leaves compression" : "";
  const value = here && `${SHADES[show].label}: ${here[show].toPrecision(3)}${leaves}`;
  return `Map over ${x} and ${y}, arrow keys move: ${x} = ${values[x]}, ${y} = ${values[y]}. ${value ?? ""}`;
}

function draw(state: State, rows: (Row | undefined)[], labels: string[], width: number): Plot.Plot & Element {
  const [across, up] = [axis(state.x, ACROSS), axis(state.y, UP)];
  const cells = rows.flatMap((row, j) =>
    (row?.cells ?? []).map((cell, i) => ({
      ...cell, x1: across.edges[i], x2: across.edges[i + 1], y1: up.edges[j], y2: up.edges[j + 1],
      x: across.middles[i], y: up.middles[j],
    })),
  );
  const boundary = rows.flatMap((row) => row?.boundary ?? []);
  const ends = (name: string): [number, number] => [SPANS[name]!.from, SPANS[name]!.to];
  const least = SHADES[state.show].domain[0];
  const shown = cells.filter((cell) => Number.isFinite(cell[state.show]));
  return Plot.plot({
    width,
    ...{ height: 330, marginLeft: 58, marginTop: 28, marginBottom: 42 },
    style: { fontSize: "13px", background: "none" },
    x: { label: `${labels[0]} →`, type: across.type, domain: ends(state.x), ticks: 4, tickFormat: String },
    y: { label: `↑ ${labels[1]}`, type: up.type, domain: ends(state.y), ticks: 5, tickFormat: String },
    color: { ...SHADES[state.show], constant: AROUND_0, scheme: "viridis", clamp: true, reverse: true, ticks: 4 },
    marks: [
      Plot.rect(shown, { ...CORNERS, fill: (cell) => Math.max(cell[state.show], least), inset: -0.25 }),
      Plot.dot(cells.filter((cell) => cell.leaves), { x: "x", y: "y", ...DOT }),
      Plot.line(boundary, { x: "x", y: "y", stroke: "white", strokeWidth: 4, clip: true }),
      Plot.line(boundary, { x: "x", y: "y", stroke: "black", strokeWidth: 2, strokeDasharray: "6 3", clip: true }),
      Plot.dot([picked(state.values, [state.x, state.y])], {
        x: state.x, y: state.y, r: 6, fill: "var(--trailer)", stroke: "white", strokeWidth: 2, clip: true,
      }),
      Plot.frame({ stroke: "var(--line)" }),
    ],
  }) as Plot.Plot & Element;
}
