/** Many parts of one geometry, each carried by a segment: ellipsoids, tapered capsules. */

import {
  BufferGeometry,
  DynamicDrawUsage,
  Float32BufferAttribute,
  InstancedBufferAttribute,
  InstancedMesh,
  Matrix4,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "three";
import { numbers } from "./arrays.js";
import { FINE, surface } from "./material.js";

const AXIS = new Vector3(0, 1, 0);
const AROUND = 16;
const ALONG = 3;

const matrix = new Matrix4();

/** Parts that are drawn twice: their depth, then their surface. */
export class Instances {
  /**
   * @param {BufferGeometry} geometry
   * @param {ArrayLike<number>} segments Segment of each part (K).
   * @param {Matrix4[]} places T_segment_part of each part, with its scale (K).
   * @param {{depth: any, shown: any}} materials
   */
  constructor(geometry, segments, places, materials) {
    this.material = materials.shown;
    this.segments = segments;
    this.places = places;
    this.confidence = new InstancedBufferAttribute(new Float32Array(places.length).fill(1), 1);
    geometry.setAttribute("confidence", this.confidence.setUsage(DynamicDrawUsage));
    this.objects = [materials.depth, materials.shown].map(
      (material) => new InstancedMesh(geometry, material, places.length),
    );
    this.matrices = this.objects[0].instanceMatrix.setUsage(DynamicDrawUsage);
    this.objects[1].instanceMatrix = this.matrices;
    for (const object of this.objects) object.frustumCulled = false;
    this.objects[0].layers.set(FINE);
  }

  /** Moves the parts with their segments. @param {Matrix4[]} transforms T_camera_segment (S). */
  place(transforms) {
    const { segments, places } = this;
    for (let k = 0; k < places.length; k++) {
      matrix
        .multiplyMatrices(transforms[segments[k]], places[k])
        .toArray(this.matrices.array, 16 * k);
    }
    this.matrices.needsUpdate = true;
  }

  /** Fades the parts of segments. @param {ArrayLike<number> | null} confidence Of segments (S). */
  weigh(confidence) {
    const { array } = this.confidence;
    for (let k = 0; k < array.length; k++) array[k] = confidence?.[this.segments[k]] ?? 1;
    this.confidence.needsUpdate = true;
  }

  /** @param {string} colour */
  paint(colour) {
    this.material.color.set(colour);
  }

  dispose() {
    this.objects[0].geometry.dispose();
    for (const object of this.objects) {
      object.material.dispose();
      object.dispose();
    }
  }
}

/** Returns ellipsoids of a scene. */
export function ellipsoids(shape, look, presence) {
  const [centres, rotations, radii] = ["centres", "rotations", "radii"].map((key) =>
    numbers(shape[key]),
  );
  const segments = numbers(shape.segments);
  const places = Array.from(segments, (_, k) =>
    new Matrix4().compose(
      new Vector3().fromArray(centres, 3 * k),
      new Quaternion().fromArray(rotations, 4 * k),
      new Vector3().fromArray(radii, 3 * k),
    ),
  );
  const materials = surface(look, presence);
  return new Instances(new SphereGeometry(1, 16, 10), segments, places, materials);
}

/** Returns tapered capsules of a scene: the hulls of two spheres. */
export function capsules(shape, look, presence) {
  const [ends, radii, segments] = [shape.ends, shape.radii, shape.segments].map(numbers);
  const tapers = new Float32Array(4 * segments.length);
  const places = Array.from(segments, (_, k) => {
    const start = new Vector3().fromArray(ends, 6 * k);
    const axis = new Vector3().fromArray(ends, 6 * k + 3).sub(start);
    const length = axis.length();
    const [first, second] = [radii[2 * k], radii[2 * k + 1]];
    // The cone between the spheres touches both at the latitude of this sine. A sphere that
    // contains the other has no such cone, and nearly all of the surface.
    const sine = length > 0 ? Math.max(-0.98, Math.min(0.98, (first - second) / length)) : 0;
    tapers.set([first, second, length, sine], 4 * k);
    const turned =
      length > 0 ? new Quaternion().setFromUnitVectors(AXIS, axis.normalize()) : new Quaternion();
    return new Matrix4().compose(start, turned, new Vector3(1, 1, 1));
  });
  const geometry = capsuleGeometry();
  geometry.setAttribute("taper", new InstancedBufferAttribute(tapers, 4));
  return new Instances(geometry, segments, places, surface(look, presence, true));
}

/** Returns the vertices of a capsule as its material expects them: rings from pole to pole. */
function capsuleGeometry() {
  const heights = [];
  for (let i = ALONG; i >= 0; i--) heights.push(-1 - i / ALONG);
  for (let i = 0; i <= ALONG; i++) heights.push(1 + i / ALONG);
  const positions = [];
  const triangles = [];
  heights.forEach((height, ring) => {
    for (let i = 0; i <= AROUND; i++) {
      const angle = (2 * Math.PI * i) / AROUND;
      positions.push(Math.sin(angle), height, Math.cos(angle));
      if (ring === 0 || i === AROUND) continue;
      const [a, b] = [(ring - 1) * (AROUND + 1) + i, ring * (AROUND + 1) + i];
      triangles.push(a, a + 1, b, b, a + 1, b + 1);
    }
  });
  const geometry = new BufferGeometry();
  geometry.setAttribute("position", new Float32BufferAttribute(positions, 3));
  geometry.setIndex(triangles);
  return geometry;
}
