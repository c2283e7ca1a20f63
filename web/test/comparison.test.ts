/** Against comparison/theory.py, in the runs that tests/web/test_comparison.py writes. */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import { cell } from "../src/cell.js";
import { compare, verdict } from "../src/comparison.js";
import type { Traces } from "../src/engine.js";
import { changed, type Values } from "../src/paper.js";
import { steady } from "../src/steady.js";

interface Row {
  quantity: string;
  theory: number | null; // null: NaN, which JSON has not
  run: number | null;
  verdict: string;
  allowed: number | null;
  notJudged: string;
}

interface Case {
  values: Values;
  traces: Record<keyof Traces, number[]>;
  alone: Record<keyof Traces, number[]>;
  rows: Row[];
  jerk: number; // m/s3
}

const cases: Case[] = JSON.parse(readFileSync(process.env["COMPARISONS"]!, "utf8"));
// Of what may differ between theory and run, so that no verdict hangs on it; the fits stop at rounding.
const SHARE = 0.01;
const CLEAR = 0.15; // 1/s: the swing changes by a quarter from third to third, more than its samples may hide

function columns(traces: Case["traces"]): Traces {
  const found = Object.entries(traces).map(([name, values]) => [name, Float64Array.from(values)]);
  return Object.fromEntries(found) as Traces;
}

function near(found: number, expected: number | null, allowed: number | null, what: string): void {
  assert.equal(Number.isFinite(found), expected !== null, `${what}: ${found} instead of ${expected}`);
  if (expected !== null) {
    const most = SHARE * Math.min(allowed ?? 0.01 * Math.abs(expected), 0.01 * Math.abs(expected) + 0.001) + 1e-9;
    assert(Math.abs(found - expected) <= most, `${what}: ${found} instead of ${expected}`);
  }
}

for (const { values, traces, alone, rows, jerk } of cases) {
  const name = changed(values).map((key) => `${key}=${values[key]}`).join(", ") || "figure 8";
  test(name, () => {
    const found = compare(values, columns(traces), columns(alone));
    const { silent } = steady(values);
    for (const row of rows) {
      const one = found.find(({ quantity }) => quantity === row.quantity)!;
      if (silent && one.notJudged.includes(silent)) {
        // Of a drawbar that rests on another stiffness than k the page says nothing, and says so.
        near(one.run, row.run, row.allowed, `the run's ${row.quantity}`);
        assert(Number.isNaN(one.theory) && one.notJudged.includes(row.notJudged), one.notJudged);
        continue;
      }
      near(one.theory, row.theory, row.allowed, `theory's ${row.quantity}`);
      near(one.run, row.run, row.allowed, `the run's ${row.quantity}`);
      if (row.allowed !== null) {
        assert(Math.abs(one.allowed - row.allowed) <= 1e-3 * row.allowed, `${row.quantity}: ${one.allowed} allowed`);
      }
      assert.deepEqual([row.quantity, one.notJudged, verdict(one)], [row.quantity, row.notJudged, row.verdict]);
    }
    const shown = cell(columns(traces), values["eps"]!);
    assert(Math.abs(shown.jerk - jerk) <= 1e-9 * jerk, `the map's jerk: ${shown.jerk} instead of ${jerk}`);
    const { run } = rows.find(({ quantity }) => quantity === "shunting growth")!;
    if (run !== null && Math.abs(run) > CLEAR) {
      assert.equal(Math.sign(shown.growth), Math.sign(run), `the map's growth: ${shown.growth}, of a fit ${run}`);
    }
    const damping = found.find(({ quantity }) => quantity === "damping ratio")!;
    assert.equal(verdict(damping), rows[0]!.verdict);
  });
}
