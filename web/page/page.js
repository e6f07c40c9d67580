// SPDX-License-Identifier: MIT
// The page: which pictures are drawn, how large, and when.

const element = id => document.getElementById(id);
const FIRST_PIXELS = 16e3; // of the first picture, before any time is known
const LEAST_PIXELS = 8e3; // of a moving picture, however long it takes
const JUDGED_PIXELS = 16e3;
const SWELL_WAVES = 24; // of a swell, where none says how many
const page = {
  settings: presets(), methods: ["none", "mangata"], wipe: 0.5, playing: true, frames: 0,
  dirty: true, version: 0, // of what is to be seen
  scale: 0,                // pixels of a moving picture over the window's, each way
  way: "lanes", took: [], costs: {}, histories: [null, null], figures: [],
};
const say = text => { element("said").textContent = text; };

// A word over the picture; "" takes it away.
function tell(text) {
  if (element("word").textContent === text) return;
  element("word").textContent = text;
  element("word").hidden = !text;
}

function setPlaying(playing) {
  page.playing = playing;
  element("play").textContent = playing ? "Pause" : "Play";
  element("play").setAttribute("aria-pressed", String(playing));
  changed();
}

// ---- pictures ----

// Width and height of a picture; scale(): its pixels over the window's, each way. The first call decides page.scale.
function sizes(scale) {
  const canvas = element("canvas"), ratio = Math.min(devicePixelRatio || 1, 2);
  const width = Math.max(64, Math.round(canvas.clientWidth * ratio)), height = Math.max(36, Math.round(canvas.clientHeight * ratio));
  page.leastScale = Math.min(1, Math.sqrt(LEAST_PIXELS / (width * height)));
  page.scale = page.scale || Math.min(1, Math.sqrt(FIRST_PIXELS / (width * height)));
  return [Math.max(64, Math.round(width * scale())), Math.max(36, Math.round(height * scale()))];
}

// Two targets of a size. What page[name] has had of another size is discarded.
function targets(name, width, height) {
  const { engine } = page.view, old = page[name];
  if (old && old[0].width === width && old[0].height === height) return old;
  if (old) old.forEach(t => engine.discard(t));
  return (page[name] = [engine.target(width, height), engine.target(width, height)]);
}

// The history of a side's taa while pictures follow each other; anew where more than the time has changed.
function historyOf(side, width, height) {
  const { engine } = page.view, key = JSON.stringify([{ ...page.settings, time: 0 }, width, height]), old = page.histories[side];
  if (old && old.key === key) return old;
  if (old) [old.current, ...old.pictures].forEach(t => engine.discard(t));
  return (page.histories[side] = { ...engine.history(width, height), key });
}

// Both methods' pictures into two targets; null where stale() was true before they were whole. Of moving pictures there is what the wipe shows.
async function paintBoth(both, settings, { moving = false, stale } = {}) {
  const methods = [...page.methods], pictures = [];
  for (const side of [0, 1]) {
    const target = both[side];
    if (side === 1 && methods[0] === methods[1]) { pictures[1] = pictures[0]; break; }
    const { width } = target, edge = page.wipe * width, columns = !moving || methods[0] === methods[1] ? undefined : side ? [Math.max(0, Math.floor(edge) - 1), width] : [0, Math.min(width, Math.ceil(edge) + 1)];
    const history = moving && METHODS[methods[side]].blends ? historyOf(side, target.width, target.height) : undefined;
    if (!await paint(page.view, methods[side], settings, target, { way: page.way, history, columns, stale })) return null;
    pictures[side] = target;
  }
  return pictures;
}

// The canvas gets the pictures' size.
function show() {
  if (!page.pictures) return;
  const [first, second] = page.pictures, { engine, canvas } = page.view, { width, height } = first;
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  engine.show(first, second, page.wipe);
}

// Shows what was painted into page.spare. `settled`: the version of what is to be seen, where the pictures are whole; else 0.
async function take(pictures, settled) {
  [page.spare, page.shown] = [page.shown, page.spare];
  page.pictures = pictures;
  page.settled = settled;
  show();
  await page.view.engine.finished();
  page.frames++;
}

function tellProgress(fraction) {
  if (fraction === 1) tell("");
  else if (page.mapBegun === undefined) page.mapBegun = performance.now();
  else if (performance.now() - page.mapBegun > 400) tell(`The map of slopes of leadr is being made: ${Math.round(100 * fraction)} %`);
  if (fraction === 1) page.mapBegun = undefined;
}

// ---- moving pictures: as many pixels as hold 30 frames a second ----

async function drawMoving() {
  const [width, height] = sizes(() => page.scale), way = page.way;
  page.dirty = false;
  page.judge.stop();
  const start = performance.now();
  await take(await paintBoth(targets("spare", width, height), { ...page.settings }, { moving: true }), 0);
  page.firstPicture = page.firstPicture || performance.now();
  adapt(way, performance.now() - start, width * height);
  chooseWay();
}

function adapt(way, took, pixels) {
  page.took.push(took / pixels);
  const middle = page.took.toSorted((a, b) => a - b)[page.took.length >> 1];
  page.costs[way] = middle;
  page.middle = middle * pixels;
  if (page.took.length < 5 && page.frames > 2) return; // the first pictures say at once how many pixels there can be
  page.took = [];
  const wanted = Math.min(1, Math.max(page.leastScale, page.scale * Math.sqrt(28 / page.middle)));
  if (!page.recorder && (wanted < page.scale * 0.85 || wanted > page.scale * 1.2 || wanted === 1)) page.scale = wanted; // films keep their size
}

// Workers draw until the shaders are compiled. Then the faster of both does, but for WebGL2 that the CPU draws: there workers do.
function chooseWay() {
  const { engine } = page.view, key = page.methods.join(), { choppiness, foam, waves, swell } = page.settings;
  const water = { choppy: choppiness > 0, foamy: choppiness > 0 && foam > 0, waves: waves + (swell > 0 ? SWELL_WAVES : 0) };
  if (engine.byCpu || page.chosenFor === key) return;
  if (page.triedFor === key) {
    if (--page.trial > 0) return;
    page.chosenFor = key;
    if (page.costs.lanes < page.costs.shaders) page.way = "lanes";
    return;
  }
  page.way = page.methods.map(method => engine.isReady(engine.methodProgram(METHODS[method].blends ? "none" : method, water))).every(Boolean) ? "shaders" : "lanes";
  page.took = [];
  if (page.way === "lanes") return;
  page.triedFor = key;
  page.trial = 12; // pictures
}

// ---- pictures at rest: they sharpen, and brute force judges them ----

async function rest() {
  if (!page.pictures) return drawMoving(); // none could be drawn yet
  const { version } = page, stale = () => page.version !== version, full = sizes(() => 1), now = page.pictures[0];
  if (now.width < full[0] || page.settled !== version) {
    const [width, height] = sizes(() => Math.min(1, 2 * now.width / full[0]));
    const pictures = await paintBoth(targets("spare", width, height), { ...page.settings }, { stale });
    if (!pictures) return;
    await take(pictures, version);
    if (width === full[0]) say("the picture is sharp");
  } else if (page.judgedFor !== version) {
    page.judgedFor = version;
    await judge(256, 1, stale);
  } else {
    await pause(50);
  }
}

// Small pictures of both methods at two instants a frame apart, and the judge's word on them.
async function judge(most, duty, stale) {
  const { view } = page, [columns, rows] = sizes(() => (page.playing ? page.scale : 1)), shrink = Math.min(1, Math.sqrt(JUDGED_PIXELS / (columns * rows)));
  const both = targets("small", Math.round(columns * shrink), Math.round(rows * shrink)), { width, height } = both[0];
  const settings = [{ ...page.settings }, { ...page.settings, time: page.settings.time + 1 / 30 }], methods = [...page.methods], pictures = [[], []];
  for (const instant of [0, 1]) {
    const painted = await paintBoth(both, settings[instant], { stale });
    if (!painted) return;
    painted.forEach((picture, side) => { pictures[side][instant] = view.engine.read(picture); });
  }
  page.judge.begin({ settings, width, height, pictures, most, duty }, (sides, samples) => {
    const times = (ratio, bound) => (Number.isFinite(ratio) ? `${bound ? "≤" : "×"} ${ratio.toFixed(2)}` : "?");
    page.meters = sides.map(f => [`flicker ${times(f.flicker, f.bounds.flicker)}`, `energy ${times(f.energy, false)}`, `contrast ${times(f.contrast, f.bounds.contrast)}`, `error ${f.error.toFixed(3)}`]);
    page.figures = [...page.meters.map((meter, side) => `${methods[side]}: ${meter.join(", ")}`), `over those of brute force, ${samples} samples a pixel of ${width} × ${height}`];
    showFigures();
    placeWipe();
  }).catch(error => tell(error.message));
}

function showFigures() {
  const t = page.pictures && page.pictures[0], ways = { lanes: "WebAssembly", shaders: "WebGL2" };
  element("figures").textContent = [...(t ? [`${t.width} × ${t.height} by ${ways[page.way]}, ${page.middle.toFixed(0)} ms a moving picture`] : []), ...page.figures].join("\n");
}

// ---- the loop ----

async function step(now) {
  const passed = Math.min(0.1, (now - (page.clock || now)) / 1000);
  page.clock = now;
  if (!page.playing && !page.dirty) return rest();
  if (page.playing) page.settings.time = Number(((page.settings.time + passed) % 3600).toFixed(3));
  if (page.playing && page.frames > 30 && page.judge.idle) await judge(16, navigator.hardwareConcurrency > 4 ? 1 : 0.25);
  await drawMoving();
  tell("");
  if (page.frames % 10 === 1) { placeWipe(); showTime(); showFigures(); }
}

async function loop() {
  for (;;) {
    const now = await new Promise(requestAnimationFrame);
    try {
      await step(now);
    } catch (error) {
      tell(error.message);
      page.dirty = false;
      await pause(200);
    }
  }
}

// Without WebGL2: one picture by the workers.
async function drawStill(lanes, reason) {
  document.body.classList.add("still");
  const word = `This is a still picture: ${reason}. The command below renders it, and films.`, old = element("canvas"), canvas = old.cloneNode();
  old.replaceWith(canvas); // a canvas that had a context of another kind has no 2D one
  page.playing = false;
  for (const option of element("right").options) option.disabled = !METHODS[option.value].byLanes;
  if (!METHODS[page.methods[1]].byLanes) { page.methods[1] = "mangata"; changed(); }
  for (;; await pause(100)) {
    if (!page.dirty) continue;
    const { version } = page, width = 640, height = Math.round(640 * canvas.clientHeight / Math.max(canvas.clientWidth, 1)) || 360, method = page.methods[1];
    page.dirty = false;
    try {
      const picture = await lanes.pixels({ method, settings: page.settings, width, height }, () => page.version !== version, true);
      if (!picture) continue;
      Object.assign(canvas, { width, height });
      canvas.getContext("2d").putImageData(new ImageData(picture.data, width, height), 0, 0);
      page.firstPicture = page.firstPicture || performance.now();
      tell(word);
    } catch (error) {
      tell(error.message);
    }
  }
}

async function start() {
  takeLink();
  buildControls();
  buildGestures();
  buildExports();
  fold();
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) setPlaying(false);
  changed();
  placeWipe();
  const { texts, module } = await unpacked(), lanes = new Lanes(module), { calls } = await openLibrary(module);
  try {
    page.view = { canvas: element("canvas"), lanes, engine: new Engine(element("canvas"), lanes, texts, calls) };
  } catch (error) {
    drawStill(lanes, error.message);
    return;
  }
  page.judge = new Judge(module);
  page.view.engine.progress = tellProgress;
  element("canvas").addEventListener("webglcontextlost", event => { event.preventDefault(); location.reload(); });
  await page.view.engine.compiled(page.view.engine.program("display.frag", "", "", ""));
  loop();
}

if (location.hash !== "#still") start();
