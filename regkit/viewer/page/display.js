/** What is drawn: the choices of the panel. */

import { KINDS, OWN } from "./model.js";

const $ = (id) => document.getElementById(id);
const BOXES = {
  points: "show-points",
  depth: "show-depth",
  bones: "show-bones",
  joints: "show-joints",
  cameras: "show-cameras",
  confidence: "show-confidence",
  uncertainty: "show-uncertainty",
  solid: "show-solid",
};

/**
 * @typedef {{model: string, points: boolean, depth: boolean, bones: boolean, joints: boolean,
 *   cameras: boolean, confidence: boolean, uncertainty: boolean, solid: boolean, methods: Set<string>}} Display
 */

/** Returns the display of a page that was just opened. @returns {Display} */
export const everything = () => ({
  model: "",
  points: true,
  depth: true,
  bones: true,
  joints: true,
  cameras: true,
  confidence: true,
  uncertainty: false,
  solid: false,
  methods: new Set(),
});

/**
 * Lets the panel's choices change a display.
 * @param {Display} display
 * @param {() => void} changed
 */
export function displayChoices(display, changed) {
  for (const [key, id] of Object.entries(BOXES)) {
    $(id).checked = display[key];
    $(id).addEventListener("change", () => {
      display[key] = $(id).checked;
      changed();
    });
  }
  $("model").addEventListener("change", () => {
    display.model = $("model").value;
    changed();
  });
}

/**
 * Offers what a recording has.
 * @param {import("./recording.js").Recording} recording
 * @param {Display} display
 */
export function offer(recording, display) {
  const { methods, clouds, jointNames, cameras, frames } = recording;
  const kinds = Object.keys(KINDS).filter((kind) =>
    methods.some((method) => method.shapes.some((shape) => shape.kind === kind)),
  );
  // Methods are compared by what each of them compares with the data.
  const own = methods.length > 1 && kinds.length > 1 ? [[OWN, "each method's own"]] : [];
  const options = [...own, ...kinds.map((kind) => [kind, KINDS[kind]]), ["none", "none"]];
  $("model").replaceChildren(...options.map(([value, text]) => new Option(text, value)));
  if (!options.some(([value]) => value === display.model)) display.model = options[0][0];
  $("model").value = display.model;
  const shown = (id, there) => (($(id).closest("label") ?? $(id)).hidden = !there);
  const points =
    recording.live || frames.some((frame) => frame.href !== null || frame.points?.positions.length);
  shown("model", kinds.length > 0);
  shown("show-points", points || clouds.length > 0);
  shown("show-depth", points);
  shown(
    "show-bones",
    methods.some((method) => method.bones.length || method.markerNames.length),
  );
  shown("show-joints", jointNames.length > 0);
  shown("show-cameras", cameras.length > 0);
  shown(
    "show-confidence",
    recording.live || frames.some((frame) => frame.poses.some((pose) => pose.confidence)),
  );
  shown(
    "show-uncertainty",
    frames.some((frame) => frame.poses.some((pose) => pose.ellipsoids)),
  );
  shown(
    "show-solid",
    kinds.some((kind) => kind !== "points"),
  );
}
