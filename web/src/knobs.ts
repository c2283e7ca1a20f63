/** The knobs of the page: a slider and a field each, for one parameter or input of the unit. */
import { element } from "./element.js";
import { PAPER, type Values } from "./paper.js";
import { typed } from "./state.js";
import type { Description } from "./unit.js";

export interface Span {
  from: number;
  to: number;
  step: number;
}

/** What the sliders and the map reach, in the unit's units; a field takes all that the unit takes. */
export const SPANS: Record<string, Span> = {
  C: { from: 0, to: 3000, step: 5 },
  V_0: { from: 5, to: 60, step: 0.5 },
  k: { from: 500, to: 20000, step: 10 },
  k_t: { from: 0, to: 600000, step: 10 },
  r: { from: 0, to: 60000, step: 1 },
  eps: { from: 0, to: 0.2, step: 0.001 },
  tau_b: { from: 0, to: 0.5, step: 0.005 },
  F_f: { from: 0, to: 1000, step: 5 },
  M_t: { from: 100, to: 2000, step: 5 },
  brake_torque: { from: 0, to: 4000, step: 10 },
};

export interface Knobs {
  /** Shows values; but for `anew`, a field with a wrong text keeps it until its knob has another value. */
  show(values: Values, anew: boolean): void;
  /** Marks the field of what a message names first, "C = -5 ...", or none; whether there is such a field. */
  complain(name: string, text: string, message: string): boolean;
}

/** Makes the knobs in `parent`; `turned` is told each new number and answers what is wrong with it, or "". */
export function makeKnobs(parent: HTMLElement, unit: Description, turned: (name: string, value: number) => string): Knobs {
  const knobs = new Map<string, ReturnType<typeof makeKnob>>();
  for (const [name, span] of Object.entries(SPANS)) {
    const knob = makeKnob(name, span, unit, turned);
    knobs.set(name, knob);
    parent.append(knob.row);
  }
  return {
    show: (values, anew) => knobs.forEach((knob, name) => knob.show(values[name]!, anew)),
    complain: (name, text, message) => knobs.get(name)?.complain(text, message) ?? false,
  };
}

function makeKnob(name: string, span: Span, unit: Description, turned: (name: string, value: number) => string) {
  const variable = unit.variables[name]!;
  const { unit: symbol } = variable;
  const meaning = PAPER.meanings[name]!;
  const slider = element("input", { type: "range", min: span.from, max: span.to, step: span.step });
  const field = element("input", { type: "text", inputMode: "decimal", autocomplete: "off", spellcheck: false });
  const told = element("p", { id: `told-${name}`, className: "told", ariaLive: "polite" });
  field.id = `knob-${name}`;
  const label = element("label", { htmlFor: field.id }, meaning, element("i", {}, name));
  slider.setAttribute("aria-label", `${meaning}, ${name}, slider`);
  field.setAttribute("aria-describedby", `${told.id} unit-${name}`);
  let last = NaN;
  const tell = (message: string): void => {
    told.textContent = message;
    field.setAttribute("aria-invalid", String(message !== ""));
  };
  slider.addEventListener("input", () => {
    field.value = slider.value;
    tell(turned(name, slider.valueAsNumber));
  });
  field.addEventListener("input", () => {
    try {
      tell(turned(name, typed(name, field.value, variable)));
    } catch (error) {
      tell((error as Error).message);
    }
  });
  const unitText = element("span", { id: `unit-${name}` }, symbol ?? "");
  return {
    row: element("div", { className: "knob" }, label, slider, field, unitText, told),
    show(value: number, anew: boolean) {
      slider.value = String(value);
      slider.setAttribute("aria-valuetext", `${value} ${symbol}`);
      if (anew || (document.activeElement !== field && (value !== last || told.textContent === ""))) {
        field.value = String(value);
        tell("");
      }
      last = value;
    },
    complain(text: string, message: string) {
      field.value = text;
      tell(message);
      return true;
    },
  };
}

/** The presets: figures and cases of the paper, and what is none of these. */
export function makePresets(select: HTMLSelectElement, chosen: (values: Values) => void): (values: Values) => void {
  const presets = Object.entries({ "Figures of the paper": PAPER.figures, "Its cases, with C = 500 N.s/m": PAPER.cases });
  const all = presets.flatMap(([heading, table]) => {
    const word = table === PAPER.figures ? "Figure" : "Case";
    const options = Object.keys(table).map((name) => element("option", { value: `${word} ${name}` }, `${word} ${name}`));
    select.append(element("optgroup", { label: heading }, ...options));
    return Object.entries(table).map(([name, values]) => [`${word} ${name}`, { ...PAPER.datum, ...values }] as const);
  });
  select.prepend(element("option", { value: "" }, "Own values"));
  select.addEventListener("change", () => chosen({ ...(all.find(([name]) => name === select.value)?.[1] ?? PAPER.datum) }));
  return (values) => {
    const same = all.filter(([, preset]) => Object.keys(preset).every((name) => preset[name] === values[name]));
    if (!same.some(([name]) => name === select.value)) {
      select.value = same[0]?.[0] ?? "";
    }
  };
}
