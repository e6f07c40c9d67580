// SPDX-License-Identifier: MIT
// A page in headless Chromium, driven by the DevTools protocol over a pipe. Node alone.
import { spawn } from "node:child_process";
import { mkdtempSync, rmSync, existsSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";

const PROGRAMS = ["/usr/bin/chromium-headless-shell", "/usr/bin/chromium"];

// Runs work(ended) for so many seconds at most. False: the time ended before it was done; what it still waits for is left.
export async function withinSeconds(seconds, work) {
  let over = false, timer;
  const limit = new Promise(resolve => { timer = setTimeout(() => { over = true; resolve(false); }, seconds * 1000); });
  const done = work(() => over).then(() => true, error => { if (!over) throw error; return false; });
  const whole = await Promise.race([done, limit]);
  clearTimeout(timer);
  return whole && !over;
}

// Exit code 77 says that a test cannot run here.
export async function openBrowser({ width = 1280, height = 720 } = {}) {
  const program = PROGRAMS.find(existsSync);
  if (!program) {
    console.log("skipped: there is no chromium-headless-shell");
    process.exit(77);
  }
  const profile = mkdtempSync(join(tmpdir(), "web-test-"));
  const child = spawn(program, ["--headless", "--no-sandbox", "--remote-debugging-pipe", "--use-angle=swiftshader", "--use-gl=angle", "--enable-unsafe-swiftshader",
    "--enable-precise-memory-info", "--hide-scrollbars", `--window-size=${width},${height}`, `--user-data-dir=${profile}`, "about:blank"],
    { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
  let next = 1, rest = "", session;
  const waiting = new Map(), listeners = [];
  child.stdio[4].on("data", data => {
    const parts = (rest + data).split("\0");
    rest = parts.pop();
    for (const part of parts) {
      const message = JSON.parse(part);
      if (message.id) {
        const [resolve, reject] = waiting.get(message.id);
        waiting.delete(message.id);
        message.error ? reject(new Error(message.error.message)) : resolve(message.result);
      } else listeners.forEach(f => f(message));
    }
  });
  const send = (method, params = {}) => new Promise((resolve, reject) => {
    waiting.set(next, [resolve, reject]);
    child.stdio[3].write(JSON.stringify({ id: next++, method, params, ...(session ? { sessionId: session } : {}) }) + "\0");
  });
  const { targetInfos } = await send("Target.getTargets");
  session = (await send("Target.attachToTarget", { targetId: targetInfos.find(t => t.type === "page").targetId, flatten: true })).sessionId;
  await send("Runtime.enable");
  await send("Page.enable");
  await send("Log.enable");
  const errors = [];
  listeners.push(m => {
    if (m.method === "Runtime.exceptionThrown") errors.push(m.params.exceptionDetails.exception?.description || m.params.exceptionDetails.text);
    if (m.method === "Runtime.consoleAPICalled" && m.params.type === "error") errors.push(m.params.args.map(a => a.value).join(" "));
    if (m.method === "Log.entryAdded" && m.params.entry.level === "error") errors.push(m.params.entry.text);
  });
  return {
    send, errors, listen: f => listeners.push(f),
    async open(address) {
      const loaded = new Promise(resolve => listeners.push(m => m.method === "Page.loadEventFired" && resolve()));
      await send("Page.navigate", { url: address });
      await loaded;
    },
    async run(expression) {
      const { result, exceptionDetails } = await send("Runtime.evaluate", { expression, awaitPromise: true, returnByValue: true });
      if (exceptionDetails) throw new Error(exceptionDetails.exception?.description || exceptionDetails.text);
      return result.value;
    },
    async screenshot() { return Buffer.from((await send("Page.captureScreenshot", { format: "png" })).data, "base64"); },
    size: (w, h, scale = 1, mobile = false) => send("Emulation.setDeviceMetricsOverride", { width: w, height: h, deviceScaleFactor: scale, mobile }),
    async close() {
      const ended = new Promise(resolve => child.on("exit", resolve));
      child.kill("SIGKILL");
      await ended;
      rmSync(profile, { recursive: true, force: true });
    },
  };
}
