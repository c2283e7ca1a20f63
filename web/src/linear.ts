/** Linear theory of the drawbar: theory/linear.py once more, for a page. The tests hold the two together. */
import { EigenvalueDecomposition, Matrix, inverse } from "ml-matrix";

/** Of the paper's parameters those that linear theory knows, in SI units; what they mean: docs/parameters.md. */
export type LinearParameters = Record<
  "M_c" | "M_t" | "I_c" | "I_t" | "R_c" | "R_t" | "C_kc" | "C_kt" | "k" | "C" | "rebound" | "r" | "tau_b" | "sigma",
  number
>;

/** Of e^(re + i im)t, both in 1/s. */
export interface Eigenvalue {
  re: number;
  im: number;
}

/**
 * The dynamic matrix (5 x 5, in rows) for (x_t - x_c, v_c, v_t, omega_c, omega_t) at the speed V in m/s; with sigma > 0
 * the slips of car and trailer are two more states, with tau_b > 0 the trailer's brake torque is the last one.
 * RangeError where V is not greater than 0.
 */
export function compressionMatrix(p: LinearParameters, V: number): number[][] {
  if (!(V > 0)) {
    throw new RangeError(`V_0 = ${V} m/s is not allowed: linear theory needs a speed greater than 0 m/s`);
  }
  const C = 0.5 * p.C * (1 + p.rebound);
  const drawbar = [
    [0, -1, 1, 0, 0],
    [p.k / p.M_c, -C / p.M_c, C / p.M_c, 0, 0],
    [-p.k / p.M_t, C / p.M_t, -C / p.M_t, 0, 0],
    [0, 0, 0, 0, 0],
    [p.tau_b > 0 ? 0 : -p.r / p.I_t, 0, 0, 0, 0],
  ];
  const rows = p.sigma > 0 ? withLaggingTyres(drawbar, p, V) : withTyres(drawbar, p, V);
  if (!(p.tau_b > 0)) {
    return rows;
  }
  const torque = [p.r / p.tau_b, ...rows.slice(1).map(() => 0), -1 / p.tau_b]; // tau_b T' = r (x_t - x_c) - T
  return [...rows.map((row, i) => [...row, i === 4 ? -1 / p.I_t : 0]), torque];
}

/** Slip speeds of car and trailer over (x_t - x_c, v_c, v_t, omega_c, omega_t); what a tyre's force makes of these. */
function tyres(p: LinearParameters): { slipSpeeds: number[][]; answers: number[][] } {
  return {
    slipSpeeds: [[0, 1, 0, -p.R_c, 0], [0, 0, 1, 0, -p.R_t]],
    answers: [[0, -1 / p.M_c, 0, p.R_c / p.I_c, 0], [0, 0, -1 / p.M_t, 0, p.R_t / p.I_t]],
  };
}

/** Tyre force C_k slip, slip = slip speed / V. */
function withTyres(drawbar: number[][], p: LinearParameters, V: number): number[][] {
  const { slipSpeeds, answers } = tyres(p);
  const forces = [p.C_kc / V, p.C_kt / V];
  const added = (i: number, j: number): number =>
    forces.reduce((sum, force, tyre) => sum + answers[tyre]![i]! * force * slipSpeeds[tyre]![j]!, 0);
  return drawbar.map((row, i) => row.map((value, j) => value + added(i, j)));
}

/** sigma slip' = slip speed - V slip. */
function withLaggingTyres(drawbar: number[][], p: LinearParameters, V: number): number[][] {
  const { slipSpeeds, answers } = tyres(p);
  const rows = drawbar.map((row, i) => [...row, answers[0]![i]! * p.C_kc, answers[1]![i]! * p.C_kt]);
  const slips = slipSpeeds.map((row, tyre) => [
    ...row.map((value) => value / p.sigma),
    ...[0, 1].map((other) => (other === tyre ? -V / p.sigma : 0)),
  ]);
  return [...rows, ...slips];
}

/** The eigenvalues of a real matrix, in no order. */
export function eigenvalues(matrix: number[][]): Eigenvalue[] {
  return values(decomposition(matrix));
}

/**
 * The mode in which car and trailer move against each other, with im >= 0: a motion that grows, else the one in which
 * the compression participates most (theory/linear.py: shunting_mode). RangeError as above, and where k = r = 0.
 */
export function shuntingMode(p: LinearParameters, V: number): Eigenvalue {
  return modesOf(p, V).shunting;
}

/** The slowest decay rate (1/s) of what is left beside rigid body and shunting (theory/linear.py). */
export function wheelDecayRate(p: LinearParameters, V: number): number {
  const { modes, shunting } = modesOf(p, V);
  const distance = ({ re, im }: Eigenvalue): number => Math.hypot(re - shunting.re, Math.abs(im) - shunting.im);
  const others = modes.sort((one, other) => distance(one) - distance(other)).slice(2);
  const bySize = others.sort((one, other) => Math.hypot(one.re, one.im) - Math.hypot(other.re, other.im));
  return -Math.max(...bySize.slice(1).map(({ re }) => re));
}

/**
 * The damper coefficient (N.s/m) below which the shunting mode grows (theory/boundary.py), by halving, to a relative
 * 1e-12; 0 where it is stable without one. RangeError as above, and where no damper up to 1e9 N.s/m holds it.
 */
export function criticalDamping(p: LinearParameters, V: number): number {
  const grows = (C: number): boolean => shuntingMode({ ...p, C }, V).re > 0;
  if (!grows(0)) {
    return 0;
  }
  let [low, high] = [0, 100];
  for (; grows(high); high *= 2) {
    if (high > 1e9) {
      throw new RangeError("no damper holds the shunting mode");
    }
    low = high;
  }
  while (high - low > 1e-12 * high) {
    const middle = 0.5 * (low + high);
    [low, high] = grows(middle) ? [middle, high] : [low, middle];
  }
  return high;
}

function modesOf(p: LinearParameters, V: number): { modes: Eigenvalue[]; shunting: Eigenvalue } {
  if (!(p.k + p.r > 0)) {
    throw new RangeError("k = 0 N/m and r = 0 N.m/m leave no shunting mode: one of them must be greater than 0");
  }
  const found = decomposition(compressionMatrix(p, V));
  const modes = values(found);
  const fastest = Math.max(...modes.map(({ re, im }) => Math.hypot(re, im)));
  const shares = participations(found, modes);
  const { re, im } = modes.find((mode) => mode.re > 1e-9 * fastest) ?? modes[shares.indexOf(Math.max(...shares))]!;
  return { modes, shunting: { re, im: Math.abs(im) } };
}

function decomposition(matrix: number[][]): EigenvalueDecomposition {
  return new EigenvalueDecomposition(new Matrix(balanced(matrix)), { assumeSymmetric: false });
}

/**
 * The matrix in other units of its states, powers of 2, in which rows are about as large as columns: forces and metres
 * differ by 1e6, which costs digits (B. N. Parlett and C. Reinsch 1969, doi 10.1007/BF02165404). LAPACK does so by
 * itself. Eigenvalues and participations stay.
 */
function balanced(matrix: number[][]): number[][] {
  const rows = matrix.map((row) => [...row]);
  for (let again = true; again; ) {
    again = false;
    rows.forEach((row, i) => {
      const others = rows.filter((other) => other !== row);
      const column = magnitude(others.map((other) => other[i]!));
      const size = magnitude(row.filter((_, j) => j !== i));
      const factor = column > 0 && size > 0 ? 2 ** Math.round(Math.log2(size / column) / 2) : 1;
      if (column * factor + size / factor < 0.95 * (column + size)) {
        row.forEach((value, j) => (row[j] = j === i ? value : value / factor));
        others.forEach((other) => (other[i]! *= factor));
        again = true;
      }
    });
  }
  return rows;
}

function magnitude(values: number[]): number {
  return values.reduce((total, value) => total + Math.abs(value), 0);
}

function values(found: EigenvalueDecomposition): Eigenvalue[] {
  return found.realEigenvalues.map((re, i) => ({ re, im: found.imaginaryEigenvalues[i]! }));
}

/** |right * left eigenvector| at the compression. Of a pair, a + ib and its conjugate, two columns hold a and b. */
function participations(found: EigenvalueDecomposition, modes: Eigenvalue[]): number[] {
  const right = found.eigenvectorMatrix.getRow(0);
  const left = inverse(found.eigenvectorMatrix).getColumn(0);
  return modes.map(({ im }, i) => {
    if (im === 0) {
      return Math.abs(right[i]! * left[i]!);
    }
    const other = im > 0 ? i + 1 : i - 1;
    return Math.hypot(right[i]!, right[other]!) * Math.hypot(left[i]!, left[other]!) * 0.5;
  });
}
