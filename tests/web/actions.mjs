// SPDX-License-Identifier: MIT
// What a visitor of the page does, once: actions.mjs PAGE. Every control must change settings and picture, links bring them back, exports give files, brute force judges, and the
// page without WebGL2 shows a still picture. The console stays without errors. Exit code 77 where the time ended before all was done.
import { mkdtempSync, readFileSync, readdirSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { openBrowser, withinSeconds } from "./browser.mjs";

const [page] = process.argv.slice(2);
const MOST_SECONDS = 45; // of a software GL that other work slows down
const browser = await openBrowser({ width: 320, height: 200 });
const downloads = mkdtempSync(join(tmpdir(), "web-actions-"));
const failures = [];
let checks = 0, whole = false;
const expect = (good, what) => {
  checks++;
  if (!good) { failures.push(what); console.log("FAIL:", what); }
};
const pause = ms => new Promise(r => setTimeout(r, ms));
const key = async (name, shift) => {
  for (const type of ["keyDown", "keyUp"]) await browser.send("Input.dispatchKeyEvent", { type, key: name, code: name, modifiers: shift ? 8 : 0 });
};
const drag = async (from, to, shift) => {
  const at = (type, [x, y], buttons) => browser.send("Input.dispatchMouseEvent", { type, x, y, button: "left", buttons, clickCount: 1, modifiers: shift ? 8 : 0 });
  await at("mousePressed", from, 1);
  await at("mouseMoved", to, 1);
  await at("mouseReleased", to, 0);
};
const settings = () => browser.run("({ ...page.settings })");
const until = what => browser.run(`(async () => { while (!(${what})) await new Promise(r => setTimeout(r, 20)); })()`);

async function downloaded(ending) {
  for (;;) {
    const name = readdirSync(downloads).find(n => n.endsWith(ending));
    if (name) return readFileSync(join(downloads, name));
    await pause(50);
  }
}

// A picture of 64 × 36 by the workers is other than before.
async function controls() {
  await browser.run(`window.drawn = async () => (await page.view.lanes.pixels({ method: "mangata", settings: page.settings, width: 64, height: 36 }, undefined, true)).data.join()`);
  for (const name of await browser.run("SETTINGS.map(s => s.name)")) {
    const moved = await browser.run(`(async () => {
      page.settings = { ...presets(), wind: 14, swell: 2 };
      const base = window.base = window.base || await drawn(), s = SETTINGS.find(row => row.name === "${name}"), input = element("set-${name}"), before = page.settings["${name}"];
      changed();
      const said = input.getAttribute("aria-valuetext");
      input.value = before < (s.least + s.most) / 2 ? s.most : s.least;
      input.dispatchEvent(new Event("input"));
      return page.settings["${name}"] !== before && said !== input.getAttribute("aria-valuetext") && await drawn() !== base;
    })()`);
    expect(moved, `the control ${name} changes its setting and the picture`);
  }
}

async function gestures() {
  await browser.run("(() => { page.settings = presets(); page.methods = ['ggx-moments', 'mangata']; changed(); element('canvas').focus(); })()");
  let before = await settings();
  await key("ArrowLeft", false);
  await key("ArrowUp", true);
  let after = await settings();
  expect(after.heading !== before.heading && after.elevation > before.elevation, "arrow keys look around, and with Shift move the light");
  await drag([60, 30], [90, 40], false);
  before = await settings();
  expect(before.heading !== after.heading && before.pitch !== after.pitch, "a drag looks around");
  await drag([60, 30], [90, 40], true);
  after = await settings();
  expect(after.azimuth !== before.azimuth && after.elevation !== before.elevation, "a drag with Shift moves the light");
  await browser.run("(() => { element('wipe').value = 20; element('wipe').dispatchEvent(new Event('input')); })()");
  expect(await browser.run("page.wipe") === 0.2, "the wipe moves");
  const link = await browser.run("linkOf(page.settings, page.methods, true)");
  const same = await browser.run(`(() => { const was = JSON.stringify(page.settings); page.settings = presets(); page.methods = ["none", "none"]; location.hash = ${JSON.stringify(link)}; takeLink(); changed();
    return was === JSON.stringify(page.settings) && page.methods.join() === "ggx-moments,mangata"; })()`);
  expect(same, "a link brings settings and methods back");
}

async function rests() {
  await browser.run("(() => { page.settings = { ...presets(), choppiness: 0 }; changed(); })()");
  await until("page.figures.length > 0 && page.settled");
  const figures = await browser.run("element('figures').textContent");
  expect(/over those of brute force/.test(figures) && /flicker [×≤] \d/.test(figures) && !/NaN|Infinity/.test(figures), `brute force judges a picture that rests: ${figures}`);
  expect(await browser.run("element('canvas').width === sizes(() => 1)[0]"), "a picture at rest has all of the window's pixels");
  const fits = await browser.run(`(() => {
    const { engine } = page.view, { gl } = engine;
    gl.getError();
    engine.data("hit_texture", new Float32Array(4 * 1024 * 8200));
    return gl.getError() === gl.NO_ERROR;
  })()`);
  expect(fits, "first hits of large pictures fit into a texture of 8192 rows");
}

// A sea that there is not, in the first link of a page that begins paused.
async function withoutPictures() {
  await browser.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-reduced-motion", value: "reduce" }] });
  await browser.open("about:blank");
  await browser.open("file://" + resolve(page) + "#wind=20&fetch=1");
  await until("!element('word').hidden && page.view");
  await pause(500);
  const word = await browser.run("element('word').textContent");
  expect(/^no sea has a wind of 20 m/.test(word), `a first link to no sea is told: ${word}`);
  await browser.run("(() => { element('set-fetch').value = 0; element('set-fetch').dispatchEvent(new Event('input')); })()");
  await until("page.firstPicture");
  await browser.send("Emulation.setEmulatedMedia", { features: [] });
}

async function exports() {
  await browser.send("Browser.setDownloadBehavior", { behavior: "allow", downloadPath: downloads });
  await browser.run("element('save').click()");
  const png = await downloaded(".png");
  expect(png.readUInt32BE(16) === 320 && png.readUInt32BE(20) === 200 && png.length > 5000, `the picture's file has the picture: ${png.length} bytes`);
  await browser.run("(() => { setPlaying(true); element('film').click(); })()");
  const { frames } = await browser.run("({ frames: page.frames })");
  await until(`page.frames > ${frames + 5}`);
  await pause(500);
  await browser.run("element('film').click()");
  const film = await downloaded(await browser.run("page.filmKind")), bytes = film.toString("base64");
  const seen = await browser.run(`(async () => {
    const video = Object.assign(document.createElement("video"), { muted: true, src: URL.createObjectURL(new Blob([Uint8Array.from(atob("${bytes}"), c => c.charCodeAt(0))])) });
    await new Promise((resolve, reject) => { video.onloadeddata = resolve; video.onerror = () => reject(new Error("the film does not play")); });
    return [video.videoWidth, video.videoHeight];
  })()`);
  expect(seen[0] >= 64 && seen[1] >= 36, `the film's file plays: ${film.length} bytes, ${seen.join(" × ")}`);
}

async function withoutWebGL() {
  await browser.send("Page.addScriptToEvaluateOnNewDocument", { source: "HTMLCanvasElement.prototype.getContext = (get => function (kind, ...rest) { return kind === 'webgl2' ? null : get.call(this, kind, ...rest); })(HTMLCanvasElement.prototype.getContext);" });
  await browser.open("about:blank");
  await browser.open("file://" + resolve(page));
  await until("page.firstPicture");
  const seen = await browser.run("({ word: element('word').textContent, hidden: element('word').hidden, colors: new Set(element('canvas').getContext('2d').getImageData(0, 0, 640, 300).data).size })");
  expect(/still picture: this browser has no WebGL2/.test(seen.word) && !seen.hidden && seen.colors > 50, `without WebGL2 there is a still picture and a word: ${JSON.stringify(seen)}`);
}

try {
  whole = await withinSeconds(MOST_SECONDS, async () => {
    await browser.size(320, 200, 1, false);
    await browser.open("file://" + resolve(page));
    await until("page.firstPicture");
    expect(true, "there is a picture");
    console.log("first picture after", Math.round(await browser.run("page.firstPicture")), "ms");
    await browser.run("setPlaying(false)");
    expect(await browser.run("element('panel').classList.contains('folded')"), "the panel of a small window is folded");
    await controls();
    for (const side of ["left", "right"])
      expect(await browser.run(`Object.keys(METHODS).every(m => { element("${side}").value = m; element("${side}").onchange(); return page.methods[${side === "left" ? 0 : 1}] === m; })`), `${side} takes every method`);
    expect(await browser.run("[...element('gallery').children].every((button, i) => { button.click(); return page.settings.wind === (GALLERY[i].wind ?? presets().wind); })"), "the gallery's seas are taken");
    await gestures();
    await rests();
    await exports();
    await withoutPictures();
    await withoutWebGL();
  });
  expect(browser.errors.length === 0, `errors on the console: ${browser.errors.slice(0, 3).join("; ")}`);
  console.log(whole ? `${checks} checks` : `skipped: the ${MOST_SECONDS} seconds ended after ${checks} checks`);
} finally {
  await browser.close();
  rmSync(downloads, { recursive: true });
}
process.exit(failures.length ? 1 : whole ? 0 : 77);
