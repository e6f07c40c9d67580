// SPDX-License-Identifier: MIT
// Screenshots of the page at rest, with the judge's first word: screens.mjs PAGE FOLDER. Desktop, dark and light, and phone; and how long the first picture takes.
import { writeFileSync } from "node:fs";
import { join, resolve } from "node:path";
import { openBrowser } from "./browser.mjs";

const [page, folder] = process.argv.slice(2);
const views = [["desktop", 1280, 720, 1, "dark", ""], ["light", 1280, 720, 1, "light", "#methods=none~mangata&elevation=7&wind=5&fetch=40&direction=30"],
  ["phone", 390, 844, 2, "dark", "#methods=ggx-moments~mangata&moon=1&wind=3&swell=1.5&elevation=16&height=4"]];
for (const [name, width, height, scale, scheme, link] of views) {
  const browser = await openBrowser({ width, height });
  try {
    await browser.size(width, height, scale, name === "phone");
    await browser.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: scheme }] });
    await browser.open("file://" + resolve(page) + link);
    await browser.run(`(async () => { while (page.frames < 3) await new Promise(r => setTimeout(r, 50));
      page.settings.time = 10; setPlaying(false);
      while (!page.settled || page.pictures[0].width < sizes(() => 1)[0] || page.figures.length === 0) await new Promise(r => setTimeout(r, 100)); showFigures(); })()`);
    console.log(name, "first picture after", Math.round(await browser.run("page.firstPicture")), "ms;", (await browser.run("document.getElementById('figures').textContent")).replaceAll("\n", "; "));
    writeFileSync(join(folder, `web-${name}.png`), await browser.screenshot());
    if (browser.errors.length) console.log(browser.errors.slice(0, 3));
  } finally {
    await browser.close();
  }
}
process.exit(0);
