// SPDX-License-Identifier: MIT
// Pictures of a scene in a canvas; the three functions for other pages.

function presets() { return Object.fromEntries(SETTINGS.map(s => [s.name, s.preset])); }

// What draws in a canvas. `way`: "shaders" of its WebGL2, or "lanes", the library in WebAssembly, which is faster where the CPU does WebGL2's work.
// Rejects with a text where WebGL2 is missing.
async function create(canvas) {
  const { texts, module } = await unpacked(), library = await openLibrary(module), lanes = new Lanes(module), engine = new Engine(canvas, lanes, texts, library.calls);
  return { canvas, lanes, engine, library, way: engine.byCpu ? "lanes" : "shaders", settings: presets(), last: Promise.resolve() };
}

// Changes settings by name. Throws where there is no such setting, or no such sea.
function setScene(view, changes) {
  for (const name in changes)
    if (!(name in view.settings)) throw new Error(`there is no setting ${name}; allowed: ${SETTINGS.map(s => s.name).join(", ")}`);
  const settings = { ...view.settings, ...changes };
  view.library.checkSea(settings);
  view.settings = settings;
}

// Draws the scene by a method at a time in seconds and shows it. Resolves when it is drawn; one picture of a view is drawn at a time.
function render(view, { method = "mangata", time = view.settings.time, ...options } = {}) {
  if (!(method in METHODS)) return Promise.reject(new Error(`there is no method ${method}; allowed: ${Object.keys(METHODS).join(", ")}`));
  const { engine, canvas } = view, settings = { ...view.settings, time };
  const next = async () => {
    const { width, height } = canvas;
    if (!view.target || view.target.width !== width || view.target.height !== height) {
      if (view.target) engine.discard(view.target);
      view.target = engine.target(width, height);
    }
    await paint(view, method, settings, view.target, options);
    await engine.compiled(engine.program("display.frag", "", "", ""));
    engine.show(view.target);
    await engine.finished();
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
  for (let frame = 0; frame < frames && whole; frame++) {
    const time = settings.time - (frames - 1 - frame) / 30;
    whole = await paint(view, "none", { ...settings, time }, h.current, { ...options, jitter: taaOffset(h.frames % TAA_FRAMES) });
    if (whole) await engine.blend(h);
  }
  if (whole) engine.copy(h.pictures[0], target);
  if (own) [own.current, ...own.pictures].forEach(t => engine.discard(t));
  return whole;
}
