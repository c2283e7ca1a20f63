/** Car, trailer and drawbar as they move: live.html draws them at rest, this moves their parts. */
import { place } from "./element.js";
import type { Traces } from "./engine.js";

const REST = 360; // where the plunger is in the drawing, px; the car stays, the trailer moves against it
const SEAT = 250; // and the spring's other end
const ROOM = 75; // px, that the largest compression takes
const ROAD = 6; // px a metre
const COILS = 9;

/** Makes the buttons work; what comes back is given each new run. `at` is told the time that is shown. */
export function makeMotion(at: (time: number) => void): (traces: Traces, eps: number) => void {
  const [play, slowness, slider] = [place<HTMLButtonElement>("play"), place<HTMLSelectElement>("slowness"), place<HTMLInputElement>("time")];
  let [traces, eps, time, before] = [null as Traces | null, 0, 0, 0];
  let plays = !matchMedia("(prefers-reduced-motion: reduce)").matches;
  const show = (): void => {
    slider.value = String(time);
    slider.setAttribute("aria-valuetext", `${time.toFixed(2)} s`);
    at(time);
    if (traces) {
      draw(traces, eps, time);
    }
  };
  const frame = (now: number): void => {
    if (plays && traces) {
      const end = traces.time.at(-1)!;
      time += (now - before) / 1000 / Number(slowness.value);
      time = time > end ? 0 : time;
      show();
    }
    before = now;
    requestAnimationFrame(frame);
  };
  const label = (): void => void (play.textContent = plays ? "Pause" : "Play");
  play.addEventListener("click", () => {
    plays = !plays;
    label();
  });
  slider.addEventListener("input", () => {
    [time, plays] = [slider.valueAsNumber, false];
    label();
    show();
  });
  label();
  requestAnimationFrame(frame);
  return (next, clearance) => {
    [traces, eps] = [next, clearance];
    slider.max = String(next.time.at(-1)!);
    time = Math.min(time, next.time.at(-1)!);
    show();
  };
}

function draw(traces: Traces, eps: number, time: number): void {
  const last = traces.time.length - 1;
  const i = Math.min(Math.floor((time / traces.time[last]!) * last), last);
  const most = Math.max(0.05, eps, ...traces.compression);
  const scale = ROOM / most; // px a metre of the drawbar
  const moved = traces.compression[i]! * scale;
  move("trailer-drawn", moved);
  // The spring's free end is held by its stop until the plunger has crossed the clearance.
  const end = Math.min(REST, REST - eps * scale + moved);
  place("spring").setAttribute("d", coil(SEAT - 90 + moved, end));
  place("seat").setAttribute("x", String(end - 3));
  place("gap").setAttribute("x", String(end));
  place("gap").setAttribute("width", String(Math.max(0, REST - end)));
  place("ruler").setAttribute("width", String(ruler(most) * scale));
  place("ruler-length").textContent = `${ruler(most) * 1000} mm of the drawbar`;
  place("road").setAttribute("stroke-dashoffset", String(distance(traces, i) * ROAD));
  const torque = Math.max(...traces.trailer_brake_torque) || 1;
  place("trailer-brake").setAttribute("opacity", String(Math.max(0, traces.trailer_brake_torque[i]! / torque)));
}

function move(id: string, by: number): void {
  place(id).setAttribute("transform", `translate(${by} 0)`);
}

/** A length that is easily said, in m. */
function ruler(most: number): number {
  return 10 ** Math.floor(Math.log10(most));
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
