// SPDX-License-Identifier: MIT
// Pictures of a scene in a canvas; the four functions for other pages.

function presets() { return Object.fromEntries(SETTINGS.map(s => [s.name, s.preset])); }

// What draws in a canvas. `way`: "shaders" of its WebGL2, or "lanes", the library in WebAssembly, which is faster where the CPU does WebGL2's work.
// Rejects with a text where WebGL2 is missing. Its workers stay until destroy().
async function create(canvas) {
  if (!canvas || !canvas.getContext) throw new Error("create() needs a canvas");
  const { texts, module } = await unpacked(), library = await openLibrary(module), lanes = new Lanes(module);
  const newEngine = () => new Engine(canvas, lanes, texts, library.calls);
  let engine;
  try {
    engine = newEngine();
  } catch (error) {
    lanes.end();
    throw error;
  }
  const view = { canvas, lanes, engine, library, way: engine.byCpu ? "lanes" : "shaders", settings: presets(), last: Promise.resolve() };
  // Without preventDefault() a browser never gives a lost context back. What it held is gone.
  view.listeners = {
    webglcontextlost: event => { event.preventDefault(); view.engine.gone = true; },
    webglcontextrestored: () => { view.target = null; view.engine = newEngine(); },
  };
  for (const name in view.listeners) canvas.addEventListener(name, view.listeners[name]);
  return view;
}

// Ends a view: its workers, and what it holds in the canvas's WebGL2. A picture that is being drawn is given up: its promise rejects. Resolves when all is
// done.
function destroy(view) {
  if (view.destroyed) return view.last;
  const free = () => { if (view.target) view.engine.discard(view.target); view.engine.free(); };
  view.destroyed = view.engine.gone = true;
  for (const name in view.listeners) view.canvas.removeEventListener(name, view.listeners[name]);
  view.lanes.end();
  return (view.last = view.last.then(free, free));
}

const quoted = value => (typeof value === "string" ? JSON.stringify(value) : String(value));

// Throws where a value is none of a setting's. A setting without a unit whose step is 1 or more is a whole number.
function checkSetting({ name, unit, least, most, step }, value) {
  const whole = unit === "" && step >= 1;
  if (typeof value === "number" && value >= least && value <= most && (!whole || Number.isInteger(value))) return;
  const kind = whole ? "whole number" : "number", units = unit === "°" || unit === "" ? unit : " " + unit;
  throw new Error(`${name} is ${quoted(value)}; allowed: a ${kind} from ${least} to ${most}${units}`);
}

// Changes settings by name. Throws where there is no such setting, no such value of one, or no such sea; then all stay as they were.
function setScene(view, changes) {
  for (const name in changes) {
    const setting = SETTINGS.find(s => s.name === name);
    if (!setting) throw new Error(`there is no setting ${name}; allowed: ${SETTINGS.map(s => s.name).join(", ")}`);
    checkSetting(setting, changes[name]);
  }
  const settings = { ...view.settings, ...changes };
  view.library.checkSea(settings);
  view.settings = settings;
}

const WAYS = ["shaders", "lanes"], MOST_TIME = 1e8; // seconds, as in scene files

function checkPicture(view, method, time, way) {
  if (view.destroyed) throw new Error("the view has been destroyed");
  if (!Object.hasOwn(METHODS, method)) throw new Error(`there is no method ${quoted(method)}; allowed: ${Object.keys(METHODS).join(", ")}`);
  if (typeof time !== "number" || !(Math.abs(time) <= MOST_TIME)) throw new Error(`time is ${quoted(time)}; allowed: a number from -1e8 to 1e8 s`);
  if (way && !WAYS.includes(way)) throw new Error(`there is no way ${quoted(way)}; allowed: ${WAYS.join(", ")}`);
}

// Throws where what `engine` draws is not to be seen.
function checkEngine(view, engine) {
  if (view.destroyed) throw new Error("the view has been destroyed");
  const lost = view.engine !== engine || engine.gl.isContextLost();
  if (lost) throw new Error("the canvas has lost its WebGL context; pictures can be drawn again after its event webglcontextrestored");
}

// Draws the scene by a method at a time in seconds and shows it. Resolves when it is drawn; one picture of a view is drawn at a time. A canvas that is resized
// meanwhile shows the picture stretched and keeps its size, which the next picture has.
function render(view, { method = "mangata", time = view.settings.time, ...options } = {}) {
  try {
    checkPicture(view, method, time, options.way);
  } catch (error) {
    return Promise.reject(error);
  }
  const settings = { ...view.settings, time };
  const draw = async engine => {
    const { width, height } = view.canvas;
    if (!view.target || view.target.width !== width || view.target.height !== height) {
      if (view.target) engine.discard(view.target);
      view.target = engine.target(width, height);
    }
    const { target } = view;
    await paint(view, method, settings, target, options);
    await engine.compiled(engine.program("display.frag", "", "", ""));
    engine.show(target);
    await engine.finished();
  };
  const next = async () => {
    const { engine } = view, check = () => checkEngine(view, engine);
    check();
    await draw(engine).finally(check);
  };
  return (view.last = view.last.then(next, next));
}

// Draws one picture into a target; `options`: way, jitter and sorted as engine.draw() has them, columns of pixels that matter, a history, and stale(). False: stale() was true, and the picture is not whole.
async function paint(view, method, settings, target, options = {}) {
  const { engine, lanes } = view;
  if (METHODS[method].blends) return paintBlended(view, settings, target, options);
  if ((options.way || view.way) === "shaders" || !METHODS[method].byLanes) return engine.draw(method, target, settings, options);
  const { jitter, columns, stale } = options, { width, height } = target;
  const picture = await lanes.pixels({ method, settings, width, height, jitter, columns }, stale);
  if (!picture) return false;
  engine.put(target, picture);
  return true;
}

// A picture of taa: with a history of its own, or as the newest frame of `options.history`.
async function paintBlended(view, settings, target, { history, ...options }) {
  const { engine } = view, own = history ? null : engine.history(target.width, target.height), h = history || own, frames = own ? TAA_FRAMES : 1;
  let whole = true;
  try {
    for (let frame = 0; frame < frames && whole; frame++) {
      const time = settings.time - (frames - 1 - frame) / 30;
      whole = await paint(view, "none", { ...settings, time }, h.current, { ...options, jitter: taaOffset(h.frames % TAA_FRAMES) });
      if (whole) await engine.blend(h);
    }
    if (whole) engine.copy(h.pictures[0], target);
  } finally {
    if (own) [own.current, ...own.pictures].forEach(t => engine.discard(t));
  }
  return whole;
}
