/** From where the scene is seen: turned by hand, from a side, or as the depth camera sees it. */

import { PerspectiveCamera, Vector3 } from "three";
import { OrbitControls } from "three/OrbitControls.js";

const UP = new Vector3(0, 1, 0);

/** Angles [rad] of the first view, beside and above the line from the depth camera. */
const BESIDE = 0.45;
const ABOVE = 0.2;

/** Heights that the banner above and the buttons below take from the picture, in pixels. */
const BANNER = 52;
const BUTTONS = 48;

export class View {
  /** @param {HTMLCanvasElement} canvas @param {() => void} changed */
  constructor(canvas, changed) {
    this.camera = new PerspectiveCamera(32, 1, 0.01, 100);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.enableDamping = !matchMedia("(prefers-reduced-motion: reduce)").matches;
    this.controls.dampingFactor = 0.18;
    this.controls.addEventListener("change", changed);
    this.controls.addEventListener("start", () => this.leave());
    this.changed = changed;
    this.distance = 1;
    /** Name of the view, until it is turned by hand. */
    this.name = "";
    /** Takes the named view again, for another size of the canvas. @type {(() => void) | null} */
    this.again = null;
    /** Called when the view's name changed. @type {() => void} */
    this.renamed = () => {};
  }

  /** Moves the camera on as far as it still swings; returns whether it does. */
  update() {
    return this.sensor ? false : this.controls.update();
  }

  resize(width, height) {
    this.width = width;
    this.height = height;
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.again?.();
  }

  /**
   * Looks at all of an extent from a side.
   * @param {"free" | "front" | "side" | "top"} name
   * @param {import("./extent.js").Extent} extent
   */
  look(name, extent) {
    this.again = () => this.look(name, extent);
    this.sensor = null;
    const ahead = extent.ahead.clone().projectOnPlane(UP);
    // A depth camera that looks straight down has no front; any horizontal direction serves.
    if (ahead.lengthSq() < 1e-6) ahead.set(0, 0, 1).projectOnPlane(extent.ahead);
    ahead.normalize();
    const right = ahead.clone().cross(UP);
    const from = {
      front: () => ahead.clone().negate(),
      side: () => right.clone(),
      top: () => UP.clone().addScaledVector(ahead, -0.002),
      free: () =>
        ahead
          .clone()
          .multiplyScalar(-Math.cos(ABOVE))
          .applyAxisAngle(UP, BESIDE)
          .addScaledVector(UP, Math.sin(ABOVE)),
    }[name]();
    const tangent = Math.tan((this.camera.fov * Math.PI) / 360);
    const free = Math.max(1 - (BANNER + BUTTONS) / this.height, 0.4);
    const { wide, high } = extent;
    const [up, deep] = name === "top" ? [wide, high] : [high, wide];
    // What is nearest is drawn largest; it is nearer than the centre by the depth of the extent.
    this.distance = Math.max(up / (tangent * free), wide / (tangent * this.camera.aspect)) + deep;
    const middle = ((BANNER - BUTTONS) / this.height) * tangent * this.distance;
    const target = extent.centre.clone();
    if (name !== "top") target.addScaledVector(UP, middle);
    this.camera.near = this.distance / 100;
    this.camera.far = this.distance * 60;
    this.controls.minDistance = this.distance / 40;
    this.controls.maxDistance = this.distance * 12;
    this.controls.target.copy(target);
    this.camera.position.copy(target).addScaledVector(from, this.distance);
    this.camera.up.copy(UP);
    this.camera.updateProjectionMatrix();
    this.controls.enabled = true;
    this.controls.update();
    this.rename(name);
  }

  /**
   * Looks from where the depth camera is, with its own opening angles.
   * @param {{width: number, height: number, fx: number, fy: number, cx: number, cy: number}} sensor
   * @param {import("three").Object3D} world What the recording's coordinates live in.
   * @param {import("./extent.js").Extent} extent
   */
  see(sensor, world, extent) {
    this.again = () => this.see(sensor, world, extent);
    this.sensor = sensor;
    const turned = (x, y, z) => new Vector3(x, y, z).applyQuaternion(world.quaternion);
    this.camera.position.set(0, 0, 0);
    this.camera.up.copy(turned(0, -1, 0));
    this.camera.lookAt(turned(0, 0, 1));
    this.camera.updateMatrixWorld();
    this.distance = Math.max(extent.centre.length(), extent.radius);
    this.controls.target.copy(turned(0, 0, this.distance));
    this.project();
    this.rename("sensor");
  }

  /** Sets the opening angles so that the depth camera's picture fits into the canvas. */
  project() {
    const { width, height, fx, fy, cx, cy } = this.sensor;
    const wide = Math.max(1, ((this.width / this.height) * (height / fy)) / (width / fx));
    const high = Math.max(1, ((this.height / this.width) * (width / fx)) / (height / fy));
    /** Size of the depth camera's picture in the canvas, as a style. */
    this.border = { width: `${100 / wide}%`, height: `${100 / high}%` };
    const near = this.distance / 100;
    const across = (column) => ((width / 2 - cx + (column * wide * width) / 2) / fx) * near;
    const down = (row) => ((height / 2 - cy + (row * high * height) / 2) / fy) * near;
    const far = this.distance * 60;
    this.camera.projectionMatrix.makePerspective(
      across(-1),
      across(1),
      -down(-1),
      -down(1),
      near,
      far,
    );
    this.camera.projectionMatrixInverse.copy(this.camera.projectionMatrix).invert();
    this.changed();
  }

  /** Goes over from a named view to one that is turned by hand. */
  leave() {
    this.again = null;
    if (this.sensor) {
      this.sensor = null;
      this.camera.up.copy(UP);
      this.camera.near = this.distance / 100;
      this.camera.far = this.distance * 60;
      this.camera.updateProjectionMatrix();
    }
    this.rename("");
  }

  rename(name) {
    this.name = name;
    this.changed();
    this.renamed();
  }
}
