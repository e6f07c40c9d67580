// SPDX-License-Identifier: MIT
// Settings as links and as commands, and the seas of the gallery.

const GALLERY = [
  { name: "Evening breeze", wind: 5, fetch: 40, elevation: 7, direction: 30 },
  { name: "The road of light", wind: 7, elevation: 12, height: 3 },
  { name: "Moonlit swell", wind: 3, swell: 1.5, swell_direction: 20, moon: 1, elevation: 16, height: 4, pitch: -5 },
  { name: "Gale", wind: 19, direction: -50, elevation: 15, height: 9, pitch: -5, fov: 42 },
  { name: "Noon from above", wind: 9, elevation: 58, height: 60, pitch: -38 },
  { name: "Last light", wind: 4, fetch: 15, elevation: 0.5, turbidity: 3.5, pitch: -4, fov: 38 },
];

function decimals(setting) { return setting.step > 0 && setting.step < 1 ? Math.ceil(-Math.log10(setting.step) - 1e-9) : 0; }

// A value within the setting's range, to its step's decimals.
function fitted(setting, value) {
  const v = Math.min(setting.most, Math.max(setting.least, Number(value)));
  return Number.isFinite(v) ? Number(v.toFixed(decimals(setting))) : setting.preset;
}

// What differs from the presets, behind the page's address; the time where the picture stands still.
function linkOf(settings, methods, timed) {
  const words = SETTINGS.filter(s => (s.name === "time" ? timed : settings[s.name] !== s.preset)).map(s => `${s.name}=${settings[s.name]}`);
  return "#" + [`methods=${methods.join("~")}`, ...words].join("&");
}

function settingsOfLink(hash) {
  const words = new URLSearchParams(hash.replace(/^#/, "")), settings = presets();
  for (const s of SETTINGS) if (words.has(s.name)) settings[s.name] = fitted(s, words.get(s.name));
  const methods = (words.get("methods") || "").split("~").filter(m => m in METHODS);
  return { settings, methods, timed: words.has("time") };
}

// The command that renders the same picture. Glare is left out, for the page draws none.
function commandOf(settings, method, width, height) {
  const target = cameraTarget(settings), sea = [], set = [];
  const units = { "sea fetch": 1000 };
  for (const s of SETTINGS) {
    const [kind, key] = s.place.split(" "), value = settings[s.name];
    if (kind === "sea" && (value !== 0 || s.name === "wind") && !(s.name.startsWith("swell") && settings.swell === 0)) sea.push(`${key}=${value * (units[s.place] || 1)}`);
    if (kind === "set" && s.name === "moon") set.push(`${key}=${value ? "moon" : "sun"}`);
    else if (kind === "set") set.push(`${key}=${value}`);
  }
  set.push("post.glare=0", `camera.position=[0,${settings.height},0]`, `camera.target=[${target.join(",")}]`);
  return `mangata render --sea ${sea.join(",")} ${set.map(word => `--set '${word}'`).join(" ")} --method ${method} --size ${width}x${height} --frames 0 -o sea.png`;
}
