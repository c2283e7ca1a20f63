/** Against theory/linear.py, in the cases that tests/web/test_linear.py writes. */
import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { test } from "node:test";
import {
  compressionMatrix, criticalDamping, eigenvalues, shuntingMode, wheelDecayRate, type LinearParameters,
} from "../src/linear.js";

interface Case {
  parameters: LinearParameters;
  V: number;
  matrix: number[][];
  eigenvalues: [number, number][];
  shunting: [number, number];
  wheels: number;
  critical?: number;
}

const cases: Case[] = JSON.parse(readFileSync(process.env["LINEAR_CASES"]!, "utf8"));
const TOLERANCE = 1e-10; // relative to the value, and ROUNDING to the largest beside it: one eigenvalue is zero
const ROUNDING = 1e-13;

function size(values: number[]): number {
  return Math.max(...values.map(Math.abs));
}

test("matrices", () => {
  for (const { parameters, V, matrix } of cases) {
    const rows = compressionMatrix(parameters, V);
    assert.equal(rows.length, matrix.length);
    rows.forEach((row, i) => {
      const expected = matrix[i]!;
      assert.equal(row.length, expected.length);
      row.forEach((value, j) => assert(Math.abs(value - expected[j]!) <= ROUNDING * size(expected)));
    });
  }
});

test("eigenvalues", () => {
  for (const { parameters, V, eigenvalues: expected } of cases) {
    const left = eigenvalues(compressionMatrix(parameters, V));
    const largest = size(expected.map(([re, im]) => Math.hypot(re, im)));
    for (const [re, im] of expected) {
      const allowed = TOLERANCE * Math.hypot(re, im) + ROUNDING * largest;
      const distances = left.map((value) => Math.hypot(value.re - re, value.im - im));
      const nearest = Math.min(...distances);
      assert(nearest <= allowed, `${re} + ${im}i is ${nearest} off: ${JSON.stringify(parameters)}`);
      left.splice(distances.indexOf(nearest), 1); // each is there once
    }
    assert.equal(left.length, 0);
  }
});

test("the shunting mode", () => {
  for (const { parameters, V, shunting } of cases) {
    const { re, im } = shuntingMode(parameters, V);
    const distance = Math.hypot(re - shunting[0], im - shunting[1]);
    assert(distance <= TOLERANCE * Math.hypot(...shunting), JSON.stringify(parameters));
  }
});

test("the slowest of the wheels", () => {
  for (const { parameters, V, wheels } of cases) {
    assert(Math.abs(wheelDecayRate(parameters, V) - wheels) <= 1e-8 * Math.abs(wheels), JSON.stringify(parameters));
  }
});

test("the boundary", () => {
  for (const { parameters, V, critical } of cases.filter((one) => one.critical !== undefined)) {
    const distance = Math.abs(criticalDamping(parameters, V) - critical!);
    assert(distance <= 1e-9 * critical! + 1e-9, `${distance} off ${critical}: ${JSON.stringify(parameters)}`);
  }
});

test("what has no answer is refused by name", () => {
  const { parameters } = cases[0]!;
  assert.throws(() => compressionMatrix(parameters, 0), /^RangeError: V_0 = 0 m\/s .* greater than 0/);
  assert.throws(() => shuntingMode({ ...parameters, k: 0, r: 0 }, 20), /^RangeError: k = 0 N\/m and r = 0/);
});
