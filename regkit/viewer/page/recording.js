/** A recording of a scene: its frames, and what each method found in them. */

import { numbers, rows } from "./arrays.js";
import { Verdicts } from "./verdicts.js";

/**
 * Points as whole numbers: a position is `origin + step * whole` [m].
 * @typedef {{origin: number[], step: number, positions: Int16Array}} Points
 *
 * A method's result in a frame: T_camera_segment as quaternion and translation (S, 7), markers
 * (M, 3) [m], how well data support each segment (S), and the ellipsoids that hold the markers, as
 * quaternion and half axes (M, 7) [m], if that is known.
 * @typedef {{transforms: Float32Array, markers: Float32Array, confidence: Float32Array | null,
 *   ellipsoids?: Float32Array | null}} Pose
 *
 * A frame; its points may still be at the address `href`.
 * @typedef {{number: number, time: number, points: Points | null, href: string | null,
 *   pending?: Promise<Points> | null, joints: Float32Array | null, poses: Pose[]}} Frame
 *
 * @typedef {{name: string, unit: string, frames: ArrayLike<number>, values: ArrayLike<number>}} Curve
 */

/** Lazily loaded points are kept for so many frames. */
const KEPT = 240;

export class Recording {
  /**
   * @param {any} source The recording as the scene's document has it.
   * @param {boolean} live Whether frames follow.
   */
  constructor(source, live) {
    this.live = live;
    /** @type {string} */
    this.name = source.name;
    /** Frames of the whole recording, not only those of the scene. @type {number} */
    this.length = source.length;
    /** Direction that is drawn upward. @type {number[]} */
    this.up = source.up;
    /** Intrinsics of the depth camera, or null. */
    this.camera = source.camera;
    /** Where several depth cameras are, and the corners of their pictures at one metre. */
    this.cameras = source.cameras ?? [];
    /** Frames that deserve a look, and why. @type {{frame: number, why: string}[]} */
    this.marks = [...source.marked].sort((a, b) => a.frame - b.frame);
    this.clouds = source.clouds.map((cloud) => ({ ...cloud, positions: numbers(cloud.positions) }));
    this.jointNames = source.joints?.names ?? [];
    this.methods = source.methods.map((method) => ({
      name: method.name,
      colour: method.colour,
      segments: method.segments,
      bones: numbers(method.bones),
      markerNames: method.markers.names,
      shapes: method.shapes,
      verdicts: new Verdicts(method.verdicts),
      curves: method.curves.map((curve) => ({
        name: curve.name,
        unit: curve.unit,
        frames: numbers(curve.frames),
        values: numbers(curve.values),
      })),
    }));
    /** @type {Frame[]} */
    this.frames = framesOf(source);
    /** Frames whose points were loaded, the latest last. @type {Frame[]} */
    this.loaded = [];
  }

  /** Returns the index of the frame that is nearest to a frame number. @param {number} number */
  nearest(number) {
    const after = this.frames.findIndex((frame) => frame.number >= number);
    if (after < 0) return this.frames.length - 1;
    const before = Math.max(after - 1, 0);
    const closer = number - this.frames[before].number < this.frames[after].number - number;
    return closer ? before : after;
  }

  /** First and last frame number of the timeline. */
  get range() {
    const first = this.live ? (this.frames[0]?.number ?? 0) : 0;
    return [first, Math.max(this.length - 1, this.frames.at(-1)?.number ?? 0, first)];
  }

  /**
   * Loads the points of a frame if they are not here.
   * @param {Frame} frame
   * @returns {Promise<void>}
   */
  async load(frame) {
    if (frame.points || frame.href === null) return;
    frame.pending ??= fetched(frame.href).finally(() => (frame.pending = null));
    const points = await frame.pending;
    if (frame.points) return;
    frame.points = points;
    this.loaded.push(frame);
    if (this.loaded.length > KEPT) this.loaded.shift().points = null;
  }
}

/** Returns the frames of a recording. @returns {Frame[]} */
function framesOf(source) {
  const { points, joints, methods } = source;
  const whole = points.href === undefined ? numbers(points.positions) : null;
  const offsets = whole && numbers(points.offsets);
  const truth = joints && rows(joints.positions);
  const results = methods.map(({ transforms, markers, confidence, ellipsoids }) => ({
    transforms: rows(transforms),
    markers: rows(markers.positions),
    confidence: confidence && rows(confidence),
    ellipsoids: ellipsoids ? rows(ellipsoids) : null,
  }));
  return source.frames.map((number, index) => ({
    number,
    time: number / (source.fps || 1),
    points: whole && {
      origin: points.origin,
      step: points.step,
      positions: whole.subarray(3 * offsets[index], 3 * offsets[index + 1]),
    },
    href: whole ? null : points.href.replace("{index}", index),
    joints: truth && truth[index],
    poses: results.map(({ transforms, markers, confidence, ellipsoids }) => ({
      transforms: transforms[index],
      markers: markers[index],
      confidence: confidence && confidence[index],
      ellipsoids: ellipsoids && ellipsoids[index],
    })),
  }));
}

/** Fetches a frame's points: origin and step as four floats, then whole numbers. */
async function fetched(href) {
  const answer = await fetch(href);
  if (!answer.ok) throw new Error(`${href}: ${answer.status} ${answer.statusText}`);
  const content = await answer.arrayBuffer();
  const [x, y, z, step] = new Float32Array(content, 0, 4);
  return { origin: [x, y, z], step, positions: new Int16Array(content, 16) };
}
