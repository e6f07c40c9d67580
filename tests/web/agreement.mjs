// SPDX-License-Identifier: MIT
// The page's pictures against the command's: agreement.mjs PAGE MANGATA WIDTH HEIGHT SCENES [SECONDS]. Prints the RMSE of displayed values and the times of frames.
import { execFileSync } from "node:child_process";
import { mkdtempSync, rmSync, statSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { openBrowser } from "./browser.mjs";

const [page, mangata, width, height, count, seconds] = process.argv.slice(2);
const MOST_RMSE = 0.01, MOST_BYTES = 400e3;
const MOST_SECONDS = Number(seconds || 45); // of a software GL that other work slows down
const browser = await openBrowser();
setTimeout(async () => {
  console.log("skipped: this machine's WebGL2 is too slow now");
  await browser.close();
  process.exit(failed ? 1 : 77);
}, MOST_SECONDS * 1000).unref();
const folder = mkdtempSync(join(tmpdir(), "web-agreement-"));
let failed = statSync(page).size > MOST_BYTES;
console.log(`size ${(statSync(page).size / 1000).toFixed(0)} KB`);
try {
  await browser.open("file://" + resolve(page) + "#still");
  await browser.run(`(async () => {
    const canvas = Object.assign(document.createElement("canvas"), { width: ${width}, height: ${height} });
    window.tested = await create(canvas);
  })()`);
  for (const scene of (await browser.run("GALLERY")).slice(0, Number(count)))
    for (const method of ["none", "ggx-moments", "bruneton", "taa", "mangata"]) {
      const { name, ...changes } = scene;
      const drawn = await browser.run(`(async () => {
        setScene(tested, { ...presets(), ...${JSON.stringify(changes)} });
        const gl = tested.engine.gl, drawn = () => gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, new Uint8Array(4)); // waits for the picture
        await render(tested, { method: "${method}" });
        drawn();
        const start = performance.now();
        await render(tested, { method: "${method}" });
        drawn();
        const frame = performance.now() - start;
        return { frame, times: tested.engine.times, command: commandOf(tested.settings, "${method}", ${width}, ${height}), png: tested.canvas.toDataURL().split(",")[1] };
      })()`);
      const [ours, theirs] = [join(folder, "page.png"), join(folder, "sea.png")];
      writeFileSync(ours, Buffer.from(drawn.png, "base64"));
      execFileSync("sh", ["-c", `${drawn.command.replace(/^mangata/, resolve(mangata))} --overwrite -q`], { cwd: folder });
      const rmse = JSON.parse(execFileSync(mangata, ["diff", ours, theirs, "--metrics", "rmse", "--json"])).rmse;
      failed ||= !(rmse <= MOST_RMSE);
      console.log(`${name}, ${method}: RMSE ${rmse.toFixed(5)}, frame ${drawn.frame.toFixed(0)} ms, of which tiles ${drawn.times.prepare.toFixed(0)} ms`);
    }
  failed ||= browser.errors.length > 0;
  console.log(`errors on the console: ${browser.errors.length} ${browser.errors.slice(0, 3).join("; ")}`);
} finally {
  await browser.close();
  rmSync(folder, { recursive: true });
}
process.exit(failed ? 1 : 0);
