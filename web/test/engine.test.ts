/** Against this machine's library, whose runs tests/web/test_engine.py writes. */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";
import { cell } from "../src/cell.js";
import { compare } from "../src/comparison.js";
import { brake, brakeAlone, type Traces } from "../src/engine.js";
import { SPANS } from "../src/knobs.js";
import { PAPER } from "../src/paper.js";
import { Unit, type Description } from "../src/unit.js";

interface Run {
  figure: string;
  values: Record<string, number>;
  traces: Record<string, number[]>;
}

const folder = process.env["UNIT"]!;
const module = new WebAssembly.Module(readFileSync(join(folder, "CarTrailer.wasm")));
const description: Description = JSON.parse(readFileSync(join(folder, "CarTrailer.json"), "utf8"));
const runs: Run[] = JSON.parse(readFileSync(process.env["RUNS"]!, "utf8"));
const unit = new Unit(module, description);
const TOLERANCE = 1e-9; // relative to the largest value of a trace
const FRAME = 16; // ms

function largest(values: number[]): number {
  return Math.max(...values.map(Math.abs));
}

for (const { figure, values, traces } of runs) {
  test(`figure ${figure}`, () => {
    const found = brake(unit, values);
    const distances = Object.entries(traces).map(([name, expected]) => {
      const column = found[name as keyof Traces];
      assert.equal(column.length, expected.length);
      return largest(expected.map((value, i) => value - column[i]!)) / largest(expected);
    });
    const worst = Math.max(...distances);
    console.log(`figure ${figure}: ${worst} of the largest value`);
    assert(worst <= TOLERANCE);
  });
}

test("what the unit refuses comes in its words, and the next run is as before", () => {
  const { values } = runs[0]!;
  const before = brake(unit, values);
  assert.throws(() => brake(unit, { ...values, C: -1 }), /^UnitError: C = -1 N\.s\/m is not allowed: its range is 0/);
  assert.throws(() => brake(unit, { ...values, c: 1 }), /^UnitError: the unit has no variable c$/);
  unit.start(values);
  assert.throws(() => unit.sample(new Float64Array([0, -1]), ["v_car"]), /^UnitError: .*step size/);
  assert.deepEqual(brake(unit, values), before);
  assert.throws(() => new Unit(module, { ...description, token: "{}" }), /^UnitError: .*token/);
});

test("two units at once, and one that is gone", () => {
  const other = new Unit(module, description);
  const { values } = runs[0]!;
  const before = brake(unit, values);
  brake(other, { ...values, C: 3000 });
  other.free();
  assert.deepEqual(brake(unit, values), before);
});

test("fifty values of a slider", () => {
  const { values } = runs.find((run) => run.figure === "8")!;
  const begin = performance.now();
  for (let i = 0; i < 50; i++) {
    brake(unit, { ...values, C: 500 + i });
  }
  const each = (performance.now() - begin) / 50;
  console.log(`${each.toFixed(2)} ms a run`);
  assert(each < FRAME);
});

test("whatever the unit runs, is judged, and is drawn on the map", () => {
  let seed = 20261129;
  const random = (): number => (seed = (seed * 48271) % 2147483647) / 2147483647; // Park and Miller 1988
  let judged = 0;
  for (let i = 0; i < 300; i++) {
    const values = { ...PAPER.datum };
    for (const [name, { to }] of Object.entries(SPANS)) {
      if (random() < 0.5) {
        values[name] = random() < 0.2 ? 0 : to * 10 ** (4 * random() - 3);
      }
    }
    try {
      const traces = brake(unit, values);
      const rows = compare(values, traces, brakeAlone(unit, values));
      assert(rows.every((row) => row.notJudged || Number.isFinite(row.theory)), JSON.stringify(values));
      assert.equal(typeof cell(traces, values["eps"]!).leaves, "boolean");
      judged++;
    } catch (error) {
      assert.match(String(error), /^UnitError: |^RangeError: V_0 = /, JSON.stringify(values));
    }
  }
  console.log(`${judged} of 300 random step brakes judged`);
  assert(judged > 100);
});
