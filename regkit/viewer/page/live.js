/** Frames that a server sends while they are tracked. */

import { listed } from "./arrays.js";
import { Verdicts } from "./verdicts.js";

/** So many of the last frames are kept. */
const KEPT = 600;

/**
 * Listens to the frames of a live scene.
 * @param {import("./recording.js").Recording} recording
 * @param {HTMLElement} status Where the server's words about the stream are shown.
 * @param {(dropped: number) => void} arrived Called after frames were appended.
 */
export function listen(recording, status, arrived) {
  const stream = new EventSource("frames");
  const told = (text, broken = false) => {
    status.textContent = text;
    status.toggleAttribute("data-broken", broken);
  };
  let dropped = 0;
  let refresh;
  const show = () => {
    refresh = undefined;
    arrived(dropped);
    dropped = 0;
  };
  told("Waiting for the first frame …");
  stream.addEventListener("message", (event) => {
    const data = JSON.parse(event.data);
    dropped += append(recording, data);
    // The cameras are known with the first frame, before anything is drawn.
    if (data.cameras && recording.cameras.length === 0) recording.cameras = data.cameras;
    // Frames that come faster than the screen shows pictures are shown together.
    refresh ??= requestAnimationFrame(show);
    told(data.status ?? "");
  });
  stream.addEventListener("end", (event) => {
    stream.close();
    told(event.data || "The stream has ended.");
  });
  stream.addEventListener("error", () => {
    const closed = stream.readyState === EventSource.CLOSED;
    told(closed ? "The connection broke." : "The connection broke; trying again …", true);
  });
}

/** Appends a frame; returns how many old ones were dropped. */
export function append(recording, data) {
  const { frames, methods } = recording;
  const number = data.frame;
  let dropped = 0;
  // A server that was started anew counts from the beginning.
  if (frames.length > 0 && number <= frames.at(-1).number) dropped = clear(recording);
  const results = new Map(data.methods.map((result) => [result.name, result]));
  frames.push({
    number,
    time: data.time,
    points: data.points && { ...data.points, positions: listed(data.points.positions, Int16Array) },
    href: null,
    joints: data.joints ? listed(data.joints) : null,
    poses: methods.map(({ name }) => poseOf(results.get(name))),
  });
  dropped += frames.splice(0, Math.max(0, frames.length - KEPT)).length;
  recording.length = number + 1;
  for (const method of methods) {
    const { verdict, curves = {} } = results.get(method.name) ?? {};
    if (verdict) method.verdicts.append(number, verdict, frames[0].number);
    for (const [name, value] of Object.entries(curves))
      note(method, name, number, value, frames[0].number);
  }
  return dropped;
}

/** Removes all frames; returns how many there were. */
function clear({ frames, methods }) {
  for (const method of methods) {
    method.verdicts = new Verdicts();
    for (const curve of method.curves) Object.assign(curve, { frames: [], values: [] });
  }
  return frames.splice(0).length;
}

function poseOf(result) {
  return {
    transforms: result ? listed(result.transforms) : new Float32Array([NaN]),
    markers: listed(result?.markers ?? []),
    confidence: result?.confidence ? listed(result.confidence) : null,
  };
}

/** Appends a value to a method's curve. */
function note(method, name, number, value, first) {
  let curve = method.curves.find((one) => one.name === name);
  if (!curve) {
    curve = { name, unit: "", frames: [], values: [] };
    method.curves.push(curve);
  }
  // A live recording's curves grow, which typed arrays do not.
  if (!Array.isArray(curve.frames)) {
    curve.frames = Array.from(curve.frames);
    curve.values = Array.from(curve.values);
  }
  curve.frames.push(number);
  curve.values.push(value ?? NaN);
  while (curve.frames[0] < first) {
    curve.frames.shift();
    curve.values.shift();
  }
}
