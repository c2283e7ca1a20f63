/** Car, trailer and drawbar as they move: live.html draws them at rest, this moves their parts. */
import { place } from "./element.js";
import type { Traces } from "./engine.js";

const PLUNGER = 360; // px, where it is in the drawing: the car stays, the trailer moves against it
const SEAT = 160; // px, where the spring's other end is while the drawbar is at rest
const ROOM = 75; // px, that the largest compression takes
const ROAD = 6; // px a metre
const COILS = 9;

/** The drawing, and what plays it: it goes on from where it is when it is given another run. */
export class Motion {
  readonly #play = place<HTMLButtonElement>("play");
  readonly #slowness = place<HTMLSelectElement>("slowness");
  readonly #slider = place<HTMLInputElement>("time");
  #run: { traces: Traces; eps: number } | null = null;
  #time = 0; // s
  #plays = !matchMedia("(prefers-reduced-motion: reduce)").matches;

  /** `at` is told each time that is shown. */
  constructor(private readonly at: (time: number) => void) {
    this.#play.addEventListener("click", () => this.#go(!this.#plays));
    this.#slider.addEventListener("input", () => {
      this.#go(false);
      this.#show(this.#slider.valueAsNumber);
    });
    this.#go(this.#plays);
    requestAnimationFrame((now) => this.#frame(now, now));
  }

  show(traces: Traces, eps: number): void {
    this.#run = { traces, eps };
    this.#slider.max = String(traces.time.at(-1)!);
    this.#show(Math.min(this.#time, traces.time.at(-1)!));
  }

  #go(plays: boolean): void {
    this.#plays = plays;
    this.#play.textContent = plays ? "Pause" : "Play";
  }

  #frame(before: number, now: number): void {
    if (this.#plays && this.#run) {
      const next = this.#time + (now - before) / 1000 / Number(this.#slowness.value);
      this.#show(next > this.#run.traces.time.at(-1)! ? 0 : next);
    }
    requestAnimationFrame((then) => this.#frame(now, then));
  }

  #show(time: number): void {
    this.#time = time;
    this.#slider.value = String(time);
    this.#slider.setAttribute("aria-valuetext", `${time.toFixed(2)} s`);
    this.at(time);
    if (this.#run) {
      draw(this.#run.traces, this.#run.eps, time);
    }
  }
}

function draw(traces: Traces, eps: number, time: number): void {
  const last = traces.time.length - 1;
  const i = Math.min(Math.floor((time / traces.time[last]!) * last), last);
  const most = Math.max(0.05, eps, ...traces.compression);
  const scale = ROOM / most; // px a metre of the drawbar
  const moved = traces.compression[i]! * scale;
  set("trailer-drawn", "transform", `translate(${moved} 0)`);
  // The spring's free end is held by its stop until the plunger has crossed the clearance.
  const end = Math.min(PLUNGER, PLUNGER - eps * scale + moved);
  set("spring", "d", coil(SEAT + moved, end));
  set("seat", "x", end - 3);
  set("gap", "x", end);
  set("gap", "width", Math.max(0, PLUNGER - end));
  const ruler = 10 ** Math.floor(Math.log10(most)); // m
  set("ruler", "width", ruler * scale);
  place("ruler-length").textContent = `${ruler * 1000} mm of the drawbar`;
  set("road", "stroke-dashoffset", distance(traces, i) * ROAD);
  const torque = Math.max(...traces.trailer_brake_torque) || 1;
  set("trailer-brake", "opacity", Math.max(0, traces.trailer_brake_torque[i]! / torque));
}

function set(id: string, attribute: string, value: string | number): void {
  place(id).setAttribute(attribute, String(value));
}

function coil(from: number, to: number): string {
  const points = Array.from({ length: 2 * COILS + 1 }, (_, i) => {
    const y = i === 0 || i === 2 * COILS ? 0 : i % 2 ? -9 : 9;
    return `${from + ((to - from) * i) / (2 * COILS)} ${92 + y}`;
  });
  return `M ${points.join(" L ")}`;
}

/** How far the car has come, in m. */
function distance({ v_car, time }: Traces, i: number): number {
  return v_car.subarray(0, i).reduce((sum, v) => sum + v, 0) * (time[1]! - time[0]!);
}
