/** The live page: knobs, a run of the unit at each of their values, what theory says of them. */
import json from "unit.json";
import bytes from "unit.wasm";
import { compare, verdict } from "./comparison.js";
import { makeDownloads, python, type Shown } from "./downloads.js";
import { element, place, settled } from "./element.js";
import { brake, brakeAlone } from "./engine.js";
import { SPANS, makeKnobs, makePresets } from "./knobs.js";
import { criticalDamping } from "./linear.js";
import "./live.css";
import { makeMap } from "./map.js";
import { Motion } from "./motion.js";
import { PAPER, changed, known, type Values } from "./paper.js";
import { makePlane } from "./plane.js";
import { link, linked, typed, type Metric, type State } from "./state.js";
import { steady } from "./steady.js";
import { makeTraces } from "./traces.js";
import { Unit, type Description } from "./unit.js";

const QUIET = 120; // ms after the last change until numbers, link and map follow
const description = json as Description;
// At once, before the page counts as loaded: browsers allow that up to megabytes, and it takes milliseconds.
const module = new WebAssembly.Module(bytes);
const unit = new Unit(module, description);

const state: State = { values: { ...PAPER.datum }, ...linked("", Object.keys(SPANS)).state };
let shown: Shown;

const traces = makeTraces(place("traces"));
const plane = makePlane(place("plane"));
const motion = new Motion(traces.at);
const knobs = makeKnobs(place("knobs"), description, (name, value) =>
  attempt({ ...state.values, [name]: value }, false),
);
const presets = makePresets(place<HTMLSelectElement>("preset"), take);
const map = makeMap(place("map"), { module, description }, (values) => take({ ...state.values, ...values }));
makeDownloads(description, () => shown);

/** Runs the unit and shows it; what it refuses is answered, and what was shown stays. `anew`: wrong fields go, too. */
function attempt(values: Values, anew: boolean): string {
  try {
    shown = { values, traces: brake(unit, values), steady: steady(values) };
  } catch (error) {
    return (error as Error).message;
  }
  state.values = values;
  traces.show(shown.traces, shown.steady);
  motion.show(shown.traces, values["eps"]!);
  plane(values);
  Object.entries(knobs).forEach(([name, knob]) => knob.show(values[name]!, anew));
  presets(values);
  later();
  return "";
}

function take(values: Values): void {
  place("alert").textContent = attempt(values, true);
}

/** What takes more than a frame, or is heard: link, words, numbers, map. */
function finish(): void {
  history.replaceState(null, "", link(state));
  place("python").textContent = python(state.values);
  const others = changed(state.values).filter((name) => !(name in SPANS));
  const told = others.map((name) => `${name} = ${state.values[name]} ${description.variables[name]!.unit}`);
  place("others").textContent = told.join(", ");
  place("others").parentElement!.hidden = told.length === 0;
  numbers();
  map(state);
}
const later = settled(finish, QUIET);

function numbers(): void {
  const rows = compare(state.values, shown.traces, brakeAlone(unit, state.values));
  const judged = rows.map((one) => row(one.quantity, one.unit, one.theory, one.run, verdict(one)));
  place("numbers").replaceChildren(row("C_crit at V_0", "N.s/m", critical(), NaN, ""), ...judged);
  const said = (rate: number): string =>
    Number.isFinite(rate) ? `shunting ${rate > 0 ? "grows" : "dies out"} at ${number(rate)} 1/s` : "nothing to tell";
  place("verdict").textContent = `Theory: ${said(rows[0]!.theory)}. Run: ${said(rows[0]!.run)}: ${verdict(rows[0]!)}.`;
  const reasons = [...new Set(rows.flatMap(({ notJudged }) => notJudged.split("; ")))].filter((reason) => reason);
  place("reasons").textContent = reasons.length > 0 ? `Not judged: ${reasons.join("; ")}.` : "";
}

/** C_crit is theory's alone; NaN where it has none, and then the other rows say why. */
function critical(): number {
  try {
    return criticalDamping(known(state.values), state.values["V_0"]!);
  } catch {
    return NaN;
  }
}

function row(quantity: string, unit: string, theory: number, run: number, word: string): Element {
  const numbers = [theory, run].map((value) => element("td", {}, number(value)));
  const heading = element("th", { scope: "row" }, quantity, " ", element("small", {}, unit));
  return element("tr", {}, heading, ...numbers, element("td", { className: word.replace(" ", "-") }, word));
}

function number(value: number): string {
  return Number.isFinite(value) ? String(Number(value.toPrecision(4))) : "–";
}

/** What the address bar holds, one value after the other, so that each is refused for itself. */
function follow(): void {
  const { state: map, texts, unknown } = linked(location.hash, Object.keys(SPANS));
  Object.assign(state, map);
  const told = unknown.slice(0, 3).map((text) => `The page has no ${text}.`);
  const refused: [name: string, text: string, message: string][] = [];
  let values = { ...PAPER.datum };
  for (const [name, text] of Object.entries(texts)) {
    try {
      const next = { ...values, [name]: typed(name, text, description.variables[name]!) };
      brake(unit, next);
      values = next;
    } catch (error) {
      refused.push([name, text, (error as Error).message]);
    }
  }
  told.push(attempt(values, true));
  for (const [name, text, message] of refused) {
    knobs[name]?.complain(text, message);
    if (!knobs[name]) {
      told.push(message);
    }
  }
  place("alert").textContent = told.join(" ").trim();
  for (const key of ["x", "y", "show"] as const) {
    place<HTMLSelectElement>(key).value = state[key];
  }
  finish();
}

for (const axis of ["x", "y"] as const) {
  place(axis).append(...Object.keys(SPANS).map((name) => element("option", { value: name }, name)));
}
for (const key of ["x", "y", "show"] as const) {
  place<HTMLSelectElement>(key).addEventListener("change", ({ target }) => {
    const { value } = target as HTMLSelectElement;
    if (key === "show") {
      state.show = value as Metric;
    } else {
      const other = key === "x" ? "y" : "x";
      if (state[other] === value) {
        place<HTMLSelectElement>(other).value = state[other] = state[key]; // they change places
      }
      state[key] = value;
    }
    later();
  });
}
addEventListener("hashchange", follow);
addEventListener("resize", settled(() => attempt(state.values, false), QUIET));
follow();
