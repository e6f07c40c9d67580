/* SPDX-License-Identifier: MIT */
/* Error over time as SVG. */

function svg(name, attributes, text) {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  for (const [key, value] of Object.entries(attributes))
    element.setAttribute(key, value);
  if (text !== undefined)
    element.textContent = text;
  return element;
}

/* Four to six round steps that hold all values. */
function ticksOf(low, high) {
  const step = niceCeiling((high - low || Math.abs(high) || 1) / 5), ticks = [];
  for (let i = Math.floor(low / step); i <= Math.ceil(high / step - 1e-9); i++)
    ticks.push(i * step);
  return ticks.length > 1 ? ticks : [ticks[0], ticks[0] + step];
}

/* Moves labels apart that would lie on each other. */
function spread(places, least) {
  const order = places.map((_, i) => i).sort((i, j) => places[i] - places[j]), out = [...places];
  for (let n = 1; n < order.length; n++)
    out[order[n]] = Math.max(out[order[n]], out[order[n - 1]] + least);
  return out;
}

function drawPlot() {
  const key = document.getElementById("metric").value, column = report.columns.find(c => c.key === key);
  const host = document.getElementById("plot"), methods = state.scene.methods;
  const values = methods.map(m => m.frames[key]), known = values.flat().filter(v => v !== null);
  if (!column || known.length === 0) {
    host.textContent = "This metric has no values here.";
    return;
  }
  const width = 960, left = 64, top = 14, right = 40 + 7.6 * Math.max(...methods.map(m => m.method.length));
  const ticks = ticksOf(Math.min(column.best === 0 ? 0 : Infinity, ...known), Math.max(...known));
  const inner = Math.max(250, 16 * methods.length), height = inner + 56;
  const x = frame => left + (width - left - right) * (report.frames.length > 1 ? frame / (report.frames.length - 1) : 0.5);
  const y = value => top + inner * (1 - (value - ticks[0]) / (ticks[ticks.length - 1] - ticks[0]));
  const root = svg("svg", {viewBox: `0 0 ${width} ${height}`, role: "img", "aria-label": `${column.title} of each frame, ${state.scene.name}`});
  for (const tick of ticks) {
    root.append(svg("line", {class: "axis", x1: left, x2: width - right, y1: y(tick), y2: y(tick)}));
    root.append(svg("text", {class: "tick", x: left - 8, y: y(tick) + 4, "text-anchor": "end"}, String(+tick.toPrecision(6))));
  }
  const every = Math.ceil(report.frames.length / 16);
  report.frames.forEach((number, frame) => {
    if (frame % every === 0)
      root.append(svg("text", {class: "tick", x: x(frame), y: top + inner + 20, "text-anchor": "middle"}, String(number)));
  });
  root.append(svg("text", {class: "tick", x: (left + width - right) / 2, y: top + inner + 40, "text-anchor": "middle"}, "frame"));
  root.append(svg("line", {class: "now", x1: x(state.frame), x2: x(state.frame), y1: top, y2: top + inner}));
  const ends = values.map(list => y([...list].reverse().find(v => v !== null) ?? ticks[0])), labels = spread(ends, 16);
  methods.forEach((method, m) => {
    const group = svg("g", {class: state.a === m + 1 ? "chosen" : ""}), color = methodColors[m % methodColors.length];
    const points = values[m].map((v, frame) => v === null ? null : [x(frame), y(v)]).filter(p => p);
    group.append(svg("polyline", {class: "line", stroke: color, points: points.map(p => p.map(v => v.toFixed(1)).join(",")).join(" ")}));
    for (const point of points)
      group.append(svg("circle", {cx: point[0].toFixed(1), cy: point[1].toFixed(1), r: 2.6, fill: color}));
    group.append(svg("line", {x1: width - right + 4, x2: width - right + 18, y1: ends[m], y2: labels[m], stroke: color}));
    group.append(svg("text", {x: width - right + 22, y: labels[m] + 4}, method.method));
    group.append(svg("title", {}, `${method.method}: ${shortNumber(method.scores[key])} over the clip`));
    root.append(group);
  });
  host.replaceChildren(root);
}
