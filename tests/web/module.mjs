// SPDX-License-Identifier: MIT
// module.mjs MODULE: the functions of build/web/mangata.mjs in a page of another: canvases that are resized, taken or lose their context, views that end, and
// what is refused.
import { createServer } from "node:http";
import { readFileSync } from "node:fs";
import { openBrowser } from "./browser.mjs";

const script = "import * as mangata from '/mangata.mjs'; window.mangata = mangata;";
const files = {
  "/": ["text/html", `<!doctype html><link rel=icon href=data:,><script type=module>${script}</script>`],
  "/mangata.mjs": ["text/javascript", readFileSync(process.argv[2])],
};
const server = createServer((request, response) => {
  const [kind, body] = files[request.url] || ["text/plain", ""];
  response.writeHead(body ? 200 : 404, { "content-type": kind });
  response.end(body);
});
await new Promise(resolve => server.listen(0, "127.0.0.1", resolve));
const browser = await openBrowser({ width: 400, height: 300 });
let failures = 0;
const expect = (good, text) => { console.log(good ? "ok  " : "FAIL", text); failures += !good; };

await browser.open(`http://127.0.0.1:${server.address().port}/`);
await browser.run(`(async () => {
  while (!window.mangata) await new Promise(r => setTimeout(r, 10));
  const Plain = Worker;
  window.workers = { made: 0, ended: 0 };
  window.Worker = class extends Plain { constructor(a) { super(a); workers.made++; } terminate() { workers.ended++; super.terminate(); } };
  window.canvasOf = (width, height) => Object.assign(document.createElement("canvas"), { width, height });
  window.wordOf = async work => { try { await work(); return "no error"; } catch (error) { return error.message; } };
  window.pixelsOf = canvas => {
    const copy = canvasOf(canvas.width, canvas.height), to = copy.getContext("2d");
    to.drawImage(canvas, 0, 0);
    return Array.from(to.getImageData(0, 0, copy.width, copy.height).data);
  };
})()`);
// The value of a function's body that may wait, in the page.
const run = body => browser.run(`(async () => { const { create, setScene, render, destroy } = mangata; ${body} })()`);

expect(await run("return Object.keys(mangata).sort().join()") === "create,destroy,render,setScene", "four functions");
const drawn = await run(`window.view = await create(canvasOf(64, 36));
  setScene(view, { wind: 12, elevation: 8 });
  await render(view, { time: 3, way: "lanes" });
  window.first = pixelsOf(view.canvas); return new Set(first).size`);
expect(drawn > 50, `a picture of ${drawn} values`);

// ---- what is refused ----

for (const [change, word] of [
  ["elevation: 'abc'", "elevation is \"abc\"; allowed: a number from -2 to 85°"],
  ["elevation: NaN", "elevation is NaN; allowed: a number from -2 to 85°"],
  ["turbidity: -5", "turbidity is -5; allowed: a number from 1 to 10"],
  ["height: -5", "height is -5; allowed: a number from 0.5 to 200 m"],
  ["pitch: 90", "pitch is 90; allowed: a number from -85 to 30°"],
  ["exposure: 1e9", "exposure is 1000000000; allowed: a number from -5 to 5 stops"],
  ["time: NaN", "time is NaN; allowed: a number from 0 to 3600 s"],
  ["moon: 2", "moon is 2; allowed: a whole number from 0 to 1"],
  ["seed: 1.5", "seed is 1.5; allowed: a whole number from 1 to 99"],
  ["waves: 5000", "waves is 5000; allowed: a whole number from 16 to 1024"],
  ["choppiness: 5", "choppiness is 5; allowed: a number from 0 to 1"],
  ["wind: 33, fetch: 0.1", "no sea has a wind of 33 m/s over a fetch of 0.1 km; allowed: a longer fetch, or 0 for a fully developed sea"],
  ["toString: 1", "there is no setting toString; allowed: wind, "],
]) {
  const [got, same] = await run(`const old = JSON.stringify(view.settings), word = await wordOf(() => setScene(view, { ${change} }));
    return [word, old === JSON.stringify(view.settings)]`);
  expect(got.startsWith(word) && same, `setScene: ${change}: ${got}`);
}
for (const [options, word] of [
  ["method: 'toString'", "there is no method \"toString\"; allowed: none, "],
  ["way: 'bogus'", "there is no way \"bogus\"; allowed: shaders, lanes"],
  ["time: NaN", "time is NaN; allowed: a number from -1e8 to 1e8 s"],
]) {
  const got = await run(`return wordOf(() => render(view, { ${options} }))`);
  expect(got.startsWith(word), `render: ${options}: ${got}`);
}
const taken = await run(`const canvas = canvasOf(8, 8), running = workers.made - workers.ended;
  canvas.getContext("2d");
  return [await wordOf(() => create(canvas)), await wordOf(() => create(null)), workers.made - workers.ended - running]`);
expect(/^the canvas has a context of another kind/.test(taken[0]) && taken[1] === "create() needs a canvas", `create: ${taken.slice(0, 2).join("; ")}`);
expect(taken[2] === 0, "what create() refuses keeps no workers");
const again = await run(`await render(view, { time: 3, way: "lanes" }); return JSON.stringify(pixelsOf(view.canvas)) === JSON.stringify(first)`);
expect(again, "after errors, the same picture");

// ---- canvases ----

const sizes = await run(`const { canvas } = view, draw = () => render(view, { time: 3, way: "lanes" }), got = [];
  for (const width of [96, 112]) {
    const drawing = draw();
    await new Promise(r => setTimeout(r, 1));
    canvas.width = width;
    await drawing;
    got.push(canvas.width, new Set(pixelsOf(canvas)).size > 50);
  }
  await draw();
  return [...got, view.target.width]`);
expect(sizes.join() === "96,true,112,true,112", `sizes of a canvas that is resized while it is drawn: ${sizes}`);

const lost = await run(`const view = await create(canvasOf(64, 36)), draw = () => render(view, { time: 3, way: "lanes" });
  const loser = view.canvas.getContext("webgl2").getExtension("WEBGL_lose_context");
  setScene(view, { wind: 12, elevation: 8 });
  await draw();
  const restored = new Promise(resolve => view.canvas.addEventListener("webglcontextrestored", resolve));
  const during = draw();
  loser.loseContext();
  const words = [await wordOf(() => during), await wordOf(draw)];
  await new Promise(r => setTimeout(r, 50));
  loser.restoreContext();
  await restored;
  await draw();
  const same = JSON.stringify(pixelsOf(view.canvas)) === JSON.stringify(first);
  await destroy(view);
  return [...words, same]`);
expect(lost.slice(0, 2).every(word => /has lost its WebGL context; .* webglcontextrestored/.test(word)), `a lost context: ${lost.slice(0, 2).join("; ")}`);
expect(lost[2], "the same picture when it is back");

// ---- ends ----

const ended = await run(`const other = await create(view.canvas), giveUp = render(other, { time: 4 }), word = wordOf(() => giveUp);
  await destroy(other);
  const words = [await word, await wordOf(() => render(other))];
  await render(view, { time: 4, way: "lanes" }); // in the same canvas
  await destroy(view);
  await destroy(view);
  return [...words, workers.made, workers.ended]`);
expect(ended[0] === "the view has been destroyed" && ended[1] === ended[0], `a view that is destroyed: ${ended.slice(0, 2).join("; ")}`);
expect(ended[2] > 0 && ended[2] === ended[3], `${ended[2]} workers made, ${ended[3]} ended`);

const errors = browser.errors.filter(e => !/CONTEXT_LOST_WEBGL/.test(e));
expect(errors.length === 0, `no errors on the console: ${errors.join(" | ").slice(0, 400)}`);
await browser.close();
server.close();
process.exit(failures ? 1 : 0);
