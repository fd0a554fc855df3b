/** Ellipsoids that hold the markers' true positions with a probability of 90 %. */

import {
  DynamicDrawUsage,
  InstancedMesh,
  Matrix4,
  MeshBasicMaterial,
  Quaternion,
  SphereGeometry,
  Vector3,
} from "three";
import { readable } from "./theme.js";

/** How much of what is behind them is hidden. */
const OPACITY = 0.3;

const centre = new Vector3();
const axes = new Quaternion();
const halves = new Vector3();
const matrix = new Matrix4();

export class Uncertainty {
  /** @param {any} method A method of a recording. */
  constructor(method) {
    this.method = method;
    this.count = method.markerNames.length;
    const material = new MeshBasicMaterial({ transparent: true, depthWrite: false });
    this.object = new InstancedMesh(new SphereGeometry(1, 20, 14), material, this.count);
    this.object.instanceMatrix.setUsage(DynamicDrawUsage);
    this.object.frustumCulled = false;
    this.object.renderOrder = 999;
    this.fade(1);
  }

  /** Draws the ellipsoids of a pose. @param {import("./recording.js").Pose} pose */
  place({ markers, ellipsoids }) {
    for (let m = 0; m < this.count; m++) {
      const known = ellipsoids && Number.isFinite(ellipsoids[7 * m]);
      centre.fromArray(markers, 3 * m);
      if (known) {
        axes.fromArray(ellipsoids, 7 * m);
        halves.fromArray(ellipsoids, 7 * m + 4);
      } else {
        halves.setScalar(0);
      }
      matrix.compose(centre, axes, halves).toArray(this.object.instanceMatrix.array, 16 * m);
    }
    this.object.instanceMatrix.needsUpdate = true;
  }

  paint() {
    this.object.material.color.set(readable(this.method.colour));
  }

  fade(presence) {
    this.object.material.opacity = OPACITY * presence;
  }

  dispose() {
    this.object.geometry.dispose();
    this.object.material.dispose();
    this.object.dispose();
  }
}
