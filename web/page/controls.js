// SPDX-License-Identifier: MIT
// Controls, dragging, links and exports of the page.

const GROUPS = {
  Water: ["wind", "direction", "fetch", "choppiness", "foam", "swell", "swell_period", "swell_direction", "waves", "seed"],
  Light: ["moon", "elevation", "azimuth", "turbidity", "exposure"],
  "Camera and time": ["height", "pitch", "heading", "fov", "shutter", "time"],
};

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

function showValue(s) {
  const input = element("set-" + s.name), value = page.settings[s.name];
  input.value = value;
  input.nextElementSibling.textContent = valueText(s, value);
  input.setAttribute("aria-valuetext", valueText(s, value));
}

function showTime() { showValue(SETTINGS.find(s => s.name === "time")); }

// After any change: the picture, the link and the command follow.
function changed() {
  page.dirty = true;
  page.version++;
  page.figures = [];
  placeWipe();
  SETTINGS.forEach(showValue);
  element("left").value = page.methods[0];
  element("right").value = page.methods[1];
  clearTimeout(page.linkTimer);
  page.linkTimer = setTimeout(() => {
    try { history.replaceState(null, "", linkOf(page.settings, page.methods, !page.playing)); } catch { /* a sandboxed frame has no history */ }
    element("command").textContent = commandOf(page.settings, page.methods[1], ...sizes(() => 1));
  }, 150);
}

function placeWipe() {
  element("edge").style.left = 100 * page.wipe + "%";
  for (const [i, id] of ["label-left", "label-right"].entries()) {
    element(id).replaceChildren(page.methods[i], ...(page.figures.length ? [Object.assign(document.createElement("small"), { textContent: page.meters[i].join("\n") })] : []));
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
  element("wipe").oninput = event => { page.wipe = event.target.value / 100; placeWipe(); if (page.settled) show(); else page.dirty = true; };
  element("fold").onclick = () => {
    const folded = element("panel").classList.toggle("folded");
    element("fold").setAttribute("aria-expanded", String(!folded));
  };
  window.onresize = () => { changed(); fold(); };
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
  const { settings, methods, timed } = settingsOfLink(location.hash);
  page.settings = { ...settings, time: timed ? settings.time : page.settings.time };
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
  element("copy-link").onclick = () => copy(location.href.split("#")[0] + linkOf(page.settings, page.methods, !page.playing), "link");
  element("copy-command").onclick = () => copy(element("command").textContent, "command");
  element("save").onclick = () => element("canvas").toBlob(blob => saveAs(blob, "mangata.png"));
  element("play").onclick = () => setPlaying(!page.playing);
  element("film").onclick = () => {
    if (page.recorder) { page.recorder.stop(); return; }
    const kind = ["video/mp4", "video/webm"].find(k => window.MediaRecorder && MediaRecorder.isTypeSupported(k)), parts = [];
    if (!kind) { tell("This browser records no films. The command renders them."); return; }
    if (!page.playing) setPlaying(true);
    page.recorder = new MediaRecorder(element("canvas").captureStream(30), { mimeType: kind, videoBitsPerSecond: 16e6 });
    page.recorder.ondataavailable = event => parts.push(event.data);
    page.recorder.onstop = () => {
      saveAs(new Blob(parts, { type: kind }), "mangata." + page.filmKind);
      page.recorder = null;
      element("film").setAttribute("aria-pressed", "false");
      element("film").textContent = "Record film";
    };
    page.filmKind = kind.split("/")[1];
    page.recorder.start();
    element("film").setAttribute("aria-pressed", "true");
    element("film").textContent = "Stop and save";
  };
}
