// Shows the values under the pointer, from what stands beside each figure (readings.py).
"use strict";
const REACH = 25; // points: farther from a mark it is not meant

const along = (axis, share) => {
  const [first, last] = axis.ends;
  return axis.log ? first * (last / first) ** share : first + (last - first) * share;
};
const share = (axis, value) => {
  const [first, last] = axis.ends;
  return axis.log ? Math.log(value / first) / Math.log(last / first) : (value - first) / (last - first);
};
const written = (value, unit) => `${Number(value.toPrecision(4))}`.replace("-", "\u2212") + (unit && ` ${unit}`);

// What a curve has at x, between its samples; nothing beyond its ends.
function at(curve, x) {
  const after = curve.x.findIndex((other) => other >= x);
  if (after < 0 || (after === 0 && curve.x[0] > x)) return [];
  const before = Math.max(after - 1, 0);
  const part = after === before ? 0 : (x - curve.x[before]) / (curve.x[after] - curve.x[before]);
  const y = curve.y[before] + part * (curve.y[after] - curve.y[before]);
  return Number.isFinite(y) ? [{ name: curve.name, x, y }] : [];
}

function read(panel, point) {
  const [left, top, width, height] = panel.box;
  const [across, up] = [(point.x - left) / width, 1 - (point.y - top) / height];
  if (across < 0 || across > 1 || up < 0 || up > 1) return null;
  const placed = (value) => ({
    ...value,
    left: left + width * share(panel.x, value.x),
    top: top + height * (1 - share(panel.y, value.y)),
  });
  const x = along(panel.x, across);
  const found = panel.curves.filter((curve) => curve.function).flatMap((curve) => at(curve, x)).map(placed);
  const away = (value) => Math.hypot(value.left - point.x, value.top - point.y);
  const others = panel.curves
    .filter((curve) => !curve.function)
    .flatMap((curve) => curve.x.map((x, place) => placed({ name: curve.name, x, y: curve.y[place] })))
    .sort((one, other) => away(one) - away(other));
  const nearest = others.length && away(others[0]) < REACH ? others[0] : null;
  if (nearest && !found.some((value) => away(value) < away(nearest))) {
    const here = others.filter((value) => Math.hypot(value.left - nearest.left, value.top - nearest.top) < 1);
    const names = [...new Set(here.map((value) => value.name))];
    const lines = [...names, `${panel.x.name}: ${written(nearest.x, panel.x.unit)}`];
    return { lines: [...lines, `${panel.y.name}: ${written(nearest.y, panel.y.unit)}`], marks: [nearest] };
  }
  const lines = found.map((value) => `${value.name}: ${written(value.y, panel.y.unit)}`);
  return found.length ? { lines: [`${panel.x.name}: ${written(x, panel.x.unit)}`, ...lines], marks: found } : null;
}

for (const figure of document.querySelectorAll("figure")) {
  const svg = figure.querySelector("svg");
  const panels = JSON.parse(figure.querySelector("script").textContent);
  const told = figure.appendChild(document.createElement("output"));
  const marks = svg.appendChild(document.createElementNS(svg.namespaceURI, "g"));
  marks.setAttribute("class", "reading");
  const clear = () => {
    told.replaceChildren();
    marks.replaceChildren();
  };
  const show = (event) => {
    clear();
    const point = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    for (const { lines, marks: places } of panels.map((panel) => read(panel, point)).filter(Boolean)) {
      for (const line of lines) told.appendChild(document.createElement("div")).textContent = line;
      for (const place of places) {
        const ring = marks.appendChild(document.createElementNS(svg.namespaceURI, "circle"));
        for (const [name, value] of [["cx", place.left], ["cy", place.top], ["r", 4]]) ring.setAttribute(name, value);
      }
    }
    const box = figure.getBoundingClientRect();
    const [x, y] = [event.clientX - box.left, event.clientY - box.top];
    told.style.left = `${Math.max(0, Math.min(x + 14, svg.clientWidth - told.offsetWidth))}px`;
    told.style.top = `${y - told.offsetHeight > 14 ? y - told.offsetHeight - 14 : y + 14}px`; // a finger hides what is below
  };
  svg.addEventListener("pointermove", show);
  svg.addEventListener("pointerdown", show);
  svg.addEventListener("pointerleave", clear);
}
