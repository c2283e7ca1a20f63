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
const SHADES: Record<Metric, { label: string; domain: [number, number] }> = {
  growth: { label: "growth of the swing (1/s): above 0 it grows", domain: [-1, 1] },
  jerk: { label: "peak jerk (m/s³)", domain: [0, 30] },
};

/** Edges (n + 1) and middles (n) of an axis; from 0 on they lie closer where values are small. */
function axis(name: string, n: number): { edges: number[]; middles: number[]; type: "sqrt" | "linear" } {
  const { from, to } = SPANS[name]!;
  const type = from === 0 ? "sqrt" : "linear";
  const at = (share: number): number => from + (to - from) * (type === "sqrt" ? share ** 2 : share);
  const edges = Array.from({ length: n + 1 }, (_, i) => at(i / n));
  return { type, edges, middles: edges.slice(1).map((_, i) => Number(at((i + 0.5) / n).toPrecision(3))) };
}

/** Makes the map in `parent`; `taken` is told the values of a place. What comes back draws the map of a state. */
export function makeMap(
  parent: HTMLElement, unit: { module: WebAssembly.Module; description: Description }, taken: (values: Values) => void,
): (state: State) => void {
  const crew = new Worker(URL.createObjectURL(new Blob([worker], { type: "text/javascript" })));
  crew.postMessage(unit);
  const rows: (Row | undefined)[] = [];
  let state: State;
  let asked = "";
  let number = 0;
  let picture: (Plot.Plot & Element) | null = null;
  const named = (name: string): string => `${name} (${unit.description.variables[name]!.unit})`;
  const show = (): void => {
    picture = draw(state, rows, [state.x, state.y].map(named), parent.clientWidth);
    parent.setAttribute("aria-busy", String(rows.filter((row) => row).length < UP));
    parent.setAttribute("aria-label", told(state, rows));
    picture.setAttribute("aria-hidden", "true"); // what it tells is the label's to say
    parent.replaceChildren(picture);
    place("legend").replaceChildren(picture.legend("color")!);
  };
  crew.addEventListener("message", ({ data }: MessageEvent<Row>) => {
    if (data.number === number) {
      rows[data.row] = data;
      if (data.row === UP - 1 || data.row % 5 === 4) {
        show();
      }
    }
  });
  parent.addEventListener("click", (event) => {
    const box = picture!.getBoundingClientRect();
    const scale = parent.clientWidth / box.width;
    const [x, y] = [picture!.scale("x")!, picture!.scale("y")!];
    taken({
      [state.x]: nearest(axis(state.x, ACROSS).middles, x.invert!((event.clientX - box.left) * scale)),
      [state.y]: nearest(axis(state.y, UP).middles, y.invert!((event.clientY - box.top) * scale)),
    });
  });
  parent.addEventListener("keydown", (event) => {
    const moves: Record<string, [number, number]> = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowDown: [0, -1], ArrowUp: [0, 1] };
    const move = moves[event.key];
    if (move) {
      event.preventDefault();
      taken(move[0] ? neighbour(state, state.x, ACROSS, move[0]) : neighbour(state, state.y, UP, move[1]));
    }
  });
  return (next) => {
    state = next;
    const { [state.x]: across, [state.y]: up, ...values } = state.values;
    const key = JSON.stringify([values, state.x, state.y]);
    if (key !== asked) {
      asked = key;
      rows.length = 0;
      const axes = { x: { name: state.x, values: axis(state.x, ACROSS).middles }, y: { name: state.y, values: axis(state.y, UP).middles } };
      crew.postMessage({ number: ++number, values: state.values, ...axes } satisfies Request);
    }
    show();
  };
}

function nearest(values: number[], value: number): number {
  return values.reduce((best, other) => (Math.abs(other - value) < Math.abs(best - value) ? other : best));
}

function neighbour({ values }: State, name: string, n: number, by: number): Values {
  const { middles } = axis(name, n);
  const here = middles.indexOf(nearest(middles, values[name]!));
  return { [name]: middles[Math.min(Math.max(here + by, 0), n - 1)]! };
}

/** What somebody hears of the map. */
function told({ values, x, y, show }: State, rows: (Row | undefined)[]): string {
  const [i, j] = [x, y].map((name, up) => {
    const { middles } = axis(name, up ? UP : ACROSS);
    return middles.indexOf(nearest(middles, values[name]!));
  }) as [number, number];
  const here = rows[j]?.cells[i];
  const value = here ? `${SHADES[show].label}: ${here[show].toPrecision(3)}${here.leaves ? ", leaves compression" : ""}` : "";
  return `Map over ${x} and ${y}, arrow keys move: ${x} = ${values[x]}, ${y} = ${values[y]}. ${value}`;
}

function draw(state: State, rows: (Row | undefined)[], labels: string[], width: number): Plot.Plot & Element {
  const [across, up] = [axis(state.x, ACROSS), axis(state.y, UP)];
  const cells = rows.flatMap((row, j) =>
    (row?.cells ?? []).map((cell, i) => ({
      ...cell, x1: across.edges[i], x2: across.edges[i + 1], y1: up.edges[j], y2: up.edges[j + 1],
      x: across.middles[i], y: up.middles[j],
    })),
  );
  const boundary = rows.flatMap((row, j) => (row?.critical == null ? [] : [{ x: row.critical, y: up.middles[j] }]));
  const ends = (name: string): [number, number] => [SPANS[name]!.from, SPANS[name]!.to];
  const shown = cells.filter((cell) => Number.isFinite(cell[state.show]));
  return Plot.plot({
    width,
    height: 330,
    marginLeft: 58,
    marginTop: 28,
    marginBottom: 42,
    style: { fontSize: "13px", background: "none" },
    x: { label: `${labels[0]} →`, type: across.type, domain: ends(state.x), ticks: 4, tickFormat: String },
    y: { label: `↑ ${labels[1]}`, type: up.type, domain: ends(state.y), ticks: 5, tickFormat: String },
    color: { ...SHADES[state.show], scheme: "viridis", clamp: true, reverse: true, type: "linear" },
    marks: [
      Plot.rect(shown, { x1: "x1", x2: "x2", y1: "y1", y2: "y2", fill: state.show, inset: -0.25 }),
      Plot.dot(cells.filter((cell) => cell.leaves), { x: "x", y: "y", r: 1.4, fill: "white", stroke: "black", strokeWidth: 0.4 }),
      Plot.line(boundary, { x: "x", y: "y", stroke: "white", strokeWidth: 4, clip: true }),
      Plot.line(boundary, { x: "x", y: "y", stroke: "black", strokeWidth: 2, strokeDasharray: "6 3", clip: true }),
      Plot.dot([picked(state.values, [state.x, state.y])], {
        x: state.x, y: state.y, r: 6, fill: "var(--trailer)", stroke: "white", strokeWidth: 2, clip: true,
      }),
      Plot.frame({ stroke: "var(--line)" }),
    ],
  }) as Plot.Plot & Element;
}
