// SPDX-License-Identifier: MIT
// Every control of the page, once: actions.mjs PAGE. Each must change the settings, the link must bring them back, and the console stays without errors.
import { resolve } from "node:path";
import { openBrowser } from "./browser.mjs";

const [page] = process.argv.slice(2);
const MOST_SECONDS = 45; // of a software GL that other work slows down
const browser = await openBrowser({ width: 320, height: 200 });
const failures = [];
setTimeout(async () => {
  console.log("skipped: this machine's WebGL2 is too slow now");
  await browser.close();
  process.exit(failures.length ? 1 : 77);
}, MOST_SECONDS * 1000).unref();
const expect = (good, what) => { if (!good) { failures.push(what); console.log("FAIL:", what); } };
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
try {
  await browser.size(320, 200, 1, false);
  await browser.open("file://" + resolve(page));
  await browser.run("(async () => { while (!page.firstPicture) await new Promise(r => setTimeout(r, 50)); setPlaying(false); })()");
  console.log("first picture after", Math.round(await browser.run("page.firstPicture")), "ms");
  expect(await browser.run("element('panel').classList.contains('folded')"), "the panel of a small window is folded");

  for (const name of await browser.run("SETTINGS.map(s => s.name).filter(name => element('set-' + name))")) {
    const moved = await browser.run(`(() => {
      const s = SETTINGS.find(row => row.name === "${name}"), input = element("set-${name}"), before = page.settings["${name}"];
      input.value = before === s.most ? s.least : s.most;
      input.dispatchEvent(new Event("input"));
      const after = page.settings["${name}"], said = input.getAttribute("aria-valuetext");
      page.settings["${name}"] = before;
      changed();
      return after !== before && said !== input.getAttribute("aria-valuetext");
    })()`);
    expect(moved, `the control ${name} changes its setting`);
  }
  for (const side of ["left", "right"])
    expect(await browser.run(`Object.keys(METHODS).every(m => { element("${side}").value = m; element("${side}").onchange(); return page.methods.includes(m); })`), `${side} takes every method`);
  expect(await browser.run("[...element('gallery').children].every((button, i) => { button.click(); return page.settings.wind === (GALLERY[i].wind ?? presets().wind); })"), "the gallery's seas are taken");

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

  const link = await browser.run("linkOf(page.settings, page.methods)");
  const same = await browser.run(`(() => { const was = JSON.stringify({ ...page.settings, time: 0 }); page.settings = presets(); page.methods = ["none", "none"]; location.hash = ${JSON.stringify(link)}; takeLink(); changed();
    return was === JSON.stringify({ ...page.settings, time: 0 }) && page.methods.join() === "ggx-moments,mangata"; })()`);
  expect(same, "a link brings settings and methods back");
  await browser.run("(async () => { const shown = page.frames; page.dirty = true; while (page.frames === shown) await new Promise(r => setTimeout(r, 50)); for (let i = 0; i < 20; i++) await new Promise(r => setTimeout(r, 50)); measureFlicker(); showFigures(); })()");
  const figures = await browser.run("element('figures').textContent");
  expect(/judged by/.test(figures), `brute force judges a picture that rests: ${figures}`);
  expect(browser.errors.length === 0, `errors on the console: ${browser.errors.slice(0, 3).join("; ")}`);
} finally {
  await browser.close();
}
process.exit(failures.length ? 1 : 0);
