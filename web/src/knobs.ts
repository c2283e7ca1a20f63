/** The knobs of the page: a slider and a field each, for one parameter or input of the unit. */
import type { Description } from "./unit.js";

interface Span {
  name: string;
  meaning: string;
  from: number;
  to: number;
  step: number;
}

/** What the sliders reach, in the unit's units; a field takes all that the unit takes. */
const SPANS: Span[] = [
  { name: "C", meaning: "damper", from: 0, to: 5000, step: 10 },
  { name: "k", meaning: "spring", from: 1000, to: 20000, step: 10 },
  { name: "eps", meaning: "clearance", from: 0, to: 0.2, step: 0.001 },
  { name: "tau_b", meaning: "lag of the trailer's brake", from: 0, to: 1, step: 0.01 },
  { name: "brake_torque", meaning: "brake torque of the car", from: 0, to: 2000, step: 10 },
];

export type Values = Record<string, number>;

/**
 * Makes the knobs in `parent`, at `values` where they are named there, else where the unit starts, and returns all
 * their values. `changed` is called with these after each change; a field without a number is NaN, which the unit
 * refuses.
 */
export function makeKnobs(
  parent: HTMLElement,
  unit: Description,
  values: Values,
  changed: (values: Values) => void,
): Values {
  const now: Values = {};
  for (const span of SPANS) {
    const { start, unit: symbol, description } = unit.variables[span.name]!;
    now[span.name] = values[span.name] ?? start ?? 0;
    const [slider, field] = [input("range", span), input("number", span)];
    field.step = "any";
    field.removeAttribute("min");
    field.removeAttribute("max");
    slider.value = field.value = String(now[span.name]);
    for (const [one, other] of [[slider, field], [field, slider]] as const) {
      one.addEventListener("input", () => {
        other.value = one.value;
        now[span.name] = one.valueAsNumber;
        changed(now);
      });
    }
    slider.setAttribute("aria-label", `${span.meaning}, ${symbol}, slider`);
    const label = element("label", element("span", span.meaning), element("i", span.name));
    label.title = description ?? "";
    label.setAttribute("for", (field.id = `knob-${span.name}`));
    parent.append(element("div", label, slider, field, element("span", symbol ?? "")));
  }
  return now;
}

function input(type: string, { from, to, step }: Span): HTMLInputElement {
  return Object.assign(document.createElement("input"), { type, min: from, max: to, step });
}

function element(tag: "div" | "span" | "i" | "label", ...inside: (Node | string)[]): HTMLElement {
  const made = document.createElement(tag);
  made.append(...inside);
  return made;
}
