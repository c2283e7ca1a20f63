/**
 * Growth rate and frequency of a free oscillation, from a sampled trace alone: measure/oscillation.py once more, where
 * it says whose method this is. Only the start differs: linear prediction (R. Prony 1795), which is enough for traces
 * without noise.
 */
import { Matrix, solve } from "ml-matrix";

const FEWEST_PERIODS = 2;
const FEWEST_A_PERIOD = 4; // samples
const FEWEST_SAMPLES = 2 * FEWEST_PERIODS * FEWEST_A_PERIOD;
const FADED = Math.log(1e6); // what has faded so far is over
const FITS = 0.05; // what a fit may leave, relative
const STRIDES = [1, 2, 4, 8, 16, 32, 64];
const TRIALS = 60;
const ACCURATE = 1e-11; // of the sum of squares, relative: less is rounding

type Numbers = Float64Array | number[];
type Unknowns = [growth: number, omega: number, growthSlope: number, omegaSlope: number];

/** Means over the window: growth rate in 1/s, frequency in Hz; offset in the trace's unit. */
export interface Oscillation {
  growth: number;
  frequency: number;
  offset: number;
  /** Offset of another trace of the same motion at the same times. */
  offsetOf(trace: Numbers): number;
}

/** The oscillation in `trace`, sampled evenly at `time` in s, or why there is none. */
export function measure(time: Numbers, trace: Numbers): Oscillation | string {
  const swing = Math.max(...trace) - Math.min(...trace);
  const largest = Math.max(...trace.map(Math.abs));
  if (time.length < FEWEST_SAMPLES || !(swing > 1e-9 * largest)) {
    return time.length < FEWEST_SAMPLES ? `only ${time.length} samples` : "the trace is constant";
  }
  const middle = 0.5 * (time[0]! + time.at(-1)!);
  const window = Float64Array.from(time, (t) => t - middle);
  const scaled = Float64Array.from(trace, (value) => value / swing);
  const starts = STRIDES.flatMap((stride) => predicted(window, scaled, stride));
  if (starts.length === 0) {
    return "the trace does not oscillate";
  }
  const squares = starts.map((start) => square(remainder(start, window, scaled).left));
  const found = refined(starts[squares.indexOf(Math.min(...squares))]!, window, scaled);
  const [growth, frequency] = [found[0], Math.abs(found[1]) / (2 * Math.PI)];
  const length = window.at(-1)! - window[0]!;
  const lasting = Math.min(frequency * length, (frequency * FADED) / Math.max(Math.abs(growth), 1e-9));
  if (lasting < FEWEST_PERIODS) {
    return `only ${lasting.toFixed(1)} periods to measure`;
  }
  if (frequency * (window[1]! - window[0]!) * FEWEST_A_PERIOD > 1) {
    return `fewer than ${FEWEST_A_PERIOD} samples a period`;
  }
  const { left, offset } = remainder(found, window, scaled);
  const residual = Math.sqrt(square(left) / square(scaled.map((value) => value - offset)));
  if (!(residual <= FITS)) {
    return `no exponential fits the oscillation: it leaves ${Number(residual.toPrecision(2))}, over ${FITS}`;
  }
  const offsetOf = (other: Numbers): number => remainder(found, window, Float64Array.from(other)).offset;
  return { growth, frequency, offset: offset * swing, offsetOf };
}

function dot(one: Numbers, other: Numbers): number {
  let sum = 0;
  for (let i = 0; i < one.length; i++) {
    sum += one[i]! * other[i]!;
  }
  return sum;
}

function square(values: Numbers): number {
  return dot(values, values);
}

/** Differences d over `stride` samples lose the offset; of what oscillates, d[n + 2] = a d[n + 1] + b d[n]. */
function predicted(window: Float64Array, scaled: Float64Array, stride: number): Unknowns[] {
  const n = scaled.length - 3 * stride;
  if (n < 4) {
    return [];
  }
  const difference = (from: number): Float64Array =>
    Float64Array.from({ length: n }, (_, i) => scaled[i + from + stride]! - scaled[i + from]!);
  const [d0, d1, d2] = [difference(0), difference(stride), difference(2 * stride)];
  const [s00, s01, s11] = [dot(d0, d0), dot(d0, d1), dot(d1, d1)];
  const determinant = s00 * s11 - s01 * s01;
  const a = (dot(d1, d2) * s00 - dot(d0, d2) * s01) / determinant;
  const b = (dot(d0, d2) * s11 - dot(d1, d2) * s01) / determinant;
  if (!(a * a + 4 * b < 0)) {
    return [];
  }
  const step = stride * (window[1]! - window[0]!);
  return [[Math.log(-b) / 2 / step, Math.atan2(Math.sqrt(-a * a - 4 * b), a) / step, 0, 0]];
}

/** What is left of the trace beside its projection on offset, cosine and sine, and the offset's share. */
function remainder(unknowns: Unknowns, window: Float64Array, scaled: Float64Array) {
  const [growth, omega, growthSlope, omegaSlope] = unknowns;
  const exponents = window.map((t) => growth * t + 0.5 * growthSlope * t * t);
  const most = Math.max(...exponents); // so that no trial overflows
  const turned = (part: (angle: number) => number): Float64Array =>
    window.map((t, i) => Math.exp(exponents[i]! - most) * part(omega * t + 0.5 * omegaSlope * t * t));
  const [cosine, sine, one] = [turned(Math.cos), turned(Math.sin), window.map(() => 1)];
  const left = Float64Array.from(scaled);
  // The offset comes last: what the others have not taken of the constant is its own.
  const orthonormal: Float64Array[] = [];
  for (const column of [cosine, sine, one]) {
    for (const earlier of [...orthonormal, ...orthonormal]) {
      subtract(column, dot(earlier, column), earlier);
    }
    const length = Math.sqrt(square(column));
    const unit = column.map((value) => value / length);
    orthonormal.push(unit);
  }
  const shares = orthonormal.map((unit) => dot(unit, left));
  orthonormal.forEach((unit, i) => subtract(left, shares[i]!, unit));
  return { left, offset: shares[2]! / dot(orthonormal[2]!, window.map(() => 1)) };
}

function subtract(from: Float64Array, factor: number, other: Float64Array): void {
  for (let i = 0; i < from.length; i++) {
    from[i]! -= factor * other[i]!;
  }
}

/** Levenberg's and Marquardt's method on the remainder, with slopes by differences. */
function refined(start: Unknowns, window: Float64Array, scaled: Float64Array): Unknowns {
  const scales = [1, Math.abs(start[1]), 1, Math.abs(start[1])];
  const moved = (from: Unknowns, by: number[]) => from.map((value, i) => value + by[i]! * scales[i]!) as Unknowns;
  let [best, { left }] = [start, remainder(start, window, scaled)];
  let damping = 1e-3;
  for (let trial = 0; trial < TRIALS; trial++) {
    const slopes = scales.map((_, i) => {
      const by = [0, 0, 0, 0];
      by[i] = 1e-6;
      return remainder(moved(best, by), window, scaled).left.map((value, j) => (value - left[j]!) / 1e-6);
    });
    const normal = slopes.map((one) => slopes.map((other) => dot(one, other)));
    normal.forEach((row, i) => (row[i]! *= 1 + damping));
    const right = Matrix.columnVector(slopes.map((slope) => -dot(slope, left)));
    const trialled = moved(best, solve(new Matrix(normal), right, true).getColumn(0));
    const next = remainder(trialled, window, scaled).left;
    const [before, after] = [square(left), square(next)];
    damping *= after < before ? 0.1 : 10;
    if (after < before) {
      [best, left] = [trialled, next];
    }
    if (Math.abs(before - after) <= ACCURATE * before || damping > 1e9) {
      break;
    }
  }
  return best;
}
