/** What is taken away from the page: the run as CSV, the picture as SVG, and what repeats the run elsewhere. */
import * as Plot from "@observablehq/plot";
import { element, place } from "./element.js";
import { OUTPUTS, type Traces } from "./engine.js";
import { changed, type Values } from "./paper.js";
import type { Steady } from "./steady.js";
import { DASHES, PANELS, columns } from "./traces.js";
import type { Description } from "./unit.js";

const INKS: Record<string, string> = { car: "#0b3c6f", drawbar: "#0b3c6f", trailer: "#d55e00", steady: "#777777" };
const [WIDTH, HEIGHT] = [720, 240];

export interface Shown {
  values: Values;
  traces: Traces;
  steady: Steady;
}

/** Makes the buttons work; `shown` tells what the page shows when one is pressed. */
export function makeDownloads(description: Description, shown: () => Shown): void {
  const buttons = {
    csv: () => save("run.csv", "text/csv", csv(shown().traces, description)),
    svg: () => save("run.svg", "image/svg+xml", svg(shown())),
    toml: () => save("hitch.toml", "application/toml", toml(shown().values, description)),
  };
  Object.entries(buttons).forEach(([id, press]) => place(id).addEventListener("click", press));
}

function save(name: string, type: string, text: string): void {
  const address = URL.createObjectURL(new Blob([text], { type }));
  element("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 1000);
}

/** The table that `hitch run` writes. */
export function csv(traces: Traces, { variables }: Description): string {
  const heads = OUTPUTS.map((name) => `${name} [${variables[name]!.unit}]`);
  const row = (time: number, i: number) => [Number(time.toFixed(9)), ...OUTPUTS.map((name) => traces[name][i]!)];
  return [["time [s]", ...heads], ...Array.from(traces.time, row)].map((row) => `${row.join(",")}\r\n`).join("");
}

/** The file for `hitch run --parameters`. */
export function toml(values: Values, { variables }: Description): string {
  const lines = changed(values).filter((name) => name !== "brake_torque").map((name) => {
    const number = String(values[name]);
    const { unit, description } = variables[name]!;
    return `${name} = ${/[.e]/.test(number) ? number : `${number}.0`}  # ${unit}, ${description}`;
  });
  const torque = changed(values, ["brake_torque"]).map((name) => ` --brake-torque ${values[name]}`);
  return [`# hitch run --parameters hitch.toml${torque.join("")}`, ...lines, ""].join("\n");
}

/** The call that repeats the run. */
export function python(values: Values): string {
  const given = changed(values).map((name) => `, ${name}=${values[name]}`);
  return `import overrun_hitch as hitch; run = hitch.run("8"${given.join("")})`;
}

/** The three panels, one below the other, in the colours of paper. */
function svg({ values, traces, steady }: Shown): string {
  const title = changed(values).map((name) => `${name} = ${values[name]}`).join(", ");
  const panels = PANELS.map((panel, row) => {
    const names = [...Object.keys(panel.of), ...(panel.steady ? ["steady"] : [])];
    const found = columns(panel, traces, steady);
    const picture = Plot.plot({
      ...{ width: WIDTH, height: HEIGHT, marginLeft: 60, marginTop: 34, marginBottom: 42 },
      style: "font: 12px sans-serif; color: #1c2126",
      x: { label: "Time (s)" }, y: { label: panel.name, grid: true },
      marks: [
        ...found.map((column, i) => Plot.lineY(column, {
          x: traces.time, stroke: INKS[names[i]!]!, strokeDasharray: DASHES[names[i]!]!.join(" ") || "none",
        })),
        // Above the panel, where there are no curves.
        ...names.map((name, i) => Plot.text([`${DASHES[name]!.length ? "- -" : "—"} ${name}`], {
          frameAnchor: "top-right", dy: -26, dx: -110 * (names.length - 1 - i), fill: INKS[name]!,
        })),
      ],
    });
    picture.setAttribute("y", String(30 + row * HEIGHT));
    return new XMLSerializer().serializeToString(picture);
  });
  const heading = element("b", {}, `Overrun hitch: ${title || "figure 8"}`).innerHTML;
  const size = `width="${WIDTH}" height="${30 + PANELS.length * HEIGHT}"`;
  return `<svg xmlns="http://www.w3.org/2000/svg" ${size} style="background: white">
<text x="10" y="20" font-family="sans-serif" font-size="13">${heading}</text>${panels.join("")}</svg>`;
}
