/* SPDX-License-Identifier: MIT */
/* x–t strips: one row of pixels of every shown frame, below each other. */

function setRow(row) {
  state.row = row;
  document.getElementById("row").value = String(row);
  document.getElementById("row-text").textContent = String(row);
  drawStrips();
}

let strips = 0;
async function drawStrips() {
  const turn = ++strips, view = {...state}, pictures = [...new Set([0, state.a, state.b])];
  const loaded = await Promise.all(pictures.map(picture => Promise.all(
    Array.from({length: report.shown}, (_, frame) => loadBits(view, picture, frame)))));
  if (turn !== strips)
    return;
  const {width} = state.scene, channels = state.layer.channels, table = displayBytes(2 ** state.exposure / state.layer.scale);
  const host = document.getElementById("strips");
  host.replaceChildren(...pictures.map((picture, p) => {
    const strip = document.createElement("div"), name = document.createElement("span"), canvas = document.createElement("canvas");
    strip.className = "strip";
    name.textContent = pictureName(picture);
    canvas.width = width;
    canvas.height = report.shown;
    canvas.style.height = `${Math.max(36, Math.min(12 * report.shown, 240))}px`;
    canvas.setAttribute("role", "img");
    canvas.setAttribute("aria-label", `${pictureName(picture)}, row ${state.row} over ${report.shown} frames`);
    const context = canvas.getContext("2d"), image = context.createImageData(width, report.shown);
    for (let frame = 0; frame < report.shown; frame++)
      for (let x = 0; x < width; x++) {
        const at = channels * (state.row * width + x), out = 4 * (frame * width + x);
        for (let c = 0; c < 3; c++)
          image.data[out + c] = table[loaded[p][frame][at + (channels === 3 ? c : 0)]];
        image.data[out + 3] = 255;
      }
    context.putImageData(image, 0, 0);
    strip.append(name, canvas);
    return strip;
  }));
}
