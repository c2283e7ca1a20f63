/** A step brake on the unit: what theory and page look at, over time. */
import type { Unit } from "./unit.js";

export const STEP = 0.01; // s, between two samples; the unit chooses its own steps
export const DURATION = 6; // s, as in the paper's figures

/** The outputs that are seen, each a Float64Array over `time`, in SI units. */
export const OUTPUTS = [
  "v_car",
  "v_trailer",
  "a_car",
  "a_trailer",
  "compression",
  "F_hitch",
  "slip_car",
  "slip_trailer",
  "trailer_brake_torque",
];

export type Traces = Record<string, Float64Array>;

/**
 * The traces of a step brake from the beginning: `values` are parameters and inputs by name (brake_torque), in SI
 * units. UnitError where the unit refuses one, in its words.
 */
export function brake(unit: Unit, values: Record<string, number>, step = STEP, duration = DURATION): Traces {
  const time = Float64Array.from({ length: Math.round(duration / step) + 1 }, (_, i) => i * step);
  unit.start(values);
  return { time, ...unit.sample(time, OUTPUTS) };
}
