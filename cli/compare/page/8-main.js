/* SPDX-License-Identifier: MIT */
/* Controls and keys. */

const control = id => document.getElementById(id);

function redraw() {
  drawStage();
  drawScale();
  drawStrips();
  showValues();
}

function setPictures(a, b) {
  state.a = Math.min(a, pictureCount() - 1);
  state.b = Math.min(b, pictureCount() - 1);
  control("a").value = String(state.a);
  control("b").value = String(state.b);
  markChosen();
  drawPlot();
  redraw();
}

function setMode(name) {
  state.mode = name;
  for (const button of control("modes").children)
    button.setAttribute("aria-pressed", String(button.dataset.mode === name));
  redraw();
}

function setFrame(frame) {
  state.frame = (frame + report.shown) % report.shown;
  control("frame").value = String(state.frame);
  control("frame-text").textContent = String(report.frames[state.frame]);
  drawPlot();
  drawStage();
  showValues();
}

function setExposure(stops) {
  state.exposure = Math.min(Math.max(stops, +control("exposure").min), +control("exposure").max);
  control("exposure").value = String(state.exposure);
  control("exposure-text").textContent = `${state.exposure > 0 ? "+" : ""}${state.exposure.toFixed(1)}`;
  drawStage();
  drawScale();
  drawStrips();
}

function setLayer(index) {
  state.layer = state.scene.layers[index];
  const middle = Math.round(state.layer.exposure);
  control("exposure").min = String(middle - 8);
  control("exposure").max = String(middle + 8);
  setExposure(state.layer.exposure);
  redraw();
}

function setScene(index) {
  state.scene = report.scenes[index];
  state.pixel = null;
  control("scene").value = String(index);
  control("layer").replaceChildren(...state.scene.layers.map((layer, i) => new Option(layer.name, i)));
  control("layer-label").style.display = state.scene.layers.length > 1 ? "" : "none";
  control("row").max = String(state.scene.height - 1);
  setView(1, [0.5, 0.5]);
  /* The sun's reflection is what it is all about: colour where there is a sky, coverage else. */
  control("layer").value = String(state.scene.layers.length - 1);
  setLayer(state.scene.layers.length - 1);
  setRow(Math.floor(0.6 * state.scene.height));
  showCommands();
  markChosen();
  drawPlot();
}

function showCommands() {
  control("command").textContent = report.command;
  const {command, second_command} = state.scene.reference, halves = second_command ? [["reference, second half", second_command]] : [];
  const entries = [["reference", command], ...halves, ...state.scene.methods.map(m => [m.method, m.command ?? `files ${m.external}`])];
  control("commands").replaceChildren(...entries.map(([name, command]) => {
    const block = document.createElement("pre");
    block.textContent = command;
    block.title = name;
    return block;
  }));
}

let playing = 0;
function togglePlay() {
  clearInterval(playing);
  playing = playing ? 0 : setInterval(() => setFrame(state.frame + 1), 125);
  control("play").textContent = playing ? "pause" : "play";
}

function onArrow(event) {
  const [dx, dy] = {ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1]}[event.key];
  if (event.shiftKey)
    setView(state.zoom, [state.center[0] + 0.1 * dx / state.zoom, state.center[1] + 0.1 * dy / state.zoom]);
  else if (dx && !event.target.matches("input"))
    setFrame(state.frame + dx);
  else
    return false;
  return true;
}

function onKey(event) {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.matches("select"))
    return;
  const mode = modes.find(m => m.key === event.key);
  let used = true;
  if (mode)
    setMode(mode.name);
  else if (/^[0-9]$/.test(event.key) && +event.key < pictureCount())
    setPictures(+event.key, state.b);
  else if (event.key.startsWith("Arrow"))
    used = onArrow(event);
  else
    switch (event.key) {
    case "x": setPictures(state.b, state.a); break;
    case "r": setView(1, [0.5, 0.5]); break;
    case "+": case "=": zoomAbout(null, 2); break;
    case "-": zoomAbout(null, 0.5); break;
    case "[": setExposure(state.exposure - 0.5); break;
    case "]": setExposure(state.exposure + 0.5); break;
    case " ":
      used = !event.target.matches("button, input");
      if (used)
        togglePlay();
      break;
    default: used = false;
    }
  if (used)
    event.preventDefault();
}

function prepareModes() {
  for (const mode of modes) {
    const button = document.createElement("button");
    Object.assign(button, {type: "button", textContent: mode.text, title: `${mode.help} (${mode.key})`});
    button.dataset.mode = mode.name;
    button.addEventListener("click", () => setMode(mode.name));
    control("modes").append(button);
  }
}

function start() {
  document.documentElement.classList.add("scripted");
  if (typeof DecompressionStream === "undefined") {
    control("stage-frame").textContent = "This browser has no DecompressionStream and cannot unpack the pictures; the table is complete.";
    return;
  }
  prepareTable();
  prepareModes();
  const choice = (picture, name) => new Option(picture < 10 ? `${name} (${picture})` : name, picture);
  for (const id of ["a", "b"])
    control(id).append(...Array.from({length: pictureCount()}, (_, picture) => choice(picture, pictureName(picture))));
  control("scene").append(...report.scenes.map(s => new Option(s.name, s.index)));
  control("metric").append(...report.columns.map(c => new Option(c.title, c.key)));
  control("frame").max = String(report.shown - 1);
  control("shown-note").textContent = report.shown < report.frames.length
    ? `The page holds the pictures of the first ${report.shown} of ${report.frames.length} frames; the figures are of all.` : "";
  const on = (id, event, act) => control(id).addEventListener(event, act);
  on("scene", "change", event => setScene(+event.target.value));
  on("layer", "change", event => setLayer(+event.target.value));
  on("a", "change", event => setPictures(+event.target.value, state.b));
  on("b", "change", event => setPictures(state.a, +event.target.value));
  on("swap", "click", () => setPictures(state.b, state.a));
  on("frame", "input", event => setFrame(+event.target.value));
  on("play", "click", togglePlay);
  on("exposure", "input", event => setExposure(+event.target.value));
  on("reset", "click", () => setView(1, [0.5, 0.5]));
  on("row", "input", event => setRow(+event.target.value));
  on("metric", "change", drawPlot);
  addEventListener("keydown", onKey);
  addEventListener("resize", redraw);
  matchMedia("(prefers-color-scheme: dark)").addEventListener("change", redraw);
  setScene(0);
  setMode("flip");
  setPictures(state.a, 0);
  setFrame(0);
}

start();
