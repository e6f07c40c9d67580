// SPDX-License-Identifier: MIT
// Every setting of the page at another value, and every sea of its gallery, through a link: commands.mjs PAGE MANGATA. The picture must be that of the command which the page
// prints, and a setting must change it. Exit code 1 where one does not.
import { resolve } from "node:path";
import { openBrowser } from "./browser.mjs";
import { rmseOfCommand } from "./command.mjs";

const [page, mangata] = process.argv.slice(2);
const MOST_RMSE = 0.01, WIDTH = 192, HEIGHT = 108;
const browser = await openBrowser({ width: 320, height: 200 });
let failed = false, worst = 0, count = 0;
try {
  await browser.open("file://" + resolve(page) + "#still");
  const cases = await browser.run(`(async () => {
    window.tested = await create(Object.assign(document.createElement("canvas"), { width: ${WIDTH}, height: ${HEIGHT} }));
    const base = { ...presets(), wind: 14, swell: 2, swell_direction: 40 };
    const other = s => (base[s.name] < (s.least + s.most) / 2 ? 0.3 * s.least + 0.7 * s.most : 0.7 * s.least + 0.3 * s.most);
    return [["as a beginning", base], ...SETTINGS.map(s => [s.label + ", " + s.name, { ...base, [s.name]: fitted(s, s.name === "moon" ? 1 : other(s)) }]),
      ...GALLERY.map(({ name, ...values }) => [name, { ...presets(), ...values }])];
  })()`);
  let first;
  for (const [name, settings] of cases) {
    const { command, png } = await browser.run(`(async () => {
      setScene(tested, settingsOfLink(linkOf(${JSON.stringify(settings)}, ["none", "mangata"], true)).settings);
      await render(tested, { way: "lanes" });
      return { command: commandOf(tested.settings, "mangata", ${WIDTH}, ${HEIGHT}), png: tested.canvas.toDataURL().split(",")[1] };
    })()`);
    const rmse = await rmseOfCommand(mangata, command, png), same = first === png;
    first ??= png;
    worst = Math.max(worst, rmse);
    count++;
    if (!(rmse <= MOST_RMSE) || same) {
      failed = true;
      console.log(`FAIL: ${name}: RMSE ${rmse.toFixed(5)}${same ? ", the picture is as before" : ""}: ${command}`);
    }
  }
  failed ||= browser.errors.length > 0;
  console.log(`${count} pictures, RMSE at most ${worst.toFixed(5)}; errors on the console: ${browser.errors.length} ${browser.errors.slice(0, 3).join("; ")}`);
} finally {
  await browser.close();
}
process.exit(failed ? 1 : 0);
