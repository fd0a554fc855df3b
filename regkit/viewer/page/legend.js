/** What the colours and signs of the scene and the timeline mean. */

import { element } from "./panel.js";
import { readable } from "./theme.js";

/**
 * Returns the rows of the legend: classes and colour of a sign, and its meaning.
 * @param {import("./recording.js").Recording} recording
 * @param {import("./display.js").Display} display
 * @param {number | undefined} cell Side of a cell of the ground's grid [m].
 */
function* meanings(recording, display, cell) {
  const { frames, clouds, methods, jointNames, cameras } = recording;
  if (
    recording.live ||
    frames.some((frame) => frame.href !== null || frame.points?.positions.length)
  ) {
    yield display.depth
      ? ["ramp", "", "points, near to far from the camera"]
      : ["plain", "", "points"];
  }
  for (const cloud of clouds) yield ["plain", cloud.colour, cloud.name];
  const [first] = methods;
  if (first?.bones.length)
    yield ["line knot", readable(first.colour), "bones and markers of a method"];
  if (jointNames.length > 0) yield ["cross", "", "reference joints"];
  if (display.cameras && cameras.length > 0) yield ["line", "", "depth cameras, and what they see"];
  if (frames.some((frame) => frame.poses.some((pose) => pose.confidence))) {
    yield ["sure", readable(first.colour), "model, from little to good support by data"];
  }
  if (display.uncertainty && frames.some((frame) => frame.poses.some((pose) => pose.ellipsoids))) {
    yield ["plain", readable(first.colour), "ellipsoids: where each marker is, with 90 %"];
  }
  if (cell !== undefined) {
    yield [
      "line",
      "",
      `ground grid, ${cell >= 1 ? `${cell} m` : `${Math.round(1e6 * cell) / 1e4} cm`}`,
    ];
  }
  if (recording.live || recording.length > 1) {
    yield ["ribbon found", "", "found"];
    yield ["ribbon doubtful", "", "doubtful"];
    yield ["ribbon lost", "", "lost: the model is faint"];
    yield ["ribbon no-data", "", "no data: the last pose, faint"];
  }
}

/** Fills the legend. @param {HTMLElement} list */
export function explain(list, ...of) {
  list.replaceChildren();
  for (const [name, colour, meaning] of meanings(...of)) {
    const sign = element("dt", name, name === "cross" ? "✕" : "");
    if (colour) sign.style.setProperty("--colour", colour);
    list.append(sign, element("dd", "", meaning));
  }
}
