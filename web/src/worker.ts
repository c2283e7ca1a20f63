/** The map, off the page's thread: a run of a unit of its own for each cell, a row at a time. */
import { cell, type Cell, type Request, type Row } from "./cell.js";
import { brake } from "./engine.js";
import { criticalDamping, type LinearParameters } from "./linear.js";
import type { Values } from "./paper.js";
import { Unit, type Description } from "./unit.js";

const LISTENS = 30; // ms, at least so often

function run(unit: Unit, values: Values): Cell {
  try {
    return cell(brake(unit, values), values["eps"]!);
  } catch {
    return { growth: NaN, jerk: NaN, leaves: false };
  }
}

function critical(values: Values): number | null {
  try {
    return criticalDamping(values as unknown as LinearParameters, values["V_0"]!);
  } catch {
    return null;
  }
}

let unit: Unit;
let latest = 0;
let heard = 0;

async function answer({ number, values, x, y }: Request): Promise<void> {
  for (const [row, up] of y.values.entries()) {
    const here = { ...values, [y.name]: up };
    const cells: Cell[] = [];
    for (const across of x.values) {
      cells.push(run(unit, { ...here, [x.name]: across }));
      if (performance.now() - heard > LISTENS) {
        await new Promise((resume) => setTimeout(resume)); // so that a newer request is heard
        heard = performance.now();
      }
      if (number !== latest) {
        return;
      }
    }
    self.postMessage({ number, row, cells, critical: x.name === "C" ? critical(here) : null } satisfies Row);
  }
}

self.addEventListener("message", ({ data }: MessageEvent<Request | { module: WebAssembly.Module; description: Description }>) => {
  if ("module" in data) {
    unit = new Unit(data.module, data.description);
  } else {
    latest = data.number;
    void answer(data);
  }
});
