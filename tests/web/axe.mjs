// SPDX-License-Identifier: MIT
// Accessibility of the page by axe-core: axe.mjs PAGE AXE.min.js, which `npm install axe-core` brings. Dark and light, desktop and phone. Exit code 1 where there is a serious finding.
import { readFileSync } from "node:fs";
import { resolve } from "node:path";
import { openBrowser } from "./browser.mjs";

const [page, axe] = process.argv.slice(2);
const browser = await openBrowser();
let serious = 0;
try {
  for (const [width, height, scheme] of [[1000, 700, "dark"], [1000, 700, "light"], [390, 844, "dark"]]) {
    await browser.size(width, height, 1, width < 640);
    await browser.send("Emulation.setEmulatedMedia", { features: [{ name: "prefers-color-scheme", value: scheme }, { name: "prefers-reduced-motion", value: "reduce" }] });
    await browser.open("about:blank");
    await browser.open("file://" + resolve(page));
    await browser.run("(async () => { while (!page.firstPicture) await new Promise(r => setTimeout(r, 50)); page.judge.begin = async () => {}; })()"); // which would take the time of the audit
    await browser.run(readFileSync(axe, "utf8") + "; 0");
    const findings = await browser.run("axe.run().then(r => r.violations.map(v => [v.impact, v.id, v.nodes.length, v.nodes[0].html.slice(0, 80)]))");
    for (const [impact, id, count, where] of findings) {
      console.log(`${width} x ${height}, ${scheme}: ${impact}: ${id}, ${count} places: ${where}`);
      serious += impact === "serious" || impact === "critical";
    }
  }
  console.log("serious findings:", serious);
} finally {
  await browser.close();
}
process.exit(serious ? 1 : 0);
