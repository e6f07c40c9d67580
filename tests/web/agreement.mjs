// SPDX-License-Identifier: MIT
// The page's pictures against the command's: agreement.mjs PAGE MANGATA WIDTH HEIGHT SEAS [SECONDS [METHOD]]. SEAS: how many of the gallery, or FIRST-LAST of them, counted from 1.
// By shaders and by the library in WebAssembly. Prints the RMSE of displayed values, the times of frames and what sorting the waves by tiles gains. Exit code 77 where the seconds
// ended before all pictures were compared.
import { statSync } from "node:fs";
import { resolve } from "node:path";
import { openBrowser, withinSeconds } from "./browser.mjs";
import { rmseOfCommand } from "./command.mjs";

const [page, mangata, width, height, seas, seconds = "45", only = ""] = process.argv.slice(2);
const MOST_RMSE = 0.01, MOST_BYTES = 400e3;
const [, firstSea, lastSea] = /^(?:(\d+)-)?(\d+)$/.exec(seas) ?? [];
if (!(Number(firstSea ?? 1) >= 1 && Number(firstSea ?? 1) <= Number(lastSea))) {
  console.error(`agreement.mjs: seas ${seas}: allowed is how many, or FIRST-LAST`);
  process.exit(64);
}
const browser = await openBrowser();
let failed = statSync(page).size > MOST_BYTES, compared = 0, whole = false, cases = [];
console.log(`size ${(statSync(page).size / 1000).toFixed(0)} KB`);

async function compare([scene, method, way]) {
  const { name, ...changes } = scene;
  const drawn = await browser.run(`(async () => {
    setScene(tested, { ...presets(), ...${JSON.stringify(changes)} });
    const timed = async options => {
      if (!METHODS[options.method].blends) await render(tested, options); // which compiles
      const start = performance.now();
      await render(tested, options);
      return { frame: performance.now() - start, tiles: tested.engine.times.tiles };
    };
    const options = { method: "${method}", way: "${way}" }, slow = ${way === "shaders" && method === "mangata"} ? await timed({ ...options, sorted: false }) : null, fast = await timed(options);
    return { slow, fast, command: commandOf(tested.settings, "${method}", ${width}, ${height}), png: tested.canvas.toDataURL().split(",")[1] };
  })()`);
  const { slow, fast } = drawn, rmse = await rmseOfCommand(mangata, drawn.command, drawn.png);
  failed ||= !(rmse <= MOST_RMSE);
  compared++;
  const tiles = way === "shaders" ? `, of which tiles ${fast.tiles.toFixed(0)} ms` : "", gain = slow ? `; unsorted ${slow.frame.toFixed(0)} ms, sorting gains × ${(slow.frame / fast.frame).toFixed(2)}` : "";
  console.log(`${name}, ${method} by ${way}: RMSE ${rmse.toFixed(5)}, frame ${fast.frame.toFixed(0)} ms${tiles}${gain}`);
}

// A sky of stars by shaders and by the library; they are too few and too faint for the RMSE of a picture.
async function compareStars() {
  const { most, peak, floor } = await browser.run(`(async () => {
    setScene(tested, { ...presets(), moon: 1, pitch: 30, heading: 180, elevation: 3 });
    const greens = {};
    for (const way of ["lanes", "shaders"]) {
      await render(tested, { way });
      greens[way] = tested.engine.read(tested.target).filter((value, i) => i % 4 === 1);
    }
    const { lanes, shaders } = greens;
    return { most: lanes.reduce((all, v, i) => Math.max(all, Math.abs(v - shaders[i])), 0), peak: lanes.reduce((all, v) => Math.max(all, v), 0), floor: lanes.toSorted()[lanes.length >> 1] };
  })()`);
  const good = peak > 4 * floor && most < 1e-3 * peak;
  failed ||= !good;
  console.log(`${good ? "" : "FAIL: "}stars by both ways: brightest ${peak.toExponential(2)} kcd/m², sky ${floor.toExponential(2)}, apart by ${most.toExponential(1)} at most`);
}

try {
  whole = await withinSeconds(Number(seconds), async ended => {
    await browser.open("file://" + resolve(page) + "#still");
    await browser.run(`(async () => { window.tested = await create(Object.assign(document.createElement("canvas"), { width: ${width}, height: ${height} })); })()`);
    const methods = await browser.run("Object.entries(METHODS).map(([name, m]) => ({ name, lanes: m.byLanes || m.blends, last: m.blends ? 2 : m.map ? 1 : 0 }))");
    methods.reverse().sort((a, b) => a.last - b.last); // mangata first, what takes longest last
    for (const scene of (await browser.run("GALLERY")).slice((firstSea ?? 1) - 1, lastSea))
      for (const { name, lanes } of methods.filter(m => !only || m.name === only)) cases.push(...(lanes ? [[scene, name, "lanes"]] : []), [scene, name, "shaders"]);
    await compareStars();
    for (const one of cases) if (!ended()) await compare(one);
  });
  if (!whole) console.log(`skipped: the ${seconds} seconds ended: ${compared} of ${cases.length} pictures were compared`);
  failed ||= (whole && !compared) || browser.errors.length > 0;
  console.log(`errors on the console: ${browser.errors.length} ${browser.errors.slice(0, 3).join("; ")}`);
} finally {
  await browser.close();
}
process.exit(failed ? 1 : whole ? 0 : 77);
