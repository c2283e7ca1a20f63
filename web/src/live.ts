/** The live page: knobs, a run of the unit at each of their values, what theory says of them. */
import json from "unit.json";
import bytes from "unit.wasm";
import { compare, verdict, type Judged } from "./comparison.js";
import { makeDownloads, python, type Shown } from "./downloads.js";
import { element, place, settled } from "./element.js";
import { brake, brakeAlone } from "./engine.js";
import { SPANS, makeKnobs, makePresets } from "./knobs.js";
import { criticalDamping, type LinearParameters } from "./linear.js";
import "./live.css";
import { makeMap } from "./map.js";
import { makeMotion } from "./motion.js";
import { PAPER, changed, type Values } from "./paper.js";
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
const motion = makeMotion(traces.at);
const knobs = makeKnobs(place("knobs"), description, (name, value) => attempt({ ...state.values, [name]: value }, false));
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
  motion(shown.traces, values["eps"]!);
  plane(values);
  knobs.show(values, anew);
  presets(values);
  later();
  return "";
}

function take(values: Values): void {
  place("alert").textContent = attempt(values, true);
}

const later = settled(() => {
  history.replaceState(null, "", link(state));
  place("python").textContent = python(state.values);
  const others = changed(state.values).filter((name) => !(name in SPANS));
  place("others").parentElement!.hidden = others.length === 0;
  place("others").textContent = others.map((name) => `${name} = ${state.values[name]} ${description.variables[name]!.unit}`).join(", ");
  numbers();
  map(state);
}, QUIET);

function numbers(): void {
  const rows = compare(state.values, shown.traces, brakeAlone(unit, state.values));
  place("numbers").replaceChildren(critical(), ...rows.map(row));
  const said = (growth: number): string =>
    Number.isFinite(growth) ? `shunting ${growth > 0 ? "grows" : "dies out"} at ${number(growth)} 1/s` : "nothing to tell";
  place("verdict").textContent = `Theory: ${said(rows[0]!.theory)}. Run: ${said(rows[0]!.run)}: ${verdict(rows[0]!)}.`;
  const reasons = [...new Set(rows.flatMap(({ notJudged }) => notJudged.split("; ")))].filter((reason) => reason);
  place("reasons").textContent = reasons.length > 0 ? `Not judged: ${reasons.join("; ")}.` : "";
}

function critical(): Element {
  let value = NaN;
  try {
    value = criticalDamping(state.values as unknown as LinearParameters, state.values["V_0"]!);
  } catch {
    // theory has none, and the other rows say why
  }
  return row({ quantity: "C_crit at V_0", unit: "N.s/m", theory: value, run: NaN, allowed: 0, notJudged: "theory's alone" });
}

function row(judged: Judged): Element {
  const word = judged.notJudged === "theory's alone" ? "" : verdict(judged);
  const numbers = [judged.theory, judged.run].map((value) => element("td", {}, number(value)));
  const heading = element("th", { scope: "row" }, judged.quantity, " ", element("small", {}, judged.unit));
  return element("tr", {}, heading, ...numbers, element("td", { className: word.replace(" ", "-") }, word));
}

function number(value: number): string {
  return Number.isFinite(value) ? String(Number(value.toPrecision(4))) : "–";
}

/** What the address bar holds, one value after the other, so that each is refused for itself. */
function follow(): void {
  const { state: map, texts, unknown } = linked(location.hash, Object.keys(SPANS));
  Object.assign(state, map);
  const told = unknown.map((text) => `The page has no ${text}.`);
  const refused: [string, string, string][] = [];
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
  const unplaced = refused.filter(([name, text, message]) => !knobs.complain(name, text, message));
  place("alert").textContent = [...told, ...unplaced.map(([, , message]) => message)].join(" ").trim();
  for (const key of ["x", "y", "show"] as const) {
    place<HTMLSelectElement>(key).value = state[key];
  }
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
follow();
