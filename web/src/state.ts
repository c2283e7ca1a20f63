/** What the page shows, as a link carries it behind its #: C=100&eps=0.1&x=C&y=M_t&show=jerk. Links are hostile. */
import { PAPER, changed, type Values } from "./paper.js";
import type { Variable } from "./unit.js";

export const METRICS = ["growth", "jerk"] as const;
export type Metric = (typeof METRICS)[number];

/** The map's axes are names of knobs. */
export interface State {
  values: Values;
  x: string;
  y: string;
  show: Metric;
}

/**
 * A number as somebody types it, its unit behind it allowed. RangeError that says what is. The unit refuses parameters
 * itself; an input's range it would only keep to.
 */
export function typed(name: string, text: string, { unit, min, max, causality }: Variable): number {
  const bare = text.trim();
  const number = unit && unit !== "1" && bare.endsWith(unit) ? bare.slice(0, -unit.length).trim() : bare;
  const low = causality === "input" ? (min ?? -Infinity) : -Infinity;
  if (number === "" || !Number.isFinite(Number(number)) || Number(number) < low) {
    const ends = [min, max].map((end) => `${end ?? "any"} ${unit}`).join(" to ");
    throw new RangeError(`${name} = ${text.slice(0, 40)} is not allowed: its range is ${ends}`);
  }
  return Number(number);
}

/**
 * The state in a link, figure 8 where it says nothing, over the map of the knobs `axes`: texts that are to be values
 * are handed out as they are; what is none of the page's is told in `unknown`.
 */
export function linked(hash: string, axes: string[]) {
  const state: Omit<State, "values"> = { x: axes[0]!, y: axes[1]!, show: METRICS[0] };
  const texts: Record<string, string> = {};
  const unknown: string[] = [];
  for (const [name, text] of new URLSearchParams(hash.replace(/^#/, ""))) {
    if (Object.hasOwn(PAPER.datum, name)) {
      texts[name] = text;
    } else if ((name === "x" || name === "y") && axes.includes(text)) {
      state[name] = text;
    } else if (name === "show" && (METRICS as readonly string[]).includes(text)) {
      state.show = text as Metric;
    } else {
      unknown.push(`${name}=${text}`.slice(0, 40));
    }
  }
  if (state.x === state.y) {
    state.y = axes.find((name) => name !== state.x)!;
  }
  return { state, texts, unknown };
}

/** The link to a state: what differs from figure 8, and the map. */
export function link({ values, x, y, show }: State): string {
  const pairs = changed(values).map((name) => [name, String(values[name])]);
  return `#${new URLSearchParams([...pairs, ["x", x], ["y", y], ["show", show]])}`;
}
