// SPDX-License-Identifier: MIT
// The page: controls, dragging, the loop of frames.

const GROUPS = {
  Water: ["wind", "direction", "fetch", "choppiness", "foam", "swell", "swell_period", "swell_direction", "waves", "seed"],
  Light: ["moon", "elevation", "azimuth", "turbidity", "exposure"],
  Camera: ["height", "pitch", "heading", "fov", "shutter"],
};
const element = id => document.getElementById(id);
const page = { settings: presets(), methods: ["none", "mangata"], wipe: 0.5, playing: true, scale: 1, dirty: true, frameTimes: [], last: {} };
const say = text => { element("said").textContent = text; };

// ---- controls ----

function buildControls() {
  for (const side of ["left", "right"]) {
    for (const name in METHODS) element(side).add(new Option(name, name));
    element(side).onchange = () => { page.methods[side === "left" ? 0 : 1] = element(side).value; changed(); };
  }
  for (const scene of GALLERY) {
    const button = Object.assign(document.createElement("button"), { type: "button", textContent: scene.name });
    button.onclick = () => { const { name, ...values } = scene; page.settings = { ...presets(), ...values, time: page.settings.time }; changed(); say(name); };
    element("gallery").append(button);
  }
  for (const title in GROUPS) {
    const set = document.createElement("fieldset");
    set.append(Object.assign(document.createElement("legend"), { textContent: title }));
    for (const name of GROUPS[title]) {
      const s = SETTINGS.find(row => row.name === name), row = document.createElement("div"), id = "set-" + name;
      row.className = "row";
      row.append(Object.assign(document.createElement("label"), { htmlFor: id, textContent: s.label }),
        Object.assign(document.createElement("input"), { type: "range", id, min: s.least, max: s.most, step: s.step, value: s.preset }), document.createElement("output"));
      row.children[1].oninput = event => { page.settings[name] = fitted(s, event.target.value); changed(); };
      set.append(row);
    }
    element("groups").append(set);
  }
}

function valueText(s, value) {
  if (s.name === "moon") return value ? "moon" : "sun";
  if (s.name === "fetch" && value === 0) return "open sea";
  if (s.name === "swell" && value === 0) return "none";
  return `${value} ${s.unit}`.trim();
}

// After any change: the picture, the link and the command follow.
function changed() {
  page.dirty = true;
  page.shown = 0;
  for (const s of SETTINGS) {
    const input = element("set-" + s.name);
    if (!input) continue;
    input.value = page.settings[s.name];
    input.nextElementSibling.textContent = valueText(s, page.settings[s.name]);
    input.setAttribute("aria-valuetext", valueText(s, page.settings[s.name]));
  }
  element("left").value = page.methods[0];
  element("right").value = page.methods[1];
  clearTimeout(page.linkTimer);
  page.linkTimer = setTimeout(() => {
    try { history.replaceState(null, "", linkOf(page.settings, page.methods)); } catch { /* a sandboxed frame has no history */ }
    element("command").textContent = commandOf(page.settings, page.methods[1], element("canvas").width, element("canvas").height);
  }, 150);
}

function placeWipe() {
  for (const [i, id] of ["label-left", "label-right"].entries()) {
    element(id).textContent = page.methods[i];
    element(id).style.left = 100 * page.wipe + "%";
  }
}

function move(name, by) {
  const s = SETTINGS.find(row => row.name === name);
  let value = page.settings[name] + by;
  if (s.unit === "°" && s.most === 180) value = ((value + 540) % 360) - 180;
  page.settings[name] = fitted(s, value);
  changed();
}

function buildGestures() {
  const canvas = element("canvas");
  let drag = null;
  // A drag that begins at the light, or with Shift, moves the light; any other looks around.
  canvas.onpointerdown = event => {
    const at = lightPlace(), near = at && Math.hypot(event.clientX - at[0], event.clientY - at[1]) < 60;
    drag = { x: event.clientX, y: event.clientY, light: event.shiftKey || near };
    canvas.setPointerCapture(event.pointerId);
  };
  canvas.onpointermove = event => {
    if (!drag) return;
    const degrees = page.settings.fov / canvas.clientHeight, x = (event.clientX - drag.x) * degrees, y = (event.clientY - drag.y) * degrees;
    drag.x = event.clientX;
    drag.y = event.clientY;
    if (drag.light) { move("azimuth", x); move("elevation", -y); }
    else { move("heading", -x); move("pitch", y); }
  };
  canvas.onpointerup = canvas.onpointercancel = () => { drag = null; };
  canvas.addEventListener("wheel", event => { event.preventDefault(); move("fov", Math.sign(event.deltaY)); }, { passive: false });
  canvas.onkeydown = event => {
    const arrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key];
    if (event.key === " ") { event.preventDefault(); element("play").click(); }
    if (!arrows) return;
    event.preventDefault();
    const names = event.shiftKey ? ["azimuth", "elevation"] : ["heading", "pitch"];
    arrows.forEach((by, i) => by && move(names[i], by));
  };
  element("wipe").oninput = event => { page.wipe = event.target.value / 100; page.dirty = true; placeWipe(); };
  element("fold").onclick = () => {
    const folded = element("panel").classList.toggle("folded");
    element("fold").setAttribute("aria-expanded", String(!folded));
  };
  window.onresize = () => { page.dirty = true; fold(); };
  window.onhashchange = () => { takeLink(); changed(); };
}

// Where the light stands on the screen; null behind the camera.
function lightPlace() {
  const s = page.settings, rad = Math.PI / 180, h = (s.azimuth - s.heading) * rad, e = s.elevation * rad, p = s.pitch * rad;
  const x = Math.sin(h) * Math.cos(e), y = Math.sin(e), z = Math.cos(h) * Math.cos(e);
  const ahead = z * Math.cos(p) + y * Math.sin(p), up = y * Math.cos(p) - z * Math.sin(p);
  if (ahead <= 0.05) return null;
  const canvas = element("canvas"), focal = canvas.clientHeight / 2 / Math.tan(s.fov * rad / 2);
  return [canvas.clientWidth / 2 + focal * x / ahead, canvas.clientHeight / 2 - focal * up / ahead];
}

// An open panel would hide the water of a small window.
function fold() { if (!page.folded && (innerWidth < 640 || innerHeight < 480)) { page.folded = true; element("fold").click(); } }

function takeLink() {
  const { settings, methods } = settingsOfLink(location.hash);
  page.settings = { ...settings, time: page.settings.time };
  if (methods.length === 2) page.methods = methods;
}

// ---- export ----

function saveAs(blob, name) {
  const link = Object.assign(document.createElement("a"), { href: URL.createObjectURL(blob), download: name });
  link.click();
  setTimeout(() => URL.revokeObjectURL(link.href), 1000);
}

function buildExports() {
  const copy = (text, word) => navigator.clipboard.writeText(text).then(() => say(word + " copied"), () => say("this page may not copy; select the text instead"));
  element("copy-link").onclick = () => copy(location.href.split("#")[0] + linkOf(page.settings, page.methods), "link");
  element("copy-command").onclick = () => copy(element("command").textContent, "command");
  element("save").onclick = () => element("canvas").toBlob(blob => saveAs(blob, "mangata.png"));
  element("play").onclick = () => setPlaying(!page.playing);
  element("film").onclick = () => {
    if (page.recorder) { page.recorder.stop(); return; }
    const kind = ["video/mp4", "video/webm"].find(k => window.MediaRecorder && MediaRecorder.isTypeSupported(k)), parts = [];
    if (!kind) { say("this browser records no films"); return; }
    page.recorder = new MediaRecorder(element("canvas").captureStream(30), { mimeType: kind, videoBitsPerSecond: 16e6 });
    page.recorder.ondataavailable = event => parts.push(event.data);
    page.recorder.onstop = () => {
      saveAs(new Blob(parts, { type: kind }), "mangata." + kind.split("/")[1]);
      page.recorder = null;
      element("film").setAttribute("aria-pressed", "false");
      element("film").textContent = "Record film";
    };
    page.recorder.start();
    element("film").setAttribute("aria-pressed", "true");
    element("film").textContent = "Stop and save";
  };
}

function setPlaying(playing) {
  page.playing = playing;
  element("play").textContent = playing ? "Pause" : "Play";
  element("play").setAttribute("aria-pressed", String(playing));
}

// ---- frames ----

// The canvas has the window's pixels; pictures have as many as hold 30 frames a second.
function sizes() {
  const canvas = element("canvas"), ratio = Math.min(devicePixelRatio || 1, 2);
  const width = Math.max(64, Math.round(canvas.clientWidth * ratio)), height = Math.max(64, Math.round(canvas.clientHeight * ratio));
  if (canvas.width !== width || canvas.height !== height) Object.assign(canvas, { width, height });
  return [Math.max(64, Math.round(width * page.scale)), Math.max(36, Math.round(height * page.scale))];
}

function targets(width, height) {
  const engine = page.engine;
  if (page.targets && page.targets[0].width === width && page.targets[0].height === height) return page.targets;
  for (const t of page.targets || []) engine.discard(t);
  for (const h of page.histories || []) if (h) [h.current, ...h.pictures].forEach(t => engine.discard(t));
  page.targets = [engine.target(width, height), engine.target(width, height)];
  page.histories = [null, null];
  return page.targets;
}

// One method's picture; null while its program is compiled.
function pictureOf(side, target) {
  const method = page.methods[side], engine = page.engine;
  if (!METHODS[method].blends) return engine.draw(method, target) ? target : null;
  const history = page.histories[side] = page.histories[side] || engine.history(target.width, target.height);
  return engine.blend(history) ? history.pictures[0] : null;
}

function drawFrame() {
  const engine = page.engine, [width, height] = sizes();
  if (engine.update(page.settings) < 0) { say("no sea has this wind and this fetch"); return false; }
  const both = targets(width, height), first = pictureOf(0, both[0]);
  const second = page.methods[0] === page.methods[1] ? first : pictureOf(1, both[1]);
  if (!first && !second) return false;
  page.pictures = [first || second, second || first];
  if (!engine.show(page.pictures[0], page.pictures[1], page.wipe * element("canvas").width)) return false;
  engine.gl.readPixels(0, 0, 1, 1, engine.gl.RGBA, engine.gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits, so that the time is the frame's
  return first && second;
}

// Keeps what a frame takes near a thirtieth of a second.
function adapt(took) {
  page.frameTimes.push(took);
  if (page.frameTimes.length < 6) return;
  const middle = page.frameTimes.sort((a, b) => a - b)[3];
  page.frameTimes = [];
  page.middle = middle;
  const wanted = Math.min(1, Math.max(0.15, page.scale * Math.sqrt(28 / middle)));
  if (wanted < page.scale * 0.85 || wanted > page.scale * 1.2) page.scale = Math.round(wanted * 20) / 20;
}

function showFigures() {
  const t = page.pictures && page.pictures[0], lines = [];
  if (t) lines.push(`${t.width} × ${t.height}, ${(page.middle || page.took).toFixed(0)} ms a frame`);
  if (page.judge && t && !page.playing) {
    for (const side of [0, 1]) {
      const f = page.judge.figures(page.engine.read(page.pictures[side]), 0.18 / Math.max(page.level || 1, 1e-9));
      if (f) lines.push(`${page.methods[side]}: error ${f.error.toFixed(3)}, light × ${f.light.toFixed(2)}, contrast × ${f.contrast.toFixed(2)}`);
      if (f && side) lines.push(`judged by ${f.samples} samples a pixel`);
    }
  }
  if (page.flicker) lines.push(page.flicker);
  element("figures").textContent = lines.join("\n");
}

// Mean radiance of a picture, and how much pictures change from frame to frame on the left and on the right of the wipe.
function measureFlicker() {
  if (!page.pictures) return;
  const now = page.pictures.map(p => page.engine.read(p)), luma = a => Float32Array.from({ length: a.length / 4 }, (_, i) => 0.2126 * a[4 * i] + 0.7152 * a[4 * i + 1] + 0.0722 * a[4 * i + 2]);
  const planes = now.map(luma);
  page.level = planes[1].reduce((a, b) => a + b, 0) / planes[1].length;
  if (page.before && page.before[0].length === planes[0].length && page.playing) {
    const shown = v => 1 - Math.exp(-v * 0.18 / Math.max(page.level, 1e-9));
    const change = planes.map((p, side) => Math.sqrt(p.reduce((sum, v, i) => sum + (shown(v) - shown(page.before[side][i])) ** 2, 0) / p.length));
    page.flicker = `change a frame: ${page.methods[0]} ${change[0].toFixed(3)}, ${page.methods[1]} ${change[1].toFixed(3)}`;
  }
  page.before = planes;
}

function loop(now) {
  requestAnimationFrame(loop);
  const step = Math.min(0.1, (now - (page.clock || now)) / 1000);
  page.clock = now;
  if (page.playing) page.settings.time = Number(((page.settings.time + step) % 3600).toFixed(3));
  if (!page.playing && !page.dirty) { restWhileStill(); return; }
  const start = performance.now(), whole = drawFrame();
  page.took = performance.now() - start;
  if (!whole) return;
  if (!page.firstPicture) page.firstPicture = performance.now();
  page.dirty = !page.playing && ++page.shown < (page.methods.includes("taa") ? 16 : 1);
  page.frames = (page.frames || 0) + 1;
  if (page.frames % 30 < 2) measureFlicker();
  if (page.playing) adapt(page.took);
  if (page.frames % 10 === 1) { placeWipe(); showFigures(); }
}

function restWhileStill() {
  if (!page.judge || !page.pictures) return;
  page.judge.ask(page.settings, page.pictures[0].width, page.pictures[0].height);
  page.judge.work(12);
  if (++page.rests % 20 === 0) showFigures();
}

// Without WebGL2: one picture by the CPU's kernels.
function drawStill(library, reason) {
  document.body.classList.add("still");
  element("word").textContent = `This is a still picture: ${reason}. The command below renders it, and films.`;
  element("word").hidden = false;
  const old = element("canvas"), canvas = old.cloneNode();
  old.replaceWith(canvas); // a canvas that had a context of another kind has no 2D one
  page.playing = false;
  const draw = () => {
    const width = 640, height = Math.round(640 * canvas.clientHeight / Math.max(canvas.clientWidth, 1)) || 360, calls = library.calls;
    Object.assign(canvas, { width, height });
    if (library.update(page.settings) < 0) return;
    calls.picture_begin(library.method(page.methods[1] === "taa" ? "none" : page.methods[1]), width, height, 0);
    for (let row = 0; row * 16 < height; row++) calls.picture_row(row);
    const shown = library.bytes(calls.picture_shown(), 4 * width * height);
    canvas.getContext("2d").putImageData(new ImageData(new Uint8ClampedArray(shown), width, height), 0, 0);
  };
  draw();
  setInterval(() => { if (page.dirty) { page.dirty = false; draw(); } }, 300);
}

async function start() {
  takeLink();
  buildControls();
  buildGestures();
  buildExports();
  fold();
  changed();
  placeWipe();
  page.rests = 0;
  const { texts, code } = await unpacked(), module = await WebAssembly.compile(code), library = await openLibrary(module);
  if (matchMedia("(prefers-reduced-motion: reduce)").matches) setPlaying(false);
  try {
    page.engine = new Engine(element("canvas"), library, texts);
  } catch (error) {
    drawStill(library, error.message);
    return;
  }
  element("canvas").addEventListener("webglcontextlost", event => { event.preventDefault(); location.reload(); });
  page.scale = 0.2; // of the window's pixels, until a frame's time is known
  page.judge = new Judge(await openLibrary(module));
  requestAnimationFrame(loop);
}

if (location.hash !== "#still") start();
