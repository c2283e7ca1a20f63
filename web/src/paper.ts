/** Parameters and inputs by name, in SI units, and what web/presets.py takes from parameters.py about them. */
import json from "presets.json";
import type { LinearParameters } from "./linear.js";

export type Values = Record<string, number>;

interface Paper {
  datum: Values; // figure 8, and all that there is
  duration: number; // s
  figures: Record<string, Values>; // where they differ from figure 8
  cases: Record<string, Values>;
  meanings: Record<string, string>; // noun phrases
  link: string[]; // parameters that make what passes between car and trailer
  neutral: string[]; // those of which linear theory knows the default alone
  beyond: string[]; // those that must have it where large motions are compared with theory
}

export const PAPER = json as Paper;

/** Those of `names` that differ, from figure 8 unless said otherwise. */
export function changed(values: Values, names = Object.keys(PAPER.datum), from = PAPER.datum): string[] {
  return names.filter((name) => values[name] !== from[name]);
}

/** What linear theory takes. RangeError for what it does not know. */
export function known(values: Values): LinearParameters {
  for (const name of changed(values, PAPER.neutral)) {
    throw new RangeError(`linear theory does not know ${name} = ${values[name]}; allowed: ${PAPER.datum[name]}`);
  }
  return values as unknown as LinearParameters;
}

/** The values of `names` only. */
export function picked(values: Values, names: string[]): Values {
  return Object.fromEntries(names.map((name) => [name, values[name]!]));
}
