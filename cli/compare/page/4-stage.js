/* SPDX-License-Identifier: MIT */
/* The stage: panes of pictures that share one zoom, and what lies under the pointer. */

const modes = [
  {name: "flip", key: "f", text: "Flip", help: "A alone; the keys 0 to 9 flip through the pictures"},
  {name: "side", key: "s", text: "Side by side", help: "A and B"},
  {name: "wipe", key: "w", text: "Wipe", help: "A left, B right of the line under the pointer"},
  {name: "all", key: "g", text: "All", help: "the reference and every method"},
  {name: "difference", key: "d", text: "Difference", help: "A − B, blue below, red above"},
  {name: "error", key: "e", text: "Error", help: "|A − reference| in false colours"},
  {name: "flicker", key: "k", text: "Flicker", help: "A's frame steps against the reference's, in false colours"},
];

const stage = document.getElementById("stage");
const stageContext = stage.getContext("2d");
let panes = []; /* of the last drawing, in CSS pixels */

/* What each pane holds. */
function paneContents() {
  const {mode, a, b} = state;
  if (mode === "side")
    return [{kind: "plain", picture: a}, {kind: "plain", picture: b}];
  if (mode === "all")
    return Array.from({length: pictureCount()}, (_, picture) => ({kind: "plain", picture}));
  if (mode === "wipe")
    return [{kind: "plain", picture: a, over: {kind: "plain", picture: b}}];
  return [{kind: mode === "flip" ? "plain" : mode, picture: a}];
}

function paneLabel(content) {
  const a = pictureName(content.picture);
  switch (content.kind) {
  case "difference": return `${a} − ${pictureName(state.b)}`;
  case "error": return `| ${a} − reference |`;
  case "flicker": return `flicker of ${a}`;
  default: return content.over ? `${a}  │  ${pictureName(content.over.picture)}` : a;
  }
}

/* ---- pictures as bytes ---- */

const rasterCache = new Map();

function rasterKey(view, content) {
  const base = [content.kind, view.scene.index, view.layer.name, content.picture, view.exposure];
  if (content.kind === "plain")
    return [...base, view.frame].join(" ");
  return [...base, content.kind === "flicker" ? "" : view.frame, content.kind === "difference" ? view.b : ""].join(" ");
}

function plainBytes(out, {layer, exposure}, bits) {
  const channels = layer.channels, table = displayBytes(2 ** exposure / layer.scale), pixels = out.length / 4;
  for (let i = 0; i < pixels; i++)
    for (let c = 0; c < 3; c++)
      out[4 * i + c] = table[bits[channels === 3 ? 3 * i + c : channels * i]];
}

function putColor(out, i, color) {
  out[4 * i] = color[0];
  out[4 * i + 1] = color[1];
  out[4 * i + 2] = color[2];
}

async function fillBytes(out, view, content) {
  if (content.kind === "plain") {
    plainBytes(out, view, await loadBits(view, content.picture, view.frame));
    return;
  }
  const scale = await scaleEnd(view, content.kind === "flicker" ? "flicker" : "error");
  const shade = value => errorTable[Math.min(255, Math.round(255 * value / scale))];
  if (content.kind === "flicker") {
    (await flickerMap(view, content.picture)).forEach((value, i) => putColor(out, i, shade(value)));
    return;
  }
  const signed = content.kind === "difference";
  const [a, b] = await Promise.all([loadBits(view, content.picture, view.frame), loadBits(view, signed ? view.b : 0, view.frame)]);
  forEachDifference(view.layer, a, b, (i, mean, rms) =>
    putColor(out, i, signed ? differenceTable[255 + Math.round(255 * Math.min(Math.max(mean / scale, -1), 1))] : shade(rms)));
}

function raster(view, content) {
  const key = rasterKey(view, content);
  if (rasterCache.has(key))
    return rasterCache.get(key);
  if (rasterCache.size > 80)
    rasterCache.delete(rasterCache.keys().next().value);
  const {width, height} = view.scene;
  const promise = (async () => {
    const canvas = document.createElement("canvas");
    canvas.width = width;
    canvas.height = height;
    const context = canvas.getContext("2d"), image = context.createImageData(width, height);
    await fillBytes(image.data, view, content);
    for (let i = 3; i < image.data.length; i += 4)
      image.data[i] = 255;
    context.putImageData(image, 0, 0);
    return canvas;
  })();
  rasterCache.set(key, promise);
  return promise;
}

/* ---- drawing ---- */

function layOut(count, width) {
  const columns = count === 1 ? 1 : count === 2 ? 2 : Math.ceil(Math.sqrt(count)), rows = Math.ceil(count / columns), gap = count > 1 ? 4 : 0;
  const paneWidth = (width - gap * (columns - 1)) / columns;
  const paneHeight = Math.min(paneWidth * state.scene.height / state.scene.width, 0.78 * innerHeight / Math.min(rows, 2));
  return {
    height: rows * paneHeight + gap * (rows - 1),
    rectangles: Array.from({length: count}, (_, i) => ({
      x: i % columns * (paneWidth + gap), y: Math.floor(i / columns) * (paneHeight + gap), width: paneWidth, height: paneHeight})),
  };
}

/* CSS pixels of a picture's pixel; the same in all panes. */
function pixelSize(pane) {
  return state.zoom * Math.min(pane.width / state.scene.width, pane.height / state.scene.height);
}

function origin(pane) {
  const size = pixelSize(pane);
  const [x, y] = state.center;
  return [pane.x + pane.width / 2 - x * state.scene.width * size, pane.y + pane.height / 2 - y * state.scene.height * size];
}

function drawNumbers(pane, picture, bits) {
  const size = pixelSize(pane), channels = state.layer.channels, [x0, y0] = origin(pane), unit = 1 / state.layer.scale;
  if (size < (channels === 3 ? 44 : 38))
    return;
  const first = [Math.floor((pane.x - x0) / size), Math.floor((pane.y - y0) / size)];
  const last = [Math.floor((pane.x + pane.width - x0) / size), Math.floor((pane.y + pane.height - y0) / size)];
  const table = displayBytes(2 ** state.exposure / state.layer.scale);
  stageContext.font = `${Math.min(13, size / 4.2)}px ui-monospace, "DejaVu Sans Mono", monospace`;
  stageContext.textAlign = "center";
  stageContext.textBaseline = "middle";
  for (let y = Math.max(first[1], 0); y <= Math.min(last[1], state.scene.height - 1); y++)
    for (let x = Math.max(first[0], 0); x <= Math.min(last[0], state.scene.width - 1); x++) {
      const i = channels * (y * state.scene.width + x);
      stageContext.fillStyle = table[bits[i + (channels === 3 ? 1 : 0)]] > 130 ? "#000" : "#fff";
      for (let c = 0; c < channels; c++)
        stageContext.fillText((halfValues[bits[i + c]] * unit).toPrecision(3), x0 + (x + 0.5) * size,
          y0 + (y + 0.5 + (c - (channels - 1) / 2) * 0.26) * size);
    }
}

function drawLabel(pane, text) {
  stageContext.font = "600 13px system-ui, sans-serif";
  stageContext.textAlign = "left";
  stageContext.textBaseline = "alphabetic";
  const width = stageContext.measureText(text).width;
  stageContext.fillStyle = "rgba(0, 0, 0, .62)";
  stageContext.fillRect(pane.x + 6, pane.y + 6, width + 14, 22);
  stageContext.fillStyle = "#fff";
  stageContext.fillText(text, pane.x + 13, pane.y + 21);
}

function drawRaster(pane, canvas, fromX) {
  const size = pixelSize(pane), [x0, y0] = origin(pane);
  stageContext.save();
  stageContext.beginPath();
  stageContext.rect(pane.x + fromX, pane.y, pane.width - fromX, pane.height);
  stageContext.clip();
  stageContext.imageSmoothingEnabled = size < 1;
  stageContext.drawImage(canvas, x0, y0, size * state.scene.width, size * state.scene.height);
  stageContext.restore();
}

function drawPixelFrame(pane) {
  if (!state.pixel)
    return;
  const size = pixelSize(pane), [x0, y0] = origin(pane);
  const x = x0 + state.pixel[0] * size, y = y0 + state.pixel[1] * size, reach = Math.max(size, 5), shift = (reach - size) / 2;
  if (x < pane.x || y < pane.y || x + size > pane.x + pane.width || y + size > pane.y + pane.height)
    return;
  stageContext.lineWidth = 1;
  stageContext.strokeStyle = "#000";
  stageContext.strokeRect(x - shift - 1.5, y - shift - 1.5, reach + 3, reach + 3);
  stageContext.strokeStyle = "#fff";
  stageContext.strokeRect(x - shift - 0.5, y - shift - 0.5, reach + 1, reach + 1);
}

/* Only the last of several calls draws. */
let drawing = 0;
async function drawStage() {
  const turn = ++drawing, contents = paneContents(), view = {...state};
  stage.setAttribute("aria-busy", "true");
  const loaded = await Promise.all(contents.map(content => Promise.all([
    raster(view, content), content.over ? raster(view, content.over) : null,
    content.kind === "plain" ? loadBits(view, content.picture, view.frame) : null])));
  if (turn !== drawing)
    return;
  const ratio = devicePixelRatio || 1, width = stage.parentElement.clientWidth, layout = layOut(contents.length, width);
  stage.style.height = `${layout.height}px`;
  stage.width = Math.round(width * ratio);
  stage.height = Math.round(layout.height * ratio);
  stageContext.setTransform(ratio, 0, 0, ratio, 0, 0);
  panes = layout.rectangles;
  contents.forEach((content, i) => {
    const pane = panes[i], [canvas, over, bits] = loaded[i];
    stageContext.save();
    stageContext.beginPath();
    stageContext.rect(pane.x, pane.y, pane.width, pane.height);
    stageContext.clip();
    drawRaster(pane, canvas, 0);
    if (bits && !over)
      drawNumbers(pane, content.picture, bits);
    if (over) {
      drawRaster(pane, over, state.wipe * pane.width);
      stageContext.fillStyle = "#fff";
      stageContext.fillRect(pane.x + state.wipe * pane.width - 0.5, pane.y, 1, pane.height);
    }
    drawPixelFrame(pane);
    drawLabel(pane, paneLabel(content));
    stageContext.restore();
  });
  stage.dataset.shown = contents.map(paneLabel).join(" / ");
  stage.setAttribute("aria-label", `${stage.dataset.shown}, ${state.scene.name}, frame ${report.frames[state.frame]}`);
  stage.dataset.drawn = String(turn);
  stage.setAttribute("aria-busy", "false");
}

/* ---- the scale of false colours ---- */

let scaling = 0;
async function drawScale() {
  const turn = ++scaling;
  const canvas = document.getElementById("scale"), colored = ["difference", "error", "flicker"].includes(state.mode);
  canvas.style.display = colored ? "block" : "none";
  if (!colored)
    return;
  const signed = state.mode === "difference", end = await scaleEnd({...state}, state.mode === "flicker" ? "flicker" : "error");
  if (turn !== scaling)
    return;
  const ratio = devicePixelRatio || 1, width = canvas.parentElement.clientWidth, context = canvas.getContext("2d");
  const table = signed ? differenceTable : errorTable, bar = Math.min(420, width - 40), start = 20;
  canvas.width = Math.round(width * ratio);
  canvas.height = Math.round(34 * ratio);
  canvas.style.height = "34px";
  context.setTransform(ratio, 0, 0, ratio, 0, 0);
  for (let x = 0; x < bar; x++) {
    context.fillStyle = `rgb(${table[Math.floor(x / bar * table.length)].join(",")})`;
    context.fillRect(start + x, 0, 1.5, 12);
  }
  const ink = getComputedStyle(document.documentElement).getPropertyValue("--ink");
  context.fillStyle = ink;
  context.font = "12px system-ui, sans-serif";
  context.textAlign = "center";
  for (let i = 0; i <= 4; i++) {
    const value = signed ? (i / 2 - 1) * end : i / 4 * end;
    context.fillRect(start + i / 4 * bar - 0.5, 12, 1, 4);
    context.fillText(String(+value.toPrecision(3)), start + i / 4 * bar, 29);
  }
  context.textAlign = "left";
  if (width > bar + 260)
    context.fillText(`${state.layer.name}; one scale for all methods of ${state.scene.name}; the exposure moves it`, start + bar + 18, 11);
  canvas.dataset.end = String(end);
}

/* ---- the pointer ---- */

/* The pane and the picture's pixel at a place of the stage; null outside. */
function pixelAt(event) {
  const box = stage.getBoundingClientRect(), px = event.clientX - box.left, py = event.clientY - box.top;
  const pane = panes.find(p => px >= p.x && px < p.x + p.width && py >= p.y && py < p.y + p.height);
  if (!pane)
    return null;
  const [x0, y0] = origin(pane), size = pixelSize(pane), x = (px - x0) / size, y = (py - y0) / size;
  return {pane, px, py, x, y, inside: x >= 0 && y >= 0 && x < state.scene.width && y < state.scene.height};
}

/* Zooms about a place of the picture, which stays where it is on the stage. */
function zoomAbout(place, factor) {
  const zoom = Math.min(Math.max(state.zoom * factor, 1), 256), fraction = 1 - state.zoom / zoom;
  const at = place ? [place.x / state.scene.width, place.y / state.scene.height] : state.center;
  setView(zoom, state.center.map((c, i) => c + (at[i] - c) * fraction));
}

function setView(zoom, center) {
  state.zoom = zoom;
  state.center = center.map(c => Math.min(Math.max(c, 0.5 / zoom), 1 - 0.5 / zoom));
  stage.dataset.zoom = zoom.toFixed(3);
  document.getElementById("zoom-text").textContent = `${zoom.toFixed(zoom < 10 ? 1 : 0)}×`;
  drawStage();
}

let dragged = null; /* where a drag began */

stage.addEventListener("wheel", event => {
  event.preventDefault();
  zoomAbout(pixelAt(event), Math.exp(-event.deltaY * (event.deltaMode ? 0.06 : 0.0022)));
}, {passive: false});

stage.addEventListener("pointerdown", event => {
  const place = pixelAt(event);
  if (!place || event.button !== 0)
    return;
  stage.setPointerCapture(event.pointerId);
  dragged = {x: event.clientX, y: event.clientY, center: [...state.center], moved: false, place};
});

stage.addEventListener("pointermove", event => {
  if (dragged && event.buttons & 1) {
    const size = pixelSize(dragged.place.pane), dx = event.clientX - dragged.x, dy = event.clientY - dragged.y;
    dragged.moved ||= Math.hypot(dx, dy) > 4;
    if (dragged.moved && state.zoom > 1)
      setView(state.zoom, [dragged.center[0] - dx / size / state.scene.width, dragged.center[1] - dy / size / state.scene.height]);
    return;
  }
  const place = pixelAt(event);
  if (place && state.mode === "wipe") {
    state.wipe = (place.px - place.pane.x) / place.pane.width;
    stage.dataset.wipe = state.wipe.toFixed(3);
  }
  state.pixel = place && place.inside ? [Math.floor(place.x), Math.floor(place.y)] : state.pixel;
  showValues();
  drawStage();
});

stage.addEventListener("pointerup", () => {
  if (dragged && !dragged.moved && dragged.place.inside)
    setRow(Math.floor(dragged.place.y));
  dragged = null;
});

/* ---- values under the pointer ---- */

async function showValues() {
  const table = document.getElementById("values"), pixel = state.pixel, view = {...state};
  if (!pixel) {
    table.innerHTML = "<caption>Point at a pixel to read its values.</caption>";
    return;
  }
  const channels = state.layer.channels, at = channels * (pixel[1] * state.scene.width + pixel[0]), unit = 1 / state.layer.scale;
  const values = await Promise.all(Array.from({length: pictureCount()}, async (_, picture) => {
    const bits = await loadBits(view, picture, view.frame);
    return Array.from({length: channels}, (unused, c) => halfValues[bits[at + c]] * unit);
  }));
  if (pixel !== state.pixel || view.scene !== state.scene || view.layer !== state.layer || view.frame !== state.frame)
    return;
  const unitName = channels === 3 ? "kcd/m², R G B" : "coverage";
  const rows = values.map((value, picture) => {
    const numbers = value.map(v => `<td>${shortNumber(v)}</td>`).join("");
    const off = picture ? value.map((v, c) => `<td>${(v - values[0][c] >= 0 ? "+" : "−") + shortNumber(Math.abs(v - values[0][c]))}</td>`).join("")
      : `<td class="reference" colspan="${channels}">–</td>`;
    return `<tr${picture ? "" : " class=\"reference\""}><th scope="row">${pictureName(picture)}</th>${numbers}${off}</tr>`;
  });
  const place = `x ${pixel[0]}, y ${pixel[1]}, frame ${report.frames[state.frame]}`;
  table.innerHTML = `<caption>${place}: ${unitName}, and the error</caption><tbody>${rows.join("")}</tbody>`;
  table.dataset.pixel = pixel.join(",");
}
