/** Steady braking by the paper's equation 15: theory/steady.py on the first piece of the spring, silent elsewhere. */
import type { Values } from "./paper.js";

export interface Steady {
  A: number; // m/s2, of the combination
  ratio: number; // A / A_c (1)
  D: number; // m, drawbar compression, clearance included
  wheels: number; // I/R^2 over what it adds to, of both vehicles (1)
  silent: string; // "" or why there is none of these
}

/** Compression (m) from which the spring gives: clearance, and F_0 on the frame. */
export function givesFrom({ eps, F_0, k_t }: Values): number {
  return F_0! > 0 ? eps! + F_0! / k_t! : eps!;
}

/** Compression (m) up to which, from there on, the stiffness is k. */
export function linearUntil(values: Values): number {
  return Math.max(givesFrom(values), Math.min(values["eps"]! + values["x_2"]!, values["travel"]!));
}

/** NaN, and why, where equation 15 has no answer. */
export function steady(values: Values): Steady {
  const { M_c, M_t, I_c, I_t, R_c, R_t, k, r, eps, F_0, brake_torque } = values as Record<string, number> & Values;
  const [wheels_c, wheels_t] = [I_c! / R_c! ** 2, I_t! / R_t! ** 2];
  const [car, trailer] = [M_c! + wheels_c, M_t! + wheels_t];
  const wheels = wheels_c / car + wheels_t / trailer;
  const share = k! / (k! + r! / R_t!);
  const ratio = car / (car + share * trailer);
  const A = (-ratio * brake_torque!) / R_c! / car;
  const D = eps! - (A * trailer) / (k! + r! / R_t!);
  const silent =
    k! + r! > 0
      ? F_0! > 0
        ? `equation 15 does not know F_0 = ${F_0} N`
        : D > linearUntil(values)
          ? "the drawbar comes to rest on another stiffness than k"
          : ""
      : "k = r = 0 leave no steady state";
  return silent ? { A: NaN, ratio: NaN, D: NaN, wheels, silent } : { A, ratio, D, wheels, silent };
}
