/** What the map shows of one run, and what page and worker say to each other. */
import { STEP, type Traces } from "./engine.js";
import type { Values } from "./paper.js";

/** Runs at every combination of the two axes, and where one is C, C_crit over the other. */
export interface Request {
  number: number;
  values: Values;
  x: { name: string; values: number[] };
  y: { name: string; values: number[] };
}

/** NaN where the unit refuses the values. */
export interface Cell {
  growth: number; // 1/s, of the swing from the second third of the run to the last
  jerk: number; // m/s3, the largest of the car
  leaves: boolean; // the drawbar leaves compression after it once was in it
}

export interface Row {
  number: number;
  row: number;
  cells: Cell[];
  boundary: { x: number; y: number }[]; // points of C_crit that belong to the row; none where theory has none
}

const TAKEN_UP = 0.1; // s: until then the car's wheels take up the step of the brake torque
const LEAST = 1e-6; // m, a swing below which nothing swings

/** Of one run; jerk and leaving as measure/metrics.py has them. */
export function cell({ time, compression, a_car }: Traces, eps: number): Cell {
  const third = Math.floor(time.length / 3);
  const swing = (from: number): number => {
    const part = compression.subarray(from, from + third + 1);
    return Math.max(LEAST, Math.max(...part) - Math.min(...part));
  };
  let [jerk, been, leaves] = [0, false, false];
  for (let i = 0; i < time.length; i++) {
    been ||= compression[i]! > eps;
    leaves ||= been && compression[i]! <= eps;
    if (i > 0 && time[i - 1]! >= TAKEN_UP) {
      jerk = Math.max(jerk, Math.abs(a_car[i]! - a_car[i - 1]!) / STEP);
    }
  }
  const swings = [swing(0), swing(third), swing(2 * third)] as const;
  const [before, after] = swings[1] > LEAST ? [swings[1], swings[2]] : [swings[0], swings[1]]; // it died out early
  return { growth: Math.log(after / before) / (third * STEP), jerk, leaves };
}
