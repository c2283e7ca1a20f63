/** The knobs of the page: a slider and a field each, for one parameter or input of the unit. */
import { element } from "./element.js";
import { PAPER, changed, type Values } from "./paper.js";
import { typed } from "./state.js";
import type { Description, Variable } from "./unit.js";

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

/** Told a knob's new number, answers what is wrong with it, or "". */
type Turned = (name: string, value: number) => string;

/** Makes the knobs in `parent`, by name. */
export function makeKnobs(parent: HTMLElement, { variables }: Description, turned: Turned): Record<string, Knob> {
  const knobs = Object.keys(SPANS).map((name) => [name, new Knob(name, variables[name]!, turned)] as const);
  parent.append(...knobs.map(([, knob]) => knob.row));
  return Object.fromEntries(knobs);
}

export class Knob {
  readonly row: HTMLElement;
  readonly #slider: HTMLInputElement;
  readonly #field: HTMLInputElement;
  readonly #told: HTMLElement;
  readonly #unit: string;
  #last = NaN;

  constructor(name: string, variable: Variable, turned: Turned) {
    const { from, to, step } = SPANS[name]!;
    const [id, meaning] = [`knob-${name}`, PAPER.meanings[name]!];
    this.#unit = variable.unit ?? "";
    const ariaLabel = `${meaning}, ${name}, slider`;
    this.#slider = element("input", { type: "range", min: from, max: to, step, ariaLabel });
    this.#field = element("input", { id, type: "text", inputMode: "decimal", autocomplete: "off", spellcheck: false });
    this.#told = element("p", { id: `told-${name}`, className: "told", ariaLive: "polite" });
    const label = element("label", { htmlFor: id }, meaning, element("i", {}, name));
    const unit = element("span", { id: `unit-${name}` }, this.#unit);
    this.#field.setAttribute("aria-describedby", `unit-${name} told-${name}`);
    this.#slider.addEventListener("input", () => {
      this.#field.value = this.#slider.value;
      this.#tell(turned(name, this.#slider.valueAsNumber));
    });
    this.#field.addEventListener("input", () => {
      try {
        this.#tell(turned(name, typed(name, this.#field.value, variable)));
      } catch (error) {
        this.#tell((error as Error).message);
      }
    });
    this.row = element("div", { className: "knob" }, label, this.#slider, this.#field, unit, this.#told);
  }

  /** But for `anew`, a field with a wrong text keeps it until its knob has another value. */
  show(value: number, anew: boolean): void {
    this.#slider.value = String(value);
    this.#slider.setAttribute("aria-valuetext", `${value} ${this.#unit}`);
    const waits = document.activeElement === this.#field || (value === this.#last && this.#told.textContent !== "");
    if (anew || !waits) {
      this.complain(String(value), "");
    }
    this.#last = value;
  }

  complain(text: string, message: string): void {
    this.#field.value = text;
    this.#tell(message);
  }

  #tell(message: string): void {
    this.#told.textContent = message;
    this.#field.setAttribute("aria-invalid", String(message !== ""));
  }
}

/** The presets, figures and cases of the paper; what comes back shows which of them has these values, if one has. */
export function makePresets(select: HTMLSelectElement, chosen: (values: Values) => void): (values: Values) => void {
  const presets: Record<string, Values> = {};
  select.append(element("option", { value: "" }, "Own values"));
  for (const [heading, word, table] of [
    ["Figures of the paper", "Figure", PAPER.figures],
    ["Its cases, with C = 500 N.s/m", "Case", PAPER.cases],
  ] as const) {
    const names = Object.keys(table).map((name) => `${word} ${name}`);
    const options = names.map((name) => element("option", { value: name }, name));
    select.append(element("optgroup", { label: heading }, ...options));
    Object.values(table).forEach((values, i) => (presets[names[i]!] = { ...PAPER.datum, ...values }));
  }
  select.addEventListener("change", () => chosen({ ...(presets[select.value] ?? PAPER.datum) }));
  return (values) => {
    const same = Object.keys(presets).filter((name) => changed(values, undefined, presets[name]).length === 0);
    select.value = same.includes(select.value) ? select.value : (same[0] ?? "");
  };
}
