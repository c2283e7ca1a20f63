/** A step brake on the unit: what theory and page look at, over time. */
import { PAPER, type Values } from "./paper.js";
import type { Unit } from "./unit.js";

export const STEP = 0.01; // s, between two samples; the unit chooses its own steps
const PATIENCE = 2000; // ms: the page stands still meanwhile
const STANDSTILL = 0.1; // m/s: the paper's slip, a difference over the speed, means nothing at rest

/** The outputs that are seen, each a Float64Array over `time`, in SI units. */
export const OUTPUTS = [
  "v_car", "v_trailer", "a_car", "a_trailer", "compression", "F_hitch", "slip_car", "slip_trailer",
  "trailer_brake_torque",
] as const;

export type Traces = Record<(typeof OUTPUTS)[number] | "time", Float64Array>;

/**
 * The traces of a step brake from the beginning, ended before standstill: as `hitch run`. UnitError where the unit
 * refuses one of the values, in its words.
 */
export function brake(unit: Unit, values: Values, duration = PAPER.duration): Traces {
  const time = Float64Array.from({ length: Math.round(duration / STEP) + 1 }, (_, i) => i * STEP);
  const { V_0 } = values;
  unit.start(values);
  if (!(V_0! >= STANDSTILL)) {
    throw new RangeError(`V_0 = ${V_0} m/s is not allowed: a step brake starts at ${STANDSTILL} m/s at least`);
  }
  const found = { time, ...unit.sample(time, [...OUTPUTS], PATIENCE) } as Traces;
  const rest = time.findIndex((_, i) => becomesSlower(found, i));
  return rest < 0 ? found : (mapped(found, (column) => column.subarray(0, rest + 1)) as Traces);
}

/** The same with nothing between car and trailer: the car as if alone. */
export function brakeAlone(unit: Unit, values: Values): Traces {
  return brake(unit, { ...values, ...Object.fromEntries(PAPER.link.map((name) => [name, 0])) });
}

/** Whether the next step may carry the run past rest: an acceleration may grow within it. */
function becomesSlower({ v_car, v_trailer, a_car, a_trailer }: Traces, i: number): boolean {
  const speeds = [v_car[i]! + 2 * STEP * Math.min(a_car[i]!, 0), v_trailer[i]! + 2 * STEP * Math.min(a_trailer[i]!, 0)];
  return Math.min(...speeds) < STANDSTILL;
}

function mapped<T>(columns: Record<string, T>, change: (column: T) => T): Record<string, T> {
  return Object.fromEntries(Object.entries(columns).map(([name, column]) => [name, change(column)]));
}
