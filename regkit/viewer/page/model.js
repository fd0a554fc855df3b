/** What a method has found: its model in one of its shapes, and its bones. */

import { Group, Matrix4, Vector3 } from "three";
import { numbers } from "./arrays.js";
import { capsules, ellipsoids } from "./instances.js";
import { Cloud } from "./points.js";
import { setMatrices } from "./rigid.js";
import { Skeleton } from "./skeleton.js";
import { Skin } from "./skin.js";
import { readable } from "./theme.js";
import { Uncertainty } from "./uncertainty.js";

/** The choice of each method's own kind of shape. */
export const OWN = "own";

/** How the kinds of shapes are called, in the order in which they are offered. */
export const KINDS = {
  mesh: "mesh",
  capsules: "capsules",
  ellipsoids: "ellipsoids",
  points: "points",
};

const MAKERS = {
  ellipsoids,
  capsules,
  mesh: (...parts) => new Skin(...parts),
  points: (...parts) => new CarriedPoints(...parts),
};

/** How much is left to see of a body that was not found. */
const GHOST = 0.45;

export class Model {
  /**
   * @param {any} method A method of a recording.
   * @param {number} order Number of the method, from 0.
   * @param {import("./material.js").Look} look
   * @param {number} size Radius of the scene [m].
   */
  constructor(method, order, look, size) {
    this.method = method;
    this.presence = { value: 1 };
    this.matrices = method.segments.map(() => new Matrix4());
    this.skeleton = new Skeleton(method, 0.009 * size);
    this.uncertainty = new Uncertainty(method);
    this.object = new Group().add(this.skeleton.object, this.uncertainty.object);
    /** Shapes by their kind. */
    this.shapes = new Map();
    for (const entry of method.shapes) {
      const shape = MAKERS[entry.kind](entry, look, this.presence, size);
      shape.objects.forEach((object, pass) => (object.renderOrder = 1 + 2 * order + pass));
      this.object.add(...shape.objects);
      this.shapes.set(entry.kind, [...(this.shapes.get(entry.kind) ?? []), shape]);
    }
  }

  /**
   * Shows the model in a pose.
   * @param {import("./recording.js").Pose} pose
   * @param {string} verdict
   * @param {import("./display.js").Display} display
   */
  show(pose, verdict, display) {
    const placed = display.methods.has(this.method.name) && pose.transforms.every(Number.isFinite);
    this.object.visible = placed;
    if (!placed) return;
    this.presence.value = verdict === "lost" || verdict === "no data" ? GHOST : 1;
    setMatrices(this.matrices, pose.transforms);
    const known = this.shapes.has(display.model) || display.model === "none";
    const kind = display.model === OWN ? this.own : known ? display.model : this.first;
    for (const [name, shapes] of this.shapes) {
      for (const shape of shapes) {
        for (const object of shape.objects) object.visible = name === kind;
        if (name !== kind) continue;
        shape.place(this.matrices);
        shape.weigh(pose.confidence);
      }
    }
    this.uncertainty.object.visible = display.uncertainty && Boolean(pose.ellipsoids);
    if (this.uncertainty.object.visible) {
      this.uncertainty.place(pose);
      this.uncertainty.fade(this.presence.value);
    }
    this.skeleton.object.visible = display.bones;
    if (!display.bones) return;
    this.skeleton.place(pose);
    this.skeleton.fade(this.presence.value);
  }

  /** The kind of shape that the method compares with the data. */
  get own() {
    return this.shapes.keys().next().value ?? "none";
  }

  /** The kind of shape that stands for one that the method does not have. */
  get first() {
    return Object.keys(KINDS).find((kind) => this.shapes.has(kind)) ?? "none";
  }

  /** Takes the method's colour as it is at present. */
  paint() {
    this.skeleton.paint();
    this.uncertainty.paint();
    for (const shape of [...this.shapes.values()].flat()) shape.paint(readable(this.method.colour));
  }

  dispose() {
    this.skeleton.dispose();
    this.uncertainty.dispose();
    for (const shape of [...this.shapes.values()].flat()) shape.dispose();
  }
}

const place = new Vector3();

/** Points that segments carry. */
class CarriedPoints {
  constructor(shape, look, presence, size) {
    this.segments = numbers(shape.segments);
    this.centres = numbers(shape.centres);
    this.places = new Float32Array(this.centres.length);
    this.cloud = new Cloud({ size: 0.012 * size });
    this.objects = [this.cloud.object];
  }

  place(transforms) {
    for (let k = 0; k < this.segments.length; k++) {
      place.fromArray(this.centres, 3 * k).applyMatrix4(transforms[this.segments[k]]);
      place.toArray(this.places, 3 * k);
    }
    this.cloud.set(this.places);
  }

  weigh() {}

  paint(colour) {
    this.cloud.uniforms.near.value.set(colour);
  }

  dispose() {
    this.cloud.dispose();
  }
}
