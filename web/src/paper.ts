/** Parameters and inputs by name, in SI units, and what web/presets.py takes from parameters.py about them. */
import json from "presets.json";

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

/** Those of `names` that differ from figure 8. */
export function changed(values: Values, names = Object.keys(PAPER.datum)): string[] {
  return names.filter((name) => values[name] !== PAPER.datum[name]);
}

/** The values of `names` only. */
export function picked(values: Values, names: string[]): Values {
  return Object.fromEntries(names.map((name) => [name, values[name]!]));
}
