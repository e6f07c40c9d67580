// SPDX-License-Identifier: MIT
// The page's judge against the command's brute force: judge.mjs PAGE MANGATA [SPATIAL TIME]. Pictures of `reference` are judged, of a small smooth sea: their error must be their own
// noise, their energy 1, their contrast and flicker what noise adds. Two seeds tell the noise. Exit code 77 where the time ended before that.
import { execFile } from "node:child_process";
import { mkdtempSync, readFileSync, rmSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { promisify } from "node:util";
import { openBrowser, withinSeconds } from "./browser.mjs";

const run = promisify(execFile);
const [page, mangata, spatial = "6", time = "8"] = process.argv.slice(2);
const MOST_SECONDS = 45, WIDTH = 48, HEIGHT = 27, SAMPLES = 256;
const folder = mkdtempSync(join(tmpdir(), "web-judge-"));
const browser = await openBrowser({ width: 320, height: 200 });
let failed = false, whole = false;
const expect = (good, what) => {
  failed ||= !good;
  console.log(`${good ? "" : "FAIL: "}${what}`);
};

// Red, green, blue and 0 of each pixel, top row first, of a PFM in colour.
function pixelsOf(path) {
  const file = readFileSync(path), heads = /^PF\n(\d+) (\d+)\n-1(?:\.0*)?\n/.exec(file.toString("latin1", 0, 60)), [width, height] = [Number(heads[1]), Number(heads[2])];
  const rgba = new Float32Array(4 * width * height);
  for (let y = 0; y < height; y++)
    for (let x = 0; x < width; x++)
      for (let c = 0; c < 3; c++) rgba[4 * (y * width + x) + c] = file.readFloatLE(heads[0].length + 4 * (3 * ((height - 1 - y) * width + x) + c));
  return rgba;
}

// Radiance of two frames, which are as far apart as the judge's instants.
async function reference(command, seed) {
  const words = command.replace(/^mangata/, resolve(mangata)).replace(/--frames 0 -o sea.png$/, `--frames 0-1 -o ${seed}-%d.pfm`);
  await run("sh", ["-c", `${words} --spatial ${spatial} --time-samples ${time} --seed ${seed} -q`], { cwd: folder });
  return [0, 1].map(frame => pixelsOf(join(folder, `${seed}-${frame}.pfm`)));
}

try {
  whole = await withinSeconds(MOST_SECONDS, async () => {
    await browser.open("file://" + resolve(page) + "#still");
    const command = await browser.run(`(() => {
      window.both = [0, 1 / 30].map(later => ({ ...presets(), waves: 32, choppiness: 0, elevation: 25, azimuth: 180, height: 6, pitch: -15, shutter: 1, time: 10 + later }));
      return commandOf(both[0], "reference", ${WIDTH}, ${HEIGHT});
    })()`);
    const pictures = await Promise.all([1, 2].map(seed => reference(command, seed))); // by seed, then by instant
    await browser.run(`window.given = ${JSON.stringify(pictures.map(pair => pair.map(p => Buffer.from(p.buffer).toString("base64"))))}
      .map(pair => pair.map(text => new Float32Array(Uint8Array.from(atob(text), c => c.charCodeAt(0)).buffer)));`);
    const found = await browser.run(`(async () => {
      const { module } = await unpacked(), library = await openLibrary(module), { calls } = library, count = ${WIDTH * HEIGHT};
      library.update(both[0]);
      calls.picture_begin(library.method("none"), ${WIDTH}, ${HEIGHT}, 0, 0, 0);
      const lumaOf = rgba => {
        const at = calls.take(16 * count), out = calls.take(4 * count);
        new Float32Array(calls.memory.buffer, at, 4 * count).set(rgba);
        calls.picture_luma(at, 1, count, out);
        return library.copy(Float32Array, out, count);
      };
      const sums = of => { let sum = 0; for (let i = 0; i < count; i++) sum += of(i) ** 2; return sum; };
      // The mean of both seeds, its displayed luma, and its noise: half of what they differ by.
      const own = [0, 1].map(instant => {
        const [a, b] = given.map(pair => pair[instant]), mean = a.map((v, i) => (v + b[i]) / 2), [x, y] = [lumaOf(a), lumaOf(b)];
        return { mean, luma: lumaOf(mean), noise: x.map((v, i) => (v - y[i]) / 2) };
      });
      const beside = plane => i => (i % ${WIDTH} ? plane[i] - plane[i - 1] : 0), step = (a, b) => i => b[i] - a[i];
      const contrasts = [sums(beside(own[0].luma)), sums(beside(own[0].noise))], flickers = [sums(step(own[0].luma, own[1].luma)), sums(step(own[0].noise, own[1].noise))];
      const judge = new Judge(module), judged = {};
      const dim = own.map(o => o.mean.map(v => 0.8 * v));
      await judge.begin({ settings: both, width: ${WIDTH}, height: ${HEIGHT}, pictures: [own.map(o => o.mean), dim], most: ${SAMPLES}, duty: 1 }, (sides, samples) => Object.assign(judged, { sides, samples }));
      return { ...judged, noise: Math.sqrt(sums(i => own[0].noise[i]) / count), contrast: Math.sqrt(contrasts[0] / (contrasts[0] - contrasts[1])), flicker: Math.sqrt(flickers[0] / (flickers[0] - flickers[1])) };
    })()`);
    const [same, dim] = found.sides, near = (name, value, wanted, most) => expect(Math.abs(value / wanted - 1) <= most, `${name} ${value.toFixed(4)}, by two seeds ${wanted.toFixed(4)}`);
    expect(found.samples === SAMPLES, `${found.samples} samples a pixel`);
    near("error", same.error, found.noise, 0.25);
    near("energy", same.energy, 1, 0.005);
    near("contrast", same.contrast, found.contrast, 0.04);
    near("flicker", same.flicker, found.flicker, 0.2);
    near("energy of a picture that is a fifth darker", dim.energy, 0.8, 0.005);
    expect(dim.error > 8 * found.noise, `its error ${dim.error.toFixed(4)}`);
  });
  if (!whole) console.log(`skipped: the ${MOST_SECONDS} seconds ended`);
  expect(browser.errors.length === 0, `errors on the console: ${browser.errors.length} ${browser.errors.slice(0, 3).join("; ")}`);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
process.exit(failed ? 1 : whole ? 0 : 77);
