/* SPDX-License-Identifier: MIT */
/* Pictures out of the page: base64, zlib, differences, half floats (tools/compare_pixels.c writes them). */

const halfValues = (() => {
  const values = new Float32Array(65536);
  for (let bits = 0; bits < 65536; bits++) {
    const exponent = bits >> 10 & 31, mantissa = bits & 1023;
    const magnitude = exponent ? (1 + mantissa / 1024) * 2 ** (exponent - 15) : mantissa * 2 ** -24;
    values[bits] = bits & 0x8000 ? -magnitude : magnitude;
  }
  return values;
})();

async function inflate(base64) {
  const text = atob(base64), bytes = new Uint8Array(text.length);
  for (let i = 0; i < text.length; i++)
    bytes[i] = text.charCodeAt(i);
  const stream = new Blob([bytes]).stream().pipeThrough(new DecompressionStream("deflate"));
  return new Uint8Array(await new Response(stream).arrayBuffer());
}

/* Undoes the differences of each channel; of three channels G, R − G, B − G become R, G, B. */
function unpack(planes, width, height, channels) {
  const pixels = width * height, values = pixels * channels, ordered = new Uint16Array(values);
  for (let c = 0; c < channels; c++) {
    let left = 0, above = 0;
    for (let i = 0; i < pixels; i++) {
      const p = c * pixels + i, first = i % width === 0;
      left = (first ? above : left) + (planes[p] << 8 | planes[values + p]) & 65535;
      if (first)
        above = left;
      ordered[p] = left;
    }
  }
  if (channels < 3)
    return ordered;
  const bits = new Uint16Array(values);
  for (let i = 0; i < pixels; i++) {
    const green = ordered[i];
    bits[3 * i] = ordered[pixels + i] + green;
    bits[3 * i + 1] = green;
    bits[3 * i + 2] = ordered[2 * pixels + i] + green;
  }
  return bits;
}

const pictureCache = new Map();

/* A promise of the bits of a picture's halves, one for each channel of each pixel. */
function loadPicture(layer, scene, picture, frame) {
  const id = `${layer.name}-${scene.index}-${picture}-${frame}`;
  if (!pictureCache.has(id)) {
    const text = document.getElementById(id).textContent;
    pictureCache.set(id, inflate(text).then(planes => unpack(planes, scene.width, scene.height, layer.channels)));
  }
  return pictureCache.get(id);
}
