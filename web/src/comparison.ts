/** Theory against a run: comparison/theory.py once more, which says what may differ and why. */
import type { Traces } from "./engine.js";
import { shuntingMode, wheelDecayRate, type Eigenvalue, type LinearParameters } from "./linear.js";
import { measure, type Oscillation } from "./oscillation.js";
import { PAPER, changed, known, picked, type Values } from "./paper.js";
import { givesFrom, linearUntil, steady } from "./steady.js";

const GROWTH_ALLOWED = [0.005, 0.01] as const; // 1/s, and relative
const FREQUENCY_ALLOWED = 0.002; // relative
const STEADY_ALLOWED = 1e-4; // relative, beside slip
const RATIO_ALLOWED = 0.0005;
const WHEELS_SETTLED = Math.log(1e6);
const DECAYED = Math.log(100);
const SETTLED = Math.log(1e5);
const SPEEDS = 40; // at which theory's mode is computed; between them it is as good as straight
const FINE = 16; // pieces of a sampling step, in which the drawbar is looked at

/** A quantity from both sides, NaN where one has none. */
export interface Judged {
  quantity: string;
  unit: string;
  theory: number;
  run: number;
  allowed: number; // of the difference
  notJudged: string; // the reason, if there is one
}

/** What is needed of a run from the moment on when start-up transients are over. */
interface Part {
  time: Float64Array;
  compression: Float64Array;
  a_car: Float64Array;
  growth: Float64Array; // 1/s, theory's along the speed; empty: there is no mode
  frequency: Float64Array; // Hz
  stays: boolean; // in compression from here on
  notLinear: string; // "" or why linear theory does not hold
}

/** "agrees", "differs" or "not judged". */
export function verdict({ theory, run, allowed, notJudged }: Judged): string {
  return notJudged ? "not judged" : Math.abs(run - theory) <= allowed ? "agrees" : "differs";
}

/** Judges a step brake; `alone` is the same one with the car alone. */
export function compare(values: Values, traces: Traces, alone: Traces): Judged[] {
  const part = settledPart(values, traces);
  const window = indexOf(part.growth, DECAYED, part.time.length) + 1;
  const found = measure(part.time.subarray(0, window), part.compression.subarray(0, window));
  return [...modeRows(part, window, found), ...steadyRows(values, part, window, found, traces, alone)];
}

function settledPart(values: Values, traces: Traces): Part {
  const linear = known({ ...values, ...picked(PAPER.datum, PAPER.neutral) });
  const { entry, stays, sentence } = compressedFrom(traces, values);
  const hasMode = linear.k + linear.r > 0;
  const settled = hasMode ? WHEELS_SETTLED / Math.max(wheelDecayRate(linear, values["V_0"]!), 1e-9) : entry;
  const begin = traces.time.findIndex((t) => t >= Math.max(entry, settled));
  const from = begin < 0 ? traces.time.length - 1 : begin;
  const modes = hasMode ? modesAlong(linear, traces.v_car.subarray(from)) : [];
  const beyond = changed(values, PAPER.beyond)[0];
  return {
    time: traces.time.subarray(from),
    compression: traces.compression.subarray(from),
    a_car: traces.a_car.subarray(from),
    growth: Float64Array.from(modes, ({ re }) => re),
    frequency: Float64Array.from(modes, ({ im }) => im / (2 * Math.PI)),
    stays,
    notLinear: beyond ? `${beyond} = ${values[beyond]} is beyond linear theory` : sentence,
  };
}

function modesAlong(p: LinearParameters, speeds: Float64Array): Eigenvalue[] {
  const [low, high] = [Math.min(...speeds), Math.max(...speeds)];
  const step = (high - low) / SPEEDS || 1;
  const table = Array.from({ length: SPEEDS + 2 }, (_, i) => shuntingMode(p, low + i * step));
  return Array.from(speeds, (V) => {
    const i = Math.floor((V - low) / step);
    const share = (V - low) / step - i;
    const [one, other] = [table[i]!, table[i + 1]!];
    return { re: one.re + share * (other.re - one.re), im: one.im + share * (other.im - one.im) };
  });
}

/** When (s) the drawbar is first compressed, whether it stays so, and a sentence if it was or is not so. */
function compressedFrom({ time, compression, v_car, v_trailer }: Traces, values: Values) {
  const [start, end] = [givesFrom(values), linearUntil(values)];
  const path = refined(time, compression, v_trailer.map((v, i) => v - v_car[i]!));
  const at = (i: number): number => time[0]! + ((time.at(-1)! - time[0]!) * i) / (path.length - 1);
  const first = path.findIndex((x) => x > start);
  if (first < 0) {
    return { entry: time[0]!, stays: false, sentence: "drawbar is never in compression" };
  }
  const entry = at(first);
  const leaves = path.findIndex((x, i) => i > first && !(x > start));
  const passes = path.findIndex((x) => x > end);
  if (leaves > 0) {
    return { entry, stays: false, sentence: `drawbar leaves compression at t = ${at(leaves).toFixed(2)} s` };
  }
  if (passes >= 0) {
    const sentence = `drawbar's stiffness changes, at ${end} m, at t = ${at(passes).toFixed(2)} s`;
    return { entry, stays: false, sentence };
  }
  const late = compression[0]! < start ? `drawbar comes into compression only at t = ${entry.toFixed(2)} s` : "";
  return { entry, stays: true, sentence: late };
}

/** FINE times as many samples, on the cubic Hermite polynomial through samples and rates. */
function refined(time: Float64Array, samples: Float64Array, rates: Float64Array): Float64Array {
  return Float64Array.from({ length: FINE * (time.length - 1) + 1 }, (_, n) => {
    const i = Math.min(Math.floor(n / FINE), Math.max(time.length - 2, 0));
    const [s, h] = [n / FINE - i, time[i + 1]! - time[i]!];
    const [one, other, slope, next] = [samples[i]!, samples[i + 1]!, rates[i]! * h, rates[i + 1]! * h];
    const rest = s * (3 * (other - one) - 2 * slope - next) + s * s * (2 * (one - other) + slope + next);
    return s === 0 ? one : one + s * (slope + rest);
  });
}

/** How many samples pass until the oscillation of this growth has fallen by exp(-measure). */
function indexOf(growth: Float64Array, measure: number, samples: number): number {
  let [exponent, least] = [0, 0];
  for (let i = 0; i < growth.length; i++) {
    exponent += i > 0 ? 0.005 * (growth[i - 1]! + growth[i]!) : 0;
    least = Math.min(least, exponent);
    if (-least >= measure) {
      return i;
    }
  }
  return samples;
}

/** Rows that are judged together, or not. */
function rows(notJudged: string) {
  return (quantity: string, unit: string, theory: number, run: number, allowed: number): Judged =>
    ({ quantity, unit, theory, run, allowed, notJudged });
}

function modeRows(part: Part, window: number, found: Oscillation | string): Judged[] {
  const growth = mean(part.growth.subarray(0, window));
  const frequency = mean(part.frequency.subarray(0, window));
  let reason = part.notLinear;
  if (part.growth.length === 0) {
    reason ||= "k = r = 0 leave no shunting mode";
  } else if (part.frequency.subarray(0, window).some((f) => f === 0)) {
    reason ||= "the shunting mode is overdamped";
  }
  const measured = typeof found === "string" ? { growth: NaN, frequency: NaN } : found;
  if (typeof found === "string") {
    reason = found.startsWith("no exponential") && reason ? `${reason}; ${found}` : reason || found;
  }
  const allowed = GROWTH_ALLOWED[0] + GROWTH_ALLOWED[1] * Math.abs(growth);
  const ratio = (re: number, f: number): number => -re / Math.hypot(re, 2 * Math.PI * f);
  const [omega, damping] = [2 * Math.PI * frequency, ratio(growth, frequency)];
  const row = rows(reason);
  return [
    row("shunting growth", "1/s", growth, measured.growth, allowed),
    row("shunting frequency", "Hz", frequency, measured.frequency, FREQUENCY_ALLOWED * frequency),
    row("damping ratio", "1", damping, ratio(measured.growth, measured.frequency),
      allowed / omega + FREQUENCY_ALLOWED * Math.abs(damping)),
  ];
}

function steadyRows(
  values: Values, part: Part, window: number, found: Oscillation | string, traces: Traces, alone: Traces,
): Judged[] {
  const { A, D, reason } = steadyValues(part, window, found);
  const from = traces.time.length - part.time.length;
  const slip = Math.max(...[traces.slip_car, traces.slip_trailer].map((slips) => largest(slips.subarray(from))));
  const theory = steady(values);
  const relative = STEADY_ALLOWED + slip * theory.wheels;
  const last = alone.time.length - 1;
  const first = Math.min(from, last - 1);
  const A_c = (alone.v_car[last]! - alone.v_car[first]!) / (alone.time[last]! - alone.time[first]!);
  const silent = [reason, theory.silent].filter((text) => text).join("; ");
  const notJudged = silent || (A_c ? "" : "nothing brakes the car");
  const pushed = theory.D - values["eps"]!;
  const row = rows(notJudged);
  return [
    row("acceleration A", "m/s2", theory.A, A, relative * Math.abs(theory.A)),
    row("A / A_c", "1", theory.ratio, A / A_c, RATIO_ALLOWED),
    row("compression D", "m", theory.D, D, relative * pushed),
  ];
}

/** From the settled end of the run, else from the fit. */
function steadyValues(part: Part, window: number, found: Oscillation | string) {
  const { growth, time, a_car, compression, stays, notLinear } = part;
  const settled = indexOf(growth, SETTLED, time.length);
  if (stays && settled < time.length - 1) {
    return { A: mean(a_car.subarray(settled)), D: mean(compression.subarray(settled)), reason: notLinear };
  }
  if (stays && typeof found !== "string") {
    return { A: found.offsetOf(a_car.subarray(0, window)), D: found.offset, reason: notLinear };
  }
  const reason = notLinear || "the run is too short to judge: it ends before the motion has settled";
  return { A: mean(a_car), D: mean(compression), reason };
}

/** Over evenly spaced samples, by the trapezoidal rule. */
function mean(samples: Float64Array): number {
  const sum = samples.reduce((total, value) => total + value, 0) - 0.5 * (samples[0]! + samples.at(-1)!);
  return samples.length > 1 ? sum / (samples.length - 1) : (samples[0] ?? NaN);
}

function largest(samples: Float64Array): number {
  return samples.reduce((most, value) => Math.max(most, Math.abs(value)), 0);
}
