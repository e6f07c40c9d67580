// SPDX-License-Identifier: MIT
// The three functions for other pages.

function presets() { return Object.fromEntries(SETTINGS.map(s => [s.name, s.preset])); }

// What draws in a canvas. `picture` has the canvas' size unless it is said otherwise. Rejects with a text where WebGL2 is missing.
async function create(canvas) {
  const { texts, code } = await unpacked();
  const library = await openLibrary(await WebAssembly.compile(code));
  const view = { canvas, engine: new Engine(canvas, library, texts), settings: presets() };
  view.engine.update(view.settings);
  return view;
}

// Changes settings by name. Throws where there is no such setting, or no such sea.
function setScene(view, changes) {
  for (const name in changes)
    if (!(name in view.settings)) throw new Error(`there is no setting ${name}; allowed: ${SETTINGS.map(s => s.name).join(", ")}`);
  Object.assign(view.settings, changes);
  if (view.engine.update(view.settings) < 0) throw new Error("no sea has this wind and this fetch");
}

// Draws the scene by a method at a time in seconds and shows it. Resolves when it is drawn.
async function render(view, { method = "mangata", time = view.settings.time } = {}) {
  if (!(method in METHODS)) throw new Error(`there is no method ${method}; allowed: ${Object.keys(METHODS).join(", ")}`);
  const { engine, canvas } = view, { width, height } = canvas;
  if (!view.target || view.target.width !== width || view.target.height !== height) {
    if (view.target) engine.discard(view.target);
    if (view.history) [view.history.current, ...view.history.pictures].forEach(t => engine.discard(t));
    view.target = engine.target(width, height);
    view.history = null;
  }
  const until = async step => { while (!step()) await new Promise(next => setTimeout(next, 5)); };
  let picture = view.target;
  if (METHODS[method].blends) {
    view.history = view.history || engine.history(width, height);
    view.history.frames = 0;
    for (let frame = 0; frame < TAA_FRAMES; frame++) {
      engine.update({ ...view.settings, time: time - (TAA_FRAMES - 1 - frame) / 30 });
      await until(() => engine.blend(view.history));
      engine.gl.finish();
    }
    picture = view.history.pictures[0];
  } else {
    engine.update({ ...view.settings, time });
    await until(() => engine.draw(method, picture));
  }
  await until(() => engine.show(picture));
  view.engine.gl.finish();
}
