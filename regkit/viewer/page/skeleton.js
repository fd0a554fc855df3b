/** Bones between the segments' origins and markers, above everything. */

import {
  Color,
  CylinderGeometry,
  DynamicDrawUsage,
  Group,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  Quaternion,
  Vector3,
} from "three";
import { Cloud } from "./points.js";
import { colour, readable } from "./theme.js";

const AXIS = new Vector3(0, 1, 0);
const start = new Vector3();
const end = new Vector3();
const middle = new Vector3();
const scale = new Vector3();
const rotation = new Quaternion();
const matrix = new Matrix4();

export class Skeleton {
  /** @param {any} method A method of a recording. @param {number} width Diameter of bones [m]. */
  constructor(method, width) {
    this.method = method;
    this.width = width;
    this.count = method.bones.length / 2;
    this.joints = new Float32Array(3 * (method.segments.length + method.markerNames.length));
    const material = new MeshBasicMaterial({ depthTest: false, transparent: true });
    this.bones = new InstancedMesh(
      new CylinderGeometry(0.5, 0.5, 1, 8, 1, true),
      material,
      this.count,
    );
    this.bones.instanceMatrix.setUsage(DynamicDrawUsage);
    this.bones.frustumCulled = false;
    this.bones.renderOrder = 1000;
    this.knots = new Cloud({ size: 2.6 * width, least: 4, most: 9, above: true });
    this.knots.object.renderOrder = 1001;
    this.object = new Group().add(this.bones, this.knots.object);
  }

  /** Draws the bones of a pose. @param {import("./recording.js").Pose} pose */
  place({ transforms, markers }) {
    const segments = this.method.segments.length;
    for (let s = 0; s < segments; s++) {
      for (let axis = 0; axis < 3; axis++) this.joints[3 * s + axis] = transforms[7 * s + 4 + axis];
    }
    this.joints.set(markers, 3 * segments);
    this.knots.set(markers);
    for (let b = 0; b < this.count; b++) {
      start.fromArray(this.joints, 3 * this.method.bones[2 * b]);
      end.fromArray(this.joints, 3 * this.method.bones[2 * b + 1]);
      const length = start.distanceTo(end);
      middle.addVectors(start, end).multiplyScalar(0.5);
      end.sub(start);
      if (length > 0) rotation.setFromUnitVectors(AXIS, end.divideScalar(length));
      matrix.compose(middle, rotation, scale.set(this.width, length, this.width));
      matrix.toArray(this.bones.instanceMatrix.array, 16 * b);
    }
    this.bones.instanceMatrix.needsUpdate = true;
  }

  /** Takes the method's colour, nearer to the ink, so that it stands out from its surface. */
  paint() {
    const shade = new Color(readable(this.method.colour)).lerp(new Color(colour("ink")), 0.45);
    this.bones.material.color.copy(shade);
    this.knots.uniforms.near.value.copy(shade);
  }

  fade(presence) {
    this.bones.material.opacity = presence;
    this.knots.uniforms.opacity.value = presence;
  }

  dispose() {
    this.bones.geometry.dispose();
    this.bones.material.dispose();
    this.bones.dispose();
    this.knots.dispose();
  }
}
