/** The root locus of the shunting mode over the damper, with the point where one is. */
import * as Plot from "@observablehq/plot";
import { SPANS } from "./knobs.js";
import { shuntingMode } from "./linear.js";
import { known, type Values } from "./paper.js";

const POINTS = 80;
const MARKS = [0, 500, 1000, 2000]; // N.s/m, numbered along the locus

/** The picture of the locus at these values. RangeError where theory has none. */
function draw(values: Values, width: number): Plot.Plot & Element {
  const most = Math.max(SPANS["C"]!.to, values["C"]!);
  const at = (C: number) => ({ C, ...shuntingMode(known({ ...values, C }), values["V_0"]!) });
  const locus = Array.from({ length: POINTS + 1 }, (_, i) => at(most * (i / POINTS) ** 2));
  const oscillates = locus.filter(({ im }) => im > 0);
  const shown = oscillates.length > 1 ? oscillates : locus;
  const heights = shown.map(({ im }) => im);
  const [low, high] = [Math.min(...heights), Math.max(...heights)];
  const margin = 0.15 * (high - low) || 1;
  const marks = MARKS.filter((C) => C <= most).map(at);
  const right = Math.max(0.2, ...shown.map(({ re }) => re)) * 1.15;
  return Plot.plot({
    width,
    ...{ height: 270, marginLeft: 45, marginTop: 28, marginBottom: 42 },
    style: { fontSize: "13px", background: "none", overflow: "visible" },
    x: { label: "Growth rate (1/s) →", domain: [Math.min(-0.2, ...shown.map(({ re }) => re)), right], ticks: 5 },
    y: { label: "↑ Angular frequency (rad/s)", domain: [Math.max(0, low - margin), high + margin], ticks: 5 },
    clip: true,
    marks: [
      Plot.rectX([right], { x1: 0, x2: right, fill: "var(--grows)" }),
      Plot.ruleX([0], { stroke: "var(--ink)", strokeWidth: 1.5 }),
      Plot.line(shown, { x: "re", y: "im", stroke: "var(--car)", strokeWidth: 2 }),
      Plot.dot(marks, { x: "re", y: "im", r: 2.5, fill: "var(--car)" }),
      Plot.text(marks, { x: "re", y: "im", text: ({ C }) => String(C), dy: -11, fill: "var(--soft)" }),
      Plot.dot([at(values["C"]!)], {
        x: "re", y: "im", r: 6, fill: "var(--trailer)", stroke: "var(--card)", strokeWidth: 2, className: "here",
      }),
    ],
  }) as Plot.Plot & Element;
}

/** Draws in `parent`; what comes back draws other values. A new damper moves the point alone. */
export function makePlane(parent: HTMLElement): (values: Values) => void {
  let picture: (Plot.Plot & Element) | null = null;
  let drawn = "";
  return (values) => {
    const { C, k_t, eps, F_f, brake_torque, compression_start, ...others } = values;
    const key = JSON.stringify([others, Math.max(C!, SPANS["C"]!.to), parent.clientWidth]);
    if (key !== drawn) {
      drawn = key;
      try {
        picture = draw(values, parent.clientWidth);
        picture.setAttribute("aria-hidden", "true");
        parent.replaceChildren(picture);
      } catch (error) {
        picture = null;
        parent.replaceChildren((error as Error).message);
      }
    }
    if (picture) {
      const { re, im } = shuntingMode(known(values), values["V_0"]!);
      const point = picture.querySelector(".here circle")!;
      point.setAttribute("cx", picture.scale("x")!.apply(re));
      point.setAttribute("cy", picture.scale("y")!.apply(im));
    }
  };
}
