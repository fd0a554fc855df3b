/** Where the points and the bodies of a frame are, strays left out. */

import { Vector3 } from "three";

/** This share of the points on each side is taken for strays. */
const STRAYS = 0.01;
const SAMPLES = 4000;

/**
 * @typedef {{centre: Vector3, radius: number, wide: number, high: number, lowest: number,
 *   depths: [number, number], ahead: Vector3}} Extent
 * Centre, radius [m], greatest distance from the upright axis, half the height and lowest height in
 * the drawn coordinates, least and greatest depth in the recording's, and the direction in which
 * its depth camera looks.
 */

/**
 * Returns the extent of some frames, or null if there is nothing in them.
 * @param {import("./recording.js").Recording} recording
 * @param {import("./recording.js").Frame[]} frames
 * @param {import("three").Object3D} world
 * @param {{place: number[]}[]} cameras Depth cameras that belong to it.
 * @returns {Extent | null}
 */
export function extentOf(recording, frames, world, cameras = []) {
  const ahead = new Vector3(0, 0, 1).applyQuaternion(world.quaternion);
  const cloud = samples(frames.flatMap((frame) => (frame.points ? [pointsOf(frame.points)] : [])));
  const fixed = samples(recording.clouds.map((one) => one.positions));
  const bodies = frames.flatMap((frame) => frame.poses.flatMap((pose) => joints(pose)));
  const all = [...trimmed(cloud), ...trimmed(fixed), ...bodies].filter((point) =>
    Number.isFinite(point.x + point.y + point.z),
  );
  if (all.length === 0) return null;
  all.push(...cameras.map(({ place }) => new Vector3(...place)));
  const depths = all.map((point) => point.z);
  const drawn = all.map((point) => point.clone().applyQuaternion(world.quaternion));
  const low = drawn.reduce((least, point) => least.min(point), drawn[0].clone());
  const high = drawn.reduce((most, point) => most.max(point), drawn[0].clone());
  const centre = low.clone().add(high).multiplyScalar(0.5);
  const radius = Math.max(...drawn.map((point) => point.distanceTo(centre)), 1e-3);
  const wide = Math.max(...drawn.map(({ x, z }) => Math.hypot(x - centre.x, z - centre.z)));
  return {
    centre,
    radius,
    wide: Math.max(1.05 * wide, 0.1 * radius),
    high: Math.max(0.525 * (high.y - low.y), 0.1 * radius),
    lowest: low.y,
    depths: [Math.min(...depths), Math.max(...depths)],
    ahead,
  };
}

/** Returns the positions of points [m]. */
function pointsOf({ origin, step, positions }) {
  return positions.length === 0
    ? []
    : Float32Array.from(positions, (whole, i) => origin[i % 3] + step * whole);
}

/** Returns some positions of lists of coordinates, as vectors. */
function samples(lists) {
  const count = lists.reduce((sum, list) => sum + list.length / 3, 0);
  const stride = Math.max(1, Math.ceil(count / SAMPLES));
  return lists.flatMap((list) => {
    const found = [];
    for (let i = 0; i < list.length; i += 3 * stride) {
      found.push(new Vector3(list[i], list[i + 1], list[i + 2]));
    }
    return found;
  });
}

/** Returns the origins of the segments and the markers of a pose. */
function joints({ transforms, markers }) {
  const origins = [];
  for (let i = 4; i < transforms.length; i += 7) origins.push(...transforms.subarray(i, i + 3));
  return samples([origins, markers]);
}

/** Returns points without those that are farthest out in a coordinate. */
function trimmed(points) {
  const bounds = ["x", "y", "z"].map((axis) => {
    const sorted = points.map((point) => point[axis]).sort((a, b) => a - b);
    const cut = Math.floor(STRAYS * sorted.length);
    return [axis, sorted[cut], sorted[sorted.length - 1 - cut]];
  });
  return points.filter((point) =>
    bounds.every(([axis, low, high]) => point[axis] >= low && point[axis] <= high),
  );
}
