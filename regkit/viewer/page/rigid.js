/** Rigid transforms of a scene: a quaternion (x, y, z, w) and a translation [m]. */

import { Matrix4, Quaternion, Vector3 } from "three";

const rotation = new Quaternion();
const translation = new Vector3();
const UNSCALED = new Vector3(1, 1, 1);

/**
 * Sets matrices from transforms.
 * @param {Matrix4[]} matrices
 * @param {ArrayLike<number>} transforms (S, 7)
 */
export function setMatrices(matrices, transforms) {
  for (let s = 0; s < matrices.length; s++) {
    rotation.fromArray(transforms, 7 * s);
    translation.fromArray(transforms, 7 * s + 4);
    matrices[s].compose(translation, rotation, UNSCALED);
  }
}

/** Returns matrices of transforms. @param {ArrayLike<number>} transforms (S, 7) */
export function matricesOf(transforms, count) {
  const matrices = Array.from({ length: count }, () => new Matrix4());
  setMatrices(matrices, transforms);
  return matrices;
}
