/** The canvas with its lights and its renderer, which draws only when something changed. */

import { AmbientLight, Color, DirectionalLight, Group, HemisphereLight, Scene, Vector3, WebGLRenderer } from "three";
import { View } from "./camera.js";
import { colour } from "./theme.js";

const UP = new Vector3(0, 1, 0);

/** The browser cannot draw in three dimensions. */
export class NoWebGL extends Error {}

export class Stage {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    const context = canvas.getContext("webgl2", { antialias: true, powerPreference: "high-performance" });
    if (!context) throw new NoWebGL();
    /** Called whenever a picture was drawn. @type {() => void} */
    this.drawn = () => {};
    this.renderer = new WebGLRenderer({ canvas, context });
    this.scene = new Scene();
    this.scene.background = new Color();
    /** What the recording's coordinates live in: turned so that its `up` is drawn upward. */
    this.world = this.scene.add(new Group()).children[0];
    this.sky = new HemisphereLight(0xffffff, 0xffffff, 1.6);
    this.scene.add(this.sky, new AmbientLight(0xffffff, 0.35));
    this.view = new View(canvas, () => this.invalidate());
    // One lamp goes with the viewer, above the left shoulder, so that no side is dark.
    const lamp = new DirectionalLight(0xffffff, 1.7);
    lamp.position.set(-0.6, 0.9, 1);
    this.view.camera.add(lamp, lamp.target);
    lamp.target.position.set(0, 0, -1);
    this.scene.add(this.view.camera);
    // A phone takes the canvas away from pages in the background.
    canvas.addEventListener("webglcontextrestored", () => this.invalidate());
    new ResizeObserver(() => this.resize(canvas)).observe(canvas);
    this.resize(canvas);
  }

  /** Turns the recording's coordinates. @param {number[]} up */
  orient(up) {
    this.world.quaternion.setFromUnitVectors(new Vector3(...up).normalize(), UP);
    this.world.updateMatrixWorld(true);
  }

  resize(canvas) {
    const { clientWidth: width, clientHeight: height } = canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.view.resize(width, height);
    this.invalidate();
  }

  /** Takes the colours of the style as they are at present. */
  paint() {
    this.scene.background.set(colour("scene"));
    this.sky.color.set(colour("sky"));
    this.sky.groundColor.set(colour("earth"));
    this.invalidate();
  }

  /** Has a picture drawn soon; many calls before it make one picture. */
  invalidate() {
    this.pending ??= requestAnimationFrame(() => {
      this.pending = undefined;
      if (this.view.update()) this.invalidate();
      this.renderer.render(this.scene, this.view.camera);
      this.drawn();
    });
  }
}
