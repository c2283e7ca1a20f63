/** The map, off the page's thread: a run of a unit of its own for each cell, a row at a time. */
import { cell, type Cell, type Request, type Row } from "./cell.js";
import { brake } from "./engine.js";
import { criticalDamping } from "./linear.js";
import { known, type Values } from "./paper.js";
import { Unit, type Description } from "./unit.js";

const LISTENS = 30; // ms, at least so often

function run(unit: Unit, values: Values): Cell {
  try {
    return cell(brake(unit, values), values["eps"]!);
  } catch {
    return { growth: NaN, jerk: NaN, leaves: false };
  }
}

/** C_crit (N.s/m) where the knob `name` has these values. */
function boundary(values: Values, name: string, others: number[]): { C: number; other: number }[] {
  try {
    return others.map((other) => {
      const here = { ...values, [name]: other };
      return { C: criticalDamping(known(here), here["V_0"]!), other };
    });
  } catch {
    return [];
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
    const across = x.name === "C" ? boundary(values, y.name, [up]).map(({ C, other }) => ({ x: C, y: other })) : [];
    const along = y.name === "C" && row === 0 ? boundary(values, x.name, x.values) : [];
    const line = [...across, ...along.map(({ C, other }) => ({ x: other, y: C }))];
    self.postMessage({ number, row, cells, boundary: line } satisfies Row);
  }
}

type Message = Request | { module: WebAssembly.Module; description: Description };

self.addEventListener("message", ({ data }: MessageEvent<Message>) => {
  if ("module" in data) {
    unit = new Unit(data.module, data.description);
  } else {
    latest = data.number;
    void answer(data);
  }
});
