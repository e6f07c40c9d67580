/* SPDX-License-Identifier: MIT */
/* From values to bytes: exposure and sRGB, and two false colour scales. */

function encode(linear) {
  if (!(linear > 0))
    return 0;
  if (linear >= 1)
    return 255;
  return Math.round(255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * linear ** (1 / 2.4) - 0.055));
}

/* Bytes of all halves after multiplying by `factor`. */
let displayTable = {factor: NaN, bytes: null};
function displayBytes(factor) {
  if (displayTable.factor !== factor) {
    const bytes = new Uint8Array(65536);
    for (let bits = 0; bits < 65536; bits++)
      bytes[bits] = encode(halfValues[bits] * factor);
    displayTable = {factor, bytes};
  }
  return displayTable.bytes;
}

/* Green's cube helix: lightness rises evenly, so that the scale reads in grey as well. */
function errorColor(t) {
  const x = Math.min(Math.max(t, 0), 1), angle = 2 * Math.PI * (0.25 - 1.15 * x), depth = 1.1 * x * (1 - x) / 2;
  const cos = Math.cos(angle), sin = Math.sin(angle);
  return [x + depth * (-0.14861 * cos + 1.78277 * sin), x + depth * (-0.29227 * cos - 0.90649 * sin), x + depth * 1.97294 * cos]
    .map(v => Math.round(255 * Math.min(Math.max(v, 0), 1)));
}

/* Blue below, red above, white at 0. */
function differenceColor(t) {
  const x = Math.min(Math.abs(t), 1), end = t < 0 ? [12, 62, 140] : [150, 22, 24];
  return end.map(v => Math.round(250 + (v - 250) * x ** 0.7));
}

const errorTable = Array.from({length: 256}, (_, i) => errorColor(i / 255));
const differenceTable = Array.from({length: 511}, (_, i) => differenceColor((i - 255) / 255));

/* The least of 1, 2, 5 × 10ⁿ that is not below x. */
function niceCeiling(x) {
  if (!(x > 0))
    return 1;
  const power = 10 ** Math.floor(Math.log10(x));
  return [1, 2, 5, 10].map(d => d * power).find(v => v >= x * 0.9999);
}

function shortNumber(x) {
  if (x === null || x === undefined || Number.isNaN(x))
    return "–";
  const magnitude = Math.abs(x);
  return magnitude !== 0 && (magnitude < 1e-3 || magnitude >= 1e5) ? x.toExponential(2) : x.toPrecision(4);
}

const methodColors = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#a6761d", "#56b4e9", "#e69f00", "#7f7f7f", "#8c5fc4", "#4c9a2a"];
