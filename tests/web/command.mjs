// SPDX-License-Identifier: MIT
// What the command that the page prints renders, beside what the page shows.
import { execFile } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join, resolve } from "node:path";
import { promisify } from "node:util";

const run = promisify(execFile);

// RMSE of displayed values between a PNG in base64 and the picture of a command that begins with "mangata"; `mangata` is the program's path.
export async function rmseOfCommand(mangata, command, png) {
  const folder = mkdtempSync(join(tmpdir(), "web-command-")), [ours, theirs] = [join(folder, "page.png"), join(folder, "sea.png")];
  try {
    writeFileSync(ours, Buffer.from(png, "base64"));
    await run("sh", ["-c", `${command.replace(/^mangata/, resolve(mangata))} -q`], { cwd: folder });
    return JSON.parse((await run(mangata, ["diff", ours, theirs, "--metrics", "rmse", "--json"])).stdout).rmse;
  } finally {
    rmSync(folder, { recursive: true });
  }
}
