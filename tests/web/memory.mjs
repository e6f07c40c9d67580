// SPDX-License-Identifier: MIT
// Memory of the page while it plays: memory.mjs PAGE [SECONDS]. Prints that of JavaScript and of all workers' WebAssembly each fifth of the time; exit code 1 where either grows by more than
// a tenth after the first.
import { resolve } from "node:path";
import { openBrowser } from "./browser.mjs";

const [page, seconds = "60"] = process.argv.slice(2);
const browser = await openBrowser({ width: 320, height: 200 });
const taken = [];
try {
  await browser.size(320, 200, 1, false);
  await browser.open("file://" + resolve(page));
  await browser.run("(async () => { while (!page.firstPicture) await new Promise(r => setTimeout(r, 50)); })()");
  for (let part = 0; part < 5; part++) {
    await new Promise(r => setTimeout(r, 200 * Number(seconds)));
    await browser.send("HeapProfiler.collectGarbage");
    taken.push(await browser.run("[performance.memory.usedJSHeapSize, page.view.lanes.memory.reduce((a, b) => a + b), page.frames]"));
    const [script, library, frames] = taken[part];
    console.log(`${frames} frames: JavaScript ${(script / 1e6).toFixed(2)} MB, WebAssembly ${(library / 1e6).toFixed(2)} MB`);
  }
} finally {
  await browser.close();
}
process.exit([0, 1].some(i => taken[4][i] > 1.1 * taken[0][i]) ? 1 : 0);
