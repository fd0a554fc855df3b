/** The depth cameras of a recording of several: where each stands, where it looks, its name. */

import {
  BufferAttribute,
  BufferGeometry,
  CanvasTexture,
  Group,
  LineBasicMaterial,
  LineSegments,
  Sprite,
  SpriteMaterial,
  Vector3,
} from "three";
import { colour } from "./theme.js";

/** Length of a pyramid, and height of a name, in radii of the body. */
const LENGTH = 0.3;
const NAME = 0.18;

/** Height of a letter in the picture of a name, and its margin, in pixels. */
const LETTER = 48;
const MARGIN = 12;

const EDGES = [0, 1, 0, 2, 0, 3, 0, 4, 1, 2, 2, 3, 3, 4, 4, 1];

export class Sensors {
  /**
   * @param {{name: string, place: number[], corners: number[][]}[]} cameras
   * @param {number} size Radius of the body [m].
   */
  constructor(cameras, size) {
    this.cameras = cameras;
    this.size = size;
    this.object = new Group();
    this.material = new LineBasicMaterial();
    for (const camera of cameras) {
      const place = new Vector3(...camera.place);
      const ends = camera.corners.map((corner) =>
        new Vector3(...corner)
          .sub(place)
          .multiplyScalar(LENGTH * size)
          .add(place),
      );
      const geometry = new BufferGeometry().setFromPoints([place, ...ends]);
      geometry.setIndex(new BufferAttribute(new Uint16Array(EDGES), 1));
      const lines = new LineSegments(geometry, this.material);
      lines.frustumCulled = false;
      const name = new Sprite(new SpriteMaterial({ depthTest: false, transparent: true }));
      // The name stands above the camera, in any view.
      name.position.copy(place);
      name.center.set(0.5, -0.4);
      name.renderOrder = 1002;
      this.object.add(lines, name);
    }
  }

  /** Takes the colours of the style as they are at present. */
  paint() {
    const ink = colour("ink");
    this.material.color.set(ink);
    this.names.forEach((name, c) => {
      name.material.map?.dispose();
      const picture = written(this.cameras[c].name, ink);
      name.material.map = new CanvasTexture(picture);
      name.material.needsUpdate = true;
      const high = NAME * this.size;
      name.scale.set((high * picture.width) / picture.height, high, 1);
    });
  }

  get names() {
    return this.object.children.filter((child) => child.isSprite);
  }

  dispose() {
    for (const child of this.object.children) {
      if (child.isSprite) {
        child.material.map?.dispose();
        child.material.dispose();
      } else child.geometry.dispose();
    }
    this.material.dispose();
  }
}

/** Returns a canvas with a text. */
function written(text, ink) {
  const canvas = document.createElement("canvas");
  const pen = canvas.getContext("2d");
  const font = `${LETTER}px system-ui, sans-serif`;
  pen.font = font;
  canvas.width = Math.ceil(pen.measureText(text).width) + 2 * MARGIN;
  canvas.height = LETTER + 2 * MARGIN;
  pen.font = font;
  pen.fillStyle = ink;
  pen.textBaseline = "middle";
  pen.fillText(text, MARGIN, canvas.height / 2);
  return canvas;
}
