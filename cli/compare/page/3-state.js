/* SPDX-License-Identifier: MIT */
/* What is shown. Pictures are numbered 0: the reference, n: method n. */

const report = JSON.parse(document.getElementById("report-data").textContent);
report.scenes.forEach((scene, index) => { scene.index = index; });

const state = {
  scene: report.scenes[0],
  layer: report.scenes[0].layers[0],
  a: report.scenes[0].methods.length,
  b: 0,
  mode: "flip",
  frame: 0,
  exposure: 0,
  zoom: 1,
  center: [0.5, 0.5],
  wipe: 0.5,
  pixel: null,
  row: 0,
};

const pictureCount = () => state.scene.methods.length + 1;
const pictureName = picture => picture === 0 ? "reference" : state.scene.methods[picture - 1].method;

/* What waits for pictures works on a copy of the state, `view`: the state may have moved on before they are there. */
function loadBits(view, picture, frame) {
  return loadPicture(view.layer, view.scene, picture, frame);
}

/* Calls `visit(pixel index, signed mean difference, root mean square)` for each pixel of A − B. */
function forEachDifference(layer, a, b, visit) {
  const channels = layer.channels, pixels = a.length / channels, unit = 1 / layer.scale;
  for (let i = 0; i < pixels; i++) {
    let sum = 0, squares = 0;
    for (let c = 0; c < channels; c++) {
      const d = (halfValues[a[channels * i + c]] - halfValues[b[channels * i + c]]) * unit;
      sum += d;
      squares += d * d;
    }
    visit(i, sum / channels, Math.sqrt(squares / channels));
  }
}

/* √ mean over the shown frame steps of the step's error squared, one number a pixel. */
const flickerCache = new Map();
function flickerMap(view, picture) {
  const key = `${view.scene.index} ${view.layer.name} ${picture}`;
  if (!flickerCache.has(key))
    flickerCache.set(key, measureFlicker(view, picture));
  return flickerCache.get(key);
}

async function measureFlicker({scene, layer}, picture) {
  const channels = layer.channels, unit = 1 / layer.scale, steps = report.shown - 1, load = (...which) => loadPicture(layer, scene, ...which);
  const sums = new Float32Array(scene.width * scene.height);
  for (let frame = 1; frame <= steps; frame++) {
    const [a, b, before, beforeB] = await Promise.all([load(picture, frame), load(0, frame), load(picture, frame - 1), load(0, frame - 1)]);
    for (let i = 0; i < a.length; i++) {
      const d = (halfValues[a[i]] - halfValues[before[i]] - halfValues[b[i]] + halfValues[beforeB[i]]) * unit;
      sums[i / channels | 0] += d * d / channels;
    }
  }
  return sums.map(v => Math.sqrt(v / Math.max(steps, 1)));
}

/* The value that all but half a per cent of the pixels stay below. */
function highQuantile(values) {
  return Float32Array.from(values).sort()[Math.floor(0.995 * (values.length - 1))];
}

/* One scale for all methods of a scene and layer, so that colours can be compared: promises of its end, from the method in the middle. */
const scaleCache = new Map();
function sharedScale({scene, layer}, kind) {
  const key = `${kind} ${scene.index} ${layer.name}`;
  if (!scaleCache.has(key))
    scaleCache.set(key, (async () => {
      const ends = [];
      for (let picture = 1; picture <= scene.methods.length; picture++) {
        let values;
        if (kind === "flicker") {
          values = await flickerMap({scene, layer}, picture);
        } else {
          const [a, b] = await Promise.all([loadPicture(layer, scene, picture, 0), loadPicture(layer, scene, 0, 0)]);
          values = new Float32Array(scene.width * scene.height);
          forEachDifference(layer, a, b, (i, mean, rms) => { values[i] = rms; });
        }
        ends.push(highQuantile(values));
      }
      return niceCeiling(ends.sort((x, y) => x - y)[ends.length >> 1]);
    })());
  return scaleCache.get(key);
}

/* The same as the exposure has it: a stop up halves what the brightest colour stands for. */
async function scaleEnd(view, kind) {
  return await sharedScale(view, kind) / 2 ** (view.exposure - view.layer.exposure);
}
