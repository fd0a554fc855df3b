/** The canvas with its lights and its renderer, which draws only when something changed. */

import {
  AmbientLight,
  Color,
  DirectionalLight,
  Group,
  HemisphereLight,
  Scene,
  Vector3,
  WebGLRenderer,
} from "three";
import { View } from "./camera.js";
import { FINE } from "./material.js";
import { colour } from "./theme.js";

/** After so long without a change, a slow renderer draws a fine picture [ms]. */
const REST = 220;

const UP = new Vector3(0, 1, 0);

/** The browser cannot draw in three dimensions. */
export class NoWebGL extends Error {}

export class Stage {
  /** @param {HTMLCanvasElement} canvas */
  constructor(canvas) {
    this.slow = withoutGraphicsCard();
    const context = canvas.getContext("webgl2", { alpha: false, antialias: !this.slow });
    if (!context) throw new NoWebGL();
    this.canvas = canvas;
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
    new ResizeObserver(() => this.resize()).observe(canvas);
    this.resize();
  }

  /** Turns the recording's coordinates. @param {number[]} up */
  orient(up) {
    this.world.quaternion.setFromUnitVectors(new Vector3(...up).normalize(), UP);
    this.world.updateMatrixWorld(true);
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.canvas;
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(this.ratio(false));
    this.renderer.setSize(width, height, false);
    this.view.resize(width, height);
    this.invalidate();
  }

  /** Pixels of the picture in one of the page's, in a picture that stays or one of many. */
  ratio(still) {
    if (!this.slow) return Math.min(devicePixelRatio, 2);
    return still ? 2 : 0.75;
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
      this.render(false);
      if (!this.slow) return;
      clearTimeout(this.rest);
      this.rest = setTimeout(() => this.render(true), REST);
    });
  }

  render(still) {
    const ratio = this.ratio(still);
    this.view.camera.layers.set(0);
    if (still || !this.slow) this.view.camera.layers.enable(FINE);
    if (ratio !== this.renderer.getPixelRatio()) this.renderer.setPixelRatio(ratio);
    this.renderer.render(this.scene, this.view.camera);
    this.drawn();
  }
}

/** Whether the browser draws on the processor, for which smooth edges are too much in motion. */
function withoutGraphicsCard() {
  const context = document.createElement("canvas").getContext("webgl2");
  if (!context) return false;
  let name = context.getParameter(context.RENDERER);
  // Most browsers give a name of their own there; Firefox warns of those who ask for another.
  if (name === "WebKit WebGL") {
    const names = context.getExtension("WEBGL_debug_renderer_info");
    if (names) name = context.getParameter(names.UNMASKED_RENDERER_WEBGL);
  }
  context.getExtension("WEBGL_lose_context")?.loseContext();
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(name);
}
