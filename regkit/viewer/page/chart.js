/** Draws what the timeline tells: verdicts in ribbons, a curve of each method, marks, numbers. */

import { colour, readable } from "./theme.js";

const AXIS = 25;
const ROW = 9;
const GAP = 4;
const CURVE = 64;

/** How high a verdict is drawn in its ribbon: what is worse is higher, also without colours. */
const HEIGHTS = { found: 0.34, doubtful: 0.67, lost: 1, "no data": 1 };

/**
 * Where things are in the chart, in pixels of the page.
 * @typedef {{left: number, right: number, height: number, first: number, last: number}} Scale
 */

/** Returns where a frame number is across. @param {Scale} scale */
export const across = ({ left, right, first, last }, number) =>
  left + ((number - first) / Math.max(last - first, 1)) * (right - left);

/** Returns the frame number at a place across. @param {Scale} scale */
export const numberAt = ({ left, right, first, last }, x) =>
  first + ((x - left) / Math.max(right - left, 1)) * Math.max(last - first, 1);

/**
 * Returns the scale of a chart of a width.
 * @param {import("./recording.js").Recording} recording
 */
export function scaleOf(recording, width, methods, quantity) {
  const [first, last] = recording.range;
  const height = AXIS + methods.length * (ROW + GAP) + (quantity ? CURVE : 0) + 4;
  return { left: width > 700 ? 112 : 44, right: width - 10, height, first, last };
}

/**
 * @param {CanvasRenderingContext2D} pen
 * @param {Scale} scale
 * @param {import("./recording.js").Recording} recording
 * @param {any[]} methods The methods that are shown.
 * @param {string} quantity Name of the curve.
 */
export function drawChart(pen, scale, recording, methods, quantity) {
  pen.font = `11px ${getComputedStyle(document.body).fontFamily}`;
  pen.textBaseline = "middle";
  drawAxis(pen, scale, recording);
  let top = AXIS;
  for (const method of methods) {
    drawRibbon(pen, scale, method, top);
    top += ROW + GAP;
  }
  if (quantity) drawCurves(pen, scale, methods, quantity, top + 4);
}

function drawAxis(pen, scale, recording) {
  const [room, span] = [scale.right - scale.left, scale.last - scale.first];
  const step =
    [1, 2, 5]
      .flatMap((one) => [0, 1, 2, 3, 4, 5, 6].map((power) => one * 10 ** power))
      .sort((a, b) => a - b)
      .find((one) => (one / Math.max(span, 1)) * room > 64) ?? span;
  pen.textAlign = "center";
  pen.strokeStyle = colour("rule");
  pen.lineWidth = 1;
  for (let number = Math.ceil(scale.first / step) * step; number <= scale.last; number += step) {
    const x = Math.round(across(scale, number)) + 0.5;
    pen.beginPath();
    pen.moveTo(x, AXIS - 3);
    pen.lineTo(x, scale.height);
    pen.stroke();
    pen.fillStyle = colour("soft");
    pen.fillText(number, x, 7);
  }
  pen.fillStyle = colour("ink");
  for (const { frame } of recording.marks) {
    const x = across(scale, frame);
    pen.beginPath();
    pen.moveTo(x - 4.5, AXIS - 7);
    pen.lineTo(x + 4.5, AXIS - 7);
    pen.lineTo(x, AXIS - 0.5);
    pen.fill();
  }
}

function drawRibbon(pen, scale, method, top) {
  pen.fillStyle = readable(method.colour);
  pen.fillRect(0, top, 9, ROW);
  pen.fillStyle = colour("soft");
  pen.textAlign = "left";
  if (scale.left > 100)
    pen.fillText(clipped(pen, method.name, scale.left - 24), 14, top + ROW / 2 + 0.5);
  const { starts, words, end } = method.verdicts;
  const width = (scale.right - scale.left) / Math.max(scale.last - scale.first, 1);
  words.forEach((word, run) => {
    // A frame is as wide as the distance to the next, but what is bad is always seen.
    const from = Math.max(scale.left, across(scale, starts[run]) - width / 2);
    const to = Math.min(scale.right, across(scale, starts[run + 1] ?? end) - width / 2);
    if (from > scale.right || to < scale.left) return undefined;
    const wide = Math.max(to - from, word === "found" ? 0 : 1.5);
    const high = ROW * (HEIGHTS[word] ?? 1);
    pen.fillStyle = colour(word.replace(" ", "-"));
    if (word !== "no data") return pen.fillRect(from, top + ROW - high, wide, high);
    // Frames without data are hollow.
    pen.fillRect(from, top, wide, 1.5);
    return pen.fillRect(from, top + ROW - 1.5, wide, 1.5);
  });
}

function drawCurves(pen, scale, methods, quantity, top) {
  const curves = methods.flatMap((method) =>
    method.curves.filter((curve) => curve.name === quantity).map((curve) => [method, curve]),
  );
  let [low, high] = [Infinity, -Infinity];
  for (const [, { values }] of curves) {
    for (let i = 0; i < values.length; i++) {
      if (values[i] < low) low = values[i];
      if (values[i] > high) high = values[i];
    }
  }
  if (low > high) return;
  if (low >= 0 && low < 0.6 * high) low = 0;
  if (low === high) [low, high] = [Math.min(low, 0), Math.max(high, 0) || 1];
  const [ceiling, floor] = [top + 6, scale.height - 6];
  const y = (value) => floor - ((value - low) / (high - low)) * (floor - ceiling);
  const unit = curves[0][1].unit;
  pen.textAlign = "right";
  pen.fillStyle = colour("soft");
  const digits = high - low >= 20 ? 0 : high - low >= 2 ? 1 : high - low >= 0.02 ? 2 : 4;
  for (const value of [low, high]) {
    pen.fillText(
      `${value.toFixed(digits)}${scale.left > 100 && unit ? ` ${unit}` : ""}`,
      scale.left - 6,
      y(value),
    );
    pen.fillStyle = colour("soft");
  }
  for (const [method, curve] of curves) drawCurve(pen, scale, readable(method.colour), curve, y);
}

function drawCurve(pen, scale, colour, { frames, values }, y) {
  pen.strokeStyle = colour;
  pen.lineWidth = 1.4;
  pen.lineJoin = "round";
  pen.beginPath();
  // Of many samples in a pixel, the least and the greatest are what a line would show of them.
  const bundle = Math.max(1, Math.floor(values.length / (2 * (scale.right - scale.left))));
  let down = false;
  for (let i = 0; i < values.length; i += bundle) {
    let [least, most] = [i, i];
    for (let j = i; j < Math.min(i + bundle, values.length); j++) {
      if (!(values[j] >= values[least])) least = j;
      if (!(values[j] <= values[most])) most = j;
    }
    for (const at of least === most ? [least] : [Math.min(least, most), Math.max(least, most)]) {
      if (!Number.isFinite(values[at])) down = false;
      else if (down) pen.lineTo(across(scale, frames[at]), y(values[at]));
      else {
        // A single value between gaps is a dot.
        pen.moveTo(across(scale, frames[at]) - 0.7, y(values[at]));
        pen.lineTo(across(scale, frames[at]) + 0.7, y(values[at]));
        down = true;
      }
    }
  }
  pen.stroke();
}

/** Returns text that is cut to a width. */
function clipped(pen, text, width) {
  if (pen.measureText(text).width <= width) return text;
  let shown = text;
  while (shown.length > 1 && pen.measureText(`${shown}…`).width > width) shown = shown.slice(0, -1);
  return `${shown}…`;
}
